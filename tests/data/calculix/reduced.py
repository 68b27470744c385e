"""Prints the frequencies of a steel cantilever (300 x 60 x 50 mm, see make.py) that CalculiX finds with full and with
reduced integration: what docs/meshes.md and the warnings of the reader say of C3D8R and C3D20R.

    apt install calculix-ccx && python reduced.py

With CalculiX 2.20, the first frequencies in Hz, and how much lower they are with R:

    C3D8I   6 x 1 x 1: 451.6    C3D8R    82.1  (82 %)
    C3D8I   6 x 2 x 2: 456.3    C3D8R   398.5  (13 %)
    C3D8I  12 x 4 x 4: 450.6    C3D8R   435.7  (3.3 %)
    C3D20   2 x 2 x 2: 468.3    C3D20R  452.8  (3.3 %)
    C3D20   6 x 2 x 2: 451.1    C3D20R  449.3  (0.4 %)
    C3D20  12 x 4 x 4: 448.2    C3D20R  447.6  (0.1 %)
    C3D20   6 x 1 x 1: 454.3    C3D20R    0.0, twice, then 453.1
"""

import pathlib
import re
import subprocess
import tempfile

SOURCE = (pathlib.Path(__file__).parent / "make.py").read_text()
# The mesh of make.py, which runs CalculiX where its own files begin.
make = {}
exec(SOURCE[: SOURCE.index("def printed")], make)


def hertz(kind, counts):
    text = make["mesh"]("C3D8I" if kind.startswith("C3D8") else "C3D20", counts, False)
    text = re.sub(r"TYPE=\w+", f"TYPE={kind}", text)
    text += "*BOUNDARY\nBASE, 1, 3\n*STEP\n*FREQUENCY\n6\n*END STEP\n"
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "job.inp").write_text(text)
        subprocess.run(["ccx", "-i", "job"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        printed = (pathlib.Path(folder) / "job.dat").read_text().split("P A R T I C I P A T I O N")[0]
    rows = [line.split() for line in printed.splitlines()]
    return [float(row[3]) for row in rows if len(row) == 5 and row[0].isdigit()]


for full, reduced in [("C3D8I", "C3D8R"), ("C3D20", "C3D20R")]:
    for counts in [(2, 2, 2), (6, 1, 1), (6, 2, 2), (12, 4, 4)]:
        for kind in (full, reduced):
            print(kind, *counts, [round(own, 1) for own in hertz(kind, counts)])
