"""Writes bar20.inp and bar10.inp, which CalculiX 2.20 (`ccx bar20`, `ccx bar10`) turned into the files beside it.

A bar of steel of 20 x 20 x 60 mm in mm, N, t: three hexahedra of 20 nodes, each a little skew, or eighteen tetrahedra of 10.
"""

import gzip
import subprocess

STEEL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.85e-9\n*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n"
STEP = "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n*END STEP\n"
HEX = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
TETS = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
TET_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]


def place(p):
    x, y, z = (10.0 * c for c in p)
    return (x + 0.05 * z, y - 0.03 * z + 0.02 * x, z + 0.04 * x)


def middle(a, b):
    return tuple((i + j) // 2 for i, j in zip(a, b))


def write(name, kind, cells):
    numbers = {}
    for cell in cells:
        for p in cell:
            numbers.setdefault(p, len(numbers) + 1)
    with open(name + ".inp", "w") as out:
        out.write("*NODE, NSET=NALL\n")
        for p, n in numbers.items():
            out.write("%d, %.10g, %.10g, %.10g\n" % ((n,) + place(p)))
        out.write("*ELEMENT, TYPE=%s, ELSET=EALL\n" % kind)
        for e, cell in enumerate(cells):
            labels = [str(numbers[p]) for p in cell]
            out.write("%d, %s\n" % (e + 1, ", ".join(labels[:10]) + (",\n" + ", ".join(labels[10:]) if len(labels) > 10 else "")))
        end = [n for p, n in numbers.items() if p[2] == 0]
        out.write("*NSET, NSET=END\n" + ",\n".join(map(str, end)) + "\n")
        out.write(STEEL + STEP)
    subprocess.run(["ccx", name], check=True, stdout=subprocess.DEVNULL)
    for ending in ("sti", "mas", "dof"):
        with open(name + "." + ending, "rb") as source, open(name + "." + ending + ".gz", "wb") as out:
            with gzip.GzipFile(filename="", mode="wb", fileobj=out, mtime=0) as packed:
                packed.write(source.read())


hexes, tets = [], []
for k in range(3):
    corners = [(x, y, z + 2 * k) for x, y, z in HEX]
    hexes.append(corners + [middle(corners[a], corners[b]) for a, b in EDGES])
    for tet in TETS:
        four = [tuple(2 * c for c in corners[i]) for i in tet]
        own = four + [middle(four[a], four[b]) for a, b in TET_EDGES]
        tets.append([tuple(c / 2 for c in p) for p in own])
write("bar20", "C3D20", hexes)
write("bar10", "C3D10", tets)
