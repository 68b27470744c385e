//! Cells that touch and do not share nodes: nodes at one place, hanging nodes, quadratic faces on linear ones.

use std::fmt::Write;

use whirl_solver::error::InputErrors;
use whirl_solver::mesh::format::{MeshUnits, ReadMesh, ReadOptions, read};

use super::packed::data;
use super::{elements, open};

/// Edge of a block across z, in the numbers of the file.
const WIDTH: f64 = 0.02;
/// How far another node may be from one that is taken for it, when a text is made.
const NEAR: f64 = 1e-9;

/// A mesh as it is put together.
#[derive(Default)]
struct Blocks {
    nodes: Vec<[f64; 3]>,
    cells: Vec<(&'static str, Vec<usize>)>,
}

impl Blocks {
    /// A block of cells from one z to another; `shares` says at which places nodes of other blocks are taken.
    fn add(
        &mut self,
        [across, layers]: [usize; 2],
        [from, to]: [f64; 2],
        quadratic: bool,
        shares: impl Fn([f64; 3]) -> bool,
    ) {
        let before = self.nodes.len();
        let mut node = |at: [f64; 3]| {
            let same = |known: &[f64; 3]| (0..3).all(|k| (known[k] - at[k]).abs() < NEAR);
            let first = if shares(at) { 0 } else { before };
            let known = self.nodes.iter().skip(first).position(same);
            known.map(|place| place + first).unwrap_or_else(|| {
                self.nodes.push(at);
                self.nodes.len() - 1
            })
        };
        // Corners, then middles of edges below, above and upright, as Abaqus has them.
        let corners = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]];
        let mut places: Vec<[usize; 3]> = corners.to_vec();
        places.extend(corners.map(|[x, y, _]| [x, y, 2]));
        if quadratic {
            let edges = [[1, 0], [2, 1], [1, 2], [0, 1]];
            places.extend(edges.map(|[x, y]| [x, y, 0]));
            places.extend(edges.map(|[x, y]| [x, y, 2]));
            places.extend(corners.map(|[x, y, _]| [x, y, 1]));
        }
        for layer in 0..layers {
            for cell in 0..across * across {
                let start = [cell % across, cell / across, layer].map(|k| 2 * k);
                let own = places.iter().map(|place| {
                    let at = [0, 1, 2].map(|k| (start[k] + place[k]) as f64);
                    let x = |k: usize| WIDTH * (at[k] / (2 * across) as f64 - 0.5);
                    node([x(0), x(1), from + (to - from) * at[2] / (2 * layers) as f64])
                });
                let own = own.collect();
                self.cells.push((if quadratic { "C3D20" } else { "C3D8I" }, own));
            }
        }
    }

    /// Input of Abaqus, in `scale` of a metre.
    fn text(&self, scale: f64) -> String {
        let mut text = "*NODE\n".to_owned();
        for (place, x) in self.nodes.iter().enumerate() {
            let [x, y, z] = x.map(|x| x / scale);
            writeln!(text, "{}, {x}, {y}, {z}", place + 1).unwrap();
        }
        for (place, (kind, nodes)) in self.cells.iter().enumerate() {
            let listed: Vec<String> = nodes.iter().map(|node| (node + 1).to_string()).collect();
            let lines: Vec<String> = listed.chunks(10).map(|own| own.join(", ")).collect();
            writeln!(text, "*ELEMENT, TYPE={kind}\n{}, {}", place + 1, lines.join(",\n")).unwrap();
        }
        let ends = self.nodes.iter().enumerate().filter(|(_, x)| x[2] == MEETING);
        text += "*NSET, NSET=MEETING\n";
        ends.for_each(|(place, _)| writeln!(text, "{}", place + 1).unwrap());
        text
    }
}

/// Where both blocks of a bar meet.
const MEETING: f64 = 0.04;

/// A bar of two blocks of 2 × 2 cells in a layer, which share the nodes at which `shares` is true.
fn bar(shares: impl Fn([f64; 3]) -> bool) -> Blocks {
    let mut own = Blocks::default();
    own.add([2, 2], [0.0, MEETING], false, |_| true);
    own.add([2, 2], [MEETING, 0.08], false, shares);
    own
}

fn read_with(text: &str, merge: Option<f64>, units: MeshUnits) -> Result<ReadMesh, InputErrors> {
    let elements = elements();
    let options = ReadOptions { open: true, merge, units, ..ReadOptions::new(&elements) };
    read(text.as_bytes().to_vec(), "bar.inp", &options)
}

fn warnings(text: &str) -> Vec<String> {
    let read = open(text.as_bytes(), "bar.inp").unwrap();
    read.warnings.iter().map(|warning| format!("{} {}", warning.what, warning.help)).collect()
}

#[test]
fn a_bar_whose_blocks_share_their_nodes_is_sound() {
    assert_eq!(warnings(&bar(|_| true).text(1.0)), Vec::<String>::new());
    let mut quadratic = Blocks::default();
    quadratic.add([2, 2], [0.0, 0.04], true, |_| true);
    quadratic.add([2, 2], [0.04, 0.08], true, |_| true);
    assert_eq!(warnings(&quadratic.text(1.0)), Vec::<String>::new());
}

#[test]
fn nodes_at_one_place_are_counted_and_named() {
    // Three of the nine nodes of the meeting, then all.
    for (pairs, joined) in [(3, bar(|[x, ..]| x < 0.005)), (9, bar(|_| false))] {
        let text = joined.text(1.0);
        let found = warnings(&text);
        let [found] = found.as_slice() else { panic!("{found:?}") };
        assert!(
            found.starts_with(&format!("{pairs} pairs of nodes are at one place: ")),
            "{found}"
        );
        let first = joined.nodes[27..].iter().find(|x| x[2] == MEETING).unwrap();
        let [x, y, _] = first.map(|x| (1e6 * x).round() / 1e3);
        assert!(found.contains(&format!(" at ({x}, {y}, 40 mm)")), "{found}");
        assert!(found.contains("merge = \"1e-8 m\""), "{found}");
    }
}

#[test]
fn nodes_at_one_place_merge_into_the_first_of_them() {
    let whole = open(bar(|_| true).text(1.0).as_bytes(), "bar.inp").unwrap().mesh;
    let mut apart = bar(|[x, ..]| x < 0.005);
    // As files have them: equal to some digits only.
    apart.nodes.iter_mut().skip(27).for_each(|x| x[2] += 3e-9);
    for (scale, units) in
        [(1.0, MeshUnits::default()), (1e-3, MeshUnits { length: 1e-3, ..MeshUnits::default() })]
    {
        let text = apart.text(scale);
        let merged = read_with(&text, Some(1e-8), units).unwrap();
        assert_eq!(merged.mesh.nodes().len(), whole.nodes().len());
        assert_eq!(merged.mesh.node_set("MEETING").unwrap().len(), 9);
        let said: Vec<&str> = merged.warnings.iter().map(|own| own.what.as_str()).collect();
        assert_eq!(said, ["3 nodes merged with others within 1e-8 m, as `merge` asks for"]);
        for (own, other) in merged.mesh.blocks().iter().zip(whole.blocks()) {
            assert_eq!(own.connectivity.len(), other.connectivity.len());
            for (a, b) in own.connectivity.iter().zip(&other.connectivity) {
                let away = |k: usize| (merged.mesh.nodes()[*a][k] - whole.nodes()[*b][k]).abs();
                assert!((0..3).all(|k| away(k) < 4e-9));
            }
        }
        // Closer than they are, nothing merges.
        let none = read_with(&text, Some(1e-9), units).unwrap();
        assert_eq!(none.mesh.nodes().len(), whole.nodes().len() + 3);
        assert!(none.warnings.iter().any(|own| own.what.contains("no nodes are within 1e-9 m")));
    }
    // Farther than an edge is long, cells would be flat.
    let errors = read_with(&apart.text(1.0), Some(0.01), MeshUnits::default()).unwrap_err();
    assert!(
        errors.0[0].what.contains("would flatten cell 1: two of its nodes are 0.01 m apart"),
        "{errors:?}"
    );
}

/// Nodes of one cell, 1.5 mm apart, and those of another one between them.
#[test]
fn nodes_of_a_cell_are_not_merged_by_way_of_others() {
    let cell = |first: usize, x: [f64; 2], z: [f64; 2]| -> String {
        let corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
        let all = z.iter().flat_map(|z| corners.iter().map(move |own| (own, z)));
        let line = |(place, (own, z)): (usize, (&[usize; 2], &f64))| {
            format!("{}, {:?}, {:?}, {z:?}\n", first + place, x[own[0]], 0.1 * own[1] as f64)
        };
        all.enumerate().map(line).collect()
    };
    let text = format!(
        "*NODE\n{}{}*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n2, 9, 10, 11, 12, 13, 14, 15, 16\n\
         *MATERIAL, NAME=S\n*ELASTIC\n200e9, 0.3\n*DENSITY\n7860.\n*SOLID SECTION, ELSET=E, MATERIAL=S\n",
        cell(1, [0.0, 0.0015], [0.0, 0.1]),
        cell(9, [0.00075, 0.1], [0.1, 0.2])
    );
    let errors = read_with(&text, Some(1e-3), MeshUnits::default()).unwrap_err();
    assert_eq!(errors.0.len(), 1, "{errors:?}");
    let words = "would flatten cell 1: two of its nodes are 0.0015 m apart, and nodes that lie between them join them";
    assert!(errors.0[0].what.contains(words), "{errors:?}");
    assert!(!errors.0[0].help.is_empty());
    // A step to the nodes between them is longer.
    assert!(read_with(&text, Some(0.7e-3), MeshUnits::default()).is_ok());
}

#[test]
fn nodes_that_hang_on_faces_are_counted_and_named() {
    for across in [2, 4] {
        let mut own = Blocks::default();
        own.add([1, 2], [0.0, MEETING], false, |_| true);
        own.add([across, 2], [MEETING, 0.08], false, |_| true);
        let found = warnings(&own.text(1.0));
        let [found] = found.as_slice() else { panic!("{found:?}") };
        // All of the finer side but the four corners that both have.
        let count = (across + 1) * (across + 1) - 4;
        assert!(found.starts_with(&format!("{count} nodes hang on faces of cells")), "{found}");
        assert!(found.contains(" on cell 2 at ("), "{found}");
        // A gap of a tenth of an edge is one.
        let mut gap = Blocks::default();
        gap.add([1, 2], [0.0, MEETING], false, |_| true);
        gap.add([across, 2], [MEETING + 0.002, 0.08], false, |_| false);
        assert_eq!(warnings(&gap.text(1.0)), Vec::<String>::new());
    }
}

#[test]
fn quadratic_faces_on_linear_ones_are_counted() {
    for first in [true, false] {
        let mut own = Blocks::default();
        own.add([2, 2], [0.0, MEETING], first, |_| true);
        own.add([2, 2], [MEETING, 0.08], !first, |_| true);
        let found = warnings(&own.text(1.0));
        let [found] = found.as_slice() else { panic!("{found:?}") };
        assert!(found.starts_with("4 pairs of faces are joined by their corners only"), "{found}");
        assert!(found.contains("5 and 9, 6 and 10, 7 and 11, 8 and 12;"), "{found}");
    }
    let tetrahedra = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,0,0,-1\n6,.5,0,0\n7,.5,.5,0\n8,0,.5,0\n9,0,0,-.5\n\
        10,.5,0,-.5\n11,0,.5,-.5\n*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n*ELEMENT,TYPE=C3D10\n2,1,3,2,5,8,7,6,9,11,10\n";
    let found = warnings(tetrahedra);
    assert!(found[0].starts_with("1 pair of faces is joined by"), "{found:?}");
    assert_eq!(found.len(), 1);
}

#[test]
fn meshes_of_other_programs_have_no_seams() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/data");
    let mut seen = 0;
    for part in ["own-mesh", "gmsh", "calculix"] {
        for entry in std::fs::read_dir(format!("{folder}/{part}")).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            let Some(name) = name.strip_suffix(".gz").map(|name| format!("{part}/{name}")) else {
                continue;
            };
            let Ok(read) = open(&data(&name), &name) else { continue };
            seen += 1;
            for warning in &read.warnings {
                let seam = ["at one place", "hang", "by their corners only"];
                assert!(
                    !seam.iter().any(|words| warning.what.contains(words)),
                    "{name}: {warning}"
                );
            }
        }
    }
    assert!(seen > 30, "{seen}");
}
