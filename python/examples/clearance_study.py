"""Forces of the reference machine over the radial clearance of its bearings.

python clearance_study.py
"""

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import numpy as np
from matplotlib import pyplot

import whirl


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--points", type=int, default=13)
    arguments.add_argument("--steps", type=int, help="fewer than the case has")
    arguments.add_argument("--out", type=Path, default=Path("figures"))
    asked = arguments.parse_args()
    case = {"include": "hu2003-5.toml"}
    if asked.steps:
        case["march"] = {"steps": asked.steps}
    clearances = np.linspace(20, 80, asked.points)
    sweep = whirl.sweep(
        case,
        {"springs.radial_clearance": [f"{own:g} um" for own in clearances]},
        progress=lambda done, points, point: print(f"{done} of {points}: {point.values}"),
    )
    data = sweep.to_xarray()
    asked.out.mkdir(parents=True, exist_ok=True)
    figure, axes = pyplot.subplots(layout="constrained")
    largest = np.maximum(abs(data.RX_min), abs(data.RX_max))
    for support in data.support.values:
        axes.plot(clearances, largest.sel(support=support), ".-", label=f"support {support}")
    axes.set_xlabel("radial clearance (µm)")
    axes.set_ylabel("largest |RX| over the last cycle (N)")
    axes.legend()
    figure.savefig(asked.out / "clearances.png", dpi=120)


if __name__ == "__main__":
    main()
