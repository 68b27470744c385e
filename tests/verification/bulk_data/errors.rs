//! Every error of a file, with its place and its remedy: the texts are in errors.txt, which WHIRL_RENEW_GOLDEN=1
//! writes anew.

use std::path::Path;

use whirl_solver::mesh::bdf;
use whirl_solver::mesh::format::{MeshUnits, ReadOptions};

use super::{GOOD, read};

const SOLID_1: &str = "CHEXA        101       1       1       2       3       4       5       6\n               7       8\n";
const NODE_9: &str = "GRID           9              2.      0.      0.";

/// Passages of the good file, and what stands in their place.
const CASES: &[(&str, &str)] = &[
    // Fields.
    (NODE_9, "GRID           9              2.     one      0."),
    (NODE_9, "GRID           9              2.  1.+999      0."),
    (NODE_9, "GRID 9 2. 0. 0."),
    (NODE_9, "GRID      9    0    2.   0.    0."),
    (NODE_9, "GRID          -9              2.      0.      0."),
    (NODE_9, "GRID                          2.      0.      0."),
    (NODE_9, "GRID,9,,2.,0.,0.,,,,,9.5"),
    (NODE_9, "GRID*,9,,2.,0.,0."),
    ("1.*\n*                     0.", "1.*A\n*B                    0."),
    ("$HMNAME PROP                   1\"cube\" 4\n", "+A      7\n"),
    ("PARAM,POST,-1", "PARAM,WTMASS,-1."),
    ("PARAM,POST,-1", "PARAM,WTMASS,2.\nPARAM,WTMASS,2.\nPARAM,WTMASS,3."),
    // Nodes and systems.
    (NODE_9, "GRID           9       7      2.      0.      0."),
    ("GRID,5,,0.,0.,1.\nGRID,6,,", "GRID,5,7,0.,0.,1.\nGRID,6,7,"),
    (NODE_9, "GRID           9              2.      0.      0.\nGRID,9,,2.,0.,1."),
    (NODE_9, "GRID,9,,2.,0.,0.,,,3"),
    (NODE_9, "GRID,9,,2.,0.,0.\nCORD2R,7,8,0.,0.,0.,0.,0.,1.\n,1.,0.,0."),
    (
        NODE_9,
        "GRID,9,7,2.,0.,0.\nCORD2R,7,8,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCORD2C,8,9,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCORD2S,9,7,0.,0.,0.,0.,0.,1.\n,1.,0.,0.",
    ),
    (NODE_9, "GRID,9,7,2.,0.,0.\nCORD1R,7,9,1,2"),
    (NODE_9, "GRID,9,7,2.,0.,0.\nCORD2R,7,,0.,0.,0.,0.,0.,1.\n,0.,0.,2."),
    (NODE_9, "GRID,9,7,2.,0.,0.\nCORD1R,7,1,2,77"),
    (NODE_9, "GRID,9,7,2.,0.,0.\nCORD1C,7,1,2,3\nCORD1C,7,1,2,4"),
    (NODE_9, "GRID,9,,2.,0.,0.\nGRDSET,,7\nGRDSET,,8\nCORD1C,7,1,2,3"),
    // Elements.
    (SOLID_1, "CHEXA        101       1       1       2       3       4       5       6\n"),
    (
        SOLID_1,
        "CHEXA        101       1       1       2       3       4       5       6\n               7       8       9               10\n",
    ),
    (
        SOLID_1,
        "CHEXA        101       1       1       2       3       4       5       6\n               7      88\n",
    ),
    (
        SOLID_1,
        "CHEXA        101       1       1       2       3       4       5       6\n               7       1\n",
    ),
    (SOLID_1, "CHEXA,101,1,1,2,3,4,5,6\n,7,8,11,12,13,14,15,16\n,17,18,19,20,21,22,23,24\n"),
    (SOLID_1, "CPYRAM,101,1,1,2,3,4,5\n"),
    ("MAT1           1 ", "CPENTA,102,2,2,9,3,6,10,7\nMAT1           1 "),
    ("MAT1           1 ", "CPENTA,103,2,6,10,7,2,9,3\nMAT1           1 "),
    // Materials.
    ("PSOLID         2       2\n", ""),
    ("PSOLID         2       2\n", "PSOLID,2,7\n"),
    ("PSOLID         2       2\n", "PSOLID,2,7\nMAT9,7,1.,2.\n"),
    ("PSOLID         2       2\n", "PLSOLID,2,2\n"),
    ("PSOLID         2       2\n", "PSOLID,2,2\nPSOLID,2,1\n"),
    ("PSOLID         2       2\n", "PSOLID,2,2,,,,,PFLUID\n"),
    ("7.+10              .3   2700.", "7.+10   7.+10      .3   2700."),
    ("7.+10              .3   2700.", "7.+10                   2700."),
    ("7.+10              .3   2700.", "7.+10   1.+10           2700."),
    ("7.+10              .3   2700.", "7.+10              .3        "),
    ("7.+10              .3   2700.", "7.+10              .5   2700."),
    ("7.+10              .3   2700.", "-7.+1              .3   2700."),
    // Interfaces and masses.
    (
        "RBE2          17      20     123       1       2       3",
        "RBE2          17      20     123       1     THR       3",
    ),
    (",7\nCONM2", ",x\nCONM2"),
    ("CONM2         21      20", "CONM2         21      77"),
    ("CONM2         21      20           5.5", "CONM2         21      20       7   -5.5"),
    // What would change the mesh.
    ("BEGIN BULK", "MPC = 1\nSUBCASE 2\nMPC = 2\nBEGIN BULK\nMPC,1,1,1,1.,2,1,-1."),
    ("PSHELL", "MPC,1,1,1,1.,2,1,-1.\nMPC,1,1,12,1.,2,2,-1.\nPSHELL"),
    ("PSHELL", "RBAR,9,1,2,1234\nPSHELL"),
    ("PSHELL", "RSPLINE,9,.1,1,2,123,3\nPSHELL"),
    ("PSHELL", "RBE1,9,1,12345\n,UM,2,123\nPSHELL"),
    ("BEGIN BULK", "BEGIN SUPER=3"),
    ("PSHELL", "BEGIN BULK\nPSHELL"),
    ("PSHELL", "INCLUDE 'more.bdf'\nPSHELL"),
    ("PSHELL", "INCLUDE\nPSHELL"),
    // A file of another kind.
    (GOOD, ""),
    (GOOD, "*NODE\n1, 0., 0., 0.\n*ELEMENT, TYPE=C3D8\n1, 1, 2, 3\n"),
];

#[test]
fn every_error_says_where_what_and_how_to_fix_it() {
    let mut found = String::new();
    for (passage, by) in CASES {
        assert_eq!(GOOD.matches(passage).count(), 1, "{passage}");
        let errors = match read(&GOOD.replace(passage, by)) {
            Ok(_) => panic!("{by} was accepted"),
            Err(errors) => errors.to_string(),
        };
        found += &format!("--- {}\n{errors}\n\n", by.trim_end().replace('\n', "\n    "));
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("verification/bulk_data/errors.txt");
    whirl_tests::golden::is_as_committed(&path, &found);
}

#[test]
fn all_errors_are_given_at_once_in_the_order_of_the_lines() {
    let text = GOOD
        .replace("7860.", "heavy")
        .replace("      10       7\n", "      10      77\n")
        .replace("GRID,5,,0.", "GRID,5,,x");
    let errors = read(&text).unwrap_err();
    let lines: Vec<usize> = errors.0.iter().map(|error| error.line).collect();
    assert_eq!(lines, [16, 25, 26]);
}

/// Ties of a node beside the elements join nothing that is read.
#[test]
fn ties_that_join_no_two_nodes_of_elements_are_left_out() {
    let text = GOOD
        .replace("PSHELL ", "GRID,21\nGRID,22\nRBAR,9,1,21,123456\nMPC,1,22,3,1.,7,3,-1.\nPSHELL ");
    let text = text.replace("BEGIN BULK", "MPC = 1\nBEGIN BULK");
    let warnings = super::good(&text).warnings;
    let warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    let known = "left out, as they join no two nodes of solid elements: 1 MPC, 1 RBAR";
    assert!(warnings.iter().any(|warning| warning.ends_with(known)), "{warnings:?}");
}

/// The material of a file is another one than that of a case: E and ν stay where the density is missing.
#[test]
fn a_material_without_density_keeps_what_it_has() {
    let text = GOOD.replacen("   7860.", "", 1);
    let open = ReadOptions { open: true, ..super::options() };
    let mesh = bdf::read(&text, "cube.bdf", &open, &super::no_files).unwrap().mesh;
    let material = &mesh.materials()[mesh.blocks()[0].material];
    assert_eq!((material.properties["E"], material.properties["nu"]), (2e11, 0.3));
    assert_eq!(material.lacks(), Some("density"));
    let error = read(&text).unwrap_err().to_string();
    assert!(error.starts_with("cube.bdf:26:1: material MAT1_1 has no density"), "{error}");
    // No element is of this material: it is not missed.
    let unused = text.replace("PSOLID         1       1", "PSOLID         1       2");
    assert_eq!(super::good(&unused).mesh.materials().len(), 2);
    // One that is written as 0 is meant.
    let text = GOOD.replacen("   7860.", "      0.", 1);
    let massless = super::good(&text);
    let said: Vec<String> = massless.warnings.iter().map(ToString::to_string).collect();
    assert!(
        said.iter().any(|own| own.contains("material MAT1_1 has no mass: its density is 0")),
        "{said:?}"
    );
    assert_eq!(massless.mesh.materials()[0].properties["rho"], 0.0);
    let units = MeshUnits { length: 1e-3, force: 1.0, mass: 1e3 };
    let options = ReadOptions { units, ..super::options() };
    let text = GOOD.replacen("   7860.", "", 1);
    let error = bdf::read(&text, "cube.bdf", &options, &super::no_files).unwrap_err().to_string();
    assert!(error.contains("such as 7.86e-9 (steel)"), "{error}");
}

#[test]
fn what_is_odd_but_readable_is_a_warning() {
    let text = GOOD
        .replace("CQUAD4       201       3       1       2       3       4\nPSHELL         3       1     .01\nSPC1           1     123       1       2\n", "GRIP,1\nGRIP,2\n")
        .replace("\n,7\n", "\n,7,.5,123,8\n")
        .replace(NODE_9, "GRID,99\nGRID,9,,2.,0.,0.,,123");
    let warnings = super::good(&text).warnings;
    let warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        warnings,
        [
            "cube.bdf: constraints (PS) of 1 node are left out\n  help: hold nodes by `mounts` or joints of the case",
            "cube.bdf:6:1: 1 of the labels of SET 6 are no nodes of solid elements\n  help: a set of elements is of no \
             use; the node set ends has the others",
            "cube.bdf:20:1: 1 node in no cell, left out: 99\n  help: delete them, or add the cells that they belong to",
            "cube.bdf:33:1: the weights of RBE3 18 are not applied\n  help: the motion of a set is its mean by area",
            "cube.bdf:36:1: GRIP is left out (2 cards)\n  help: is GRID meant?",
        ]
    );
    // Beside elements that are left out, whose nodes are no loose ones: node 99 is.
    let text = GOOD.replace(NODE_9, &format!("GRID,99\n{NODE_9}"));
    let warnings = super::good(&text).warnings;
    let loose: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    let loose: Vec<&String> = loose.iter().filter(|own| own.contains("in no cell")).collect();
    assert!(loose.len() == 1 && loose[0].contains("left out: 99"), "{loose:?}");
}
