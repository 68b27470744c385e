"""Linear analyses have the numbers of the command, and are objects of Python."""

import pathlib
import pickle
import subprocess
import threading
import time

import numpy as np
import pytest

import whirl


def by_the_command(command, folder, *arguments):
    """The files that the command writes, by their names."""
    line = [command, *arguments, "--out", "out", "--quiet"]
    done = subprocess.run(line, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    files = {own.name: own.read_bytes() for own in pathlib.Path(folder / "out").iterdir()}
    # What the command tells of them is no table.
    return {name: files[name] for name in files if name != "analyses.json"}


KINDS = {
    "modes": (["--speeds", "3000 rpm"], "3000 rpm"),
    "campbell": (["--speeds", "500 rpm .. 9000 rpm, 9"], "500 rpm .. 9000 rpm, 9"),
    "stability": (["--speeds", "3000 rpm .. 9000 rpm, 7"], "3000 rpm .. 9000 rpm, 7"),
    "response": (["--speeds", "500 rpm .. 6000 rpm, 12"], "500 rpm .. 6000 rpm, 12"),
    "coefficients": (["--speeds", "500 rpm .. 9000 rpm, 5"], "500 rpm .. 9000 rpm, 5"),
    "matrices": (["--speed", "3000 rpm"], "3000 rpm"),
}


@pytest.mark.parametrize("kind", KINDS)
def test_numbers_are_those_of_the_command(command, kind, tmp_path):
    arguments, speeds = KINDS[kind]
    pictures = [] if kind == "matrices" else ["--no-figures", "--no-report"]
    theirs = by_the_command(command, tmp_path, kind, "weight", *arguments, *pictures)
    own = getattr(whirl.Case("weight"), kind)(speeds)
    assert isinstance(own, whirl.Analysis) and own.kind == kind and str(own)
    own.save(tmp_path / "own")
    mine = {file.name: file.read_bytes() for file in (tmp_path / "own").iterdir()}
    assert mine == theirs
    again = pickle.loads(pickle.dumps(own))
    assert type(again) is type(own) and again.text == own.text


def test_a_table_of_the_case_is_analysed_by_its_name(command, tmp_path):
    theirs = by_the_command(command, tmp_path, "analyse", "weight", "campbell", "--no-figures", "--no-report")
    own = whirl.Case("weight").analyse("campbell")
    assert isinstance(own, whirl.Campbell)
    assert own._files == theirs
    with pytest.raises(whirl.WhirlError, match="no analysis `campbel`.*|campbell"):
        whirl.Case("weight").analyse("campbel")
    with pytest.raises(TypeError, match="str"):
        whirl.Case("weight").analyse(3)


def test_arrays_are_the_cells_of_the_tables(nothing_written):
    diagram = whirl.Case("weight").campbell("500 rpm .. 9000 rpm, 18", orders=[0.5, 1])
    branches, speeds = diagram.frequency_hz.shape
    assert diagram.speed_rpm.shape == (speeds,) == (18,) and branches >= 3
    table = diagram.table
    for row in (0, table.rows // 2, table.rows - 1):
        branch = int(table["branch"][row]) - 1
        place = int(np.flatnonzero(diagram.speed_rpm == table["speed_rpm"][row])[0])
        assert diagram.frequency_hz[branch, place] == table["frequency_hz"][row]
        assert diagram.eigenvalue[branch, place].real == table["real_1_s"][row]
        assert diagram.whirl[branch, place] == table["whirl"][row]
    listed = np.isfinite(diagram.frequency_hz)
    assert listed.sum() == table.rows and (diagram.whirl != "").sum() == table.rows
    # δ = −2π Re λ/Im λ.
    value = diagram.eigenvalue[listed]
    decrement = -2 * np.pi * value.real / value.imag
    assert np.allclose(decrement, diagram.log_decrement[listed], rtol=1e-12, atol=0)
    criticals = diagram.criticals
    assert len(criticals) > 0 and set(criticals.order) <= {0.5, 1.0}
    turning = criticals.order * criticals.speed_rpm / 60
    assert np.allclose(criticals.frequency_hz, turning, rtol=1e-6, atol=0)
    assert list(diagram.thresholds.unstable_above) == [True]
    assert diagram.thresholds.speed_rpm[0] == pytest.approx(6183.28, abs=0.01)
    only = whirl.Case("weight").critical_speeds("500 rpm .. 9000 rpm, 18", orders=[0.5, 1])
    assert np.array_equal(only.speed_rpm, criticals.speed_rpm)
    with pytest.raises(ValueError, match="read-only"):
        diagram.frequency_hz[0, 0] = 0.0


def test_stability_and_response_and_coefficients():
    case = whirl.Case("weight")
    stability = case.stability("3000 rpm .. 9000 rpm, 7")
    assert stability.stable.dtype == np.bool_
    assert np.array_equal(stability.stable, stability.least_log_decrement > 0)
    assert len(stability.thresholds) == 1
    response = case.response("1000 rpm .. 6000 rpm, 6")
    excited = response["rotor"]
    assert excited.order == 1 and excited.points == ("joint.left", "joint.right")
    assert excited.major_um.shape == excited.x_um.shape == (2, 6)
    orbit = np.hypot(*excited.orbit("joint.left", 3, 20001))
    assert orbit.max() == pytest.approx(excited.major_um[0, 3], rel=1e-6)
    assert orbit.min() == pytest.approx(abs(excited.minor_um[0, 3]), rel=1e-6)
    with pytest.raises(KeyError, match="rotor, order 1"):
        response["rotor", 3]
    with pytest.raises(KeyError, match="joint.left"):
        excited.orbit("joint.lef", 0)
    joint = case.coefficients([3000, 6000])["left"]
    assert joint.K.shape == joint.C.shape == (2, 2, 2)
    assert joint.speed_rpm == pytest.approx([3000, 6000])
    # The weight is carried by both bearings alike.
    assert np.hypot(*joint.force_N.T) == pytest.approx(60 * 9.81 / 2, rel=1e-6)
    assert (joint.eccentricity_ratio > 0).all() and (joint.eccentricity_ratio < 1).all()


def test_matrices_have_the_modes():
    case = whirl.Case("weight")
    matrices, modes = case.matrices(3000), case.modes(3000)
    size = len(matrices.coordinates)
    for own in (matrices.mass, matrices.damping, matrices.stiffness):
        assert own.shape == (size, size)
    assert matrices.speeds == {"rotor": pytest.approx(3000 * 2 * np.pi / 60)}
    values = np.linalg.eigvals(matrices.A)
    for own in modes.eigenvalue:
        assert abs(values - own).min() < 1e-6 * abs(own)
    with pytest.raises(whirl.WhirlError, match="one speed"):
        case.matrices([1000, 2000])


def test_speeds_are_texts_or_numbers_in_rpm():
    case = whirl.Case("weight")
    texts = case.modes(["1000 rpm", "3000 rpm"])
    numbers = case.modes(np.array([3000.0, 1000.0]))
    assert texts._files == numbers._files
    one = case.modes(np.float64(3000.0), count=2)
    assert len(one.frequency_hz) == 2
    assert case.modes("314.1592653589793 rad/s", count=2).frequency_hz == pytest.approx(
        one.frequency_hz
    )
    with pytest.raises(whirl.CaseError, match="speed"):
        case.modes("3 m")
    with pytest.raises(whirl.CaseError, match="there is no body `roto`"):
        case.modes(3000, of="roto")
    with pytest.raises(whirl.CaseError, match="roto"):
        case.modes(3000, ratios={"roto": 2.0})
    with pytest.raises(whirl.WhirlError, match="count"):
        case.modes(3000, count=0)
    with pytest.raises(whirl.WhirlError, match="order"):
        case.campbell(orders=[-1])
    with pytest.raises(TypeError, match="rpm"):
        case.modes(object())
    with pytest.raises(ValueError, match="no speeds"):
        case.modes([])


def rotor(**more):
    """A rigid rotor on springs, without [march]."""
    spring = {
        "kind": "bushing",
        "stiffness": {"xx": "1e6 N/m", "yy": "1e6 N/m"},
        "damping": {"xx": "30 N*s/m", "yy": "30 N*s/m"},
    }
    return {
        "title": "a rigid rotor",
        "body": {
            "rotor": {
                "turns": "prescribed",
                "speed": "3000 rpm",
                "mass": "12 kg",
                "z": "0 m",
                "polar_inertia": "0.05 kg*m^2",
                "transverse_inertia": "0.4 kg*m^2",
            }
        },
        "joint": {
            name: {**spring, "first": {"body": "rotor", "z": z}}
            for name, z in (("left", "-0.3 m"), ("right", "0.3 m"))
        },
        **more,
    }


def test_a_case_without_march_is_analysed_and_not_run():
    case = whirl.Case(rotor())
    shift = np.sqrt(2e6 / 12) / (2 * np.pi)
    assert abs(case.modes(0).frequency_hz - shift).min() < 1e-3 * shift
    for run in (case.run, lambda: whirl.sweep(case, {"body.rotor.mass": ["10 kg", "12 kg"]})):
        with pytest.raises(whirl.CaseError, match="march") as raised:
            run()
        assert raised.value.diagnostics[0].help
    only = whirl.Case(rotor(title="one", analysis={"now": {"kind": "modes"}}))
    assert len(only.analyse("now").frequency_hz) > 2
    with pytest.raises(whirl.WhirlError, match="analysed, not run"):
        only.run()


def test_what_has_no_type_of_its_own_has_tables():
    lateral = {"kind": "lateral", "minimum_speed": "2000 rpm", "maximum_speed": "4000 rpm"}
    case = {
        "include": "weight.toml",
        "title": "lateral",
        "analysis": {
            "api": {
                **lateral,
                "variants": {"tight": {"set": ["joint.left.radial_clearance = 120 um"]}},
            }
        },
    }
    own = whirl.Case(case).analyse("api")
    assert type(own) is whirl.Analysis and set(own.table["pass"]) <= {"yes", "NO", "level II", ""}
    assert {"as given", "tight"} <= set(own.table["variant"])
    assert any("clearance" in note or "stages" in note for note in own.notes)


def test_a_machine_that_does_not_stand_is_an_error():
    with pytest.raises(whirl.WhirlError):
        whirl.Case("weight").modes(0)
    # Of several speeds those that are left out are told of.
    found = whirl.Case("weight").modes([0, 3000])
    assert any("left out" in note for note in found.notes)


def test_threads_of_python_run_meanwhile():
    counted = [0]
    stop = threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    case = whirl.Case("weight")
    case.modes(3000)
    thread.start()
    before = counted[0]
    case.campbell("500 rpm .. 9000 rpm, 400")
    during = counted[0] - before
    stop.set()
    thread.join()
    assert during > 5


def test_ctrl_c_ends_an_analysis():
    import _thread

    case = whirl.Case("hu2003-2")
    case.modes(3000)
    timer = threading.Timer(0.3, _thread.interrupt_main)
    timer.start()
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        # It would take minutes.
        case.campbell("500 rpm .. 9000 rpm, 10000")
    assert time.monotonic() - started < 30
    timer.join()
    assert len(case.modes(3000).frequency_hz) > 0

def test_numbers_are_told_from_texts():
    case = whirl.Case("weight")
    assert case.campbell("500 rpm .. 3000 rpm, 4", orders=2).kind == "campbell"
    for wrong in (
        {"speeds": b"3000 rpm"},
        {"speeds": True},
        {"orders": "12"},
        {"ratios": 3},
        {"ratios": {"rotor": "2"}},
    ):
        with pytest.raises(TypeError, match="number"):
            case.campbell(**wrong)
    with pytest.raises(ValueError, match="ratio of rotor"):
        case.modes("3000 rpm", ratios={"rotor": np.nan})
    for count in (-1, 2**70, 1.5):
        with pytest.raises(ValueError, match="how many modes"):
            case.modes("3000 rpm", count=count)
