"""Tables of stiffness and damping over speed and frequency, as docs/linear.md has them."""

from __future__ import annotations

import functools
import os
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import _whirl
from .errors import CaseError, Diagnostic, FitError, WhirlError

__all__ = ["AtOneSpeed", "at_one_speed", "speed_of"]

ENTRIES = ("xx", "xy", "yx", "yy")
# The names of their columns, and units that they may have.
COEFFICIENTS = {
    f"{kind}_{entry}": unit for kind, unit in (("k", "N/m"), ("c", "N*s/m")) for entry in ENTRIES
}
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?\Z")
# Units with an angle do not count cycles.
ANGLES = re.compile(r"rad|rpm|deg|°")
# In no unit, and not within the text of a law.
QUOTES = re.compile(r"[\"\\\x00-\x1f]")
# Codes of docs/errors.md.
TABLE, UNIT, DIMENSION = "E033", "E020", "E021"
MOST_ERRORS = 8


@dataclass(frozen=True)
class AtOneSpeed:
    """The coefficients of a table at one speed.

    Attributes
    ----------
    file : str
        Of the table.
    speed : float or None
        rad/s; None of a table that does not say.
    between : tuple of float or None
        The speeds (rad/s) of the rows between which it is taken; None of a speed of the table.
    omega : numpy.ndarray
        Angular frequencies, rising, rad/s, shape ``(rows,)``.
    stiffness, damping : numpy.ndarray
        K in N/m and C in N·s/m, shape ``(rows, 2, 2)``.
    """

    file: str
    speed: float | None
    between: tuple[float, float] | None
    omega: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray


@functools.cache
def factor(unit: str, example: str) -> float:
    """What one of ``unit`` is in ``example``, a unit of SI, by the program's own reading of units.

    Raises
    ------
    CaseError
        It is unknown, or measures something else.
    """
    # A law whose force per metre is the number that is wanted: units are read where laws are.
    text = f"""
kind = "law"
name = "unit"
title = "a unit"
source = "none"
inputs.e_x = {{ unit = "m", range = [-1, 1] }}
[parameters]
length = {{ value = 1, unit = "m" }}
force = {{ value = 1, unit = "N" }}
one = {{ value = 1, unit = "{example}" }}
none = {{ value = 0, unit = "{example}" }}
unit = {{ value = 1, unit = "{unit}" }}
[outputs]
F_x = {{ unit = "N", value = 'force*(e_x/length)*(unit + none)/one' }}
F_y = {{ unit = "N", value = '0' }}
"""
    law = _whirl.Law.of_text("unit.toml", text)
    return float(law.evaluate(np.ones((1, 1)))[0, 0, 0])


def speed_of(speed: str | float) -> float:
    """A speed in rad/s; numbers are in rpm."""
    if isinstance(speed, str):
        found = re.match(r"\s*([^\s]*?\d)\s*([^\d\s.].*?)\s*\Z", speed)
        if not found or not NUMBER.match(found[1]):
            raise FitError(f"`{speed}` is no speed: write a number and a unit, such as `9000 rpm`")
        if not ANGLES.search(found[2]) or QUOTES.search(found[2]):
            raise FitError(
                f"`{found[2]}` is no unit of a speed: write it in rpm or rad/s, such as `9000 rpm`"
            )
        try:
            return float(found[1]) * factor(found[2], "rad/s")
        except CaseError as error:
            raise FitError(
                f"`{found[2]}` is no unit of a speed ({error.diagnostics[0].message}): write it in "
                "rpm or rad/s, such as `9000 rpm`"
            ) from error
    try:
        value = float(speed)
    except (TypeError, ValueError) as error:
        raise TypeError(
            f"a speed is a text such as '9000 rpm', or a number in rpm, not {speed!r}"
        ) from error
    return value * np.pi / 30.0


@dataclass(frozen=True)
class _Cell:
    line: int
    start: int
    text: str


class _File:
    """A file of columns, split into cells as the program splits it."""

    def __init__(self, name: str, text: str):
        self.name = name
        self.lines = text.removeprefix("\ufeff").splitlines()
        rows = [cells for cells in map(self._cells, range(len(self.lines))) if cells]
        self.heads: dict[str, _Cell] = {}
        self.units: dict[str, str] = {}
        if not rows or any(NUMBER.match(own.text) for own in rows[0]):
            message = f"`{name}` has no line of names"
            help = "write names and units above the numbers, such as `frequency [Hz], k_xx [N/m]`"
            raise CaseError([self.wrong(None, TABLE, message, help)])
        self.order = []
        for cell in rows[0]:
            parts = re.match(r"(.*?)\s*(?:\[(.*?)\]|\((.*?)\)|\Z)", cell.text)
            assert parts is not None
            called = parts[1].strip()
            if called and called in self.heads:
                message = f"two columns are called `{called}`"
                help = "give each column a name of its own"
                raise CaseError([self.wrong(cell, TABLE, message, help)])
            self.order.append(called)
            self.heads[called] = cell
            unit = parts[2] if parts[2] is not None else parts[3]
            if unit is not None:
                self.units[called] = unit.strip()
        self.rows = rows[1:]
        if not self.rows:
            message = f"`{name}` has no rows of numbers"
            raise CaseError([self.wrong(None, TABLE, message, "give a row for each frequency")])
        long = [own for own in self.rows if len(own) > len(self.order)]
        if long:
            help = "write numbers with a point, as `0.5`; commas separate columns, unless `;` does"
            raise CaseError(
                [
                    self.wrong(
                        own[len(self.order)],
                        TABLE,
                        f"this line has {len(own)} values, but the line of names has "
                        f"{len(self.order)} columns",
                        help,
                    )
                    for own in long[:MOST_ERRORS]
                ]
            )

    def _cells(self, place: int) -> list[_Cell]:
        line = self.lines[place]
        quoted = False
        for at, letter in enumerate(line):
            quoted ^= letter == '"'
            if letter == "#" and not quoted:
                line = line[:at]
                break
        line = line.rstrip()
        separator = next((own for own in ";\t," if own in line), None)
        if separator is None:
            # A unit in brackets belongs to the name before it.
            pieces = [own.span() for own in re.finditer(r"\S+(?:\s+[\[(]\S*)*", line)]
        else:
            ends = [at for at, letter in enumerate(line) if letter == separator]
            pieces = list(zip([0, *(own + 1 for own in ends)], [*ends, len(line)]))
            # A separator at the end of a line begins no column.
            if not line[pieces[-1][0] :].strip():
                pieces.pop()
        cells = []
        for start, end in pieces:
            text = line[start:end].strip().strip('"').strip()
            cells.append(_Cell(place, line.find(text, start), text))
        return cells

    def wrong(self, cell: _Cell | None, code: str, message: str, help: str) -> Diagnostic:
        """Something wrong at a cell, shown as the program shows it."""
        shown = [f"error[{code}]: {message}"]
        line = column = None
        if cell is not None:
            line, column = cell.line + 1, cell.start + 1
            blank = " " * len(str(line))
            marks = " " * cell.start + "^" * max(len(cell.text), 1)
            shown += [f"{blank}--> {self.name}:{line}:{column}", f"{blank} |"]
            shown += [f"{line} | {self.lines[cell.line]}", f"{blank} | {marks}", f"{blank} |"]
        else:
            blank = ""
            shown.append(f"--> {self.name}")
        shown.append(f"{blank} = help: {help}")
        return Diagnostic(message, self.name, line, column, help, code, "\n".join(shown) + "\n")

    def column(self, called: str, unit_like: str, needed: Iterable[str]) -> np.ndarray:
        """The numbers of a column in SI, whose unit measures the same as this one; frequencies are angular ones."""
        head = self.heads.get(called)
        example = f"{called} [{unit_like}]"
        if head is None:
            message = f"`{self.name}` has no column `{called}`"
            help = f"such as `{example}`; these are needed: {', '.join(needed)}"
            first = next(iter(self.heads.values()))
            raise CaseError([self.wrong(first, TABLE, message, help)])
        unit = self.units.get(called)
        if unit is None:
            message = f"the column `{called}` has no unit"
            help = f"write it behind the name, as in `{example}`"
            raise CaseError([self.wrong(head, TABLE, message, help)])
        times = self._factor(head, called, unit, unit_like)
        place = self.order.index(called)
        values, errors = [], []
        for row in self.rows:
            if place >= len(row):
                message = f"this line has no value in the column `{called}`"
                help = "write a value for each column, with commas between"
                errors.append(self.wrong(row[0], TABLE, message, help))
            elif not NUMBER.match(row[place].text) or not np.isfinite(float(row[place].text)):
                message = f"expected a number, found `{row[place].text}`"
                help = "write numbers with a point, such as `0.035` or `3.5e-2`"
                errors.append(self.wrong(row[place], TABLE, message, help))
            else:
                values.append(float(row[place].text) * times)
            if len(errors) == MOST_ERRORS:
                break
        if errors:
            raise CaseError(errors)
        return np.array(values)

    def _factor(self, head: _Cell, called: str, unit: str, example: str) -> float:
        """What one of the unit is in SI, if it measures the same as that of the example."""
        message = f"`{unit}` is no unit of the column `{called}`"
        help = f"such as `{called} [{example}]`"
        other = self.wrong(head, DIMENSION, message, help)
        turns = bool(ANGLES.search(unit))
        if QUOTES.search(unit) or example == "rpm" and not turns:
            raise CaseError([other])
        try:
            # A frequency in Hz counts cycles.
            if example == "Hz" and not turns:
                return 2.0 * np.pi * factor(unit, "Hz")
            return factor(unit, "rad/s" if example in ("Hz", "rpm") else example)
        except CaseError as error:
            own = error.diagnostics[0]
            if own.code != UNIT:
                raise CaseError([other]) from None
            raise CaseError([self.wrong(head, UNIT, own.message, own.help or help)]) from None


def at_one_speed(source: str | os.PathLike[str], speed: str | float | None) -> AtOneSpeed:
    """The coefficients of a table at a speed.

    Parameters
    ----------
    source : str or path
        The path of a file, or its text (a str with a line break).
    speed : str, float or None
        Such as ``"9000 rpm"``; numbers are in rpm. A table of one speed needs none.
    """
    name, text = _text(source)
    file = _File(name, text)
    over = [own for own in ("frequency", "frequency_ratio") if own in file.heads]
    if len(over) != 1:
        message = (
            f"`{name}` has both `frequency` and `frequency_ratio`"
            if over
            else f"`{name}` has no column `frequency`"
        )
        help = (
            "leave one of the two columns out"
            if over
            else "a law with states is fitted to coefficients over `frequency [Hz]` or "
            "`frequency_ratio [1]`; those over the speed alone are marched as they are, as `table` of "
            "a bushing"
        )
        first = file.heads[over[1]] if over else next(iter(file.heads.values()))
        raise CaseError([file.wrong(first, TABLE, message, help)])
    needed = [*over, *COEFFICIENTS]
    errors: list[Diagnostic] = []

    def read(called: str, unit_like: str) -> np.ndarray:
        try:
            return file.column(called, unit_like, needed)
        except CaseError as error:
            errors.extend(error.diagnostics)
            return np.zeros(0)

    ratio = over == ["frequency_ratio"]
    omega = read(over[0], "1" if ratio else "Hz")
    all_speeds = read("speed", "rpm") if "speed" in file.heads else None
    columns = [read(called, unit) for called, unit in COEFFICIENTS.items()]
    if errors:
        raise CaseError(errors)
    if (omega < 0).any():
        cell = file.rows[int(np.argmax(omega < 0))][file.order.index(over[0])]
        message = f"a `{over[0]}` is zero or more, not {cell.text}"
        help = (
            "stiffness and damping in the plane are real, and hold for backward whirl as for forward: "
            "leave negative rows out"
        )
        raise CaseError([file.wrong(cell, TABLE, message, help)])
    values = np.stack(columns, axis=1)

    def twice(row: int) -> CaseError:
        cell = file.rows[row][file.order.index(over[0])]
        message = f"the row of the {over[0]} {cell.text} is given twice at one speed"
        return CaseError([file.wrong(cell, TABLE, message, "give each pair of both once")])

    at, between, omega, values = _chosen(name, speed, all_speeds, omega, values, twice)
    if ratio:
        if at is None:
            raise FitError(
                f"`{name}` has frequencies as shares of a speed, which it does not say: name it, such "
                'as speed="9000 rpm"'
            )
        omega = omega * abs(at)
        if at == 0:
            raise FitError(
                f"`{name}` has frequencies as shares of the speed, which is 0: name another one"
            )
    matrices = values.reshape(-1, 2, 2, 2)
    return AtOneSpeed(name, at, between, omega, matrices[:, 0], matrices[:, 1])


def _chosen(
    name: str,
    speed: str | float | None,
    all_speeds: np.ndarray | None,
    omega: np.ndarray,
    values: np.ndarray,
    twice: Callable[[int], CaseError],
):
    """Speed, the speeds around it, and rows of it by rising frequency."""

    def sorted_rows(rows: np.ndarray):
        order = rows[np.argsort(omega[rows], kind="stable")]
        same = np.flatnonzero(np.diff(omega[order]) == 0)
        if len(same):
            raise twice(int(order[same[0] + 1]))
        return omega[order], values[order]

    wanted = None if speed is None else speed_of(speed)
    if all_speeds is None:
        return wanted, None, *sorted_rows(np.arange(len(omega)))
    known = np.unique(all_speeds)
    shown = ", ".join(f"{own * 30 / np.pi:.6g}" for own in known[:12]) + (
        ", …" if len(known) > 12 else ""
    )
    if wanted is None:
        if len(known) > 1:
            raise FitError(
                f"`{name}` has {len(known)} speeds, and a fit is of one: name it, such as "
                f'speed="{known[-1] * 30 / np.pi:.6g} rpm"; it has {shown} rpm'
            )
        wanted = float(known[0])
    # Speeds in other units are not the same bits.
    near = np.flatnonzero(np.abs(known - wanted) <= 1e-9 * np.abs(known).max())
    if len(near):
        wanted = float(known[near[0]])
        return wanted, None, *sorted_rows(np.flatnonzero(all_speeds == wanted))
    if not known[0] < wanted < known[-1]:
        raise FitError(
            f"{wanted * 30 / np.pi:.6g} rpm lies outside the speeds of `{name}`: name one from "
            f"{known[0] * 30 / np.pi:.6g} to {known[-1] * 30 / np.pi:.6g} rpm; it has {shown} rpm"
        )
    by_speed = [sorted_rows(np.flatnonzero(all_speeds == own)) for own in known]
    axis = by_speed[0][0]
    if any(len(own) != len(axis) or (own != axis).any() for own, _ in by_speed):
        raise FitError(
            f"{wanted * 30 / np.pi:.6g} rpm lies between the speeds of `{name}`, which have different "
            f"frequencies: name one of its speeds, {shown} rpm, or give all the same frequencies"
        )
    grid = np.stack([own for _, own in by_speed])
    place = int(np.searchsorted(known, wanted))
    around = (float(known[place - 1]), float(known[place]))
    return wanted, around, axis, _cubic(known, grid, wanted)


def _cubic(x: np.ndarray, y: np.ndarray, at: float) -> np.ndarray:
    """The monotone cubic of docs/laws.md between rows, at one place; ``y`` has the rows first."""
    h = np.diff(x)
    h = h.reshape(-1, *[1] * (y.ndim - 1))
    secants = np.diff(y, axis=0) / h

    def limited(slope, near, other):
        none = (near * other <= 0) | (slope * near <= 0)
        most = 3.0 * np.minimum(np.abs(near), np.abs(other))
        return np.where(none, 0.0, np.clip(slope, -most, most))

    slopes = np.empty_like(y)
    if len(x) == 2:
        slopes[:] = secants[0]
    else:
        inner = (secants[:-1] * h[1:] + secants[1:] * h[:-1]) / (h[:-1] + h[1:])
        slopes[1:-1] = limited(inner, secants[:-1], secants[1:])
        for end, first, second, widths in (
            (0, secants[0], secants[1], (h[0], h[1])),
            (-1, secants[-1], secants[-2], (h[-1], h[-2])),
        ):
            own = first + (first - second) * widths[0] / (widths[0] + widths[1])
            slopes[end] = limited(own, first, first)
    place = int(np.clip(np.searchsorted(x, at) - 1, 0, len(x) - 2))
    width, t = x[place + 1] - x[place], at - x[place]
    s, m, n = secants[place], slopes[place], slopes[place + 1]
    b, c = (3.0 * s - 2.0 * m - n) / width, (m + n - 2.0 * s) / width**2
    return y[place] + t * (m + t * (b + t * c))


def _text(source: str | os.PathLike[str]) -> tuple[str, str]:
    """What messages call it, and its text."""
    if isinstance(source, str) and "\n" in source:
        return "table.csv", source
    if not isinstance(source, (str, os.PathLike)):
        raise TypeError(
            f"a table is the path of a file or its text, not {type(source).__name__} ({source!r})"
        )
    try:
        return os.fspath(source), Path(source).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise WhirlError(f"cannot read `{os.fspath(source)}`: {error}") from error
