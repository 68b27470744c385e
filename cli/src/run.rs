//! `whirl run`: a case from its file to its results.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use whirl_solver::dynamics::{MarchOptions, Newmark, NewtonOptions, Outcome, march};

use crate::arguments::{CacheArguments, RunArguments};
use crate::case::{Case, System};
use crate::errors::Failure;
use crate::machine::{self, Built};
use crate::output::Output;
use crate::report::{Summary, Times, history_csv, stops, supports};
use crate::{figures, progress};

/// Runs a case: read, build, march, report. What was computed is kept even if a step does not converge.
///
/// # Errors
/// Bad input, a folder that cannot be written, or a step that does not converge.
pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let start = Instant::now();
    let case = machine::read(&arguments.case)?;
    let mut output = Output::open(&folder(arguments, &case))?;
    let built = build(&case, &arguments.cache)?;
    let marched = march_through(&case, &built);
    let time = times(&built, &marched, start);
    let summary = Summary::new(&case, &built, &marched.outcome, time, marched.failure.clone());
    output.put("history.csv", history_csv(&marched.outcome.history));
    output.put("summary.json", summary.json());
    if !arguments.no_figures {
        figures::draw(&case, &marched.outcome.history, &built.clearances, &mut output);
    }
    let folder = output.commit()?;
    print!("{}", closing(&case, &summary, time, &folder));
    match marched.failure {
        None => Ok(()),
        Some(reason) => Err(Failure::NotConverged { reason, kept: folder }),
    }
}

fn folder(arguments: &RunArguments, case: &Case) -> PathBuf {
    let usual = || Path::new("results").join(&case.name);
    arguments.out.clone().unwrap_or_else(usual)
}

fn build(case: &Case, arguments: &CacheArguments) -> Result<Built, Failure> {
    let cache = arguments.open();
    let _spinner = progress::spinner("reducing shaft and support");
    machine::build(case, None, cache.as_ref())
}

/// A march to its end, or to the step that did not converge.
struct Marched {
    outcome: Outcome,
    failure: Option<String>,
    /// s.
    wall: f64,
}

fn march_through(case: &Case, built: &Built) -> Marched {
    let options = MarchOptions {
        time_step: case.march.time_step,
        steps: case.march.steps,
        newmark: Newmark::default(),
        newton: NewtonOptions {
            force_tolerance: case.march.force_tolerance,
            ..NewtonOptions::default()
        },
        cycle: case.march.steady_cycle(),
        stop_when_steady: false,
        initial_shaft: built.initial.clone(),
        initial_speed: 0.0,
    };
    let steps = progress::steps(case.march.steps);
    let start = Instant::now();
    let marched = march(&built.machine, &options, &mut |progress| {
        steps.done(progress.step, progress.time);
        ControlFlow::Continue(())
    });
    let wall = start.elapsed().as_secs_f64();
    match marched {
        Ok(outcome) => Marched { outcome, failure: None, wall },
        Err(failure) => {
            Marched { outcome: failure.outcome, failure: Some(failure.error.to_string()), wall }
        }
    }
}

fn times(built: &Built, marched: &Marched, start: Instant) -> Times {
    let history = &marched.outcome.history;
    let last = history.rows().checked_sub(1);
    let simulated = last.map_or(0.0, |row| history.row(row)[0]);
    let bodies = built.bodies.as_ref();
    Times {
        simulated_s: simulated,
        reduction_wall_s: bodies.map_or(0.0, |bodies| bodies.wall),
        march_wall_s: marched.wall,
        total_wall_s: start.elapsed().as_secs_f64(),
        real_time_factor: simulated / marched.wall,
        reduction_cached: bodies.is_some_and(|bodies| bodies.cached),
    }
}

/// What a run leaves on the terminal.
fn closing(case: &Case, summary: &Summary, time: Times, folder: &Path) -> String {
    let names = figures::support_names(case);
    let table = match case.system {
        System::Rotor(_) => supports(&names, &summary.supports),
        System::Lumped(_) => stops(&names, &summary.supports),
    };
    let steady = match summary.steady_time() {
        Some(time) => format!("steady from {time:.4} s"),
        None if case.march.steady_cycle().is_none() => {
            "not judged for a steady state: the run is shorter than two cycles".to_string()
        }
        None => "not steady".to_string(),
    };
    format!(
        "{}: {}\n\nlast cycle ({:.2} ms), {steady}\n{table}\n\
         {:.4} s simulated in {:.3} s ({:.3} of real time), reduction {:.2} s{}\n\
         results in {}\n",
        case.name,
        case.title,
        1e3 * case.march.cycle,
        time.simulated_s,
        time.march_wall_s,
        time.real_time_factor,
        time.reduction_wall_s,
        if time.reduction_cached { " (cached)" } else { "" },
        folder.display()
    )
}
