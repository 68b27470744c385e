//! EX and EY of a history are the eccentricity that laws see. A ring that pushes with F = −k e knows it.

use std::ops::ControlFlow;

use whirl_solver::bearing::{Bearing, SpringLaw};
use whirl_solver::dynamics::march;
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};

use super::{bearing, bores, discs, force, options, parts};

/// k along x and along y (N/m): alike, as the axes of a law turn with its bore.
const STIFFNESS: [f64; 2] = [5e5; 2];

/// F_x = −k e_x, F_y = −k e_y.
struct Linear;

impl SpringLaw for Linear {
    fn name(&self) -> &str {
        "linear"
    }
    fn hash(&self) -> &str {
        ""
    }
    fn inputs(&self) -> Vec<&str> {
        vec!["e_x", "e_y"]
    }
    fn outputs(&self) -> Vec<&str> {
        vec!["F_x", "F_y"]
    }
    fn workspace(&self) -> usize {
        0
    }
    fn evaluate(&self, springs: usize, e: &[f64], outputs: &mut [f64], _: &mut [f64]) {
        // Of each output its value, then its derivative by each input, a row each.
        let mut rows = outputs.chunks_exact_mut(springs);
        for (output, stiffness) in STIFFNESS.into_iter().enumerate() {
            let values = rows.next().expect("a row of values");
            for (value, e) in values.iter_mut().zip(&e[output * springs..]) {
                *value = -stiffness * e;
            }
            for input in 0..2 {
                let slope = if input == output { -stiffness } else { 0.0 };
                rows.next().expect("a row of slopes").fill(slope);
            }
        }
    }
}

/// The nodes of the bores stand unevenly around, so that their plain mean moves when the ring turns, and the
/// support moves them in any way.
#[test]
fn the_eccentricity_of_a_history_is_the_one_that_laws_see() {
    let mut parts = parts(discs(1e5), bores(), Rotation::Free);
    parts.laws = vec![Box::new(Linear)];
    parts.bearings = vec![Bearing { stations: vec![0.5], ..bearing(0) }];
    let sine = TimeFunction::Sine { frequency: 60.0, phase: 0.4 };
    parts.loads =
        vec![force(&parts.bodies[0].nodes()[2], [200.0, -300.0, 0.0], sine, Frame::Space)];
    let machine = Machine::new(parts).expect("a machine");
    let mut options = options(2e-4, 300);
    options.initial[0].speed = 80.0;
    let outcome = march(&machine, &options, &mut |_| ControlFlow::Continue(()));
    let history = outcome.unwrap_or_else(|failure| panic!("{}", failure.error)).history;
    let column = |name: &str| history.column(name).expect("a column");
    let peak = |values: &[f64]| values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    for (axis, stiffness) in ["X", "Y"].into_iter().zip(STIFFNESS) {
        let reaction = column(&format!("R{axis}1_N"));
        let (journal, eccentricity) =
            (column(&format!("{axis}1_um")), column(&format!("E{axis}1_um")));
        let bore: Vec<f64> = journal.iter().zip(&eccentricity).map(|(x, e)| x - e).collect();
        assert!(peak(&bore) > 0.1 * peak(&eccentricity), "along {axis} the bore hardly moves");
        // Four coordinates move the bore, ten the journal; a row adds their parts up in its own order.
        // The law's axes turn with the bore by β, of which its measures are linear: β² of the force is left, β of 5e-3 here.
        let turned = |force: &f64| 1e-4 * force.abs();
        let rounding = 1e-6 * stiffness * 32.0 * f64::EPSILON * (peak(&journal) + peak(&bore));
        for (row, (force, e)) in reaction.iter().zip(&eccentricity).enumerate() {
            let expected = -1e-6 * stiffness * e;
            assert!(
                (force - expected).abs() <= rounding + turned(force),
                "{axis} row {row}: {force} {expected}"
            );
        }
    }
}
