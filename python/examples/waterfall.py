"""What oscillates during a run-up, over speed: a waterfall as a Campbell diagram has it, from one run.

python waterfall.py
"""

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import numpy as np
from matplotlib import pyplot

import whirl


def spectra(signal, rows, windows):
    """Amplitudes of a signal in windows of so many rows: (frequencies over the rate of rows, windows × frequencies)."""
    window = np.hanning(rows)
    starts = np.linspace(0, len(signal) - rows, windows).astype(int)
    slices = np.array([signal[start : start + rows] for start in starts])
    slices = (slices - slices.mean(axis=1, keepdims=True)) * window
    return starts, np.abs(np.fft.rfft(slices, axis=1)) * 2 / window.sum()


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--steps", type=int, help="fewer than the case has")
    arguments.add_argument("--out", type=Path, default=Path("figures"))
    asked = arguments.parse_args()
    case = {"include": "unbalance.toml"}
    if asked.steps:
        case["march"] = {"steps": asked.steps}
    results = whirl.Case(case, name="unbalance").run()
    times, speeds = results["t_s"], results["omega_rad_s"] * 60 / (2 * np.pi)
    rows = len(times) // 12
    starts, amplitudes = spectra(results["x_left_um"], rows, 60)
    hertz = np.fft.rfftfreq(rows, times[1] - times[0])
    seen = hertz <= 3 * speeds[-1] / 60
    asked.out.mkdir(parents=True, exist_ok=True)
    figure, axes = pyplot.subplots(layout="constrained", figsize=(8, 5))
    middle = speeds[starts + rows // 2]
    image = axes.pcolormesh(middle, hertz[seen], amplitudes[:, seen].T, shading="nearest")
    for order in (1, 2):
        axes.plot(middle, order * middle / 60, "w--", linewidth=0.6)
        axes.annotate(f"{order}X", (middle[-1], order * middle[-1] / 60), color="w", ha="right")
    axes.set_ylim(0, hertz[seen][-1])
    axes.set_xlabel("speed (rpm)")
    axes.set_ylabel("frequency (Hz)")
    unit = results.history.unit("x_left_um").replace("um", "µm")
    figure.colorbar(
        image, label=f"amplitude of {results.history.column('x_left_um').meaning} ({unit})"
    )
    figure.savefig(asked.out / "waterfall.png", dpi=120)
    largest = np.argmax(np.abs(results["x_left_um"]))
    print(f"largest displacement at {speeds[largest]:.0f} rpm")


if __name__ == "__main__":
    main()
