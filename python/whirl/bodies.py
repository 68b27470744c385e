"""Reduced bodies, which cases share."""

from __future__ import annotations

import os

from ._whirl import Bodies

__all__ = ["Bodies", "forget_bodies", "keep_bodies", "shared_bodies"]

_shared = Bodies()


def shared_bodies() -> Bodies:
    """The reduced bodies of this process, which all cases use that are given no others."""
    return _shared


def keep_bodies(folder: str | os.PathLike[str] | None = None) -> Bodies:
    """Keeps reduced bodies on disk from here on, so that the next process finds them.

    Parameters
    ----------
    folder : path, optional
        Where; the place where the command ``whirl`` keeps them if none is given.

    Returns
    -------
    Bodies
        What :func:`shared_bodies` gives now. Without a call of this nothing is written to disk.
    """
    global _shared
    kept = Bodies(None if folder is None else os.fspath(folder), folder is None)
    for packed in _shared.held():
        kept.adopt(packed)
    _shared = kept
    return kept


def forget_bodies() -> None:
    """Frees the memory of all reduced bodies; those on disk stay. Cases that are built keep theirs."""
    global _shared
    folder = _shared.folder
    _shared = Bodies(None if folder is None else os.fspath(folder))
