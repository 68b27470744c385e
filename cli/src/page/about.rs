//! What a page has to know of a case beside its numbers: about.json, written by every run.

use serde::{Deserialize, Serialize};
use whirl_text::rounded;

use super::groups::{Group, groups, moved};
use super::teeth::Teeth;
use crate::case::{Case, Joint, JointKind, LawSource};
use crate::figures::at_zero;
use crate::machine::Built;
use crate::report::oscillations;
use crate::version;

/// Layout of the file.
pub(super) const LAYOUT: u32 = 3;

/// A part of the case in words: rows of a table, the first one of heads, and lines below it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Section {
    pub(crate) title: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) table: Vec<Vec<String>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) lines: Vec<String>,
}

/// A column of the history.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct ColumnFacts {
    pub(super) name: String,
    pub(super) unit: String,
    pub(super) meaning: String,
}

/// What oscillates: columns that belong together, with what each is called by.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Signal {
    pub(super) title: String,
    pub(super) quantity: String,
    pub(super) unit: String,
    /// Column, and letter of its axis.
    pub(super) columns: Vec<(String, String)>,
    /// The column of the angle by which its orders count.
    pub(super) angle: Option<String>,
}

/// The way of a journal in its bore, or of the first side of a bushing, and the force on it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Journal {
    pub(super) title: String,
    /// What moves.
    pub(super) moved: String,
    /// Columns of the eccentricity along x and y (µm).
    pub(super) columns: [String; 2],
    /// Columns of the force on it along x and y (N).
    pub(super) forces: [String; 2],
    /// Radial; 0 where there is none.
    pub(super) clearance_um: f64,
    /// The column of the angle at which its keyphasor is seen.
    pub(super) angle: Option<String>,
}

/// The first output of a law along its first input, all others being zero.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct LawCurve {
    /// Name and title of the law.
    pub(super) law: String,
    pub(super) title: String,
    /// Name and unit.
    pub(super) x: (String, String),
    pub(super) y: (String, String),
    pub(super) points: Vec<(f64, f64)>,
}

impl LawCurve {
    /// Of every law of bearings, stops and gears that has one, once: bushings and couplings tell their coefficients.
    fn all(case: &Case, laws: &[LawSource]) -> Vec<Self> {
        let mut all: Vec<LawCurve> = Vec::new();
        for (joint, own) in case.machine.joints.iter().zip(laws) {
            let linear = matches!(joint.kind, JointKind::Bushing | JointKind::Coupling);
            // With states at zero a law is none that acts anywhere.
            let is_shown = !linear && own.states().is_empty();
            let (name, Some(spec)) = (own.name(), own.spec().filter(|_| is_shown)) else {
                continue;
            };
            let Some(curve) = at_zero(&spec) else { continue };
            if all.iter().all(|own| own.law != name) {
                let title = spec.title.clone();
                let rounded = |(x, y)| (rounded(x, 7), rounded(y, 7));
                let points = curve.points.into_iter().map(rounded).collect();
                all.push(LawCurve { law: name, title, x: curve.x, y: curve.y, points });
            }
        }
        all
    }
}

/// All of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct About {
    pub(super) layout: u32,
    pub(super) version: String,
    pub(super) name: String,
    pub(super) title: String,
    pub(super) source: String,
    /// The case in words.
    pub(super) words: Vec<Section>,
    pub(super) laws: Vec<LawCurve>,
    /// Of the history, in its order.
    pub(super) columns: Vec<ColumnFacts>,
    /// Columns that are drawn together.
    pub(super) groups: Vec<Group>,
    pub(super) signals: Vec<Signal>,
    pub(super) journals: Vec<Journal>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) teeth: Vec<Teeth>,
    /// From row to row (s).
    pub(super) row_s: f64,
    /// The cycle (s), and what it is.
    pub(super) cycle_s: f64,
    pub(super) cycle: String,
    /// How the summary tells of steadiness, in words.
    pub(super) steady: String,
}

impl About {
    /// Of a run of a case; `steady`: whether it came to a steady state, in words.
    pub(crate) fn of_run(
        (case, built): (&Case, &Built),
        words: Vec<Section>,
        steady: String,
    ) -> Self {
        let (march, columns) = (case.march(), built.columns());
        let (all, supports) = (oscillations(case, &built.machine), case.supports());
        // Outputs may have the names of joints.
        let of_joint =
            |column: &str| supports.iter().position(|own| own.column("X", "um") == *column);
        let signals = all.iter().map(|own| Signal {
            title: own.title.clone(),
            quantity: match own.columns.first().and_then(|own| of_joint(&own.0)) {
                Some(joint) => format!("displacement of {}", moved(case, joint)),
                None => own.quantity.to_owned(),
            },
            unit: own.unit.to_owned(),
            columns: own.columns.iter().map(|(a, b)| (a.clone(), (*b).to_lowercase())).collect(),
            angle: own.angle.clone(),
        });
        let signals: Vec<Signal> = signals.collect();
        let angle_of = |column: &str| {
            let own = signals.iter().find(|own| own.columns.iter().any(|own| own.0 == column));
            own.and_then(|own| own.angle.clone())
        };
        // A coupling has no way in its plane, and a stop on one side no circle.
        let moving = case.machine.joints.iter().zip(&supports).zip(&built.clearances);
        let moving = moving.enumerate().filter(|(_, ((joint, _), _))| {
            let has_circle = !case.machine.is_mass() || joint.angle.is_none();
            has_circle && !matches!(joint.kind, JointKind::Coupling | JointKind::Gear)
        });
        // Pads move, so that the middle of their bores is no middle of the bearing.
        let is_pad =
            |joint: &Joint| joint.bearing.law.source.film().is_some_and(|own| own.is_arc());
        let journals = moving.map(|(place, ((joint, own), clearance))| Journal {
            title: own.title.clone(),
            moved: moved(case, place).to_owned(),
            columns: ["EX", "EY"].map(|quantity| own.column(quantity, "um")),
            forces: ["RX", "RY"].map(|quantity| own.column(quantity, "N")),
            clearance_um: if is_pad(joint) { 0.0 } else { rounded(1e6 * clearance, 10) },
            angle: angle_of(&own.column("X", "um")),
        });
        About {
            layout: LAYOUT,
            version: version::PACKAGE.to_owned(),
            name: case.name.clone(),
            title: case.title.clone(),
            source: case.origin.clone(),
            words,
            laws: LawCurve::all(case, &built.laws),
            groups: groups(case, built, &columns),
            journals: journals.collect(),
            teeth: Teeth::all(case),
            signals,
            columns: columns
                .into_iter()
                .map(|own| ColumnFacts {
                    name: own.name,
                    unit: own.unit.to_string(),
                    meaning: own.meaning,
                })
                .collect(),
            row_s: march.time_step * march.output_every as f64,
            cycle_s: march.cycle,
            cycle: march.cycle_called.to_owned(),
            steady,
        }
    }

    /// The text of the file.
    pub(crate) fn json(&self) -> String {
        serde_json::to_string_pretty(self).expect("the keys are strings") + "\n"
    }

    /// Of the text of a file; why it is none.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let own: serde_json::Value = serde_json::from_str(text).map_err(|why| why.to_string())?;
        if own["layout"] != LAYOUT {
            return Err("it is of another version of the program: run the case again".to_owned());
        }
        serde_json::from_value(own).map_err(|why| why.to_string())
    }
}
