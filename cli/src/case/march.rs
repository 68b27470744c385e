//! Time step, duration and tolerances.

use whirl_codegen::diagnostic::Code;
use whirl_codegen::document::Table;
use whirl_solver::dynamics::{AutomaticStep, Integrator, LEAST_STEPS, SteadyRule};

use super::cycle::{self, MOST_PERIODS};
use super::film_march;
use super::joined_machine::JoinedMachine;
use super::run::Run;

/// What stands for a time step that the program chooses.
pub(super) const AUTOMATIC: &str = "auto";
/// What tells a steady state.
pub(super) const ESTIMATE: &str = "estimate";
pub(super) const ONE_CYCLE: &str = "one-cycle";
/// How steps are integrated.
pub(super) const NEWMARK: &str = "newmark";
pub(super) const GENERALIZED_ALPHA: &str = "generalized-alpha";
/// Steps of a march; their history takes some gigabytes.
pub(super) const MOST_STEPS: usize = 10_000_000;

/// How a case is marched in time.
#[derive(Debug, Clone)]
pub(crate) struct MarchSettings {
    /// Δt in s; where the program chooses the parts of it, from one row of the history to the next.
    pub(crate) time_step: f64,
    /// How the program chooses them, where it does.
    pub(crate) automatic: Option<AutomaticStep>,
    /// Steps.
    pub(crate) steps: usize,
    /// How they are integrated.
    pub(crate) integrator: Integrator,
    /// Spectral radius of generalized-α, where it is that.
    pub(crate) spectral_radius: Option<f64>,
    /// Largest change of a spring force between iterations, in N, at which a step has converged.
    pub(crate) force_tolerance: f64,
    /// Steps from one row of the history to the next.
    pub(crate) output_every: usize,
    /// Period over which steady state is tested and results are summed up, in s.
    pub(crate) cycle: f64,
    /// What the cycle is, in words.
    pub(crate) cycle_called: &'static str,
    /// Whether loads and rotation have no period in common, so that the cycle is not theirs.
    pub(crate) no_common_cycle: bool,
    /// What tells the steady state.
    pub(crate) steady_rule: SteadyRule,
    /// Whether the steady state is the end.
    pub(crate) stop_when_steady: bool,
}

impl MarchSettings {
    /// The integrator as a case names it.
    pub(crate) fn integrator_called(&self) -> &'static str {
        if self.spectral_radius.is_some() { GENERALIZED_ALPHA } else { NEWMARK }
    }

    /// End of the analysis in s.
    pub(crate) fn duration(&self) -> f64 {
        self.time_step * self.steps as f64
    }

    /// The cycle by which the steady state is tested, in s; none where the analysis ends before there are so many of them
    /// that a steady state could be told.
    pub(crate) fn steady_cycle(&self) -> Option<f64> {
        let least = self.steady_rule.cycles() as f64 * self.cycle;
        // A sum of steps may miss the end by rounding.
        (least <= self.duration() * (1.0 + 1e-9)).then_some(self.cycle)
    }

    /// How many cycles a run has at least in which a steady state can be told, in words.
    pub(crate) fn steady_cycles(&self) -> String {
        match self.steady_rule.cycles() {
            2 => "two cycles".to_owned(),
            more => format!("{more} cycles"),
        }
    }
}

/// Steps beyond have nothing to do with a machine, and their squares leave the range of numbers (s).
const SHORTEST: f64 = 1e-15;
const LONGEST: f64 = 1e9;

/// Of generalized-α: motion that is far faster than the step falls to a tenth in 22 of them.
const SPECTRAL_RADIUS: f64 = 0.9;

/// Of the reference histories: far below every force of interest, far above rounding.
const FORCE_TOLERANCE: f64 = 1e-3;

/// `goes_on`: from the state of another run.
pub(super) fn read(
    file: &Table,
    machine: Option<&JoinedMachine>,
    goes_on: bool,
) -> Option<MarchSettings> {
    file.in_table("march", |march| read_march(march, machine, goes_on))
}

fn read_march(march: &Table, machine: Option<&JoinedMachine>, goes_on: bool) -> MarchSettings {
    let automatic = is_automatic(march);
    let step = if automatic { Step::of_rows(march) } else { Step::fixed(march) };
    let (given, key) = (step.given, step.key);
    let given = given.filter(|given| sensible(march, key, *given));
    let time_step = given.unwrap_or(1.0);
    let steps = steps(march, &step);
    let force_tolerance = march.quantity("force_tolerance").unwrap_or(FORCE_TOLERANCE);
    let frequency = march.quantity("cycle_frequency");
    let run = Run { duration: time_step * steps as f64, goes_on };
    // That of a speed at which a couple only aims may be none that steps show; of others that is refused.
    let natural = machine.and_then(|own| cycle::of(own, run));
    let natural = natural.filter(|own| !own.aimed || own.time >= LEAST_STEPS * time_step);
    let cycle = match frequency {
        Some(frequency) => Some((1.0 / frequency, "cycle_frequency", "a cycle")),
        None => natural.map(|own| (own.time, key, own.called)),
    };
    let shortest = machine.map_or(Vec::new(), |own| cycle::shortest(own, run));
    if let (Some(time_step), false) = (given, automatic) {
        let cycle = cycle.filter(|(_, key, _)| *key == "cycle_frequency");
        let shortest = shortest.iter().map(|(time, called)| (*time, key, called.as_str()));
        cycle.into_iter().chain(shortest).for_each(|own| shown(march, time_step, own));
    }
    let cycle_of_rows = cycle;
    let cycle = cycle.map_or(time_step * steps as f64, |(cycle, ..)| cycle);
    let output_every = if automatic { 1 } else { output_every(march, given, steps) };
    if let (Some(_), Some((cycle, ..))) = (given, cycle_of_rows) {
        shown_by_rows(march, output_every as f64 * time_step, (cycle, automatic));
    }
    let spectral_radius = spectral_radius(march);
    if let (Some(_), Some(machine)) = (spectral_radius, machine) {
        film_march::refuse_alpha(march, machine);
    }
    let stop_when_steady = march.optional_boolean("stop_when_steady").unwrap_or(false);
    let settings = MarchSettings {
        time_step,
        automatic: tolerance(march, automatic).map(|tolerance| AutomaticStep {
            tolerance,
            longest: shortest
                .iter()
                .map(|(time, _)| time / LEAST_STEPS)
                .fold(f64::INFINITY, f64::min),
        }),
        steps,
        integrator: spectral_radius.map_or_else(Integrator::default, Integrator::generalized_alpha),
        spectral_radius,
        force_tolerance,
        output_every,
        cycle,
        cycle_called: match (frequency, &natural) {
            (Some(_), _) => "one period of the `cycle_frequency` that the case gives",
            (None, Some(own)) => own.called,
            (None, None) => "the whole run",
        },
        steady_rule: match march.optional_word("steady_test") {
            Some(ONE_CYCLE) => SteadyRule::OneCycle,
            _ => SteadyRule::default(),
        },
        no_common_cycle: frequency.is_none() && natural.is_some_and(|own| !own.common),
        stop_when_steady,
    };
    if stop_when_steady && given.is_some() && (march.has("steps") || march.has("duration")) {
        has_a_steady_state(march, &settings, cycle_of_rows.is_some());
    }
    settings
}

/// The step that a case gives, and the key by which it does.
struct Step {
    given: Option<f64>,
    key: &'static str,
}

impl Step {
    /// Of a march in steps that are all alike.
    fn fixed(march: &Table) -> Self {
        let key = "time_step";
        let written = march.written(key);
        let word = written.text().trim_matches(['"', '\'']);
        if march.gives(key) && word.starts_with(char::is_alphabetic) {
            march.pass_over(key);
            let message = format!("`time_step` cannot be `{word}`");
            let help = "write `time_step = \"auto\"`, or a step such as `time_step = \"7.4e-5 s\"`";
            refuse(march, key, message, help.to_owned());
            return Step { given: None, key };
        }
        Step { given: march.quantity(key), key }
    }

    /// From row to row of a march whose steps the program chooses, which asks for no number of them.
    fn of_rows(march: &Table) -> Self {
        let key = "output_step";
        march.pass_over("time_step");
        if !march.has(key) {
            march.absent(key, "with `time_step = \"auto\"`, add `output_step = \"0.1 ms\"`, the time between rows of history.csv");
        }
        if march.has("steps") {
            let message = "`steps` has no meaning with `time_step = \"auto\"`: how many there will be is not known";
            let help = "write `duration = \"0.1 s\"` instead of it";
            refuse(march, "steps", message, help.to_owned());
        }
        Step { given: march.quantity(key), key }
    }
}

/// Whether the program is to choose the step.
fn is_automatic(march: &Table) -> bool {
    let key = "time_step";
    march.gives(key) && march.written(key).text().trim_matches(['"', '\'']) == AUTOMATIC
}

/// The spectral radius of generalized-α, where that is the integrator.
fn spectral_radius(march: &Table) -> Option<f64> {
    let key = "spectral_radius";
    let chosen = march.optional_word("integrator") == Some(GENERALIZED_ALPHA);
    if !march.has(key) {
        return chosen.then_some(SPECTRAL_RADIUS);
    }
    let given = march.number_or_middle(key);
    if !chosen {
        let message = "`spectral_radius` has no effect on Newmark's method, which damps nothing";
        let help = format!("write `integrator = \"{GENERALIZED_ALPHA}\"`, or leave it out");
        refuse(march, key, message, help);
    }
    chosen.then_some(given)
}

/// The tolerance by which steps are chosen, where they are.
fn tolerance(march: &Table, automatic: bool) -> Option<f64> {
    let key = "step_tolerance";
    if !march.has(key) {
        return automatic.then_some(AutomaticStep::TOLERANCE);
    }
    let given = march.number_or_middle(key);
    if !automatic {
        let message = "`step_tolerance` has no effect with a fixed `time_step`";
        let help = "write `time_step = \"auto\"`, or leave out `step_tolerance`";
        refuse(march, key, message, help.to_owned());
    }
    automatic.then_some(given)
}

/// Notes why a run could not be stopped at its steady state.
fn has_a_steady_state(march: &Table, settings: &MarchSettings, has_cycle: bool) {
    let write =
        "write `cycle_frequency = \"25 Hz\"`, with the frequency at which the motion repeats";
    if !has_cycle {
        let message = "no cycle is known in which a steady state could be detected: nothing turns at a known speed, \
                       and no load has a frequency";
        refuse(march, "stop_when_steady", message, write.to_owned());
    } else if settings.no_common_cycle {
        let message = format!(
            "loads and rotation have no common period of up to {MOST_PERIODS} of the slowest: the motion does not \
             repeat, and no steady state can be detected"
        );
        refuse(march, "stop_when_steady", message, write.to_owned());
    } else if settings.steady_cycle().is_none() {
        let message = format!(
            "a run of {} s is shorter than {} of {} s ({}): no steady state can be detected in it",
            plain(settings.duration()),
            settings.steady_cycles(),
            three_digits(settings.cycle, f64::round),
            settings.cycle_called
        );
        let least = three_digits(settings.steady_rule.cycles() as f64 * settings.cycle, |digits| {
            (digits - 1e-6).ceil()
        });
        let help = format!(
            "write `duration = \"{least} s\"` or more, or a higher `cycle_frequency` at which the motion repeats"
        );
        refuse(march, "stop_when_steady", message, help);
    }
}

/// Whether a step is one that numbers can march by; notes it otherwise.
fn sensible(march: &Table, key: &'static str, step: f64) -> bool {
    let is_sensible = (SHORTEST..=LONGEST).contains(&step);
    if !is_sensible {
        let message = format!(
            "`{key}` is {step:e} s, but steps are from {SHORTEST:e} s to {LONGEST:e} s long"
        );
        let help = "write a small fraction of the period of the fastest motion of interest";
        refuse(march, key, message, help.to_owned());
    }
    is_sensible
}

/// Notes a cycle that is too short for its steps to show it; `key` is to blame for it.
fn shown(march: &Table, time_step: f64, (cycle, key, called): (f64, &str, &str)) {
    let steps = cycle / time_step;
    if steps >= LEAST_STEPS {
        return;
    }
    let message = format!(
        "{called} of {} s takes {} steps of `time_step`: at least {LEAST_STEPS} are needed to resolve it",
        three_digits(cycle, f64::round),
        three_digits(steps, f64::round)
    );
    let step = three_digits(cycle / LEAST_STEPS, f64::floor);
    let mut help = format!("write `time_step = \"{step} s\"` or less");
    if key == "cycle_frequency" {
        let frequency = three_digits(1.0 / (LEAST_STEPS * time_step), f64::floor);
        help += &format!(", or `cycle_frequency = \"{frequency} Hz\"` or less");
    }
    refuse(march, key, message, help);
}

/// Notes rows that are too far apart to sum up a cycle.
fn shown_by_rows(march: &Table, output_step: f64, (cycle, automatic): (f64, bool)) {
    if !march.has("output_step") || cycle / output_step >= LEAST_STEPS * (1.0 - 1e-9) {
        return;
    }
    let message = format!(
        "a cycle of {} s has {} rows of `output_step`: at least {LEAST_STEPS} are needed to resolve it",
        three_digits(cycle, f64::round),
        three_digits(cycle / output_step, f64::round)
    );
    let step = three_digits(cycle / LEAST_STEPS, f64::floor);
    let multiple = if automatic { "" } else { ", a multiple of `time_step`" };
    let help = format!("write `output_step = \"{step} s\"` or less{multiple}");
    refuse(march, "output_step", message, help);
}

/// Refuses the value of a key, at its place or, where it is not given, at that of the table.
fn refuse(march: &Table, key: &str, message: impl Into<String>, help: String) {
    march.push(march.written(key).error_here(Code::BAD_VALUE, message).help(help));
}

/// A positive number with three digits, rounded by `round`.
fn three_digits(value: f64, round: fn(f64) -> f64) -> String {
    let place = 10f64.powf(value.log10().floor() - 2.0);
    // The quotient of a number of three digits may be less than it by rounding.
    plain(round(value / place + 1e-9) * place)
}

/// Steps of the march; only those that are counted, where none is known.
fn steps(march: &Table, step: &Step) -> usize {
    let (time_step, known, key) = (step.given.unwrap_or(1.0), step.given.is_some(), step.key);
    let (steps, duration) = (march.optional_count("steps"), march.quantity("duration"));
    match (march.has("steps"), march.has("duration")) {
        (true, true) if key == "time_step" => march.conflict("steps", "duration"),
        (false, false) if key == "output_step" => {
            march.absent("duration", "add `duration = \"0.1 s\"`");
        }
        (false, false) => march.absent("steps", "add `steps = 1000` or `duration = \"0.1 s\"`"),
        _ => {}
    }
    let Some(duration) = duration else { return steps.unwrap_or(1) };
    if steps.is_none() && known && duration < time_step * (1.0 - 1e-9) {
        let message = format!("`duration` is shorter than `{key}`: it has no whole step");
        let help = format!("lower `{key}` to {} s at most, or raise `duration`", plain(duration));
        refuse(march, "duration", message, help);
        return 1;
    }
    let whole = (duration / time_step).round().max(1.0);
    if steps.is_none() && known && whole > MOST_STEPS as f64 {
        let most = MOST_STEPS as f64;
        let message = format!(
            "`duration` takes {} steps of `{key}`, more than the {MOST_STEPS} that are allowed",
            plain(whole)
        );
        let help = format!(
            "lower `duration` to {} s at most, or raise `{key}` to {} s at least",
            plain(most * time_step),
            plain(duration / most)
        );
        refuse(march, "duration", message, help);
        return 1;
    }
    steps.unwrap_or(whole as usize)
}

/// Steps from one row of the history to the next: `output_step` over `time_step`, a whole number.
fn output_every(march: &Table, time_step: Option<f64>, steps: usize) -> usize {
    let Some(output_step) = march.quantity("output_step") else { return 1 };
    let Some(time_step) = time_step else { return 1 };
    let (exact, most) = (output_step / time_step, steps as f64);
    let whole = exact.round().clamp(1.0, most);
    // Both are written in decimals: what is meant as a multiple is one to a few roundings.
    if (exact / whole - 1.0).abs() <= 1e-9 {
        return whole as usize;
    }
    let what = match exact > most {
        true => "is longer than the run".to_string(),
        false => format!("is {} steps of `time_step`, no whole number of them", plain(exact)),
    };
    let message = format!("`output_step` {what}: a row is written at the end of a step");
    let help = format!("write `output_step = \"{} s\"`", plain(whole * time_step));
    refuse(march, "output_step", message, help);
    1
}

/// A number without the digits that rounding adds.
fn plain(value: f64) -> String {
    whirl_text::shown(value, 10, 1e-4..1e9)
}
