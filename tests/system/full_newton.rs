//! Every step of every shipped case is that of the plain method: full Newton with a dense matrix that is made and factored
//! anew in every iteration, from the same state.

use std::collections::BTreeMap;

use whirl_solver::cache::Cache;
use whirl_solver::dynamics::{March, MarchOptions, NewtonOptions};
use whirl_solver::history::History;

/// Steps of each case that are compared.
const STEPS: usize = 40;
/// Steps between those, so that shafts turn and springs switch.
const BETWEEN: usize = 20;

/// A row may differ by what both methods may leave: a force at each spring, a share of the largest value of its
/// unit so far.
const MISSING: f64 = 4e-3;
const SHARE: f64 = 1e-6;

#[test]
fn the_steps_of_all_shipped_cases_are_those_of_full_newton() {
    for name in whirl_cli::built_in_cases() {
        let mut warnings = Vec::new();
        let case =
            whirl_cli::read(name, &mut warnings).unwrap_or_else(|e| panic!("{}", e.report()));
        let built = whirl_cli::build(&case, Cache::of_platform().as_ref(), &mut warnings)
            .unwrap_or_else(|e| panic!("{name}: {}", e.report()));
        let (mut march, options) = whirl_cli::simulate::begin(&case, &built)
            .unwrap_or_else(|e| panic!("{name}: {}", e.report()));
        let plain = NewtonOptions { keep_factors: false, ..options.newton };
        let plain = MarchOptions { newton: plain, ..options };
        let columns = History::columns_of(built.machine());
        let mut largest: BTreeMap<&str, f64> = BTreeMap::new();
        let (mut compared, mut worst) = (0, (0.0, String::new()));
        while compared < STEPS && !march.is_done() {
            let is_compared = (march.progress().step + 1).is_multiple_of(BETWEEN);
            let before = is_compared.then(|| march.checkpoint());
            march.advance().unwrap_or_else(|error| panic!("{name}: {error}"));
            let own = march.row();
            for (column, own) in columns.iter().zip(own) {
                let most = largest.entry(&*column.unit).or_default();
                *most = most.max(own.abs());
            }
            let Some(before) = before else { continue };
            let mut full = March::resume(built.machine(), &plain, before)
                .unwrap_or_else(|error| panic!("{name}: {error}"));
            full.advance().unwrap_or_else(|error| panic!("{name}, full Newton: {error}"));
            compared += 1;
            for (place, column) in columns.iter().enumerate() {
                if column.name == "iterations" {
                    continue;
                }
                let difference = (own[place] - full.row()[place]).abs();
                // What does not turn but for rounding is not held to that.
                let least = if column.unit.starts_with("rad") { 1.0 } else { 0.0 };
                let size = f64::max(largest[&*column.unit], least);
                let missing = if column.unit == "N" { MISSING } else { 0.0 };
                let error = difference / (SHARE * size + missing);
                if error > worst.0 {
                    worst = (error, format!("{} at {:.4} s", column.name, march.time()));
                }
            }
        }
        println!(
            "{name}: {compared} steps, at most {:.3} of what may differ, {}",
            worst.0, worst.1
        );
        assert!(compared > 0 && worst.0 <= 1.0, "{name}: {worst:?}");
    }
}
