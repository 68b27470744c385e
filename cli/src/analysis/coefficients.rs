//! Stiffness and damping of joints over speed.

use std::fmt::Write;

use whirl_solver::linear::{JointCoefficients, LinearMachine, Standstill};
use whirl_text::{rounded, shown};

use super::facts::{COEFFICIENTS, Facts};
use super::found::{Found, drawn};
use super::speeds::Wanted;
use super::states::{Ended, at_each_speed};
use super::through::Felt;
use super::words;
use crate::case::{Analysis, Case};
use crate::errors::Failure;
use crate::figures::{Figure, Line, Panel, Style};
use crate::report::table;
use crate::signals::Interruption;

/// Share of the largest that is rounding, and a displacement (m) by which forces of joints are nothing.
const ROUNDING: f64 = 1e-9;
const LENGTH: f64 = 1e-6;
/// Columns that the `table` of a bushing reads.
const OF_BUSHING: &str = "speed [rpm],k_xx [N/m],k_xy [N/m],k_yx [N/m],k_yy [N/m],c_xx [N*s/m],c_xy [N*s/m],c_yx [N*s/m],c_yy [N*s/m]\n";

/// Those of every joint at every speed: all in one file, and for each joint one that a bushing reads.
pub(super) fn found(
    case: &Case,
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    interruption: &Interruption,
    figures: bool,
) -> Result<Found, Failure> {
    let mut all = format!(
        "speed_rpm,joint,eccentricity_ratio,attitude_deg,e_x_um,e_y_um,force_x_N,force_y_N,{}\n",
        COEFFICIENTS.join(",")
    );
    let mut single: Vec<(String, String)> = Vec::new();
    let mut whole = String::new();
    let mut facts = Facts::default();
    let mut drawing: Vec<(String, Vec<(f64, [f64; 8])>)> = Vec::new();
    let head = ["joint", "speed (rpm)", "e/c", "attitude (°)", "F_x (N)", "F_y"];
    let mut rows = vec![head.iter().chain(&words::OF_PLANE).map(|own| (*own).to_owned()).collect()];
    let mut varying: Vec<(String, String, f64)> = Vec::new();
    let mut felt = Felt::new(wanted.of, analysis);
    let mut work = |speed: f64, at: &Standstill| -> Result<(), Failure> {
        facts.numbers.clear();
        felt.add(linear, speed, at)?;
        for (order, own) in felt.last() {
            facts.bearing(*order, own);
        }
        for own in linear.varying_joints(at) {
            match varying.iter_mut().find(|known| known.0 == own.0) {
                Some(known) => known.2 = known.2.max(own.2),
                None => varying.push(own),
            }
        }
        for own in linear.coefficients_at(at, speed)? {
            let label = own.label.trim_start_matches('_').to_owned();
            let values = values(&own);
            facts.joint(&label, &own, values);
            let numbers = values.map(|value| value.to_string()).join(",");
            match drawing.iter_mut().find(|(name, _)| *name == label) {
                Some((_, all)) => all.push((words::rpm(speed), values)),
                None => drawing.push((label.clone(), vec![(words::rpm(speed), values)])),
            }
            let ratio = own.eccentricity.map_or(String::new(), |own| own.to_string());
            let attitude = own.attitude.map_or(String::new(), |own| own.to_degrees().to_string());
            let [x, y] = own.displacement.map(|own| 1e6 * own);
            let rpm = words::rpm(speed);
            let [f_x, f_y] = own.force;
            writeln!(all, "{rpm},{label},{ratio},{attitude},{x},{y},{f_x},{f_y},{numbers}")
                .expect("text can be written");
            if let Some(matrices) = &own.whole {
                if whole.is_empty() {
                    whole = format!("speed_rpm,joint,{}\n", whole_columns().join(","));
                }
                let values = matrices.iter().flatten().flatten();
                let numbers = values.map(f64::to_string).collect::<Vec<_>>().join(",");
                writeln!(whole, "{rpm},{label},{numbers}").expect("text can be written");
            }
            let mut cells = vec![
                words::joint(&label),
                words::speed(speed),
                own.eccentricity.map_or("-".to_owned(), |own| format!("{own:.4}")),
                own.attitude.map_or("-".to_owned(), |own| format!("{:.2}", own.to_degrees())),
            ];
            // What is nothing beside the largest of its kind is rounding.
            let clean =
                |value: f64, most: f64| if value.abs() > ROUNDING * most { value } else { 0.0 };
            let most = |all: &[f64]| all.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
            let [k, c] = [most(&values[..4]), most(&values[4..])];
            cells.extend(own.force.map(|value| shown(clean(value, k * LENGTH), 5, 1e-3..1e6)));
            let cleaned = values.iter().enumerate().map(|(place, &value)| {
                // Damping may be rounding of the stiffness.
                clean(value, if place < 4 { k } else { c.max(ROUNDING * k) })
            });
            cells.extend(cleaned.map(|value| match value {
                0.0 => "0".to_owned(),
                value => format!("{value:.4e}"),
            }));
            rows.push(cells);
            if !single.iter().any(|(name, _)| *name == label) {
                single.push((label.clone(), OF_BUSHING.to_owned()));
            }
            let file = single.iter_mut().find(|(name, _)| *name == label);
            let (_, file) = file.expect("it was added");
            writeln!(file, "{rpm},{numbers}").expect("text can be written");
        }
        Ok(())
    };
    let Ended { mut notes, interrupted } =
        at_each_speed(linear, (analysis, wanted), interruption, &mut work)?;
    for (joint, body, share) in &varying {
        let _ = writeln!(
            notes,
            "note: stiffness and damping of {joint} vary by {} % with the angle of {body}: the table holds where that is 0",
            rounded(100.0 * share, 2)
        );
    }
    let name = &analysis.name;
    let mut files = vec![(format!("{name}.csv"), all.into_bytes())];
    let alone =
        |(label, text): (String, String)| (format!("{name}.{label}.csv"), text.into_bytes());
    files.extend(single.into_iter().map(alone));
    // One speed is no curve.
    drawing.retain(|(_, all)| all.len() > 1);
    if let (true, false, Some(of)) = (figures, drawing.is_empty(), wanted.of) {
        let body = linear.machine().bodies[of].name();
        files.extend(drawn(name, &figure(case, body, &drawing)));
    }
    let mut text = format!("{}: {}\n\n{}", case.name, case.title, table(&rows));
    if let Some((words, file)) = felt.told() {
        text.push_str(&words);
        files.push((format!("{name}.through.csv"), file.into_bytes()));
    }
    text.push_str(&notes);
    let sensed = words::stateful(linear) + &words::sensed(case);
    text.push_str(&words::at_the_speed(linear));
    text.push_str(&sensed);
    if !whole.is_empty() {
        let file = format!("{name}.5x5.csv");
        writeln!(text, "\nMoments, forces along z and what tilts do beside this: {file}")
            .expect("text can be written");
        files.push((file, whole.into_bytes()));
    }
    facts.lines(&(words::at_the_speed(linear) + &sensed + &notes));
    Ok(Found { text, files, interrupted, facts })
}

fn values(own: &JointCoefficients) -> [f64; 8] {
    let [k, c] = [own.stiffness, own.damping];
    [k[0][0], k[0][1], k[1][0], k[1][1], c[0][0], c[0][1], c[1][0], c[1][1]]
}

/// Stiffness beside damping over speed, a row of panels for each joint.
fn figure(case: &Case, body: &str, all: &[(String, Vec<(f64, [f64; 8])>)]) -> Figure {
    let styles = [Style::First, Style::Second, Style::Third, Style::Fourth];
    let mut panels = Vec::new();
    for (label, values) in all {
        for (first, quantity, letter, unit) in
            [(0, "stiffness", "K", "N/m"), (4, "damping", "C", "N s/m")]
        {
            let lines = ["xx", "xy", "yx", "yy"].into_iter().zip(styles).enumerate();
            let own = values.iter().flat_map(|(_, own)| &own[first..first + 4]);
            let power = power(own.fold(0.0, |most: f64, own| most.max(own.abs())));
            let unit = if power == 0 { unit.to_owned() } else { format!("1e{power} {unit}") };
            let scale = 10.0_f64.powi(-power);
            let lines = lines.map(|(place, (axes, style))| Line {
                points: (values.iter())
                    .map(|(speed, own)| (*speed, scale * own[first + place]))
                    .collect(),
                style,
                name: axes.to_owned(),
            });
            panels.push(Panel {
                title: format!("{}: {quantity}", words::joint(label)),
                x: format!("speed of {body} (rpm)"),
                y: format!("{letter} ({unit})"),
                lines: lines.collect(),
                ..Panel::default()
            });
        }
    }
    Figure { title: format!("{}: {}", case.name, case.title), panels, columns: 2 }
}

/// The power of ten, a multiple of three, in which a number has one to three digits before its point.
fn power(most: f64) -> i32 {
    if most > 0.0 && most.is_finite() { 3 * (most.log10() / 3.0).floor() as i32 } else { 0 }
}

/// Columns of K and C of a law of the whole joint, called as the parameters of `linear-5x5` are.
fn whole_columns() -> Vec<String> {
    let motions = [("x", "m"), ("y", "m"), ("z", "m"), ("ax", "rad"), ("ay", "rad")];
    let column = |letter: &str, time: &str, row: &str, (column, unit): (&str, &str)| {
        let force = if row.starts_with('a') { "Nm" } else { "N" };
        format!("{letter}_{row}_{column}_{force}{time}_{unit}")
    };
    let all = [("k", ""), ("c", "s")].into_iter().flat_map(|(letter, time)| {
        motions.into_iter().flat_map(move |(row, _)| {
            motions.into_iter().map(move |own| column(letter, time, row, own))
        })
    });
    all.collect()
}
