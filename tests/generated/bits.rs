//! Every shipped law: compiled for every kind of register and tape agree bit for bit, and both with direct
//! evaluation of the file's formulas to rounding.

use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::law::LawSpec;
use whirl_codegen::operation::Rounded;
use whirl_codegen::tape::Tape;
use whirl_specs::{LAWS, Registers, TABLES};

use crate::random::Random;

#[test]
fn compiled_tape_and_direct_evaluation_agree() {
    let mut random = Random::new(7);
    assert!(!LAWS.is_empty());
    let (mut measured, mut remembered) = (0, 0);
    for law in LAWS {
        let file = Source::new(law.origin.spec, law.origin.text);
        let table = |name: &str| {
            let path = format!("laws/{name}");
            let found = TABLES.iter().find(|(other, _)| *other == path);
            found.map(|(_, text)| Source::new(&path, *text)).ok_or(path)
        };
        let spec = LawSpec::read_with(&file, &table).unwrap_or_else(|errors| panic!("{errors}"));
        let tape = Tape::new(&spec.program().expect("a program"));
        // Not a whole number of registers.
        let springs = 1003;
        let mut inputs = Vec::new();
        for input in &spec.inputs {
            let [low, high] = input.range.unwrap_or([-1.0, 1.0]);
            // A little beyond the range on both sides.
            let width = 1.2 * (high - low);
            inputs.extend((0..springs).map(|_| low - 0.1 * width + width * random.unit()));
        }
        let rows = tape.outputs();
        let (mut compiled, mut taped) = (vec![0.0; rows * springs], vec![1.0; rows * springs]);
        let mut workspace = vec![f64::NAN; tape.workspace()];
        Registers::SINGLE.within(|| (law.evaluate)(springs, &inputs, &mut compiled));
        tape.evaluate(springs, &inputs, &mut taped, &mut workspace);
        let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&compiled), bits(&taped), "{}", law.origin.name);
        for registers in Registers::all() {
            compiled.fill(f64::NAN);
            registers.within(|| (law.evaluate)(springs, &inputs, &mut compiled));
            assert_eq!(
                bits(&compiled),
                bits(&taped),
                "{} with {}",
                law.origin.name,
                registers.name()
            );
        }

        let measures = spec.measures_program().expect("a program").map(|own| Tape::new(&own));
        assert_eq!(law.valid.len(), spec.valid.len(), "{}", law.origin.name);
        if let Some(tape) = measures {
            let mut taped = vec![1.0; tape.outputs() * springs];
            let mut workspace = vec![f64::NAN; tape.workspace()];
            tape.evaluate(springs, &inputs, &mut taped, &mut workspace);
            let mut compiled = vec![f64::NAN; taped.len()];
            for registers in Registers::all() {
                compiled.fill(f64::NAN);
                registers.within(|| (law.measure)(springs, &inputs, &mut compiled));
                assert_eq!(bits(&compiled), bits(&taped), "measures of {}", law.origin.name);
            }
            for j in 0..springs {
                let at: Vec<Rounded> =
                    (0..spec.inputs.len()).map(|i| Rounded::new(inputs[i * springs + j])).collect();
                for (place, direct) in spec.measures(&at).iter().enumerate() {
                    let value = compiled[place * springs + j];
                    let bound = 2.0 * direct.error;
                    assert!((value - direct.value).abs() <= bound, "{value} {direct:?}");
                }
            }
            measured += law.valid.len();
        }

        let rates: Vec<_> = spec.states.iter().map(|own| own.start).collect();
        assert_eq!(law.states.iter().map(|own| own.start).collect::<Vec<_>>(), rates);
        assert_eq!(rows, (law.outputs.len() + rates.len()) * (1 + spec.inputs.len()));
        let stored = spec.stored_program().expect("a program").map(|own| Tape::new(&own));
        assert_eq!(law.stored.is_some(), stored.is_some(), "{}", law.origin.name);
        if let (Some(stored), Some(tape)) = (law.stored, stored) {
            let mut taped = vec![1.0; springs];
            tape.evaluate(springs, &inputs, &mut taped, &mut vec![f64::NAN; tape.workspace()]);
            for registers in Registers::all() {
                let mut energies = vec![f64::NAN; springs];
                registers.within(|| stored(springs, &inputs, &mut energies));
                assert_eq!(bits(&energies), bits(&taped), "what {} stores", law.origin.name);
            }
            remembered += rates.len();
        }

        for j in 0..springs {
            let at: Vec<Rounded> =
                (0..spec.inputs.len()).map(|i| Rounded::new(inputs[i * springs + j])).collect();
            let direct = spec.evaluate(&at).expect("a value");
            for (place, direct) in direct.iter().enumerate() {
                let row = place * (1 + spec.inputs.len());
                let value = compiled[row * springs + j];
                // Both sides round each operation once, in another order.
                let bound = 2.0 * direct.error;
                let name = law.origin.name;
                assert!((value - direct.value).abs() <= bound, "{name}: {value} {direct:?}");
            }
        }
    }
    assert!(measured > 10, "{measured} measures");
    assert!(remembered > 1, "{remembered} states of laws that store energy");
}
