"""The examples run, and draw what they say."""

import os
import pathlib
import subprocess
import sys

import pytest

EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "examples"

# Script, arguments, what it draws.
RUNS = {
    "paper_figures": (["--steps", "60"], {"reactions.png", "eccentricity.png", "rotation.png"}),
    "campbell": (["--speeds", "9"], {"campbell.png"}),
    "own_law": (["--steps", "40"], {"my-law.png"}),
    "waterfall": (["--steps", "2400"], {"waterfall.png"}),
    "clearance_study": (["--steps", "40", "--points", "3"], {"clearances.png"}),
}


def test_every_example_is_run():
    assert {own.stem for own in EXAMPLES.glob("*.py")} == set(RUNS)


@pytest.mark.parametrize("name", RUNS)
def test_an_example_runs(name, tmp_path):
    pytest.importorskip("matplotlib")
    arguments, figures = RUNS[name]
    line = [sys.executable, str(EXAMPLES / f"{name}.py"), *arguments, "--out", "out"]
    environment = {**os.environ, "MPLCONFIGDIR": str(tmp_path / "matplotlib")}
    done = subprocess.run(line, cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert figures <= {own.name for own in (tmp_path / "out").iterdir()}
