"""Many runs of a case with varied keys: on local cores, an executor, or a cluster."""

from __future__ import annotations

import concurrent.futures
import itertools
import os
import queue
import threading
from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .bodies import Bodies, shared_bodies
from .case import Case
from .errors import WhirlError, extra
from .history import History
from .law import Law
from .points import Point, expanded
from .results import Results

__all__ = ["Sweep", "SweepPoint", "sweep"]


@dataclass(frozen=True)
class SweepPoint:
    """A point of a sweep, once it is done.

    Attributes
    ----------
    number : int
        Its place among the points, from 0.
    values : dict of str to object
        The varied keys with the values that they have here.
    results : Results or None
        Its results; of a run that ended early those up to there.
    error : str or None
        Why there are none, or why the run ended early.
    """

    number: int
    values: Mapping[str, Any]
    results: Results | None
    error: str | None


class Sweep(Sequence[SweepPoint]):
    """The points of a sweep in their order: the last key varies fastest.

    Attributes
    ----------
    keys : dict of str to list
        The varied keys with all their values; the shape of the sweep is that of their lengths.
    """

    def __init__(self, name: str, keys: Mapping[str, list[Any]], points: Sequence[SweepPoint]):
        self.name = name
        self.keys = dict(keys)
        self._points = tuple(points)

    def __getitem__(self, place):
        return self._points[place]

    def __len__(self) -> int:
        return len(self._points)

    def __repr__(self) -> str:
        failed = sum(own.error is not None for own in self._points)
        early = f", {failed} not to their end" if failed else ""
        return (
            f"<whirl.Sweep of {self.name} over {', '.join(self.keys)}: {len(self)} points{early}>"
        )

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of each key."""
        return tuple(len(own) for own in self.keys.values())

    def to_xarray(self, columns: Iterable[str] = ()) -> Any:
        """What the points come to as an :class:`xarray.Dataset` with a dimension for every varied key.

        Parameters
        ----------
        columns : iterable of str, optional
            Columns of histories that are wanted, too, with a dimension ``row`` and the variable ``t_s``.

        Returns
        -------
        xarray.Dataset
            Least, mean and largest of every quantity of the supports over the last cycle (dimension ``support``), ``done``,
            ``sound``, ``complete``, ``steps``, ``error``. NaN where a point has no results.
        """
        columns = (columns,) if isinstance(columns, str) else tuple(columns)
        layout = _Layout(self.name, self.keys, columns)
        for own in self._points:
            layout.add(own)
        return layout.dataset()


def sweep(
    case: Case | str | os.PathLike[str] | Mapping[str, Any],
    vary: Mapping[str, Iterable[Any]],
    *,
    client: Any = None,
    columns: Iterable[str] = (),
    out: str | os.PathLike[str] | None = None,
    progress: Callable[[int, int, SweepPoint], object] | None = None,
    workers: int | None = None,
    keep_histories: bool = True,
    bodies: Bodies | None = None,
) -> Sweep:
    """Runs a case once for every combination of values of some of its keys.

    Bodies that points share are reduced once. The numbers of a point are those of a run of the case with these values, to
    the bit, wherever it runs, if the processors are of one kind.

    Parameters
    ----------
    case : Case, path, name, text or dict
        The case.
    vary : mapping of str to iterable
        Values of keys, such as ``{"springs.radial_clearance": ["30 um", "40 um"], "springs.law": [law, "hu2003-linear"]}``. A key
        is the tables that it is in and its name, with dots between; ``load.2.force`` is that of the second of several
        ``[[load]]``. Values are those of a case in a dict; those of a key
        ``law`` may be laws, or their texts.
    client : optional
        Where the points run: on all cores of this process if it is None; or a :class:`concurrent.futures.Executor`, such as a
        ProcessPoolExecutor; or a :class:`dask.distributed.Client`, whose scheduler runs the points of a lost worker again.
    columns : iterable of str, optional
        Columns of histories that ``out`` has.
    out : path, optional
        A folder (``NAME.zarr``) for an xarray dataset, as :meth:`Sweep.to_xarray` makes it, which is filled as the points come.
        Nothing is written if none is given.
    progress : callable, optional
        ``progress(done, points, point)`` is called on this thread after every point. What it raises cancels the sweep, as a
        KeyboardInterrupt does: points that run end after their step, and ``out`` keeps what has come.
    workers : int, optional
        Points at a time without a client; as many as there are processors if it is None.
    keep_histories : bool, default True
        Whether the points that are returned have their histories; without, memory does not grow with their rows.
    bodies : Bodies, optional
        Reduced bodies that are there before; :func:`whirl.shared_bodies` if none are given.

    Returns
    -------
    Sweep
        A sequence of :class:`SweepPoint`. A point that cannot be run to its end has its ``error``.

    Raises
    ------
    CaseError
        A point whose case is wrong; nothing was run then.
    """
    if workers is not None and workers < 1:
        raise ValueError(f"`workers` is how many points run at a time, at least 1, not {workers}")
    if columns and out is None:
        raise TypeError(
            "`columns` are those of histories in `out`: name that, or pass them to `to_xarray`"
        )
    case = case if isinstance(case, Case) else Case(case)
    keys, points = expanded(case, vary)
    points[0].case._inner.demand_march()
    bodies = shared_bodies() if bodies is None else bodies
    layout = None
    if out is not None:
        layout = _Layout(case.name, keys, tuple(columns))
        layout.open(Path(out), max(own.case._inner.rows for own in points))
    runner = _runner(client, workers, bodies)
    done: list[SweepPoint | None] = [None] * len(points)
    came = runner(points)
    try:
        for number, (results, error) in came:
            own = SweepPoint(number, points[number].values, results, error)
            done[number] = own
            if layout is not None:
                layout.write(own)
            if progress is not None:
                progress(sum(point is not None for point in done), len(points), own)
            if not keep_histories and results is not None:
                empty = History(
                    np.empty((0, len(results.history.columns))), results.history.columns
                )
                results.history = empty
    finally:
        came.close()
        if layout is not None:
            layout.close()
    return Sweep(case.name, keys, [own for own in done if own is not None])


_Outcome = tuple[Results | None, str | None]
_Outcomes = Generator[tuple[int, _Outcome], None, None]
_Runner = Callable[[Sequence[Point]], _Outcomes]


def _runner(client: Any, workers: int | None, bodies: Bodies) -> _Runner:
    if client is None:
        return lambda points: _on_threads(points, bodies, workers or os.cpu_count() or 1)
    if workers is not None:
        raise TypeError("`workers` is for sweeps without a client, which has workers of its own")
    if isinstance(client, concurrent.futures.Executor):
        return lambda points: _on_executor(points, client, bodies)
    if all(hasattr(client, name) for name in ("submit", "scatter", "cancel")):
        return lambda points: _on_dask(points, client, bodies)
    raise TypeError(
        "`client` is a concurrent.futures.Executor or a dask.distributed.Client, not "
        f"{type(client).__name__}"
    )


def _run(case: Case, bodies: Bodies, progress: Any = None) -> _Outcome:
    """Runs a point; what keeps it from its end is no exception."""
    try:
        results = case.run(bodies=bodies, progress=progress, raises=False)
    except WhirlError as error:
        return None, str(error)
    finally:
        # A sweep needs no machine twice.
        case._inner.release()
    return results, results.reason


def _on_threads(points: Sequence[Point], bodies: Bodies, workers: int) -> _Outcomes:
    """On threads of this process, which share the bodies; the first to need one reduces it."""
    came: queue.SimpleQueue = queue.SimpleQueue()
    left = iter(range(len(points)))
    lock, stop = threading.Lock(), threading.Event()

    class Stopped(Exception):
        pass

    def watch(*_):
        if stop.is_set():
            raise Stopped

    def work():
        while not stop.is_set():
            with lock:
                number = next(left, None)
            if number is None:
                return
            try:
                came.put((number, _run(points[number].case, bodies, watch), None))
            except Stopped:
                return
            except BaseException as error:
                came.put((number, None, error))
                return

    threads = [
        threading.Thread(target=work, name=f"whirl-sweep-{place}", daemon=True)
        for place in range(max(1, min(workers, len(points))))
    ]
    for own in threads:
        own.start()
    try:
        for _ in points:
            number, outcome, error = _waited(came)
            if error is not None:
                raise error
            yield number, outcome
    finally:
        stop.set()
        for own in threads:
            own.join()


def _waited(came: queue.SimpleQueue) -> Any:
    """The next entry. Waits in pieces: a signal that another thread gets is only seen between them."""
    while True:
        try:
            return came.get(timeout=0.1)
        except queue.Empty:
            pass


def _reduce(case: Case, known: Sequence[bytes] = ()) -> list[bytes]:
    """The bodies of a case, packed."""
    bodies = Bodies()
    for packed in known:
        bodies.adopt(packed)
    case._inner.build(bodies)
    return bodies.held()


def _given(packed: bytes) -> bytes:
    """A body that is there before."""
    return packed


def _run_with(case: Case, packed: Sequence[bytes]) -> _Outcome:
    """As :func:`_run`, in another process."""
    bodies = Bodies()
    for own in packed:
        bodies.adopt(own)
    return _run(case, bodies)


def _groups(points: Sequence[Point]) -> dict[tuple[str, ...], list[int]]:
    """Points that share their bodies, by the keys of these."""
    groups: dict[tuple[str, ...], list[int]] = {}
    for number, own in enumerate(points):
        groups.setdefault(tuple(own.case._inner.body_keys()), []).append(number)
    return groups


def _on_executor(
    points: Sequence[Point], executor: concurrent.futures.Executor, bodies: Bodies
) -> _Outcomes:
    """On an executor: a task reduces what some points share, then they are tasks with it."""
    running: dict[concurrent.futures.Future, Any] = {}
    for keys, numbers in _groups(points).items():
        if keys:
            first = points[numbers[0]].case
            running[executor.submit(_reduce, first, bodies.held())] = numbers
        else:
            for number in numbers:
                running[executor.submit(_run_with, points[number].case, ())] = number
    try:
        while running:
            came, _ = concurrent.futures.wait(
                running, timeout=0.1, return_when=concurrent.futures.FIRST_COMPLETED
            )
            for future in came:
                what = running.pop(future)
                if isinstance(what, int):
                    yield what, future.result()
                    continue
                try:
                    packed = future.result()
                except WhirlError as error:
                    yield from ((number, (None, str(error))) for number in what)
                    continue
                for own in packed:
                    bodies.adopt(own)
                for number in what:
                    running[executor.submit(_run_with, points[number].case, packed)] = number
    finally:
        for future in running:
            future.cancel()


def _on_dask(points: Sequence[Point], client: Any, bodies: Bodies) -> _Outcomes:
    """On a cluster: bodies are tasks, and points are tasks that need them; the scheduler moves them to the workers."""
    distributed = extra("dask", "distributed", "a sweep on a dask client")
    # As tasks, which are run again where a worker is lost: data that are scattered are lost with it.
    known = [
        client.submit(_given, own, pure=False, key=_fresh("whirl-body")) for own in bodies.held()
    ]
    tasks, reductions = {}, []
    for keys, numbers in _groups(points).items():
        packed = []
        if keys:
            name = f"whirl-bodies of {points[numbers[0]].case.name}"
            packed = client.submit(
                _reduce, points[numbers[0]].case, known, pure=False, key=_fresh(name)
            )
            reductions.append(packed)
        for number in numbers:
            name = f"whirl-point {number}"
            future = client.submit(
                _run_with, points[number].case, packed, pure=False, key=_fresh(name)
            )
            tasks[future] = number
    try:
        for future in distributed.as_completed(list(tasks)):
            number = tasks.pop(future)
            try:
                outcome = future.result()
            except WhirlError as error:
                outcome = None, str(error)
            except distributed.KilledWorker as error:
                outcome = None, f"its workers were lost again and again: {error}"
            # A result that is held here would be made again if its worker were lost.
            del future
            yield number, outcome
    finally:
        client.cancel([*tasks, *reductions, *known], force=True)


def _fresh(name: str) -> str:
    """A key that no other task has."""
    return f"{name} {os.urandom(8).hex()}"


_QUANTITIES = ("RX_N", "RY_N", "X_um", "Y_um", "EX_um", "EY_um")
_STATISTICS = ("min", "mean", "max")
# Letters of an error that a dataset keeps: arrays on disk have one width.
_LONGEST = 400


class _Layout:
    """A dataset that is filled point by point, in memory or on disk."""

    def __init__(self, name: str, keys: Mapping[str, list[Any]], columns: tuple[str, ...]):
        self.name = name
        self.keys = keys
        self.columns = columns
        self.shape = tuple(len(own) for own in keys.values())
        self.points: list[SweepPoint] = []
        self.path: Path | None = None
        self.rows = 0

    def open(self, path: Path, rows: int) -> None:
        """A dataset on disk; it is made with the first point, of which the supports are known."""
        extra("dask", "zarr", "`out`")
        if path.suffix != ".zarr":
            raise WhirlError(f"`out` is a folder `NAME.zarr`, not `{path}`")
        if path.exists():
            raise WhirlError(f"`{path}` is there: choose another place, or remove it")
        self.path, self.rows = path, rows

    def add(self, point: SweepPoint) -> None:
        self.points.append(point)
        if point.results is not None:
            self.rows = max(self.rows, len(point.results["t_s"]))

    def write(self, point: SweepPoint) -> None:
        assert self.path is not None, "it is open"
        self.add(point)
        found = self._filled([point])
        place = np.unravel_index(point.number, self.shape)
        region = {key: slice(at, at + 1) for key, at in zip(self.keys, place)}
        if not self.path.exists():
            # Its arrays are known with the first point that has results.
            if point.results is not None:
                whole = self.dataset()
                done = whole[["done"]]
                done = done.drop_vars(list(done.coords))
                whole.assign(done=whole["done"] & False).to_zarr(
                    self.path, mode="w-", zarr_format=2
                )
                done.to_zarr(self.path, mode="r+")
            return
        if point.results is None:
            found = found[["done", "error"]]
        own = found.isel(region)
        without = [
            own_name for own_name in own.variables if not set(own[own_name].dims) & set(self.keys)
        ]
        own = own.drop_vars([*without, *(key for key in self.keys if key in own.variables)])
        # Whoever reads while it is written: what is done is whole.
        own.drop_vars("done").to_zarr(self.path, region=region)
        own[["done"]].to_zarr(self.path, region=region)

    def close(self) -> None:
        """Without any results there are the errors."""
        if self.path is not None and not self.path.exists() and self.points:
            self.dataset().to_zarr(self.path, mode="w-", zarr_format=2)

    def dataset(self) -> Any:
        return self._filled(self.points)

    def _filled(self, points: Sequence[SweepPoint]) -> Any:
        xarray = extra("xarray", "xarray", "Sweep.to_xarray()")
        dims = tuple(self.keys)
        arrays: dict[str, Any] = {}

        def put(name, inner, shape, point, value, units=None, meaning=None, fill=np.nan):
            if name not in arrays:
                attrs = {"units": units, "long_name": meaning}
                attrs = {own: text for own, text in attrs.items() if text}
                dtype = f"<U{_LONGEST}" if isinstance(fill, str) else np.asarray(fill).dtype
                arrays[name] = (
                    (*dims, *inner),
                    np.full((*self.shape, *shape), fill, dtype=dtype),
                    attrs,
                )
            arrays[name][1][np.unravel_index(point.number, self.shape)] = value

        for point in points:
            put("done", (), (), point, True, fill=False)
            put("error", (), (), point, (point.error or "")[:_LONGEST], fill="")
            if point.results is None:
                continue
            summary = point.results.summary
            supports = summary.supports
            put("sound", (), (), point, bool(point.results.verdict), fill=False)
            put("complete", (), (), point, point.results.complete, fill=False)
            put("steps", (), (), point, summary.march.steps, fill=0)
            for quantity, statistic in itertools.product(_QUANTITIES, _STATISTICS):
                values = [_number(own[quantity][statistic]) for own in supports]
                name, unit = f"{quantity.rsplit('_', 1)[0]}_{statistic}", quantity.rsplit("_", 1)[1]
                meaning = f"{statistic} of {quantity} over the last cycle"
                put(name, ("support",), (len(values),), point, values, unit, meaning)
            for name in ("t_s", *self.columns) if self.columns else ():
                column = point.results.history.column(name)
                if summary.march.steps and not len(point.results.history.array):
                    raise WhirlError("no histories were kept: sweep with `keep_histories=True`")
                padded = np.full(self.rows, np.nan)
                own = point.results[name]
                padded[: len(own)] = own
                put(name, ("row",), (self.rows,), point, padded, column.unit, column.meaning)
        coords = {key: (key, _labels(values)) for key, values in self.keys.items()}
        named = next((own.results for own in points if own.results is not None), None)
        if named is not None:
            names = [own.get("joint") or str(own.support) for own in named.summary.supports]
            coords["support"] = ("support", np.array(names))
        return xarray.Dataset(arrays, coords=coords, attrs={"case": self.name})


def _number(value: float | None) -> float:
    """NaN of a run that ended in its first step."""
    return np.nan if value is None else float(value)


def _labels(values: Sequence[Any]) -> np.ndarray:
    """Values of a key as the coordinates of a dimension: numbers, or texts that differ."""
    if all(isinstance(own, (int, float)) and not isinstance(own, bool) for own in values):
        return np.array(values, dtype=np.float64)
    texts = [own.name if isinstance(own, Law) else str(own) for own in values]
    if len(set(texts)) < len(texts) or any("\n" in own for own in texts):
        texts = [
            f"{place}: {own.splitlines()[0][:40] if own else own}"
            for place, own in enumerate(texts)
        ]
    return np.array(texts)
