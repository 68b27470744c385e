//! `whirl mesh FILE --picture FILE`: the surface of a mesh as SVG and PNG.

use std::fmt::Write;
use std::fs;

use crate::own_mesh::bench;
use crate::workbench::Workbench;

/// A picture of a mesh as SVG.
fn svg(bench: &Workbench, mesh: &str) -> String {
    let outcome = bench.whirl(&["mesh", mesh, "--picture", "pictures/mesh.svg"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    fs::read_to_string(bench.path("pictures/mesh.svg")).expect("a picture")
}

/// A plate of n × n × 1 cells of 1 mm, with its sets behind it.
fn plate(n: usize, sets: &str) -> String {
    let mut text = "*NODE\n".to_owned();
    let node = |i: usize, j: usize, k: usize| 1 + i + (n + 1) * (j + (n + 1) * k);
    for k in 0..2 {
        for j in 0..=n {
            for i in 0..=n {
                let [x, y, z] = [i, j, k].map(|own| own as f64 * 1e-3);
                writeln!(text, "{}, {y}, {x}, {z}", node(i, j, k)).expect("text");
            }
        }
    }
    text += "*ELEMENT, TYPE=C3D8\n";
    for j in 0..n {
        for i in 0..n {
            let around =
                |k| [node(i, j, k), node(i, j + 1, k), node(i + 1, j + 1, k), node(i + 1, j, k)];
            let all: Vec<String> =
                around(0).into_iter().chain(around(1)).map(|own| own.to_string()).collect();
            writeln!(text, "{}, {}", 1 + i + n * j, all.join(", ")).expect("text");
        }
    }
    text + sets
}

#[test]
fn a_picture_shows_the_faces_in_front_with_their_sets() {
    let bench = bench();
    let text = svg(&bench, "rotor.msh");
    let polygons = text.matches("<polygon").count();
    // Of 862 faces half look away, and others are behind the disc.
    assert!((200..420).contains(&polygons), "{polygons}");
    for wanted in ["rotor.msh: 2900 nodes, 1494 cells", "JOURNAL_3 (", ">z<", "20 mm"] {
        assert!(text.contains(wanted), "{wanted}");
    }
    let outcome = bench.whirl(&["mesh", "housing.msh", "--picture", "housing.PNG"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let png = fs::read(bench.path("housing.PNG")).expect("a picture");
    assert!(png.starts_with(b"\x89PNG\r\n") && png.len() > 50_000, "{}", png.len());
}

#[test]
fn sets_of_faces_cells_and_single_nodes_are_shown() {
    let sets = "*NSET, NSET=END\n1, 2, 4, 5\n*NSET, NSET=TIP<1>\n18\n*ELSET, ELSET=HALF\n3, 4\n*ELSET, ELSET=ALL\n1, 2, 3, 4\n";
    let text = svg(&Workbench::new().file("plate.inp", &plate(2, sets)), "plate.inp");
    for wanted in ["END (4 nodes)", "TIP&lt;1&gt; (1 node)", "HALF (2 cells)", "<circle"] {
        assert!(text.contains(wanted), "{wanted}\nin\n{text}");
    }
    assert!(!text.contains("ALL ("), "a set of all cells shows nothing");
    // Four squares in front and two on each of two sides.
    assert_eq!(text.matches("<polygon").count(), 8);
    assert!(!text.contains("NaN"));
}

#[test]
fn a_large_mesh_becomes_pixels() {
    let text = svg(&Workbench::new().file("plate.inp", &plate(230, "")), "plate.inp");
    assert!(!text.contains("<polygon") && text.contains("<path d=\"M"));
    assert!(text.len() < 2_000_000, "{} bytes", text.len());
}

#[test]
fn other_endings_are_refused_before_anything_is_read() {
    let bench = bench();
    let before = bench.listing();
    for (file, help) in [("rotor.jpg", "rotor.png"), ("rotor", "rotor.png")] {
        let outcome = bench.whirl(&["mesh", "rotor.msh", "--picture", file]);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""));
        let said = format!("`{file}` is neither an SVG nor a PNG file");
        assert!(outcome.stderr.contains(&said), "{}", outcome.stderr);
        assert!(outcome.stderr.contains(&format!("--picture {help}")), "{}", outcome.stderr);
    }
    let outcome = bench.whirl(&["mesh", "rotor.msh", "--picture", "rotor.msh/rotor.png"]);
    assert_ne!(outcome.status, 0);
    assert!(outcome.stderr.contains("cannot write"), "{}", outcome.stderr);
    assert_eq!(bench.listing(), before);
}
