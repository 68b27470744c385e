# The rotor and the housing of docs/own-mesh.md, in millimetres: `pip install gmsh`, then `python models.py`.
# `python models.py 3` makes cells of a third of the size.
import sys

import gmsh

FINER = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0


def save(name, size):
    gmsh.model.occ.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMax", size / FINER)
    gmsh.option.setNumber("Mesh.MeshSizeMin", size / FINER / 8)
    gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 12 * FINER)
    gmsh.option.setNumber("Mesh.ElementOrder", 2)
    gmsh.option.setNumber("Mesh.HighOrderOptimize", 1)
    gmsh.model.mesh.generate(3)
    gmsh.write(name)
    gmsh.clear()


gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
model = gmsh.model.occ

# A shaft along z with two journals and a disc.
left = model.addCylinder(0, 0, 0, 0, 0, 20, 10)
middle = model.addCylinder(0, 0, 20, 0, 0, 60, 12)
disc = model.addCylinder(0, 0, 45, 0, 0, 10, 35)
right = model.addCylinder(0, 0, 80, 0, 0, 20, 10)
model.fuse([(3, left)], [(3, middle), (3, disc), (3, right)])
save("rotor.msh", 20)

# Two plates with bores on a base.
base = model.addBox(-30, -40, -5, 10, 80, 110)
plates = [(3, model.addBox(-20, -25, z, 50, 50, 20)) for z in (0, 80)]
body, _ = model.fuse([(3, base)], plates)
model.cut(body, [(3, model.addCylinder(0, 0, z, 0, 0, 22, 10.05)) for z in (-1, 79)])
save("housing.msh", 25)
gmsh.finalize()
