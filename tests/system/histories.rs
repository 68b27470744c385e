//! Histories of analyses 1 to 3 against an independent program, over the whole analysis.

use whirl_tests::History;
use whirl_tests::validation::Section;

use crate::run::{reference, shipped};

/// Largest difference from the reference as a fraction of the peak. Both programs solve the same equations of the
/// same time integration, each step to 1e-6 of its forces or better, and the reference is written in eight
/// digits; the differences of three analyses were measured as 1.5e-6 and less.
const SHARE: f64 = 2e-5;

/// Largest difference over `columns`, scaled by the largest reference value of all of them.
fn scaled_difference(ours: &History, theirs: &History, columns: &[String]) -> f64 {
    let scale = columns
        .iter()
        .flat_map(|name| theirs.column(name))
        .fold(0.0_f64, |largest, value| largest.max(value.abs()));
    columns
        .iter()
        .flat_map(|name| ours.column(name).iter().zip(theirs.column(name)))
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
    let mut section = Section::new(
        &format!("Histories of analysis {number} of Hu, Mourelatos and Vlahopoulos"),
        "An independent program: largest difference over all steps, as a share of the peak",
        &format!("cargo test -p whirl-cli --test system -- histories::analysis_{number}"),
    );
    for (what, columns) in
        [("reactions", starting(&['R'])), ("displacements", starting(&['X', 'Y']))]
    {
        let share = scaled_difference(ours, &theirs, &columns);
        section.compare(what, 0.0, share, SHARE);
    }
    // Of the speed that analysis 2 reaches, and of a radian; without a drive neither turns at all.
    for (name, scale) in [("theta_rad", 1.0), ("omega_rad_s", 471.2389)] {
        let rows = ours.column(name).iter().zip(theirs.column(name));
        let worst = rows.fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()));
        assert!(worst <= SHARE * scale, "analysis {number}: {name} differs by {worst}");
    }
    section.finish();
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
