"""The examples run, and draw what they say."""

import importlib.util
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "examples"

# Script, arguments, what it draws.
RUNS = {
    "paper_figures": (["--steps", "60"], {"reactions.png", "eccentricity.png", "rotation.png"}),
    "campbell": (["--speeds", "9"], {"campbell.png"}),
    "own_law": (["--steps", "40"], {"my-law.png"}),
    "waterfall": (["--steps", "2400"], {"waterfall.png"}),
    "clearance_study": (["--steps", "40", "--points", "3"], {"clearances.png"}),
    "uncertainty": (["--points", "8", "--power", "2"], {"uncertainty.png"}),
    "optimisation": (["--evaluations", "4", "--speeds", "9"], {"optimisation.png"}),
}
NEED_SCIPY = {"uncertainty", "optimisation"}


def test_every_example_is_run():
    assert {own.stem for own in EXAMPLES.glob("*.py")} == set(RUNS)


@pytest.mark.parametrize("name", RUNS)
def test_an_example_runs(name, tmp_path):
    pytest.importorskip("matplotlib")
    if name in NEED_SCIPY:
        pytest.importorskip("scipy")
    arguments, figures = RUNS[name]
    line = [sys.executable, str(EXAMPLES / f"{name}.py"), *arguments, "--out", "out"]
    environment = {**os.environ, "MPLCONFIGDIR": str(tmp_path / "matplotlib")}
    done = subprocess.run(line, cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert figures <= {own.name for own in (tmp_path / "out").iterdir()}


@pytest.fixture
def uncertainty():
    """The example of that name as a module."""
    pytest.importorskip("scipy")
    place = EXAMPLES / "uncertainty.py"
    described = importlib.util.spec_from_file_location("uncertainty", place)
    module = importlib.util.module_from_spec(described)
    described.loader.exec_module(module)
    return module


def a_sum(points):
    """Indices are known: the terms have variances 1/12, 4/12, and of the product 1/144 more."""
    x, y, z = points.T - 0.5
    return x + 2 * y + x * z


def test_the_indices_of_the_example_are_those_of_a_function_whose_variance_is_known(uncertainty):
    first, total = uncertainty.indices(a_sum(uncertainty.saltelli(12, seed=0)))
    whole = 1 / 12 + 4 / 12 + 1 / 144
    # 4096 rows: independent ones would be off by some 1/√4096 of the variance; those of a sequence are nearer.
    assert np.allclose(first, np.array([1 / 12, 4 / 12, 0]) / whole, rtol=0, atol=1 / 64)
    assert np.allclose(total, np.array([13 / 144, 4 / 12, 1 / 144]) / whole, rtol=0, atol=1 / 64)


def test_the_indices_of_the_example_are_those_of_salib(uncertainty):
    pytest.importorskip("SALib")
    results = a_sum(uncertainty.saltelli(6, seed=0))
    for own, other in zip(uncertainty.indices(results), uncertainty.indices_by_salib(results)):
        # The same formulas: rounding differs.
        assert np.allclose(own, other, rtol=0, atol=1e-12)
