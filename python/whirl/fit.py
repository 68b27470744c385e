"""Laws with states from tables of stiffness and damping over the frequency."""

from __future__ import annotations

import os
import re
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from . import _toml
from ._coefficients import ENTRIES, AtOneSpeed, at_one_speed
from ._law_of_fit import law_text, printed
from ._rational import Rational, Samples, believable, fitted, grows
from .errors import FitError, WhirlError, WhirlWarning
from .law import Law
from .plots import plot_fit

__all__ = ["FittedLaw", "fit_law"]

MOST_POLES = 8
SOURCE = (
    "fitted by whirl.fit_law to {}; vector fitting: Gustavsen, Semlyen, "
    "IEEE Trans. Power Delivery 14 (1999) 1052-1061"
)
EQUATION = (
    "F = -(K_0 + C_0 s + sum of R_j s/(s + p_j)) e, s the rate of change, fitted to K + i w C of"
)
LIMITS = (
    "It holds at this speed alone, for small motions about the centre, or about a static position: "
    "its force is relative to e = 0, where it is zero, and K_0 e is that of a displacement that stays. "
    "Beyond the rows it is a guess: inertia "
    "that the table does not show is not in it."
)


@dataclass(frozen=True, eq=False)
class FittedLaw:
    """A law with states whose dynamic stiffness is that of a table at one speed: what :func:`whirl.fit_law` gives.

    The force on the journal is F = −D(s) e with D(s) = K₀ + C₀ s + Σ_j R_j s/(s + p_j), so that D(iω) = K(ω) + iω C(ω). Each
    real pole has one state in each direction, a conjugate pair has two.

    Attributes
    ----------
    name : str
        Of the law.
    text : str
        Its file, with comments on what it was made of and how well it fits.
    law : Law
        The same as a law, for ``"law"`` of a joint in a case.
    poles : numpy.ndarray
        p_j in 1/s, by size, shape ``(poles,)``; complex, with both of a pair, if there are pairs.
    error : float
        The largest error of all entries and rows, as a share (see :func:`whirl.fit_law`).
    errors : numpy.ndarray
        The largest error of each entry, shape ``(2, 2)``.
    speed_rpm : float or None
        At which the table was taken; None of a table that does not say.
    frequency_hz : numpy.ndarray
        Rows of the table, rising, shape ``(rows,)``.
    K, C : numpy.ndarray
        Coefficients of the table, in N/m and N·s/m, shape ``(rows, 2, 2)``.
    notes : tuple of str
        What limits the worth of the law, such as damping that is negative above the table.
    """

    name: str
    text: str
    law: Law
    poles: np.ndarray
    error: float
    errors: np.ndarray
    speed_rpm: float | None
    frequency_hz: np.ndarray
    K: np.ndarray
    C: np.ndarray
    notes: tuple[str, ...]
    _fit: Rational

    def __repr__(self) -> str:
        error = _percent(self.error)
        return f"<whirl.FittedLaw {self.name}: {_counted(self._fit)}, largest error {error}>"

    def stiffness(self, frequency_hz: Any) -> np.ndarray:
        """K of the law in N/m at frequencies in Hz, shape ``(..., 2, 2)``."""
        return self._fit(2j * np.pi * np.asarray(frequency_hz, dtype=np.float64)).real

    def damping(self, frequency_hz: Any) -> np.ndarray:
        """C of the law in N·s/m at frequencies in Hz, shape ``(..., 2, 2)``."""
        omega = 2.0 * np.pi * np.asarray(frequency_hz, dtype=np.float64)[..., None, None]
        still = omega == 0
        value = self._fit(1j * omega[..., 0, 0]).imag / np.where(still, 1.0, omega)
        return np.where(still, self._fit.slope(), value)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Writes the law file, for ``law = "seal.toml"`` of a joint; returns its path."""
        path = Path(path)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(self.text, encoding="utf-8", newline="\n")
        except OSError as error:
            raise WhirlError(f"cannot write the law to `{path}`: {error}") from error
        return path

    def plot(self, axes: Any = None) -> Any:
        """Stiffness and damping over the frequency, of the law as lines and of the table as points.

        Parameters
        ----------
        axes : sequence of two matplotlib.axes.Axes, optional
            For stiffness and damping; new ones are made if none are given.

        Returns
        -------
        numpy.ndarray of matplotlib.axes.Axes
        """
        return plot_fit(self, axes)


def fit_law(
    source: str | os.PathLike[str],
    *,
    speed: str | float | None = None,
    name: str | None = None,
    tolerance: float = 0.01,
    poles: int | None = None,
    pairs: bool = True,
) -> FittedLaw:
    """A law with states from a table of stiffness and damping over the frequency, such as that of a gas seal.

    A run has no frequency, so it takes no such table; it takes the law. D(s) = K₀ + C₀ s + Σ_j R_j s/(s + p_j) is fitted to
    K(ω) + iω C(ω), with poles that decay and are common to all entries, by vector fitting and least squares.

    An error is that of an entry of D over its size; an entry that is smaller than a tenth of the largest one at its frequency
    is measured by that tenth.

    Parameters
    ----------
    source : str or path
        A file with the columns ``frequency`` or ``frequency_ratio``, ``k_xx``, ``k_xy``, ``k_yx``, ``k_yy``, ``c_xx``,
        ``c_xy``, ``c_yx``, ``c_yy``, and ``speed`` if it has several, each with its unit; or the text of one (a str with a
        line break).
    speed : str or float, optional
        Such as ``"9000 rpm"``; numbers are in rpm. Between the speeds of a table coefficients are monotone cubics, as in
        analyses. A table of one speed needs none.
    name : str, optional
        Of the law; that of the file without its ending if none is given.
    tolerance : float, default 0.01
        The largest error as a share. The fewest poles are taken that keep it.
    poles : int, optional
        As many as that instead, both of a pair counting; an error beyond the tolerance is a :class:`WhirlWarning` then.
    pairs : bool, default True
        Whether conjugate pairs of poles are tried where real ones do not keep the tolerance.

    Returns
    -------
    FittedLaw

    Raises
    ------
    CaseError
        The table is wrong, with its lines.
    FitError
        No such fit keeps the tolerance, or what is asked does not go with the table.

    Examples
    --------
    >>> seal = whirl.fit_law("seal.csv", speed="9000 rpm")
    >>> seal.save("seal.toml")
    >>> case = whirl.Case({..., "joint": {"seal": {"kind": "bearing", "law": seal.law, ...}}})
    """
    _check(tolerance, poles, name)
    table = at_one_speed(source, speed)
    called = name or re.sub(r"[^A-Za-z0-9_.-]", "-", Path(table.file).stem)
    if not (np.abs(table.stiffness).any() or np.abs(table.damping).any()):
        raise FitError(f"all coefficients of `{table.file}` are zero: there is nothing to fit")
    samples = Samples(table.omega, table.stiffness, table.damping)
    if len(table.omega) == 1:
        fit = _constant(table, poles)
        errors = np.zeros((1, 2, 2))
    else:
        fit = printed(_searched(table, samples, tolerance, poles, pairs), samples)
        errors = samples.errors(fit)
    notes = _notes(table, fit)
    error = float(errors.max())
    if error > tolerance:
        notes.insert(
            0,
            f"the largest error, {_percent(error)}, is beyond {_percent(tolerance)}",
        )
    for note in notes:
        warnings.warn(f"law `{called}`: {note}", WhirlWarning, stacklevel=2)
    speed_rpm = None if table.speed is None else table.speed * 30.0 / np.pi
    text = law_text(
        fit,
        name=called,
        title=f"Joint with coefficients over the frequency, as a law with states: {_counted(fit)}",
        source=SOURCE.format(os.path.basename(table.file)),
        about=_about(table, fit, errors, speed_rpm, notes),
        speed=table.speed,
    )
    every = [*fit.poles, *fit.poles[fit.poles.imag > 0].conj()]
    own = np.array(sorted(every, key=lambda pole: (abs(pole), -pole.imag)), dtype=np.complex128)
    return FittedLaw(
        name=called,
        text=text,
        law=Law(text, name=called),
        poles=own if own.imag.any() else own.real,
        error=error,
        errors=errors.max(axis=0),
        speed_rpm=speed_rpm,
        frequency_hz=table.omega / (2.0 * np.pi),
        K=table.stiffness,
        C=table.damping,
        notes=tuple(notes),
        _fit=fit,
    )


def _check(tolerance: Any, poles: Any, name: Any) -> None:
    if not isinstance(tolerance, (int, float, np.number)) or not 0 < tolerance < 1:
        raise FitError(f"`tolerance` is a share between 0 and 1, such as 0.01, not {tolerance!r}")
    if poles is not None and (
        isinstance(poles, bool)
        or not isinstance(poles, (int, np.integer))
        or not 0 <= poles <= 2 * MOST_POLES
    ):
        raise FitError(f"`poles` is a whole number from 0 to {2 * MOST_POLES}, not {poles!r}")
    if name is not None and not (isinstance(name, str) and re.match(r"[A-Za-z0-9_.-]+\Z", name)):
        raise FitError(f"{name!r} is no name of a law: it has letters, digits, `-`, `_` and `.`")


def _constant(table: AtOneSpeed, poles: int | None) -> Rational:
    if poles:
        raise FitError(_too_few(table, poles))
    return Rational(
        table.stiffness[0], table.damping[0], np.zeros(0, dtype=np.complex128), np.zeros((0, 2, 2))
    )


def _too_few(table: AtOneSpeed, poles: int) -> str:
    rows = len(table.omega)
    return (
        f"a fit with {poles} pole{'s' if poles > 1 else ''} takes {poles + 1} frequencies at least, "
        f"and `{table.file}` has {rows} at this speed: ask for {rows - 1} or fewer, or add rows"
    )


def _searched(
    table: AtOneSpeed, samples: Samples, tolerance: float, poles: int | None, pairs: bool
) -> Rational:
    """The fit of so many poles, or of the fewest that keep the tolerance."""
    most = len(table.omega) - 1
    if poles is not None and poles > most:
        raise FitError(_too_few(table, poles))
    counts = range(min(most, MOST_POLES) + 1) if poles is None else [int(poles)]
    best: tuple[float, Rational] | None = None
    driven: Rational | None = None
    for kind in (False, True) if pairs else (False,):
        apart = True
        for count in counts:
            if kind and count < 2:
                continue
            before, apart = apart, False
            # A damper that drives fast motion is worse than none.
            for damper in (True, False):
                fit = fitted(samples, count, pairs=kind, damper=damper, tolerance=tolerance)
                if not believable(samples, fit):
                    break
                apart = True
                error = float(samples.errors(fit).max())
                if best is None or error < best[0]:
                    best = (error, fit)
                if damper and not _drives(fit.damper, table):
                    if error <= tolerance:
                        return fit
                    break
                if error <= tolerance:
                    if not damper:
                        return fit
                    driven = driven or fit
            # More poles of this kind fall upon each other, too.
            if not (before or apart):
                break
        if driven is not None:
            return driven
    if best is not None and poles is not None:
        return best[1]
    raise FitError(_beyond(table, samples, tolerance, best, counts, pairs))


def _drives(damping: np.ndarray, table: AtOneSpeed) -> bool:
    """Whether a damping, shape ``(..., 2, 2)``, is negative for some motion along a line."""
    least = np.linalg.eigvalsh(damping + np.swapaxes(damping, -1, -2)).min()
    size = np.abs(table.damping).max() + np.abs(table.stiffness).max() / table.omega[-1]
    return bool(least < -1e-6 * size)


def _beyond(table, samples, tolerance, best, counts, pairs) -> str:
    where = f"`{table.file}`" + (
        "" if table.speed is None else f" at {table.speed * 30 / np.pi:.6g} rpm"
    )
    for count in counts:
        if count and len(growing := grows(samples, count, tolerance)):
            shown = ", ".join(f"{own.real:.4g}" for own in growing)
            return (
                f"the coefficients of {where} are those of a joint whose own states grow "
                f"(p = {shown} 1/s): look at the signs of the damping; a stiffness that rises with the "
                "frequency goes with a damping that falls"
            )
    most = counts[-1]
    error = (
        "no fit is sound"
        if best is None
        else f"the best with up to {most} poles is off by {_percent(best[0])}"
    )
    help = "allow more by `tolerance`, take the number of poles by `poles`, or smooth the rows"
    if most < MOST_POLES and len(counts) > 1:
        help = f"add rows, as {most + 1} allow {most} poles at most, or allow more by `tolerance`"
    elif not pairs:
        help = f"allow resonances by pairs=True, or {help}"
    return f"no law keeps {_percent(tolerance)} of {where}: {error}; {help}"


def _notes(table: AtOneSpeed, fit: Rational) -> list[str]:
    notes = []
    above = table.omega[-1] * np.geomspace(1.0, 1e3, 61)
    if len(table.omega) == 1:
        notes.append(
            "the table has one frequency at this speed: the coefficients are constant, and the law "
            "has no states"
        )
    elif _drives(fit(1j * above).imag / above[:, None, None], table):
        notes.append(
            "above the rows its damping becomes negative: modes there may grow in a run; add rows of "
            "higher frequencies"
        )
    if len(fit.poles) and table.omega[0] > 0:
        off = np.abs(fit.static - table.stiffness[0]).max() / np.abs(table.stiffness[0]).max(
            initial=1e-300
        )
        if off > 0.1:
            notes.append(
                f"its stiffness at rest is extrapolated, {_percent(off)} from that of the lowest row: "
                "where a static load counts, add a row of 0 Hz"
            )
    return notes


def _about(
    table: AtOneSpeed, fit: Rational, errors: np.ndarray, speed_rpm: float | None, notes: list[str]
) -> list[str]:
    """Lines of the comment."""
    hertz = table.omega / (2.0 * np.pi)
    at = "" if speed_rpm is None else f" at {speed_rpm:.6g} rpm"
    if table.between is not None:
        ends = " and ".join(f"{own * 30 / np.pi:.6g}" for own in table.between)
        at += f" (between its rows of {ends} rpm)"
    rows = (
        f"{len(hertz)} rows from {hertz[0]:.6g} to {hertz[-1]:.6g} Hz"
        if len(hertz) > 1
        else f"one row, of {hertz[0]:.6g} Hz"
    )
    lines = [
        f"{EQUATION} {_toml._text(os.path.basename(table.file))}{at}, {rows}.",
        LIMITS,
        "Largest errors of K + i w C, as shares of the entry, or of a tenth of the largest if it is less:",
    ]
    for place, entry in enumerate(ENTRIES):
        own = errors.reshape(len(errors), 4)[:, place]
        worst = int(np.argmax(own))
        lines.append(f"   {entry}  {_percent(own[worst])} at {hertz[worst]:.6g} Hz")
    if len(fit.poles):
        fastest = np.abs(fit.poles).max()
        lines.append(
            f"Keep the steps of a run well below {2e3 / fastest:.3g} ms, twice its fastest time constant."
        )
    return lines + [f"Note: {own}." for own in notes]


def _counted(fit: Rational) -> str:
    pairs = int((fit.poles.imag > 0).sum())
    count = fit.count
    text = "no poles" if count == 0 else f"{count} pole{'s' if count > 1 else ''}"
    return text + (f", {2 * pairs} of them in pairs" if pairs else "")


def _percent(share: float) -> str:
    return f"{100.0 * share:.2g} %" if share >= 1e-5 else "below 0.001 %"
