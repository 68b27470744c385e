//! What is found of periodic motions.

use whirl_solver::history::History;
use whirl_solver::periodic::{Periodic, Repeating};

use crate::case::{Analysis, Case};
use crate::report::VerdictFacts;

/// A periodic motion at a speed.
pub(super) struct Motion {
    /// Of the body whose speed it is (rad/s); none where the case has the speeds.
    pub(super) speed: Option<f64>,
    /// What repeats in a cycle.
    pub(super) repeating: Vec<Repeating>,
    pub(super) periodic: Periodic,
    pub(super) verdict: VerdictFacts,
    /// Names of the columns of its rows.
    pub(super) columns: Vec<String>,
}

/// The motions of a case, and those that were not found.
pub(super) struct Motions<'a> {
    pub(super) case: &'a Case,
    pub(super) analysis: &'a Analysis,
    pub(super) of: Option<usize>,
    pub(super) all: Vec<Motion>,
    /// Speeds (rad/s) with why there is nothing.
    pub(super) lost: Vec<(Option<f64>, String)>,
    /// What is to be known of all.
    pub(super) notes: Vec<String>,
}

/// Whether the range of a column says something: not that of angles, which go on, and of iterations.
pub(super) fn is_summed_up(column: &str) -> bool {
    column != "t_s" && column != "iterations" && !column.starts_with("theta_")
}

/// Least and largest value of a column.
pub(super) fn range(history: &History, column: usize) -> [f64; 2] {
    let values = (0..history.rows()).map(|row| history.values(row)[column]);
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], own| {
        [least.min(own), most.max(own)]
    })
}
