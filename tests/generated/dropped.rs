//! A law and an element dropped into a copy of the specs are listed and work, with no Rust changed.

use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::law::LawSpec;
use whirl_codegen::operation::Function;
use whirl_codegen::tape::Tape;

use crate::workspace::{Workspace, text};

/// The law with every function of one number in it.
fn law() -> String {
    let functions = Function::ALL.iter().map(|f| format!("{}(0.3 + (h/d)^2)", f.name()));
    LAW.replace("FUNCTIONS", &functions.collect::<Vec<_>>().join(" + "))
}

const LAW: &str = r#"kind = "law"
name = "dropped-hertz"
title = "Hertzian contact with a damper"
source = "made for this test"

[inputs.h]
unit = "um"

[inputs.h_dot]
unit = "m/s"

[parameters.d]
value = 9
unit = "um"

[outputs.Q]
unit = "N"
pieces = [
  { when = 'h < 5', value = '2*(5 - h)^(3/2)*(1 - 0.4*h_dot)*(9 + FUNCTIONS)' },
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

/// The specs with two more, and the probe.
fn workspace() -> Workspace {
    let folders = ["elements", "forms", "laws", "motion"];
    let workspace = Workspace::new("dropped", "\"specs\", \"probe\"", &folders);
    workspace.write("specs/laws/dropped-hertz.toml", &law());
    let brick: String = text("specs/elements/hex8.toml")
        .lines()
        .map(|line| match line.split_once(" = ") {
            Some(("name", _)) => "name = \"dropped-brick\"\n".to_owned(),
            Some(("types", _)) => "types = [\"BRICK8\"]\n".to_owned(),
            _ => format!("{line}\n"),
        })
        .collect();
    workspace.write("specs/elements/dropped-brick.toml", &brick);
    workspace.write(
        "probe/Cargo.toml",
        "[package]\nname = \"whirl-probe\"\nedition = \"2024\"\n\n\
         [dependencies]\nwhirl-specs.workspace = true\n",
    );
    workspace
        .write("probe/src/main.rs", &format!("const POINTS: &[f64] = &{:?};\n{PROBE}", points()));
    workspace
}

#[test]
fn specs_dropped_into_the_folders_are_usable() {
    let output = workspace().cargo(&["run", "--package", "whirl-probe"]);
    let law = LawSpec::read(&Source::new("laws/dropped-hertz.toml", law())).expect("a law");
    let tape = Tape::new(&law.program().expect("a program"));
    let (mut taped, mut workspace) = (vec![0.0; 150], vec![0.0; tape.workspace()]);
    tape.evaluate(50, &points(), &mut taped, &mut workspace);
    let printed = String::from_utf8(output.stdout).expect("text");
    let expected: Vec<String> =
        taped.iter().map(|value| format!("{:x}", value.to_bits())).collect();
    assert_eq!(printed.lines().collect::<Vec<_>>(), expected);
    assert!(taped[..50].iter().any(|q| *q > 0.0), "the law acts somewhere");
}
