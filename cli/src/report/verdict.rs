//! What the program itself believes of a run, as summary.json and the terminal say it.

use serde::Serialize;
use whirl_solver::bearing::{Measure, Worst};
use whirl_solver::dynamics::{AutomaticStep, Finding, MovingPart, Outcome, findings};
use whirl_solver::machine::Machine;

use crate::case::SupportName;

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
    energy_error_share: f64,
    /// Null where there was no motion that steps resolve.
    local_error: f64,
    largest_local_error: f64,
    unresolved_motion: f64,
    inertia_error: f64,
    ringing: f64,
    /// Left out where no law has states.
    #[serde(skip_serializing_if = "Option::is_none")]
    state_error: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    state_error_sum: Option<f64>,
    /// Of accepted steps, so that it is never above 1.
    row_error: f64,
}

impl VerdictFacts {
    /// Of a march of steps of so many s, or of parts of them that it chose; `diverged`: the steps that were done and those asked for, where the
    /// march ended in one that does not converge; `from`: what it went on from, if that is not sound;
    /// `places` names the supports or stops.
    pub(crate) fn new(
        (machine, places): (&Machine, &[SupportName]),
        outcome: &Outcome,
        length: (f64, Option<AutomaticStep>),
        (diverged, from): (Option<[usize; 2]>, Option<&str>),
    ) -> Self {
        let quality = &outcome.quality;
        // A march that ended in its first step has no measures.
        let marched = diverged.is_none_or(|[done, _]| done > 0);
        let judged = |error: f64| if quality.judged && marched { error } else { f64::NAN };
        let of_march = |measure: f64| if marched { measure } else { f64::NAN };
        let key = if length.1.is_some() { "output_step" } else { "time_step" };
        let diverged = diverged.map(|steps| FindingFacts::diverged(steps, key));
        let of_run = diverged.into_iter().chain(from.map(FindingFacts::inherited));
        let of_steps = findings(quality, &outcome.energy, length).into_iter();
        let of_steps = of_steps.map(|finding| FindingFacts::of_steps(finding, (machine, places)));
        let measures = machine.springs.measures().iter().zip(&outcome.worst);
        let of_laws = measures.filter_map(|(measure, worst)| {
            let Worst { value, time } = (*worst)?;
            (measure.excess(value) > 0.0)
                .then(|| FindingFacts::beyond(measure, value, time, places))
        });
        let findings: Vec<FindingFacts> = of_run.chain(of_steps).chain(of_laws).collect();
        VerdictFacts {
            sound: findings.is_empty(),
            findings,
            measures: Measures {
                energy_made_share: of_march(quality.energy_made_share),
                energy_error_share: of_march(outcome.energy.error_fraction()),
                local_error: judged(quality.local_error),
                largest_local_error: judged(quality.largest_local_error),
                unresolved_motion: of_march(quality.unresolved_motion),
                inertia_error: of_march(quality.inertia_error),
                ringing: of_march(quality.ringing.share),
                state_error: quality.states.map(|own| own.local.0),
                state_error_sum: quality.states.map(|own| own.summed.0),
                row_error: of_march(quality.row_error),
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

impl FindingFacts {
    fn of_steps(finding: Finding, (machine, places): (&Machine, &[SupportName])) -> Self {
        let Finding { what, bearing, part, coordinate, value, limit, unit, remedy } = finding;
        let place = bearing.map(|bearing| format!(" (at {})", named(places, bearing)));
        let part = part.map(|MovingPart { body, turns }| {
            let (rotation, name) =
                (if turns { "rotation of " } else { "" }, machine.bodies[body].name());
            format!(" ({rotation}{name})")
        });
        let row = coordinate.map(|place| format!(" ({})", machine.coordinate(place)));
        let what = what + &place.or(part).or(row).unwrap_or_default();
        FindingFacts { what, value, limit, unit, remedy }
    }

    /// `key`: what a case sets to have shorter steps.
    fn diverged([done, asked]: [usize; 2], key: &str) -> Self {
        FindingFacts {
            what: "steps before one that does not converge".to_owned(),
            value: done as f64,
            limit: asked as f64,
            unit: "steps".to_owned(),
            remedy: format!(
                "see `error`: a shorter `{key}` may help, unless a law has no value there"
            ),
        }
    }

    /// What the run `before` got wrong stands in the state in which it ended.
    fn inherited(before: &str) -> Self {
        FindingFacts {
            what: format!("unsound runs before this one ({before})"),
            value: 1.0,
            limit: 0.0,
            unit: "runs".to_owned(),
            remedy: format!(
                "correct {before} as its own verdict says, and start from its new final state"
            ),
        }
    }

    /// A law that was used where it may not be believed; `value` in SI.
    fn beyond(measure: &Measure, value: f64, time: f64, places: &[SupportName]) -> Self {
        let validity = &measure.validity;
        let [least, most] = validity.limits;
        let limit = if value < least { least } else { most };
        let place = named(places, measure.bearing);
        FindingFacts {
            what: format!(
                "{} at {place} (law `{}`, worst at t = {time:.6} s)",
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

/// The name of a support or stop, such as `support 2`.
fn named(places: &[SupportName], bearing: usize) -> String {
    let name = places.get(bearing).map(|place| place.word.clone());
    name.unwrap_or_else(|| format!("bearing {}", bearing + 1))
}

/// Three digits, in scientific notation where that is shorter.
fn digits(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    format!("{}", whirl_text::rounded(value, 3))
}
