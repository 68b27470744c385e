//! From two meshes of Gmsh to bearing forces, as docs/own-mesh.md says it.

use std::fs;
use std::io::Read;
use std::path::Path;

use flate2::read::GzDecoder;

use crate::workbench::Workbench;

const PAGE: &str = include_str!("../../docs/own-mesh.md");

/// A folder with both meshes.
pub(crate) fn bench() -> Workbench {
    let bench = Workbench::new();
    for name in ["rotor.msh", "housing.msh"] {
        let path =
            Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../tests/data/own-mesh/{name}.gz"));
        let mut bytes = Vec::new();
        let file = fs::File::open(path).expect("a mesh");
        GzDecoder::new(file).read_to_end(&mut bytes).expect("gzip");
        fs::write(bench.path(name), bytes).expect("the folder can be written");
    }
    bench
}

/// The case of the page.
fn case() -> &'static str {
    let (_, rest) = PAGE.split_once("```toml\n").expect("a case");
    rest.split_once("```").expect("its end").0
}

#[test]
fn what_the_page_shows_of_a_mesh_is_what_is_printed() {
    let bench = bench();
    let outcome = bench.whirl(&["mesh", "rotor.msh"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let (_, shown) = PAGE.split_once("```\nrotor.msh: Gmsh").expect("what it shows");
    let shown = format!("rotor.msh: Gmsh{}", shown.split_once("```").expect("its end").0);
    assert!(outcome.stdout.starts_with(&shown), "{}", outcome.stdout);
    // Lines to copy are those of the page.
    for name in ["rotor", "housing"] {
        let printed = bench.whirl(&["mesh", &format!("{name}.msh")]).stdout;
        let tables = case().split("\n\n");
        let sets = tables.filter(|text| text.starts_with(&format!("[body.{name}.sets.")));
        let mut found = 0;
        for table in sets.filter(|text| text.contains("z = ")) {
            assert!(printed.contains(table), "{table}\nin\n{printed}");
            found += 1;
        }
        assert_eq!(found, 2);
    }
}

#[test]
fn the_case_of_the_page_runs_and_is_sound() {
    let bench = bench().file("case.toml", &case().replace("\"0.2 s\"", "\"0.03 s\""));
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("verdict: sound"), "{}", outcome.stdout);
    let history = bench.history("out");
    for column in ["RX_front_N", "RY_back_N"] {
        let largest = history.column(column).iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        assert!(largest > 0.1 && largest.is_finite(), "{column}: {largest}");
    }
    assert!(bench.path("out/fields/housing.pvd").exists());
}

#[test]
fn the_clearance_is_that_of_the_meshes() {
    let bench = bench().file("case.toml", &case().replace("\"0.2 s\"", "\"0.001 s\""));
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    for wanted in [
        "bearing front: journal rotor, bore housing, law hu2003-nonlinear (c0 = 0.05 mm), c = 50 µm from mesh, 3 \
         rings of 24 springs at z = 0, 10, 20 mm",
        "measured on the meshes: journal of radius 10 mm (out of round by 0 µm), bore of radius 10.05 mm (out of round by 0 µm)",
    ] {
        assert!(outcome.stdout.contains(wanted), "{wanted}\nin\n{}", outcome.stdout);
    }
    let said =
        bench.file("said.toml", &case().replace("from mesh", "50 um").replace("0.2 s", "0.001 s"));
    for name in ["case", "said"] {
        let run = ["run", &format!("{name}.toml"), "--no-figures", "--out", name];
        let outcome = said.whirl(&run);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let summary = said.summary(name);
        for joint in summary["supports"].as_array().expect("a list") {
            let c = joint["clearance_um"].as_f64().expect("µm");
            assert!((c / 50.0 - 1.0).abs() < 1e-8, "{c}");
        }
    }
    // The same but for rounding of the coordinates.
    let [a, b] = ["case", "said"].map(|name| said.history(name));
    for column in ["RX_front_N", "EX_back_um"] {
        let (a, b) = (a.column(column), b.column(column));
        let largest = a.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let apart = a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        assert!(apart <= 1e-6 * largest, "{column}: {apart} of {largest}");
    }
}

#[test]
fn the_meshes_are_as_heavy_as_their_shapes() {
    let bench = bench().file("case.toml", case());
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    // π r² l of the cylinders, and the plates with the base less the bores, in kg.
    let pi = std::f64::consts::PI;
    let rotor = 7850e-9 * pi * (2.0 * 20.0 * 100.0 + 50.0 * 144.0 + 10.0 * 1225.0);
    let housing = 7850e-9 * (10.0 * 80.0 * 110.0 + 2.0 * 20.0 * (50.0 * 50.0 - pi * 10.05 * 10.05));
    for (name, exact) in [("rotor ", rotor), ("housing ", housing)] {
        let line = outcome.stdout.lines().find(|line| line.starts_with(name)).expect("a row");
        let mass: f64 = line.split_whitespace().nth(1).expect("a mass").parse().expect("kg");
        // Quadratic faces follow circles so far.
        println!("{name}: {mass} {exact}");
        assert!((mass / exact - 1.0).abs() < 2e-3, "{name}: {mass} for {exact}");
    }
}

#[test]
fn a_file_that_is_no_mesh_is_refused() {
    let bench =
        bench().file("broken.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n");
    let refused = |arguments: &[&str]| {
        let outcome = bench.whirl(arguments);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
        outcome.stderr
    };
    let text = refused(&["mesh", "nothing.msh"]);
    assert!(
        text.contains("cannot read `nothing.msh`") && text.contains("name a mesh file"),
        "{text}"
    );
    let text = refused(&["mesh", "rotor.msh", "--units", "mm, N"]);
    assert!(text.contains("`mm, N` are 2 units, not three") && text.contains("mm, N, t"), "{text}");
    let text = refused(&["mesh", "rotor.msh", "--units", "mm, N, m"]);
    assert!(text.contains("`m` is no unit of mass"), "{text}");
    let text = refused(&["mesh", "broken.msh"]);
    assert!(text.contains("--> broken.msh:"), "{text}");
    let text = refused(&["mesh", "."]);
    assert!(text.contains("cannot read `.`"), "{text}");
}

/// The bores of free tetrahedra yield as those of the mesh; without the correction their modes lack most of it.
#[test]
fn bores_of_the_page_yield_as_those_of_the_mesh() {
    let corrected = "static_correction = true\n";
    assert!(case().contains(corrected));
    let bench = bench().file("case.toml", case()).file("few.toml", &case().replace(corrected, ""));
    let lacking = |name: &str| -> Vec<f64> {
        let outcome = bench.whirl(&["check", name, "--contacts"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let table = outcome.stdout.split_once("n = 4").expect("a table").1.to_owned();
        let line = table.lines().find(|line| line.starts_with("front")).expect("a bore").to_owned();
        line.split_whitespace().filter_map(|cell| cell.parse().ok()).collect()
    };
    assert_eq!(lacking("case.toml"), [0.0; 5]);
    assert!(lacking("few.toml").iter().all(|part| *part > 20.0));
}
