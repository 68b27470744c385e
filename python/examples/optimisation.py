"""Stiffness and damping of a support for the least peak of the response of an overhung disc.

python optimisation.py

Needs SciPy (`pip install scipy`).
"""

import argparse
import sys
import warnings
from pathlib import Path

import numpy as np

import whirl

try:
    from scipy import optimize
except ImportError:
    sys.exit("this example needs SciPy: pip install scipy")

# Of the bearing beside the disc, which carries 83 N: a softer one sags by more than 41 µm.
BOUNDS = {"stiffness": (2e6, 1e8), "damping": (3e2, 1e5)}
UNITS = {"stiffness": "N/m", "damping": "N*s/m"}
AS_BUILT = (5e7, 2e3)


def response(stiffness, damping, speeds):
    """To the unbalance of the disc, with this bearing beside it."""
    alike = zip(UNITS.items(), map(float, (stiffness, damping)))
    bearing = {
        key: {"xx": f"{own!r} {unit}", "yy": f"{own!r} {unit}"} for (key, unit), own in alike
    }
    case = whirl.Case({"include": "overhung-disc.toml", "joint": {"far": bearing}})
    with warnings.catch_warnings():
        # Peaks that a linear analysis is no judge of are what is left behind.
        warnings.simplefilter("ignore", whirl.WhirlWarning)
        return case.response(f"600 rpm .. 6000 rpm, {speeds}")["rotor"]


def at_wheel(excited):
    """Semi-major axis of the orbit over speed (µm)."""
    return excited.major_um[excited.points.index("joint.wheel")]


def peak(excited):
    """The largest at any speed of the range (µm): at a speed asked for, or a peak between two of them."""
    peaks = excited.peaks.where(excited.peaks["point"] == "joint.wheel")
    return max([*at_wheel(excited), *peaks["major_um"]])


def draw(tried, curves, out):
    try:
        import matplotlib
    except ImportError:
        print("no figure: it needs Matplotlib (pip install matplotlib)")
        return
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for name, own in curves.items():
        left.semilogy(own.speed_rpm, at_wheel(own), label=name)
    left.set(xlabel="speed (rpm)", ylabel="amplitude at the wheel (µm)")
    left.legend()
    stiffness, damping, peaks = np.array(tried).T
    dots = right.scatter(stiffness, damping, c=np.log10(peaks), s=14)
    right.plot(stiffness, damping, linewidth=0.4)
    right.set(xscale="log", yscale="log", xlabel="stiffness (N/m)", ylabel="damping (N·s/m)")
    right.xaxis.set_minor_formatter("")
    figure.colorbar(dots, label="log10 of the peak (µm)")
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "optimisation.png", dpi=120)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--evaluations", type=int, default=80, help="at most")
    arguments.add_argument("--speeds", type=int, default=28)
    arguments.add_argument("--out", type=Path, default=Path("figures"))
    asked = arguments.parse_args()
    tried = []

    def objective(logarithms):
        stiffness, damping = 10**logarithms
        largest = peak(response(stiffness, damping, asked.speeds))
        tried.append((stiffness, damping, largest))
        return np.log(largest)

    found = optimize.minimize(
        objective,
        np.log10(AS_BUILT),
        method="Nelder-Mead",
        bounds=[np.log10(own) for own in BOUNDS.values()],
        options={"maxfev": asked.evaluations, "xatol": 1e-3, "fatol": 1e-4},
    )
    best = 10**found.x
    print(f"{len(tried)} responses: {found.message}")
    print(f"{'':10}{'k (N/m)':>12}{'c (N·s/m)':>12}{'peak (µm)':>12}")
    curves = {}
    for name, own in (("as built", AS_BUILT), ("found", best)):
        curves[name] = response(*own, 109)
        print(f"{name:10}{own[0]:12.3g}{own[1]:12.3g}{peak(curves[name]):12.1f}")
    for (key, (low, high)), own in zip(BOUNDS.items(), best):
        if min(own / low, high / own) < 1.01:
            print(f"the {key} is at its bound: another bound gives another optimum")
    draw(tried, curves, asked.out)


if __name__ == "__main__":
    main()
