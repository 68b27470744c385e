//! The files of periodic motions: rows over the cycle, multipliers, numbers of all.

use std::fmt::Write;

use serde_json::{Map, Value, json};
use whirl_solver::periodic::{MultiplierKind, StepError};

use super::motions::{Motion, Motions, is_summed_up, range};
use super::text::{leading, method, stability};
use crate::analysis::words;

/// All files.
pub(super) fn written(name: &str, motions: &Motions) -> Vec<(String, Vec<u8>)> {
    vec![
        (format!("{name}.csv"), rows(&motions.all).into_bytes()),
        (format!("{name}.multipliers.csv"), multipliers(&motions.all).into_bytes()),
        (format!("{name}.json"), summary(motions).into_bytes()),
    ]
}

/// Speed of a motion (rpm), as a cell.
fn rpm(motion: &Motion) -> String {
    motion.speed.map_or(String::new(), |speed| words::rpm(speed).to_string())
}

/// The cycle of every motion, the columns of a history behind the speed.
fn rows(all: &[Motion]) -> String {
    let mut text = format!("speed_rpm,{}\n", all[0].columns.join(","));
    for motion in all {
        let speed = rpm(motion);
        let history = &motion.periodic.history;
        for row in 0..history.rows() {
            text.push_str(&speed);
            for value in history.values(row) {
                write!(text, ",{value}").expect("text can be written");
            }
            text.push('\n');
        }
    }
    text
}

fn multipliers(all: &[Motion]) -> String {
    let mut text =
        String::from("speed_rpm,number,real,imaginary,modulus,modulus_of_half_steps,of\n");
    for motion in all {
        for (place, own) in motion.periodic.multipliers.iter().enumerate() {
            let finer = own.finer.map_or(String::new(), |finer| finer.norm().to_string());
            let of = match own.kind {
                MultiplierKind::Motion => "motion",
                MultiplierKind::Phase => "phase",
                MultiplierKind::Unresolved => "unresolved",
            };
            let (re, im, size) = (own.value.re, own.value.im, own.value.norm());
            writeln!(text, "{},{},{re},{im},{size},{finer},{of}", rpm(motion), place + 1)
                .expect("text can be written");
        }
    }
    text
}

fn error(own: &StepError) -> Value {
    json!({ "force": own.force, "displacement": own.displacement, "state": own.state })
}

fn summary(motions: &Motions) -> String {
    let all = motions.all.iter().map(|motion| {
        let Motion { periodic, columns, verdict, repeating, .. } = motion;
        let ranges = columns.iter().enumerate().filter(|own| is_summed_up(own.1)).map(|own| {
            let [least, most] = range(&periodic.history, own.0);
            (own.1.clone(), json!({ "min": least, "max": most }))
        });
        json!({
            "speed_rpm": motion.speed.map(words::rpm),
            "period_s": periodic.cycle.period,
            "begins_at_s": periodic.cycle.start,
            "steps": periodic.cycle.steps,
            "time_step_s": periodic.cycle.time_step(),
            "repeating": repeating.iter().map(|own| json!({ "what": own.what, "frequency_hz": own.hertz })).collect::<Vec<_>>(),
            "method": method(periodic.method),
            "cycles": periodic.cycles,
            "miss": periodic.miss,
            "stability": stability(periodic.stability),
            "largest_multiplier": leading(periodic).map(|own| own.value.norm()),
            "unresolved_multipliers": periodic.multipliers.iter().filter(|own| own.kind == MultiplierKind::Unresolved).count(),
            "half_steps_change": periodic.step_error.map(|own| error(&own)),
            "harmonics": periodic.harmonics.map(|own| json!({
                "count": own.count,
                "instants": own.instants,
                "corrections": own.corrections,
                "twice_as_many_change": own.change.map(|own| error(&own)),
                "march_differs": error(&own.steps),
            })),
            "steps_of_shortest_contact": periodic.contact_steps,
            "verdict": verdict,
            "columns": Value::Object(ranges.collect::<Map<String, Value>>()),
        })
    });
    let lost = motions
        .lost
        .iter()
        .map(|(speed, reason)| json!({ "speed_rpm": speed.map(words::rpm), "reason": reason }));
    let whole = json!({
        "case": motions.case.name,
        "analysis": motions.analysis.name,
        "motions": all.collect::<Vec<_>>(),
        "not_found": lost.collect::<Vec<_>>(),
        "notes": super::text::notes(motions),
    });
    let mut text = serde_json::to_string_pretty(&whole).expect("keys are strings");
    text.push('\n');
    text
}
