//! Lines of the table: a clause, a quantity, its value and its limit.

use std::fmt::Write;

use whirl_text::shown;

use crate::analysis::facts::{Facts, truth};
use crate::report::table;

/// What a line comes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pass {
    Yes,
    No,
    /// The screening of level I asks for level II.
    LevelTwo,
    /// There is no limit.
    None,
}

impl Pass {
    pub(super) fn of(passes: bool) -> Pass {
        if passes { Pass::Yes } else { Pass::No }
    }

    fn word(self) -> &'static str {
        match self {
            Pass::Yes => "yes",
            Pass::No => "NO",
            Pass::LevelTwo => "level II",
            Pass::None => "",
        }
    }
}

/// A line.
#[derive(Debug, Clone)]
pub(super) struct Line {
    pub(super) variant: String,
    /// Which unbalance, or nothing.
    pub(super) unbalance: String,
    pub(super) clause: &'static str,
    pub(super) quantity: &'static str,
    pub(super) place: String,
    /// rpm.
    pub(super) speed: Option<f64>,
    pub(super) value: f64,
    pub(super) limit: Option<f64>,
    pub(super) unit: &'static str,
    pub(super) pass: Pass,
}

/// All of them for other programs.
pub(super) fn rows(lines: &[Line]) -> String {
    let mut text =
        String::from("variant,unbalance,clause,quantity,place,speed_rpm,value,limit,unit,pass\n");
    let given = |value: Option<f64>| value.map_or(String::new(), |own| own.to_string());
    for own in lines {
        let Line { variant, unbalance, clause, quantity, place, unit, .. } = own;
        let (speed, limit, pass) = (given(own.speed), given(own.limit), own.pass.word());
        writeln!(
            text,
            "{variant},{unbalance},{clause},{quantity},{place},{speed},{},{limit},{unit},{pass}",
            own.value
        )
        .expect("text can be written");
    }
    text
}

/// Those of a variant for people.
pub(super) fn told(lines: &[&Line]) -> String {
    let head =
        ["unbalance", "clause", "quantity", "at", "speed (rpm)", "value", "limit", "unit", "pass"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    let number = |value: f64| shown(value, 5, 1e-4..1e7);
    for own in lines {
        rows.push(vec![
            own.unbalance.clone(),
            own.clause.to_owned(),
            own.quantity.to_owned(),
            own.place.clone(),
            own.speed.map_or(String::new(), |speed| shown(speed, 6, 1e-3..1e7)),
            number(own.value),
            own.limit.map_or(String::new(), number),
            own.unit.to_owned(),
            own.pass.word().to_owned(),
        ]);
    }
    table(&rows)
}

/// Numbers of a table: names, the quantity of the lines, and with which names of limits; of several lines the one that is worst
/// against its limit or, without limits, the largest.
const NUMBERS: [(&str, &str, Option<&str>); 8] = [
    ("amplification_factor", "amplification factor", None),
    ("separation_margin_percent", "separation margin", Some("separation_margin_required_percent")),
    ("probe_vibration_um_pkpk", "probe vibration A_max", Some("probe_vibration_limit_um_pkpk")),
    ("scale_factor", "scale factor S_cc", None),
    (
        "scaled_response_um_pkpk",
        "scaled response at clearance",
        Some("scaled_response_limit_um_pkpk"),
    ),
    ("level_1_log_decrement", "level I log decrement at Q_A", None),
    ("level_1_stiffness_ratio", "level I Q_0/Q_A (10 for all above)", None),
    ("level_2_log_decrement", "level II log decrement", None),
];

/// What the lines come to in numbers.
pub(super) fn facts(lines: &[&Line]) -> Facts {
    let mut facts = Facts::default();
    let count = |pass: Pass| lines.iter().filter(|own| own.pass == pass).count();
    facts.put("pass", truth(count(Pass::No) == 0));
    facts.put("lines_failed", count(Pass::No) as f64);
    facts.put("lines_for_level_2", count(Pass::LevelTwo) as f64);
    for (name, quantity, limit) in NUMBERS {
        let own = lines.iter().filter(|own| own.quantity == quantity);
        // How much is left: margins are to be above their limits, all else below.
        let room = |own: &Line| match own.limit {
            Some(required) if quantity == "separation margin" => own.value - required,
            Some(allowed) if limit.is_some() => allowed / own.value,
            _ => -own.value,
        };
        let worst = own.min_by(|a, b| room(a).total_cmp(&room(b)));
        facts.put(name, worst.map(|own| own.value));
        if let Some(limit) = limit {
            facts.put(limit, worst.and_then(|own| own.limit));
        }
    }
    facts
}

/// Lines that fail of which the verdict tells.
const MOST_FAILED: usize = 8;

/// A line that fails, for people.
fn failed(own: &Line) -> String {
    let number = |value: f64| shown(value, 5, 1e-4..1e7);
    let unit = if own.unit == "1" { String::new() } else { format!(" {}", own.unit) };
    let limit = own.limit.map_or(String::new(), |limit| format!(", limit {}{unit}", number(limit)));
    let at = if own.place.is_empty() { String::new() } else { format!(" at {}", own.place) };
    let speed =
        own.speed.map_or(String::new(), |speed| format!(", {} rpm", shown(speed, 6, 1e-3..1e7)));
    let of = [own.variant.as_str(), own.unbalance.as_str()];
    let of: Vec<&str> = of.into_iter().filter(|own| !own.is_empty()).collect();
    format!(
        "  {} {}{at}: {}{unit}{limit}{speed} ({})\n",
        own.clause,
        own.quantity,
        number(own.value),
        of.join(", ")
    )
}

/// What all lines come to.
pub(super) fn verdict(lines: &[Line]) -> String {
    let count = |pass: Pass| lines.iter().filter(|own| own.pass == pass).count();
    let judged = lines.len() - count(Pass::None);
    let of_level_two = match count(Pass::LevelTwo) {
        0 => String::new(),
        some => format!("; {some} of level I ask for level II"),
    };
    match count(Pass::No) {
        0 => format!("PASSES: all {judged} lines that have a limit{of_level_two}\n"),
        some => {
            let mut text = format!(
                "DOES NOT PASS: {some} of {judged} lines that have a limit{of_level_two}\n"
            );
            for own in lines.iter().filter(|own| own.pass == Pass::No).take(MOST_FAILED) {
                text += &failed(own);
            }
            if some > MOST_FAILED {
                text += &format!("  and {} more\n", some - MOST_FAILED);
            }
            text
        }
    }
}
