//! A run that was interrupted and resumed leaves what a whole one leaves, to the bit: of every built-in case, however it starts
//! and whoever chooses its steps.

use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use serde_json::Value;
use whirl_solver::cache::Cache;

use super::{FolderStore, Watch, simulate};
use crate::case::{Case, CaseText};
use crate::checkpoint::{self, Identity};
use crate::errors::Failure;
use crate::machine::Built;
use crate::results::{Results, STATE, SUMMARY};
use crate::{built_in_cases, history};

/// Steps of a run, and those after which it is interrupted: among those that are sampled all, and beyond.
const STEPS: usize = 160;
const CUTS: [usize; 2] = [41, 139];

/// Interrupts a run after so many steps.
struct After(usize, Cell<usize>);

impl Watch for After {
    fn progressed(&self, step: usize, _: f64) {
        self.1.set(step);
    }

    fn asked(&self) -> bool {
        self.1.get() >= self.0
    }
}

/// Marches a case into a folder, from its point if it has one, up to a step.
fn march(case: &Case, built: &Built, folder: &Path, upto: usize) -> Result<(), Failure> {
    let mut results = Results::open(folder, &mut Vec::new())?;
    let identity = Identity::of(case, built);
    let from = checkpoint::read(&results, &identity)?;
    let watch = After(upto, Cell::new(0));
    let mut store = FolderStore::new((case, built), &mut results, identity, from.as_ref());
    let simulated = simulate((case, built), &mut store, from, (&watch, Instant::now()))?;
    drop(store);
    results.write(SUMMARY, simulated.made.expect("a history").json().as_bytes()).expect("a file");
    Ok(())
}

/// What a run leaves: its summary without times, its history, and its last state.
fn left(folder: &Path) -> (Value, Vec<u8>, Vec<u8>) {
    let read = |name: &str| fs::read(folder.join(name)).expect(name);
    let mut summary: Value = serde_json::from_slice(&read(SUMMARY)).expect("JSON");
    summary.as_object_mut().expect("a table").remove("time");
    (summary, read(history::NAME), read(STATE))
}

/// A short run of a built-in case, with lines of its start; none where such a case does not start so.
fn case(folder: &Path, (name, automatic): (&str, bool), start: &str) -> Result<Case, Failure> {
    let own = crate::read(name, &mut Vec::new())?;
    let dt = own.march().time_step;
    let steps = match automatic {
        true => format!("time_step = \"auto\"\noutput_step = \"{dt:e} s\"\n"),
        false => String::new(),
    };
    let length = match name.starts_with("hu2003") && !automatic {
        true => format!("steps = {STEPS}\n"),
        false => format!("duration = \"{:e} s\"\n", STEPS as f64 * dt),
    };
    let text = format!(
        "include = \"{name}.toml\"\ntitle = \"a short run\"\n{start}\n[march]\n{steps}{length}"
    );
    let text = CaseText::new("short", folder, text);
    crate::read_text(&text, &mut Vec::new())
}

#[test]
fn a_resumed_run_leaves_what_a_whole_one_leaves() {
    let bench = tempfile::tempdir().expect("a temporary folder");
    let folder = |name: &str| -> PathBuf { bench.path().join(name) };
    let cache = Cache::shared(Some(Cache::new(folder("cache"))));
    let mut without = Vec::new();
    let mut runs = 0;
    for name in built_in_cases() {
        for automatic in [false, true] {
            let key = |what: &str| format!("{name}-{automatic}-{what}");
            let turned = if name.starts_with("hu2003") { "speed = \"4500 rpm\"\n" } else { "" };
            let first = folder(&key("rest"));
            for (kind, start) in [
                ("rest", String::new()),
                ("equilibrium", format!("[start]\nkind = \"equilibrium\"\n{turned}")),
                ("from", format!("[start]\nkind = \"state\"\nfrom = \"{}\"\n", first.display())),
            ] {
                let whole = folder(&key(kind));
                let done = case(bench.path(), (name, automatic), &start).and_then(|case| {
                    let built = crate::build(&case, Some(&cache), &mut Vec::new())?;
                    march(&case, &built, &whole, usize::MAX)?;
                    Ok((case, built))
                });
                let (case, built) = match done {
                    Ok(done) => done,
                    Err(error) => {
                        assert_ne!(kind, "rest", "{name}: {}", error.report());
                        println!("{}: {}", key(kind), error.report());
                        without.push(key(kind));
                        continue;
                    }
                };
                for cut in CUTS {
                    let resumed = folder(&key(&format!("{kind}-{cut}")));
                    for upto in [cut, usize::MAX] {
                        let done = march(&case, &built, &resumed, upto);
                        done.unwrap_or_else(|error| panic!("{}", error.report()));
                    }
                    let [whole, resumed] = [&whole, &resumed].map(|own| left(own));
                    assert_eq!(resumed.0, whole.0, "{name} {automatic} {kind} {cut}");
                    assert!(resumed == whole, "{name} {automatic} {kind} {cut}: other bytes");
                    runs += 1;
                }
            }
        }
    }
    println!("{runs} runs resumed; no equilibrium: {without:?}");
    // Masses begin as their table says.
    let masses = ["annular-rub", "sdnd101", "sdnd108"];
    without.retain(|own| !masses.iter().any(|mass| own.starts_with(mass)));
    // Without weight its journals touch nothing where they are in their clearances.
    without.retain(|own| !(own.starts_with("two-spool") && own.ends_with("equilibrium")));
    assert!(without.is_empty() && runs > 100, "{without:?}");
}
