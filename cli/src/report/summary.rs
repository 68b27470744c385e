//! summary.json.

use std::collections::BTreeMap;
use std::io;

use serde::Serialize;
use whirl_solver::dynamics::{EnergyBalance, Outcome};
use whirl_solver::machine::{Body, BodyPlace};
use whirl_specs::{CLEARANCES, ELEMENTS};
use whirl_text::rounded;

use super::{OrderFacts, VerdictFacts, begun, last_cycle, orders, oscillations};
use crate::case::{Case, MarchSettings, SupportName};
use crate::fields::LargestStress;
use crate::history::ReadHistory;
use crate::machine::{BodyFacts, Built, Counts};
use crate::version;

/// Everything that a run says of itself.
#[derive(Debug, Serialize)]
pub(crate) struct Summary {
    case: CaseFacts,
    version: &'static str,
    commit: Option<&'static str>,
    kernels: BTreeMap<String, String>,
    counts: CountFacts,
    #[serde(skip_serializing_if = "Option::is_none")]
    fixed_interface_hz: Option<BTreeMap<String, Vec<f64>>>,
    /// Whether the results can be believed.
    pub(crate) verdict: VerdictFacts,
    march: MarchFacts,
    /// Over the last cycle.
    pub(crate) supports: Vec<SupportSummary>,
    /// Over the last whole revolutions, where something turns.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) orders: Option<OrderFacts>,
    /// The largest over the cycle, by body, where the case wants stresses.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub(crate) stresses: BTreeMap<String, LargestStress>,
    cycle_s: f64,
    /// What the cycle is.
    cycle: &'static str,
    steady_state: SteadyFacts,
    energy_balance_j: EnergyFacts,
    pub(crate) time: Times,
    /// Why the march ended early.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

#[derive(Debug, Serialize)]
struct CaseFacts {
    name: String,
    title: String,
    source: String,
    files: Vec<String>,
    laws: Vec<String>,
    motion: &'static str,
}

#[derive(Debug, Serialize)]
struct CountFacts {
    /// Of what is reduced, by name.
    #[serde(flatten)]
    bodies: BTreeMap<String, Counts>,
    #[serde(rename = "bodies", skip_serializing_if = "BTreeMap::is_empty")]
    named: BTreeMap<String, Counts>,
    /// Rotations that are unknown, and the Craig–Bampton coordinates of all bodies.
    coordinates: usize,
    /// Those left by the constraints.
    active: usize,
    springs: usize,
}

#[derive(Debug, Serialize)]
struct MarchFacts {
    /// Every step that was tried.
    converged: bool,
    /// Every step that was asked for.
    complete: bool,
    integrator: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    spectral_radius: Option<f64>,
    /// Where steps are all alike.
    #[serde(skip_serializing_if = "Option::is_none")]
    time_step_s: Option<f64>,
    /// Where the program chose them: what `steps` counts is then from row to row.
    #[serde(skip_serializing_if = "Option::is_none")]
    automatic: Option<AutomaticFacts>,
    steps_asked: usize,
    steps: usize,
    iterations: usize,
    factorisations: usize,
    halved_steps: usize,
}

/// The steps that the program chose.
#[derive(Debug, Clone, Copy, Serialize)]
struct AutomaticFacts {
    output_step_s: f64,
    step_tolerance: f64,
    /// Of those that were accepted; those that a load cuts where it begins or ends are not counted here.
    shortest_step_s: f64,
    longest_step_s: f64,
    /// Steps that were accepted, and those that were done again in halves.
    steps: usize,
    rejected_steps: usize,
}

impl AutomaticFacts {
    fn new(march: &MarchSettings, outcome: &Outcome) -> Option<Self> {
        let (options, taken) = (march.automatic?, outcome.parts?);
        let length = |halvings: u32| march.time_step / 2.0_f64.powi(halvings as i32);
        let [least, most] = taken.halvings.unwrap_or_default();
        Some(AutomaticFacts {
            output_step_s: march.time_step,
            step_tolerance: options.tolerance,
            shortest_step_s: length(most),
            longest_step_s: length(least),
            steps: taken.parts,
            rejected_steps: taken.rejected,
        })
    }
}

/// One support over the last cycle: force on the shaft (N), displacement and eccentricity (µm), in the
/// fixed frame.
#[derive(Debug, Serialize)]
pub(crate) struct SupportSummary {
    pub(crate) support: usize,
    /// Of a joint that has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<String>,
    /// The radial clearance with which it was run.
    clearance_um: f64,
    #[serde(rename = "RX_N")]
    pub(crate) rx: Statistics,
    #[serde(rename = "RY_N")]
    pub(crate) ry: Statistics,
    #[serde(rename = "X_um")]
    pub(crate) x: Statistics,
    #[serde(rename = "Y_um")]
    pub(crate) y: Statistics,
    #[serde(rename = "EX_um")]
    pub(crate) ex: Statistics,
    #[serde(rename = "EY_um")]
    pub(crate) ey: Statistics,
}

impl SupportSummary {
    /// Columns of a support.
    fn columns(support: &SupportName) -> [String; 6] {
        let both = |unit, names: [&str; 2]| names.map(|name| support.column(name, unit));
        let [force, place, eccentricity] =
            [both("N", ["RX", "RY"]), both("um", ["X", "Y"]), both("um", ["EX", "EY"])];
        let [[rx, ry], [x, y], [ex, ey]] = [force, place, eccentricity];
        [rx, ry, x, y, ex, ey]
    }

    /// Sums up all supports over the last `cycle` seconds of a history; `named`: whether they have names of their own.
    fn all(
        history: &dyn ReadHistory,
        (supports, named): (&[SupportName], bool),
        clearances: &[f64],
        cycle: f64,
    ) -> io::Result<Vec<Self>> {
        let names: Vec<String> = supports.iter().flat_map(SupportSummary::columns).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let mut signals = vec![Signal::default(); names.len()];
        let columns: Vec<&str> = std::iter::once("t_s").chain(names).collect();
        let mut times: Option<[f64; 2]> = None;
        history.scan(last_cycle(history, cycle)?, &columns, &mut |row| {
            let (time, values) = (row[0], &row[1..]);
            let passed = times.map(|[_, last]| time - last);
            signals.iter_mut().zip(values).for_each(|(signal, value)| signal.add(*value, passed));
            times = Some([times.map_or(time, |[first, _]| first), time]);
        })?;
        let covered = times.map_or(0.0, |[first, last]| last - first);
        // Rows do not always meet the start of the cycle, which ends as it begins.
        let rest = if covered > 0.5 * cycle { (cycle - covered).max(0.0) } else { 0.0 };
        let sums: Vec<Statistics> =
            signals.iter().map(|signal| signal.statistics(covered, rest)).collect();
        let of = |(place, own): (usize, &[Statistics])| SupportSummary {
            support: place + 1,
            joint: named.then(|| supports[place].title.clone()),
            clearance_um: rounded(1e6 * clearances[place], 10),
            rx: own[0],
            ry: own[1],
            x: own[2],
            y: own[3],
            ex: own[4],
            ey: own[5],
        };
        Ok(sums.chunks_exact(6).enumerate().map(of).collect())
    }
}

/// Least, mean and largest of some values; NaN if there are none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct Statistics {
    pub(crate) min: f64,
    pub(crate) mean: f64,
    pub(crate) max: f64,
}

impl Statistics {
    const NONE: Self = Statistics { min: f64::NAN, mean: f64::NAN, max: f64::NAN };
}

/// What is gathered of the values of one column: straight lines between them.
#[derive(Debug, Clone, Copy, Default)]
struct Signal {
    /// The first and the last value, the least and the largest.
    ends: Option<[f64; 2]>,
    span: [f64; 2],
    /// ∫ over time.
    integral: f64,
}

impl Signal {
    /// Takes a value in, so many seconds after the one before.
    fn add(&mut self, value: f64, passed: Option<f64>) {
        let [first, last] = self.ends.unwrap_or([value; 2]);
        let [least, largest] = self.ends.map_or([value; 2], |_| self.span);
        self.span = [least.min(value), largest.max(value)];
        self.integral += 0.5 * (last + value) * passed.unwrap_or(0.0);
        self.ends = Some([first, value]);
    }

    /// Over the seconds that the values cover, and a rest in which the last leads to the first again.
    fn statistics(&self, covered: f64, rest: f64) -> Statistics {
        let Some([first, last]) = self.ends else { return Statistics::NONE };
        let all = covered + rest;
        let mean = match all > 0.0 {
            true => (self.integral + 0.5 * (first + last) * rest) / all,
            false => last,
        };
        Statistics { min: self.span[0], mean, max: self.span[1] }
    }
}

#[derive(Debug, Serialize)]
struct SteadyFacts {
    /// Whether cycles were compared: a short run has too few of them.
    checked: bool,
    reached: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    time_s: Option<f64>,
    /// What is left to change, as a fraction of what varies in a cycle: infinite where nothing settles.
    #[serde(skip_serializing_if = "Option::is_none")]
    left: Option<f64>,
    /// Until when (s) something changes that is told over time, where too few cycles follow.
    #[serde(skip)]
    too_late: Option<f64>,
}

/// Until when (s) something changes that is told over time, where too few cycles follow for a steady state to be told.
fn too_late(
    march: &MarchSettings,
    outcome: &Outcome,
    history: &dyn ReadHistory,
) -> io::Result<Option<f64>> {
    let until = outcome.told_until;
    let ends = history.last_time()?.unwrap_or(0.0);
    let begun = begun(history, march.time_step)?;
    let cycles = march.steady_rule.cycles() as f64;
    let is_late = until > begun && until + cycles * march.cycle > ends;
    Ok((is_late && outcome.steady.is_none()).then_some(until))
}

/// work_in = kinetic + strain + spring_stored + spring_dissipated + dissipated + error.
#[derive(Debug, Serialize)]
struct EnergyFacts {
    #[serde(flatten)]
    balance: EnergyBalance,
    error: f64,
}

impl EnergyFacts {
    /// Of what was marched, if anything was.
    fn new(balance: Option<&EnergyBalance>) -> Self {
        let balance = balance.copied().unwrap_or_else(EnergyBalance::none);
        EnergyFacts { balance, error: balance.error() }
    }
}

/// Simulated and wall time.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Times {
    /// Time marched through, s.
    pub(crate) simulated_s: f64,
    /// Reading, assembling and reducing the bodies, or finding them in the cache, s.
    pub(crate) reduction_wall_s: f64,
    /// Marching, s.
    pub(crate) march_wall_s: f64,
    /// From the start to the writing of this summary, s.
    pub(crate) total_wall_s: f64,
    /// Simulated ÷ march.
    pub(crate) real_time_factor: f64,
    /// Whether the reduced bodies came from the cache.
    pub(crate) reduction_cached: bool,
}

impl Summary {
    /// Sums up a march of `steps` steps and the history that it left; it may have ended early with `error`; `from`: the
    /// folder of the run from whose end it went on, if that is not sound.
    ///
    /// # Errors
    /// The history cannot be read.
    pub(crate) fn new(
        (case, built): (&Case, &Built),
        (outcome, history): (&Outcome, &dyn ReadHistory),
        (steps, converged): (usize, bool),
        time: Times,
        (verdict, error): (VerdictFacts, Option<String>),
    ) -> io::Result<Summary> {
        let (cycle, supports) = (case.march().cycle, case.supports());
        let named = case.machine.is_named();
        // A run that is too short to be tested is taken as it is.
        let repeats = outcome.steady.is_some() || case.march().steady_cycle().is_none();
        Ok(Summary {
            case: case_facts(case, built),
            version: version::PACKAGE,
            commit: version::COMMIT,
            kernels: kernels(built),
            counts: counts(built, named),
            fixed_interface_hz: built.bodies.as_ref().map(frequencies),
            verdict,
            march: MarchFacts {
                converged,
                complete: steps == case.march().steps
                    || case.march().stop_when_steady && outcome.steady.is_some() && error.is_none(),
                integrator: case.march().integrator_called(),
                spectral_radius: case.march().spectral_radius,
                time_step_s: case.march().automatic.is_none().then_some(case.march().time_step),
                automatic: AutomaticFacts::new(case.march(), outcome),
                steps_asked: case.march().steps,
                steps,
                iterations: outcome.iterations,
                factorisations: outcome.factorisations,
                halved_steps: outcome.halved_steps,
            },
            supports: SupportSummary::all(history, (&supports, named), &built.clearances, cycle)?,
            orders: orders(history, &oscillations(case, &built.machine), (cycle, repeats))?,
            stresses: BTreeMap::new(),
            cycle_s: cycle,
            cycle: case.march().cycle_called,
            steady_state: SteadyFacts {
                checked: case.march().steady_cycle().is_some(),
                reached: outcome.steady.is_some(),
                time_s: outcome.steady.map(|steady| steady.time),
                left: outcome.left,
                too_late: too_late(case.march(), outcome, history)?,
            },
            energy_balance_j: EnergyFacts::new((steps > 0).then_some(&outcome.energy)),
            time,
            error,
        })
    }

    /// When the steady state was reached, and what is left to change, in words.
    pub(crate) fn steadiness(&self, march: &MarchSettings) -> String {
        let facts = &self.steady_state;
        let left = |left: f64| {
            if left < 1e-6 {
                return "nothing changes any more".to_owned();
            }
            if left < 1.0 {
                let share = whirl_text::shown(100.0 * left, 2, 1e-3..1e6);
                return format!(
                    "forces and displacements still drift by {share} % of what they vary by in a cycle"
                );
            }
            // How much more is an estimate of what is slower than the cycle.
            match left.is_finite() {
                true => format!(
                    "forces and displacements are estimated to change by {} times what they vary by in a cycle yet",
                    whirl_text::shown(left, 2, 1e-3..1e6)
                ),
                false => "the change from cycle to cycle does not decrease".to_owned(),
            }
        };
        match (facts.time_s, facts.left) {
            _ if !facts.checked => format!(
                "not tested for a steady state: the run is shorter than {}",
                march.steady_cycles()
            ),
            _ if let Some(until) = facts.too_late => too_late_words(until, march),
            (Some(time), Some(own)) => format!("steady from {time:.4} s, {}", left(own)),
            (Some(time), None) => format!("steady from {time:.4} s"),
            (None, Some(own)) => format!("not steady: {}", left(own)),
            (None, None) => "not steady".to_owned(),
        }
    }

    /// The steps that the program chose, in words; nothing where it did not.
    pub(crate) fn steps_taken(&self) -> String {
        let Some(own) = &self.march.automatic else { return String::new() };
        let AutomaticFacts { shortest_step_s, longest_step_s, steps, rejected_steps, .. } = own;
        let [shortest, longest] = [shortest_step_s, longest_step_s].map(|own| rounded(*own, 3));
        format!(
            "{steps} steps of {shortest:e} to {longest:e} s, {rejected_steps} more repeated in halves\n"
        )
    }

    /// The text of summary.json, in which numbers that are not finite are null.
    pub(crate) fn json(&self) -> String {
        let text = serde_json::to_string_pretty(self);
        text.expect("the keys of a summary are strings") + "\n"
    }
}

/// Why no steady state was told, in words.
fn too_late_words(until: f64, march: &MarchSettings) -> String {
    match until.is_finite() {
        true => format!(
            "not steady: what is given over time changes until {} s, and the run ends less than {} later",
            rounded(until, 6),
            march.steady_cycles()
        ),
        false => "not steady: a speed that is given changes all the time".to_owned(),
    }
}

fn case_facts(case: &Case, built: &Built) -> CaseFacts {
    CaseFacts {
        name: case.name.clone(),
        title: case.title.clone(),
        source: case.origin.clone(),
        files: case.sources.iter().map(|source| source.path.display().to_string()).collect(),
        laws: built.laws.iter().map(|law| law.name()).collect(),
        motion: built.machine.motion.origin.name,
    }
}

/// Hashes of the kernels by kind and name.
fn kernels(built: &Built) -> BTreeMap<String, String> {
    let machine = &built.machine;
    let mut hashes = BTreeMap::new();
    let mut add = |kind: &str, name: &str, hash: &str| {
        hashes.insert(format!("{kind}/{name}"), hash.to_string());
    };
    built.law_hashes.iter().for_each(|(name, hash)| add("law", name, hash));
    let motion = &machine.motion.origin;
    add("motion", motion.name, motion.hash);
    CLEARANCES.iter().for_each(|c| add("clearance", c.origin.name, c.origin.hash));
    if built.bodies.is_some() {
        ELEMENTS.iter().for_each(|e| add("element", e.origin.name, e.origin.hash));
    }
    hashes
}

fn counts(built: &Built, named: bool) -> CountFacts {
    let bodies = built.bodies.as_ref();
    let machine = &built.machine;
    let fact = |name: &str| bodies?.bodies.iter().find(|body| body.name == name);
    // What is reduced counts with all its Craig–Bampton coordinates.
    let whole = |(body, place): (&Body, &BodyPlace)| {
        let reduced = fact(body.name()).map(|own| own.counts.craig_bampton_dofs);
        reduced.unwrap_or(place.flexible.len())
    };
    let all = machine.bodies.iter().zip(machine.places()).map(whole).sum::<usize>();
    let active = machine.active();
    let unknown = machine.turning().count() - machine.first_unknown();
    let counts = bodies.map_or_else(BTreeMap::new, |facts| {
        facts.bodies.iter().map(|own| (own.name.clone(), own.counts)).collect()
    });
    // Names of users stand in a table of their own, so that none is taken for another count.
    let (bodies, named) = if named { (BTreeMap::new(), counts) } else { (counts, BTreeMap::new()) };
    CountFacts {
        bodies,
        named,
        coordinates: unknown + all,
        active,
        springs: built.machine.springs.count(),
    }
}

fn frequencies(facts: &BodyFacts) -> BTreeMap<String, Vec<f64>> {
    facts.bodies.iter().map(|body| (body.name.clone(), body.hertz.clone())).collect()
}
