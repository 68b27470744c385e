//! What a law says and what follows from it.

use num_traits::ToPrimitive;

use super::equations::{Equation, equations};
use super::{Condition, LawInput, LawSpec, Parameter, short};
use crate::expression::Rational;
use crate::kinds::page::Page;

impl LawSpec {
    /// Everything about a law but its code.
    pub(in crate::kinds) fn explain(&self, page: &mut Page) {
        variables(page, self);
        given(page, self);
        valid(page, self);
        derived(page, self);
        found(page, self);
    }

    /// What was found about a law when it was read, and where it may be believed.
    pub(in crate::kinds) fn report(&self, page: &mut Page) {
        found(page, self);
        valid(page, self);
    }
}

fn found(page: &mut Page, law: &LawSpec) {
    page.heading(&format!("Report: {}", law.acts.called()));
    law.report.to_string().lines().for_each(|line| page.item(line));
}

fn variables(page: &mut Page, law: &LawSpec) {
    page.heading("Inputs");
    let named = |input: &LawInput| {
        let si = input.unit.factor().to_f64();
        let range = input.range.map_or(String::new(), |[low, high]| {
            format!("{} to {}", short(low / si), short(high / si))
        });
        vec![input.name.clone(), input.unit.to_string(), range, input.title.clone()]
    };
    page.columns(&law.taken().iter().map(named).collect::<Vec<_>>());
    if !law.states.is_empty() {
        page.heading("States");
        let rows = law.remembered().iter().zip(&law.states).map(|(input, state)| {
            let si = input.unit.factor().to_f64();
            let start = match state.start {
                Some(start) => format!("begins at {}", short(start / si)),
                None => "begins at rest".to_owned(),
            };
            let mut row = named(input);
            row.insert(3, start);
            row
        });
        page.columns(&rows.collect::<Vec<_>>());
    }
    if !law.parameters.is_empty() {
        page.heading("Parameters");
        let rows = law.parameters.iter().map(|parameter| {
            let Parameter { name, title, unit, written, bearing, limits, value } = parameter;
            let number = |value: &Rational| short(value.to_f64().unwrap_or(f64::NAN));
            let unit = if unit.text() == "1" { String::new() } else { format!(" {unit}") };
            let converted = match written == value {
                true => String::new(),
                false => format!("{} in the units of the formulas", number(value)),
            };
            let limits = limits.words();
            let title =
                if limits.is_empty() { title.clone() } else { format!("{title}; {limits}") };
            let title = match bearing {
                Some(bearing) => format!("{title} (in a bearing: its {})", bearing.word()),
                None => title,
            };
            vec![format!("{name} = {}{unit}", number(written)), converted, title]
        });
        page.columns(&rows.collect::<Vec<_>>());
    }
}

/// Where the law may be believed.
fn valid(page: &mut Page, law: &LawSpec) {
    if law.valid.is_empty() {
        return;
    }
    page.heading("Valid where");
    let rows = law.valid.iter().map(|own| {
        let si = own.unit.factor().to_f64();
        let unit = if own.unit.text() == "1" { String::new() } else { format!(" {}", own.unit) };
        let [least, most] = own.limits.map(|limit| short(limit / si));
        let limits = match own.limits.map(f64::is_finite) {
            [true, true] => format!("from {least} to {most}{unit}"),
            [true, false] => format!("at least {least}{unit}"),
            _ => format!("at most {most}{unit}"),
        };
        vec![format!("{} = {}", own.name, own.text), limits, own.title.clone()]
    });
    page.columns(&rows.collect::<Vec<_>>());
}

/// The formulas as the file has them.
fn given(page: &mut Page, law: &LawSpec) {
    page.heading("As given");
    for definition in &law.definitions {
        page.item(&format!("{} = {}", definition.name, definition.formula.text.text()));
    }
    if let Some(stored) = &law.stored {
        page.item(&format!("stored = {}", stored.text));
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
            let why: Vec<&str> = errors.iter().map(|error| error.message.as_str()).collect();
            page.paragraph(2, &format!("too large to be written out: {}", why.join("; ")));
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
