//! What is found about a law when it is read, and what of it is an error.

use std::cell::OnceCell;

use super::analysis::{Analysis, in_file};
use super::exact;
use super::lint;
use super::report::{LawReport, StateReport, TableReport};
use super::scan::{self, Line, Lined};
use super::{LawSpec, LawTable};
use crate::diagnostic::Diagnostics;
use crate::expression::Id;

/// Analyses a law. A jump that is not accepted, and a point in a declared range without a finite value,
/// are errors.
pub(super) fn report(law: &LawSpec) -> Result<LawReport, Diagnostics> {
    let ranges = scan::ranges(law);
    let lines = scan::lines(&ranges, scan::terms(law));
    let mut errors = Diagnostics::new();
    lint::tables(law, &lines, &mut errors);
    if !errors.is_empty() {
        return Err(errors);
    }
    let mut outputs = Vec::new();
    // Names have the same values for all outputs.
    let lined: OnceCell<Vec<Lined<'_>>> = OnceCell::new();
    for (place, output) in law.outputs.iter().enumerate() {
        let analysis = Analysis::new(law, output);
        let analysed = match exact::facts(law, output, ranges[0]) {
            Some(facts) => Ok(analysis.exactly(facts)),
            None => analysis.over(
                lined.get_or_init(|| lines.iter().map(|line| Lined::new(law, line)).collect()),
            ),
        };
        match analysed {
            Ok(found) => {
                lint::output(law, (place, output), &found, &mut errors);
                outputs.push(found.report);
            }
            Err(error) => errors.push(error),
        }
    }
    let named = law.inputs.iter().zip(&ranges).map(|(input, range)| {
        let range = range.map(|end| in_file(end, &input.unit));
        (input.name.clone(), input.unit.to_string(), range)
    });
    let tables = law.tables.iter().map(table_report).collect();
    let states = states(law, &lines);
    errors.into_result(LawReport { ranges: named.collect(), tables, outputs, states })
}

/// How the states come to rest by themselves.
fn states(law: &LawSpec, lines: &[Line]) -> Vec<StateReport> {
    let (first, first_rate) = (law.taken().len(), law.given().len());
    let own = (0..law.states.len())
        .map(|place| law.outputs[first_rate + place].derivatives[first + place]);
    let own: Vec<Id> = own.collect();
    if own.is_empty() {
        return Vec::new();
    }
    let inputs: Vec<Id> = law.inputs.iter().map(|input| input.symbol).collect();
    let code = law.graph.bytecode(&inputs, &own);
    let mut rates = vec![[f64::INFINITY, f64::NEG_INFINITY]; own.len()];
    for inputs in lines.iter().flat_map(|line| line.points.iter().map(|x| line.at(*x))) {
        for (rates, slope) in rates.iter_mut().zip(code.values::<f64>(&inputs)) {
            // Not −0.
            let rate = 0.0 - slope;
            if rate.is_finite() {
                *rates = [rates[0].min(rate), rates[1].max(rate)];
            }
        }
    }
    let names = law.remembered().iter().zip(rates);
    names.map(|(input, rates)| StateReport { name: input.name.clone(), rates }).collect()
}

fn table_report(table: &LawTable) -> TableReport {
    TableReport {
        name: table.name.clone(),
        file: table.path.clone(),
        rows: table.knots.len(),
        input: [table.input.text.text().to_owned(), table.input_unit.to_string()],
        span: table.ends,
        extend: table.extend,
    }
}
