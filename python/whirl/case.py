"""Cases: from a file, a dict or a text to results."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from . import _toml, _whirl
from .bodies import Bodies, shared_bodies
from .errors import RunError, WhirlError, WhirlWarning
from .history import Column
from .law import Law
from .linear import Analyses
from .results import Results

__all__ = ["Case", "cases"]

Progress = Callable[[int, int, float], object]


class Case(Analyses):
    """A case, read and checked as far as it can be without its meshes.

    It can be run if it has ``[march]``, and analysed with or without: see :class:`whirl.Analyses`.

    Parameters
    ----------
    source : str, path or mapping
        A file by its path; a built-in case by its name (:func:`whirl.cases`); a text (a str with a line break); or a dict with
        the keys of a case file. A value of a dict may be a NumPy number or array, a path, or at a key ``law`` a
        :class:`whirl.Law`.
    name : str, optional
        Name of a case from a text or dict, ``case`` if none is given.
    folder : path, optional
        What paths in a text or dict are relative to; the current folder if none is given.
    files : mapping of str to str, path or Law, optional
        Files beside the case that are not on disk, such as ``{"my-law.toml": text}``: their texts, paths of files, or laws.

    Raises
    ------
    CaseError
        Everything that is wrong, each with its file, line, column and help.

    Examples
    --------
    >>> case = whirl.Case({
    ...     "include": "hu2003-5.toml",
    ...     "springs": {"law": whirl.Law("my-law.toml")},
    ...     "march": {"steps": 500},
    ... })
    >>> results = case.run()
    >>> results["RX1_N"].max()
    """

    def __init__(
        self,
        source: str | os.PathLike[str] | Mapping[str, Any],
        *,
        name: str | None = None,
        folder: str | os.PathLike[str] | None = None,
        files: Mapping[str, str | os.PathLike[str] | Law] | None = None,
    ):
        texts = _texts(files or {})
        if isinstance(source, Mapping):
            inner = _of_text(_toml.dumps(_with_laws(source, texts)), name, folder, texts)
        elif isinstance(source, str) and "\n" in source:
            inner = _of_text(source, name, folder, texts)
        elif isinstance(source, (str, os.PathLike)):
            if name is not None or folder is not None:
                raise TypeError("`name` and `folder` are for cases from a text or a dict")
            inner = _of_path(os.fspath(source), texts)
        else:
            raise TypeError(
                f"a case is a path, a name, a text or a dict, not {type(source).__name__} ({source!r})"
            )
        self._take(inner)

    def _take(self, inner: _whirl.Case) -> None:
        self._inner = inner
        _warn(inner.warnings)

    def __reduce__(self):
        state = self._inner.state()
        if state is None:
            return _built_in, (self.name,)
        path, text, files, values = state
        return _restored, (str(path), text, {str(own): text for own, text in files.items()}, values)

    def __repr__(self) -> str:
        return f"<whirl.Case {self.name}: {self.title}>"

    @property
    def name(self) -> str:
        """Its name: that of its file without the ending."""
        return self._inner.name

    @property
    def title(self) -> str:
        """One line."""
        return self._inner.title

    @property
    def steps(self) -> int:
        """Steps that it asks for; those from row to row where the program chooses the others."""
        return self._inner.steps

    @property
    def supports(self) -> tuple[str, ...]:
        """Numbers of its supports or stops, or names of its joints, as columns and the summary have them."""
        return tuple(self._inner.supports)

    @property
    def text(self) -> str | None:
        """The text of its file; None of a built-in case."""
        state = self._inner.state()
        return None if state is None else state[1]

    def check(self, *, bodies: Bodies | None = None) -> str:
        """Checks everything that can be found wrong without running: what ``whirl check`` says of the case.

        Its bodies are reduced, and kept in memory for the runs to come.

        Raises
        ------
        CaseError
            As of the constructor, and for meshes and sets.
        """
        report, warned = self._inner.check(_bodies(bodies))
        _warn(warned)
        return report

    def columns(self, *, bodies: Bodies | None = None) -> tuple[Column, ...]:
        """Name, unit and meaning of every column that the history will have."""
        return tuple(Column(*own) for own in self._inner.columns(_bodies(bodies)))

    def run(
        self,
        *,
        progress: Progress | None = None,
        raises: bool = True,
        bodies: Bodies | None = None,
    ) -> Results:
        """Runs the case; nothing is written to disk.

        Other threads of Python run meanwhile, and runs on several of them use as many processors. A KeyboardInterrupt ends
        the run after its step, as does an exception of ``progress``; such an exception has what was computed by then as
        its attribute ``results``.

        Parameters
        ----------
        progress : callable, optional
            ``progress(step, steps, time)`` is called on this thread at most 20 times a second, and after the last step: steps
            that are done, steps in all, time in s.
        raises : bool, default True
            Whether a run that ends early, as a step does not converge, raises. Its ``results.reason`` says why otherwise.
        bodies : Bodies, optional
            Where reduced bodies are found and kept; :func:`whirl.shared_bodies` if none are given.

        Returns
        -------
        Results

        Raises
        ------
        RunError
            A step does not converge; its attribute ``results`` has the steps before.
        CaseError
            Meshes, sets or laws that are wrong; a case without ``[march]``.
        """
        if progress is not None and not callable(progress):
            raise TypeError(f"`progress` is called, but {type(progress).__name__} cannot be")
        run = self._inner.run(_bodies(bodies), progress)
        _warn(run.warnings)
        inner, own = self._inner, _bodies(bodies)
        results = Results._of(
            self.name, self.title, run, lambda: inner.page_facts(own, run.steady)
        )
        if run.error is not None:
            run.error.results = results  # type: ignore[attr-defined]
            raise run.error
        if raises and run.reason is not None:
            raise RunError(run.reason, results)
        return results


def cases() -> list[str]:
    """Names of the built-in cases."""
    return _whirl.cases()


def _bodies(bodies: Bodies | None) -> Bodies:
    return shared_bodies() if bodies is None else bodies


def _warn(words) -> None:
    for own in words:
        warnings.warn(own, WhirlWarning, stacklevel=3)


def _of_path(path: str, texts: dict[str, str]) -> _whirl.Case:
    if not os.path.isfile(path):
        if texts:
            raise TypeError("`files` are for cases from a file, a text or a dict")
        return _whirl.Case.built_in(path)
    if not texts:
        return _whirl.Case.of_file(path)
    return _beside(Path(path), _read(path), texts)


def _of_text(
    text: str,
    name: str | None,
    folder: str | os.PathLike[str] | None,
    texts: dict[str, str],
) -> _whirl.Case:
    name = "case" if name is None else name
    if not name or name != os.path.basename(name):
        raise ValueError(f"`{name}` cannot be the name of a case, under which results are kept")
    return _beside(Path(folder or "") / f"{name}.toml", text, texts)


def _beside(path: Path, text: str, texts: dict[str, str]) -> _whirl.Case:
    files = {str(path.with_name("_").parent / own): text for own, text in texts.items()}
    return _whirl.Case.of_text(str(path), text, files)


def _texts(files: Mapping[str, str | os.PathLike[str] | Law]) -> dict[str, str]:
    """The texts of files by their names."""
    texts = {}
    for name, own in files.items():
        if isinstance(own, Law):
            texts[name] = own.text
        elif isinstance(own, os.PathLike):
            texts[name] = _read(own)
        elif isinstance(own, str):
            texts[name] = own
        else:
            raise TypeError(
                f"`files[{name!r}]` is a text, a path or a law, not {type(own).__name__} ({own!r})"
            )
    return texts


def _read(path: str | os.PathLike[str]) -> str:
    try:
        return Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise WhirlError(f"cannot read `{os.fspath(path)}`: {error}") from error


def _with_laws(value: Any, texts: dict[str, str], key: str = "") -> Any:
    """A dict with files in place of laws; their texts are added."""
    if isinstance(value, Law):
        if key != "law":
            return value
        file = f"{value.name}.toml"
        number = 1
        while texts.setdefault(file, value.text) != value.text:
            number += 1
            file = f"{value.name}-{number}.toml"
        return file
    if isinstance(value, Mapping):
        return {own: _with_laws(inner, texts, own) for own, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_with_laws(inner, texts, key) for inner in value]
    return value


def _built_in(name: str) -> Case:
    return _made(_whirl.Case.built_in(name))


def _restored(path: str, text: str, files: dict[str, str], values: str) -> Case:
    return _made(_whirl.Case.of_text(path, text, files, values))


def _made(inner: _whirl.Case) -> Case:
    case = Case.__new__(Case)
    case._inner = inner
    return case
