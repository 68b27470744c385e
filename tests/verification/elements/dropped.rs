//! A file dropped into specs/elements is an element, with no edit of Rust: a crate with the runtime's own
//! sources and what the generator makes of all spec files is built and run.

use std::fs;
use std::path::{Path, PathBuf};

use whirl_codegen::diagnostic::Source;
use whirl_codegen::generate::{ENDINGS, SpecFile, generate};
use whirl_codegen::kinds::element::ElementSpec;

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

/// Forms of every structure, of values and of gradients.
const FORMS: &str = r#"
kind = "form"
name = "dropped-forms"
title = "Diffusion and reaction"
source = "made for a test"

[material.k]
unit = "Pa"
title = "diffusivity"
[material.r]
unit = "Pa/m^2"
title = "reaction"

[matrices]
S = [[1, 2, 0], [0, 1, 0], [0, 3, 1]]

[forms]
diffusion = 'k*inner(grad(u), grad(v))'
both = 'k*inner(grad(u), grad(v)) + r*dot(u, v)'
symmetric = 'k*div(u)*div(v) + r*dot(u, v)'
full = 'k*inner(grad(S*u), grad(v)) + r*dot(u, v)'
"#;

const MAIN: &str = r#"
fn main() {
    let element = dropped::ELEMENTS.iter().find(|e| e.abaqus.contains(&"TET4")).unwrap();
    let nodes = NODES;
    for (form, material) in FORMS {
        let kernel = element.form(form).unwrap();
        let (matrix, _) = kernel.of_cell(&nodes, &material[..]);
        let values: Vec<String> = matrix.iter().map(|value| format!("{value:e}")).collect();
        println!("{}", values.join(" "));
    }
}
"#;

const NODES: [[f64; 3]; 4] = [[0.1, 0.0, 0.0], [1.2, 0.1, -0.1], [0.2, 0.9, 0.1], [0.0, 0.2, 1.1]];

/// Every spec file of the crate of the specs, and the tetrahedron.
fn spec_files() -> Vec<SpecFile> {
    let specs = specs();
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

fn specs() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../specs")
}

/// The matrices of some forms, each with its material, on the dropped tetrahedron: what a crate with the kernels of all
/// `files` prints.
fn printed(name: &str, files: &[SpecFile], forms: &str) -> Vec<Vec<f64>> {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(folder.join("src")).expect("a folder for the crate");
    let generated = folder.join("generated");
    fs::create_dir_all(&generated).expect("a folder for the kernels");
    for file in generate(files).unwrap_or_else(|errors| panic!("{errors}")) {
        fs::write(generated.join(&file.name), &file.text).expect("a kernel file");
    }
    copy(&specs().join("src"), &folder.join("src"));
    // The sources include from OUT_DIR, which cargo sets for a crate with a build script.
    let build = "fn main() {\n    let out = std::env::var(\"OUT_DIR\").unwrap();\n    \
                 for file in std::fs::read_dir(\"generated\").unwrap() {\n        \
                 let path = file.unwrap().path();\n        \
                 let to = std::path::Path::new(&out).join(path.file_name().unwrap());\n        \
                 std::fs::copy(&path, to).unwrap();\n    }\n}\n";
    fs::write(folder.join("build.rs"), build).expect("a build script");
    let main = MAIN.replace("NODES", &format!("{:?}", NODES.as_flattened()));
    fs::write(folder.join("src/main.rs"), main.replace("FORMS", forms)).expect("a program");
    let printed = whirl_tests::run_alone(&folder, "dropped");
    let numbers =
        |line: &str| line.split(' ').map(|value| value.parse().expect("a number")).collect();
    printed.lines().map(numbers).collect()
}

/// Six times the volume is the determinant of the edges.
fn volume() -> f64 {
    let edge = |a: usize| nalgebra::Vector3::from_fn(|i, _| NODES[a][i] - NODES[0][i]);
    edge(1).dot(&edge(2).cross(&edge(3))) / 6.0
}

#[test]
fn an_element_dropped_into_the_specs_is_usable() {
    let forms = "[(\"stiffness\", &[200e9, 0.3][..]), (\"mass\", &[7860.0][..])]";
    let found = printed("dropped-element", &spec_files(), forms);
    let element = ElementSpec::read(&Source::new("dropped-tet.toml", TETRAHEDRON)).unwrap();
    let stiffness = direct(&element, "stiffness", &NODES);
    let upper = (0..12).flat_map(|r| (r..12).map(move |c| (r, c)));
    let expected: Vec<f64> = upper.map(|place| stiffness[place]).collect();
    close(&found[0], &expected, stiffness.amax());
    // Consistent mass of a tetrahedron: ρV/20 off the diagonal, twice that on it.
    let unit = property("rho") * volume() / 20.0;
    let expected: Vec<f64> =
        (0..4).flat_map(|a| (a..4).map(move |b| if a == b { 2.0 * unit } else { unit })).collect();
    close(&found[1], &expected, 2.0 * unit);
}

/// On a linear tetrahedron gradients are constant and ∫N_a N_b dV is V/20, twice that for a = b.
#[test]
fn forms_dropped_into_the_specs_are_usable() {
    let file = |path: &str, text: &str| SpecFile { path: path.into(), text: text.into() };
    let files = [
        file("elements/dropped-tet.toml", TETRAHEDRON),
        file("forms/dropped-forms.toml", FORMS),
        file(
            "forms/elasticity.toml",
            &fs::read_to_string(specs().join("forms/elasticity.toml")).expect("the form"),
        ),
    ];
    let (k, r) = (3.0, 5.0);
    let both = format!("&[{k:?}, {r:?}][..]");
    let forms = format!(
        "[(\"diffusion\", &[{k:?}][..]), (\"both\", {both}), (\"symmetric\", {both}), (\"full\", {both})]"
    );
    let found = printed("dropped-forms", &files, &forms);
    // N_a = 1 at node a and 0 at the others: the rows of the inverse of the matrix of [1, x_a].
    let corners = nalgebra::Matrix4::from_fn(|i, a| if i == 0 { 1.0 } else { NODES[a][i - 1] });
    let inverse = corners.try_inverse().expect("a tetrahedron");
    let gradient =
        |a: usize| nalgebra::Vector3::new(inverse[(a, 1)], inverse[(a, 2)], inverse[(a, 3)]);
    let volume = volume();
    let scalar = |a: usize, b: usize| k * volume * gradient(a).dot(&gradient(b));
    let values = |a: usize, b: usize| r * volume / 20.0 * if a == b { 2.0 } else { 1.0 };
    let same = |i: usize, j: usize| f64::from(u8::from(i == j));
    let matrix = [[1.0, 2.0, 0.0], [0.0, 1.0, 0.0], [0.0, 3.0, 1.0]];
    let upper = |entry: &dyn Fn(usize, usize) -> f64, size: usize| -> Vec<f64> {
        (0..size).flat_map(|row| (row..size).map(move |column| entry(row, column))).collect()
    };
    let symmetric = |row: usize, column: usize| {
        let (a, i, b, j) = (row / 3, row % 3, column / 3, column % 3);
        k * volume * gradient(a)[i] * gradient(b)[j] + same(i, j) * values(a, b)
    };
    let full = |row: usize, column: usize| {
        let (a, i, b, j) = (row / 3, row % 3, column / 3, column % 3);
        matrix[i][j] * scalar(a, b) + same(i, j) * values(a, b)
    };
    let scale = k * volume * (0..4).map(|a| gradient(a).norm_squared()).fold(r, f64::max);
    close(&found[0], &upper(&scalar, 4), scale);
    close(&found[1], &upper(&|a, b| scalar(a, b) + values(a, b), 4), scale);
    close(&found[2], &upper(&symmetric, 12), scale);
    let all: Vec<f64> = (0..144).map(|place| full(place / 12, place % 12)).collect();
    close(&found[3], &all, 3.0 * scale);
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
