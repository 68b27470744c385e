//! Laws read with other values of their parameters than their files have.

use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::law::{Given, LawSpec};
use whirl_codegen::rational::Rational;
use whirl_codegen::tape::Tape;

/// Points in every direction.
const POINTS: usize = 96;

/// Bits of all outputs and derivatives at points that fill the ranges.
fn bits(law: &LawSpec) -> Vec<u64> {
    let tape = Tape::new(&law.program().expect("a program"));
    let ranges = super::ranges(law);
    let share = |place: usize, n: usize| {
        // Multiples of irrational numbers, modulo 1.
        let root =
            [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0, 31.0, 37.0][place].sqrt();
        (root * (n + 1) as f64).fract()
    };
    let row = |(place, [low, high]): (usize, &[f64; 2])| {
        (0..POINTS).map(move |n| low + (high - low) * share(place, n)).collect::<Vec<_>>()
    };
    let inputs: Vec<f64> = ranges.iter().enumerate().flat_map(row).collect();
    let mut outputs = vec![0.0; POINTS * tape.outputs()];
    tape.evaluate(POINTS, &inputs, &mut outputs, &mut vec![0.0; tape.workspace()]);
    outputs.into_iter().map(f64::to_bits).collect()
}

/// The text of a law with another value of a parameter.
fn edited(text: &str, name: &str, value: &str) -> String {
    let head = format!("[parameters.{name}]\nvalue = ");
    let start = text.find(&head).unwrap_or_else(|| panic!("{name}")) + head.len();
    let end = start + text[start..].find('\n').expect("a line");
    format!("{}{value}{}", &text[..start], &text[end..])
}

/// Every parameter of every law, by its exact value and by the text of the file: breaks, roots, tables and sums
/// follow alike.
#[test]
fn given_values_are_those_of_a_file() {
    let mut moved = 0;
    for law in super::laws() {
        let of_file = bits(&law);
        for parameter in &law.parameters {
            // A number of balls stays a number.
            let seven_eighths = &parameter.written * Rational::new(7, 8);
            let text = format!("{}", whirl_codegen::rational::nearest(&seven_eighths));
            let source =
                Source::new(&law.file.path, edited(&law.file.text, &parameter.name, &text));
            let beside = |name: &str| {
                let table = law.tables.iter().find(|table| table.path == name);
                table.map(|table| table.file.clone()).ok_or_else(|| name.to_owned())
            };
            let copy = LawSpec::read_with(&source, &beside);
            let exact = copy.as_ref().ok().and_then(|copy| {
                copy.parameters
                    .iter()
                    .find(|own| own.name == parameter.name)
                    .map(|p| p.written.clone())
            });
            let value = exact.unwrap_or(seven_eighths);
            let given = Given { name: parameter.name.clone(), value, unit: parameter.unit.clone() };
            let given = law.read_again(&[given]);
            match (copy, given) {
                (Ok(copy), Ok(given)) => {
                    let (copy, given) = (bits(&copy), bits(&given));
                    assert!(copy == given, "{}: {}", law.name, parameter.name);
                    moved += usize::from(copy != of_file);
                }
                // Such as a law whose report finds a jump.
                (Err(_), Err(_)) => {}
                (copy, given) => {
                    panic!("{}: {}: {:?} {:?}", law.name, parameter.name, copy.err(), given.err())
                }
            }
        }
        let own: Vec<Given> = (law.parameters.iter())
            .map(|parameter| Given {
                name: parameter.name.clone(),
                value: parameter.written.clone(),
                unit: parameter.unit.clone(),
            })
            .collect();
        assert!(bits(&law.read_again(&own).expect("the law")) == of_file, "{}", law.name);
        let unknown = Given { name: "none".to_owned(), ..own_or_one(own) };
        assert!(law.read_again(&[unknown]).is_err(), "{}", law.name);
    }
    assert!(moved > 40, "{moved} parameters change their law");
}

fn own_or_one(own: Vec<Given>) -> Given {
    let unit = whirl_codegen::units::Unit::parse("1").expect("a unit");
    let one = Given { name: String::new(), value: Rational::from(1), unit };
    own.into_iter().next().unwrap_or(one)
}
