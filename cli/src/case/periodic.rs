//! What an analysis of the kind `periodic` says beside the others: how the motion over a cycle is looked for.

use whirl_codegen::diagnostic::Code;
use whirl_codegen::document::Table;
use whirl_solver::periodic::Method;

/// Steps of a cycle that a case may ask for.
pub(super) const STEPS: [usize; 2] = [8, 100_000];
/// Cycles that may be marched, and common periods in one.
pub(super) const MOST_MARCHED: usize = 100_000;
pub(super) const MOST_PERIODS: usize = 64;
/// Words of `method` and `begin`.
pub(super) const METHODS: &[&str] = &["accelerated", "shooting"];
pub(super) const BEGINNINGS: &[&str] = &["equilibrium", "rest"];
/// Keys that other kinds of analysis have no use for.
const KEYS: [&str; 6] = ["steps", "method", "marched", "periods", "begin", "cycles"];
/// Cycles in which a motion is looked for, where the case does not say it.
const CYCLES: usize = 400;

/// How a periodic motion is looked for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PeriodicKeys {
    /// Steps of a cycle; those nearest to the time step of the march if there are none.
    pub(crate) steps: Option<usize>,
    /// By which method; the one that takes less time if there is none.
    pub(crate) method: Option<Method>,
    /// Cycles that are marched first.
    pub(crate) marched: Option<usize>,
    /// Common periods of loads and speeds in a cycle.
    pub(crate) periods: usize,
    /// Where it begins; in equilibrium if there is one, and at rest otherwise, if there is none.
    pub(crate) begin: Option<Beginning>,
    /// Cycles at most.
    pub(crate) cycles: usize,
}

/// Where the search begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Beginning {
    /// Where the loads of the start are balanced.
    Equilibrium,
    /// At rest, as the case has its bodies at t = 0.
    Rest,
}

impl Default for PeriodicKeys {
    fn default() -> Self {
        PeriodicKeys {
            steps: None,
            method: None,
            marched: None,
            periods: 1,
            begin: None,
            cycles: CYCLES,
        }
    }
}

/// Notes keys of a periodic analysis in a table of another kind.
pub(super) fn refuse(table: &Table) {
    for key in KEYS.into_iter().filter(|key| table.has(key)) {
        let message = format!("`{key}` is of an analysis of the kind `periodic`");
        let help = "write `kind = \"periodic\"`, or leave it out";
        table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
        table.pass_over(key);
    }
}

/// Reads what the kind `periodic` asks for.
pub(super) fn read(table: &Table) -> PeriodicKeys {
    let usual = PeriodicKeys::default();
    let place = |key: &str, words: &[&str]| {
        let word = table.optional_word(key)?;
        words.iter().position(|own| *own == word)
    };
    PeriodicKeys {
        steps: table.optional_count("steps"),
        method: place("method", METHODS).map(|own| [Method::Accelerated, Method::Shooting][own]),
        marched: table.optional_count("marched"),
        periods: table.optional_count("periods").unwrap_or(usual.periods),
        begin: place("begin", BEGINNINGS).map(|own| [Beginning::Equilibrium, Beginning::Rest][own]),
        cycles: table.optional_count("cycles").unwrap_or(usual.cycles),
    }
}
