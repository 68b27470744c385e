"""Uncertainty of a rotor in film bearings: quantiles and Sobol' indices of its threshold of whirl and its vibration.

python uncertainty.py

Needs SciPy (`pip install scipy`). Indices are those of SALib where it is installed, else by the same formulas here.
"""

import argparse
import os
import sys
import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import whirl

try:
    from scipy import stats
    from scipy.stats import qmc
except ImportError:
    sys.exit("this example needs SciPy: pip install scipy")

# A tolerance of manufacture, the oil over its temperatures, and what balancing leaves: two components, normal and alike.
INPUTS = {
    "clearance (µm)": stats.truncnorm(-2, 2, loc=150, scale=10),
    "viscosity (mPa·s)": stats.uniform(12, 16),
    "unbalance (g·mm)": stats.rayleigh(scale=40),
}
QUANTITIES = ("whirl above (rpm)", "largest amplitude (µm)")
QUANTILES = (0.01, 0.05, 0.5, 0.95, 0.99)


def machine(clearance, viscosity, unbalance):
    """The case `weight` with these values, in the units of INPUTS."""
    bearing = {
        "radial_clearance": f"{clearance!r} um",
        "parameters": {"mu": f"{viscosity!r} mPa*s"},
    }
    disc = {"mass": f"{unbalance / 50!r} g", "radius": "50 mm"}
    rotor = {"unbalance": {"disc": disc}}
    joints = {"left": bearing, "right": bearing}
    return whirl.Case({"include": "weight.toml", "joint": joints, "body": {"rotor": rotor}})


def quantities(values):
    """Both QUANTITIES of a machine, by linear analyses; NaN where nothing whirls."""
    case = machine(*map(float, values))
    thresholds = case.stability("3000 rpm .. 12000 rpm, 10").thresholds.speed_rpm
    response = case.response("500 rpm .. 6000 rpm, 23")["rotor"]
    # Thresholds and peaks are sought between the speeds.
    largest = max(response.major_um.max(), *response.peaks["major_um"])
    return [min(thresholds, default=np.nan), largest]


def of_all(points):
    """Shape (points, quantities), of points in the unit cube, on all cores."""
    values = np.stack([own.ppf(column) for own, column in zip(INPUTS.values(), points.T)], axis=1)
    with ThreadPoolExecutor(os.cpu_count()) as executor:
        return values, np.array(list(executor.map(quantities, values)))


def saltelli(power, seed):
    """2^power rows of a Sobol' sequence as A and B, each with A where one column is of B: A, AB_1 … AB_d, B, and the next row."""
    d = len(INPUTS)
    both = qmc.Sobol(2 * d, seed=seed).random_base2(power)
    a, b = both[:, :d], both[:, d:]
    mixed = np.repeat(a[:, None, :], d + 2, axis=1)
    for column in range(d):
        mixed[:, column + 1, column] = b[:, column]
    mixed[:, -1] = b
    return mixed.reshape(-1, d)


def indices(results):
    """First-order (Saltelli et al., 2010) and total indices (Jansen, 1999) of results at the rows of `saltelli`."""
    d = len(INPUTS)
    results = ((results - results.mean()) / results.std()).reshape(-1, d + 2)
    a, mixed, b = results[:, :1], results[:, 1:-1], results[:, -1:]
    variance = np.var(np.concatenate([a, b]))
    first = np.mean(b * (mixed - a), axis=0) / variance
    total = np.mean((a - mixed) ** 2, axis=0) / (2 * variance)
    return first, total


def indices_by_salib(results):
    from SALib.analyze import sobol

    problem = {"num_vars": len(INPUTS), "names": list(INPUTS), "bounds": [[0, 1]] * len(INPUTS)}
    with warnings.catch_warnings():
        # Confidence of an index whose input has no effect.
        warnings.simplefilter("ignore", RuntimeWarning)
        found = sobol.analyze(problem, results, calc_second_order=False, seed=0)
    return found["S1"], found["ST"]


def draw(values, results, found, out):
    try:
        import matplotlib
    except ImportError:
        print("no figure: it needs Matplotlib (pip install matplotlib)")
        return
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(2, 4, figsize=(13, 6), layout="constrained")
    for row, name, column, (first, total) in zip(axes, QUANTITIES, results.T, found):
        row[0].hist(column, bins=20)
        row[0].set(xlabel=name, ylabel="machines")
        for own, key, value in zip(row[1:], INPUTS, values.T):
            place = list(INPUTS).index(key)
            own.plot(value, column, ".", markersize=3)
            own.set(xlabel=key, title=f"first {first[place]:.2f}, total {total[place]:.2f}")
        row[1].set_ylabel(name)
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "uncertainty.png", dpi=120)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--points", type=int, default=100, help="of the Latin hypercube")
    arguments.add_argument("--power", type=int, default=5, help="2^POWER rows of the sequence")
    arguments.add_argument("--seed", type=int, default=0)
    arguments.add_argument("--out", type=Path, default=Path("figures"))
    asked = arguments.parse_args()

    hypercube = qmc.LatinHypercube(len(INPUTS), seed=asked.seed)
    values, results = of_all(hypercube.random(asked.points))
    print(f"quantiles of {asked.points} machines of a Latin hypercube:")
    print(f"{'':24}" + "".join(f"{own:>9.0%}" for own in QUANTILES))
    for name, column in zip(QUANTITIES, results.T):
        # A machine that does not whirl within the range does so above it, if at all.
        column = np.where(np.isnan(column), np.inf, column)
        found = np.quantile(column, QUANTILES, method="inverted_cdf")
        print(f"{name:24}" + "".join(f"{own:9.4g}" for own in found))

    points = saltelli(asked.power, asked.seed)
    _, at = of_all(points)
    try:
        import SALib  # noqa: F401

        how, by = "SALib", indices_by_salib
    except ImportError:
        how, by = "the formulas of Saltelli and Jansen", indices
    print(f"\nSobol' indices from {len(points)} machines, by {how}:")
    found = []
    for name, column in zip(QUANTITIES, at.T):
        if np.isnan(column).any():
            sys.exit(
                f"{name}: some machines do not whirl below 12 000 rpm, so there are no indices"
            )
        first, total = by(column)
        found.append((first, total))
        print(f"{name:24}{'first':>9}{'total':>9}")
        for key, one, all_of in zip(INPUTS, first, total):
            print(f"  {key:22}{one:9.2f}{all_of:9.2f}")
    draw(values, results, found, asked.out)


if __name__ == "__main__":
    main()
