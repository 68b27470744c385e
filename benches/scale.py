"""What sizes cost in time and memory: bodies over dofs, histories over rows, machines at real time, points of sweeps.

    cargo build --release && pip install gmsh && python3 benches/scale.py target/release/whirl bodies 18 11.8 7.4
    python3 benches/scale.py target/release/whirl histories 100000 1000000
    python3 benches/scale.py target/release/whirl twins hu2003-5 weight
    python3 benches/scale.py target/release/whirl points 2000
    pip install './python[dask]' && python3 benches/scale.py target/release/whirl cluster 1000

`bodies` takes edges of cells (mm) of a block of steel, 120 x 120 x 160 mm with a bore of 60 mm, in tet10: 100 modes are found, held
at one side. Beside the memory that was taken (the peak of the process, by /usr/bin/time) stands what the program told before: its
refusal under a `memory_limit` of 1 MB. `histories` takes rows of the mass of `annular-rub`, `twins` built-in cases, `points` and
`cluster` points of the same mass, 500 steps each: by the program, and from Python on a Dask cluster of two processes. Of runs
below a minute the fastest of three counts. Processor time is what a process took of all cores: on a machine that others use, too, it
says more than wall time.
"""

import json
import math
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

QUIET = ["--no-figures", "--no-report", "--quiet", "--out", "run"]

MESH = """
import gmsh
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
model = gmsh.model.occ
block = model.addBox(-60, -60, 0, 120, 120, 160)
model.cut([(3, block)], [(3, model.addCylinder(0, 0, -1, 0, 0, 162, 30))])
model.synchronize()
gmsh.option.setNumber("Mesh.MeshSizeMax", {edge})
gmsh.option.setNumber("Mesh.MeshSizeMin", {edge})
gmsh.option.setNumber("Mesh.Algorithm3D", 10)
gmsh.option.setNumber("Mesh.Binary", 1)
gmsh.model.mesh.generate(3)
gmsh.model.mesh.setOrder(2)
gmsh.write({file!r})
"""

BLOCK = """title = "a block, held at one side"
{reduction}
[material.steel]
youngs_modulus = "206 GPa"
poissons_ratio = 0.3
density = "7850 kg/m^3"

[body.block]
turns = "no"
mesh = "block.msh"
units = "mm, N, t"
material = "steel"
modes = 100
damping = "2e-6 s"
held = ["FOOT"]
sets.FOOT = {{ plane = "-60 mm", across = "x" }}
sets.TOP = {{ plane = "60 mm", across = "x" }}

[loads.push]
body = "block"
sets = ["TOP"]
direction = "x"
force = "1000 N"
frequency = "50 Hz"

[march]
time_step = "1e-5 s"
steps = 10
"""

RUN = """include = "{name}.toml"
title = "{name}, so many steps"

[march]
steps = {steps}
"""

POINTS = """title = "short runs"
case = "short.toml"

[vary]
mass.unbalance.eccentricity = "0.4 mm .. 0.6 mm, {points}"
"""

MIB = 2**20


class Measured(NamedTuple):
    """A run of the program: seconds on the clock and of processors, and the peak of its memory (bytes)."""

    wall: float
    processors: float
    peak: float


def measured(command: list[str], folder: Path) -> Measured:
    """The fastest of three runs, and their largest peak; of one run where that takes long."""
    runs = []
    while len(runs) < 3 and not (runs and runs[0].wall > 60):
        line = ["/usr/bin/time", "-o", "noted", "-f", "%e %U %S %M", *command]
        subprocess.run(line, cwd=folder, check=True, capture_output=True)
        wall, user, system, peak = map(float, (folder / "noted").read_text().split())
        runs.append(Measured(wall, user + system, 1024 * peak))
    wall, processors, peak = zip(*runs)
    return Measured(min(wall), min(processors), max(peak))


def row(*cells: object) -> None:
    print("|", " | ".join(map(str, cells)), "|", flush=True)


def head(*cells: str) -> None:
    row(*cells)
    print("|" + "---|" * len(cells))


def mib(size: float) -> str:
    return f"{size / MIB:.3g} MiB" if size < 1000 * MIB else f"{size / MIB:.0f} MiB"


def summary(folder: Path) -> dict:
    return json.loads((folder / "run" / "summary.json").read_text())


def mesh(edge: float, file: Path) -> None:
    """In a process of its own, so that its memory is free again."""
    subprocess.run([sys.executable, "-c", MESH.format(edge=edge, file=str(file))], check=True)


def told(whirl: str, folder: Path) -> float:
    """Bytes that the reduction would take, as a refusal says."""
    case = BLOCK.format(reduction='[reduction]\nmemory_limit = "1 MB"')
    (folder / "refused.toml").write_text(case)
    line = [whirl, "run", "refused.toml", "--no-cache", "--out", "refused"]
    said = subprocess.run(line, cwd=folder, capture_output=True, text=True, check=False).stderr
    value, unit = re.search(r"takes about ([\d.]+) (.)iB of memory", said).groups()
    return float(value) * 1024 ** " KMGT".index(unit)


def bodies(whirl: str, edges: list[str], folder: Path) -> None:
    head(
        "dofs",
        "`mesh`, s",
        "peak",
        "`run`, s",
        "processors, s",
        "grows",
        "told",
        "taken",
        "told / taken",
    )
    before = None
    for edge in map(float, edges):
        mesh(edge, folder / "block.msh")
        (folder / "case.toml").write_text(BLOCK.format(reduction=""))
        read = measured([whirl, "mesh", "block.msh", "--units", "mm, N, t"], folder)
        said = told(whirl, folder)
        run = measured([whirl, "run", "case.toml", "--no-cache", *QUIET], folder)
        dofs = summary(folder)["counts"]["bodies"]["block"]["internal_dofs"]
        growth = ""
        if before:
            exponent = math.log(run.processors / before[1]) / math.log(dofs / before[0])
            growth = f"n^{exponent:.2f}"
        before = dofs, run.processors
        seconds = f"{run.wall:.2f}", f"{run.processors:.2f}", growth
        memory = mib(said), mib(run.peak), f"{said / run.peak:.2f}"
        row(dofs, f"{read.wall:.2f}", mib(read.peak), *seconds, *memory)


def histories(whirl: str, counts: list[str], folder: Path) -> None:
    head("rows", "file", "size", "bytes a row", "`run`, s", "processors, s", "peak")
    kinds = {"csv": [], "parquet": ["--parquet"], "npz": ["--npz"], "h5": ["--hdf5"]}
    for count in counts:
        (folder / "case.toml").write_text(RUN.format(name="annular-rub", steps=count))
        for kind, option in kinds.items():
            run = measured([whirl, "run", "case.toml", *QUIET, *option], folder)
            size = (folder / "run" / f"history.{kind}").stat().st_size
            seconds = f"{run.wall:.2f}", f"{run.processors:.2f}"
            row(count, kind, mib(size), f"{size / int(count):.0f}", *seconds, mib(run.peak))


def twins(whirl: str, names: list[str], folder: Path) -> None:
    head(
        "case",
        "coordinates",
        "µs a step",
        "simulated / wall",
        "peak",
        "columns",
        "CSV, kB/s of real time",
        "checkpoint",
    )
    for name in names:
        marches = []
        for _ in range(3):
            run = measured([whirl, "run", name, *QUIET], folder)
            marches.append(summary(folder)["time"])
        march = min(own["march_wall_s"] for own in marches)
        simulated = marches[0]["simulated_s"]
        history = folder / "run" / "history.csv"
        with history.open() as lines:
            columns = next(lines).count(",") + 1
            rows = sum(1 for _ in lines)
        rate = history.stat().st_size / simulated / 1e3
        state = (folder / "run" / "state.bin").stat().st_size
        pace = f"{1e6 * march / rows:.1f}", f"{simulated / march:.2f}"
        row(
            name,
            summary(folder)["counts"]["active"],
            *pace,
            mib(run.peak),
            columns,
            f"{rate:.0f}",
            mib(state),
        )


def points(whirl: str, counts: list[str], folder: Path) -> None:
    head("points", "at a time", "`sweep`, s", "processors, s", "points a second", "peak")
    (folder / "short.toml").write_text(RUN.format(name="annular-rub", steps=500))
    for count in counts:
        (folder / "study.toml").write_text(POINTS.format(points=count))
        for jobs in (1, 2):
            line = [whirl, "sweep", "study.toml", "--jobs", str(jobs), *QUIET]
            run = measured(line, folder)
            pace = f"{run.wall:.2f}", f"{run.processors:.2f}", f"{int(count) / run.wall:.0f}"
            row(count, jobs, *pace, mib(run.peak))


def cluster(_: str, counts: list[str], folder: Path) -> None:
    import distributed
    import whirl

    case = {"include": "annular-rub.toml", "march": {"steps": 500}}
    head("points", "`sweep`, s", "processors, client with scheduler, s", "ms a point")
    place = {"dashboard_address": None, "local_directory": str(folder)}
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, **place) as own,
        distributed.Client(own) as client,
    ):
        for count in map(int, counts):
            sizes = [f"{0.4 + 0.2 * k / count:.6f} mm" for k in range(count)]
            runs = []
            for _ in range(3):
                begun = time.perf_counter(), time.process_time()
                vary = {"mass.unbalance.eccentricity": sizes}
                whirl.sweep(case, vary, client=client, keep_histories=False)
                runs.append((time.perf_counter() - begun[0], time.process_time() - begun[1]))
            wall, processors = map(min, zip(*runs))
            row(count, f"{wall:.2f}", f"{processors:.2f}", f"{1e3 * processors / count:.1f}")


def main(whirl: str, what: str, sizes: list[str]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        kinds = {"bodies": bodies, "histories": histories, "twins": twins}
        kinds |= {"points": points, "cluster": cluster}
        kinds[what](str(Path(whirl).resolve()), sizes, Path(folder))


if __name__ == "__main__":
    # Processes of a cluster read this file, too.
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
