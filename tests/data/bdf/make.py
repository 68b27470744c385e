"""Writes the bulk data of this folder with pyNastran 1.4 (pip install pyNastran): one cell of every solid element
in a chain of turned coordinate systems, in small, large and double fields, and where pyNastran puts the nodes."""

from pyNastran.bdf.bdf import BDF

CORNERS = {
    "CTETRA": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    "CPYRAM": [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1)],
    "CPENTA": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
    "CHEXA": [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
}
# Edges in the order in which the cards list the nodes on them.
EDGES = {
    "CTETRA": [(1, 2), (2, 3), (1, 3), (1, 4), (2, 4), (3, 4)],
    "CPENTA": [(1, 2), (2, 3), (1, 3), (1, 4), (2, 5), (3, 6), (4, 5), (5, 6), (4, 6)],
    "CHEXA": [(1, 2), (2, 3), (3, 4), (1, 4), (1, 5), (2, 6), (3, 7), (4, 8), (5, 6), (6, 7), (7, 8), (5, 8)],
}

model = BDF(debug=False)
model.add_mat1(1, 2.1e11, None, 0.3, rho=7850.0)
model.add_psolid(4, 1, comment="HMNAME PROP             4\"every element\" 4\n")
# The basic system, turned rectangular, cylindrical in that, spherical in the cylindrical one.
model.add_cord2r(3, [0.1, 0.2, 0.3], [0.3, 0.3, 1.2], [1.0, 0.1, 0.2])
model.add_cord2c(5, [0.5, -0.25, 0.125], [0.5, 0.75, 0.5], [1.5, 0.25, 0.0], rid=3)
model.add_cord2s(7, [1.0, 30.0, 0.5], [1.25, 60.0, 1.0], [2.0, 45.0, 0.5], rid=5)
model.add_grid(901, [0.0, 0.0, 0.0], cp=5)
model.add_grid(902, [0.5, 90.0, 1.0], cp=5)
model.add_grid(903, [1.0, 10.0, 0.25], cp=5)
model.add_cord1c(9, 901, 902, 903)

node, cell = 1, 1
for card, corners in CORNERS.items():
    for edges in [[], EDGES.get(card)]:
        if edges is None:
            continue
        middles = [tuple((a + b) / 2 for a, b in zip(corners[i - 1], corners[j - 1])) for i, j in edges]
        for system in [5, 7, 9]:
            nodes = []
            for x, y, z in corners + middles:
                if system == 7:
                    at = [2.0 + 0.25 * z, 80.0 + 8.0 * x, 40.0 + 8.0 * y]
                else:
                    at = [2.0 + 0.25 * x, 40.0 + 8.0 * y, 1.0 * cell + 0.5 * z]
                model.add_grid(node, at, cp=system)
                nodes.append(node)
                node += 1
            getattr(model, "add_" + card.lower())(cell, 4, nodes)
            cell += 1

model.add_rbe2(51, 901, "123", [1, 2, 3])
model.add_rbe3(52, 902, "123456", [1.0], ["123"], [[4, 5, 6, 7, 8, 9, 10, 11]])
model.add_conm2(61, 901, 2.5, cid=0, X=[0.0, 0.1, 0.0], I=[0.1, 0.0, 0.2, 0.01, 0.0, 0.3])
model.add_ctria3(71, 8, [1, 2, 3])
model.add_force(1, 1, 10.0, [0.0, 0.0, 1.0])
model.add_spc1(1, "123", [1, 2, 3])

for name, options in [("small", {"size": 8}), ("large", {"size": 16}), ("double", {"size": 16, "is_double": True})]:
    model.write_bdf(f"every-element-{name}.bdf", interspersed=False, **options)

read = BDF(debug=False)
read.disable_cards(["CTRIA3"])
read.read_bdf("every-element-double.bdf", validate=False, punch=True)
with open("every-element.csv", "w") as out:
    for label, grid in sorted(read.nodes.items()):
        out.write(",".join([str(label)] + [repr(float(x)) for x in grid.get_position()]) + "\n")
