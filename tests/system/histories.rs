//! Histories of analyses 1 to 3 against an independent program, over the whole analysis.

use crate::run::{History, reference, shipped};

/// Rows of the reference over which the closer bound holds: the last cycle.
const LAST_CYCLE: usize = 361;

/// Largest difference over `columns`, scaled by the largest reference value of all of them.
fn scaled_difference(ours: &History, theirs: &History, columns: &[String], rows: usize) -> f64 {
    let scale = columns
        .iter()
        .flat_map(|name| theirs.column(name))
        .fold(0.0_f64, |largest, value| largest.max(value.abs()));
    columns
        .iter()
        .flat_map(|name| ours.tail(name, rows).iter().zip(theirs.tail(name, rows)))
        .fold(0.0_f64, |largest, (a, b)| largest.max((a - b).abs()))
        / scale
}

fn compare(number: usize) {
    let run = shipped(&format!("hu2003-{number}"));
    let (ours, theirs) = (&run.history, reference(number));
    assert_eq!(ours.names()[..theirs.names().len()], *theirs.names());
    assert_eq!(ours.rows(), theirs.rows());
    for (a, b) in ours.column("t_s").iter().zip(theirs.column("t_s")) {
        // The reference has eight digits.
        assert!((a - b).abs() <= 1e-7 * b.max(1e-3), "time {a} against {b}");
    }
    let starting = |letters: &[char]| -> Vec<String> {
        theirs.names()[3..].iter().filter(|name| name.starts_with(letters)).cloned().collect()
    };
    for (what, columns) in
        [("reactions", starting(&['R'])), ("displacements", starting(&['X', 'Y']))]
    {
        let whole = scaled_difference(ours, &theirs, &columns, theirs.rows());
        let cycle = scaled_difference(ours, &theirs, &columns, LAST_CYCLE);
        println!(
            "analysis {number}, {what}: {whole:.2e} over all, {cycle:.2e} over the last cycle"
        );
        assert!(whole <= 0.01, "analysis {number}: {what} differ by {whole} of their peak");
        assert!(cycle <= 0.0005, "analysis {number}: {what} of the last cycle differ by {cycle}");
    }
    for (row, (a, b)) in ours.column("theta_rad").iter().zip(theirs.column("theta_rad")).enumerate()
    {
        assert!((a - b).abs() <= 0.01, "row {row}: angle {a} against {b} rad");
    }
}

#[test]
fn analysis_1_static_loads_without_rotation() {
    compare(1);
}

#[test]
fn analysis_2_static_loads_with_rotation() {
    compare(2);
}

#[test]
fn analysis_3_sinusoidal_loads_without_rotation() {
    compare(3);
}
