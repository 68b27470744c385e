"""Figures of results: what is drawn is what there is."""

import json

import numpy as np
import pytest
from conftest import a_mass

import whirl
from whirl.history import Column, History

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")

SPEED = 2.0 * np.pi * 50.0


def an_ellipse(forward=8.0, backward=3.0, sense=1.0):
    """Results of a journal on an ellipse, 100 rows a revolution, twenty revolutions."""
    time = np.arange(1, 2001) * 2e-4
    angle = sense * SPEED * time
    x = (forward + backward) * np.cos(angle)
    y = (forward - backward) * np.sin(angle)
    columns = {"t_s": time, "theta_rad": angle, "X_left_um": x, "Y_left_um": y}
    columns |= {"EX_left_um": x, "EY_left_um": y}
    units = ["s", "rad", "um", "um", "um", "um"]
    facts = [Column(name, unit, name) for name, unit in zip(columns, units)]
    verdict = {"sound": True, "findings": [], "measures": {}}
    summary = {"supports": [{"clearance_um": 20.0}], "cycle_s": 0.04, "verdict": verdict}
    history = History(np.stack(list(columns.values()), axis=1), facts)
    return whirl.Results("a", "an <ellipse>", history, json.dumps(summary))


def test_an_orbit_is_that_of_the_last_revolutions():
    results = an_ellipse()
    axes = results.plot_orbit("left", revolutions=2)
    orbit, circle, seen = axes.get_lines()
    y, x = orbit.get_data()
    assert len(x) == 201
    assert np.array_equal(x, results["EX_left_um"][-201:])
    assert np.array_equal(y, results["EY_left_um"][-201:])
    assert np.allclose(np.hypot(*circle.get_data()), 20.0)
    # θ is a whole number of revolutions where x is largest.
    y, x = seen.get_data()
    assert np.allclose(x, 11.0) and np.allclose(y, 0.0, atol=1e-9) and len(x) in (2, 3)
    assert axes.get_aspect() in (1.0, "equal")
    with pytest.raises(KeyError, match="left"):
        results.plot_orbit("rigth")
    matplotlib.pyplot.close("all")


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_spectrum_parts_an_ellipse_into_its_circles(sense):
    frequency, amplitude = an_ellipse(sense=sense)._spectrum("_left", 16)
    for at, known in ((50.0 * sense, 8.0), (-50.0 * sense, 3.0), (25.0, 0.0)):
        line = np.argmin(np.abs(frequency - at))
        assert abs(amplitude[line] - known) < 1e-6, at
    axes = an_ellipse(sense=sense).plot_spectrum()
    (line,) = axes.get_lines()
    assert abs(line.get_ydata().max() - 8.0) < 1e-6
    assert "0-pk" in axes.get_ylabel()
    matplotlib.pyplot.close("all")


def test_histories_of_one_unit_share_axes():
    results = whirl.Case(a_mass()).run()
    axes = results.plot_history(["RX1_N", "RY1_N"])
    assert np.array_equal(axes.get_lines()[0].get_ydata(), results["RX1_N"])
    assert axes.get_xlabel() == "time (s)" and "N" in axes.get_ylabel()
    with pytest.raises(ValueError, match="one unit"):
        results.plot_history(["RX1_N", "X1_um"])
    matplotlib.pyplot.close("all")


def test_a_notebook_shows_the_verdict_and_the_orbits():
    shown = an_ellipse()._repr_html_()
    assert "sound" in shown and "an &lt;ellipse&gt;" in shown
    assert shown.count("<svg") == 1 and "<circle" in shown
    assert "2000 rows" in whirl.Results.__repr__(an_ellipse())
    mass = whirl.Case(a_mass()).run()._repr_html_()
    assert "sound" in mass and mass.startswith("<div>") and mass.endswith("</div>")


def test_campbell_diagrams_and_bode_plots_have_their_numbers():
    case = whirl.Case("weight")
    diagram = case.campbell("500 rpm .. 9000 rpm, 9")
    axes = diagram.plot()
    first = axes.get_lines()[0].get_ydata()
    assert np.array_equal(first, diagram.frequency_hz[0], equal_nan=True)
    marked = [own for own in axes.get_lines() if own.get_label() == "critical speed"]
    assert np.array_equal(marked[0].get_xdata(), diagram.criticals.speed_rpm)
    excited = case.response("500 rpm .. 6000 rpm, 12")["rotor"]
    upper, lower = excited.plot("joint.left")
    assert np.array_equal(upper.get_lines()[0].get_ydata(), excited.x_um[0])
    turned = lower.get_lines()[0].get_ydata() - excited.x_phase_deg[0]
    assert np.allclose(turned / 360.0, np.round(turned / 360.0))
    with pytest.raises(KeyError, match="joint.left"):
        excited.plot("joint.lefd")
    matplotlib.pyplot.close("all")

def test_what_no_figure_can_be_of_is_said():
    results = whirl.Case({"include": "weight.toml", "march": {"duration": "30 ms"}}).run()
    for wrong in (-1, 0, float("nan")):
        with pytest.raises(ValueError, match="revolutions is a number above zero"):
            results.plot_orbit(revolutions=wrong)
    for wrong in (0, 1.5, -3):
        with pytest.raises(ValueError, match="cycles is a whole number"):
            results.plot_spectrum(cycles=wrong)
    short = whirl.Case({"include": "weight.toml", "march": {"duration": "1e-4 s"}}).run()
    with pytest.raises(ValueError, match="rows: this figure takes"):
        short.plot_spectrum()
