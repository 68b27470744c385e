use super::foreign;

fn what(bytes: &[u8], path: &str) -> Option<(&'static str, String)> {
    foreign(bytes, path).map(|found| (found.what, found.help))
}

#[test]
fn files_of_other_formats_are_named() {
    let iges = format!("{:<72}S      1\n", "");
    let mut stl = vec![b' '; 84 + 50];
    stl[80..84].copy_from_slice(&1u32.to_le_bytes());
    for (bytes, path, known, command) in [
        (
            &b"\x89HDF\r\n\x1a\n"[..],
            "a/part.med",
            "a MED file of Salome (HDF5)",
            "`gmsh part.med -save -format msh41 -o part.msh`",
        ),
        (b"/COM,my part\n", "part.cdb", "an archive of ANSYS (CDB)", "Archive('part.cdb')"),
        (b"! ANSYS\n", "part.cdb", "an archive of ANSYS (CDB)", "Archive('part.cdb')"),
        (
            b"# vtk DataFile Version 3.0\n",
            "part.vtk",
            "a VTK file",
            "`meshio convert part.vtk part.inp`",
        ),
        (
            b"<?xml version=\"1.0\"?>\n<VTKFile",
            "p.vtu",
            "a VTK file in XML",
            "`meshio convert p.vtu p.inp`",
        ),
        (
            b"ISO-10303-21;\n",
            "p.stp",
            "a STEP file",
            "`gmsh p.stp -3 -order 2 -format msh41 -o p.msh`",
        ),
        (iges.as_bytes(), "p.igs", "an IGES file", "`gmsh p.igs -3"),
        (b"solid part\n facet normal 0 0 1\n", "p.stl", "an STL file", "without a volume"),
        (&stl, "p", "an STL file", "without a volume"),
        (
            b"version https://git-lfs.github.com/spec/v1\n",
            "part.msh",
            "a pointer of Git LFS, not the file itself",
            "run `git lfs pull`",
        ),
        (b"\x1f\x8b\x08", "p.inp.gz", "compressed by gzip", "`gunzip -k p.inp.gz`"),
        (b"PK\x03\x04", "p.zip", "a zip archive", "`unzip p.zip`"),
        (
            b"\xff\xfe*\0",
            "p.inp",
            "text in UTF-16",
            "`iconv -f UTF-16 -t UTF-8 p.inp > p-utf8.inp`",
        ),
        (b"\n<!DOCTYPE html>", "p.inp", "a web page", "raw"),
        (b"*KEYWORD\n*NODE\n", "p.k", "an input of LS-DYNA", "LS-PrePost"),
        (b"$# LS-DYNA\n*KEYWORD\n*NODE\n", "p.key", "an input of LS-DYNA", "LS-PrePost"),
        (
            b"1\n3 3 3\n0 0 0 \n0 0 0 \n",
            "p.p3d",
            "a PLOT3D file",
            "`gmsh p.p3d -save -format msh41 -o p.msh`",
        ),
        (b" 2\n 2 2 2 4 2 2\n", "p.p3dfmt", "a PLOT3D file", "`gmsh p.p3d -save"),
        (b"1\r\n 2 3 4\r\n 0. 1.\r\n", "p.xyz", "a PLOT3D file", "merge"),
        (b"2 3 4\n 0.0 1.0 -2.5e-1\n", "p", "a PLOT3D file", "merge"),
        (
            b"(0 \"Fluent\")",
            "p.msh",
            "a mesh of Fluent",
            "`meshio convert --input-format ansys p.msh p.inp`",
        ),
    ] {
        let (found, help) = what(bytes, path).unwrap_or_else(|| panic!("{known}"));
        assert_eq!(found, known);
        assert!(help.contains(command), "{help}");
    }
}

#[test]
fn files_that_are_read_are_not_foreign() {
    for (bytes, path) in [
        (&b"*NODE\n1, 0, 0, 0\n"[..], "part.cdb"),
        (b"** a\n*HEADING\n", "a.inp"),
        (b"\xef\xbb\xbf*NODE\n", "a.inp"),
        (b"$MeshFormat\n4.1 0 8\n", "a.med"),
        (b"$ bulk\nGRID,1\n", "a.unv"),
        (b"    -1\n  2411\n", "a.unv"),
        (b"", "a.unv"),
        (b"SOL 101\nCEND\n", "a.dat"),
        (b"TITLE = VARIABLES OF A ZONE\nSOL 103\nCEND\n", "a.dat"),
        (b"$ a\nGRID,1\n", "a.vol"),
        (b"    -1\n  2411\n", "mesh.nodes"),
        (b"** from a FLAC3D grid\n*NODE\n1, 0, 0, 0\n", "a.f3grid"),
        (b"GRID,1", "a"),
        (b"1, 0., 0., 0.\n", "nodes.txt"),
        (b"1 2 3\n4 5 6\n", "sets.txt"),
        (b"1\n2 3\n", "numbers"),
        (b"", "a.msh"),
    ] {
        assert_eq!(what(bytes, path), None, "{path}");
    }
}

/// By their content: the names say nothing.
#[test]
fn meshes_of_other_programs_are_known_by_their_content() {
    let flac = "* FLAC3D grid produced by meshio\n* GRIDPOINTS\nG\t1\t0.0\t0.0\t0.0\n";
    let flac_zones = "* made by hand\nG 1 0.0 0.0 0.0\nG 2 1.0 0.0 0.0\n";
    let dyna = "$ no keyword line\n*PART\n$ title\nrotor\n*ELEMENT_SOLID\n";
    let patran = "25       0       0       1       0       0       0       0       0\nROTOR\n\
                  26       0       0       1       8       1       0       0       0\n";
    let foam = "/*-----*- C++ -*-----*\\\n| OpenFOAM |\n\\*----*/\nFoamFile\n{\n}\n";
    let iges = format!("{:<72}S0000001\r\n", "");
    for (text, known, command) in [
        (
            "mesh3d\ndimension\n3\n",
            "a mesh of Netgen",
            "meshio convert --input-format netgen a.dat a.inp",
        ),
        ("# made\n\n# twice\nmesh3d\n", "a mesh of Netgen", "--input-format netgen"),
        ("!PERMAS DataFile\n$ENTER COMPONENT\n", "an input of PERMAS", "--input-format permas"),
        ("! of a part\n!\n$ENTER COMPONENT\n", "an input of PERMAS", "--input-format permas"),
        ("Begin ModelPartData\nEnd ModelPartData\n", "a mesh of Kratos", "--input-format mdpa"),
        ("// a part\nBegin Properties 0\n", "a mesh of Kratos", "--input-format mdpa"),
        ("# UCD\n5 2 0 0 0\n1 0.0 0.0 0.0\n", "a mesh of AVS (UCD)", "--input-format avsucd"),
        ("4 1 1 0 0\n1 0 0 0\n", "a mesh of AVS (UCD)", "--input-format avsucd"),
        ("# t\n5 3 0 0\n0 0.0 0.0 0.0\n", "a mesh of TetGen", "--input-format tetgen"),
        ("<?xml version=\"1.0\"?>\n<!-- a -->\n<dolfin>\n", "a mesh of DOLFIN (XML)", "dolfin-xml"),
        ("5 0 0 2 0 0 0\n0.0 0.0 0.0\n", "a mesh in UGRID", "--input-format ugrid"),
        (flac, "a grid of FLAC3D", "--input-format flac3d"),
        (flac_zones, "a grid of FLAC3D", "--input-format flac3d"),
        (dyna, "an input of LS-DYNA", "LS-PrePost"),
        (patran, "a neutral file of Patran", "export the mesh itself"),
        ("        CONTROL INFO 2.4.6\n", "a neutral file of Gambit", "export the mesh itself"),
        (foam, "a file of OpenFOAM", "foamMeshToFluent"),
        (&iges, "an IGES file", "gmsh a.dat -3"),
        (
            "TITLE = \"a\"\nVARIABLES = \"X\"\nZONE NODES = 5\n",
            "a file of Tecplot",
            "--input-format tecplot",
        ),
        ("MESH dimension 3 ElemType Tetrahedra Nnode 4\n", "a mesh of GiD", "export the mesh"),
        ("# made by hand\nv 0 0 0\nv 1 0 0\n", "an OBJ file", "without a volume"),
        ("o part\nv 0.0 0 0\n", "an OBJ file", "without a volume"),
        ("OFF 14 24 0\n0 0 1\n", "an OFF file", "without a volume"),
        ("(2 3)\n(10 (0 1 5 0))\n", "a mesh of Fluent", "--input-format ansys a.dat"),
        ("! ANSYS input file written by Workbench\n/batch,list\n", "an input of ANSYS", "mapdl"),
        ("! of a part\n*DIM,A,TABLE,3\nNBLOCK,6,SOLID\n", "an archive of ANSYS (CDB)", "mapdl"),
        ("<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\">\n<Xdmf>", "an XDMF file", "--input-format xdmf"),
    ] {
        let (found, help) = what(text.as_bytes(), "a.dat").unwrap_or_else(|| panic!("{known}"));
        assert_eq!(found, known, "{text}");
        assert!(help.contains(command), "{known}: {help}");
    }
}

#[test]
fn files_of_hdf_and_netcdf_are_known_by_what_they_hold() {
    const HDF: &str = "\u{1}HDF\r\n\u{1a}\n";
    for (holds, path, known, command) in [
        ("tstt", "a", "a mesh of MOAB (HDF5)", "pip install meshio h5py"),
        ("", "a.h5m", "a mesh of MOAB (HDF5)", "`meshio convert a.h5m a.inp`"),
        ("INFOS_GENERALES", "a.h5", "a MED file of Salome (HDF5)", "gmsh a.h5"),
        ("HDF5 MotherNode", "a.h5", "a CGNS file (HDF5)", "gmsh a.h5"),
        ("num_nod_per_el1", "a.h5", "an Exodus file (HDF5)", "--input-format exodus a.h5 a.inp"),
        ("VTKHDF", "a.hdf", "a VTK file (HDF5)", "ParaView"),
        ("", "a.msh.h5", "a mesh of Fluent (HDF5)", "Fluent"),
        ("data0", "a.h5", "an HDF5 file, as of the numbers of an XDMF file", "a.xdmf"),
    ] {
        let mut bytes = format!("{HDF}{holds}....").into_bytes();
        bytes[0] = 0x89;
        let (found, help) = what(&bytes, path).expect(known);
        assert_eq!(found, known, "{path} {holds}");
        assert!(help.contains(command), "{known}: {help}");
    }
    let table = [&b"CDF\x01"[..], &[b'.'; 80]].concat();
    for (bytes, known, command) in [
        (&b"CDF\x02....num_nodes...coordx"[..], "a netCDF file, as of Exodus", "netCDF4"),
        (&table, "a netCDF file that is no mesh of Exodus", "export"),
        (b"@(#)ADF Database Version A02011>", "a CGNS file (ADF)", "gmsh"),
        (b"\x01\0\0\0\x04\0\0\0\x03\0\0\0", "a mesh of Medit (binary)", "meshio convert"),
        (b"\xe6\xe7\xf6\x51\x03\0\0\0", "a grid of FLAC3D (binary)", "meshio convert"),
    ] {
        let (found, help) = what(bytes, "a.x").expect(known);
        assert_eq!(found, known);
        assert!(help.contains(command), "{known}: {help}");
    }
}

#[test]
fn names_of_files_tell_what_their_content_leaves_open() {
    for (path, known, command) in [
        ("p/mesh.nodes", "a mesh of Elmer", "ElmerGrid 2 4"),
        ("a.ele", "a mesh of TetGen", "`meshio convert a.ele a.inp`"),
        ("a.x_t", "a Parasolid file", "export it as STEP"),
        ("a.vol", "a mesh of Netgen", "`meshio convert a.vol a.inp`"),
        ("my part.vol", "a mesh of Netgen", "`meshio convert 'my part.vol' 'my part.inp'`"),
    ] {
        let (found, help) = what(b"1 2 3 4\n", path).expect(known);
        assert_eq!(found, known);
        assert!(help.contains(command), "{known}: {help}");
    }
    // Not over the file itself.
    let (_, help) = what(b"5 2 0 0 0\n1 0. 0. 0.\n", "a.inp").expect("AVS");
    assert!(help.contains("`meshio convert --input-format avsucd a.inp a-new.inp`"), "{help}");
}
