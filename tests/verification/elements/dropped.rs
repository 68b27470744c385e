//! A file dropped into specs/elements is an element, with no edit of Rust: a crate with the runtime's own
//! sources and what the generator makes of all spec files is built and run.

use std::fs;
use std::path::{Path, PathBuf};

use whirl_codegen::diagnostic::Source;
use whirl_codegen::generate::{ENDINGS, SpecFile, generate};
use whirl_codegen::spec::element::ElementSpec;

use super::{direct, property};

const TETRAHEDRON: &str = r#"
kind = "element"
name = "dropped-tet"
title = "Linear tetrahedron, 4 nodes"
source = "Zienkiewicz, Taylor & Zhu, The Finite Element Method, 7th ed., sec. 6.2"
cell = "tetrahedron"
nodes = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
shape = ['1 - xi - eta - zeta', 'xi', 'eta', 'zeta']

[quadrature]
rule = ["tetrahedron(4)"]
degree = 2
[quadrature.forms.stiffness]
rule = ["tetrahedron(1)"]
degree = 1

[abaqus]
types = ["TET4"]
[vtk]
type = 10
"#;

const MAIN: &str = r#"
fn main() {
    let element = dropped::ELEMENTS.iter().find(|e| e.abaqus.contains(&"TET4")).unwrap();
    let nodes = NODES;
    for (form, material) in [("stiffness", &[200e9, 0.3][..]), ("mass", &[7860.0][..])] {
        let kernel = element.form(form).unwrap();
        let mut matrix = vec![0.0; kernel.structure.len(element.nodes)];
        let mut det = [0.0];
        (kernel.evaluate)(&nodes, material, &mut matrix, &mut det);
        let values: Vec<String> = matrix.iter().map(|value| format!("{value:e}")).collect();
        println!("{}", values.join(" "));
    }
}
"#;

const NODES: [[f64; 3]; 4] = [[0.1, 0.0, 0.0], [1.2, 0.1, -0.1], [0.2, 0.9, 0.1], [0.0, 0.2, 1.1]];

/// Every spec file of the crate of the specs, and the tetrahedron.
fn spec_files(specs: &Path) -> Vec<SpecFile> {
    let mut files =
        vec![SpecFile { path: "elements/dropped-tet.toml".into(), text: TETRAHEDRON.into() }];
    for folder in ["elements", "forms", "laws", "motion"] {
        for entry in fs::read_dir(specs.join(folder)).expect("a folder of specs") {
            let path = entry.expect("a readable folder").path();
            let ending = path.extension().and_then(|ending| ending.to_str());
            if ending.is_some_and(|ending| ENDINGS.contains(&ending)) {
                let name = path.file_name().expect("a file").to_string_lossy().into_owned();
                let text = fs::read_to_string(&path).expect("a readable spec");
                files.push(SpecFile { path: format!("{folder}/{name}"), text });
            }
        }
    }
    files
}

#[test]
fn an_element_dropped_into_the_specs_is_usable() {
    let specs = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../specs");
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("dropped-element");
    fs::create_dir_all(folder.join("src")).expect("a folder for the crate");
    let generated = folder.join("generated");
    fs::create_dir_all(&generated).expect("a folder for the kernels");
    for file in generate(&spec_files(&specs)).unwrap_or_else(|errors| panic!("{errors}")) {
        fs::write(generated.join(&file.name), &file.text).expect("a kernel file");
    }
    copy(&specs.join("src"), &folder.join("src"));
    // The sources include from OUT_DIR, which cargo sets for a crate with a build script.
    let build = "fn main() {\n    let out = std::env::var(\"OUT_DIR\").unwrap();\n    \
                 for file in std::fs::read_dir(\"generated\").unwrap() {\n        \
                 let path = file.unwrap().path();\n        \
                 let to = std::path::Path::new(&out).join(path.file_name().unwrap());\n        \
                 std::fs::copy(&path, to).unwrap();\n    }\n}\n";
    fs::write(folder.join("build.rs"), build).expect("a build script");
    let main = MAIN.replace("NODES", &format!("{:?}", NODES.as_flattened()));
    fs::write(folder.join("src/main.rs"), main).expect("a program");
    let printed = whirl_tests::run_alone(&folder, "dropped");
    let mut lines = printed.lines().map(|line| {
        line.split(' ').map(|value| value.parse::<f64>().expect("a number")).collect::<Vec<f64>>()
    });
    let element = ElementSpec::read(&Source::new("dropped-tet.toml", TETRAHEDRON)).unwrap();
    let stiffness = direct(&element, "stiffness", &NODES);
    let upper = (0..12).flat_map(|r| (r..12).map(move |c| (r, c)));
    let expected: Vec<f64> = upper.map(|place| stiffness[place]).collect();
    close(&lines.next().expect("a stiffness"), &expected, stiffness.amax());
    // Consistent mass of a tetrahedron: ρV/20 off the diagonal, twice that on it.
    let volume = {
        let edge = |a: usize| nalgebra::Vector3::from_fn(|i, _| NODES[a][i] - NODES[0][i]);
        edge(1).dot(&edge(2).cross(&edge(3))) / 6.0
    };
    let unit = property("rho") * volume / 20.0;
    let expected: Vec<f64> =
        (0..4).flat_map(|a| (a..4).map(move |b| if a == b { 2.0 * unit } else { unit })).collect();
    close(&lines.next().expect("a mass"), &expected, 2.0 * unit);
}

/// A folder with all that is in it.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("the sources") {
        let path = entry.expect("a source").path();
        let copied = to.join(path.file_name().expect("a name"));
        if path.is_dir() {
            copy(&path, &copied);
        } else {
            fs::copy(&path, copied).expect("a copy");
        }
    }
}

fn close(found: &[f64], expected: &[f64], scale: f64) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-13 * scale, "{found} {expected}");
    }
}
