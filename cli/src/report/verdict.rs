//! What the program itself believes of a run, as summary.json and the terminal say it.

use serde::Serialize;
use whirl_solver::bearing::{Measure, Worst};
use whirl_solver::dynamics::{Finding, Outcome, findings};
use whirl_solver::machine::Machine;

/// The verdict of a run in summary.json.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct VerdictFacts {
    /// Whether nothing was found that speaks against the results.
    pub(crate) sound: bool,
    pub(crate) findings: Vec<FindingFacts>,
    measures: Measures,
}

/// Something beyond its limit.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct FindingFacts {
    what: String,
    /// In `unit`; null if it is no number.
    value: f64,
    limit: f64,
    unit: String,
    remedy: String,
}

/// What was measured of all steps, sound or not.
#[derive(Debug, Clone, Serialize)]
struct Measures {
    energy_made_share: f64,
    local_error: f64,
    largest_local_error: f64,
    row_error: f64,
}

impl VerdictFacts {
    /// Of a march of steps of `time_step` s.
    pub(crate) fn new(machine: &Machine, outcome: &Outcome, time_step: f64) -> Self {
        let quality = &outcome.quality;
        let of_steps = findings(quality, time_step).into_iter().map(FindingFacts::from);
        let measures = machine.springs.measures().iter().zip(&outcome.worst);
        let of_laws = measures.filter_map(|(measure, worst)| {
            let Worst { value, time } = (*worst)?;
            (measure.excess(value) > 0.0).then(|| FindingFacts::beyond(measure, value, time))
        });
        let findings: Vec<FindingFacts> = of_steps.chain(of_laws).collect();
        VerdictFacts {
            sound: findings.is_empty(),
            findings,
            measures: Measures {
                energy_made_share: quality.energy_made_share(),
                local_error: quality.local_error,
                largest_local_error: quality.largest_local_error,
                row_error: quality.row_error,
            },
        }
    }

    /// The verdict in words, a line each.
    pub(crate) fn words(&self) -> String {
        if self.sound {
            return "verdict: sound\n".to_owned();
        }
        let mut text = "verdict: NOT SOUND, do not use these results\n".to_owned();
        for found in &self.findings {
            let (value, limit) = (found.amount(found.value), found.amount(found.limit));
            text += &format!("  {}: {value}, limit {limit}\n", found.what);
            text += &format!("    remedy: {}\n", found.remedy);
        }
        text
    }
}

impl From<Finding> for FindingFacts {
    fn from(finding: Finding) -> Self {
        let Finding { what, value, limit, unit, remedy } = finding;
        FindingFacts { what, value, limit, unit, remedy }
    }
}

impl FindingFacts {
    /// A law that was used where it may not be believed; `value` in SI.
    fn beyond(measure: &Measure, value: f64, time: f64) -> Self {
        let validity = &measure.validity;
        let [least, most] = validity.limits;
        let limit = if value < least { least } else { most };
        let place = measure.bearing + 1;
        FindingFacts {
            what: format!(
                "{} at support {place} (law `{}`, worst at t = {time:.6} s)",
                validity.title, measure.law
            ),
            value: value / validity.per_unit,
            limit: limit / validity.per_unit,
            unit: validity.unit.clone(),
            remedy: validity.help.clone(),
        }
    }

    /// A value with its unit; shares in per cent.
    fn amount(&self, value: f64) -> String {
        match self.unit.as_str() {
            "1" => format!("{} %", digits(100.0 * value)),
            unit => format!("{} {unit}", digits(value)),
        }
    }
}

/// Three digits, in scientific notation where that is shorter.
fn digits(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    format!("{rounded}")
}
