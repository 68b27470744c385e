//! The text of generated kernels, against files in tests/golden. WHIRL_RENEW_GOLDEN=1 writes them anew.

use std::fs;
use std::path::Path;

use whirl_codegen::generate::{GeneratedFile, SpecFile, folders, generate};
use whirl_tests::golden;

const LAW: &str = r#"kind = "law"
name = "example"
title = "Quadratic spring with a damper"
source = "made for this test"

[inputs.h]
unit = "mm"

[inputs.h_dot]
unit = "m/s"

[outputs.Q]
unit = "N"
jump = "accept"
pieces = [
  { when = 'h < 0.05', value = '400 - 20000*h + 250000*h^2 - 3*h_dot*(1 - h/0.05)^(3/2)' },
  { value = '0' },
]
"#;

const FILM: &str = r#"kind = "film"
name = "example"
title = "Film between plates, linear along"
source = "made for this test"

[cell]
around = 2
along = 2

[unknowns.p]
unit = "Pa"

[unknowns.r]
unit = "1"

[gap.h]
unit = "m"

[speed.u]
unit = "m/s"

[parameters.mu]
value = 20
unit = "mPa*s"
title = "viscosity"

[nodal]
theta = '1 - r'

[stored]
value = 'theta*h'

[residual]
pressure = { value = 'h^3/(12*mu)*(ddx(p)*ddx(v) + ddz(p)*ddz(v))', points = ["midpoint", "midpoint"] }
shear = { value = '-u*h*upstream(theta, u)*ddx(v)', points = ["midpoint", "midpoint"] }

[forces]
Q = { on = "h", value = 'p' }
T_m = { on = "s_mean", value = '-h*ddx(p)' }

[edges.open]
given = ["p"]
complementary = ["out", "r"]

[outputs.loss]
unit = "W"
terms.shear = { value = 'mu*(2*u)^2*theta/h', points = "nodes" }
"#;

fn file(path: &str, text: &str) -> SpecFile {
    SpecFile { path: path.to_owned(), text: text.to_owned() }
}

fn generated(files: &[SpecFile]) -> Vec<GeneratedFile> {
    generate(files).unwrap_or_else(|errors| panic!("{errors}"))
}

fn text<'a>(files: &'a [GeneratedFile], name: &str) -> &'a str {
    &files.iter().find(|file| file.name == name).expect("the file is generated").text
}

/// Compares a text with the committed one, or writes it anew.
fn is_as_committed(found: &str, name: &str) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden");
    golden::is_as_committed(&folder.join(name), found);
}

/// A shipped spec.
fn shipped(path: &str) -> SpecFile {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs");
    file(path, &fs::read_to_string(root.join(path)).expect("a shipped spec"))
}

#[test]
fn the_text_of_a_law_is_as_committed() {
    let files = generated(&[file("laws/example.toml", LAW)]);
    is_as_committed(text(&files, "laws.rs"), "law.rs");
}

#[test]
fn the_text_of_forms_is_as_committed() {
    let files = generated(&[shipped("forms/elasticity.toml"), shipped("forms/inertia.toml")]);
    is_as_committed(text(&files, "forms.rs"), "forms.rs");
}

#[test]
fn the_text_of_an_element_is_as_committed() {
    let files = generated(&[
        shipped("elements/tet4.toml"),
        shipped("forms/elasticity.toml"),
        shipped("forms/inertia.toml"),
    ]);
    is_as_committed(text(&files, "elements.rs"), "element.rs");
}

#[test]
fn the_text_of_a_clearance_is_as_committed() {
    let files = generated(&[shipped("motion/clearance.toml")]);
    is_as_committed(text(&files, "clearances.rs"), "clearance.rs");
}

#[test]
fn the_text_of_a_film_is_as_committed() {
    let files = generated(&[file("films/example.toml", FILM)]);
    is_as_committed(text(&files, "films.rs"), "film.rs");
}

#[test]
fn the_same_specs_give_the_same_text_in_any_order() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs");
    let mut files = Vec::new();
    for folder in folders() {
        let Ok(entries) = fs::read_dir(root.join(folder)) else { continue };
        for entry in entries {
            let path = entry.expect("an entry").path();
            let name = path.file_name().expect("a name").to_string_lossy().into_owned();
            let text = fs::read_to_string(&path).expect("a readable file");
            files.push(file(&format!("{folder}/{name}"), &text));
        }
    }
    let first = generated(&files);
    files.reverse();
    assert_eq!(first, generated(&files));
    assert!(text(&first, "kernels.rs").contains("laws::hu2003_nonlinear::ENTRY"));
}

#[test]
fn files_to_start_from_are_accepted() {
    let named = |text: &str| text.replace("@NAME@", "begun");
    let law = named(include_str!("../../cli/src/new/law.toml"));
    let element = named(include_str!("../../cli/src/new/element.toml"));
    let form = include_str!("../../specs/forms/elasticity.toml");
    let files = generated(&[
        file("laws/begun.toml", &law),
        file("elements/begun.toml", &element),
        file("forms/elasticity.toml", form),
    ]);
    let text = text(&files, "kernels.rs");
    assert!(
        text.contains("laws::begun::ENTRY") && text.contains("elements::begun::ENTRY"),
        "{text}"
    );
}

#[test]
fn a_name_given_twice_is_an_error() {
    let other = LAW.replace("Quadratic", "Another quadratic");
    let errors = generate(&[file("laws/a.toml", LAW), file("laws/b.toml", &other)]);
    let text = errors.expect_err("the name is taken").to_string();
    assert!(text.contains("laws/b.toml") && text.contains("`example`"), "{text}");
}

#[test]
fn errors_of_all_files_are_found_at_once() {
    let broken = LAW.replace("h^2", "h^^2").replace("example", "broken");
    let unknown = LAW.replace("title", "tilte").replace("example", "unknown");
    let stray = file("notes/c.toml", LAW);
    let files = [file("laws/a.toml", &broken), file("laws/b.toml", &unknown), stray];
    let text = generate(&files).expect_err("three errors").to_string();
    for path in ["laws/a.toml", "laws/b.toml", "notes/c.toml"] {
        assert!(text.contains(path), "{path} is missing in {text}");
    }
}
