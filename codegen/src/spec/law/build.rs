//! Draft → law: names and dimensions checked, formulas lowered in SI, breaks moved, derivatives taken.

use std::collections::{BTreeMap, BTreeSet};

use crate::rational::{Rational, nearest};
use num_traits::Signed;

use super::blend;
use super::draft::{Draft, Jumps, Output};
use super::root::Polynomial;
use super::system::System;
use super::table::{LawTable, TableDraft};
use super::{Condition, Definition, LawInput, LawOutput, LawReport, LawSpec, Parameter, Piece};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Located};
use crate::expression::{Graph, Id, Node, Relation, Shape};
use crate::formula::{Formula, Meaning, PI, dimension, lower};
use crate::units::Unit;

/// Checks and lowers a draft.
pub(super) fn build(draft: Draft) -> Result<LawSpec, Diagnostics> {
    let mut errors = Diagnostics::new();
    check_units(&draft, &mut errors);
    let unused = unused(&draft);
    let variables = draft.inputs.iter().chain(draft.outputs.iter().map(|o| &o.variable));
    let system = match System::of(variables.clone().map(|v| &v.unit)) {
        Ok(system) if errors.is_empty() => system,
        Ok(_) => {
            errors.append(unused);
            return Err(errors);
        }
        Err(place) => {
            if let Some(odd) = variables.clone().nth(place) {
                let message =
                    format!("the unit `{}` does not go with the units before it", odd.unit);
                let error = odd.unit_place.error_here(Code::WRONG_UNIT, message);
                errors.push(error.help("use one system, such as mm, mm/s and N, or m, m/s and N"));
            }
            return Err(errors);
        }
    };
    let mut names = Names::default();
    let mut graph = Graph::new();
    let mut inputs = Vec::new();
    for input in &draft.inputs {
        let symbol = graph.scalar(&input.name);
        let scaled = graph.times(super::in_si(&input.unit).recip(), symbol);
        names.add(&input.name, scaled, &input.unit, None);
        let si = |end: &Rational| nearest(&(end * super::in_si(&input.unit)));
        inputs.push(LawInput {
            name: input.name.clone(),
            title: input.title.clone(),
            unit: input.unit.clone(),
            symbol,
            range: input.range.as_ref().map(|[low, high]| [si(low), si(high)]),
        });
    }
    let mut parameters = Vec::new();
    for parameter in draft.parameters {
        let value = system.convert(&parameter.value, &parameter.unit);
        let id = graph.number(value.clone());
        names.add(&parameter.name, id, &parameter.unit, Some(value.clone()));
        let (name, title, unit) = (parameter.name, parameter.title, parameter.unit);
        parameters.push(Parameter { name, title, unit, value });
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
    let mut outputs = Vec::new();
    for output in draft.outputs {
        match lower_output(output, &mut graph, &names, &inputs) {
            Ok(output) => outputs.push(output),
            Err(found) => errors.append(found),
        }
    }
    // Where a name is unknown, the one that was meant may be unused for that alone.
    if errors.iter().all(|error| error.code != Some(Code::UNKNOWN_NAME)) {
        errors.append(unused);
    }
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
        graph,
        report: LawReport::default(),
    })?;
    differentiate(&mut law)?;
    Ok(law)
}

/// A name that nothing uses is most likely a slip of the pen.
fn unused(draft: &Draft) -> Diagnostics {
    let mut errors = Diagnostics::new();
    let outputs = draft.outputs.iter().flat_map(|output| &output.pieces);
    let formulas = outputs.flat_map(|(when, value)| when.iter().chain([value]));
    let formulas = formulas.chain(draft.definitions.iter().map(|(_, _, formula)| formula));
    let formulas = formulas.chain(draft.tables.iter().map(|table| &table.input));
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

#[derive(Default)]
struct Names {
    ids: BTreeMap<String, Id>,
    meanings: BTreeMap<String, Meaning>,
}

impl Names {
    fn add(&mut self, name: &str, id: Id, unit: &Unit, value: Option<Rational>) {
        self.ids.insert(name.to_owned(), id);
        let meaning = Meaning { dimension: *unit.dimension(), value };
        self.meanings.insert(name.to_owned(), meaning);
    }

    /// Lowers a table and declares it.
    fn table(
        &mut self,
        graph: &mut Graph,
        draft: TableDraft,
        system: &System,
        after: usize,
        errors: &mut Diagnostics,
    ) -> Option<LawTable> {
        let name = draft.name.clone();
        let input = match self.lower(graph, &draft.input, Shape::Scalar) {
            Ok((id, found)) => {
                let wanted = draft.input_unit().dimension().without_angle();
                match found.filter(|found| *found != wanted) {
                    None => Ok(id),
                    Some(found) => {
                        let unit = draft.input_unit();
                        let message =
                            format!("this is {found}, but its column is {wanted}, in `{unit}`");
                        Err(draft.input.text.error_here(Code::DIMENSION, message).into())
                    }
                }
            }
            Err(found) => Err(found),
        };
        match input {
            Ok(input) => {
                let unit = draft.unit().clone();
                let mut table = draft.build(system, after);
                let id = table.lower(graph, input);
                self.add(&name, id, &unit, None);
                Some(table)
            }
            Err(found) => {
                errors.append(found);
                // Its name counts as declared, so that its users are not reported too.
                let unknown = graph.scalar(&name);
                self.ids.insert(name, unknown);
                None
            }
        }
    }

    /// Lowers a formula of the given shape, in the units of the file, and finds what it measures.
    fn lower(
        &self,
        graph: &mut Graph,
        formula: &Formula,
        wanted: Shape,
    ) -> Result<(Id, Option<crate::units::Dimension>), Diagnostics> {
        let id = lower(formula, graph, &self.ids)?;
        let dimension = dimension(formula, &self.meanings)?;
        if graph.shape(id) != wanted {
            let message = match wanted {
                Shape::Truth => "expected a condition such as `h < c0`, found a number",
                _ => "expected a number, found a condition",
            };
            return Err(formula.text.error_here(Code::SHAPE, message).into());
        }
        Ok((id, dimension))
    }
}

fn lower_output(
    output: Output,
    graph: &mut Graph,
    names: &Names,
    inputs: &[LawInput],
) -> Result<LawOutput, Diagnostics> {
    let mut errors = Diagnostics::new();
    let variable = &output.variable;
    let wanted = variable.unit.dimension().without_angle();
    let (mut conditions, mut pieces) = (Vec::new(), Vec::new());
    for (when, value) in &output.pieces {
        let lowered = names.lower(graph, value, Shape::Scalar).and_then(|(id, found)| match found
            .filter(|found| *found != wanted)
        {
            Some(found) => {
                let message = format!("`{}` is {wanted}, but this is {found}", variable.name);
                let help = "a parameter with a unit is missing as a factor; a number as a factor \
                                takes any unit";
                Err(value.text.error_here(Code::DIMENSION, message).help(help).into())
            }
            None => Ok(graph.times(super::in_si(&variable.unit), id)),
        });
        let node = lowered.unwrap_or_else(|found| {
            errors.append(found);
            graph.integer(0)
        });
        let condition = match when {
            None => None,
            Some(when) => match names.lower(graph, when, Shape::Truth) {
                Ok((id, _)) => {
                    conditions.push(id);
                    let threshold = threshold(graph, id, inputs, when);
                    Some(threshold.unwrap_or_else(|| Condition::Formula(when.clone())))
                }
                Err(found) => {
                    errors.append(found);
                    Some(Condition::Formula(when.clone()))
                }
            },
        };
        pieces.push(Piece { when: condition, value: value.clone(), node });
    }
    errors.into_result(())?;
    if output.jumps == Jumps::Engaged {
        engage(graph, inputs, &mut pieces)?;
    }
    blend::set(&output, inputs, &mut pieces)?;
    let mut value = pieces[pieces.len() - 1].node;
    for (place, piece) in pieces.iter().enumerate().rev().skip(1) {
        let mask = match &piece.when {
            Some(Condition::Threshold { input, at, below, blend: Some(half), .. }) => {
                let x = inputs[*input].symbol;
                value = blend::lower(graph, x, (at, *below, half), piece.node, value);
                continue;
            }
            Some(Condition::Threshold { input, at, below, inclusive, .. }) => {
                let relation = if *inclusive { Relation::LessOrEqual } else { Relation::Less };
                let (x, at) = (inputs[*input].symbol, graph.number(at.clone()));
                let (low, high) = if *below { (x, at) } else { (at, x) };
                graph.compare(relation, low, high)
            }
            _ => conditions[place],
        };
        value = graph.select(mask, piece.node, value);
    }
    Ok(LawOutput {
        name: output.variable.name,
        title: output.variable.title,
        unit: output.variable.unit,
        accepts_jumps: output.jumps == Jumps::Accepted,
        pieces,
        value,
        derivatives: Vec::new(),
    })
}

/// The condition as a threshold of one input, if it compares something linear in one.
fn threshold(
    graph: &mut Graph,
    condition: Id,
    inputs: &[LawInput],
    when: &Formula,
) -> Option<Condition> {
    let Node::Compare(relation, a, b) = *graph.node(condition) else {
        return None;
    };
    let difference = graph.sub(a, b);
    for (input, variable) in inputs.iter().enumerate() {
        let polynomial = Polynomial::of(graph, difference, variable.symbol);
        // slope·(x − at) < 0
        if let Some((slope, at)) = polynomial.and_then(|p| p.linear()) {
            let (below, inclusive) = (slope.is_positive(), relation == Relation::LessOrEqual);
            let text = when.text.clone();
            return Some(Condition::Threshold {
                input,
                at,
                below,
                inclusive,
                moved_from: None,
                blend: None,
                text,
            });
        }
    }
    None
}

/// The root of the difference of a piece and the next that lies nearest to the break between them.
fn nearest_root(
    graph: &mut Graph,
    x: Id,
    difference: Id,
    at: &Rational,
) -> Result<Rational, String> {
    let polynomial = Polynomial::of(graph, difference, x)
        .ok_or("`engage = \"root\"` needs pieces that are polynomials in the input of the break")?;
    polynomial
        .root_nearest(at)
        .ok_or_else(|| "the pieces beside the break never have the same value".to_owned())
}

/// Where `engage` would move the break after a piece to, SI; `None` if nowhere.
pub(super) fn engaged(law: &LawSpec, pieces: &[Piece], place: usize) -> Option<Rational> {
    let [Piece { when: Some(Condition::Threshold { input, at, .. }), node, .. }, next] =
        pieces.get(place..place + 2)?
    else {
        return None;
    };
    let mut graph = law.graph.clone();
    let difference = graph.sub(*node, next.node);
    nearest_root(&mut graph, law.inputs[*input].symbol, difference, at).ok()
}

fn engage(graph: &mut Graph, inputs: &[LawInput], pieces: &mut [Piece]) -> Result<(), Diagnostics> {
    let places: Vec<Located> =
        pieces.iter().map(|piece| super::scan::place_of(piece).clone()).collect();
    let mut errors = Diagnostics::new();
    let thresholds: Vec<Option<(usize, Rational)>> = (pieces.iter())
        .map(|piece| match &piece.when {
            Some(Condition::Threshold { input, at, .. }) => Some((*input, at.clone())),
            _ => None,
        })
        .collect();
    let last = pieces.len() - 1;
    for place in 0..last {
        let difference = graph.sub(pieces[place].node, pieces[place + 1].node);
        let Some(Condition::Threshold { input, at, moved_from, .. }) = &mut pieces[place].when
        else {
            let message = "`engage = \"root\"` needs conditions such as `h < c0`: one input and a \
                           constant";
            errors.push(places[place].error_here(Code::NO_ROOT, message.to_owned()));
            continue;
        };
        if graph.is_zero(difference) {
            continue;
        }
        match nearest_root(graph, inputs[*input].symbol, difference, at) {
            Ok(root) => {
                let (low, high) = ((&root).min(at).clone(), (&root).max(at).clone());
                let mut others = thresholds.iter().enumerate().filter(|(other, _)| *other != place);
                let crossed = others.any(|(_, other)| {
                    matches!(other, Some((i, x)) if i == input && low <= *x && *x <= high)
                });
                if crossed {
                    errors.push(places[place].error_here(
                        Code::NO_ROOT,
                        "the root nearest to a break lies past another".to_owned(),
                    ));
                } else if root != *at {
                    *moved_from = Some(std::mem::replace(at, root));
                }
            }
            Err(message) => {
                let error = places[place].error_here(Code::NO_ROOT, message);
                errors.push(error.help(
                    "change the pieces or the break, or keep the jump by `jump = \"accept\"`",
                ));
            }
        }
    }
    errors.into_result(())
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
