"""Reactions, orbits and rotation of an analysis of the reference system, as in the paper (Hu, Mourelatos, Vlahopoulos, 2003).

python paper_figures.py --case hu2003-5
"""

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

import whirl


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--case", default="hu2003-5", help="a built-in case")
    arguments.add_argument("--steps", type=int, help="fewer than the case has")
    arguments.add_argument("--out", type=Path, default=Path("figures"))
    asked = arguments.parse_args()
    case = {"include": f"{asked.case}.toml"}
    if asked.steps:
        case["march"] = {"steps": asked.steps}
    results = whirl.Case(case, name=asked.case).run()
    print(results.verdict)
    asked.out.mkdir(parents=True, exist_ok=True)
    milliseconds = 1e3 * results["t_s"]

    figure, axes = pyplot.subplots(4, 2, sharex=True, layout="constrained", figsize=(9, 9))
    for support, (x, y) in enumerate(axes, start=1):
        for own, axis in ((x, "X"), (y, "Y")):
            own.plot(milliseconds, results[f"R{axis}{support}_N"], linewidth=0.6)
            own.set_ylabel(f"R{axis}{support} (N)")
    for own in axes[-1]:
        own.set_xlabel("time (ms)")
    figure.savefig(asked.out / "reactions.png", dpi=120)

    figure, axes = pyplot.subplots(2, 2, layout="constrained", figsize=(8, 8))
    for support, own in enumerate(axes.ravel(), start=1):
        own.plot(results[f"EX{support}_um"], results[f"EY{support}_um"], linewidth=0.6)
        own.set_aspect("equal")
        own.set_title(f"support {support}")
        own.set_xlabel("EX (µm)")
        own.set_ylabel("EY (µm)")
    figure.savefig(asked.out / "eccentricity.png", dpi=120)

    figure, (angle, speed) = pyplot.subplots(2, sharex=True, layout="constrained")
    angle.plot(milliseconds, results["theta_rad"])
    angle.set_ylabel("θ (rad)")
    speed.plot(milliseconds, results["omega_rad_s"])
    speed.set_ylabel("dθ/dt (rad/s)")
    speed.set_xlabel("time (ms)")
    figure.savefig(asked.out / "rotation.png", dpi=120)


if __name__ == "__main__":
    main()
