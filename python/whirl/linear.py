"""Linear analyses: modes, critical speeds, responses, stability, coefficients and matrices of small motions."""

from __future__ import annotations

import csv
import io
import os
import warnings
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .bodies import Bodies, shared_bodies
from .errors import WhirlError, WhirlWarning
from .history import _absent
from .plots import plot_campbell, plot_response

__all__ = [
    "Analyses",
    "Analysis",
    "Campbell",
    "Coefficients",
    "Criticals",
    "Excited",
    "JointCoefficients",
    "Matrices",
    "Modes",
    "Response",
    "Stability",
    "Table",
    "Thresholds",
]

Speeds = str | float | Iterable[str | float] | None

_TEXTS = {
    *("beside_hz", "body", "clause", "excitation", "half_power", "joint", "motion", "name", "of", "pass"),
    *("place", "point", "quantity", "unbalance", "unit", "variant", "what", "whirl"),
    "within_margin",
}
_COUNTS = {"mode", "number"}


class Table(Mapping[str, np.ndarray]):
    """A table of an analysis: a mapping from names of columns to arrays of shape ``(rows,)``.

    Names and numbers are those of the file that the command writes, to the bit. Texts are arrays of str; a cell without a number
    is NaN.
    """

    __slots__ = ("_columns",)

    def __init__(self, columns: Mapping[str, np.ndarray]):
        self._columns = dict(columns)
        for own in self._columns.values():
            own.flags.writeable = False

    @classmethod
    def _of(cls, text: str) -> Table:
        head, *rows = csv.reader(io.StringIO(text))
        cells = list(zip(*rows)) if rows else [()] * len(head)
        return cls({name: _column(name, own) for name, own in zip(head, cells)})

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(_absent("column", name, self._columns)) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(next(iter(self._columns.values()), ()))

    def where(self, rows: np.ndarray) -> Table:
        """The rows for which ``rows`` is true."""
        return Table({name: own[rows] for name, own in self._columns.items()})

    def __repr__(self) -> str:
        return f"<whirl.Table of {self.rows} rows: {', '.join(self)}>"

    def __reduce__(self):
        return Table, (self._columns,)

    def to_pandas(self) -> Any:
        """The table as a :class:`pandas.DataFrame`."""
        from .errors import extra

        pandas = extra("pandas", "pandas", "Table.to_pandas()")
        return pandas.DataFrame({name: own.copy() for name, own in self._columns.items()})


def _column(name: str, cells: Iterable[str]) -> np.ndarray:
    cells = list(cells)
    if name in _TEXTS:
        return np.array(cells, dtype=np.str_)
    if name == "stable":
        return np.array([own == "true" for own in cells], dtype=np.bool_)
    if name in _COUNTS and all(cells):
        return np.array([int(own) for own in cells], dtype=np.int64)
    try:
        return np.array([float(own) if own else np.nan for own in cells], dtype=np.float64)
    except ValueError:
        return np.array(cells, dtype=np.str_)


class Analysis:
    """What a linear analysis comes to.

    Attributes
    ----------
    name, kind : str
        Of the analysis.
    text : str
        What the command prints.
    notes : tuple of str
        What limits the worth of the numbers, such as modes near the end of a body's reduction, or speeds that were left out.
    tables : dict of str to Table
        The tables of the command by the names of their files, without ``.csv``.
    """

    def __init__(self, name: str, kind: str, text: str, notes: Iterable[str], files):
        self.name = name
        self.kind = kind
        self.text = text
        self.notes = tuple(notes)
        self._files: dict[str, bytes] = dict(files)
        self.tables = {
            file.removesuffix(".csv"): Table._of(content.decode("utf-8"))
            for file, content in self._files.items()
            if file.endswith(".csv")
        }

    @staticmethod
    def _of(own) -> Analysis:
        for warning in own.warnings:
            warnings.warn(warning, WhirlWarning, stacklevel=4)
        kind = _KINDS.get(own.kind, Analysis)
        return kind(own.name, own.kind, own.text, own.notes, own.files)

    def __reduce__(self):
        return type(self), (self.name, self.kind, self.text, self.notes, self._files)

    def __repr__(self) -> str:
        return f"<whirl.{type(self).__name__} `{self.name}`>"

    def __str__(self) -> str:
        return self.text

    @property
    def table(self) -> Table:
        """The table that has the name of the analysis."""
        return self.tables[self.name]

    def save(self, folder: str | os.PathLike[str]) -> Path:
        """Writes the files of the command, without figures and page, into a folder, which is made where it is missing."""
        folder = Path(folder)
        try:
            folder.mkdir(parents=True, exist_ok=True)
            for file, content in self._files.items():
                (folder / file).write_bytes(content)
        except OSError as error:
            raise WhirlError(f"cannot write to `{folder}`: {error}") from error
        return folder


class Modes(Analysis):
    """Modes at one speed or a few, a row each, the slowest first.

    Attributes
    ----------
    speed_rpm, frequency_hz, damping_ratio, log_decrement, sense : numpy.ndarray
        Shape ``(rows,)``; ``sense`` is 1 for circles from x to y, −1 for the other way.
    eigenvalue : numpy.ndarray
        λ in 1/s, complex, shape ``(rows,)``.
    whirl : numpy.ndarray
        ``forward``, ``backward`` or ``-``, shape ``(rows,)``.
    """

    def __init__(self, *own):
        super().__init__(*own)
        table = self.table
        self.speed_rpm = table["speed_rpm"]
        self.frequency_hz = table["frequency_hz"]
        self.damping_ratio = table["damping_ratio"]
        self.log_decrement = table["log_decrement"]
        self.sense = table["sense"]
        self.whirl = table["whirl"]
        self.eigenvalue = _eigenvalue(table)


@dataclass(frozen=True)
class Criticals:
    """Critical speeds, an entry each: by order, then by speed.

    Attributes
    ----------
    speed_rpm, order, frequency_hz, damping_ratio, log_decrement : numpy.ndarray
        Shape ``(speeds,)``.
    branch : numpy.ndarray
        Which branch of the diagram it is on, from 0, shape ``(speeds,)``.
    whirl : numpy.ndarray
        ``forward``, ``backward`` or ``-``, shape ``(speeds,)``.
    """

    speed_rpm: np.ndarray
    order: np.ndarray
    branch: np.ndarray
    frequency_hz: np.ndarray
    damping_ratio: np.ndarray
    log_decrement: np.ndarray
    whirl: np.ndarray

    def __len__(self) -> int:
        return len(self.speed_rpm)


@dataclass(frozen=True)
class Thresholds:
    """Speeds above which a motion grows, or no longer does, by speed.

    Attributes
    ----------
    speed_rpm, frequency_hz : numpy.ndarray
        Shape ``(speeds,)``; NaN is the frequency of a motion that does not oscillate.
    unstable_above : numpy.ndarray
        Whether it grows above, shape ``(speeds,)``.
    whirl : numpy.ndarray
        ``forward``, ``backward`` or ``-``, shape ``(speeds,)``; empty without an oscillation.
    """

    speed_rpm: np.ndarray
    frequency_hz: np.ndarray
    unstable_above: np.ndarray
    whirl: np.ndarray

    @classmethod
    def _of(cls, table: Table) -> Thresholds:
        above = np.isin(table["what"], ["unstable above", "one more grows above"])
        return cls(table["speed_rpm"], table["frequency_hz"], above, table["whirl"])

    def __len__(self) -> int:
        return len(self.speed_rpm)


class Campbell(Analysis):
    """Modes followed over the speed.

    Attributes
    ----------
    speed_rpm : numpy.ndarray
        Shape ``(speeds,)``.
    frequency_hz, damping_ratio, log_decrement, sense : numpy.ndarray
        Shape ``(branches, speeds)``; NaN where a mode is not among those that were listed.
    eigenvalue : numpy.ndarray
        λ in 1/s, complex, shape ``(branches, speeds)``.
    whirl : numpy.ndarray
        ``forward``, ``backward`` or ``-``, shape ``(branches, speeds)``; empty where there is no mode.
    criticals : Criticals
        Critical speeds.
    thresholds : Thresholds
        Where modes begin to grow, or end to.
    """

    def __init__(self, *own):
        super().__init__(*own)
        table = self.table
        self.speed_rpm, place = np.unique(table["speed_rpm"], return_inverse=True)
        branch = table["branch"].astype(np.int64) - 1
        shape = (int(branch.max(initial=-1)) + 1, len(self.speed_rpm))

        def spread(values: np.ndarray, missing: Any) -> np.ndarray:
            whole = np.full(shape, missing, dtype=values.dtype)
            whole[branch, place] = values
            whole.flags.writeable = False
            return whole

        self.frequency_hz = spread(table["frequency_hz"], np.nan)
        self.damping_ratio = spread(table["damping_ratio"], np.nan)
        self.log_decrement = spread(table["log_decrement"], np.nan)
        self.sense = spread(table["sense"], np.nan)
        self.eigenvalue = spread(_eigenvalue(table), np.nan)
        self.whirl = spread(table["whirl"], "")
        marked = self.tables[f"{self.name}.critical"]
        is_critical = marked["what"] == "critical speed"
        found = marked.where(is_critical)
        self.criticals = Criticals(
            found["speed_rpm"],
            found["order"],
            found["branch"].astype(np.int64) - 1,
            found["frequency_hz"],
            found["damping_ratio"],
            found["log_decrement"],
            found["whirl"],
        )
        self.thresholds = Thresholds._of(marked.where(~is_critical))

    def plot(self, axes: Any = None) -> Any:
        """Natural frequencies over speed, with orders, critical speeds and, dashed, where stability ends or begins.

        Parameters
        ----------
        axes : matplotlib.axes.Axes, optional
            New ones are made if none are given.

        Returns
        -------
        matplotlib.axes.Axes
        """
        return plot_campbell(self, axes)


class Stability(Analysis):
    """The least stable mode over the speed.

    Attributes
    ----------
    speed_rpm, least_log_decrement, frequency_hz : numpy.ndarray
        Shape ``(speeds,)``.
    stable : numpy.ndarray
        Whether nothing grows, shape ``(speeds,)``.
    whirl : numpy.ndarray
        ``forward``, ``backward`` or ``-``, shape ``(speeds,)``.
    thresholds : Thresholds
        Where modes begin to grow, or end to.
    """

    def __init__(self, *own):
        super().__init__(*own)
        table = self.table
        self.speed_rpm = table["speed_rpm"]
        self.stable = table["stable"]
        self.least_log_decrement = table["least_log_decrement"]
        self.frequency_hz = table["frequency_hz"]
        self.whirl = table["whirl"]
        self.thresholds = Thresholds._of(self.tables[f"{self.name}.thresholds"])


@dataclass(frozen=True)
class Excited:
    """What an order of the rotation of a body excites.

    Attributes
    ----------
    body : str
        The body.
    order : float
        The order; 0 is the mean position.
    points : tuple of str
        The points, such as ``joint.left``.
    speed_rpm : numpy.ndarray
        Shape ``(speeds,)``.
    major_um, minor_um : numpy.ndarray
        Semi-axes of the orbits, zero to peak, shape ``(points, speeds)``; minor ones are negative from y to x.
    x_um, x_phase_deg, y_um, y_phase_deg : numpy.ndarray
        Amplitude and phase along x and y, shape ``(points, speeds)``: Re(w e^{inΩt}).
    peaks : Table
        ``point``, ``speed_rpm``, ``major_um``, ``amplification_factor``, ``half_power_below_rpm``, ``half_power_above_rpm``,
        ``half_power`` (``both``, ``below``, ``above`` or ``undamped``).
    """

    body: str
    order: float
    points: tuple[str, ...]
    speed_rpm: np.ndarray
    major_um: np.ndarray
    minor_um: np.ndarray
    x_um: np.ndarray
    x_phase_deg: np.ndarray
    y_um: np.ndarray
    y_phase_deg: np.ndarray
    peaks: Table

    def plot(self, point: str | None = None, axes: Any = None) -> Any:
        """Amplitude and phase over speed.

        Parameters
        ----------
        point : str, optional
            One of ``points``; all of them, if left out.
        axes : two of matplotlib.axes.Axes, optional
            New ones are made if none are given.

        Returns
        -------
        numpy.ndarray of matplotlib.axes.Axes
        """
        return plot_response(self, point, axes)

    def orbit(self, point: str, speed: int, angles: int = 181) -> np.ndarray:
        """The orbit of a point at the speed with this place: x and y in µm over a turn, shape ``(2, angles)``."""
        if point not in self.points:
            raise KeyError(_absent("point", point, self.points))
        place = self.points.index(point)
        turn = np.linspace(0.0, 2.0 * np.pi, angles)
        return np.stack(
            [
                size[place, speed] * np.cos(turn + np.radians(phase[place, speed]))
                for size, phase in ((self.x_um, self.x_phase_deg), (self.y_um, self.y_phase_deg))
            ]
        )


class Response(Analysis):
    """The response to what turns with the bodies.

    Attributes
    ----------
    excited : tuple of Excited
        One for each body and order; ``response["rotor"]`` is what the order 1 of that body excites, and ``response["rotor", 2]``
        the order 2.
    """

    def __init__(self, *own):
        super().__init__(*own)
        table, peaks = self.table, self.tables[f"{self.name}.peaks"]
        pairs = dict.fromkeys(zip(table["body"].tolist(), table["order"].tolist()))
        self.excited = tuple(_excited(table, peaks, *pair) for pair in pairs)

    def __getitem__(self, what: str | tuple[str, float]) -> Excited:
        body, order = (what, 1.0) if isinstance(what, str) else what
        for own in self.excited:
            if (own.body, own.order) == (body, order):
                return own
        known = [f"{own.body}, order {own.order:g}" for own in self.excited]
        raise KeyError(_absent("response", f"{body}, order {order:g}", known))


def _excited(table: Table, peaks: Table, body: str, order: float) -> Excited:
    own = table.where((table["body"] == body) & (table["order"] == order))
    peaked = peaks.where((peaks["body"] == body) & (peaks["order"] == order))
    points = tuple(dict.fromkeys(own["point"].tolist()))
    speeds = own["speed_rpm"][:: len(points)]

    def spread(name: str) -> np.ndarray:
        return own[name].reshape(len(speeds), len(points)).T

    names = ("major_um", "minor_um", "x_um", "x_phase_deg", "y_um", "y_phase_deg")
    return Excited(body, order, points, speeds, *map(spread, names), peaked)


@dataclass(frozen=True)
class JointCoefficients:
    """Stiffness and damping of a joint over the speed.

    Attributes
    ----------
    speed_rpm : numpy.ndarray
        Shape ``(speeds,)``.
    K, C : numpy.ndarray
        −∂F/∂e in N/m and −∂F/∂ė in N·s/m, shape ``(speeds, 2, 2)``: row the force along x or y, column the motion.
    displacement_um, force_N : numpy.ndarray
        Where the journal stands in its bore, and the force on it, shape ``(speeds, 2)``.
    eccentricity_ratio, attitude_deg : numpy.ndarray
        Shape ``(speeds,)``; NaN without a clearance.
    """

    speed_rpm: np.ndarray
    K: np.ndarray
    C: np.ndarray
    displacement_um: np.ndarray
    force_N: np.ndarray
    eccentricity_ratio: np.ndarray
    attitude_deg: np.ndarray


class Coefficients(Analysis):
    """Stiffness and damping of the joints.

    Attributes
    ----------
    joints : dict of str to JointCoefficients
        By the names of the joints.
    """

    def __init__(self, *own):
        super().__init__(*own)
        table = self.table
        names = dict.fromkeys(table["joint"].tolist())
        self.joints = {
            name: _of_joint(table.where(table["joint"] == name)) for name in names
        }

    def __getitem__(self, joint: str) -> JointCoefficients:
        try:
            return self.joints[joint]
        except KeyError:
            raise KeyError(_absent("joint", joint, self.joints)) from None


def _of_joint(own: Table) -> JointCoefficients:
    axes = ("xx", "xy", "yx", "yy")

    def square(letter: str, unit: str) -> np.ndarray:
        columns = [own[f"{letter}_{axis}_{unit}"] for axis in axes]
        return np.stack(columns, axis=-1).reshape(-1, 2, 2)

    return JointCoefficients(
        own["speed_rpm"],
        square("k", "N_m"),
        square("c", "Ns_m"),
        np.stack([own["e_x_um"], own["e_y_um"]], axis=-1),
        np.stack([own["force_x_N"], own["force_y_N"]], axis=-1),
        own["eccentricity_ratio"],
        own["attitude_deg"],
    )


class Matrices(Analysis):
    """The equations of small motions at a speed: M z̈ + C ż + K z = F u, y = R z, and ẋ = A x + B u, y = C x + D u.

    Attributes
    ----------
    mass, damping, stiffness : numpy.ndarray
        M, C, K in SI, shape ``(coordinates, coordinates)``.
    input, output : numpy.ndarray
        F, shape ``(coordinates, inputs)``, and R, shape ``(outputs, coordinates)``.
    A, B, C, D : numpy.ndarray
        Of the states x = (z, ż).
    coordinates, states, inputs, outputs : tuple of str
        What rows and columns are.
    speeds : dict of str to float
        Speeds of the bodies that turn, rad/s.
    """

    def __init__(self, *own):
        super().__init__(*own)
        archives = [file for file in self._files if file.endswith(".npz")]
        if len(archives) != 1:
            raise WhirlError("matrices are given at one speed: ask for each of several by itself")
        with np.load(io.BytesIO(self._files[archives[0]])) as read:
            for name in (
                *("mass", "damping", "stiffness", "input", "output"),
                *("A", "B", "C", "D"),
            ):
                setattr(self, name, read[name])
            for name in ("coordinates", "states", "inputs", "outputs"):
                setattr(self, name, tuple(read[name].tolist()))
            self.speeds = dict(zip(read["bodies"].tolist(), read["speeds"].tolist()))


def _eigenvalue(table: Table) -> np.ndarray:
    value = np.empty(table.rows, dtype=np.complex128)
    value.real, value.imag = table["real_1_s"], table["imaginary_1_s"]
    return value


_KINDS: dict[str, type[Analysis]] = {
    "modes": Modes,
    "campbell": Campbell,
    "stability": Stability,
    "response": Response,
    "coefficients": Coefficients,
    "matrices": Matrices,
}


class Analyses:
    """Linear analyses of a case, which need no ``[march]``. Nothing is written, and the numbers are those of the command, to the
    bit.

    Speeds are a text, as the command takes it (``"3000 rpm"``, ``"0 rpm .. 30000 rpm, 61"``), a number or several in rpm, or
    None for those that the command has by itself. Tables have them once each and in rising order, however they were given. Other threads of Python run meanwhile. A KeyboardInterrupt ends an analysis.
    """

    _inner: Any

    def analyse(self, name: str, *, bodies: Bodies | None = None) -> Analysis:
        """The analysis of a table ``[analysis.NAME]`` of the case.

        Returns
        -------
        Analysis
            By its kind :class:`Modes`, :class:`Campbell`, :class:`Stability`, :class:`Response`, :class:`Coefficients` or
            :class:`Matrices`; of other kinds with ``tables`` only.

        Raises
        ------
        WhirlError
            There is none of this name, or the machine does not stand at any of the speeds.
        CaseError
            Meshes, sets or laws that are wrong.
        """
        if not isinstance(name, str):
            raise TypeError(f"the name of an analysis is a str, not {type(name).__name__}")
        return Analysis._of(self._inner.analyse(_bodies(bodies), name))

    def modes(self, speeds: Speeds = None, **options: Any) -> Modes:
        """Frequencies, damping and whirl at a speed, or a few.

        Parameters
        ----------
        speeds : str, number or iterable, optional
            As of all analyses.
        of : str, optional
            The body whose speed it is; the fastest if none is given.
        ratios : dict of str to float, optional
            Speeds of other bodies over that.
        count : int, optional
            How many modes, the slowest ones; 10 if none is given.
        bodies : Bodies, optional
            Where reduced bodies are found and kept.
        """
        return self._described("modes", speeds, **options)

    def campbell(self, speeds: Speeds = None, **options: Any) -> Campbell:
        """Modes followed over speeds, with critical speeds and thresholds of stability.

        ``orders`` of critical speeds are 1 if none are given; other parameters are those of :meth:`modes`.
        """
        return self._described("campbell", speeds, **options)

    def critical_speeds(self, speeds: Speeds = None, **options: Any) -> Criticals:
        """The critical speeds within a range of speeds: those of :meth:`campbell`."""
        return self.campbell(speeds, **options).criticals

    def stability(self, speeds: Speeds = None, **options: Any) -> Stability:
        """The least stable mode over speeds, with thresholds. Parameters are those of :meth:`modes`."""
        return self._described("stability", speeds, **options)

    def response(self, speeds: Speeds = None, **options: Any) -> Response:
        """The response to unbalance and to loads by the angle, with its peaks. Parameters are those of :meth:`modes`."""
        return self._described("response", speeds, **options)

    def coefficients(self, speeds: Speeds = None, **options: Any) -> Coefficients:
        """Stiffness and damping of the joints where they carry their loads. Parameters are those of :meth:`modes`."""
        return self._described("coefficients", speeds, **options)

    def matrices(self, speed: str | float | None = None, **options: Any) -> Matrices:
        """Mass, damping and stiffness matrices at a speed, inputs, outputs and state space. Parameters are those of :meth:`modes`."""
        return self._described("matrices", speed, **options)

    def _described(
        self,
        kind: str,
        speeds: Speeds,
        *,
        of: str | None = None,
        ratios: Mapping[str, float] | None = None,
        count: int | None = None,
        orders: float | Iterable[float] = (),
        bodies: Bodies | None = None,
    ) -> Any:
        ratios = _ratios(ratios)
        orders = _orders(orders)
        if count is not None and not (isinstance(count, (int, np.integer)) and 0 <= count < 2**31):
            raise ValueError(f"count is how many modes are wanted, a whole number from 1 on, not {count!r}")
        count = None if count is None else int(count)
        wanted = (kind, of, _speeds(speeds), ratios, count, orders, None)
        return Analysis._of(self._inner.analyse(_bodies(bodies), None, wanted))


def _bodies(bodies: Bodies | None) -> Bodies:
    return shared_bodies() if bodies is None else bodies


def _ratios(ratios: Mapping[str, float] | None) -> list[tuple[str, float]]:
    if ratios is None:
        return []
    if not isinstance(ratios, Mapping):
        raise TypeError(
            f"ratios are speeds of other bodies over that, such as {{'high': 1.5}}, not the number or text {ratios!r}"
        )
    found = [(name, _number(own, f"the ratio of {name}")) for name, own in ratios.items()]
    for name, own in found:
        if not np.isfinite(own):
            raise ValueError(f"the ratio of {name} is a number, not {own}")
    return found


def _orders(orders: float | Iterable[float]) -> list[float]:
    if isinstance(orders, Iterable) and not isinstance(orders, (str, bytes)):
        return [_number(own, "an order") for own in orders]
    return [_number(orders, "an order")]


def _number(value: Any, what: str) -> float:
    if isinstance(value, (str, bytes, bool, np.bool_)):
        raise TypeError(f"{what} is a number, not {value!r}")
    try:
        return float(value)
    except (TypeError, OverflowError):
        raise TypeError(f"{what} is a number, not {value!r}") from None


def _speeds(speeds: Speeds) -> list[str]:
    if speeds is None:
        return []
    if isinstance(speeds, (bytes, bytearray, bool, np.bool_)):
        raise TypeError(
            f"speeds are numbers in rpm or texts with a unit, not {type(speeds).__name__}"
        )
    if isinstance(speeds, str):
        return [speeds]
    if isinstance(speeds, Iterable) and not (hasattr(speeds, "ndim") and speeds.ndim == 0):
        texts = [own for each in speeds for own in _speeds(each)]
        if not texts:
            raise ValueError("no speeds are given; leave them out for those of the case")
        return texts
    try:
        return [f"{float(speeds)!r} rpm"]  # type: ignore[arg-type]
    except (TypeError, OverflowError):
        raise TypeError(
            f"speeds are numbers in rpm or texts with a unit, not {type(speeds).__name__}"
        ) from None
