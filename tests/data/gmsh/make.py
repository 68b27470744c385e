"""Writes the meshes of this folder with Gmsh (pip install gmsh; made with 4.15.2): python make.py

Every body is written as version 2.2 and 4.1, as text and as binary, and in UNV, and compressed with gzip.
"""

import gzip
import pathlib

import gmsh

HERE = pathlib.Path(__file__).parent


def groups(volumes, name="body"):
    """A named volume, a named and an unnamed surface, a curve and a point."""
    model = gmsh.model
    model.addPhysicalGroup(3, volumes, 1, name)
    low = [tag for dim, tag in model.getEntitiesInBoundingBox(-9, -9, -1e-6, 9, 9, 1e-6, 2)]
    model.addPhysicalGroup(2, low, 2, "low end")
    high = [tag for dim, tag in model.getEntitiesInBoundingBox(-9, -9, 2 - 1e-6, 9, 9, 2 + 1e-6, 2)]
    model.addPhysicalGroup(2, high, 7)
    curve = model.getBoundary([(2, low[0])], oriented=False)[0][1]
    model.addPhysicalGroup(1, [curve], 4, "edge")
    point = model.getBoundary([(1, curve)], combined=False, oriented=False)[0][1]
    model.addPhysicalGroup(0, [point], 5, "corner")


def write(name):
    for version, digits in ((2.2, "22"), (4.1, "41")):
        for binary in (0, 1):
            gmsh.option.setNumber("Mesh.MshFileVersion", version)
            gmsh.option.setNumber("Mesh.Binary", binary)
            pack(HERE / f"{name}-{digits}-{'binary' if binary else 'text'}.msh")
    # Its groups of faces and lines as elements, and once more as nodes.
    gmsh.option.setNumber("Mesh.SaveGroupsOfNodes", 1)
    pack(HERE / f"{name}.unv")


def pack(path):
    gmsh.write(str(path))
    with open(f"{path}.gz", "wb") as packed:
        with gzip.GzipFile(filename="", mode="wb", fileobj=packed, mtime=0) as file:
            file.write(path.read_bytes())
    path.unlink()


def start(name):
    gmsh.clear()
    gmsh.model.add(name)
    gmsh.option.setNumber("Mesh.SaveAll", 0)
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 1)


def cylinder_of(name, order):
    """Tetrahedra in a cylinder of radius 1 and length 2 about z."""
    start(name)
    tag = gmsh.model.occ.addCylinder(0, 0, 0, 0, 0, 2, 1)
    gmsh.model.occ.synchronize()
    groups([tag])
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.9)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.9)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(order)
    write(name)


def box_of(name, order, recombine):
    """Wedges, or hexahedra, in a box of 1 × 1 × 2."""
    start(name)
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.6)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.6)
    square = gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
    out = gmsh.model.occ.extrude([(2, square)], 0, 0, 2, [2], recombine=True)
    gmsh.model.occ.synchronize()
    if recombine:
        gmsh.model.mesh.setTransfiniteSurface(square)
        gmsh.model.mesh.setRecombine(2, square)
    groups([tag for dim, tag in out if dim == 3])
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(order)
    write(name)


def pyramids_of(name, order):
    """A cube of 2 × 2 × 2 as six pyramids, which is in two groups."""
    start(name)
    tag = gmsh.model.addDiscreteEntity(3)
    corners = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
    points = corners + [(1, 1, 1)]
    gmsh.model.mesh.addNodes(3, tag, range(1, 10), [x for point in points for x in point])
    faces = [(1, 2, 3, 4), (8, 7, 6, 5), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 8, 4), (4, 8, 5, 1)]
    nodes = [node for face in faces for node in (*face, 9)]
    gmsh.model.mesh.addElements(3, tag, [7], [list(range(1, 7))], [nodes])
    gmsh.model.addPhysicalGroup(3, [tag], 1, "body")
    gmsh.model.addPhysicalGroup(3, [tag], 3)
    gmsh.model.mesh.setOrder(order)
    write(name)


def partitioned(name):
    """The tetrahedra of a cylinder, whole and cut into three parts with entities of their own."""
    start(name)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.8)
    volume = gmsh.model.occ.addCylinder(0, 0, 0, 0, 0, 2, 0.5)
    gmsh.model.occ.synchronize()
    groups([volume])
    gmsh.model.mesh.generate(3)
    write(f"{name}-whole")
    gmsh.option.setNumber("Mesh.PartitionCreateTopology", 1)
    gmsh.model.mesh.partition(3)
    write(f"{name}-parts")


gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
cylinder_of("tet4", 1)
cylinder_of("tet10", 2)
box_of("wedge6", 1, False)
box_of("wedge15", 2, False)
box_of("hex8", 1, True)
box_of("hex20", 2, True)
pyramids_of("pyramid5", 1)
pyramids_of("pyramid13", 2)
partitioned("cut")
gmsh.finalize()
