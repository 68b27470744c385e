"""Cases of the tests, and the command where it is built."""

import os
import pathlib
import shutil
import signal

import pytest

import whirl

# A shell has what it starts in the background ignore Ctrl-C, which some tests send.
signal.signal(signal.SIGINT, signal.default_int_handler)

ROOT = pathlib.Path(__file__).resolve().parents[2]

LAW = """\
kind = "law"
name = "my-law"
title = "Hertzian contact behind a gap"
source = "K. L. Johnson, Contact Mechanics (1985)"

[inputs.h]
unit = "mm"

[parameters.k]
value = 40000
unit = "N/mm^1.5"

[outputs.Q]
unit = "N"
pieces = [{ when = 'h < 0', value = 'k*(-h)^1.5' }, { value = '0' }]
"""


# √(h/1 mm) has no value beyond the gap.
NO_NUMBER = """\
kind = "law"
name = "root"
title = "root of the gap"
source = "none"
inputs.h = { unit = "mm", title = "clearance", range = [0.1, 3] }
parameters.k = { value = 1, unit = "N", title = "force" }
parameters.h_1 = { value = 1, unit = "mm", title = "one" }
outputs.Q = { unit = "N", title = "normal force", value = 'k*sqrt(h/h_1)' }
"""


def a_mass(steps=900, law="gap-linear-1e6", velocity="1 m/s"):
    """A mass that strikes a stop: over in no time."""
    return {
        "title": "a mass at a stop",
        "mass": {"mass": "100 kg", "stiffness": "1e4 N/m", "velocity": velocity},
        "stop": [{"side": "above", "gap": "0 mm", "law": law}],
        "march": {"time_step": "2e-5 s", "steps": steps, "force_tolerance": "1e-6 N"},
    }


def a_rotor(steps=60):
    """The start of a run-up of a flexible rotor: a body is reduced."""
    return {"include": "unbalance.toml", "title": "a run-up", "march": {"steps": steps}}


@pytest.fixture
def mass():
    return whirl.Case(a_mass())


@pytest.fixture
def nothing_written(tmp_path, monkeypatch):
    """A folder in which, and below which, a test writes nothing."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    yield tmp_path
    assert list(tmp_path.iterdir()) == []


@pytest.fixture(scope="session")
def command():
    """The command `whirl`: WHIRL_COMMAND, or what is built of it."""
    places = [os.environ.get("WHIRL_COMMAND"), shutil.which("whirl")]
    places += [str(ROOT / "target" / kind / "whirl") for kind in ("release", "debug")]
    for place in places:
        if place and os.path.isfile(place):
            return place
    pytest.skip("the command whirl is not built")
