"""Bodies with ties in the input of CalculiX: clamped cantilevers of two parts, with the frequencies that CalculiX prints.

    pip install pyNastran && apt install calculix-ccx && python ties.py

What is committed was made with CalculiX 2.20 and pyNastran 1.4.
"""

import gzip
import pathlib
import re
import subprocess
import tempfile

HERE = pathlib.Path(__file__).parent
MATERIAL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210e9, 0.3\n*DENSITY\n7800.\n*SOLID SECTION, ELSET=PART1, MATERIAL=STEEL\n*SOLID SECTION, ELSET=PART2, MATERIAL=STEEL\n"


def pack(name, text):
    (HERE / f"{name}.gz").write_bytes(gzip.compress(text.encode(), mtime=0))


def brick(first, low, high, cells):
    """Nodes and cells of a block of C3D20 without nodes that are in no cell."""
    nodes, lines = {}, []

    def node(*at):
        if at not in nodes:
            nodes[at] = first + len(nodes)
        return nodes[at]

    ring = [(0, 0), (2, 0), (2, 2), (0, 2)]
    middle = [(1, 0), (2, 1), (1, 2), (0, 1)]
    for k in range(cells[2]):
        for j in range(cells[1]):
            for i in range(cells[0]):
                own = [node(2 * i + x, 2 * j + y, 2 * k + z) for z in (0, 2) for x, y in ring]
                own += [node(2 * i + x, 2 * j + y, 2 * k + z) for z in (0, 2) for x, y in middle]
                own += [node(2 * i + x, 2 * j + y, 2 * k + 1) for x, y in ring]
                lines.append(own)
    places = {
        label: tuple(low[a] + at[a] / (2 * cells[a]) * (high[a] - low[a]) for a in range(3))
        for at, label in nodes.items()
    }
    return places, lines


def deck(name, cards, coarse, fine, point=None):
    """Writes the file with its frequencies as comments above."""
    lower, lower_cells = brick(1, (0, 0, 0), (0.02, 0.03, 0.1), coarse)
    upper, upper_cells = brick(2001, (0, 0, 0.1), (0.02, 0.03, 0.2), fine)
    text = "*NODE, NSET=ALL\n"
    for label, at in {**lower, **upper, **({5001: point} if point else {})}.items():
        text += f"{label}, " + ", ".join(f"{x:.12g}" for x in at) + "\n"
    for part, cells in ((1, lower_cells), (2, upper_cells)):
        text += f"*ELEMENT, TYPE=C3D20, ELSET=PART{part}\n"
        for number, own in enumerate(cells):
            text += f"{1000 * part + number}, " + ", ".join(map(str, own[:10])) + ",\n"
            text += ", ".join(map(str, own[10:])) + "\n"
    ends = {
        "BASE": [n for n, at in lower.items() if at[2] == 0],
        "LOWSEAM": [n for n, at in lower.items() if abs(at[2] - 0.1) < 1e-9],
        "SEAM": [n for n, at in upper.items() if abs(at[2] - 0.1) < 1e-9],
        "TIP": [n for n, at in upper.items() if abs(at[2] - 0.2) < 1e-9],
    }
    for set_name, members in ends.items():
        text += f"*NSET, NSET={set_name}\n" + "".join(f"{n},\n" for n in members)
    last = len(lower_cells) - coarse[0] * coarse[1]
    text += "*ELSET, ELSET=LAST\n" + "".join(f"{1000 + n},\n" for n in range(last, len(lower_cells)))
    text += "*SURFACE, NAME=LEADS, TYPE=ELEMENT\nLAST, S2\n"
    first = fine[0] * fine[1]
    text += "*ELSET, ELSET=FIRST\n" + "".join(f"{2000 + n},\n" for n in range(first))
    text += "*SURFACE, NAME=FOLLOWS, TYPE=ELEMENT\nFIRST, S1\n"
    text += cards(lower, upper, ends) + MATERIAL
    text += "*BOUNDARY\nBASE, 1, 3\n*STEP\n*FREQUENCY\n8\n*END STEP\n"
    folder = pathlib.Path(tempfile.mkdtemp())
    (folder / f"{name}.inp").write_text(text)
    done = subprocess.run(["ccx", name], cwd=folder, capture_output=True, text=True)
    printed = (folder / f"{name}.dat").read_text()
    hertz = re.findall(r"^\s+\d+\s+\S+\s+\S+\s+(\S+)\s+\S+\s*$", printed.split("P A R T I C I P A T I O N")[0], re.M)
    assert len(hertz) == 8, (done.stdout[-2000:], printed)
    head = "** Frequencies (Hz) by CalculiX, of the body held at BASE:\n"
    pack(f"ties-{name}.inp", head + "".join(f"**HERTZ {own}\n" for own in hertz) + text)
    print(name, hertz)


TIE = "*TIE, NAME=SEAM, POSITION TOLERANCE=1e-4\nFOLLOWS, LEADS\n"


def equations(lower, upper, ends):
    text = "*EQUATION\n"
    for own in ends["SEAM"]:
        other = next(n for n in ends["LOWSEAM"] if max(abs(a - b) for a, b in zip(lower[n], upper[own])) < 1e-9)
        text += "".join(f"2\n{own}, {k}, 1., {other}, {k}, -1.\n" for k in (1, 2, 3))
    return text


def rigid(lower, upper, ends):
    return TIE + "*RIGID BODY, NSET=TIP, REF NODE=5001\n"


def both(lower, upper, ends):
    return equations(lower, upper, ends) + "*RIGID BODY, NSET=TIP, REF NODE=5001\n"


deck("equations", equations, (2, 1, 2), (2, 1, 2))
deck("faces", lambda *_: TIE, (2, 1, 2), (3, 2, 2))
deck("nested", lambda *_: TIE, (2, 1, 2), (4, 2, 2))
deck("rigid", rigid, (2, 1, 2), (3, 2, 2), (0.07, -0.04, 0.31))
deck("both", both, (2, 1, 2), (2, 1, 2), (0.07, -0.04, 0.31))


def by_pynastran():
    """The last body as pyNastran writes it: MPC chosen by case control, RBE2."""
    from pyNastran.bdf.bdf import BDF, CaseControlDeck

    lower, lower_cells = brick(1, (0, 0, 0), (0.02, 0.03, 0.1), (2, 1, 2))
    upper, upper_cells = brick(2001, (0, 0, 0.1), (0.02, 0.03, 0.2), (2, 1, 2))
    model = BDF(debug=False)
    model.sol = 103
    model.case_control_deck = CaseControlDeck(["METHOD = 1", "MPC = 7", "BEGIN BULK"])
    for label, at in {**lower, **upper, 5001: (0.07, -0.04, 0.31)}.items():
        model.add_grid(label, at)
    for number, own in enumerate(lower_cells + upper_cells):
        model.add_chexa(number + 1, 1, own[:12] + own[16:] + own[12:16])
    model.add_psolid(1, 1)
    model.add_mat1(1, 210e9, None, 0.3, rho=7800.0)
    for own in (n for n, at in upper.items() if abs(at[2] - 0.1) < 1e-9):
        other = next(n for n in lower if max(abs(a - b) for a, b in zip(lower[n], upper[own])) < 1e-9)
        for k in "123":
            model.add_mpc(7, [own, other], [k, k], [1.0, -1.0])
    model.add_rbe2(9001, 5001, "123456", [n for n, at in upper.items() if abs(at[2] - 0.2) < 1e-9])
    model.add_set1(3, [n for n, at in lower.items() if at[2] == 0])
    model.add_eigrl(1, nd=8)
    file = pathlib.Path(tempfile.mkdtemp()) / "ties-both.bdf"
    model.write_bdf(str(file), size=16, is_double=True)
    pack(file.name, file.read_text())


by_pynastran()
