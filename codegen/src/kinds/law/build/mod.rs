//! Draft → law: names and dimensions checked, formulas lowered in SI, breaks moved, derivatives taken.

mod bytecode;
mod engage;
mod names;
mod output;
mod valid;

pub(super) use engage::engaged;

use std::collections::BTreeSet;

use self::names::Names;
use self::valid::Scope;
use super::draft::{Constant, Draft, ValidityDraft};
use super::spec::Stored;
use super::system::{Misfit, System};
use super::table::LawTable;
use super::{Definition, LawInput, LawReport, LawSpec, LawState, Parameter, in_si};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::expression::{Graph, Shape};
use crate::formula::{Formula, Meaning, PI};
use crate::rational::{Rational, nearest};
use crate::units::Dimension;

/// Checks and lowers a draft.
pub(super) fn build(draft: Draft) -> Result<LawSpec, Diagnostics> {
    let mut errors = Diagnostics::new();
    check_units(&draft, &mut errors);
    let unused = unused(&draft);
    let system = match system(&draft) {
        Ok(system) if errors.is_empty() => system,
        Ok(_) => {
            errors.append(unused);
            return Err(errors);
        }
        Err(found) => {
            errors.append(found);
            return Err(errors);
        }
    };
    let mut names = Names::default();
    let mut graph = Graph::new();
    let mut inputs = Vec::new();
    for input in &draft.inputs {
        let symbol = graph.scalar(&input.name);
        let scaled = graph.times(in_si(&input.unit).recip(), symbol);
        names.add(&input.name, scaled, &input.unit, None);
        let si = |end: &Rational| nearest(&(end * in_si(&input.unit)));
        inputs.push(LawInput {
            name: input.name.clone(),
            title: input.title.clone(),
            unit: input.unit.clone(),
            symbol,
            range: input.range.as_ref().map(|[low, high]| [si(low), si(high)]),
        });
    }
    let mut parameters = Vec::new();
    for constant in draft.parameters {
        let parameter = parameter(constant, &system);
        let id = graph.number(parameter.value.clone());
        names.add(&parameter.name, id, &parameter.unit, Some(parameter.value.clone()));
        parameters.push(parameter);
    }
    let mut waiting = draft.tables;
    let mut tables = Vec::new();
    let mut definitions = Vec::new();
    for (_, name, formula) in draft.definitions {
        // A table comes as soon as all names of its input are known.
        let ready = waiting.extract_if(.., |table| {
            table.input.names().keys().all(|name| names.ids.contains_key(*name) || *name == PI)
        });
        for table in ready.collect::<Vec<_>>() {
            tables.extend(names.table(&mut graph, table, &system, definitions.len(), &mut errors));
        }
        match names.lower(&mut graph, &formula, Shape::Scalar) {
            Ok((id, measured)) => {
                names.ids.insert(name.clone(), id);
                if let Some(dimension) = measured {
                    names.meanings.insert(name.clone(), Meaning { dimension, value: None });
                }
            }
            Err(found) => {
                errors.append(found);
                // Its name counts as declared, so that its users are not reported too.
                let unknown = graph.scalar(&name);
                names.ids.insert(name.clone(), unknown);
            }
        }
        definitions.push(Definition { name, formula });
    }
    for table in waiting {
        tables.extend(names.table(&mut graph, table, &system, definitions.len(), &mut errors));
    }
    let states = states(&draft.starts, &inputs);
    let stored = draft.stored.map(|formula| stored(&formula, &mut graph, &names, &system));
    let stored = stored.transpose().unwrap_or_else(|found| {
        errors.append(found);
        None
    });
    let mut outputs = Vec::new();
    for output in draft.outputs {
        match output::lower(output, &mut graph, &names, &inputs) {
            Ok(output) => outputs.push(output),
            Err(found) => errors.append(found),
        }
    }
    // Where a name is unknown, the one that was meant may be unused for that alone.
    if errors.iter().all(|error| error.code != Some(Code::UNKNOWN_NAME)) {
        errors.append(unused);
    }
    let after = |place: usize| tables.iter().filter(move |table: &&LawTable| table.after == place);
    let mut derived: Vec<&str> = Vec::new();
    for place in 0..=definitions.len() {
        derived.extend(after(place).map(|table| table.name.as_str()));
        derived.extend(definitions.get(place).map(|definition| definition.name.as_str()));
    }
    let scope =
        Scope { names: &names, system: &system, inputs: &inputs, parameters: &parameters, derived };
    let valid = if errors.is_empty() {
        valid::build(&draft.valid, &tables, &scope, &mut graph).unwrap_or_else(|found| {
            errors.append(found);
            Vec::new()
        })
    } else {
        Vec::new()
    };
    let mut law = errors.into_result(LawSpec {
        name: draft.name,
        title: draft.title,
        reference: draft.reference,
        file: draft.file,
        acts: draft.acts,
        inputs,
        parameters,
        tables,
        definitions,
        outputs,
        states,
        stored,
        valid,
        graph,
        report: LawReport::default(),
        code: Vec::new(),
    })?;
    bytecode::write(&mut law)?;
    differentiate(&mut law)?;
    Ok(law)
}

/// The states, which are the last of the inputs.
fn states(starts: &[Option<Rational>], inputs: &[LawInput]) -> Vec<LawState> {
    let own = inputs[inputs.len() - starts.len()..].iter().zip(starts);
    let si = |input: &LawInput, start: &Rational| nearest(&(start * in_si(&input.unit)));
    own.map(|(input, start)| LawState { start: start.as_ref().map(|own| si(input, own)) }).collect()
}

/// The energy that is stored.
fn stored(
    formula: &Formula,
    graph: &mut Graph,
    names: &Names,
    system: &System,
) -> Result<Stored, Diagnostics> {
    let energy = Dimension::TORQUE;
    let (id, found) = names.lower(graph, formula, Shape::Scalar)?;
    if let Some(found) = found.filter(|found| *found != energy) {
        let message = format!("what is stored is an energy, but this is {found}");
        let error = formula.text.error_here(Code::DIMENSION, message);
        return Err(error.help("a force times a length is one, such as 'k*x^2/2'").into());
    }
    let text = formula.text.text().to_owned();
    Ok(Stored { text, value: graph.times(system.in_si(&energy), id) })
}

/// The parameters of a draft.
pub(super) fn parameters_of(draft: Draft) -> Result<Vec<Parameter>, Diagnostics> {
    let system = system(&draft)?;
    Ok(draft.parameters.into_iter().map(|constant| parameter(constant, &system)).collect())
}

fn parameter(constant: Constant, system: &System) -> Parameter {
    let Constant { key: _, name, title, unit, value: written, bearing, limits, .. } = constant;
    let value = system.convert(&written, &unit);
    Parameter { name, title, unit, written, bearing, limits, value }
}

/// The system of the units of inputs and outputs.
fn system(draft: &Draft) -> Result<System, Diagnostics> {
    let mut variables = draft.inputs.iter().chain(draft.outputs.iter().map(|o| &o.variable));
    System::of(variables.clone().map(|v| &v.unit)).map_err(|misfit| {
        let (Misfit::Contradicts(place) | Misfit::Unwieldy(place)) = misfit;
        let odd = variables.nth(place).expect("the place of a variable");
        let what = match misfit {
            Misfit::Contradicts(_) => "does not go with the units before it",
            Misfit::Unwieldy(_) => "and those before it have powers of too many fractions",
        };
        let message = format!("the unit `{}` {what}", odd.unit);
        let error = odd.unit_place.error_here(Code::WRONG_UNIT, message);
        error.help("use one system, such as mm, mm/s and N, or m, m/s and N").into()
    })
}

/// A name that nothing uses is most likely a slip of the pen.
fn unused(draft: &Draft) -> Diagnostics {
    let mut errors = Diagnostics::new();
    let outputs = draft.outputs.iter().flat_map(|output| &output.pieces);
    let formulas = outputs.flat_map(|(when, value)| when.iter().chain([value]));
    let formulas = formulas.chain(draft.definitions.iter().map(|(_, _, formula)| formula));
    let formulas = formulas.chain(draft.tables.iter().map(|table| &table.input));
    let formulas = formulas.chain(&draft.stored);
    let formulas = formulas.chain(draft.valid.iter().flat_map(ValidityDraft::formulas));
    let used: BTreeSet<&str> = formulas.flat_map(|formula| formula.names().into_keys()).collect();
    let inputs = draft.inputs.iter().map(|input| (&input.key, &input.name));
    let parameters = draft.parameters.iter().map(|parameter| (&parameter.key, &parameter.name));
    let definitions = draft.definitions.iter().map(|(key, name, _)| (key, name));
    let tables = draft.tables.iter().map(|table| (&table.key, &table.name));
    for (key, name) in inputs.chain(parameters).chain(tables).chain(definitions) {
        if !used.contains(name.as_str()) {
            let error =
                key.error_here(Code::UNUSED, format!("`{name}` is not used by any formula"));
            errors.push(error.help("leave it out"));
        }
    }
    errors
}

/// Formulas know no degrees, and the graph only rational factors.
fn check_units(draft: &Draft, errors: &mut Diagnostics) {
    for variable in draft.inputs.iter().chain(draft.outputs.iter().map(|o| &o.variable)) {
        if variable.unit.factor().to_rational().is_none() {
            let message = format!("`{}` cannot be in `{}`", variable.name, variable.unit);
            let error = variable.unit_place.error_here(Code::WRONG_UNIT, message);
            let si = variable.unit.dimension().si_unit();
            errors.push(error.help(format!("write `{si}`: formulas take angles in rad")));
        }
    }
}

fn differentiate(law: &mut LawSpec) -> Result<(), Diagnostics> {
    for output in &mut law.outputs {
        for input in &law.inputs {
            let derivative = law.graph.differentiate(output.value, input.symbol);
            output.derivatives.push(derivative.map_err(|error| {
                Diagnostic::new(&law.file, Code::UNDEFINED, None, error.to_string())
            })?);
        }
    }
    if law.graph.exceeded() {
        let message = "the derivatives of this law grow beyond the bounds on numbers and terms";
        return Err(Diagnostic::new(&law.file, Code::LIMIT, None, message).into());
    }
    Ok(())
}
