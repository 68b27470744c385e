"""Figures of results, with matplotlib, which is imported only where one is drawn."""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape
from typing import Any

import numpy as np

from .errors import extra
from .history import History, _absent

__all__ = ["Plots"]


class Plots:
    """What draws the results of a run. Each method returns the axes, so that figures can be changed and put together.

    Displacements are those of the history, in µm; x is up and y to the right, so that positive rotation is clockwise.
    """

    history: History
    name: str
    title: str
    summary: Any
    verdict: Any

    def plot_history(self, columns: str | Iterable[str], axes: Any = None) -> Any:
        """Columns over time.

        Parameters
        ----------
        columns : str or sequence of str
            Their names; all have one unit.
        axes : matplotlib.axes.Axes, optional
            New ones are made if none are given.

        Returns
        -------
        matplotlib.axes.Axes
        """
        names = [columns] if isinstance(columns, str) else list(columns)
        units = {self.history.unit(name) for name in names}
        if len(units) != 1:
            raise ValueError(
                f"columns of one axis have one unit, not {', '.join(sorted(units)) or 'none'}"
            )
        axes = _axes(axes, "Results.plot_history()")
        for name in names:
            axes.plot(self.history.time, self.history[name], label=name, linewidth=1.0)
        return _labelled(axes, "time (s)", f"({_shown(units.pop())})", self.name)

    def plot_orbit(
        self, joint: str | int | None = None, revolutions: float = 2.0, axes: Any = None
    ) -> Any:
        """The way of a journal in its bore over the last revolutions, with the clearance circle.

        Parameters
        ----------
        joint : str or int, optional
            Name of a joint, or number of a support; the first one, if left out.
        revolutions : float
            Of the first body that turns; the last cycle is shown where nothing turns.
        axes : matplotlib.axes.Axes, optional
            New ones are made if none are given.

        Returns
        -------
        matplotlib.axes.Axes
        """
        place, label = self._joint(joint)
        if not (np.isfinite(revolutions) and revolutions > 0.0):
            raise ValueError(f"revolutions is a number above zero, not {revolutions!r}")
        self._kept(2)
        rows = self._last(revolutions)
        x, y = (self.history[f"E{axis}{label}_um"][rows] for axis in "XY")
        axes = _axes(axes, "Results.plot_orbit()")
        axes.plot(y, x, linewidth=1.0, label="centre of the journal")
        clearance = self.summary["supports"][place]["clearance_um"]
        if clearance > 0:
            turn = np.linspace(0.0, 2.0 * np.pi, 181)
            circle = (clearance * np.cos(turn), clearance * np.sin(turn))
            axes.plot(*circle, linestyle=":", color="0.4", linewidth=1.0, label="radial clearance")
        # Of one body that turns it is known whose revolutions these are.
        if not any(re.fullmatch(r"theta_.+_rad", name) for name in self.history):
            seen = _passages(self.history["theta_rad"][rows], x, y)
            if seen:
                axes.plot(seen[1], seen[0], "o", markersize=4, label="keyphasor, θ = 0°")
        axes.set_aspect("equal", adjustable="datalim")
        title = f"{self.name}: {label.lstrip('_')}"
        return _labelled(axes, "y, lateral (µm)", "x, vertical (µm)", title)

    def plot_spectrum(
        self, joint: str | int | None = None, cycles: int = 16, axes: Any = None
    ) -> Any:
        """The two-sided spectrum of the displacement of a journal over the last cycles, Hann window.

        The motion is taken as circles, x + iy: one that runs from x to y has its radius at its frequency, and one against it
        at minus that. What moves along a line has half of its amplitude at both.

        Parameters
        ----------
        joint : str or int, optional
            Name of a joint, or number of a support; the first one, if left out.
        cycles : int
            Cycles of the summary, at most as many as half of the run has.
        axes : matplotlib.axes.Axes, optional
            New ones are made if none are given.

        Returns
        -------
        matplotlib.axes.Axes
        """
        _, label = self._joint(joint)
        if isinstance(cycles, bool) or cycles != int(cycles) or cycles < 1:
            raise ValueError(f"cycles is a whole number from 1 on, not {cycles!r}")
        self._kept(16)
        frequency, amplitude = self._spectrum(label, cycles)
        worth = np.abs(frequency[amplitude >= 0.005 * amplitude.max(initial=0.0)])
        axes = _axes(axes, "Results.plot_spectrum()")
        axes.plot(frequency, amplitude, linewidth=1.0, label="displacement, zero to peak")
        end = 1.1 * max(worth.max(initial=0.0), 3.0 * abs(self._turning_hz(len(amplitude))))
        if end > 0:
            axes.set_xlim(-end, end)
        axes.set_ylim(bottom=0.0)
        title = f"{self.name}: {label.lstrip('_')}"
        return _labelled(
            axes, "frequency (Hz), backward < 0 < forward", "displacement, 0-pk (µm)", title
        )

    def _spectrum(self, label: str, cycles: int) -> tuple[np.ndarray, np.ndarray]:
        """Frequencies (Hz), rising, and amplitudes (µm)."""
        time = self.history.time
        step = (time[-1] - time[0]) / max(len(time) - 1, 1)
        cycle = self.summary["cycle_s"]
        whole = min(max(int(0.5 * (time[-1] - time[0]) / cycle), 1), cycles)
        rows = min(max(round(whole * cycle / step), 2), len(time))
        z = self.history[f"X{label}_um"][-rows:] + 1j * self.history[f"Y{label}_um"][-rows:]
        window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(rows) / rows)
        mean = (window * z).sum() / window.sum()
        padded = rows * max(8192 // rows, 1)
        amplitude = np.abs(np.fft.fftshift(np.fft.fft(window * (z - mean), padded))) / window.sum()
        return np.fft.fftshift(np.fft.fftfreq(padded, step)), amplitude

    def _turning_hz(self, rows: int) -> float:
        time, angle = self.history.time, self.history["theta_rad"]
        rows = min(rows, len(time))
        span = time[-1] - time[-rows]
        return float((angle[-1] - angle[-rows]) / span / (2.0 * np.pi)) if span > 0 else 0.0

    def _last(self, revolutions: float) -> slice:
        """Rows of the last revolutions; of the last cycle where nothing turns."""
        angle, time = self.history["theta_rad"], self.history.time
        if abs(angle[-1] - angle[0]) > np.pi:
            there = np.abs(angle[-1] - angle) <= 2.0 * np.pi * revolutions * (1.0 + 1e-9)
        else:
            there = time[-1] - time <= self.summary["cycle_s"] * (1.0 + 1e-9)
        return slice(int(np.argmax(there)), None)

    def _kept(self, rows: int) -> None:
        found = len(self.history.time)
        if found < rows:
            why = "histories of this point were not kept" if found == 0 else f"the history has {found} rows"
            raise ValueError(f"{why}: this figure takes {rows} or more")

    def _joint(self, joint: str | int | None) -> tuple[int, str]:
        """The place of a joint, and what its columns are called by."""
        found = [match[1] for name in self.history if (match := re.fullmatch(r"EX(.*)_um", name))]
        known = [label.removeprefix("_") for label in found]
        if not known:
            raise KeyError("there is no joint")
        if joint is None:
            return 0, found[0]
        if str(joint) not in known:
            raise KeyError(_absent("joint", joint, known))
        place = known.index(str(joint))
        return place, found[place]

    def _repr_html_(self) -> str:
        verdict = self.verdict
        colour = "#1a7f37" if verdict.sound else "#b42318"
        words = "sound" if verdict.sound else "NOT SOUND, do not use these results"
        findings = "".join(f"<li>{escape(str(own))}</li>" for own in verdict.findings)
        span = f"{self.history.time[-1]:g} s, " if len(self.history.array) else ""
        return (
            f"<div><b>{escape(self.name)}</b>: {escape(self.title)}<br>"
            f'<span style="color: {colour}; font-weight: bold">{words}</span>'
            f"{f'<ul>{findings}</ul>' if findings else '<br>'}"
            f"{span}{len(self.history.array)} rows, {len(self.history.columns)} columns"
            f"{self._picture()}</div>"
        )

    def _picture(self) -> str:
        """The orbits as SVG, small; nothing where there are none."""
        if not len(self.history.array):
            return ""
        try:
            _, label = self._joint(None)
        except KeyError:
            return ""
        rows = self._last(2.0)
        labels = [match[1] for name in self.history if (match := re.fullmatch(r"EX(.*)_um", name))]
        clearances = [own["clearance_um"] for own in self.summary["supports"]]
        pictures = []
        for label, clearance in list(zip(labels, clearances))[:4]:
            x, y = (self.history[f"E{axis}{label}_um"][rows] for axis in "XY")
            size = max(
                clearance, float(np.abs(x).max(initial=0.0)), float(np.abs(y).max(initial=0.0))
            )
            if not size > 0.0:
                continue
            every = max(len(x) // 400, 1)
            points = " ".join(
                f"{60 + 52 * b / size:.1f},{60 - 52 * a / size:.1f}"
                for a, b in zip(x[::every], y[::every])
            )
            circle = (
                f'<circle cx="60" cy="60" r="{52 * clearance / size:.1f}" fill="none" stroke="#888" stroke-dasharray="2 3"/>'
                if clearance > 0
                else ""
            )
            pictures.append(
                f'<svg width="120" height="134" role="img" aria-label="orbit">{circle}'
                f'<polyline points="{points}" fill="none" stroke="#0072b2"/>'
                f'<text x="60" y="130" text-anchor="middle" font-size="11" fill="currentColor">'
                f"{escape(label.removeprefix('_'))}</text></svg>"
            )
        return f"<br>{''.join(pictures)}" if pictures else ""


def plot_campbell(found: Any, axes: Any) -> Any:
    """Natural frequencies over speed, with orders, critical speeds and thresholds."""
    axes = _axes(axes, "Campbell.plot()")
    speed = found.speed_rpm
    for branch, frequency in enumerate(found.frequency_hz):
        axes.plot(speed, frequency, linewidth=1.3, label=f"mode {branch + 1}")
    top = np.nanmax(found.frequency_hz, initial=0.0)
    for order in sorted({1.0, *found.criticals.order.tolist()}):
        axes.plot(speed, order * speed / 60.0, linestyle=":", color="0.4", linewidth=1.0)
        end = min(speed[-1], 60.0 * 1.05 * top / order)
        axes.annotate(f"{order:g}X", (end, order * end / 60.0), fontsize="small", color="0.3")
    marked = found.criticals
    if len(marked):
        axes.plot(marked.speed_rpm, marked.frequency_hz, "o", markersize=5, label="critical speed")
    for at in found.thresholds.speed_rpm:
        axes.axvline(at, linestyle="--", color="tab:red", linewidth=1.0)
    axes.set_ylim(0.0, 1.1 * top if top > 0 else 1.0)
    return _labelled(axes, "speed (rpm)", "frequency (Hz)", found.name)


def plot_response(found: Any, point: str | None, axes: Any) -> Any:
    """Amplitude and phase over speed of what an order excites."""
    points = found.points if point is None else (point,)
    for own in points:
        if own not in found.points:
            raise KeyError(_absent("point", own, found.points))
    if axes is None:
        pyplot = extra("plots", "matplotlib.pyplot", "Excited.plot()")
        _, axes = pyplot.subplots(2, 1, sharex=True, layout="constrained", figsize=(6.4, 6.0))
    upper, lower = np.asarray(axes, dtype=object).ravel()
    for own in points:
        place = found.points.index(own)
        for axis, size, phase in (
            ("x", found.x_um, found.x_phase_deg),
            ("y", found.y_um, found.y_phase_deg),
        ):
            upper.plot(found.speed_rpm, size[place], linewidth=1.2, label=f"{own} {axis}")
            turned = np.degrees(np.unwrap(np.radians(phase[place])))
            lower.plot(found.speed_rpm, turned, linewidth=1.2, label=f"{own} {axis}")
    _labelled(upper, "", "displacement, 0-pk (µm)", f"{found.body}, {found.order:g}X")
    lower.set_xlabel("speed (rpm)")
    lower.set_ylabel("phase (°)")
    lower.grid(True, alpha=0.3)
    return np.array([upper, lower], dtype=object)


def plot_fit(found: Any, axes: Any) -> Any:
    """Stiffness and damping over the frequency, of a fitted law as lines and of its table as points."""
    if axes is None:
        pyplot = extra("plots", "matplotlib.pyplot", "FittedLaw.plot()")
        _, axes = pyplot.subplots(2, 1, sharex=True, layout="constrained", figsize=(6.4, 6.0))
    upper, lower = np.asarray(axes, dtype=object).ravel()
    rows = found.frequency_hz
    frequency = np.linspace(0.0, 1.1 * rows[-1] if rows[-1] > 0 else 100.0, 401)
    for letter, own, table, values in (
        ("k", upper, found.K, found.stiffness(frequency)),
        ("c", lower, found.C, found.damping(frequency)),
    ):
        for row, column in np.ndindex(2, 2):
            label = f"{letter}_{'xy'[row]}{'xy'[column]}"
            (line,) = own.plot(frequency, values[:, row, column], linewidth=1.3, label=label)
            own.plot(rows, table[:, row, column], "o", markersize=4, color=line.get_color())
    at = "" if found.speed_rpm is None else f", {found.speed_rpm:.6g} rpm"
    _labelled(
        upper, "", "stiffness (N/m)", f"{found.name}{at}: points of the table, lines of the law"
    )
    _labelled(lower, "frequency (Hz)", "damping (N·s/m)", "")
    return np.array([upper, lower], dtype=object)


def _axes(axes: Any, what: str) -> Any:
    if axes is not None:
        return axes
    pyplot = extra("plots", "matplotlib.pyplot", what)
    return pyplot.subplots(layout="constrained")[1]


def _labelled(axes: Any, x: str, y: str, title: str) -> Any:
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.set_title(title)
    axes.grid(True, alpha=0.3)
    axes.legend(fontsize="small")
    return axes


def _passages(
    angle: np.ndarray, x: np.ndarray, y: np.ndarray
) -> tuple[np.ndarray, np.ndarray] | None:
    """x and y where the angle passes whole revolutions."""
    turn = angle * np.sign(angle[-1] - angle[0]) / (2.0 * np.pi)
    whole = np.arange(np.ceil(turn[0]), np.floor(turn[-1]) + 1.0)
    if not len(whole) or np.any(np.diff(turn) <= 0):
        return None
    return np.interp(whole, turn, x), np.interp(whole, turn, y)


def _shown(unit: str) -> str:
    return {"um": "µm", "N*m": "N·m", "m/s^2": "m/s²"}.get(unit, unit)
