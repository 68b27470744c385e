"""Laws: values, derivatives, curves, pages."""

import numpy as np
import pytest
from conftest import LAW

import whirl


def test_values_are_those_of_the_formula():
    law = whirl.Law(LAW)
    h = np.linspace(-0.02, 0.02, 101)
    expected = np.where(h < 0, 40000 * np.abs(h) ** 1.5, 0.0)
    np.testing.assert_allclose(law(h=h), expected, rtol=1e-13, atol=1e-12)
    assert law(h=-0.01) == pytest.approx(40.0) and law(h=-0.01).shape == ()
    assert law(h=h.reshape(1, 101)).shape == (1, 101)
    slope = law.derivative("Q", "h", h=h)
    np.testing.assert_allclose(slope, np.where(h < 0, -60000 * np.sqrt(np.abs(h)), 0), rtol=1e-12)


def test_a_law_says_what_it_is():
    law = whirl.Law(LAW)
    assert (law.name, law.inputs[0].name, law.inputs[0].unit) == ("my-law", "h", "mm")
    assert law.outputs[0].unit == "N" and law.parameters[0].value == 40000
    page = law.explain()
    assert "my-law" in page and "40000" in page
    assert whirl.explain(LAW).splitlines()[0] == page.splitlines()[0]
    assert "hex8" in whirl.explain("hex8")


def test_inputs_broadcast_and_are_named():
    law = whirl.Law("ocvirk")
    names = [own.name for own in law.inputs]
    values = law(**{names[0]: np.linspace(1, 2, 3)[:, None], names[1]: np.linspace(1, 2, 4)})
    for value in values.values() if isinstance(values, dict) else [values]:
        assert value.shape == (3, 4)
    with pytest.raises(TypeError, match="did you mean|there are"):
        law(nothing=1.0)
    with pytest.raises(TypeError, match="takes numbers in"):
        law(**{names[0]: "wide"})
    with pytest.raises(ValueError, match="do not broadcast"):
        law(**{names[0]: np.zeros(3), names[1]: np.zeros(4)})
    with pytest.raises(KeyError, match="no output"):
        law.derivative("nothing", names[0])
    assert whirl.Law(LAW)(h=np.zeros(0)).shape == (0,)


def test_every_built_in_curve_can_be_plotted():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    law = whirl.Law("greenwood-tripp")
    axes = law.plot()
    assert len(axes) == len(law.curves()) and axes[0].get_xlabel()
    curve = law.curves()[0]
    assert curve.x.shape == curve.y.shape and curve.x.ndim == 1
    pyplot.close("all")


def test_what_is_wrong_with_a_law_is_said():
    with pytest.raises(whirl.CaseError) as raised:
        whirl.Law(LAW.replace('unit = "N"', 'unit = "kg"'), name="mine")
    assert raised.value.diagnostics[0].file == "mine.toml"
    with pytest.raises(whirl.CaseError, match="hertz-cylinder"):
        whirl.Law("hertz-cilinder")
    with pytest.raises(whirl.CaseError, match="not a law"):
        whirl.Law("hex8")
    with pytest.raises(TypeError, match="a law is a name"):
        whirl.Law(3)

def test_what_is_no_number_has_no_force():
    for name in ("hertz-cylinder", "gap-linear", "ocvirk"):
        law = whirl.Law(name)
        first = law.inputs[0].name
        values = law(**{first: [np.nan, 1e-3]})
        for value in values.values() if isinstance(values, dict) else [values]:
            assert np.isnan(value[0]) and np.isfinite(value[1])
        for wrong in (None, "1", b"1", True):
            with pytest.raises(TypeError, match="takes numbers in"):
                law(**{first: wrong})
