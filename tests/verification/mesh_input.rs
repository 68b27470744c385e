//! Reading Abaqus and CalculiX input: what is accepted, and what is refused.

mod errors;

use proptest::prelude::*;
use whirl_benches::hand::elements::ELEMENTS;
use whirl_solver::error::InputErrors;
use whirl_solver::mesh::format::ReadOptions;
use whirl_solver::mesh::inp::{self, ReadMesh};
use whirl_solver::mesh::{Cell, Material, Mesh};

use crate::bodies::reference;

const GOOD: &str = "*HEADING
A cube and a wedge
** nodes
*Node, nset=All
 1, 0, 0, 0
 2, 1., 0, 0
 3, 1.0D0, 1e0, 0
 4, 0, 1, 0
 5, 0, 0, 1
 6, 1, 0, 1
 7, 1, 1, 1
 8, 0, 1, 1
 9, 2, 0, 0
10, 2, 0, 1
*ELEMENT, TYPE=C3D8I, ELSET=CUBE
101, 1, 2, 3, 4,
     5, 6, 7, 8
*ELEMENT, TYPE=C3D6, ELSET=WEDGE
102, 2, 9, 3, 6, 10, 7
*NSET, NSET=BOTTOM, GENERATE
1, 4
*NSET, NSET=Ends
BOTTOM, 5,
6
*NSET, NSET=bottom
9
*NSET, NSET=ODD, GENERATE
1, 9, 2
*ELSET, ELSET=ALL
CUBE, 102
*MATERIAL, NAME=Steel
*ELASTIC, TYPE=ISOTROPIC
200e9, 0.3
*DENSITY
7860
*SOLID SECTION,
 ELSET=ALL, MATERIAL=STEEL
1.
*STEP
*STATIC
*END STEP
";

fn read(text: &str) -> Result<ReadMesh, InputErrors> {
    inp::read(text, "cube.inp", &ELEMENTS)
}

fn labels(mesh: &Mesh, set: &str) -> Vec<u64> {
    mesh.node_set(set).unwrap().iter().map(|&node| mesh.labels()[node]).collect()
}

#[test]
fn a_good_file_gives_its_mesh() {
    let ReadMesh { mesh, warnings, .. } = read(GOOD).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!((mesh.nodes().len(), mesh.cell_count(), mesh.origin()), (10, 2, "cube.inp"));
    assert_eq!(mesh.nodes()[2], [1.0, 1.0, 0.0]);
    let names: Vec<&str> = mesh.blocks().iter().map(|b| b.element.origin.name).collect();
    assert_eq!(names, ["hex8i", "wedge6"]);
    assert_eq!(mesh.blocks()[0].connectivity, [0, 1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(mesh.blocks()[1].connectivity, [1, 8, 2, 5, 9, 6]);
    assert_eq!(mesh.blocks()[1].labels, [102]);
    assert_eq!(labels(&mesh, "BOTTOM"), [1, 2, 3, 4, 9]);
    assert_eq!(labels(&mesh, "ends"), [1, 2, 3, 4, 5, 6]);
    assert_eq!(labels(&mesh, "ODD"), [1, 3, 5, 7, 9]);
    assert_eq!(labels(&mesh, "ALL").len(), 10);
    assert_eq!(mesh.element_sets()["ALL"].len(), 2);
    let steel = &mesh.materials()[0];
    assert_eq!(steel.name, "Steel");
    let values: Vec<(&str, f64)> =
        steel.properties.iter().map(|(name, &value)| (name.as_str(), value)).collect();
    assert_eq!(values, [("E", 200e9), ("nu", 0.3), ("rho", 7860.0)]);
    let warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    // A heading says nothing of the mesh.
    assert_eq!(warnings, ["cube.inp:39:1: *STEP is left out"]);
    let error = mesh.node_set("BOTOM").unwrap_err().to_string();
    assert_eq!(error, "cube.inp has no node set called BOTOM; did you mean BOTTOM?");
    let error = mesh.single_node("ODD").unwrap_err().to_string();
    assert_eq!(error, "cube.inp: node set ODD must have one node, it has 5");
}

/// What no solid has may be meant: a stiff part, or one that only holds others.
#[test]
fn stiff_parts_and_parts_without_mass_are_warned_of() {
    for (from, to, said, key) in [
        (
            "200e9, 0.3",
            "200e12, 0.3",
            "cube.inp:33:1: in material Steel (E = 200000000000000 Pa, ρ = 7860 kg/m³) sound would travel at 1.595e5 m/s\n  help: if that is meant, leave it; units are m, Pa and kg/m³: steel is 200e9 and 7860",
            ("E", 200e12),
        ),
        (
            "*DENSITY\n7860",
            "*DENSITY\n0",
            "cube.inp:35:1: material Steel has no mass: its density is 0\n  help: if that is meant, leave it; units are m, Pa and kg/m³: steel is 200e9 and 7860",
            ("rho", 0.0),
        ),
    ] {
        let text = GOOD.replace(from, to);
        assert_ne!(text, GOOD);
        let ReadMesh { mesh, warnings, .. } =
            read(&text).unwrap_or_else(|errors| panic!("{errors}"));
        assert_eq!(mesh.materials()[0].properties[key.0], key.1);
        assert!(warnings.iter().any(|warning| warning.to_string() == said), "{warnings:?}");
    }
    for (from, to) in [("200e9, 0.3", "0, 0.3"), ("*DENSITY\n7860", "*DENSITY\n-1")] {
        assert!(
            read(&GOOD.replace(from, to)).unwrap_err().to_string().contains("must be positive")
        );
    }
}

#[test]
fn windows_line_ends_and_capitals_do_not_matter() {
    let mesh = read(&GOOD.to_lowercase().replace('\n', "\r\n")).unwrap().mesh;
    assert_eq!((mesh.nodes().len(), mesh.cell_count()), (10, 2));
    assert_eq!(labels(&mesh, "BOTTOM"), [1, 2, 3, 4, 9]);
}

#[test]
fn reference_meshes_have_their_sets() {
    let shaft = reference("shaft");
    assert_eq!(shaft.node_sets().len(), 12 + 2 + 3 + 1);
    assert_eq!(shaft.nodes()[shaft.single_node("LOAD2").unwrap()][2], 0.702);
    let support = reference("support");
    assert_eq!(support.node_sets().len(), 12 + 2 + 1);
    assert!(support.node_sets().values().all(|set| set.len() >= 3));
}

#[test]
fn what_is_odd_but_readable_is_a_warning() {
    let text = GOOD
        .replace("10, 2, 0, 1\n", "10, 2, 0, 1\n11, 900, 0, 0\n")
        .replace("*STEP", "*NSTE, NSET=A\n*STEP");
    let ReadMesh { mesh, warnings, .. } = read(&text).unwrap();
    assert_eq!(mesh.nodes().len(), 10);
    assert_eq!(labels(&mesh, "ALL").len(), 10);
    let warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        warnings[0],
        "cube.inp:15:1: 1 node in no cell, left out: 11\n  help: delete them, or add the cells that they belong to"
    );
    assert_eq!(warnings[1], "cube.inp:40:1: *NSTE is left out\n  help: is *NSET meant?");
    let millimetres = GOOD.replace(" 9, 2, 0, 0", " 9, 2000, 0, 0");
    let warnings = read(&millimetres).unwrap().warnings;
    assert_eq!(
        warnings[0].to_string(),
        "cube.inp: the mesh is 2000 m long\n  help: if its coordinates are in mm, write `units = \"mm, N, t\"` beside `mesh` \
         in the case"
    );
}

/// A cell without a section takes what the reader is to leave open; whatever else is wrong is said.
#[test]
fn sections_may_be_left_open() {
    let (whole, by) = ("ELSET=ALL, MAT", "ELSET=CUBE, MAT");
    let text = GOOD.replace(whole, by);
    let options = ReadOptions { open: true, ..ReadOptions::new(&ELEMENTS) };
    let open = |text: &str| inp::read_with(text, "cube.inp", &options);
    let mesh = open(&text).unwrap_or_else(|errors| panic!("{errors}")).mesh;
    let names: Vec<&str> = mesh.materials().iter().map(|own| own.name.as_str()).collect();
    assert_eq!(names, ["Steel", ""]);
    let tin = Material::isotropic("tin", 50e9, 0.36, 7300.0).unwrap();
    let bare = |cell: Cell| mesh.materials()[mesh.blocks()[cell.block].material].name.is_empty();
    let filled = mesh.with_material(&tin, bare).unwrap();
    let blocks: Vec<(&str, u64)> = filled
        .blocks()
        .iter()
        .map(|block| (filled.materials()[block.material].name.as_str(), block.labels[0]))
        .collect();
    assert_eq!(blocks, [("Steel", 101), ("tin", 102)]);
    // Sets still hold the same cells, also where blocks are parted.
    let parted = filled.with_material(&tin, |cell| cell.block == 0).unwrap();
    assert_eq!(parted.materials().len(), 1);
    let cells = parted.element_set("all").unwrap().iter();
    let labels: Vec<u64> = cells.map(|c| parted.blocks()[c.block].labels[c.cell]).collect();
    assert_eq!(labels, [101, 102]);
    assert!(open(&GOOD.replace("7860", "-1").replace(whole, by)).is_err());
}

/// Text that is not UTF-8 is Latin-1.
#[test]
fn older_programs_write_latin_1() {
    let mut bytes = b"** Welle f\xfcr den Pr\xfcfstand \xa9\n".to_vec();
    bytes.extend(GOOD.replace("NSET=ODD", "NSET=M\u{e4}rz").chars().map(|c| c as u8));
    let text = inp::decode(bytes);
    assert!(text.starts_with("** Welle für den Prüfstand ©\n"));
    assert_eq!(labels(&read(&text).unwrap().mesh, "März"), [1, 3, 5, 7, 9]);
    assert_eq!(inp::decode("µ".to_owned().into_bytes()), "µ");
}

proptest! {
    /// Any damage to a file is read or refused, never a panic.
    #[test]
    fn damaged_files_never_panic(
        cuts in prop::collection::vec((0..GOOD.len(), 0..12usize, "[-*,=\n0-9A-Ze. \"é]{0,6}"), 1..6),
    ) {
        let mut text = GOOD.to_owned();
        for (at, length, by) in cuts {
            let floor = |i: usize| (0..=i.min(text.len())).rev().find(|&i| text.is_char_boundary(i));
            let (from, to) = (floor(at).unwrap_or(0), floor(at + length).unwrap_or(0));
            text.replace_range(from..to, &by);
        }
        if let Err(errors) = read(&text) {
            prop_assert!(!errors.0.is_empty());
            prop_assert!(errors.0.iter().all(|error| !error.what.is_empty()));
        }
    }
}
