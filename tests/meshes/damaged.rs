//! Files of Gmsh that are cut off, mixed up or say what is not so: an error with a cause, and no panic.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use whirl_solver::error::InputErrors;

use crate::open;
use crate::packed::data;

const GOOD: &str = "$MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 0 1
1 0 0 0 1 1 1 1 3 0
$EndEntities
$Nodes
1 4 1 4
3 1 0 4
1
2
3
4
0 0 0
1 0 0
0 1 0
0 0 1
$EndNodes
$Elements
1 1 1 1
3 1 4 1
1 1 2 3 4
$EndElements
";

const OLDER: &str = "$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
$EndNodes
$Elements
1
1 4 2 3 1 1 2 3 4
$EndElements
";

fn refused(text: &str) -> InputErrors {
    open(text.as_bytes(), "bad.msh").map(|_| ()).unwrap_err()
}

#[test]
fn the_files_that_are_damaged_here_are_good() {
    for text in [GOOD, OLDER] {
        let mesh = open(text.as_bytes(), "good.msh").unwrap_or_else(|e| panic!("{e}")).mesh;
        assert_eq!(mesh.element_set("VOLUME_3").unwrap().len(), 1);
    }
}

/// Places on the entities, which Gmsh writes behind the coordinates of nodes where it is asked to, are passed over: none at points
/// and in volumes, one on curves, two on faces.
#[test]
fn nodes_with_parametric_coordinates_are_those_without() {
    let plain = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
    let text = OLDER.replace(
        plain,
        "$ParametricNodes\n4\n1 0 0 0 0 7\n2 1 0 0 1 3 0.25\n3 0 1 0 2 5 0.5 -0.125\n4 0 0 1 3 1\n$EndParametricNodes\n",
    );
    assert_ne!(text, OLDER);
    let [with, without] = [text.as_bytes(), OLDER.as_bytes()]
        .map(|bytes| open(bytes, "good.msh").unwrap_or_else(|errors| panic!("{errors}")).mesh);
    assert_eq!(with.nodes(), without.nodes());
    // In binary, as Gmsh writes it.
    let mut bytes = b"$MeshFormat\n2.2 1 8\n".to_vec();
    bytes.extend(1_i32.to_le_bytes());
    bytes.extend(b"\n$EndMeshFormat\n$ParametricNodes\n4\n");
    let places: [(i32, &[f64]); 4] = [(0, &[]), (1, &[0.25]), (2, &[0.5, -0.125]), (3, &[])];
    for (node, (dimension, place)) in places.into_iter().enumerate() {
        bytes.extend((node as i32 + 1).to_le_bytes());
        without.nodes()[node].iter().for_each(|own| bytes.extend(own.to_le_bytes()));
        bytes.extend(dimension.to_le_bytes());
        bytes.extend(9_i32.to_le_bytes());
        place.iter().for_each(|own| bytes.extend(own.to_le_bytes()));
    }
    bytes.extend(b"\n$EndParametricNodes\n$Elements\n1\n");
    for own in [4, 1, 2, 1, 3, 1, 1, 2, 3, 4_i32] {
        bytes.extend(own.to_le_bytes());
    }
    bytes.extend(b"\n$EndElements\n");
    let binary = open(&bytes, "good.msh").unwrap_or_else(|errors| panic!("{errors}")).mesh;
    assert_eq!(binary.nodes(), without.nodes());
}

#[test]
fn what_is_wrong_is_said_where_it_is() {
    for (text, from, to, place, what) in [
        (GOOD, "4.1 0 8", "4.0 0 8", (2, 1), "version 4 of Gmsh's format is not read"),
        (GOOD, "4.1 0 8", "4.1 2 8", (2, 5), "the kind of file is 2"),
        (GOOD, "$Nodes\n1 4", "$Nodes\n1 5", (19, 1), "$Nodes says 5 nodes, but its blocks lack 1"),
        (
            GOOD,
            "1 0 4\n",
            "1 0 7\n",
            (10, 7),
            "a block of $Nodes says 7 nodes, where 4 of 4 are left",
        ),
        (GOOD, "1 4 1 4", "1 99999999999999 1 4", (9, 3), "has room for"),
        (GOOD, "1 4 1 4", "18446744073709551615 4 1 4", (9, 1), "has room for"),
        (GOOD, "0 0 1\n$EndN", "0 0\n$EndN", (19, 1), "expected a coordinate, found `$EndNodes`"),
        (GOOD, "0 1 0\n", "0 nan 0\n", (17, 3), "expected a coordinate, found `nan`"),
        (GOOD, "\n3\n4\n", "\n3\n3\n", (14, 1), "node 3 is defined twice"),
        (GOOD, "1 1 2 3 4", "1 1 2 3 9", (23, 1), "cell 1 has node 9, which is not defined"),
        (GOOD, "1 1 2 3 4", "1 1 2 3 3", (23, 1), "cell 1 has node 3 twice"),
        (GOOD, "3 1 4 1", "3 1 77 1", (22, 5), "element type 77 of Gmsh is not known"),
        (GOOD, "3 1 4 1", "7 1 4 1", (22, 1), "the dimension 7 is none from 0 to 3"),
        (
            GOOD,
            "$Entities",
            "Entities",
            (4, 1),
            "expected a section such as $Nodes, found `Entities`",
        ),
        (
            GOOD,
            "$EndEntities",
            "$EndEntitis",
            (7, 1),
            "expected `$EndEntities`, found `$EndEntitis`",
        ),
        (GOOD, "$Elements\n", "$Elementz\n", (20, 1), "$Elementz has no end"),
        (
            OLDER,
            "$Nodes\n4",
            "$Nodes\n5",
            (10, 1),
            "expected the label of a node, found `$EndNodes`",
        ),
        (OLDER, "$Nodes\n4", "$Nodes\n3", (9, 1), "expected `$EndNodes`, found `4`"),
        (OLDER, "$Nodes\n4", "$Nodes\n-4", (5, 1), "-4 nodes"),
        (OLDER, "4 2 3 1", "4 2 3 0", (0, 0), ""),
        (OLDER, "1 4 2", "1 4 -2", (13, 5), "an element has -2 tags"),
        (OLDER, "1 4 2", "-1 4 2", (13, 1), "the label of an element is -1"),
    ] {
        let changed = text.replacen(from, to, 1);
        assert_ne!(changed, text);
        if what.is_empty() {
            assert!(open(changed.as_bytes(), "good.msh").is_ok());
            continue;
        }
        let errors = refused(&changed);
        let error = &errors.0[0];
        assert!(error.what.contains(what), "{what}: {errors}");
        assert_eq!((error.line, error.column), place, "{errors}");
        assert!(!error.help.is_empty(), "{errors}");
    }
}

#[test]
fn mixed_files_are_refused() {
    let nodes = |text: &str| text[text.find("$Nodes").unwrap()..].to_owned();
    let head = |text: &str| text[..text.find("$Nodes").unwrap()].to_owned();
    for text in [head(GOOD) + &nodes(OLDER), head(OLDER) + &nodes(GOOD)] {
        assert!(refused(&text).to_string().contains("of another version than its header says"));
    }
    assert!(refused(&(GOOD.to_owned() + GOOD)).to_string().contains("another mesh begins here"));
    assert!(refused(&nodes(GOOD)).to_string().contains("there is no $MeshFormat above"));
    assert!(refused("$NOD\n1\n").to_string().contains("write version 4.1 or 2.2"));
    assert!(refused("").to_string().contains("the file ends without $Nodes"));
    let without = GOOD[..GOOD.find("$Elements").unwrap()].to_owned();
    assert!(refused(&without).to_string().contains("the file ends without $Elements"));
    let empty = without + "$Elements\n0 0 0 0\n$EndElements\n";
    assert!(refused(&empty).to_string().contains("the file has no cells"));
}

#[test]
fn nodes_of_no_cell_and_groups_without_solids_are_warned_of() {
    let more =
        OLDER.replace("$Nodes\n4", "$Nodes\n5").replace("\n$EndNodes", "\n5 3 3 3\n$EndNodes");
    let more =
        more.replace("$Elements\n1", "$Elements\n2").replace("\n$EndEl", "\n2 15 2 8 1 5\n$EndEl");
    let read = open(more.as_bytes(), "good.msh").unwrap();
    let warnings: Vec<String> = read.warnings.iter().map(ToString::to_string).collect();
    let warnings = warnings.join("\n");
    assert_eq!(read.mesh.nodes().len(), 4);
    assert!(warnings.contains("1 node in no cell, left out: 5"), "{warnings}");
    assert!(
        warnings.contains("no node of the point group `POINT_8` belongs to a solid"),
        "{warnings}"
    );
}

/// Numbers that look random, the same in every run.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % bound
    }
}

#[test]
fn files_cut_anywhere_and_files_with_changed_bytes_never_panic() {
    let mut random = Random(7);
    let (mut good, mut bad) = (0, 0);
    for body in ["hex8", "tet4", "pyramid5", "wedge15"] {
        for variant in ["22-text", "22-binary", "41-text", "41-binary"] {
            let bytes = data(&format!("gmsh/{body}-{variant}.msh"));
            let mut files: Vec<Vec<u8>> = Vec::new();
            let step = (bytes.len() / 300).max(1);
            files.extend((0..bytes.len()).step_by(step).map(|end| bytes[..end].to_vec()));
            for _ in 0..500 {
                let mut changed = bytes.clone();
                for _ in 0..=random.below(3) {
                    let at = random.below(changed.len());
                    changed[at] = match random.below(3) {
                        0 => b'9',
                        1 => 0xff,
                        _ => random.below(256) as u8,
                    };
                }
                files.push(changed);
            }
            for file in files {
                let start = Instant::now();
                let outcome = catch_unwind(AssertUnwindSafe(|| open(&file, "bad.msh")));
                let text = || String::from_utf8_lossy(&file).into_owned();
                let outcome = outcome.unwrap_or_else(|_| panic!("panics:\n{}", text()));
                assert!(start.elapsed() < Duration::from_secs(20), "{}", text());
                match outcome {
                    Ok(_) => good += 1,
                    Err(errors) => {
                        assert!(errors.0.iter().all(|error| !error.what.is_empty()));
                        bad += 1;
                    }
                }
            }
        }
    }
    assert!(bad > 4_000 && good > 500, "{good} good, {bad} bad");
}
