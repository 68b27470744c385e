//! What a film must be beside well written: linear in the test function, holding no less than nothing, and without a
//! moment of its own.

use std::collections::BTreeMap;

use num_traits::ToPrimitive;

use super::operators::named;
use super::spec::FilmSpec;
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::expression::normal;
use crate::units::Unit;

/// The measures of a clearance on which forces of films work.
const MEASURES: [&str; 3] = ["h", "s", "s_mean"];

pub(super) fn prove(spec: &FilmSpec) -> Result<(), Diagnostics> {
    let mut errors = Diagnostics::new();
    parameters(spec, &mut errors);
    linear(spec, &mut errors);
    works(spec, &mut errors);
    if errors.is_empty() {
        holds(spec, &mut errors);
        moments(spec, &mut errors);
    }
    errors.into_result(())
}

/// Formulas know no degrees.
fn parameters(spec: &FilmSpec, errors: &mut Diagnostics) {
    for own in &spec.parameters {
        if !number(own).is_finite() {
            let message = format!("`{}` is too large a number", own.name);
            errors.push(own.place.error_here(Code::BAD_VALUE, message));
        }
    }
}

/// A parameter in SI.
pub(super) fn number(own: &super::spec::Parameter) -> f64 {
    let written = own.written.to_f64().unwrap_or(f64::NAN);
    if own.written == crate::rational::Rational::from(0) {
        0.0
    } else {
        Unit::to_si(&own.unit, written)
    }
}

fn linear(spec: &FilmSpec, errors: &mut Diagnostics) {
    let mut graph = spec.graph.clone();
    let zero = graph.integer(0);
    let without: BTreeMap<_, _> = spec.test.map(|test| (test, zero)).into_iter().collect();
    for term in &spec.terms {
        let rest = graph.substitute(term.value, &without);
        let mut fine = normal::equal(&mut graph, rest, zero);
        for test in spec.test {
            let slope = graph.differentiate(term.value, test);
            fine &= slope.is_ok_and(|slope| {
                let rest = graph.substitute(slope, &without);
                normal::equal(&mut graph, slope, rest)
            });
        }
        if !fine {
            let message = format!("the term `{}` is not linear in the test function v", term.name);
            let error = term.formula.text.error_here(Code::FORM, message);
            errors.push(error.help("every product holds `v`, `ddx(v)` or `ddz(v)` once"));
        }
    }
}

/// Every force works on another measure; one on the gap, by which pressure acts.
fn works(spec: &FilmSpec, errors: &mut Diagnostics) {
    for (place, force) in spec.forces.iter().enumerate() {
        let on = force.on.text();
        if !MEASURES.contains(&on) {
            let message = format!("a film's force does not work on `{on}`");
            let error = force.on.error_here(Code::UNKNOWN_NAME, message);
            let help = "it works on `h`, the gap, `s`, the slip of the journal over the bore, or `s_mean`, by which \
                        oil shears both surfaces alike";
            errors.push(error.help(help));
        }
        if spec.forces[..place].iter().any(|before| before.on.text() == on) {
            let message = format!("two forces work on `{on}`");
            errors.push(force.on.error_here(Code::BAD_VALUE, message).help("add them up in one"));
        }
    }
    if !spec.forces.iter().any(|force| force.on.text() == MEASURES[0]) {
        let message = "no force works on the gap `h`";
        let error = Diagnostic::new(&spec.file, Code::MISSING_KEY, None, message);
        errors.push(error.help("write the pressure, such as `Q = { on = \"h\", value = 'p' }`"));
    }
    if spec.edges.is_empty() {
        let message = "no edge is declared, so that no oil can enter or leave";
        errors.push(Diagnostic::new(&spec.file, Code::MISSING_KEY, None, message));
    }
}

/// What a node holds is never less than nothing, grows with the gap, and does not with the second unknown: else neither
/// the balance nor the order of elimination holds.
fn holds(spec: &FilmSpec, errors: &mut Diagnostics) {
    let uniform: Vec<f64> =
        [1e-3, 1e-3, 1.0].into_iter().chain(spec.parameters.iter().map(number)).collect();
    let stored = |p: f64, r: f64, h: f64| {
        spec.at_node([p, r, h], &uniform).last().copied().unwrap_or(f64::NAN)
    };
    let gaps: Vec<f64> = (0..=24).map(|step| 1e-8 * 10f64.powf(f64::from(step) / 4.0)).collect();
    let full = [0.0, 1e3, 1e5, 1e7, 1e8].map(|p| [p, 0.0]);
    let empty = (0..=16).map(|step| [0.0, f64::from(step) / 16.0]);
    let states: Vec<[f64; 2]> = full.into_iter().chain(empty).collect();
    let second = &spec.unknowns[1].name;
    let found = gaps.iter().zip(&gaps[1..]).find_map(|(h, wider)| {
        states.iter().find_map(|[p, r]| {
            let value = stored(*p, *r, *h);
            let what = if !(value >= 0.0) {
                "is less than nothing"
            } else if !(stored(*p, *r, *wider) >= value) {
                "shrinks as the gap grows"
            } else if *p == 0.0 && !(stored(*p, r + 1.0 / 16.0, *h) <= value) {
                "grows with the second unknown"
            } else {
                return None;
            };
            let place = format!("at p = {p} Pa, {second} = {r}, a gap of {h:.3e} m");
            Some(format!("what a node holds {what} {place}"))
        })
    });
    if let Some(message) = found {
        errors.push(spec.stored.0.text.error_here(Code::FILM, message));
    }
}

/// The pressure acts at the journal's centre on the journal, at the bore's on the bore: the moment that is left is that
/// of −h ∂p/∂x, by which its slope shears both surfaces.
fn moments(spec: &FilmSpec, errors: &mut Diagnostics) {
    let mut graph = spec.graph.clone();
    let on = |measure: &str| spec.forces.iter().find(|force| force.on.text() == measure);
    let Some(normal) = on(MEASURES[0]) else { return };
    let pressure = &spec.unknowns[0];
    let slope = graph.scalar(&named("ddx", &pressure.name));
    let Ok(by) = graph.differentiate(normal.value, pressure.symbol) else { return };
    let slope = graph.mul(by, slope);
    let sheared = graph.mul(spec.gap.symbol, slope);
    let wanted = graph.neg(sheared);
    let shown = format!(
        "`-{}*ddx({})` on `{}`, by which the slope of the pressure shears both surfaces",
        spec.gap.name, pressure.name, MEASURES[2]
    );
    let (place, fine) = match on(MEASURES[2]) {
        Some(mean) => (&mean.formula.text, normal::equal(&mut graph, mean.value, wanted)),
        None => (&normal.formula.text, false),
    };
    if !fine {
        let message = "moments on journal and bore do not balance the forces on them";
        errors.push(place.error_here(Code::FILM, message).help(format!("there must be {shown}")));
    }
}
