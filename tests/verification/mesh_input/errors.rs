//! Every error of a mesh file, with its place and its remedy.

use super::{GOOD, read};

/// Reads the good file with one passage replaced and gives its errors.
fn errors(passage: &str, by: &str) -> String {
    assert_eq!(GOOD.matches(passage).count(), 1, "{passage}");
    match read(&GOOD.replace(passage, by)) {
        Ok(_) => panic!("{by} was accepted"),
        Err(errors) => errors.to_string(),
    }
}

/// As files that share an interface have it.
#[test]
fn a_node_may_stand_twice_at_one_place() {
    let twice = read(&GOOD.replace(" 9, 2, 0, 0\n", " 9, 2, 0, 0\n 9, 2., 0\n")).expect("a mesh");
    let once = read(GOOD).expect("a mesh");
    assert_eq!(twice.mesh.nodes(), once.mesh.nodes());
    assert_eq!(twice.mesh.node_sets(), once.mesh.node_sets());
}

#[test]
fn every_error_says_where_what_and_how_to_fix_it() {
    let cases = [
        // Nodes.
        (
            " 4, 0, 1, 0\n",
            " 4, 0, 1, 0, 0, 0, 1, 5\n",
            "cube.inp:8:2: node 4 has 7 coordinates\n  help: write label, x, y, z",
        ),
        (
            " 4, 0, 1, 0\n",
            " 4, 0, one, 0\n",
            "cube.inp:8:8: coordinate must be a number, found `one`\n  help: write it as 0.0115 or 1.15e-2",
        ),
        (
            " 4, 0, 1, 0\n",
            " 4, 0, inf, 0\n",
            "cube.inp:8:8: coordinate must be a number, found `inf`\n  help: write it as 0.0115 or 1.15e-2",
        ),
        (
            " 9, 2, 0, 0\n",
            " 9, 2, 0, 0\n 9, 2, 0, 1\n",
            "cube.inp:14:2: node 9 is defined twice\n  help: line 13 has the first; give this one another label",
        ),
        (
            " 9, 2, 0, 0\n",
            " 9, 2, 0, 0\n-3, 2, 0, 0\n",
            "cube.inp:14:1: label of a node must be a whole number from 1, found `-3`\n  help: write a label such as `17`, without a sign or decimals",
        ),
        (
            "*Node, nset=All",
            "*Node, nset=All, system=C",
            "cube.inp:4:18: only rectangular coordinates are read\n  help: write x, y, z",
        ),
        (
            "*HEADING\nA cube and a wedge\n",
            "1, 2, 3\n",
            "cube.inp:1:1: data before the first keyword\n  help: begin with *NODE",
        ),
        // Cells.
        (
            "TYPE=C3D6",
            "TYPE=C3D7",
            "cube.inp:18:16: no element is known for type C3D7\n  help: did you mean C3D8? solids that are read: C3D8, C3D8I, C3D6",
        ),
        (
            "TYPE=C3D6, ",
            "",
            "cube.inp:18:1: *ELEMENT needs TYPE=\n  help: write *ELEMENT, TYPE=C3D8I, ELSET=NAME",
        ),
        (
            "TYPE=C3D6, ",
            "TPYE=C3D6, ",
            "cube.inp:18:1: *ELEMENT needs TYPE=\n  help: is TPYE meant to be TYPE?",
        ),
        (
            "102, 2, 9, 3, 6, 10, 7",
            "102, 2, 9, 3, 6, 10, 77",
            "cube.inp:19:22: cell 102 has node 77, which is not defined\n  help: add it under *NODE, or correct the label",
        ),
        (
            "102, 2, 9, 3, 6, 10, 7",
            "102, 2, 9, 3, 6, 10, 2",
            "cube.inp:19:22: cell 102 has node 2 twice\n  help: correct the label, or use an element with fewer nodes",
        ),
        (
            "102, 2, 9, 3, 6, 10, 7",
            "102, 2, 9, 3, 6, 10",
            "cube.inp:19:1: cell 102 has 5 nodes, wedge6 needs 6\n  help: write label, then the nodes",
        ),
        (
            "*NSET, NSET=BOTTOM, GENERATE",
            "*ELEMENT, TYPE=C3D6\n101, 2, 9, 3, 6, 10, 7\n*NSET, NSET=BOTTOM, GENERATE",
            "cube.inp:21:1: cell 101 is defined twice\n  help: line 16 has the first; give this one another label",
        ),
        // Sets.
        (
            "BOTTOM, 5,",
            "BOTOM, 5,",
            "cube.inp:23:1: no set of nodes called BOTOM stands above this line\n  help: did you mean BOTTOM?",
        ),
        (
            "1, 9, 2\n",
            "1, 10, 2\n",
            "cube.inp:28:1: from 1 one does not come to 10 in steps of 2\n  help: let last − first be a multiple of the step",
        ),
        (
            "1, 9, 2\n",
            "1\n",
            "cube.inp:28:1: GENERATE needs first, last, step; found 1 values\n  help: write 1, 100, 1",
        ),
        (
            "*NSET, NSET=Ends",
            "*NSET, NSTE=Ends",
            "cube.inp:22:1: *NSET needs NSET=\n  help: is NSTE meant to be NSET?",
        ),
        // Parameters.
        (
            "*Node, nset=All",
            "*Node, nset=All, FILE=more.txt",
            "cube.inp:4:18: FILE of *NODE is not read\n  help: take it out if the mesh is the same without it; else write out what it stands for",
        ),
        (
            "TYPE=C3D6, ELSET",
            "TYPE=C3D6, OFFSET=100, ELSET",
            "cube.inp:18:22: OFFSET of *ELEMENT is not read\n  help: take it out if the mesh is the same without it; else write out what it stands for",
        ),
        (
            "BOTTOM, GENERATE",
            "BOTTOM, GENERTE",
            "cube.inp:20:21: GENERTE of *NSET is not read\n  help: is GENERATE meant?",
        ),
        (
            "TYPE=ISOTROPIC",
            "TYPE=ISOTROPIC, NO COMPRESSION",
            "cube.inp:32:27: NO COMPRESSION of *ELASTIC is not read\n  help: take it out if the mesh is the same without it; else write out what it stands for",
        ),
        (
            "*DENSITY\n",
            "*DENSITY, DISTRIBUTION TABLE=A\n",
            "cube.inp:34:11: DISTRIBUTION TABLE of *DENSITY is not read\n  help: take it out if the mesh is the same without it; else write out what it stands for",
        ),
        (
            "*SOLID SECTION,\n",
            "*SOLID SECTION, COMPOSITE,\n",
            "cube.inp:36:17: COMPOSITE of *SOLID SECTION is not read\n  help: take it out if the mesh is the same without it; else write out what it stands for",
        ),
        // Materials.
        (
            "7860\n",
            "-7860\n",
            "cube.inp:35:1: the density of Steel is -7860\n  help: it must be positive, or 0 of a part without mass",
        ),
        (
            "200e9, 0.3",
            "0, 0.3",
            "cube.inp:33:1: the Young's modulus of Steel is 0\n  help: it must be positive",
        ),
        (
            "200e9, 0.3",
            "200e9, 0.5",
            "cube.inp:33:8: Poisson's ratio of Steel is 0.5\n  help: it lies between −1 and 0.5, both excluded",
        ),
        (
            "200e9, 0.3",
            "200e9",
            "cube.inp:33:1: *ELASTIC lacks the Poisson's ratio\n  help: write E, ν below *ELASTIC, and ρ below *DENSITY",
        ),
        (
            "200e9, 0.3",
            "200e9, 0, 0, 3",
            "cube.inp:33:14: *ELASTIC of Steel has 4 values on its line\n  help: write decimals with points, such as 0.3, and one line of values with their temperature at most",
        ),
        (
            "200e9, 0.3",
            "200e9, 0.3\n190e9, 0.3",
            "cube.inp:34:1: *ELASTIC has 2 lines\n  help: keep one line, or write the temperature of each behind its Poisson's ratio",
        ),
        (
            "ISOTROPIC",
            "ORTHOTROPIC",
            "cube.inp:32:16: material Steel is ORTHOTROPIC: only isotropic materials are read\n  help: write *ELASTIC and E, ν",
        ),
        (
            "*DENSITY\n7860\n",
            "",
            "cube.inp:31:1: material Steel has no *DENSITY\n  help: write *DENSITY and a line such as 7860 (steel) below its *MATERIAL, or give the cells another material by `regions` in the case",
        ),
        (
            "*MATERIAL, NAME=Steel\n",
            "",
            "cube.inp:31:1: *ELASTIC belongs to no material\n  help: put *MATERIAL, NAME=… above it\ncube.inp:33:1: *DENSITY belongs to no material\n  help: put *MATERIAL, NAME=… above it\ncube.inp:36:22: no material is called STEEL\n  help: there are none",
        ),
        (
            "*SOLID SECTION,",
            "*MATERIAL, NAME=STEEL\n*SOLID SECTION,",
            "cube.inp:36:1: material STEEL is defined twice\n  help: line 31 has the first",
        ),
        (
            "200e9, 0.3",
            "200e9, 0.3\n*ELASTIC\n210e9, 0.3",
            "cube.inp:35:1: the Young's modulus of Steel is given twice: 200000000000 and 210000000000\n  help: line 33 has the first: keep one",
        ),
        (
            "7860",
            "7860\n*DENSITY\n7800",
            "cube.inp:37:1: the density of Steel is given twice: 7860 and 7800\n  help: line 35 has the first: keep one",
        ),
        (
            "200e9, 0.3",
            "200e9, 0.49999999",
            "cube.inp:33:8: material Steel is nearly incompressible: with ν = 0.49999999 it is 5.0e7 times as stiff against change of volume as against shear\n  help: write 0.4999 or less",
        ),
        (
            "200e9, 0.3",
            "200e9, -0.99999999",
            "cube.inp:33:8: material Steel hardly shears: with ν = -0.99999999 it is 4.5e8 times as stiff against shear as against change of volume\n  help: write -0.9999 or more",
        ),
        // Cells of other types, and cells that stand twice.
        (
            "TYPE=C3D8I",
            "TYPE=C3D20R",
            "cube.inp:15:16: no element is known for type C3D20R\n  help: solids that are read: C3D8, C3D8I, C3D6",
        ),
        (
            "*NSET, NSET=Ends",
            "*ELEMENT, TYPE=C3D6, ELSET=CUBE\n103, 6, 10, 7, 2, 9, 3\n*NSET, NSET=Ends",
            "cube.inp:23:1: cell 103 has the nodes of cell 102\n  help: take one of them out: line 19 has the first",
        ),
        (
            "*NSET, NSET=Ends",
            "*ELEMENT, TYPE=C3D8I, ELSET=CUBE\n103, 1, 2, 3, 4, 5, 6, 7, 8\n104, 1, 2, 3, 4, 5, 6, 7, 8\n*NSET, NSET=Ends",
            "cube.inp:23:1: 2 cells have the nodes of others: 103, 104; cell 103 those of cell 101\n  help: take them out, or their originals, of which line 16 has the first",
        ),
        // Sections.
        (
            "MATERIAL=STEEL",
            "MATERIAL=STEAL",
            "cube.inp:37:22: no material is called STEAL\n  help: did you mean Steel?",
        ),
        (
            "ELSET=ALL, MAT",
            "ELSET=AL, MAT",
            "cube.inp:37:8: no set of cells is called AL\n  help: did you mean ALL?",
        ),
        (
            "ELSET=ALL, MAT",
            "ELSET=CUBE, MAT",
            "cube.inp:19:1: 1 cell without a section: 102\n  help: add *SOLID SECTION, ELSET=…, MATERIAL=… for a set that holds them; in a case `material` serves, too",
        ),
        (
            "*STEP",
            "*MATERIAL, NAME=TIN\n*ELASTIC\n50e9, 0.3\n*DENSITY\n7300\n*SOLID SECTION, ELSET=CUBE, MATERIAL=TIN\n*STEP",
            "cube.inp:44:1: 1 cell with two materials: 101\n  help: line 36 gave the first",
        ),
        (
            "*STEP",
            "*SOLID SECTION, ELSET=CUBE\n*STEP",
            "cube.inp:39:1: *SOLID SECTION needs MATERIAL=\n  help: write *SOLID SECTION, ELSET=NAME, MATERIAL=NAME",
        ),
        // What would change the mesh.
        (
            "*STEP",
            "*INCLUDE, INPUT=more.inp\n*STEP",
            "cube.inp:39:17: there is no file `more.inp`\n  help: paths are relative to the file that names them",
        ),
        (
            "*STEP",
            "*NGEN\n1, 4\n*STEP",
            "cube.inp:39:1: *NGEN is not read, but changes the mesh\n  help: write the mesh out in full, in one file and in x, y, z",
        ),
        (
            "*STEP",
            "*INSTANCE, NAME=A, PART=B\n0, 5\n*STEP",
            "cube.inp:40:1: an *INSTANCE is moved by other numbers than these\n  help: write x, y, z, and below them two points and an angle: ax, ay, az, bx, by, bz, angle",
        ),
    ];
    let mut wrong = Vec::new();
    for (passage, by, expected) in cases {
        let found = errors(passage, by);
        if found != expected {
            wrong.push(format!("{by}\nexpected {expected}\nfound    {found}\n"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn all_errors_are_given_at_once_in_the_order_of_the_lines() {
    let text = GOOD
        .replace("7860", "-1")
        .replace("102, 2, 9, 3, 6, 10, 7", "102, 2, 9, 3, 6, 10, 77")
        .replace(" 5, 0, 0, 1\n", " 5, 0, 0, x\n");
    let errors = read(&text).unwrap_err();
    let lines: Vec<usize> = errors.0.iter().map(|error| error.line).collect();
    assert_eq!(lines, [9, 19, 35]);
}

#[test]
fn an_empty_file_has_no_cells() {
    for text in ["", "** nothing\n"] {
        let error = read(text).unwrap_err().to_string();
        let expected =
            "cube.inp: the file has no cells\n  help: add *ELEMENT with its TYPE and cells";
        assert_eq!(error, expected);
    }
}
