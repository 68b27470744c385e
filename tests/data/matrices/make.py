"""K and M of two hexahedra of eight nodes, in the formats of several programs.

    pip install numpy scipy pyNastran pyyeti && python make.py

Written by scipy: K.mtx, M.mtx (the yardstick); by pyYeti and pyNastran: *.op4; by pyNastran: *.pch and body.bdf; here, as
the documentation of Abaqus has it, for no free program writes it: *_STIF1.mtx, *_MASS1.mtx and body.inp. What is committed
was made with scipy 1.17, pyNastran 1.4.1 and pyYeti 1.4.7. All is compressed with gzip.
"""

import gzip
import itertools
import pathlib
import tempfile

import numpy as np
import scipy.io
import scipy.sparse
from pyNastran.bdf.bdf import BDF
from pyNastran.op4.op4 import OP4
from pyyeti.nastran import op4

HERE = pathlib.Path(__file__).parent
FOLDER = pathlib.Path(tempfile.mkdtemp())
YOUNG, POISSON, DENSITY = 206e9, 0.3, 7850.0

# Labels with gaps, in the order of the rows.
LABELS = [2, 3, 5, 7, 11, 13, 17, 19, 102, 105, 1000, 70000]
PLACES = np.array([(x, y, z) for z in (0.0, 0.05, 0.11) for (x, y) in ((0, 0), (0.04, 0), (0.045, 0.03), (0, 0.03))])
CELLS = [list(range(8)), list(range(4, 12))]
CORNERS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])


def assembled():
    shear = YOUNG / 2 / (1 + POISSON)
    lame = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
    law = np.diag([2 * shear] * 3 + [shear] * 3)
    law[:3, :3] += lame
    size = 3 * len(LABELS)
    stiffness, mass = np.zeros((size, size)), np.zeros((size, size))
    for cell in CELLS:
        dofs = [3 * node + i for node in cell for i in range(3)]
        for point in itertools.product((-(3**-0.5), 3**-0.5), repeat=3):
            factors = 1 + CORNERS * point
            shapes = factors.prod(axis=1) / 8
            slopes = np.stack([CORNERS[:, i] * np.delete(factors, i, axis=1).prod(axis=1) / 8 for i in range(3)])
            jacobian = slopes @ PLACES[cell]
            volume = np.linalg.det(jacobian)
            slopes = np.linalg.solve(jacobian, slopes)
            strain = np.zeros((6, 24))
            for node, (x, y, z) in enumerate(slopes.T):
                strain[:, 3 * node : 3 * node + 3] = [(x, 0, 0), (0, y, 0), (0, 0, z), (y, x, 0), (0, z, y), (z, 0, x)]
            stiffness[np.ix_(dofs, dofs)] += volume * strain.T @ law @ strain
            mass[np.ix_(dofs, dofs)] += volume * DENSITY * np.kron(np.outer(shapes, shapes), np.eye(3))
    return [np.tril(own) + np.tril(own, -1).T for own in (stiffness, mass)]


K, M = assembled()
# Strings of values need gaps.
K[abs(K) < 1e-9 * abs(K).max()] = 0.0
DOFS = [(label, i + 1) for label in LABELS for i in range(3)]


def markets():
    for name, matrix in (("K", K), ("M", M)):
        scipy.io.mmwrite(FOLDER / f"{name}.mtx", scipy.sparse.coo_matrix(matrix), symmetry="symmetric", precision=17)
    with open(FOLDER / "dofs.csv", "w") as table:
        table.write("node, direction, x [m], y [m], z [m]\n")
        for label, place in zip(LABELS, PLACES):
            for direction in "xyz":
                table.write(f"{label}, {direction}, {place[0]}, {place[1]}, {place[2]}\n")


def op4s():
    both = {"kaa": (K, 6), "maa": (M, 6)}
    for sparse in ("dense", "bigmat", "nonbigmat"):
        for binary, order in ((False, ""), (True, "<"), (True, ">")):
            end = {"": "text", "<": "little", ">": "big"}[order]
            op4.write(FOLDER / f"yeti-{sparse}-{end}.op4", both, binary=binary, digits=16, endian=order, sparse=sparse)
    op4.write(FOLDER / "yeti-complex.op4", {"kaa": (K * (1 + 0.01j), 6), "maa": (M, 6)}, binary=False)
    op4.write(FOLDER / "yeti-one.op4", {"maa": (M, 6)}, binary=True)
    # What pyNastran 1.4.1 writes as binary has no lengths of records, and its strings have the length of their column.
    for precision in ("double", "single"):
        matrices = {"KAA": (6, K), "MAA": (1, M)}
        OP4(debug=False).write_op4(str(FOLDER / f"nastran-{precision}-text.op4"), matrices, ["KAA", "MAA"], precision=precision, is_binary=False)


def punches():
    model = BDF(debug=None)
    for name, matrix, form in (("KAAX", K, 6), ("MAAX", M, 1)):
        places = [(i, j) for j in range(len(DOFS)) for i in range(len(DOFS)) if matrix[i, j] and (form == 1 or i >= j)]
        rows, columns = [DOFS[i] for i, _ in places], [DOFS[j] for _, j in places]
        model.add_dmig(name, form, 2, 0, 0, len(DOFS), columns, rows, [matrix[place] for place in places])
    model.write_bdf(str(FOLDER / "body.pch"), size=16)
    model = BDF(debug=None)
    for label, place in zip(LABELS, PLACES):
        model.add_grid(label, place)
    model.add_set1(4, LABELS[:4])
    model.write_bdf(str(FOLDER / "body.bdf"), size=16)


def abaqus():
    for name, matrix in (("STIF", K), ("MASS", M)):
        # Lines of the lower half, row by row.
        with open(FOLDER / f"input_{name}1.mtx", "w") as file:
            for i, j in zip(*np.nonzero(np.tril(matrix))):
                (a, b), (c, d) = DOFS[i], DOFS[j]
                file.write(f"{a},{b}, {c},{d}, {matrix[i, j]:23.15e}\n")
        # All of it, with blanks.
        with open(FOLDER / f"labels_{name}1.mtx", "w") as file:
            for i, j in zip(*np.nonzero(matrix)):
                (a, b), (c, d) = DOFS[i], DOFS[j]
                file.write(f"{a:8d} {b} {c:8d} {d} {matrix[i, j]:23.15e}\n")
        with open(FOLDER / f"coordinate_{name}1.mtx", "w") as file:
            for i, j in zip(*np.nonzero(matrix)):
                file.write(f"{i + 1:8d}, {j + 1:8d}, {matrix[i, j]:23.15e}\n")
    with open(FOLDER / "body.inp", "w") as file:
        file.write("*NODE\n")
        for label, place in zip(LABELS, PLACES):
            file.write(f"{label}, {place[0]}, {place[1]}, {place[2]}\n")
        file.write("*NSET, NSET=FOOT\n" + ", ".join(map(str, LABELS[:4])) + "\n")


markets()
op4s()
punches()
abaqus()
for path in sorted(FOLDER.iterdir()):
    with open(HERE / f"{path.name}.gz", "wb") as packed:
        with gzip.GzipFile(filename="", mode="wb", fileobj=packed, mtime=0) as file:
            file.write(path.read_bytes())
