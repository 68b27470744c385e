"""Writes small meshes by other programs, as their users get them, into corpus.tar.gz, with what each of them holds in
corpus.csv.gz: name, nodes of solids, cells, volume.

    pip install gmsh meshio pyNastran && apt install calculix-ccx calculix-cgx && python make.py

What is committed was made with Gmsh 4.15, meshio 5.3, pyNastran 1.4, CalculiX 2.20 and its preprocessor cgx 2.20.
Numbers of nodes and cells, and volumes, are counted here, from the meshes that were handed to the programs.
"""

import gzip
import io
import pathlib
import subprocess
import tarfile
import tempfile

import gmsh
import meshio
import numpy as np
from pyNastran.bdf.bdf import BDF, read_bdf

HERE = pathlib.Path(__file__).parent
FOLDER = pathlib.Path(tempfile.mkdtemp())
# Types of Gmsh that are solids, with the points at which the volume of a cell is summed.
SOLIDS = {4, 5, 6, 7, 11, 17, 18}
STATIC = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*SOLID SECTION, ELSET={}, MATERIAL=STEEL\n"
STEP = "*STEP\n*STATIC\n*CLOAD\n1, 1, 1.\n*NODE FILE\nU\n*EL FILE\nS\n*END STEP\n"
rows = []


def count():
    """Nodes of solids, cells, and the volume of the mesh in Gmsh."""
    nodes, cells, volume = set(), 0, 0.0
    for kind, tags, of in zip(*gmsh.model.mesh.getElements(3)):
        assert kind in SOLIDS
        nodes.update(of)
        cells += len(tags)
        points, weights = gmsh.model.mesh.getIntegrationPoints(kind, "Gauss4")
        _, determinants, _ = gmsh.model.mesh.getJacobians(kind, points)
        volume += float((determinants.reshape(-1, len(weights)) * weights).sum())
    return len(nodes), cells, volume


def note(name, numbers):
    rows.append(f"{name},{numbers[0]},{numbers[1]},{numbers[2]:.12g}")


def by_gmsh(body, groups):
    """The mesh of a body in Gmsh's own writers."""
    options = {"inp": [("Mesh.SaveGroupsOfNodes", 0), ("Mesh.SaveGroupsOfNodes", 1)], "msh": [("Mesh.MshFileVersion", 2.2), ("Mesh.MshFileVersion", 4.1)], "bdf": [("Mesh.BdfFieldFormat", 0), ("Mesh.BdfFieldFormat", 1), ("Mesh.BdfFieldFormat", 2)]}
    for ending, ways in options.items():
        for option, value in ways:
            gmsh.option.setNumber(option, value)
            name = f"gmsh-{body}-{'groups' if groups else 'all'}-{option.split('.')[1]}-{value}.{ending}"
            gmsh.write(str(FOLDER / name))
            note(name, count())


def by_meshio(body):
    gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
    gmsh.write(str(FOLDER / "scratch.msh"))
    mesh = meshio.read(FOLDER / "scratch.msh")
    # The writer of bulk data has no room for all digits of numbers below zero.
    mesh.points = np.round(mesh.points, 6) + 0.0
    for ending, kind in [("inp", "abaqus"), ("bdf", "nastran"), ("msh", "gmsh"), ("msh", "gmsh22")]:
        if kind == "nastran" and "hex20" in body:
            continue
        name = f"meshio-{body}-{kind}.{ending}"
        meshio.write(FOLDER / name, mesh, file_format=kind)
        note(name, count())
    (FOLDER / "scratch.msh").unlink()


def by_pynastran(body):
    """Gmsh's bulk data, as pyNastran writes them, with what decks for static analyses have."""
    gmsh.option.setNumber("Mesh.BdfFieldFormat", 0)
    gmsh.write(str(FOLDER / "scratch.bdf"))
    model = read_bdf(str(FOLDER / "scratch.bdf"), punch=True, xref=False, debug=False)
    solids = {e.pid for e in model.elements.values() if e.type in ("CTETRA", "CHEXA", "CPENTA", "CPYRAM")}
    model.add_mat1(1, 2.1e11, None, 0.3)
    for pid in {e.pid for e in model.elements.values()}:
        model.properties.pop(pid, None)
        if pid in solids:
            model.add_psolid(pid, 1)
        else:
            model.add_pshell(pid, 1, 0.001)
    low = [n for n, g in model.nodes.items() if abs(g.xyz[2]) < 1e-9]
    spider = max(model.nodes) + 1
    model.add_grid(spider, [0.0, 0.0, -0.5])
    label = max(model.elements) + 1
    model.add_rbe2(label, spider, "123456", low)
    model.add_conm2(label + 1, spider, 0.25)
    model.add_spc1(1, "123456", [spider])
    for size, double, form in [(8, False, "small"), (16, False, "large"), (16, True, "double")]:
        name = f"pynastran-{body}-{form}.bdf"
        model.write_bdf(str(FOLDER / name), size=size, is_double=double, write_header=True)
        note(name, count())
    (FOLDER / "scratch.bdf").unlink()


def by_cgx():
    """A box of cgx, whose lines and faces are written beside the solids, and what CalculiX writes of an input."""
    for kind, cells, nodes in [("he8", 2 * 2 * 3, 3 * 3 * 4), ("he20", 2 * 2 * 3, 36 + 2 * 3 * 4 + 3 * 2 * 4 + 3 * 3 * 3), ("he20r", 2 * 2 * 3, 36 + 24 + 24 + 27), ("he8i", 12, 36)]:
        text = "pnt p 0 0 0\nswep all s tra 1 0 0 4\nswep all t tra 0 1 0 4\nswep all u tra 0 0 2 6\n"
        if kind in ("he8", "he8i"):
            text = text.replace(" 4\n", " 2\n").replace(" 6\n", " 3\n")
        text += f"elty all {kind}\nmesh all\nsend all abq\nquit\n"
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "box.fbd").write_text(text)
            subprocess.run(["cgx", "-bg", "box.fbd"], cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            (FOLDER / f"cgx-{kind}.inp").write_bytes((pathlib.Path(folder) / "all.msh").read_bytes())
        note(f"cgx-{kind}.inp", (nodes, cells, 2.0))


def outputs_of_ccx():
    """Results and their kin, which are no meshes."""
    gmsh.option.setNumber("Mesh.SaveGroupsOfNodes", 0)
    with tempfile.TemporaryDirectory() as folder:
        gmsh.write(str(pathlib.Path(folder) / "job.inp"))
        mesh = (pathlib.Path(folder) / "job.inp").read_text()
        # CalculiX knows no plane elements without a section.
        kept = [block for block in mesh.split("*ELEMENT") if "C3D" in block.split("\n")[0] or block.startswith("*H")]
        text = "*ELEMENT".join(kept) + "*ELSET, ELSET=EALL\nVolume1\n" + STATIC.format("EALL")
        text += "*BOUNDARY\n1, 1, 3\n2, 1, 3\n3, 1, 3\n" + STEP
        (pathlib.Path(folder) / "job.inp").write_text(text)
        subprocess.run(["ccx", "-i", "job"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        for ending in ("inp", "frd"):
            (FOLDER / f"ccx-static.{ending}").write_bytes((pathlib.Path(folder) / f"job.{ending}").read_bytes())
    note("ccx-static.inp", count())
    rows.append("ccx-static.frd,refused,a file of results of CalculiX (FRD),")


def foreign():
    # This one is read.
    gmsh.write(str(FOLDER / "foreign.unv"))
    note("foreign.unv", count())
    for ending, what in [("med", "a MED file of Salome (HDF5)"), ("vtk", "a VTK file"), ("stl", "an STL file"), ("mesh", "a mesh of Medit"), ("key", "an input of LS-DYNA"), ("su2", "a mesh of SU2"), ("step", "a STEP file"), ("brep", "a BREP file of Open Cascade")]:
        gmsh.write(str(FOLDER / f"foreign.{ending}"))
        rows.append(f"foreign.{ending},refused,{what},")
    gmsh.write(str(FOLDER / "scratch.msh"))
    mesh = meshio.read(FOLDER / "scratch.msh")
    meshio.write(FOLDER / "foreign-meshio.vtu", mesh)
    rows.append("foreign-meshio.vtu,refused,a VTK file in XML,")
    (FOLDER / "scratch.msh").unlink()


def body(name, order, shape, groups):
    gmsh.clear()
    gmsh.model.add(name)
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 1)
    gmsh.option.setNumber("Mesh.SaveAll", 0)
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.8)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.8)
    if shape == "cylinder":
        volume = gmsh.model.occ.addCylinder(0, 0, 0, 0, 0, 2, 0.5)
        gmsh.model.occ.synchronize()
    elif shape == "box":
        face = gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
        gmsh.model.occ.synchronize()
        for curve in gmsh.model.getEntities(1):
            gmsh.model.mesh.setTransfiniteCurve(curve[1], 3)
        gmsh.model.mesh.setTransfiniteSurface(face)
        gmsh.model.mesh.setRecombine(2, face)
        made = gmsh.model.occ.extrude([(2, face)], 0, 0, 2, [3], recombine=True)
        gmsh.model.occ.synchronize()
        volume = [tag for dim, tag in made if dim == 3][0]
        for curve in gmsh.model.getEntities(1):
            gmsh.model.mesh.setTransfiniteCurve(curve[1], 3)
    else:
        face = gmsh.model.occ.addDisk(0, 0, 0, 0.5, 0.5)
        made = gmsh.model.occ.extrude([(2, face)], 0, 0, 2, [2], recombine=True)
        gmsh.model.occ.synchronize()
        volume = [tag for dim, tag in made if dim == 3][0]
    if groups:
        gmsh.model.addPhysicalGroup(3, [volume], name="body")
        low = gmsh.model.getEntitiesInBoundingBox(-9, -9, -1e-6, 9, 9, 1e-6, 2)
        gmsh.model.addPhysicalGroup(2, [tag for _, tag in low], name="foot")
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(order)


gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
for shape, kinds in [("cylinder", "tet"), ("box", "hex"), ("prism", "wedge")]:
    for order in (1, 2):
        for groups in (False, True):
            name = f"{kinds}{order}"
            body(name, order, shape, groups)
            by_gmsh(name, groups)
        # meshio reads no wedges of 15 nodes.
        if name != "wedge2":
            by_meshio(name)
        if kinds != "wedge":
            by_pynastran(name)
body("tet1", 1, "cylinder", False)
outputs_of_ccx()
foreign()
by_cgx()
gmsh.finalize()

packed = io.BytesIO()
with tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as archive:
    for path in sorted(FOLDER.iterdir()):
        entry = tarfile.TarInfo(path.name)
        entry.size = path.stat().st_size
        archive.addfile(entry, io.BytesIO(path.read_bytes()))
table = "file,nodes,cells,volume\n" + "\n".join(rows) + "\n"
for name, content in [("corpus.tar", packed.getvalue()), ("corpus.csv", table.encode())]:
    with open(HERE / f"{name}.gz", "wb") as out:
        with gzip.GzipFile(filename="", mode="wb", fileobj=out, mtime=0) as file:
            file.write(content)
