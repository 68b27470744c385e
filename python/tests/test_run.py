"""Runs: numbers, progress, interruption, threads."""

import json
import pickle
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from conftest import LAW, NO_NUMBER, a_mass, a_rotor

import whirl


def read_csv(path):
    with open(path) as file:
        names = file.readline().strip().split(",")
    return names, np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)


def data_of(page):
    text = page.read_text(encoding="utf-8")
    head = '<script id="data" type="application/json">'
    return json.loads(text[text.index(head) + len(head) :].split("</script>", 1)[0])


@pytest.mark.parametrize("case", ["mass", "rotor"])
def test_arrays_are_those_of_history_csv(case, tmp_path, command):
    from whirl._toml import dumps

    text = dumps(a_mass() if case == "mass" else a_rotor())
    (tmp_path / f"{case}.toml").write_text(text)
    line = [command, "run", f"{case}.toml", "--no-figures", "--quiet", "--out", "out"]
    subprocess.run(line, cwd=tmp_path, check=True)
    names, values = read_csv(tmp_path / "out" / "history.csv")
    results = whirl.Case(tmp_path / f"{case}.toml").run()
    assert list(results.history) == names
    assert results.history.array.tobytes() == values.tobytes()
    for place, name in enumerate(names):
        assert np.array_equal(results[name], values[:, place])
    saved = results.save(tmp_path / "saved")
    assert (saved / "history.csv").read_bytes() == (tmp_path / "out/history.csv").read_bytes()
    assert (saved / "state.bin").read_bytes() == (tmp_path / "out/state.bin").read_bytes()
    own, other = (json.loads((tmp_path / k / "summary.json").read_text()) for k in ("saved", "out"))
    for summary in (own, other):
        del summary["time"], summary["case"]["files"], summary["commit"]
    assert own == other
    page, mine = (tmp_path / "out/report.html", results.report(tmp_path / "own.html"))
    assert mine == tmp_path / "own.html"
    told, known = (data_of(path) for path in (page, mine))
    assert known["about"] == told["about"] and known["run"] == told["run"]
    assert known["shapes"] == told["shapes"]
    assert known["summary"]["verdict"] == told["summary"]["verdict"]
    with pytest.raises(whirl.WhirlError, match="another process"):
        pickle.loads(pickle.dumps(results)).report(mine)
    with pytest.raises(whirl.WhirlError, match="cannot write the report"):
        results.report(tmp_path / "no" / "own.html")


def test_arrays_are_views_that_cannot_be_written(mass):
    history = mass.run().history
    column = history["RX1_N"]
    assert column.base is not None and np.shares_memory(column, history.array)
    with pytest.raises(ValueError, match="read-only"):
        column[0] = 1.0
    assert history.array.shape == (900, len(history.columns)) and history.array.flags.c_contiguous
    assert np.all(np.diff(history.time) > 0)
    assert dict(history).keys() == set(history.keys()) and len(list(history.values())) == len(
        history
    )
    with pytest.raises(KeyError, match="RX1_N"):
        history["RX1"]
    with pytest.raises(ValueError, match=r"of the shape \(rows, 1\), not \(3, 2\)"):
        whirl.History(np.zeros((3, 2)), [whirl.Column("t_s", "s", "time")])


def test_progress_is_told(mass):
    told = []
    mass.run(progress=lambda *now: told.append(now))
    assert told[-1] == (900, 900, pytest.approx(900 * 2e-5))
    with pytest.raises(TypeError, match="progress"):
        mass.run(progress=3)


def test_what_progress_raises_ends_the_run():
    case = whirl.Case(a_mass(steps=3_000_000))

    def stop(step, steps, time):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough") as raised:
        case.run(progress=stop)
    results = raised.value.results
    assert 0 < len(results["t_s"]) < 3_000_000 and "interrupted" in results.reason


def test_ctrl_c_ends_the_run():
    case = whirl.Case(a_mass(steps=3_000_000))
    timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    timer.start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        case.run()
    assert time.monotonic() - start < 5


def test_other_threads_run_meanwhile():
    case = whirl.Case(a_mass(steps=100_000))
    counted = 0
    done = threading.Event()

    def count():
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    case.run()
    done.set()
    thread.join()
    assert counted > 5


def test_one_case_may_be_run_by_many_threads():
    case = whirl.Case(a_rotor())
    found = [None] * 4

    def run(place):
        found[place] = case.run().history

    threads = [threading.Thread(target=run, args=(place,)) for place in range(4)]
    [own.start() for own in threads]
    [own.join() for own in threads]
    assert all(own == found[0] for own in found)


def between_stops(law, time_step, steps):
    stop = [
        {"side": "above", "gap": "1 mm", "law": law},
        {"side": "below", "gap": "2 mm", "law": law},
    ]
    return {
        "title": "a mass between stops",
        "mass": {"mass": "1 kg", "velocity": "1 m/s"},
        "stop": stop,
        "march": {"time_step": time_step, "steps": steps},
    }


def test_a_run_that_does_not_converge_says_so():
    case = whirl.Case(between_stops(whirl.Law(NO_NUMBER), "1e-4 s", 100))
    with pytest.raises(whirl.RunError, match="has no value") as raised:
        case.run()
    results = raised.value.results
    assert results.reason == raised.value.reason and 0 < len(results["t_s"]) < 100
    assert not results.complete and not results.verdict
    sent = pickle.loads(pickle.dumps(raised.value))
    assert sent.reason == raised.value.reason and sent.results.history == results.history
    assert case.run(raises=False).history == results.history


def test_summary_and_verdict_are_objects(mass):
    results = mass.run()
    assert results.verdict.sound and results.verdict and not results.verdict.findings
    assert str(results.verdict) == "sound"
    summary = results.summary
    assert summary.march.steps == 900 == summary["march"]["steps"] and results.complete
    assert summary.supports[0].RX_N.min < 0
    assert "march" in dir(summary) and "march" in list(summary)
    with pytest.raises(AttributeError, match="did you mean `march`"):
        summary.mach
    assert summary.to_dict()["march"]["steps"] == 900


def test_a_run_goes_on_from_saved_results(tmp_path):
    whole = whirl.Case(a_rotor(60)).run()
    folder = whirl.Case(a_rotor(40)).run().save(tmp_path / "first")
    rest = whirl.Case({**a_rotor(20), "start": {"from": str(folder)}}).run()
    assert rest["t_s"][0] > 40 * 4.9e-5 and rest.notes and "going on from" in rest.notes[0]
    np.testing.assert_allclose(rest["x_left_um"], whole["x_left_um"][40:], rtol=1e-6)


def test_an_unsound_run_says_why():
    verdict = whirl.Case(between_stops("gap-linear-1e6", "5e-3 s", 100)).run().verdict
    assert not verdict and verdict.findings[0].remedy and "NOT SOUND" in str(verdict)


def test_xarray_and_pandas_have_units_and_meanings(mass):
    results = mass.run()
    data = results.to_xarray()
    assert data.sizes == {"t_s": 900}
    assert data["RX1_N"].attrs["units"] == "N" and "force" in data["RX1_N"].attrs["long_name"]
    assert data.t_s.attrs["units"] == "s" and data.attrs["sound"] == 1
    assert np.array_equal(data["X1_um"].values, results["X1_um"])
    frame = results.to_pandas()
    assert frame.index.name == "t_s" and frame.attrs["units"]["X1_um"] == "um"
    assert np.array_equal(frame["X1_um"].to_numpy(), results["X1_um"])


def test_what_is_missing_is_named(mass, monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(whirl.MissingExtra, match=r"pip install 'whirl\[xarray\]'"):
        mass.run().to_xarray()


def test_pickled_cases_and_results_give_the_same_bits(tmp_path):
    folder = tmp_path / "gone"
    folder.mkdir()
    (folder / "my-law.toml").write_text(LAW)
    from whirl._toml import dumps

    (folder / "base.toml").write_text(dumps(a_mass()))
    text = 'include = "base.toml"\n[[stop]]\nside = "above"\ngap = "0 mm"\nlaw = "my-law.toml"\n'
    (folder / "own.toml").write_text(text)
    case = whirl.Case(folder / "own.toml")
    packed = pickle.dumps(case)
    first = case.run()
    for own in folder.iterdir():
        own.unlink()
    again = pickle.loads(packed).run()
    assert again.history == first.history and again.name == "own"
    sent = pickle.loads(pickle.dumps(first))
    assert sent.history == first.history and sent.summary == first.summary
    assert sent.verdict == first.verdict
    assert pickle.loads(pickle.dumps(whirl.Case("sdnd101"))).name == "sdnd101"
    law = whirl.Law(LAW)
    assert pickle.loads(pickle.dumps(whirl.Case(a_mass(law=law)))).run().history == first.history


def test_another_process_gives_the_same_bits(tmp_path):
    case = whirl.Case(a_rotor())
    (tmp_path / "case").write_bytes(pickle.dumps(case))
    script = "import pickle, sys; r = pickle.load(open('case', 'rb')).run(); pickle.dump(r, open('out', 'wb'))"
    subprocess.run([sys.executable, "-c", script], cwd=tmp_path, check=True)
    sent = pickle.loads((tmp_path / "out").read_bytes())
    assert sent.history == case.run().history


def test_bodies_are_reduced_once_and_may_be_sent(tmp_path):
    bodies = whirl.Bodies()
    first = whirl.Case(a_rotor()).run(bodies=bodies)
    second = whirl.Case(a_rotor()).run(bodies=bodies)
    assert not first.summary.time.reduction_cached and second.summary.time.reduction_cached
    other = whirl.Bodies()
    assert bodies.held() and all(other.adopt(own) for own in bodies.held())
    assert not other.adopt(b"something else")
    third = whirl.Case(a_rotor()).run(bodies=other)
    assert third.summary.time.reduction_cached
    assert first.history == second.history == third.history
    on_disk = whirl.Bodies(str(tmp_path / "kept"))
    whirl.Case(a_rotor()).run(bodies=on_disk)
    assert len(list((tmp_path / "kept").iterdir())) == 1
