//! Universal files (UNV): those that Gmsh wrote (`tests/data/gmsh/make.py`) beside its own ones, and damaged ones.

use whirl_solver::assembly::mass_properties;
use whirl_solver::error::InputErrors;
use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::format::{MeshUnits, ReadMesh, ReadOptions, read};

use crate::packed::data;
use crate::{elements, open, steel};

/// Bodies that Gmsh wrote in both formats; pyramids have no descriptor.
const BODIES: [&str; 7] = ["tet4", "tet10", "wedge6", "wedge15", "hex8", "hex20", "cut-whole"];

fn universal(name: &str) -> ReadMesh {
    let name = format!("{name}.unv");
    open(&data(&format!("gmsh/{name}")), &name).unwrap_or_else(|errors| panic!("{errors}"))
}

fn of_gmsh(name: &str) -> Mesh {
    let name = format!("{name}-41-text.msh");
    open(&data(&format!("gmsh/{name}")), &name).unwrap_or_else(|errors| panic!("{errors}")).mesh
}

/// Places of nodes, as labels may differ.
fn places(mesh: &Mesh, nodes: &[usize]) -> Vec<[i64; 3]> {
    let place = |node: &usize| mesh.nodes()[*node].map(|x| (x * 1e9).round() as i64);
    let mut all: Vec<[i64; 3]> = nodes.iter().map(place).collect();
    all.sort_unstable();
    all
}

/// All cells by the places of their nodes, in the order of the element: where an order is wrong, none is the same.
fn cells(mesh: &Mesh) -> Vec<Vec<[i64; 3]>> {
    let place = |node: &usize| mesh.nodes()[*node].map(|x| (x * 1e9).round() as i64);
    let blocks = mesh.blocks().iter();
    let mut all: Vec<Vec<[i64; 3]>> =
        blocks.flat_map(|own| own.cells()).map(|cell| cell.iter().map(place).collect()).collect();
    all.sort();
    all
}

/// The same cells node by node, so that their volumes, stiffnesses and frequencies are the same; the same sets.
#[test]
fn every_body_is_that_of_the_other_format() {
    for name in BODIES {
        let (ReadMesh { mesh, warnings, .. }, known) = (universal(name), of_gmsh(name));
        // Gmsh names elements of points that it does not write; the nodes of their groups are there.
        let points = "the group `corner` has members that are not in the file";
        let known_warning = |what: &str| what.starts_with("left out: ") || what.starts_with(points);
        assert!(warnings.iter().all(|own| known_warning(&own.what)), "{warnings:?}");
        let element = |mesh: &Mesh| mesh.blocks()[0].element.origin.name;
        assert_eq!((mesh.blocks().len(), element(&mesh)), (1, element(&known)), "{name}");
        assert_eq!(mesh.nodes().len(), known.nodes().len(), "{name}");
        assert_eq!(cells(&mesh), cells(&known), "{name}");
        for (set, nodes) in known.node_sets() {
            // What Gmsh calls a group without a name, and one with a blank in it.
            let called = if set == "SURFACE_7" { "PhysicalSurface7" } else { set };
            let called = called.replace(' ', "_");
            let own = mesh.node_set(&called).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(places(&mesh, own), places(&known, nodes), "{name} {set}");
        }
        assert_eq!(mesh.node_sets().len(), known.node_sets().len(), "{name}");
        assert_eq!(mesh.element_set("body").expect("a set").len(), mesh.cell_count(), "{name}");
        let [own, other] = [&mesh, &known].map(|mesh| {
            let steel = mesh.with_material(&steel(), |_| true).expect("a material");
            mass_properties(&steel).expect("a body").volume
        });
        assert!((own / other - 1.0).abs() < 1e-12, "{name}: {own}, {other}");
    }
}

#[test]
fn what_no_element_stands_for_is_said() {
    // Gmsh leaves pyramids out of these files.
    let errors = open(&data("gmsh/pyramid5.unv"), "p.unv").map(|_| ()).unwrap_err().to_string();
    assert!(errors.contains("the file has no cells") && errors.contains("pyramids"), "{errors}");
    let errors = refused(&GOOD.replace("       111 ", "       117 "));
    assert!(
        errors.to_string().contains("cubic hexahedra are not read (descriptor 117)"),
        "{errors}"
    );
}

/// A tetrahedron with a face, a beam and groups, in older datasets, units and a coordinate system.
const GOOD: &str = "    -1
   164
         1SI: Meter (newton)           2
  1.0000000000000000D+00  1.0000000000000000D+00  1.0000000000000000D+00
  2.7314999999999998D+02
    -1
    -1
  2420
         1
part
         1         0         8
global
  1.0D+00  0.0D+00  0.0D+00
  0.0D+00  1.0D+00  0.0D+00
  0.0D+00  0.0D+00  1.0D+00
  0.0D+00  0.0D+00  0.0D+00
    -1
    -1
    15
         1         1         1        11  0.00000E+00  0.00000E+00  0.00000E+00
         2         1         1        11  1.00000E+00  0.00000E+00  0.00000E+00
    -1
    -1
  2411
        30         1         1        11
  0.0D+00  1.0D+00  0.0D+00
        40         1         1        11
  0.0D+00  0.0D+00  1.0D+00
    -1
    -1
  2412
         7       111         1         1         7         4
         1         2        30        40
         8        91         1         1         7         3
         1         2        30
         9        21         1         1         7         2
         0         0         0
         1        40
    -1
    -1
  2467
         1         0         0         0         0         0         0         1
FOOT
         8         8         0         0
         2         0         0         0         0         0         0         2

         7         1         0         0         8         9         0         0
    -1
    -1
  2430
         3         0         0         0         0         0         3
OLD
         7         1         7         2         8         7
    -1
    -1
  1710
         1
    -1
";

fn refused(text: &str) -> InputErrors {
    open(text.as_bytes(), "bad.unv").map(|_| ()).unwrap_err()
}

#[test]
fn old_datasets_units_and_groups_are_read() {
    let ReadMesh { mesh, warnings, .. } =
        open(GOOD.as_bytes(), "good.unv").unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!((mesh.cell_count(), mesh.labels()), (1, &[1, 2, 30, 40][..]));
    assert_eq!(mesh.node_set("foot").expect("a set"), [0, 1, 2]);
    assert_eq!(mesh.node_set("GROUP_2").expect("a set"), [0, 3]);
    assert_eq!(mesh.node_set("OLD").expect("a set").len(), 4);
    assert_eq!(mesh.element_set("OLD").expect("a set").len(), 1);
    let said: Vec<&str> = warnings.iter().map(|own| own.what.as_str()).collect();
    let wanted = [
        "left out: 1 line, 1 face; the nodes of their groups are node sets",
        "left out: datasets 1710",
    ];
    assert_eq!(said, wanted);
}

/// Units of dataset 164 are those of the file where the case has none; else those of the case are.
#[test]
fn units_of_the_file_are_applied() {
    let factors = "  1.0000000000000000D+00  1.0000000000000000D+00  1.0";
    assert!(GOOD.contains(factors));
    let with = |length: &str| GOOD.replace(factors, &format!("  {length}  1.0D+00  1.0"));
    let read_in = |units: MeshUnits, units_given: bool, text: &str| {
        let elements = elements();
        let options = ReadOptions { open: true, units, units_given, ..ReadOptions::new(&elements) };
        let read = read(text.as_bytes().to_vec(), "a.unv", &options).expect("a mesh");
        let said: Vec<String> = read.warnings.iter().map(|own| own.what.clone()).collect();
        (read.mesh.nodes()[1][0], said.into_iter().find(|own| own.contains("dataset 164")))
    };
    let far = |units, text: &str| read_in(units, false, text);
    let (si, mm) = (MeshUnits::default(), MeshUnits { length: 1e-3, force: 1.0, mass: 1e3 });
    assert_eq!(far(si, GOOD), (1.0, None));
    assert_eq!(far(mm, GOOD), (0.001, None));
    assert_eq!(far(mm, &with("1.0D+03")), (0.001, None));
    let said = |words: &str| Some(words.to_owned());
    let applied = said("lengths are in units of 0.001 m, as dataset 164 says");
    assert_eq!(far(si, &with("1.0D+03")), (0.001, applied));
    let inches = said("lengths are in units of 0.0254 m, as dataset 164 says");
    assert_eq!(far(si, &with("39.37007874015748")), (0.0254, inches));
    let differs = "the file says (dataset 164) that its unit of length is 0.0254 m, but it is read in units of 0.001 m";
    assert_eq!(far(mm, &with("39.37007874015748")), (0.001, said(differs)));
    // Metres that are asked for are metres.
    let differs = "the file says (dataset 164) that its unit of length is 0.001 m, but it is read in units of 1 m";
    assert_eq!(read_in(si, true, &with("1.0D+03")), (1.0, said(differs)));
    let errors = refused(&with("0.0"));
    assert_eq!((errors.0[0].line, errors.0.len()), (4, 1), "{errors}");
    assert!(errors.0[0].what.starts_with("the factors of units should stand here"), "{errors}");
}

#[test]
fn what_is_wrong_is_said_where_it_is() {
    for (from, to, line, what) in [
        (
            "  1.00000E+00  0.00",
            "  1.0000xE+00  0.00",
            21,
            "a node with its coordinates should stand here",
        ),
        (
            "  0.0D+00  1.0D+00  0.0D+00\n        40",
            "  0.0D+00  nan  0.0D+00\n        40",
            26,
            "the coordinates of a node",
        ),
        (
            "        40         1         1        11\n",
            "        30         1         1        11\n",
            27,
            "node 30 is defined twice",
        ),
        (
            "         1         2        30        40\n",
            "         1         2        30        41\n",
            32,
            "cell 7 has node 41, which is not defined",
        ),
        (
            "         1         2        30        40\n",
            "         1         2        30        30\n",
            32,
            "cell 7 has node 30 twice",
        ),
        (
            "         1         2        30        40\n",
            "         1         2        30\n",
            33,
            "4 nodes of element 7 should stand here",
        ),
        (
            "         7         4\n",
            "         7         5\n",
            33,
            "5 nodes of element 7 should stand here",
        ),
        ("         7         4\n", "         7        -4\n", 32, "the number of its nodes"),
        ("         0         1\nFOOT", "         0         9\nFOOT", 46, "should stand here"),
        (
            "         1         0         8\nglobal",
            "         1         1         8\nglobal",
            20,
            "coordinate system 1, which is cylindrical",
        ),
        (
            "        30         1         1        11\n",
            "        30         3         1        11\n",
            25,
            "node 30 is in the coordinate system 3, which is not defined in dataset 2420",
        ),
        (
            "    -1\n  2420\n",
            "    -1\n    18\n",
            20,
            "coordinate system 1, which is in dataset 18, which is not read",
        ),
        ("  2467\n", "  24x7\n", 41, "`24x7` is not the number of a dataset"),
    ] {
        assert!(GOOD.contains(from), "{from}");
        let errors = refused(&GOOD.replacen(from, to, 1));
        let found = &errors.0[0];
        assert!(found.what.contains(what), "{what}: {errors}");
        assert_eq!(found.line, line, "{what}: {errors}");
        assert!(!found.help.is_empty(), "{what}");
    }
}

/// Cut anywhere or with other bytes, a file is a mesh or refused with a cause.
#[test]
fn damaged_files_are_meshes_or_refused() {
    for end in 0..GOOD.len() {
        if let Err(errors) = open(&GOOD.as_bytes()[..end], "cut.unv") {
            assert!(!errors.0.is_empty());
        }
    }
    let mut state: u64 = 3;
    let mut next = |below: usize| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let mut refused = 0;
    for text in [GOOD.as_bytes().to_vec(), data("gmsh/hex20.unv")] {
        for _ in 0..500 {
            let mut own = text.clone();
            for _ in 0..=next(3) {
                let at = next(own.len());
                own[at] = b"-0 9\n.Dx"[next(8)];
            }
            refused += usize::from(open(&own, "other.unv").is_err());
        }
    }
    assert!(refused > 300, "{refused}");
    // One field at a time, and lines that are lost or stand twice.
    const FIELDS: [&str; 12] = [
        "",
        "-1",
        "0",
        "7",
        "8",
        "999999999",
        "-9223372036854775808",
        "18446744073709551616",
        "1e308",
        "nan",
        "-0.0",
        "x",
    ];
    let mut refused = 0;
    let (small, whole) =
        (GOOD.to_owned(), String::from_utf8(data("gmsh/wedge15.unv")).expect("a text"));
    let words = small.split_whitespace().count();
    let every = (0..words).flat_map(|word| FIELDS.map(|field| (word, field)));
    for (word, field) in every {
        refused += usize::from(open(with_field(&small, word, field).as_bytes(), "a.unv").is_err());
    }
    assert!(refused > 4 * words, "{refused} of {} fields", 12 * words);
    refused = 0;
    let words = whole.split_whitespace().count();
    for _ in 0..300 {
        let changed = with_field(&whole, next(words), FIELDS[next(FIELDS.len())]);
        refused += usize::from(open(changed.as_bytes(), "a.unv").is_err());
    }
    let lines: Vec<&str> = small.lines().collect();
    for line in 0..lines.len() {
        let mut twice = lines.clone();
        twice.insert(line, lines[line]);
        let mut lost = lines.clone();
        lost.remove(line);
        for text in [twice, lost] {
            refused += usize::from(open((text.join("\n") + "\n").as_bytes(), "a.unv").is_err());
        }
    }
    assert!(refused > 60, "{refused}");
}

/// A text with another word in place of one of its words, counted from 0.
fn with_field(text: &str, word: usize, field: &str) -> String {
    let mut at = 0;
    let piece = |own: &str, changed: &mut usize| {
        let begins = !own.trim().is_empty();
        *changed += usize::from(begins);
        match begins && *changed == word + 1 {
            true => field.to_owned() + &own[own.trim_end().len()..],
            false => own.to_owned(),
        }
    };
    text.split_inclusive(char::is_whitespace).map(|own| piece(own, &mut at)).collect()
}
