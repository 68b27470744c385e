//! Oil films of whole rings inside a step: Newton's method with fresh factors sees all their derivatives.

use whirl_solver::bearing::Bearing;
use whirl_solver::dynamics::March;
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::support::Support;
use whirl_specs::LAWS;

use super::{bearing, bores, boxed, discs, force, options, parts};

/// Residual, as the march measures it (√J), from which iterations are compared; predictions beyond the wall
/// leave millions of times as much.
const NEAR: f64 = 0.05;

/// A derivative that is missing, of a velocity or of the torque say, leaves a rate of convergence; where all
/// are there the number of right digits doubles. (With kept factors a step takes two or three times as many
/// iterations: those contract by up to a fifth each.)
#[test]
fn full_newton_converges_quadratically_in_oil_films() {
    for name in ["ocvirk", "squeeze-film-damper", "squeeze-film-damper-full"] {
        let law = LAWS.iter().find(|law| law.origin.name == name).expect("a shipped law");
        let (mut measured, mut gained) = (0, [0.0; 2]);
        for vibrating in [false, true] {
            let (support, bore) = match vibrating {
                true => (bores(), bearing(0).bore),
                false => (Support::rigid(&[]), Default::default()),
            };
            let mut parts = parts(discs(1e6), support, Rotation::Free);
            parts.laws = vec![boxed(law)];
            parts.bearings = vec![Bearing { bore, clearance: 5e-5, ..bearing(0) }];
            let sine = TimeFunction::Sine { frequency: 80.0, phase: 0.3 };
            parts.loads = vec![
                force(
                    &parts.bodies[0].nodes()[2],
                    [600.0, 200.0, 0.0],
                    TimeFunction::Constant,
                    Frame::Space,
                ),
                force(&parts.bodies[0].nodes()[1], [0.0, 300.0, 0.0], sine, Frame::Space),
            ];
            let machine = Machine::new(parts).expect("a machine");
            let mut options = options(1e-3, 12);
            options.initial[0].speed = 300.0;
            options.newton.keep_factors = false;
            let mut march = March::new(&machine, &options).expect("starts");
            for _ in 0..options.steps {
                march.advance().unwrap_or_else(|error| panic!("{name}: {error}"));
                let r = march.residuals();
                // From where an iteration takes off most of the residual down to where rounding takes over;
                // before, the journal may be beyond the wall, where the film is another.
                let rounding = 100.0 * r[r.len() - 1];
                let near = |w: &&[f64]| w[0] <= NEAR && w[1] <= 0.05 * w[0] && w[2] >= rounding;
                for w in r.windows(3).filter(near) {
                    gained[0] += (w[1] / w[0]).ln();
                    gained[1] += (w[2] / w[1]).ln();
                    measured += 1;
                }
            }
        }
        assert!(measured >= 6, "{name}: {measured} times only the steps are large enough");
        // Digits gained by an iteration over those by the one before, on average: the factor of the square
        // depends on the direction from which the solution is met, by a few tenths of the order. It is 1 if
        // any derivative is missing.
        let order = gained[1] / gained[0];
        println!("{name}: order {order:.3} from {measured}");
        assert!((1.8..2.2).contains(&order), "{name}: order {order}");
    }
}
