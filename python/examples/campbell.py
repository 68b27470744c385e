"""Campbell diagram, threshold of whirl and orbits of a rotor in film bearings.

python campbell.py
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
    arguments.add_argument("--speeds", type=int, default=35)
    arguments.add_argument("--out", type=Path, default=Path("figures"))
    asked = arguments.parse_args()
    case = whirl.Case("weight")
    speeds = np.linspace(500, 9000, asked.speeds)
    diagram = case.campbell(speeds, orders=[0.5, 1])
    for note in diagram.notes:
        print("note:", note)
    print("critical speeds (rpm):", diagram.criticals.speed_rpm.round(1))
    print("unstable above (rpm):", diagram.thresholds.speed_rpm.round(1))
    response = case.response("500 rpm .. 6000 rpm, 111")["rotor"]

    asked.out.mkdir(parents=True, exist_ok=True)
    figure, (left, middle, right) = pyplot.subplots(1, 3, figsize=(13, 4), layout="constrained")
    left.plot(diagram.speed_rpm, diagram.frequency_hz.T)
    left.plot(diagram.criticals.speed_rpm, diagram.criticals.frequency_hz, "ro")
    left.plot(speeds, speeds / 60, "k:", label="1X")
    left.set(xlabel="speed (rpm)", ylabel="frequency (Hz)")
    left.legend()
    middle.plot(diagram.speed_rpm, diagram.log_decrement.T)
    middle.axhline(0, color="k", linewidth=0.5)
    middle.set(xlabel="speed (rpm)", ylabel="logarithmic decrement")
    for point in response.points:
        fastest = response.major_um[response.points.index(point)].argmax()
        right.plot(*response.orbit(point, fastest), label=point)
    right.set(xlabel="x (µm)", ylabel="y (µm)", aspect="equal")
    right.legend()
    figure.savefig(asked.out / "campbell.png", dpi=120)


if __name__ == "__main__":
    main()
