//! A law and an element dropped into a copy of the specs are listed and work, with no Rust changed.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use whirl_codegen::diagnostic::Source;
use whirl_codegen::spec::law::LawSpec;
use whirl_codegen::tape::Tape;

const LAW: &str = r#"kind = "law"
name = "dropped-hertz"
title = "Hertzian contact with a damper"
source = "made for this test"

[inputs.h]
unit = "um"

[inputs.h_dot]
unit = "m/s"

[outputs.Q]
unit = "N"
pieces = [
  { when = 'h < 5', value = '2*(5 - h)^(3/2)*(1 - 0.4*h_dot)' },
  { value = '0' },
]
"#;

/// Prints the law's bits at every point, then whether the element equals the one it was copied from.
const PROBE: &str = r#"
use whirl_specs::{ELEMENTS, LAWS};

fn main() {
    let law = LAWS.iter().find(|law| law.origin.name == "dropped-hertz").expect("the law");
    let springs = 50;
    let inputs: Vec<f64> = (0..2 * springs).map(|i| POINTS[i]).collect();
    let mut outputs = vec![0.0; 3 * springs];
    (law.evaluate)(springs, &inputs, &mut outputs);
    for value in outputs {
        println!("{:x}", value.to_bits());
    }
    let matrix = |name: &str| {
        let element = ELEMENTS.iter().find(|e| e.origin.name == name).expect("the element");
        let form = element.form("stiffness").expect("the form");
        let coordinates: Vec<f64> = element.reference_nodes.as_flattened().to_vec();
        let material: Vec<f64> = form.material.iter().map(|_| 0.25).collect();
        form.of_cell(&coordinates, &material).0
    };
    assert!(matrix("hex8").iter().any(|entry| *entry > 0.0));
    assert_eq!(matrix("hex8"), matrix("dropped-brick"));
}
"#;

fn points() -> Vec<f64> {
    let row = |scale: f64, shift: f64| (0..50).map(move |i| scale * (f64::from(i) - shift));
    row(2e-7, 10.0).chain(row(0.1, 25.0)).collect()
}

/// A workspace of the copied specs and the probe; the generator itself stays where it is.
fn workspace(root: &Path) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("dropped");
    // What an earlier run left could be listed too.
    let _ = fs::remove_dir_all(folder.join("specs"));
    let write = |path: &str, text: &str| {
        let path = folder.join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    };
    let text = |path: &str| fs::read_to_string(root.join(path)).expect("a file of the project");
    for part in ["", "src", "elements", "forms", "laws", "motion"] {
        for entry in fs::read_dir(root.join("specs").join(part)).expect("a folder of the specs") {
            let path = entry.expect("an entry").path();
            if path.is_file() {
                let name = path.strip_prefix(root).expect("a path of the project");
                let name = name.to_str().expect("a plain name");
                write(name, &text(name));
            }
        }
    }
    write("specs/laws/dropped-hertz.toml", LAW);
    let brick: String = text("specs/elements/hex8.toml")
        .lines()
        .map(|line| match line.split_once(" = ") {
            Some(("name", _)) => "name = \"dropped-brick\"\n".to_owned(),
            Some(("types", _)) => "types = [\"BRICK8\"]\n".to_owned(),
            _ => format!("{line}\n"),
        })
        .collect();
    write("specs/elements/dropped-brick.toml", &brick);

    let codegen = root.join("codegen");
    let manifest: String = text("Cargo.toml")
        .lines()
        .map(|line| {
            if line.starts_with("members") {
                "members = [\"specs\", \"probe\"]\n".to_owned()
            } else if line.starts_with("default-members") {
                String::new()
            } else {
                let here = format!("{:?}", codegen.display().to_string());
                format!("{}\n", line.replace("\"codegen\"", &here))
            }
        })
        .collect();
    write("Cargo.toml", &manifest);
    write("Cargo.lock", &text("Cargo.lock"));
    write(
        "probe/Cargo.toml",
        "[package]\nname = \"whirl-probe\"\nedition = \"2024\"\n\n\
         [dependencies]\nwhirl-specs.workspace = true\n",
    );
    write("probe/src/main.rs", &format!("const POINTS: &[f64] = &{:?};\n{PROBE}", points()));
    folder
}

#[test]
fn specs_dropped_into_the_folders_are_usable() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace");
    let folder = workspace(root);
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    // The target folder of the tests: what they were built from is not built again.
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().expect("the target folder");
    let output = Command::new(cargo)
        .args(["run", "--quiet", "--offline", "--package", "whirl-probe", "--manifest-path"])
        .arg(folder.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(target)
        .output()
        .expect("cargo can be run");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "the probe fails:\n{errors}");

    let law = LawSpec::read(&Source::new("laws/dropped-hertz.toml", LAW)).expect("a law");
    let tape = Tape::new(&law.program().expect("a program"));
    let (mut taped, mut workspace) = (vec![0.0; 150], vec![0.0; tape.workspace()]);
    tape.evaluate(50, &points(), &mut taped, &mut workspace);
    let printed = String::from_utf8(output.stdout).expect("text");
    let expected: Vec<String> =
        taped.iter().map(|value| format!("{:x}", value.to_bits())).collect();
    assert_eq!(printed.lines().collect::<Vec<_>>(), expected);
    assert!(taped[..50].iter().any(|q| *q > 0.0), "the law acts somewhere");
}
