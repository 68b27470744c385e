"""Laws with states from tables over the frequency: the same functions, motions and modes, and what is refused."""

import pickle
import warnings

import numpy as np
import pytest

import whirl
from whirl._coefficients import at_one_speed
from whirl._rational import Rational, Samples, fitted

ENTRIES = ("xx", "xy", "yx", "yy")
NAMES = [f"{letter}_{entry}" for letter in "kc" for entry in ENTRIES]
HEAD = ", ".join(f"{own} [{'N/m' if own[0] == 'k' else 'N*s/m'}]" for own in NAMES)

K_0 = np.array([[2e6, 4e5], [-4e5, 2.3e6]])
C_0 = np.array([[200.0, 15.0], [-10.0, 260.0]])
R_1 = np.array([[9e5, -2e5], [1.5e5, 1.2e6]])
R_2 = np.array([[6e5, 1e5], [-2e5, 5e5]])
POLES = np.array([300.0, 1900.0])
ROWS = np.linspace(0.0, 400.0, 21)


def rational(poles=POLES, residues=(R_1, R_2), static=K_0, damper=C_0):
    return Rational(
        static, damper, np.array(poles, dtype=complex), np.array(residues, dtype=complex)
    )


def coefficients(of, frequency_hz, noise=0.0, seed=1):
    """K and C of a function at frequencies, with normally distributed errors of both as shares."""
    omega = 2 * np.pi * np.asarray(frequency_hz, dtype=float)
    values = of(1j * omega)
    divisor = np.where(omega > 0, omega, 1.0)[:, None, None]
    damping = np.where(omega[:, None, None] > 0, values.imag / divisor, of.slope())
    random = np.random.default_rng(seed)
    return [own * (1 + noise * random.standard_normal(own.shape)) for own in (values.real, damping)]


def rows(frequency_hz, stiffness, damping, before=""):
    lines = []
    for at, k, c in zip(frequency_hz, stiffness, damping):
        cells = [float(at), *k.ravel(), *c.ravel()]
        lines.append(before + ", ".join(repr(float(own)) for own in cells))
    return "\n".join(lines) + "\n"


def table(of=None, frequency_hz=ROWS, noise=0.0, seed=1):
    """The text of a table at one speed."""
    own = coefficients(of or rational(), frequency_hz, noise, seed)
    return f"frequency [Hz], {HEAD}\n" + rows(frequency_hz, *own)


def over_speeds(speeds, of, frequency_hz=ROWS):
    """The text of a table over speeds in rpm, of a function of the speed."""
    text = f"speed [rpm], frequency [Hz], {HEAD}\n"
    for speed in speeds:
        text += rows(frequency_hz, *coefficients(of(speed), frequency_hz), before=f"{speed}, ")
    return text


def at_rest(speed):
    """A function whose coefficients are cubic in the speed."""
    return rational(static=K_0 * (1 + (speed / 9000) ** 2))


@pytest.mark.parametrize("poles", [[300.0], [300.0, 1900.0], [40.0, 300.0, 1000.0, 5000.0]])
def test_a_rational_function_is_found_again(poles):
    residues = [R_1, R_2, 0.5 * R_1, R_1 + R_2][: len(poles)]
    of = rational(poles, residues)
    found = whirl.fit_law(table(of), tolerance=1e-6)
    # Least squares of a function of this kind end at rounding; a law has twelve digits.
    np.testing.assert_allclose(found.poles, poles, rtol=1e-6)
    assert found.error < 1e-9 and found.errors.shape == (2, 2)
    for at in (0.0, 17.0, 400.0):
        value = of(2j * np.pi * at)
        np.testing.assert_allclose(found.stiffness(at), value.real, rtol=1e-6)
        slope = value.imag / (2 * np.pi * at) if at else of.slope()
        np.testing.assert_allclose(found.damping(at), slope, rtol=1e-6)
    assert found.stiffness([1.0, 2.0, 3.0]).shape == (3, 2, 2)


def test_a_law_of_the_same_function_has_its_parameters():
    found = whirl.fit_law(table(), name="seal")
    own = {one.name: one.value for one in found.law.parameters}
    for letter, matrix in (("k", K_0), ("c", C_0), ("r1", R_1), ("r2", R_2)):
        for entry, value in zip(ENTRIES, matrix.ravel()):
            assert own[f"{letter}_{entry}"] == pytest.approx(value, rel=1e-6)
    assert own["p1"] == pytest.approx(300.0) and own["p2"] == pytest.approx(1900.0)


def test_noisy_rows_take_no_more_poles_than_there_are():
    for seed in range(1, 6):
        found = whirl.fit_law(table(noise=0.003, seed=seed), tolerance=0.02)
        assert len(found.poles) == 2
        np.testing.assert_allclose(found.poles, POLES, rtol=0.1)
        # The fit lies within the rows: most of their errors are no longer in it.
        for at in (0.0, 100.0, 400.0):
            value = rational()(2j * np.pi * at)
            assert np.abs(found.stiffness(at) - value.real).max() < 0.005 * np.abs(value).max()


def test_fewer_poles_do_where_more_is_allowed():
    errors = []
    for count in range(3):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            found = whirl.fit_law(table(), poles=count)
        assert [own.category for own in caught] == [whirl.WhirlWarning] * (count < 2)
        assert all("is beyond 1 %" in str(own.message) for own in caught)
        assert len(found.poles) == count
        errors.append(found.error)
    assert errors[0] > errors[1] > 0.01 > errors[2]
    assert len(whirl.fit_law(table(), tolerance=1.01 * errors[1]).poles) == 1
    assert len(whirl.fit_law(table(), tolerance=0.99 * errors[1]).poles) == 2


def test_a_conjugate_pair_is_taken_where_real_poles_do_not_do():
    pole, residue = 250 + 900j, (1 + 0.4j) * 2e5 * np.array([[1.0, 0.3], [-0.3, 1.2]])
    of = rational([pole], [residue])
    text = table(of)
    found = whirl.fit_law(text, tolerance=1e-3)
    np.testing.assert_allclose(found.poles, [pole, pole.conjugate()], rtol=1e-6)
    with pytest.raises(whirl.FitError, match="pairs=True"):
        whirl.fit_law(text, tolerance=1e-3, pairs=False)
    states_have_its_stiffness(found, of)


def test_a_table_of_one_row_has_no_states():
    for at in (0.0, 80.0):
        with pytest.warns(whirl.WhirlWarning, match="one frequency"):
            found = whirl.fit_law(table(frequency_hz=[at]))
        stiffness, damping = coefficients(rational(), [at])
        assert len(found.poles) == 0 and found.error == 0
        np.testing.assert_allclose(found.stiffness(33.0), stiffness[0], rtol=1e-11)
        np.testing.assert_allclose(found.damping([0.0, 33.0])[1], damping[0], rtol=1e-11)
        force = found.law(e_x=0.01)["F_x"]
        assert force == pytest.approx(-stiffness[0][0, 0] * 1e-5)


def test_a_table_of_two_rows_has_at_most_one_pole():
    of = rational([500.0], [R_1])
    found = whirl.fit_law(table(of, [0.0, 80.0]), tolerance=1e-6)
    # Of K and C at both rows follows p, as K rises by what C falls times p.
    np.testing.assert_allclose(found.poles, [500.0], rtol=1e-6)
    with pytest.raises(whirl.FitError, match="add rows"):
        whirl.fit_law(table(frequency_hz=[0.0, 80.0]), tolerance=1e-6)


def test_coefficients_between_speeds_are_those_of_analyses(tmp_path):
    speeds = [3000, 5000, 9000, 12000]
    (tmp_path / "seal.csv").write_text(over_speeds(speeds, at_rest))
    at = 6100.0
    own = at_one_speed(tmp_path / "seal.csv", at)
    case = {
        "title": "a seal",
        "body": {"rotor": {**ROTOR, "speed": f"{at} rpm"}},
        "joint": {
            "seal": {
                "kind": "bushing",
                "first": {"body": "rotor", "z": "0 m"},
                "table": "seal.csv",
            },
            **SPRINGS,
        },
    }
    joint = whirl.Case(case, folder=tmp_path).coefficients([3000, 6000, at])["seal"]
    # The analysis has those of the frequency of the rotation, between rows of this table.
    with_it = at_one_speed(over_speeds(speeds, at_rest, [0.0, at / 60, 400.0]), at)
    assert own.stiffness.shape == (21, 2, 2)
    np.testing.assert_allclose(with_it.stiffness[1], joint.K[2], rtol=2e-3)
    exact = whirl.Case(
        case, files={"seal.csv": over_speeds(speeds, at_rest, [0.0, at / 60, 400.0])}
    )
    exact = exact.coefficients([at])["seal"]
    np.testing.assert_allclose(with_it.stiffness[1], exact.K[0], rtol=1e-9)
    np.testing.assert_allclose(with_it.damping[1], exact.C[0], rtol=1e-9)
    # A speed of a table is taken as it is.
    found = whirl.fit_law(tmp_path / "seal.csv", speed="9000 rpm")
    assert found.name == "seal" and found.speed_rpm == pytest.approx(9000)
    np.testing.assert_allclose(found.K[0], at_rest(9000).static, rtol=1e-12)
    in_radians = whirl.fit_law(tmp_path / "seal.csv", speed=f"{300 * np.pi!r} rad/s")
    assert in_radians.text == found.text
    assert "between its rows" in whirl.fit_law(tmp_path / "seal.csv", speed=at).text


def test_units_names_and_separators_are_those_of_the_program():
    plain = whirl.fit_law(table(), name="a")
    stiffness, damping = coefficients(rational(), ROWS)
    text = "# of a test rig\n" + "; ".join(
        [
            '"remark"',
            "frequency [rad/s]",
            *(f"{own} ({'MN/m' if own[0] == 'k' else 'N*s/mm'})" for own in NAMES),
        ]
    )
    # Rows in any order, columns that are not needed.
    order = np.random.default_rng(2).permutation(len(ROWS))
    for place in order:
        cells = [7.0, 2 * np.pi * ROWS[place], *stiffness[place].ravel() / 1e6]
        cells += list(damping[place].ravel() / 1e3)
        text += "\n" + "; ".join(repr(float(own)) for own in cells) + " # a row"
    other = whirl.fit_law(text, name="a")
    np.testing.assert_allclose(other.poles, plain.poles, rtol=1e-9)
    np.testing.assert_allclose(other.stiffness(50.0), plain.stiffness(50.0), rtol=1e-9)
    ratios = table().replace("frequency [Hz]", "frequency_ratio [1]")
    scaled = whirl.fit_law(ratios, speed="60 rpm")
    np.testing.assert_allclose(scaled.poles, plain.poles, rtol=1e-9)
    with pytest.raises(whirl.FitError, match="shares of a speed"):
        whirl.fit_law(ratios)


class ColeCole:
    """K + R √(sτ)/(1 + √(sτ)): relaxation over all times, which no number of poles is."""

    def __call__(self, s):
        root = np.sqrt(np.asarray(s) * 2e-3)[..., None, None]
        return 2e6 * np.array([[1, 0.2], [-0.2, 1.1]]) + 3e6 * np.eye(2) * root / (1 + root)

    def slope(self):
        """Over all bounds at rest: that of the lowest row above."""
        lowest = 2e-3j * np.pi * 5e3
        return self(np.array([lowest])).imag[0] / abs(lowest)


ROTOR = {
    "turns": "prescribed",
    "speed": "9000 rpm",
    "mass": "12 kg",
    "z": "0 m",
    "polar_inertia": "0.05 kg*m^2",
    "transverse_inertia": "0.4 kg*m^2",
}
SPRINGS = {
    name: {
        "kind": "bushing",
        "first": {"body": "rotor", "z": z},
        "stiffness": {"xx": "3e7 N/m", "yy": "3.3e7 N/m"},
        "damping": {"xx": "60 N*s/m", "yy": "60 N*s/m"},
    }
    for name, z in (("left", "-0.3 m"), ("right", "0.4 m"))
}


def held_by(law, **more):
    """A case of a mass in a joint of this law."""
    return whirl.Case(
        {
            "title": "a mass in a seal",
            "body": {
                "rotor": {key: ROTOR[key] for key in ("turns", "speed", "mass", "polar_inertia")}
            },
            "joint": {
                "seal": {
                    "kind": "bearing",
                    "journal": {"body": "rotor"},
                    "law": law,
                    "radial_clearance": "1 mm",
                }
            },
            **more,
        }
    )


MASS = 12.0


def states_have_its_stiffness(found, of):
    """The λ of a mass on the law: m λ² + D(λ) is singular."""
    modes = held_by(found.law).modes(9000)
    checked = 0
    for value in modes.eigenvalue:
        if abs(value.imag) < 1e-3 * abs(value):
            continue
        checked += 1
        dynamic = MASS * value**2 * np.eye(2) + of(value)
        sizes = np.linalg.svd(dynamic, compute_uv=False)
        assert sizes[-1] < 1e-6 * sizes[0], value
    assert checked >= 2


def test_states_of_the_law_are_those_of_the_function(tmp_path):
    found = whirl.fit_law(table(), name="seal")
    states_have_its_stiffness(found, rational())
    # The file is a law as any other.
    path = found.save(tmp_path / "laws" / "seal.toml")
    assert path.read_text() == found.text
    assert whirl.Law(path).text == found.text and "2 poles" in found.text
    assert "law with states" in whirl.explain(path)
    case = held_by(str(path))
    assert "seal" in case.check()
    assert whirl.Law(found.text).name == "seal"


def test_modes_are_those_with_the_table(tmp_path):
    of = ColeCole()
    (tmp_path / "seal.csv").write_text(
        over_speeds([3000, 9000], lambda speed: of, np.linspace(0.0, 600.0, 121))
    )
    found = whirl.fit_law(tmp_path / "seal.csv", speed=9000, tolerance=0.02)
    assert 1e-3 < found.error < 0.02 and 2 <= len(found.poles) <= 5
    place = {"body": "rotor", "z": "0.1 m"}
    seals = (
        {"kind": "bushing", "first": place, "table": "seal.csv"},
        {"kind": "bearing", "journal": place, "law": found.law, "radial_clearance": "1 mm"},
    )
    both = [
        whirl.Case(
            {"title": "a", "body": {"rotor": ROTOR}, "joint": {"seal": own, **SPRINGS}},
            folder=tmp_path,
        ).modes(9000)
        for own in seals
    ]
    oscillating = [
        own.eigenvalue[(own.frequency_hz > 0) & (np.abs(own.damping_ratio) < 0.5)] for own in both
    ]
    assert len(oscillating[0]) == len(oscillating[1]) == 4
    for over_frequency, with_states in zip(*oscillating):
        omega = abs(over_frequency.imag)
        # δλ = −φᵀ δD φ/(2 λ m): the error of the fit, and what D(λ) differs from K + λC of a table, which is of the
        # second order in Re λ; φ of a rigid rotor of this mass and inertia, 0.1 m from its centre.
        size = np.abs(of(np.array([1j * omega]))).max()
        share = 1.0 / MASS + 0.1**2 / 0.4
        curved = abs(over_frequency.real) * size / omega
        bound = share * (2 * found.error * size + curved) / (2 * omega)
        assert abs(over_frequency - with_states) < bound
        assert bound < 0.02 * omega
        # And what the seal changes is much more than that.
        assert share * size / (2 * omega) > 20 * abs(over_frequency - with_states)


@pytest.mark.parametrize("frequency", [25.0, 110.0, 300.0])
def test_a_march_has_the_dynamic_stiffness_of_the_table(frequency):
    found = whirl.fit_law(table(), name="seal")
    motions, forces = [], []
    steps, cycles = 200, 12
    # Transients decay at 60/s at least, see the eigenvalues.
    whole = max(cycles, int(np.ceil(0.2 * frequency)))
    for direction in "xy":
        results = held_by(
            found.law,
            loads={
                "shaker": {
                    "body": "rotor",
                    "force": "30 N",
                    "direction": direction,
                    "frequency": f"{frequency!r} Hz",
                }
            },
            march={
                "time_step": f"{1 / (steps * frequency)!r} s",
                "steps": steps * whole,
                "cycle_frequency": f"{frequency!r} Hz",
                "force_tolerance": "1e-6 N",
            },
        ).run()
        assert results.verdict.sound, str(results.verdict)
        last = slice(-steps, None)
        turn = np.exp(-2j * np.pi * frequency * results["t_s"][last])
        at = ["EX_seal_um", "EY_seal_um", "RX_seal_N", "RY_seal_N"]
        own = [2 * np.mean(results[name][last] * turn) for name in at]
        motions.append(np.array(own[:2]) * 1e-6)
        forces.append(own[2:])
    measured = -np.array(forces).T @ np.linalg.inv(np.array(motions).T)
    stiffness, damping = coefficients(rational(), [frequency])
    wanted = stiffness[0] + 2j * np.pi * frequency * damping[0]
    # Steps of 1/200 of a cycle: (2π/200)²/12 of the trapezoidal rule, less than 1e-4.
    assert np.abs(measured - wanted).max() < 1e-3 * np.abs(wanted).max()
    assert (np.abs(measured - wanted) < 0.01 * np.abs(wanted)).all()


def test_a_run_at_another_speed_is_not_sound():
    both = over_speeds([3000, 9000], lambda speed: rational())
    found = whirl.fit_law(both, speed=3000, name="seal")
    march = {"time_step": "1e-5 s", "steps": 4000, "force_tolerance": "1e-6 N"}
    load = {"shaker": {"body": "rotor", "force": "30 N", "frequency": "50 Hz"}}
    results = held_by(found.law, march=march, loads=load).run()
    assert not results.verdict.sound
    assert any("speed" in own.what for own in results.verdict.findings)
    own = whirl.fit_law(both, speed=9000, name="seal")
    assert held_by(own.law, march=march, loads=load).run().verdict.sound


def test_what_is_wrong_with_a_table_is_said(tmp_path):
    def refused(text, *words, **options):
        with pytest.raises(whirl.CaseError) as raised:
            whirl.fit_law(text, **options)
        shown = str(raised.value)
        for word in words:
            assert word in shown, shown
        return raised.value.diagnostics

    text = table()
    first = refused(text.replace("k_xy [N/m]", "k_zz [N/m]"), "no column `k_xy`", "k_yx, k_yy")[0]
    assert (first.file, first.line) == ("table.csv", 1) and first.help and first.code == "E033"
    wrong = refused(text.replace("c_yy [N*s/m]", "c_yy [N/m]"), "c_yy [N*s/m]", "^^^^")[0]
    assert wrong.code == "E021" and wrong.column == text.split("\n")[0].index("c_yy") + 1
    refused(text.replace("c_yy [N*s/m]", "c_yy [N*s/metre]"), "unknown unit `metre`", "m")
    refused(text.replace("c_yy [N*s/m]", "c_yy"), "has no unit")
    refused(text.replace("frequency [Hz]", "frequency [N]"), "no unit of the column `frequency`")
    refused(text.replace("frequency [Hz]", "frequency [1]"), "no unit of the column `frequency`")
    refused(text.replace("frequency [Hz]", "speed [rpm]"), "no column `frequency`", "bushing")
    refused(
        "speed [Hz], " + text.split("\n")[0] + "\n" + "1, " * 9 + "1\n",
        "no unit of the column `speed`",
    )
    refused(text.replace("k_xy [N/m]", "k_xx [N/m]"), "two columns are called `k_xx`")
    refused(text.replace("\n20.0", "\n-20.0"), "zero or more, not -20.0")
    refused(text.replace("\n20.0", "\n40.0"), "given twice")
    refused(text.replace("\n20.0", "\ntwenty"), "expected a number, found `twenty`")
    refused(text.replace("\n20.0,", "\n20.0, 1,"), "10 values", "9 columns")
    refused(text.replace("\n20.0,", "\n"), "no value in the column `c_yy`")
    refused(text.split("\n")[0] + "\n", "no rows")
    refused("1, 2\n3, 4\n", "no line of names")
    # Everything that is wrong is said at once.
    both = text.replace("k_xx [N/m]", "k_xx").replace("c_xx [N*s/m]", "c_xx")
    assert len(refused(both, "k_xx", "c_xx")) == 2
    with pytest.raises(whirl.WhirlError, match="cannot read"):
        whirl.fit_law(tmp_path / "seal.csv")
    with pytest.raises(TypeError, match="path of a file or its text"):
        whirl.fit_law(3)


def test_poles_decay_whatever_the_rows_are():
    for seed in range(8):
        for count in (1, 2, 3, 4):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", whirl.WhirlWarning)
                found = whirl.fit_law(table(noise=0.3, seed=seed), poles=count)
            assert len(found.poles) == count and (found.poles.real > 0).all()


def test_the_largest_error_falls_where_rows_count_more():
    """Of a relaxation over all times most rows are of high frequency, most of the error at low ones."""
    rows_hz = np.linspace(0.0, 600.0, 121)
    own = Samples(2 * np.pi * rows_hz, *coefficients(ColeCole(), rows_hz))
    of_squares, evened = fitted(own, 4), fitted(own, 4, tolerance=0.01)
    assert own.errors(evened).max() < 0.01 < 0.3 * own.errors(of_squares).max()


def test_what_cannot_be_asked_of_a_table_is_said():
    def refused(text, match, **options):
        with pytest.raises(whirl.FitError, match=match) as raised:
            whirl.fit_law(text, **options)
        assert isinstance(raised.value, whirl.WhirlError) and isinstance(raised.value, ValueError)

    text = table()
    both = over_speeds([3000, 9000], at_rest)
    refused(both, "2 speeds.*9000 rpm")
    refused(both, "outside the speeds.*3000 to 9000 rpm", speed="12000 rpm")
    refused(both, "outside", speed=2999)
    refused(both, "`9000` is no speed", speed="9000")
    refused(both, "`Hz` is no unit of a speed", speed="150 Hz")
    refused(both, "`rmp` is no unit of a speed", speed="9000 rmp")
    other = both + rows([7.0], *coefficients(rational(), [7.0]), before="9000, ")
    refused(other, "different frequencies", speed=5000)
    assert len(whirl.fit_law(other, speed=3000).frequency_hz) == 21
    refused(table(frequency_hz=ROWS[:3]), "takes 4 frequencies.*has 3", poles=3)
    refused(table(frequency_hz=ROWS[:1]), "takes 2 frequencies.*has 1", poles=1)
    refused(text, "`poles` is a whole number", poles=1.5)
    refused(text, "`poles` is a whole number", poles=-1)
    refused(text, "`tolerance` is a share", tolerance=1)
    refused(text, "no name of a law", name="a seal")
    refused(text.split("\n")[0] + "\n" + "0, " * 8 + "0\n", "all coefficients .* zero")
    with pytest.raises(TypeError, match="speed"):
        whirl.fit_law(both, speed=[9000])
    # States that grow: K rises as with those that decay, and C rises, too.
    growing = rational([-400.0], [np.eye(2) * 1e6])
    refused(table(growing, ROWS[1:]), r"own states grow \(p = -400 1/s\).*signs of the damping")
    # Nothing of this kind: rows that go up and down.
    jagged = table(noise=0.3)
    refused(jagged, "no law keeps 1 %.*best with up to 8 poles", pairs=False)


def test_what_limits_a_law_is_told_of():
    # A damping that is negative above the rows.
    driving = rational([3000.0], [np.eye(2) * 3e6], damper=-100 * np.eye(2))
    with pytest.warns(whirl.WhirlWarning, match="above the rows its damping becomes negative"):
        found = whirl.fit_law(table(driving), tolerance=1e-6)
    assert any("negative" in note for note in found.notes) and "# Note: above" in found.text
    # Without C₀ where that does: a spring and a damper in series, with errors.
    in_series = rational([900.0], [np.eye(2) * 3e6], damper=np.zeros((2, 2)))
    for seed in range(6):
        found = whirl.fit_law(table(in_series, noise=0.002, seed=seed), name="seal")
        assert not found.notes
        own = {one.name: one.value for one in found.law.parameters}
        assert own.get("c_xx", 0.0) >= 0 and own.get("c_yy", 0.0) >= 0
    with pytest.warns(whirl.WhirlWarning, match="stiffness at rest is extrapolated"):
        whirl.fit_law(table(frequency_hz=np.linspace(300.0, 400.0, 11)), tolerance=1e-6)
    for words in ("this speed alone", "small motions", "Beyond the rows"):
        assert words in " ".join(found.text.replace("\n#", " ").split())


def test_the_energy_of_its_springs_is_theirs():
    """Of a mass that swings on springs that relax, by its states as they follow from its motion."""
    of = rational(
        static=np.diag([2e6, 1.5e6]),
        damper=np.zeros((2, 2)),
        residues=(np.array([[9e5, 2e5], [2e5, 1.2e6]]), 6e5 * np.eye(2)),
    )
    found = whirl.fit_law(table(of), name="seal")
    assert "r1_xx*d1_x^2 + (r1_xy + r1_yx)*d1_x*d1_y" in found.text
    results = held_by(
        found.law,
        loads={"shaker": {"body": "rotor", "force": "30 N", "frequency": "70 Hz"}},
        march={"time_step": "2e-5 s", "steps": 2000, "force_tolerance": "1e-6 N"},
    ).run()
    assert results.verdict.sound, str(results.verdict)
    motion = 1e-6 * np.stack([np.append(0.0, results[f"E{axis}_seal_um"]) for axis in "XY"])
    stored = motion[:, -1] @ of.static @ motion[:, -1] / 2
    for pole, residue in zip(of.poles.real, of.residues.real):
        # ẇ = p (e − w), trapezoidal rule.
        step = 1e-5 * pole
        state = np.zeros(2)
        for before, after in zip(motion.T[:-1], motion.T[1:]):
            state = ((1 - step) * state + step * (before + after)) / (1 + step)
        stretch = motion[:, -1] - state
        stored += stretch @ residue @ stretch / 2
    energy = results.summary.energy_balance_j
    assert energy["spring_stored"] == pytest.approx(stored, rel=1e-3)
    assert energy["spring_dissipated"] > 0


def test_a_fit_is_pickled_and_plotted():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    found = whirl.fit_law(table(), name="seal")
    again = pickle.loads(pickle.dumps(found))
    assert again.text == found.text and again.law.text == found.text
    assert np.array_equal(again.stiffness(5.0), found.stiffness(5.0))
    assert "2 poles" in repr(found)
    upper, lower = found.plot()
    lines = upper.get_lines()
    assert np.array_equal(lines[1].get_ydata(), found.K[:, 0, 0])
    x, y = lines[0].get_data()
    assert np.array_equal(y, found.stiffness(x)[:, 0, 0])
    assert "N·s/m" in lower.get_ylabel()
    assert found.plot((upper, lower))[0] is upper
    matplotlib.pyplot.close("all")
