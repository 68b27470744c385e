"""Cases from rotors of ROSS: from saved files, and from the program itself where it is installed."""

import gzip
import pathlib

import pytest

import whirl

SAVED = pathlib.Path(__file__).resolve().parents[2] / "tests" / "data" / "ross"
MARCH = '[march]\ntime_step = "0.1 ms"\nduration = "5 ms"\n'


class Rotor:
    """A rotor whose `save` writes what ROSS wrote once."""

    def __init__(self, file):
        self.file = file

    def save(self, path):
        assert path.suffix == ".json"
        path.write_bytes(gzip.decompress((SAVED / f"{self.file}.gz").read_bytes()))


def test_a_rotor_and_its_file_are_one_case(tmp_path):
    case = whirl.from_ross(Rotor("supports.json"), name="pump")
    path = tmp_path / "pump.json"
    Rotor("supports.json").save(path)
    assert whirl.from_ross(path, name="pump").text == case.text
    assert case.name == "pump" and case.supports[0] == "bearing_0"
    assert "10000000 N/m" in case.text and "rotor" in case.check()


def test_what_differs_is_warned_of():
    with pytest.warns(whirl.WhirlWarning, match="damping alpha by mass is left out"):
        whirl.from_ross(Rotor("damping.json"))


def test_a_case_with_tables_is_marched():
    with pytest.warns(whirl.WhirlWarning, match="monotone cubics"):
        case = whirl.from_ross(Rotor("film.toml"), add=MARCH)
    assert case.run().history.array.shape[0] == 50


def test_what_is_no_rotor_is_refused(tmp_path):
    with pytest.raises(TypeError, match="a rotor of ROSS or a path"):
        whirl.from_ross(3)
    path = tmp_path / "a.toml"
    path.write_text("a = 1\n")
    with pytest.raises(whirl.CaseError, match="is no rotor of ROSS"):
        whirl.from_ross(path)


@pytest.mark.parametrize("make", ["rotor_example", "coaxrotor_example", "rotor_example_6dof"])
@pytest.mark.filterwarnings("ignore")
def test_rotors_of_the_installed_program_are_cases(make):
    try:
        import ross
    except Exception as error:  # its import fails with some versions of plotly
        pytest.skip(f"ROSS is not installed or cannot be imported: {error}")
    case = whirl.from_ross(getattr(ross, make)())
    assert "joint" in case.text and case.check()
