"""Rotors of the program ROSS as cases."""

from __future__ import annotations

import os
import tempfile
import warnings
from pathlib import Path
from typing import Any

from . import _whirl
from .case import Case
from .errors import WhirlWarning

__all__ = ["from_ross"]


def from_ross(rotor: Any, *, name: str = "rotor", add: str = "") -> Case:
    """A case from a rotor of ROSS, whose shaft is a solid body there: what ``whirl new case --from`` writes.

    Shaft elements become sections, discs and masses stand at their z, bearings and seals are bushings with their coefficients
    or tables over the speed, and supports are bodies. What has no counterpart or differs is a comment in the case
    (:attr:`Case.text`) and a :class:`WhirlWarning`.

    Parameters
    ----------
    rotor : ross.Rotor, ross.CoAxialRotor or path
        The rotor, or a file that its ``save`` wrote. A rotor is saved into a temporary folder, which is removed again.
    name : str
        Name of the case.
    add : str
        Lines added at the end of the case, such as an unbalance and a table ``[march]``.

    Raises
    ------
    CaseError
        What no rotor has, such as a bore that is not smaller than the shaft.

    Examples
    --------
    >>> import ross
    >>> case = whirl.from_ross(ross.rotor_example())
    >>> print(case.check())
    """
    if isinstance(rotor, (str, os.PathLike)):
        return _made(os.fspath(rotor), name, add)
    if not callable(getattr(rotor, "save", None)):
        raise TypeError(
            f"a rotor of ROSS or a path is needed, not {type(rotor).__name__} ({rotor!r})"
        )
    with tempfile.TemporaryDirectory() as folder:
        # ROSS saves to files alone.
        path = Path(folder) / f"{name}.json"
        rotor.save(path)
        return _made(str(path), name, add)


def _made(path: str, name: str, add: str) -> Case:
    text, files, notes = _whirl.case_of_rotor(path, name)
    for note in notes:
        warnings.warn(note, WhirlWarning, stacklevel=3)
    return Case(text + add, name=name, files=files)
