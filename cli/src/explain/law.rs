//! What a law says and what follows from it.

use std::collections::BTreeMap;

use num_traits::ToPrimitive;
use whirl_codegen::diagnostic::Located;
use whirl_codegen::expression::Rational;
use whirl_codegen::formula;
use whirl_codegen::spec::law::{Condition, LawSpec, Parameter, short};
use whirl_codegen::spec::read::Document;
use whirl_codegen::spec::schema::Described;

use super::equations::{Equation, equations};
use super::page::Page;
use super::plot;

/// Everything about a law but its code.
pub(super) fn explain(page: &mut Page, law: &LawSpec) {
    variables(page, law);
    given(page, law);
    derived(page, law);
    report(page, law);
    if let Some(plot) = plot::law(law) {
        page.heading(&plot.title);
        plot.lines.iter().for_each(|line| page.item(line));
    }
}

/// What was found about a law when it was read.
pub(super) fn report(page: &mut Page, law: &LawSpec) {
    page.heading(&format!("Report: {}", law.acts.called()));
    law.report.to_string().lines().for_each(|line| page.item(line));
}

fn variables(page: &mut Page, law: &LawSpec) {
    page.heading("Inputs");
    let rows = law.inputs.iter().map(|input| {
        let si = input.unit.factor().to_f64();
        let range = input.range.map_or(String::new(), |[low, high]| {
            format!("{} to {}", short(low / si), short(high / si))
        });
        vec![input.name.clone(), input.unit.to_string(), range, input.title.clone()]
    });
    page.columns(&rows.collect::<Vec<_>>());
    if !law.parameters.is_empty() {
        page.heading("Parameters");
        let given = given_values(law);
        let rows = law.parameters.iter().map(|parameter| {
            let Parameter { name, title, unit, value } = parameter;
            let given = given.get(name).unwrap_or(value);
            let number = |value: &Rational| short(value.to_f64().unwrap_or(f64::NAN));
            let unit = if unit.text() == "1" { String::new() } else { format!(" {unit}") };
            let converted = match given == value {
                true => String::new(),
                false => format!("{} in the units of the formulas", number(value)),
            };
            vec![format!("{name} = {}{unit}", number(given)), converted, title.clone()]
        });
        page.columns(&rows.collect::<Vec<_>>());
    }
}

/// Values of the parameters in the units in which the file gives them.
fn given_values(law: &LawSpec) -> BTreeMap<String, Rational> {
    let document = Document::parse(&law.file);
    let Some(table) = document.root(LawSpec::SHAPE).optional_table("parameters") else {
        return BTreeMap::new();
    };
    let value = |key: Located| {
        let (value, _) = table.optional_table(key.text())?.optional_number("value")?;
        Some((formula::name(key.text()).ok()?, value))
    };
    table.names().into_iter().filter_map(value).collect()
}

/// The formulas as the file has them.
fn given(page: &mut Page, law: &LawSpec) {
    page.heading("As given");
    for definition in &law.definitions {
        page.item(&format!("{} = {}", definition.name, definition.formula.text.text()));
    }
    for output in &law.outputs {
        page.item(&format!("{} ({}), {}", output.name, output.unit, output.title));
        let last = output.pieces.len() - 1;
        let rows = output.pieces.iter().enumerate().map(|(place, piece)| {
            let when = match &piece.when {
                Some(condition) => format!("where {}", text_of(condition)),
                None if last > 0 && place == last => "elsewhere".to_string(),
                None => String::new(),
            };
            vec![format!("  = {}", piece.value.text.text()), when]
        });
        page.columns(&rows.collect::<Vec<_>>());
    }
}

fn text_of(condition: &Condition) -> &str {
    match condition {
        Condition::Threshold { text, .. } => text.text(),
        Condition::Formula(formula) => formula.text.text(),
    }
}

/// Outputs and derivatives as the generator has them.
fn derived(page: &mut Page, law: &LawSpec) {
    let inputs: Vec<String> =
        law.inputs.iter().map(|input| format!("{} in {}", input.name, input.unit)).collect();
    page.heading(&format!("As derived, {}", inputs.join(", ")));
    let equations = match equations(law) {
        Ok(equations) => equations,
        Err(errors) => {
            page.paragraph(2, &format!("too large to be written out: {errors}"));
            return;
        }
    };
    let all = || equations.definitions.iter().chain(&equations.outputs);
    all().for_each(|equation| say(page, equation));
    if all().flat_map(|equation| &equation.pieces).any(|(text, _)| text.contains("select(")) {
        page.item("select(c, a, b) is a where c holds, else b");
    }
    if let Ok(program) = law.program() {
        page.item(&format!("computed together with {}", program.total_counts()));
    }
}

fn say(page: &mut Page, equation: &Equation) {
    let Equation { name, unit, pieces } = equation;
    let left = match unit {
        Some(unit) => format!("{name} ({unit})"),
        None => name.clone(),
    };
    if let [(formula, None)] = pieces.as_slice() {
        page.item(&format!("{left} = {formula}"));
        return;
    }
    page.item(&left);
    let rows = pieces.iter().map(|(formula, when)| {
        let when = when.as_ref().map_or("elsewhere".to_string(), |when| format!("where {when}"));
        vec![format!("  = {formula}"), when]
    });
    page.columns(&rows.collect::<Vec<_>>());
}
