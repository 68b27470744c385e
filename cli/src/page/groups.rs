//! Which columns of a history are drawn together, and what their charts are called.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use whirl_solver::history::Column;

use crate::case::{Case, JointKind, SupportName};
use crate::machine::Built;
use crate::report::{angle, films, oscillations, shown_unit};

/// Supports and outputs whose charts are shown unasked.
const MOST_SHOWN: usize = 6;

/// A chart over time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Group {
    pub(super) title: String,
    /// What its axis is called.
    pub(super) quantity: String,
    /// Unit of the axis, and by what the numbers of the columns are to be multiplied for it.
    pub(super) unit: String,
    pub(super) factor: f64,
    /// Columns, and what they are called.
    pub(super) lines: Vec<(String, String)>,
    /// Whether it is shown unasked.
    pub(super) shown: bool,
    /// The column of the angle over which it is shown, too.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) angle: Option<String>,
}

/// What a joint moves, as its chart calls it: only bearings and stops have journals.
pub(super) fn moved(case: &Case, joint: usize) -> &str {
    let own = &case.machine.joints[joint];
    match (own.kind, own.sides[0].body) {
        _ if case.machine.is_mass() => "the mass",
        (JointKind::Bushing | JointKind::Coupling | JointKind::Gear, Some(body)) => {
            case.machine.bodies[body].name.text()
        }
        _ => "the journal",
    }
}

/// The charts of a run, which have each column but the time once.
pub(super) fn groups(case: &Case, built: &Built, columns: &[Column]) -> Vec<Group> {
    let mut all = Charts { columns, taken: BTreeSet::new(), angle: None, groups: Vec::new() };
    let (mass, supports) = (case.machine.is_mass(), case.supports());
    let named = case.turning();
    let body = |name: &str| match name {
        "" => named.first().map_or("shaft", String::as_str).to_owned(),
        other => other.trim_start_matches('_').to_owned(),
    };
    let of = |ending: &str, start: &str| -> Vec<(String, String)> {
        let middle = |name: &str| {
            let rest = name.strip_prefix(start)?.strip_suffix(ending)?;
            Some((name.to_owned(), body(rest)))
        };
        columns.iter().filter_map(|own| middle(&own.name)).collect()
    };
    let to_rpm = 60.0 / std::f64::consts::TAU;
    let turning = of("_rad_s", "omega");
    all.add(("Speed of rotation", "speed", "rpm", to_rpm), turning, !mass);
    for (place, own) in supports.iter().enumerate() {
        let kind = case.machine.joints[place].kind;
        let moved = moved(case, place);
        // What stands still in its plane has nothing to show there.
        let plane = !matches!(kind, JointKind::Coupling);
        let shown = plane && place < MOST_SHOWN;
        let has_clearance = built.clearances[place] > 0.0 && !mass;
        let pair = |quantity: &str, unit: &str, names: [&str; 2]| -> Vec<(String, String)> {
            let axes = ["X", "Y"].into_iter().zip(names);
            axes.map(|(axis, name)| {
                (own.column(&format!("{quantity}{axis}"), unit), name.to_owned())
            })
            .collect()
        };
        let title = |what: &str| format!("{}: {what}", own.title);
        let axes = ["x, vertical", "y, lateral"];
        // Only journals have bores.
        let (called, quantity) = match moved {
            "the journal" => ("eccentricity of the journal in its bore", "eccentricity"),
            "the mass" => ("displacement of the mass in the stop", "displacement"),
            _ => ("displacement of its first side against the second", "displacement"),
        };
        let eccentricity = pair("E", "um", axes);
        let shown_so = shown && has_clearance;
        all.add((&title(called), quantity, "µm", 1.0), eccentricity, shown_so);
        let forces = pair("R", "N", axes).into_iter().chain([along(own)]).collect();
        let journal = case.machine.joints[place].sides[0].body.unwrap_or(0);
        all.angle = angle(case, &built.machine, journal).filter(|_| plane && !mass);
        all.add((&title(&format!("force on {moved}")), "force", "N", 1.0), forces, shown);
        all.angle = None;
        let moves = pair("", "um", axes);
        // Masses fly far.
        let (unit, factor) = if mass { ("mm", 1e-3) } else { ("µm", 1.0) };
        let called = title(&format!("displacement of {moved}"));
        let shown = shown && !has_clearance && (!mass || place == 0);
        all.add((&called, "displacement", unit, factor), moves, shown);
        let couples = ["MX", "MY", "MZ"].map(|letter| {
            (own.column(letter, "Nm"), format!("about {}", letter[1..].to_lowercase()))
        });
        let title = title(&format!("moment on {moved}"));
        all.add((&title, "moment", "N·m", 1.0), couples.to_vec(), kind == JointKind::Coupling);
    }
    for (place, own) in oscillations(case, &built.machine).iter().enumerate() {
        let lines = own.columns.iter().map(|(column, axis)| (column.clone(), axis.to_lowercase()));
        let title = format!("{}: {}", own.title, own.quantity);
        all.add((&title, own.quantity, &own.unit, 1.0), lines.collect(), place < 2 * MOST_SHOWN);
    }
    for own in films(case, &built.machine) {
        let shown = own.angle.is_some();
        all.angle = own.angle;
        all.add((&own.title, own.quantity, own.unit, 1.0), own.lines, shown);
    }
    all.angle = None;
    all.add(("Couples of prescribed rotations", "couple", "N·m", 1.0), of("_Nm", "M_"), true);
    for own in columns.iter().filter(|own| own.unit == "J" || own.unit == "W") {
        let quantity = if own.unit == "J" { "energy" } else { "power" };
        let lines = vec![(own.name.clone(), quantity.to_owned())];
        all.add((&capital(&own.meaning), quantity, &own.unit, 1.0), lines, true);
    }
    let turns = 1.0 / std::f64::consts::TAU;
    all.add(("Angle of rotation", "revolutions", "1", turns), of("_rad", "theta"), false);
    for own in columns.iter().skip(1) {
        let lines = vec![(own.name.clone(), own.meaning.clone())];
        let (title, unit) = (capital(&own.meaning), shown_unit(&own.unit));
        all.add((&title, &own.meaning, unit, 1.0), lines, false);
    }
    all.groups
}

fn along(own: &SupportName) -> (String, String) {
    (own.column("RZ", "N"), "z, axial".to_owned())
}

fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

struct Charts<'a> {
    columns: &'a [Column],
    taken: BTreeSet<String>,
    /// Of the charts that are added.
    angle: Option<String>,
    groups: Vec<Group>,
}

impl Charts<'_> {
    /// Adds a chart of those columns that there are and that no other one has.
    fn add(
        &mut self,
        (title, quantity, unit, factor): (&str, &str, &str, f64),
        lines: Vec<(String, String)>,
        shown: bool,
    ) {
        let there = |name: &String| self.columns.iter().any(|own| own.name == *name);
        let lines: Vec<(String, String)> = lines
            .into_iter()
            .filter(|(name, _)| there(name) && !self.taken.contains(name))
            .collect();
        if lines.is_empty() {
            return;
        }
        self.taken.extend(lines.iter().map(|own| own.0.clone()));
        let (title, quantity) = (title.to_owned(), quantity.to_owned());
        self.groups.push(Group {
            title,
            quantity,
            unit: unit.to_owned(),
            factor,
            lines,
            shown,
            angle: self.angle.clone(),
        });
    }
}
