//! docs/matrices.md: its case runs on the committed files of CalculiX, and its other lines on the same body in other formats.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use flate2::read::GzDecoder;
use whirl_solver::mesh::format::{self, MeshUnits, ReadOptions};
use whirl_specs::ELEMENTS;
use whirl_tests::matrices as written;

use crate::bodies::run;

const PAGE: &str = include_str!("../../docs/matrices.md");

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data/calculix").join(name)
}

fn packed(name: &str) -> String {
    let mut text = String::new();
    let file = fs::File::open(data(&format!("{name}.gz"))).expect("a file");
    GzDecoder::new(file).read_to_string(&mut text).expect("gzip");
    text
}

/// Contents of the blocks of TOML.
fn blocks() -> Vec<&'static str> {
    let blocks = PAGE.split("```toml\n").skip(1);
    blocks.map(|rest| rest.split("```").next().expect("its end")).collect()
}

#[test]
fn the_case_of_the_page_runs_on_files_of_every_program() {
    let [case, punched, output4, abaqus, stored, spin] = blocks()[..] else { panic!("six blocks") };
    let input = fs::read_to_string(data("bar20.inp")).expect("the input");
    let files: Vec<(&str, String)> = ["bar20.sti", "bar20.mas", "bar20.dof"]
        .into_iter()
        .map(|name| (name, packed(name)))
        .chain([("bar20.inp", input.clone())])
        .collect();
    let beside: Vec<(&str, &str)> =
        files.iter().map(|(name, text)| (*name, text.as_str())).collect();
    // The set of the input file is the one by place.
    let case = case.replace("sets.END]", "sets.FOOT]").replace("\"END\"", "\"FOOT\"");
    let made = run(&case, &beside);
    assert!(made.last("RX_tip_N").abs() > 0.0);

    let elements: Vec<_> = ELEMENTS.iter().collect();
    let units = MeshUnits { length: 1e-3, force: 1.0, mass: 1e3 };
    let options = ReadOptions { units, ..ReadOptions::new(&elements) };
    let mesh = format::read(input.into_bytes(), "bar20.inp", &options).expect("a mesh").mesh;
    let [k, m] = written::of_mesh(&mesh);
    let punch = written::dmig("KAAX", &k, &mesh) + &written::dmig("MAAX", &m, &mesh);
    let files = [
        ("bar.pch", punch),
        ("bar.op4", written::op4("KAA", &k) + &written::op4("MAA", &m)),
        ("bar_STIF1.mtx", written::abaqus(&k, &mesh)),
        ("bar_MASS1.mtx", written::abaqus(&m, &mesh)),
        ("bar.inp", written::input(&mesh)),
        ("bar.bdf", written::grids(&mesh)),
        ("K.mtx", written::market(&k, "symmetric")),
        ("M.mtx", written::market(&m, "symmetric")),
        ("dofs.csv", written::dofs(&mesh)),
    ];
    let beside: Vec<(&str, &str)> =
        files.iter().map(|(name, text)| (*name, text.as_str())).collect();
    let own = "matrices = { calculix = \"bar20\", nodes = \"bar20.inp\" }\nunits = \"mm, N, t\"\n";
    for other in [punched, output4, abaqus, stored] {
        assert!(case.contains(own));
        let found = run(&case.replace(own, other), &beside);
        let (a, b) = (made.history.column("X_tip_um"), found.history.column("X_tip_um"));
        let largest = a.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (a, b) in a.iter().zip(b) {
            // CalculiX writes fourteen digits, the history ten.
            assert!((a - b).abs() <= 1e-8 * largest, "{a} {b}");
        }
    }
    let keys: toml::Table = toml::from_str(spin).expect("TOML");
    assert!(keys["body"]["rotor"]["matrices"].as_table().is_some_and(|own| own.len() == 7));
}
