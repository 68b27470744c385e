"""Cantilevers of distorted cells for CalculiX, and what it prints of them: frequencies with the end BASE held, and
displacements and stresses under forces on the corner TIP.

    apt install calculix-ccx && python make.py

writes NAME.inp.gz and NAME.csv.gz; what is committed was made with CalculiX 2.20.
"""

import gzip
import math
import re
import subprocess
import tempfile
from pathlib import Path

EDGES = {
    "C3D20": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
    "C3D15": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    "C3D10": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
}
TETRAHEDRA = [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]]
PARTS = {
    "C3D8I": [list(range(8))],
    "C3D20": [list(range(8))],
    "C3D15": [[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]],
    "C3D10": TETRAHEDRA,
    "C3D4": TETRAHEDRA,
}


def place(x, y, z, distorted):
    """A point of the unit cube in the cantilever (m), 0.3 x 0.06 x 0.05 where it is not distorted."""
    across, up = 0.06 * (y - 0.5), 0.05 * (z - 0.5)
    if not distorted:
        return 0.3 * x, across, up
    return (
        0.3 * x + 0.006 * x * math.sin(2 * y) * (1 - x) + 0.004 * x * z * (1 - x),
        across * (1 + 0.3 * x) + 0.004 * math.sin(3 * x) * x,
        up * (1 + 0.2 * x * y) + 0.003 * x * x,
    )


def mesh(kind, counts, distorted):
    """The input up to its steps. Keys of nodes count half cells."""
    labels, positions, cells = {}, [], []
    at = lambda key: place(*(k / (2 * n) for k, n in zip(key, counts)), distorted)

    def node(key, position):
        if key not in labels:
            labels[key] = len(labels) + 1
            positions.append(position)
        return labels[key]

    nx, ny, nz = counts
    for k in range(0, 2 * nz, 2):
        for j in range(0, 2 * ny, 2):
            for i in range(0, 2 * nx, 2):
                square = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)]
                corners = [(*xy, k) for xy in square] + [(*xy, k + 2) for xy in square]
                for part in PARTS[kind]:
                    keys = [corners[p] for p in part]
                    cell = [node(key, at(key)) for key in keys]
                    for a, b in EDGES.get(kind, []):
                        middle = tuple((p + q) // 2 for p, q in zip(keys[a], keys[b]))
                        # Edges of tetrahedra stay straight.
                        mean = tuple((p + q) / 2 for p, q in zip(at(keys[a]), at(keys[b])))
                        cell.append(node(middle, mean if kind == "C3D10" else at(middle)))
                    cells.append(cell)
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{n + 1}, " + ", ".join(repr(round(x, 9)) for x in xyz) for n, xyz in enumerate(positions)]
    lines.append(f"*ELEMENT, TYPE={kind}, ELSET=BODY")
    for n, cell in enumerate(cells):
        values = [str(value) for value in [n + 1, *cell]]
        rows = [values[:16], values[16:]] if len(values) > 16 else [values]
        lines.append(",\n".join(", ".join(row) for row in rows))
    base = [str(label) for key, label in labels.items() if key[0] == 0]
    lines.append("*NSET, NSET=BASE")
    lines.append(",\n".join(", ".join(base[a : a + 12]) for a in range(0, len(base), 12)))
    lines += ["*NSET, NSET=TIP", str(labels[tuple(2 * n for n in counts)])]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "2e11, 0.3", "*DENSITY", "7860"]
    lines += ["*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL"]
    return "\n".join(lines) + "\n"


def printed(text):
    """What CalculiX prints of a step that begins with the base held."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "job.inp").write_text(text)
        subprocess.run(["ccx", "-i", "job"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        return (Path(folder) / "job.dat").read_text()


def rows(text, integers):
    """Lines that begin with so many integers, then a number."""
    pattern = re.compile(r"(\s+\d+){%d}\s+-?\d+\.\d*E" % integers, re.IGNORECASE)
    return [line.split() for line in text.splitlines() if pattern.match(line)]


def write(name, kind, counts, distorted, loaded=True):
    body = mesh(kind, counts, distorted)
    held = body + "*BOUNDARY\nBASE, 1, 3, 0\n*STEP\n"
    eigenvalues = printed(held + "*FREQUENCY\n10\n*END STEP\n").split("P A R T I C I P A T I O N")[0]
    text = "# Hz\n" + "".join(row[3] + "\n" for row in rows(eigenvalues, 1))
    displacements, stresses = "", ""
    if loaded:
        load = "*STATIC\n*CLOAD\nTIP, 1, 900\nTIP, 2, 400\nTIP, 3, -700\n"
        output = "*NODE PRINT, NSET=ALL\nU\n*EL PRINT, ELSET=BODY\nS\n*END STEP\n"
        displacements, stresses = printed(held + load + output).split("stresses")
    text += "# node, u (m)\n" + "".join(",".join(row) + "\n" for row in rows(displacements, 1))
    text += "# cell, point, xx, yy, zz, xy, xz, yz (Pa)\n"
    text += "".join(",".join(row) + "\n" for row in rows(stresses, 2))
    for ending, content in [("inp", body), ("csv", text)]:
        with open(f"{name}.{ending}.gz", "wb") as file:
            with gzip.GzipFile(filename="", mode="wb", fileobj=file, mtime=0) as packed:
                packed.write(content.encode())


if __name__ == "__main__":
    for kind in PARTS:
        write(kind.lower(), kind, (6, 2, 2), True)
    write("c3d8i-box", "C3D8I", (6, 2, 2), False)
    for kind in ["C3D8I", "C3D15"]:
        write(f"{kind.lower()}-fine", kind, (12, 4, 4), True, loaded=False)
