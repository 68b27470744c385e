"""What a run leaves."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .errors import WhirlError
from .history import Column, History, _absent
from .plots import Plots

__all__ = ["Finding", "Results", "Summary", "Verdict"]


class Summary(Mapping[str, Any]):
    """``summary.json`` as an object: ``summary.time.real_time_factor`` is ``summary["time"]["real_time_factor"]``.

    Tables within it are summaries, too, and lists of them are tuples.
    """

    __slots__ = ("_facts", "_where")

    def __init__(self, facts: Mapping[str, Any], where: str = "summary"):
        self._facts = dict(facts)
        self._where = where

    def __getitem__(self, key: str) -> Any:
        try:
            value = self._facts[key]
        except KeyError:
            raise KeyError(_absent(f"entry of {self._where}", key, self._facts)) from None
        return _wrapped(value, f"{self._where}.{key}")

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._facts)

    def __len__(self) -> int:
        return len(self._facts)

    def __dir__(self):
        return [*super().__dir__(), *(key for key in self._facts if key.isidentifier())]

    def __repr__(self) -> str:
        return f"<{self._where}: {', '.join(self._facts)}>"

    def __reduce__(self):
        return Summary, (self._facts, self._where)

    def to_dict(self) -> dict[str, Any]:
        """As plain dicts and lists, a copy."""
        return json.loads(json.dumps(self._facts))


def _wrapped(value: Any, where: str) -> Any:
    if isinstance(value, dict):
        return Summary(value, where)
    if isinstance(value, list):
        return tuple(_wrapped(own, f"{where}[{place}]") for place, own in enumerate(value))
    return value


@dataclass(frozen=True)
class Finding:
    """Something beyond its limit.

    Attributes
    ----------
    what : str
        What was found, and where.
    value, limit : float or None
        In ``unit``; None where it is no number.
    unit : str
        Their unit.
    remedy : str
        What to do about it.
    """

    what: str
    value: float | None
    limit: float | None
    unit: str
    remedy: str

    def __str__(self) -> str:
        return f"{self.what}: {self.value} {self.unit}, limit {self.limit}; remedy: {self.remedy}"


@dataclass(frozen=True)
class Verdict:
    """What the program itself believes of a run; true where it is sound.

    Attributes
    ----------
    sound : bool
        Whether nothing was found that speaks against the results.
    findings : tuple of Finding
        What was.
    measures : Summary
        What was measured of all steps, sound or not.
    """

    sound: bool
    findings: tuple[Finding, ...]
    measures: Summary

    def __bool__(self) -> bool:
        return self.sound

    def __str__(self) -> str:
        if self.sound:
            return "sound"
        return "NOT SOUND, do not use these results\n" + "\n".join(
            f"  {own}" for own in self.findings
        )


class Results(Plots):
    """The results of a run.

    Attributes
    ----------
    name, title : str
        Of the case.
    history : History
        The rows: a mapping from names of columns to arrays of shape ``(rows,)``.
    summary : Summary
        Numbers over the last cycle, counts, energies, times.
    reason : str or None
        Why the run has ended early, if it has.
    notes : tuple of str
        What is to be known of its start, such as the equilibrium that was found.
    """

    def __init__(
        self,
        name: str,
        title: str,
        history: History,
        summary: str,
        reason: str | None = None,
        notes: Iterable[str] = (),
        state: bytes | None = None,
        facts: Callable[[], tuple[str, str | None]] | None = None,
    ):
        self.name = name
        self.title = title
        self.history = history
        self._summary = summary
        self.summary = Summary(json.loads(summary))
        self.reason = reason
        self.notes = tuple(notes)
        self._state = state
        # What a page tells beside the numbers, made where it is asked for.
        self._facts = facts

    @classmethod
    def _of(cls, name: str, title: str, run, facts=None) -> Results:
        columns = [Column(*own) for own in run.columns]
        history = History(run.values, columns)
        return cls(name, title, history, run.summary, run.reason, run.notes, run.state, facts)

    def __reduce__(self):
        own = (self.name, self.title, self.history, self._summary)
        return Results, (*own, self.reason, self.notes, self._state)

    def __repr__(self) -> str:
        early = f", ended early: {self.reason}" if self.reason else ""
        sound = "sound" if self.verdict else "NOT SOUND"
        return f"<whirl.Results of {self.name}: {len(self.history.array)} rows, {sound}{early}>"

    def __getitem__(self, name: str) -> np.ndarray:
        """A column of the history, shape ``(rows,)``."""
        return self.history[name]

    @property
    def complete(self) -> bool:
        """Whether every step was done that was asked for, or the steady state was reached that was to end the run."""
        return bool(self.summary.march.complete)

    @property
    def verdict(self) -> Verdict:
        """What the program itself believes of the run."""
        own = self.summary.to_dict()["verdict"]
        findings = tuple(Finding(**found) for found in own["findings"])
        return Verdict(own["sound"], findings, Summary(own["measures"], "verdict.measures"))

    def to_xarray(self) -> Any:
        """As :meth:`History.to_xarray`, with the case, the verdict and the version as attributes of the dataset."""
        dataset = self.history.to_xarray()
        dataset.attrs.update(self._about())
        return dataset

    def to_pandas(self) -> Any:
        """As :meth:`History.to_pandas`, with the case, the verdict and the version in ``frame.attrs``."""
        frame = self.history.to_pandas()
        frame.attrs.update(self._about())
        return frame

    def save(self, folder: str | os.PathLike[str]) -> Path:
        """Writes ``history.csv``, ``summary.json`` and ``state.bin``, as ``whirl run`` does.

        A case whose ``[start]`` has ``from`` with this folder goes on from there.

        Parameters
        ----------
        folder : path
            Made where it is missing. Files of these names in it are replaced.

        Returns
        -------
        pathlib.Path
            The folder.
        """
        folder = Path(folder)
        try:
            folder.mkdir(parents=True, exist_ok=True)
            with open(folder / "history.csv", "w", encoding="utf-8", newline="\n") as file:
                from ._whirl import csv

                file.write(csv(list(self.history), np.ascontiguousarray(self.history.array)))
            with open(folder / "summary.json", "w", encoding="utf-8", newline="\n") as file:
                file.write(self._summary)
            if self._state is not None:
                (folder / "state.bin").write_bytes(self._state)
            else:
                (folder / "state.bin").unlink(missing_ok=True)
        except OSError as error:
            raise WhirlError(f"cannot write the results to `{folder}`: {error}") from error
        return folder

    def report(self, path: str | os.PathLike[str] = "report.html") -> Path:
        """Writes the page that ``whirl run`` leaves: one file, which any browser opens without a network.

        Parameters
        ----------
        path : path, default "report.html"
            A file there is replaced.

        Returns
        -------
        pathlib.Path
            The page.

        Raises
        ------
        WhirlError
            The results come from another process, which alone knows the case; the page cannot be written.
        """
        if self._facts is None:
            raise WhirlError(
                "these results come from another process, which alone knows their case: "
                "call `report` where the case is run"
            )
        from ._whirl import page_of

        about, shapes = self._facts()
        path = Path(path)
        try:
            with tempfile.TemporaryDirectory() as name:
                folder = self.save(name)
                (folder / "about.json").write_text(about, encoding="utf-8")
                if shapes is not None:
                    (folder / "shapes.json").write_text(shapes, encoding="utf-8")
                page = page_of(folder)
            with open(path, "w", encoding="utf-8", newline="\n") as file:
                file.write(page)
        except OSError as error:
            raise WhirlError(f"cannot write the report to `{path}`: {error}") from error
        return path

    def _about(self) -> dict[str, Any]:
        return {
            "case": self.name,
            "title": self.title,
            "whirl_version": self.summary.version,
            "sound": int(self.verdict.sound),
            **({"ended_early": self.reason} if self.reason else {}),
        }
