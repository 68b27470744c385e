//! Laws with other numbers in place of those of their files, by the kernels that were compiled.

use whirl_codegen::diagnostic::Source;
use whirl_codegen::expression::Rational;
use whirl_codegen::kinds::law::{Given, LawSpec, Parameter};
use whirl_codegen::schedule::Program;
use whirl_codegen::tape::Tape;
use whirl_specs::{LAWS, LawSkeleton, Registers, TABLES};

use crate::random::Random;

const SPRINGS: usize = 37;

fn read(law: &whirl_specs::Law) -> LawSpec {
    let table = |name: &str| {
        let path = format!("laws/{name}");
        let found = TABLES.iter().find(|(other, _)| *other == path);
        found.map(|(_, text)| Source::new(&path, *text)).ok_or(path)
    };
    let file = Source::new(law.origin.spec, law.origin.text);
    LawSpec::read_with(&file, &table).unwrap_or_else(|errors| panic!("{errors}"))
}

/// A parameter with its value times n/d.
fn times(parameter: &Parameter, [n, d]: [i64; 2]) -> Given {
    Given {
        name: parameter.name.clone(),
        value: parameter.written.clone() * Rational::new(n, d),
        unit: parameter.unit.clone(),
    }
}

/// What a program gives by its tape and by a kernel with its numbers, where the kernel is of its skeleton; whether it is.
fn agree(program: &Program, kernel: Option<LawSkeleton>, rows: &[f64], name: &str) -> bool {
    let Some((skeleton, numbers)) = program.skeleton() else { return false };
    let Some(kernel) = kernel.filter(|own| own.key == skeleton.key()) else { return false };
    assert_eq!(kernel.numbers, numbers.len(), "{name}");
    let tape = Tape::new(program);
    let (mut compiled, mut taped) =
        (vec![0.0; tape.outputs() * SPRINGS], vec![1.0; tape.outputs() * SPRINGS]);
    tape.evaluate(SPRINGS, rows, &mut taped, &mut vec![f64::NAN; tape.workspace()]);
    let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    for registers in Registers::all() {
        compiled.fill(f64::NAN);
        registers.within(|| (kernel.evaluate)(SPRINGS, &numbers, rows, &mut compiled));
        assert_eq!(bits(&compiled), bits(&taped), "{name} with {}", registers.name());
    }
    true
}

/// One value after the other is changed, then all of them, by a hundredth and less, so that laws stay what they are.
#[test]
fn kernels_take_the_numbers_of_other_parameters() {
    let mut random = Random::new(11);
    let (mut served, mut refused) = (0, Vec::new());
    for law in LAWS {
        let spec = read(law);
        let mut rows = Vec::new();
        for input in &spec.inputs {
            let [low, high] = input.range.unwrap_or([-1.0, 1.0]);
            rows.extend((0..SPRINGS).map(|_| low + (high - low) * random.unit()));
        }
        let single = spec.parameters.iter().map(|own| vec![times(own, [1009, 1000])]);
        let all =
            spec.parameters.iter().zip(1_i64..).map(|(own, i)| times(own, [1000 + i % 9, 1000]));
        for given in single.chain([Vec::new(), all.collect()]) {
            let names: Vec<&str> = given.iter().map(|own| own.name.as_str()).collect();
            let name = format!("{}: {}", law.origin.name, names.join(", "));
            // Numbers of balls are whole.
            let Ok(own) = spec.read_again(&given) else { continue };
            let program = own.program().expect("a program");
            let both = agree(&program, law.skeleton, &rows, &name)
                && agree(&own.forces_of(&program), law.forces_skeleton, &rows, &name);
            if both {
                served += 1;
            } else if !given.is_empty() {
                refused.push(name);
            } else {
                assert!(program.skeleton().is_none_or(|(_, numbers)| numbers.is_empty()), "{name}");
            }
        }
    }
    assert!(served > 140, "{served} served, not {refused:?}");
    assert!(refused.len() < 8, "{refused:?}");
}
