//! The formulas of a law as instructions.

use super::super::{LawSpec, Made, PieceSteps};
use crate::diagnostic::Diagnostic;
use crate::formula::{Formula, Known, Steps};
use crate::rational::nearest;
use crate::spec::law::Condition;

/// Writes the formulas of a law that was lowered.
pub(super) fn write(law: &mut LawSpec) -> Result<(), Diagnostic> {
    let mut known: Vec<&str> = law.inputs.iter().map(|input| input.name.as_str()).collect();
    let constant = |name: &str| {
        let parameter = law.parameters.iter().find(|parameter| parameter.name == name)?;
        Some(Known::Constant(nearest(&parameter.value)))
    };
    let steps = |formula: &Formula, known: &[&str]| {
        let place = |name: &str| known.iter().position(|known| *known == name).map(Known::Place);
        Steps::of(formula, &|name| place(name).or_else(|| constant(name)))
    };
    let mut made = Vec::new();
    for place in 0..=law.definitions.len() {
        for (table, spec) in law.tables.iter().enumerate().filter(|(_, spec)| spec.after == place) {
            made.push(Made::Table(table, steps(&spec.input, &known)?));
            known.push(&spec.name);
        }
        if let Some(definition) = law.definitions.get(place) {
            made.push(Made::Definition(steps(&definition.formula, &known)?));
            known.push(&definition.name);
        }
    }
    let mut outputs = Vec::new();
    for output in &law.outputs {
        let pieces = output.pieces.iter().map(|piece| {
            let when = match &piece.when {
                Some(Condition::Formula(formula)) => Some(steps(formula, &known)?),
                _ => None,
            };
            Ok(PieceSteps { when, value: steps(&piece.value, &known)? })
        });
        outputs.push(pieces.collect::<Result<Vec<_>, Diagnostic>>()?);
    }
    law.made = made;
    law.outputs.iter_mut().zip(outputs).for_each(|(output, steps)| output.steps = steps);
    Ok(())
}
