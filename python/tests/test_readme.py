"""The page of the package is true."""

import pathlib
import re

import pytest

import whirl
from conftest import LAW
from test_fit import at_rest, over_speeds

PAGE = (pathlib.Path(__file__).resolve().parents[1] / "README.md").read_text(encoding="utf-8")


def test_the_examples_of_the_page_run(tmp_path, monkeypatch):
    matplotlib = pytest.importorskip("matplotlib")
    pytest.importorskip("xarray")
    matplotlib.use("Agg")
    monkeypatch.chdir(tmp_path)
    pathlib.Path("other-law.toml").write_text(LAW)
    pathlib.Path("seal.csv").write_text(over_speeds([3000, 9000], at_rest))
    blocks = re.findall(r"```python\n(.*?)```", PAGE, flags=re.S)
    # Clusters and processes are tested elsewhere.
    blocks = [own for own in blocks if "Client(" not in own and "Cluster(" not in own]
    assert len(blocks) == 5
    names: dict = {}
    for own in blocks:
        exec(compile(own, "README.md", "exec"), names)
    assert len(names["sweep"]) == 9 and names["results"].complete
    assert names["seal"].error < 0.01 and pathlib.Path("seal.toml").exists()


def test_the_error_on_the_page_is_the_one_that_is_raised():
    with pytest.raises(whirl.CaseError) as raised:
        whirl.Case('include = "sdnd101.toml"\n[march]\nstepz = 4\n')
    assert f"whirl.errors.CaseError: {raised.value}" in PAGE
