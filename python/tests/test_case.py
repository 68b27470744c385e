"""Cases from files, dicts and texts, and what is said of those that are wrong."""

import pathlib

import numpy as np
import pytest
from conftest import LAW, a_mass, a_rotor

import whirl


def test_a_case_is_a_name_a_file_a_text_or_a_dict(tmp_path):
    built_in = whirl.Case("sdnd101")
    assert built_in.name == "sdnd101" and "stop" in built_in.title and built_in.steps == 20_000
    text = whirl.Case('include = "sdnd101.toml"\ntitle = "mine"\n', name="mine")
    assert (text.name, text.title) == ("mine", "mine")
    path = tmp_path / "on-disk.toml"
    path.write_text('include = "sdnd101.toml"\n')
    for own in (path, str(path)):
        assert whirl.Case(own).name == "on-disk"
    assert whirl.Case({"include": "sdnd101.toml"}).steps == 20_000
    assert "hu2003-5" in whirl.cases()


def test_nothing_is_written(nothing_written):
    case = whirl.Case(a_rotor())
    assert "rotor" in case.check()
    case.run()
    whirl.Case(a_mass(law=whirl.Law(LAW))).run()


def test_values_of_a_dict_may_be_those_of_numpy():
    plain = whirl.Case(a_mass(steps=40)).run()
    case = a_mass(steps=np.int64(40))
    case["march"]["time_step"] = np.str_("2e-5 s")
    case["stop"] = tuple(case["stop"])
    case["source"] = None
    assert whirl.Case(case).run().history == plain.history


@pytest.mark.parametrize(
    "value, said",
    [
        (object(), "`march.steps` is of the type object"),
        ({1, 2}, "`march.steps` is of the type set"),
        (float("nan"), "numbers of a case are finite"),
        (b"4", "`march.steps` is of the type bytes"),
        ({1: 2}, "keys of a case are texts"),
        (1 + 2j, "`march.steps` is of the type complex"),
        (np.array([np.inf]), "`march.steps.0` is of the type float"),
    ],
)
def test_what_a_case_cannot_have_is_said_with_its_place(value, said):
    with pytest.raises(TypeError, match="`march"):
        whirl.Case(a_mass(steps=value))
    with pytest.raises(whirl.WhirlError) as raised:
        whirl.Case(a_mass(steps=value))
    assert said in str(raised.value)


def test_other_things_are_no_cases():
    for source in (3, None, ["a"], b"x"):
        with pytest.raises(TypeError, match="a case is a path, a name, a text or a dict"):
            whirl.Case(source)
    with pytest.raises(ValueError, match="name of a case"):
        whirl.Case(a_mass(), name="a/b")


def test_errors_have_file_line_caret_and_help():
    text = 'include = "sdnd101.toml"\n[march]\nstepz = 4\n'
    with pytest.raises(whirl.CaseError) as raised:
        whirl.Case(text, name="wrong")
    (found,) = raised.value.diagnostics
    assert (found.file, found.line, found.column) == ("wrong.toml", 3, 1)
    assert "stepz" in found.message and "steps" in found.help and found.code
    assert "stepz = 4" in str(raised.value) and "^" in str(raised.value)
    assert isinstance(raised.value, ValueError) and isinstance(raised.value, whirl.WhirlError)


def test_units_that_do_not_fit_are_said():
    case = a_mass(velocity="1 kg")
    with pytest.raises(whirl.CaseError) as raised:
        whirl.Case(case)
    (found,) = raised.value.diagnostics
    assert "kg" in str(found) and 'velocity = "1 kg"' in found.text


def test_all_errors_are_said_at_once():
    case = a_mass(steps="many", velocity="1 kg")
    case["stop"][0]["law"] = "gap-linear-1e7"
    with pytest.raises(whirl.CaseError) as raised:
        whirl.Case(case)
    assert len(raised.value.diagnostics) == 3
    assert any("gap-linear-1e" in (own.help or "") for own in raised.value.diagnostics)


def test_names_that_are_not_there_have_the_nearest():
    with pytest.raises(whirl.CaseError, match="hu2003-5"):
        whirl.Case("hu2003-55")
    with pytest.raises(whirl.CaseError, match="folder, not a case"):
        whirl.Case(pathlib.Path("."))


def test_a_law_may_be_a_text_a_path_or_an_object(tmp_path):
    law = tmp_path / "my-law.toml"
    law.write_text(LAW)
    of_object = whirl.Case(a_mass(law=whirl.Law(LAW))).run()
    of_path = whirl.Case(a_mass(law=law)).run()
    of_text = whirl.Case(a_mass(law="own.toml"), files={"own.toml": LAW}).run()
    of_file = whirl.Case(a_mass(law="own.toml"), files={"own.toml": law}).run()
    assert of_object.history == of_path.history == of_text.history == of_file.history
    beside = whirl.Case(a_mass(law="my-law.toml"), folder=tmp_path).run()
    assert beside.history == of_path.history
    with pytest.raises(TypeError, match="a text, a path or a law"):
        whirl.Case(a_mass(), files={"own.toml": 3})


def test_two_laws_of_one_name_stay_apart():
    other = LAW.replace("40000", "50000")
    case = a_mass()
    case["stop"] = [
        {"side": "above", "gap": "0 mm", "law": whirl.Law(LAW)},
        {"side": "below", "gap": "0 mm", "law": whirl.Law(other)},
    ]
    assert whirl.Case(case).run()["RX1_N"].min() < 0
    stiff = whirl.Case(a_mass(law=whirl.Law(other))).run()
    assert stiff["RX1_N"].min() != whirl.Case(a_mass(law=whirl.Law(LAW))).run()["RX1_N"].min()


def test_an_error_in_a_law_is_at_its_line():
    with pytest.raises(whirl.CaseError) as raised:
        whirl.Case(a_mass(law="own.toml"), files={"own.toml": LAW.replace("k*(-h)", "kk*(-h)")})
    (found,) = raised.value.diagnostics
    assert found.file == "own.toml" and found.line == 15 and "kk" in found.message


def test_columns_say_their_units():
    columns = {own.name: own for own in whirl.Case(a_rotor()).columns()}
    assert columns["t_s"].unit == "s" and columns["omega_rad_s"].unit == "rad/s"
    assert columns["RX_left_N"].unit == "N" and "left" in columns["RX_left_N"].meaning
