"""Tables of stiffness and damping over speed and frequency, as docs/linear.md has them."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ._columns import ANGLES, NUMBER, QUOTES, TABLE, File, factor
from .errors import CaseError, Diagnostic, FitError, WhirlError

__all__ = ["AtOneSpeed", "at_one_speed", "speed_of"]

ENTRIES = ("xx", "xy", "yx", "yy")
# The names of their columns, and units that they may have.
COEFFICIENTS = {
    f"{kind}_{entry}": unit for kind, unit in (("k", "N/m"), ("c", "N*s/m")) for entry in ENTRIES
}


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
    file = File(name, text)
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
