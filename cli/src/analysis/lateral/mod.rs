//! The lateral analysis of API 617 and API RP 684: one table with what passes and what does not.
//!
//! A case with each variant of its keys → the machine with stations along the body ([`Model`]) → unbalance at antinodes
//! ([`placement`]) → response of probes and at close clearances ([`response`]) → stability of both levels ([`stability`]) →
//! lines ([`lines`]), by the formulas of [`standard`].

mod done;
mod figure;
mod lines;
mod model;
mod placement;
mod response;
mod stability;
mod standard;

use std::fmt::Write;

use whirl_codegen::diagnostic::Located;
use whirl_solver::cache::Cache;
use whirl_text::shown;

use self::done::{AS_IT_IS, Done};
use self::lines::Line;
use self::model::Model;
use self::placement::Unbalance;
use self::response::{Close, Probe};
use super::found::{Found, drawn};
use super::speeds::{FINE, Wanted};
use super::words;
use crate::case::{Analysis, Case, CaseText, Lateral, StageSource, Variant};
use crate::errors::Failure;
use crate::machine;
use crate::report::table;
use crate::signals::Interruption;
use crate::values::level::as_toml;

/// How far speeds reach, of the trip speed, where the case does not say it.
const BEYOND: f64 = 1.25;
/// How far they reach at least, of N_ma and of N_mc: margins of 16 % below and 26 % above may be asked for.
const BELOW: f64 = 0.8;
const ABOVE: f64 = 1.3;

/// The table of all variants; without the text of the case that of the case as it is.
pub(super) fn found(
    (case, text): (&Case, Option<&CaseText>),
    analysis: &Analysis,
    (cache, warnings): (Option<&Cache>, &mut Vec<String>),
    interruption: &Interruption,
    figures: bool,
) -> Result<Found, Failure> {
    let lateral = analysis.lateral.as_deref().expect("a lateral analysis");
    let mut all: Vec<Done> = Vec::new();
    let mut interrupted = false;
    let variants =
        text.iter().flat_map(|text| lateral.variants.iter().map(move |own| (*text, own)));
    for variant in std::iter::once(None).chain(variants.map(Some)) {
        let own = variant.map(|(text, own)| varied(text, own, warnings)).transpose()?;
        let name = variant.map_or(AS_IT_IS, |(_, own)| own.name.as_str());
        let done = of_variant(
            name,
            own.as_ref().unwrap_or(case),
            (analysis, lateral),
            (cache, warnings),
            interruption,
        )?;
        interrupted |= done.responses.interrupted;
        all.push(done);
        if interrupted {
            break;
        }
    }
    let mut whole: Vec<Line> = Vec::new();
    for done in &all {
        let stability = done.stability.iter().flat_map(|own| &own.lines);
        for line in done.responses.lines.iter().chain(stability) {
            whole.push(Line { variant: done.name.clone(), ..line.clone() });
        }
    }
    let name = &analysis.name;
    let mut files = vec![
        (format!("{name}.csv"), lines::rows(&whole).into_bytes()),
        (format!("{name}.unbalance.csv"), unbalance_rows(&all).into_bytes()),
        (format!("{name}.response.csv"), response_rows(&all).into_bytes()),
    ];
    if all.iter().any(|own| own.stability.as_ref().is_some_and(|own| !own.curve.is_empty())) {
        files.push((format!("{name}.stability.csv"), stability_rows(&all).into_bytes()));
    }
    if figures && !interrupted {
        files.extend(drawn(name, &figure::figure(case, lateral, &all)));
    }
    let mut text = format!("{}: {}\n", case.name, case.title);
    let edition = lateral.edition;
    let [low, high, trip] = [lateral.minimum, lateral.maximum, lateral.trip].map(words::speed);
    let _ = writeln!(
        text,
        "API 617, edition {edition}: N_ma {low} rpm, N_mc {high} rpm, trip {trip} rpm"
    );
    text += &given(lateral);
    for done in &all {
        let _ = writeln!(text, "\n{}\n", heading(done, lateral));
        text += &told_unbalance(&done.unbalance);
        text.push('\n');
        let own: Vec<&Line> = whole.iter().filter(|own| own.variant == done.name).collect();
        text += &lines::told(&own);
        text += &done.responses.notes;
        text += &done.notes;
    }
    text.push('\n');
    text += &lines::verdict(&whole);
    let given: Vec<&Line> = whole.iter().filter(|own| own.variant == AS_IT_IS).collect();
    let mut facts = lines::facts(&given);
    for done in &all {
        facts.lines(&(done.responses.notes.clone() + &done.notes));
    }
    Ok(Found { text, files, interrupted, facts })
}

/// What keeps a lateral analysis from being done that the case alone shows.
///
/// # Errors
/// Nothing turns, or no joint carries the body.
pub(super) fn foreseen(
    case: &Case,
    analysis: &Analysis,
    cache: Option<&Cache>,
) -> Result<(), Failure> {
    model::foreseen(case, analysis)?;
    let Some(lateral) = analysis.lateral.as_deref() else { return Ok(()) };
    let model = Model::new(case, (analysis, lateral), false, (cache, &mut Vec::new()))?;
    probes(&model, lateral)?;
    closes(&model, lateral).map(|_| ())
}

/// The case with other values of some keys.
fn varied(text: &CaseText, variant: &Variant, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    let values = variant.set.iter().filter_map(|own| own.text().split_once('='));
    let values = values.map(|(key, value)| (key.trim(), as_toml(value.trim())));
    let place = format!("variant {}", variant.name);
    let text = text.with_more_values(values).with_values_of(&place);
    machine::read_text(&text, warnings)
}

fn of_variant(
    name: &str,
    case: &Case,
    (analysis, lateral): (&Analysis, &Lateral),
    (cache, warnings): (Option<&Cache>, &mut Vec<String>),
    interruption: &Interruption,
) -> Result<Done, Failure> {
    let model = Model::new(case, (analysis, lateral), false, (cache, warnings))?;
    let against = |own: &&f64| **own * model.sense < 0.0;
    if let Some(speed) = analysis.speeds.iter().find(against) {
        return Err(Failure::Argument {
            message: format!(
                "`speeds` of `{}` go down to {} rpm, and `{}` of the case turns the other way round",
                analysis.name,
                words::speed(*speed),
                case.machine.bodies[model.of].name.text()
            ),
            help: "give speeds in the sense of the `speed` of the body; N_ma and N_mc have that sense, too".to_owned(),
        });
    }
    let probes = probes(&model, lateral)?;
    let closes = closes(&model, lateral)?;
    let (unbalance, of_modes) = placement::placed(&model, analysis, lateral)?;
    let mut notes = model.notes.clone() + &of_modes;
    let mut speeds: Vec<f64> = match analysis.speeds.as_slice() {
        [] => (0..FINE).map(|k| BEYOND * lateral.trip * k as f64 / (FINE - 1) as f64).collect(),
        own => own.iter().map(|own| own.abs()).collect(),
    };
    // Critical speeds are looked for as far as margins may be asked for, and some way further for their widths.
    let reach = [BELOW * lateral.minimum, ABOVE * lateral.maximum];
    speeds.extend(reach.into_iter().chain([lateral.minimum, lateral.maximum, lateral.trip]));
    speeds.sort_by(f64::total_cmp);
    speeds.dedup_by(|a, b| (*a - *b).abs() <= 1e-12 * b.abs());
    // From y to x they are negative, as the speed of the case.
    let wanted =
        Wanted { of: Some(model.of), speeds: speeds.iter().map(|own| model.sense * own).collect() };
    let of = (analysis, lateral);
    let responses =
        response::found(&model, of, (&probes, &closes), &unbalance, &wanted, interruption)?;
    let stability = match responses.interrupted {
        true => None,
        false if lateral.seals.is_empty() => Some(stability::found(&model, &model, of)?),
        false => {
            let bare = Model::new(case, of, true, (cache, warnings))?;
            Some(stability::found(&model, &bare, of)?)
        }
    };
    if let Some(own) = &stability {
        notes += &own.notes;
    }
    if closes.is_empty() {
        notes += "note: no `clearances`, and no bearing with one: nothing is held against 75 % of a clearance\n";
    }
    let name = name.to_owned();
    Ok(Done { name, model, unbalance, probes, closes, responses, stability, notes })
}

/// Two probes at each of their points.
fn probes(model: &Model, lateral: &Lateral) -> Result<Vec<Probe>, Failure> {
    let journal =
        |name: &Located| Located::new(name.source(), name.span(), format!("joint.{}", name.text()));
    let names: Vec<Located> = match lateral.probes.as_slice() {
        [] => model.journals.iter().map(|own| journal(&own.name)).collect(),
        own => own.to_vec(),
    };
    let mut all = Vec::new();
    for name in &names {
        let point = model.point(name)?;
        for angle in [lateral.probe_angle, lateral.probe_angle + std::f64::consts::FRAC_PI_2] {
            let degrees = whirl_text::rounded(angle.to_degrees(), 4);
            all.push(Probe {
                name: format!("{} {degrees} deg", point.name),
                point: point.clone(),
                angle,
            });
        }
    }
    Ok(all)
}

/// Points with a clearance: of bearings that have one, and those that the case names.
fn closes(model: &Model, lateral: &Lateral) -> Result<Vec<Close>, Failure> {
    let mut all = Vec::new();
    for (name, clearance) in &model.clearances {
        let told = lateral.clearances.iter().any(|own| own.0.text() == name);
        let point = model.points.iter().find(|own| own.name == *name);
        if let (Some(point), false) = (point, told) {
            all.push(Close { point: point.clone(), clearance: *clearance });
        }
    }
    for (name, clearance) in &lateral.clearances {
        all.push(Close { point: model.point(name)?, clearance: *clearance });
    }
    Ok(all)
}

/// What the case gives beside the speeds, a line each.
fn given(lateral: &Lateral) -> String {
    let mut text = String::new();
    let number = |value: f64| shown(value, 5, 1e-4..1e7);
    let mut line = |words: String| {
        let _ = writeln!(text, "given: {words}");
    };
    for (name, clearance) in &lateral.clearances {
        line(format!("diametral clearance at {} {} um", name.text(), number(1e6 * clearance)));
    }
    for own in &lateral.stages {
        let millimetres = |value: f64| format!("{} mm", number(1e3 * value));
        let words = match own.source {
            StageSource::Given(q) => format!("q {} N/m", number(q)),
            StageSource::Impeller { power, diameter, width, density_ratio } => format!(
                "impeller, {} kW, diameter {}, width {}, density ratio {}",
                number(1e-3 * power),
                millimetres(diameter),
                millimetres(width),
                number(density_ratio)
            ),
            StageSource::Blades { power, diameter, height } => format!(
                "blades, {} kW, pitch diameter {}, height {}",
                number(1e-3 * power),
                millimetres(diameter),
                millimetres(height)
            ),
        };
        let at = own.z.map_or(String::new(), |z| format!(" at z = {}", millimetres(z)));
        line(format!("stage {}{at}: {words}", own.name));
    }
    if let Some(density) = lateral.gas_density {
        line(format!("average density of the gas {} kg/m^3", number(density)));
    }
    for own in &lateral.variants {
        let set: Vec<&str> = own.set.iter().map(Located::text).collect();
        line(format!("variant {}: {}", own.name, set.join(", ")));
    }
    text
}

fn heading(done: &Done, lateral: &Lateral) -> String {
    let loads = done
        .model
        .journals
        .iter()
        .map(|own| format!("{} {} kg", own.name.text(), shown(own.load, 5, 1e-4..1e7)));
    let loads = loads.collect::<Vec<_>>().join(", ");
    match lateral.variants.is_empty() {
        true => format!("static loads: {loads}"),
        false => format!("variant {}; static loads: {loads}", done.name),
    }
}

fn told_unbalance(all: &[Unbalance]) -> String {
    let head = ["unbalance", "z (mm)", "W (kg)", "U_a (g mm)", "phase (deg)"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    let number = |value: f64| shown(value, 5, 1e-4..1e7);
    for own in all {
        for plane in &own.planes {
            let values = [1e3 * plane.z, plane.load, 1e6 * plane.moment, plane.phase.to_degrees()];
            rows.push(std::iter::once(own.name.clone()).chain(values.map(number)).collect());
        }
    }
    table(&rows)
}

fn unbalance_rows(all: &[Done]) -> String {
    let mut text = String::from("variant,unbalance,z_mm,load_kg,unbalance_g_mm,phase_deg\n");
    for done in all {
        for own in &done.unbalance {
            for plane in &own.planes {
                let values =
                    [1e3 * plane.z, plane.load, 1e6 * plane.moment, plane.phase.to_degrees()];
                let values = values.map(|own| own.to_string()).join(",");
                let _ = writeln!(text, "{},{},{values}", done.name, own.name);
            }
        }
    }
    text
}

fn response_rows(all: &[Done]) -> String {
    let mut text = String::from(
        "variant,unbalance,speed_rpm,place,unscaled_um_pkpk,scaled_um_pkpk,phase_deg\n",
    );
    for done in all {
        for own in &done.responses.all {
            let of_speed =
                |place: usize| [&own.readings[place], &own.phases[place], &own.orbits[place]];
            let speeds = done.responses.speeds.iter().enumerate();
            let mut all: Vec<(f64, [&Vec<f64>; 3])> =
                speeds.map(|(place, speed)| (*speed, of_speed(place))).collect();
            all.extend(own.between.iter().map(|(speed, own)| (*speed, own.each_ref())));
            all.sort_by(|a, b| a.0.total_cmp(&b.0));
            for (speed, [readings, phases, orbits]) in all {
                let mut row = |name: &str, value: f64, phase: &str| {
                    let (rpm, scaled) = (words::rpm(speed), own.scale * value);
                    let lead = format!("{},{},{rpm},{name}", done.name, own.name);
                    let _ = writeln!(text, "{lead},{value},{scaled},{phase}");
                };
                for (probe, (value, phase)) in done.probes.iter().zip(readings.iter().zip(phases)) {
                    // What does not move has no phase.
                    let phase = if *value > 0.0 { phase.to_string() } else { String::new() };
                    row(&probe.name, *value, &phase);
                }
                for (close, value) in done.closes.iter().zip(orbits) {
                    row(&close.point.name, *value, "");
                }
            }
        }
    }
    text
}

fn stability_rows(all: &[Done]) -> String {
    let mut text = String::from("variant,cross_coupling_N_m,log_decrement\n");
    for done in all {
        for (q, decrement) in done.stability.iter().flat_map(|own| &own.curve) {
            let _ = writeln!(text, "{},{q},{decrement}", done.name);
        }
    }
    text
}
