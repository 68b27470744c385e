//! Small motions with states, against state spaces of their own.

use nalgebra::{Complex, DMatrix};
use whirl_solver::linear::{LinearMachine, Linearised};
use whirl_solver::loads::TimeFunction;
use whirl_solver::machine::Rotation;

use super::{MASS, ON_MOUNT, RELAXING, SLOW, TAU, Taped, mass_on, shipped, with_states};

/// The mass turns, which a point does not feel: motions are those of a mass that does not.
fn turning(law: Box<dyn whirl_solver::bearing::SpringLaw>) -> LinearMachine {
    let turning = Rotation::Prescribed { speed: 300.0, acceleration: 0.0 };
    let machine = mass_on(law, (0.0, TimeFunction::Constant), turning);
    LinearMachine::new(machine).unwrap_or_else(|error| panic!("{error}"))
}

fn linearised(machine: &LinearMachine, speed: f64) -> Linearised {
    let at = machine.standing(&[Some(speed), None], None).unwrap_or_else(|error| panic!("{error}"));
    machine.linearised(&at).unwrap_or_else(|error| panic!("{error}"))
}

/// λ with Im λ > 0 of the modes.
fn found(machine: &LinearMachine, speed: f64) -> Vec<Complex<f64>> {
    let modes = machine.modes(&linearised(machine, speed), 10).expect("has modes");
    let all = modes.oscillating.iter().map(|own| Complex::new(own.value.re, own.value.im));
    all.collect()
}

/// The same of a matrix of rates.
fn exact(rates: &DMatrix<f64>) -> Vec<Complex<f64>> {
    let all = rates.complex_eigenvalues();
    let mut all: Vec<Complex<f64>> = all.iter().copied().filter(|own| own.im > 0.0).collect();
    all.sort_by(|a, b| a.im.total_cmp(&b.im));
    all
}

fn agree(found: &[Complex<f64>], exact: &[Complex<f64>]) {
    assert_eq!(found.len(), exact.len(), "{found:?} {exact:?}");
    for own in exact {
        let apart = found.iter().map(|found| (found - own).norm()).fold(f64::INFINITY, f64::min);
        assert!(apart < 1e-8 * own.norm(), "{own}: {found:?}");
    }
}

#[test]
fn modes_on_a_mount_that_relaxes_are_those_of_its_state_space() {
    let machine = turning(shipped("zener-mount"));
    let one = DMatrix::from_row_slice(3, 3, &ON_MOUNT);
    let exact = exact(&one);
    let both: Vec<Complex<f64>> = exact.iter().chain(&exact).copied().collect();
    for speed in [0.0, 300.0, -1000.0] {
        agree(&found(&machine, speed), &both);
    }
}

/// At a frequency the mount has its dynamic stiffness, at speed as at rest, and relaxed it has that of slow motion.
#[test]
fn at_a_frequency_the_equations_have_the_dynamic_stiffness() {
    let machine = turning(shipped("zener-mount"));
    for speed in [0.0, 300.0] {
        let equations = linearised(&machine, speed);
        assert!(equations.depends_on_frequency());
        for omega in [0.0, 40.0, 500.0, 6000.0] {
            let held = equations.at_frequency(omega);
            let lag = Complex::new(0.0, omega * TAU);
            let stiffness = SLOW + RELAXING * lag / (1.0 + lag);
            for i in 0..2 {
                for j in 0..2 {
                    let own = if i == j { stiffness } else { Complex::new(0.0, 0.0) };
                    // The rule of the turning frame leaves −Ω² M of what turns in K′: none of a point in space.
                    let found = Complex::new(held.stiffness[(i, j)], omega * held.damping[(i, j)]);
                    assert!((found - own).norm() < 1e-8 * SLOW, "{speed} {omega}: {found} {own}");
                }
            }
        }
    }
}

/// States that hang on each other and on rates, unlike in both directions, about a state off the middle: a law's own derivatives,
/// put together here.
const CROSSED: &str = "[rates]
z = '(e_x - z*(1 + z/a))/tau + 0.3*e_y_dot'
w = '(k*(e_y + z) - w - c*e_x_dot)/tau'
[outputs]
F_x = { unit = \"N\", value = '-k*e_x*(1 + z/a) - c*e_x_dot - w' }
F_y = { unit = \"N\", value = '-k*(e_y + z) - w*0.2 - c*e_y_dot' }
";

#[test]
fn modes_with_crossed_states_are_those_of_a_state_space_of_ones_own() {
    let law = Taped::new(&with_states("\"rest\"", CROSSED));
    let tape = law.tape.clone();
    let machine = turning(Box::new(law));
    let mut rows = vec![0.0; tape.outputs()];
    // Unloaded it stands in the middle, its states at rest: rows of e, ė, z, w behind each value.
    tape.evaluate(1, &[0.0; 6], &mut rows, &mut vec![0.0; tape.workspace()]);
    let slope = |output: usize, by: usize| rows[output * 7 + 1 + by];
    let rates = DMatrix::from_fn(6, 6, |i, j| match (i, j) {
        // x, y, ẋ, ẏ, z, w.
        (0 | 1, _) => f64::from(u8::from(j == i + 2)),
        (2 | 3, _) => slope(i - 2, j) / MASS,
        _ => slope(i - 2, j),
    });
    let exact = exact(&rates);
    assert!(!exact.is_empty());
    for speed in [0.0, 300.0] {
        let found = found(&machine, speed);
        let listed = |own: &Complex<f64>| -own.re < 0.9 * own.norm();
        let exact: Vec<Complex<f64>> = exact.iter().copied().filter(listed).collect();
        agree(&found, &exact);
    }
}

/// F_0 (N), s_0 (m), P (1/m), I (1/(m·s)), D (s/m), tau_d, tau_a (s) and leak (1/s) of the shipped magnetic bearings.
const MAGNET: f64 = 200.0;
const GAP: f64 = 0.5e-3;
const GAINS: [f64; 3] = [5e3, 2e4, 5.0];
const FILTER: f64 = 1e-4;
const AMPLIFIER: f64 = 2e-4;
const LEAK: f64 = 0.2;

/// Rates of e, ė, q, d and c of a mass in one direction of a magnetic bearing.
pub(super) fn magnetic() -> DMatrix<f64> {
    let [p, i, d] = GAINS;
    let force = 4.0 * MAGNET / MASS;
    #[rustfmt::skip]
    let rates = DMatrix::from_row_slice(5, 5, &[
        0.0, 1.0, 0.0, 0.0, 0.0,
        force / GAP, 0.0, 0.0, 0.0, force,
        1.0, 0.0, -LEAK, 0.0, 0.0,
        1.0 / FILTER, 0.0, 0.0, -1.0 / FILTER, 0.0,
        -(p + d / FILTER) / AMPLIFIER, 0.0, -i / AMPLIFIER, d / FILTER / AMPLIFIER, -1.0 / AMPLIFIER,
    ]);
    rates
}

/// Both laws, the one with the full force of its magnets about the centre.
#[test]
fn modes_on_magnetic_bearings_are_those_of_their_state_space() {
    let exact = exact(&magnetic());
    let listed = |own: &Complex<f64>| -own.re < 0.9 * own.norm();
    let exact: Vec<Complex<f64>> = exact.into_iter().filter(listed).collect();
    assert!(!exact.is_empty() && exact.iter().all(|own| own.re < 0.0), "{exact:?}");
    let both: Vec<Complex<f64>> = exact.iter().chain(&exact).copied().collect();
    for name in ["magnetic-bearing", "magnetic-bearing-linear"] {
        let machine = turning(shipped(name));
        for speed in [0.0, 300.0] {
            agree(&found(&machine, speed), &both);
        }
    }
}
