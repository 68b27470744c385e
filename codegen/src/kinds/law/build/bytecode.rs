//! The formulas of a law as bytecode.

use super::super::{LawSpec, NameCode, PieceCode};
use crate::diagnostic::Diagnostics;
use crate::formula::{Formula, bytecode};
use crate::kinds::law::Condition;
use crate::operation::Operand;
use crate::rational::nearest;

/// Writes the formulas of a law that was lowered.
pub(super) fn write(law: &mut LawSpec) -> Result<(), Diagnostics> {
    let mut known: Vec<&str> = law.inputs.iter().map(|input| input.name.as_str()).collect();
    let constant = |name: &str| {
        let parameter = law.parameters.iter().find(|parameter| parameter.name == name)?;
        Some(Operand::Constant(nearest(&parameter.value)))
    };
    let code = |formula: &Formula, known: &[&str]| {
        let place = |name: &str| known.iter().position(|known| *known == name).map(Operand::Input);
        bytecode(formula, &|name| place(name).or_else(|| constant(name)))
    };
    let mut name_codes = Vec::new();
    for place in 0..=law.definitions.len() {
        for (table, spec) in law.tables.iter().enumerate().filter(|(_, spec)| spec.after == place) {
            name_codes.push(NameCode::Table(table, code(&spec.input, &known)?));
            known.push(&spec.name);
        }
        if let Some(definition) = law.definitions.get(place) {
            name_codes.push(NameCode::Definition(code(&definition.formula, &known)?));
            known.push(&definition.name);
        }
    }
    let mut outputs = Vec::new();
    for output in &law.outputs {
        let pieces = output.pieces.iter().map(|piece| {
            let when = match &piece.when {
                Some(Condition::Formula(formula)) => Some(code(formula, &known)?),
                _ => None,
            };
            Ok(PieceCode { when, value: code(&piece.value, &known)? })
        });
        outputs.push(pieces.collect::<Result<Vec<_>, Diagnostics>>()?);
    }
    law.code = name_codes;
    law.outputs.iter_mut().zip(outputs).for_each(|(output, code)| output.code = code);
    Ok(())
}
