"""A bearing law of one's own: its plot, its values, and a run of the reference machine with it.

python own_law.py
"""

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import numpy as np

import whirl

LAW = """
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


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--steps", type=int, default=5405)
    arguments.add_argument("--out", type=Path, default=Path("figures"))
    asked = arguments.parse_args()
    law = whirl.Law(LAW)
    h = np.linspace(-0.01, 0.005, 7)
    for own, force, slope in zip(h, law(h=h), law.derivative("Q", "h", h=h)):
        print(f"h = {1e3 * own:6.1f} µm: Q = {force:7.2f} N, dQ/dh = {slope:9.1f} N/mm")
    asked.out.mkdir(parents=True, exist_ok=True)
    law.plot()[0].figure.savefig(asked.out / "my-law.png", dpi=120)

    case = whirl.Case(
        {
            "include": "hu2003-5.toml",
            "title": "My law under a sinusoidal load",
            "springs": {"law": law},
            "march": {"steps": asked.steps},
        },
        name="my-case",
    )
    results = case.run()
    for own in results.summary.supports:
        print(f"support {own.support}: RX from {own.RX_N.min:.0f} to {own.RX_N.max:.0f} N")
    print(results.verdict)


if __name__ == "__main__":
    main()
