"""Sweeps: the same bits on threads, processes and a cluster."""

import collections
import concurrent.futures
import csv
import multiprocessing
import os
import signal
import subprocess
import threading
import time

import numpy as np
import pytest
from conftest import LAW, NO_NUMBER, a_mass, a_rotor

import whirl

try:
    import zarr
except ImportError:
    zarr = None

MASSES = {"mass.velocity": ["1 m/s", "2 m/s", "3 m/s"], "march.steps": [100, 200]}


def histories(sweep):
    return [own.results.history.array.tobytes() for own in sweep]


def test_points_are_all_combinations_and_give_the_bits_of_single_runs():
    sweep = whirl.sweep(a_mass(), MASSES)
    assert len(sweep) == 6 and sweep.shape == (3, 2) and list(sweep.keys) == list(MASSES)
    for number, own in enumerate(sweep):
        velocity, steps = own.values["mass.velocity"], own.values["march.steps"]
        assert own.number == number and own.error is None
        alone = whirl.Case(a_mass(steps=steps, velocity=velocity)).run()
        assert own.results.history == alone.history
    assert [own.values["march.steps"] for own in sweep[:3]] == [100, 200, 100]


def test_fifty_laws_as_texts():
    laws = [LAW.replace("40000", str(30000 + 1000 * k)) for k in range(50)]
    machine = {
        "include": "hu2003-5.toml",
        "springs": {"radial_clearance": "5 um"},
        "march": {"steps": 40},
    }
    sweep = whirl.sweep(machine, {"springs.law": laws})
    assert len(sweep) == 50 and all(own.error is None for own in sweep)
    assert len(set(histories(sweep))) == 50
    machine["springs"]["law"] = whirl.Law(laws[7])
    alone = whirl.Case(machine).run()
    assert sweep[7].results.history == alone.history
    data = sweep.to_xarray(columns=["RX1_N"])
    assert data.sizes == {"springs.law": 50, "support": 4, "row": 40}
    assert data["RX_max"].attrs["units"] == "N"


def test_bodies_are_reduced_once():
    bodies = whirl.Bodies()
    vary = {"body.rotor.speed": ["300 rpm", "400 rpm", "500 rpm"]}
    sweep = whirl.sweep(a_rotor(), vary, bodies=bodies, workers=3)
    reduced = [not own.results.summary.time.reduction_cached for own in sweep]
    assert sum(reduced) == 1 and len(bodies.held()) == 1


def test_an_executor_gives_the_same_bits():
    vary = {"body.rotor.speed": ["300 rpm", "400 rpm"], "body.rotor.modes": [10, 12]}
    here = whirl.sweep(a_rotor(), vary)
    bodies = whirl.Bodies()
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as executor:
        there = whirl.sweep(a_rotor(), vary, client=executor, bodies=bodies)
    assert histories(here) == histories(there)
    assert all(own.results.summary.time.reduction_cached for own in there)
    assert len(bodies.held()) == 2
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        assert histories(whirl.sweep(a_mass(), MASSES, client=executor)) == histories(
            whirl.sweep(a_mass(), MASSES)
        )


def test_a_cluster_gives_the_same_bits_and_runs_the_points_of_a_lost_worker_again(tmp_path):
    distributed = pytest.importorskip("distributed")
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("zarr")
    vary = {"body.rotor.speed": ["300 rpm", "400 rpm", "500 rpm", "600 rpm"]}
    here = whirl.sweep(a_rotor(400), vary)
    assert whirl.shared_bodies().held()
    lost = []

    def lose(done, points, point):
        # Once, in the middle; the bodies that were there before go with it.
        if not lost:
            has = client.has_what()
            holder = max(has, key=lambda own: any("whirl-body" in key for key in has[own]))
            pid = client.run(os.getpid)[holder]
            lost.append(pid)
            os.kill(pid, signal.SIGKILL)

    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=tmp_path
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        there = whirl.sweep(
            a_rotor(400),
            vary,
            client=client,
            progress=lose,
            columns=["x_left_um"],
            out=tmp_path / "study.zarr",
        )
        assert lost and histories(here) == histories(there)
        assert all(own.results.summary.time.reduction_cached for own in there)

        def cancel(done, points, point):
            raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            whirl.sweep(a_mass(), {"mass.velocity": ["1 m/s"] * 8}, client=client, progress=cancel)
    data = xarray.open_zarr(tmp_path / "study.zarr", consolidated=False).load()
    xarray.testing.assert_identical(
        data.drop_attrs(), there.to_xarray(columns=["x_left_um"]).drop_attrs()
    )
    assert bool(data.done.all())


def test_a_study_survives_a_lost_worker_without_losing_or_repeating_a_point(tmp_path):
    distributed = pytest.importorskip("distributed")
    case = {"include": "annular-rub.toml", "march": {"duration": "0.2 s"}}
    gaps = [f"{own:.4f} mm" for own in np.linspace(0.5, 1.0, 60)]
    vary = {"stop.1.gap": gaps}
    here = whirl.sweep(case, vary)
    told = []

    class Finished(distributed.SchedulerPlugin):
        """Which points ran to their end, each as often as it did."""

        def __init__(self):
            self.points = []

        def transition(self, key, start, finish, *_, **__):
            if (start, finish) == ("processing", "memory") and key.startswith("whirl-point "):
                self.points.append(int(key.split()[1]))

    def lose(done, points, point):
        told.append((done, point.number))
        if done == 20:
            os.kill(pids[0], signal.SIGKILL)

    finished = Finished()
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=tmp_path
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        cluster.scheduler.add_plugin(finished)
        pids = list(client.run(os.getpid).values())
        there = whirl.sweep(case, vary, client=client, progress=lose)
        assert pids[0] not in client.run(os.getpid).values()
    assert all(own.error is None for own in there)
    assert histories(there) == histories(here) and len(set(histories(there))) == 60
    assert [done for done, _ in told] == list(range(1, 61))
    assert sorted(number for _, number in told) == list(range(60))
    # What the lost worker had finished is run again, once, and only where its results had not come.
    ends = collections.Counter(finished.points)
    assert set(ends) == set(range(60)) and max(ends.values()) <= 2
    assert all(ends[number] == 1 for _, number in told[:20])


def test_a_cluster_gives_the_table_of_the_command(command, tmp_path):
    distributed = pytest.importorskip("distributed")
    speeds, modes = ["300 rpm", "400 rpm"], [10, 12]
    (tmp_path / "rotor.toml").write_text(
        'include = "unbalance.toml"\ntitle = "a run-up"\n[march]\nsteps = 200\n'
    )
    (tmp_path / "study.toml").write_text(
        'case = "rotor.toml"\n[vary]\nbody.rotor.speed = ["300 rpm", "400 rpm"]\nbody.rotor.modes = [10, 12]\n'
    )
    line = [command, "sweep", "study.toml", "--out", "swept", "--quiet", "--no-cache"]
    subprocess.run(line, cwd=tmp_path, check=True)
    with open(tmp_path / "swept" / "table.csv", newline="", encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=tmp_path
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        vary = {"body.rotor.speed": speeds, "body.rotor.modes": modes}
        sweep = whirl.sweep(tmp_path / "rotor.toml", vary, client=client)
    assert len(table) == len(sweep) == 4
    compared = 0
    for row, own in zip(table, sweep):
        summary = own.results.summary
        assert row["body.rotor.speed [rpm]"] + " rpm" == own.values["body.rotor.speed"]
        assert row["body.rotor.modes"] == str(own.values["body.rotor.modes"])
        assert float(row["energy_balance_j.kinetic"]) == summary.energy_balance_j.kinetic
        for support in summary.supports:
            for quantity in ("RX_N", "RY_N", "X_um", "Y_um", "EX_um", "EY_um"):
                letters, unit = quantity.split("_")
                for end in ("min", "mean", "max"):
                    cell = row[f"{letters}_{support.joint}_{unit}.{end}"]
                    assert float(cell) == support[quantity][end], (quantity, end)
                    compared += 1
    assert compared == 4 * 2 * 6 * 3


def test_results_come_into_a_dataset_on_disk(tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("zarr")
    place = tmp_path / "study.zarr"
    told = []

    def stop(done, points, point):
        told.append((done, points, point.number))
        if done == 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        whirl.sweep(a_mass(), MASSES, out=place, progress=stop, workers=1)
    assert [own[:2] for own in told] == [(k, 6) for k in (1, 2, 3, 4)]
    data = xarray.open_zarr(place, consolidated=False).load()
    assert int(data.done.sum()) == 4 and int(np.isfinite(data.RX_max).sum()) == 4
    with pytest.raises(whirl.WhirlError, match="is there"):
        whirl.sweep(a_mass(), MASSES, out=place)
    with pytest.raises(whirl.WhirlError, match="NAME.zarr"):
        whirl.sweep(a_mass(), MASSES, out=tmp_path / "study.nc")


def test_cancelled_points_end_after_their_step():
    start = time.monotonic()
    timer = threading.Timer(0.5, os.kill, [os.getpid(), signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        whirl.sweep(a_mass(steps=3_000_000), {"mass.velocity": ["1 m/s"] * 4})
    assert time.monotonic() - start < 10


def test_a_point_that_ends_early_says_so(tmp_path):
    case = {"title": "a mass", "mass": {"mass": "1 kg", "velocity": "1 m/s"}}
    case["stop"] = [{"side": "above", "gap": "1 mm", "law": "gap-linear-1e6"}]
    case["march"] = {"time_step": "1e-4 s", "steps": 100}
    vary = {"stop.1.law": [NO_NUMBER, LAW]}
    sweep = whirl.sweep(case, vary, workers=1, out=tmp_path / "study.zarr" if zarr else None)
    assert "has no value" in sweep[0].error and 0 < len(sweep[0].results["t_s"]) < 100
    assert sweep[1].error is None and "1 not to their end" in repr(sweep)
    data = sweep.to_xarray(columns=["X1_um"])
    assert "has no value" in str(data.error.values[0]) and str(data.error.values[1]) == ""
    assert np.isnan(data.X1_um.values[0, -1]) and not np.isnan(data.X1_um.values[1]).any()
    assert list(data.complete.values) == [False, True]


def test_keys_of_lists_tables_and_built_in_cases_may_be_varied():
    case = whirl.Case(a_mass())
    gaps = whirl.sweep(case, {"stop.1.gap": ["0 mm", "2 mm"]})
    assert gaps[0].results.history == case.run().history != gaps[1].results.history
    whole = a_mass()
    whole["stop"][0]["gap"] = "2 mm"
    assert gaps[1].results.history == whirl.Case(whole).run().history
    tables = whirl.sweep(case, {"mass": [{"mass": "50 kg", "velocity": "1 m/s"}]})
    assert tables[0].results.history != case.run().history
    vary = {"load.1.force": ["500 N"], "march.steps": [4]}
    (built_in,) = whirl.sweep("hu2003-5", vary)
    assert built_in.error is None and len(built_in.results["t_s"]) == 4
    (other,) = whirl.sweep("hu2003-5", {"march.duration": ["3e-4 s"]})
    assert other.results.complete


def test_histories_need_not_be_kept():
    sweep = whirl.sweep(a_mass(), MASSES, keep_histories=False)
    assert all(own.results.history.array.shape[0] == 0 for own in sweep)
    assert sweep.to_xarray().sizes["support"] == 1
    with pytest.raises(whirl.CaseError, match="nothing"):
        whirl.sweep({"include": "hu2003-5.toml"}, {"springs.law": [LAW, "nothing"]})


@pytest.mark.parametrize(
    "vary, error, said",
    [
        ({}, TypeError, "is a dict of keys"),
        ([1], TypeError, "is a dict of keys"),
        ({"march.steps": "100"}, TypeError, "is a list of values, not str"),
        ({"march.steps": 4}, TypeError, "is a list of values, not int"),
        ({"march.steps": []}, whirl.WhirlError, "has no values"),
        ({"march..steps": [1]}, TypeError, "is no key of a case"),
        ({4: [1]}, TypeError, "is no key of a case"),
        ({"march": [{"steps": 4}], "march.steps": [3]}, whirl.CaseError, "march"),
        ({"stop.2.gap": ["1 mm"]}, whirl.CaseError, "`stop.1` for its first entry"),
        ({"stop.gap": ["1 mm"]}, whirl.CaseError, "there is no `stop.gap`"),
        ({"march.stepz": [3]}, whirl.CaseError, "did you mean `steps`"),
        ({"marsh.steps": [3]}, whirl.CaseError, "did you mean `march`"),
        ({"mass.velocity": ["1 kg"]}, whirl.CaseError, "1 kg"),
    ],
)
def test_keys_and_values_that_do_not_fit_are_said(vary, error, said):
    with pytest.raises(error) as raised:
        whirl.sweep(a_mass(), vary)
    assert said in str(raised.value)


def test_other_things_are_no_clients():
    with pytest.raises(TypeError, match="dask.distributed.Client, not int"):
        whirl.sweep(a_mass(), MASSES, client=4)
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        with pytest.raises(TypeError, match="workers of its own"):
            whirl.sweep(a_mass(), MASSES, client=executor, workers=2)


def in_a_forked_process(queue):
    own = {"include": "hu2003-5.toml", "march": {"steps": 20}}
    queue.put(whirl.Case(own).run(bodies=whirl.Bodies()).history["X1_um"].tobytes())


@pytest.mark.skipif(
    "fork" not in multiprocessing.get_all_start_methods(), reason="nothing is forked here"
)
def test_a_forked_process_factors_large_bodies_with_workers_of_its_own():
    """In a process that was forked from one whose workers it has not."""
    own = {"include": "hu2003-5.toml", "march": {"steps": 20}}
    here = whirl.Case(own).run(bodies=whirl.Bodies()).history["X1_um"].tobytes()
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    child = context.Process(target=in_a_forked_process, args=(queue,))
    child.start()
    try:
        assert queue.get(timeout=300) == here
    finally:
        child.kill()


def test_what_a_sweep_cannot_do_is_refused_before_it_runs():
    vary = {"mass.velocity": ["1 m/s", "2 m/s"]}
    with pytest.raises(ValueError, match="at least 1, not 0"):
        whirl.sweep(a_mass(), vary, workers=0)
    with pytest.raises(TypeError, match="histories in `out`"):
        whirl.sweep(a_mass(), vary, columns=["X1_um"])
    without = whirl.sweep(a_mass(), vary, keep_histories=False)
    pytest.importorskip("xarray")
    assert without.to_xarray().sizes["mass.velocity"] == 2
    with pytest.raises(whirl.WhirlError, match="no histories were kept"):
        without.to_xarray(columns=["X1_um"])
