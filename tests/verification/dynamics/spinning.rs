//! A mass that turns in a frame at rest: laws get its angle and its speed.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use num_dual::{Dual64, DualNum};
use whirl_solver::dynamics::{March, march};
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::LAWS;

use super::audit::{audit, pairs, strict};
use super::contacts::{FILM, Formula, MOMENT, RING};
use super::equations::{random_state, worst_column};
use super::{boxed, force, options, parts, stops};
use whirl_solver::bearing::{Bearing, SpringLaw};
use whirl_solver::machine::MachineParts;

const SPEED: f64 = 400.0;

/// A mass of 1 kg in the middle of what acts all around it.
fn mass(law: Box<dyn SpringLaw>, rotation: Rotation, load: [f64; 3]) -> MachineParts {
    let shaft = Shaft::lumped(1.0, [0.0; 2], [0.0; 2], 0.0);
    let mut parts = parts(shaft, Support::rigid(&[]), rotation);
    parts.laws = vec![law];
    let angles = [0.3, 1.4, 2.5, 4.0, 5.2];
    let around = stops("around", 5e-5, &angles, 0);
    parts.bearings = vec![Bearing { journal_radius: Some(0.025), ..around }];
    let node = &parts.bodies[0].nodes()[0];
    parts.loads = vec![force(node, load, TimeFunction::Constant, Frame::Space)];
    parts
}

#[test]
fn the_tangent_is_minus_the_derivative_of_the_residual() {
    for law in [&RING, &FILM] {
        let spinning = Rotation::Spinning { speed: SPEED };
        let machine =
            Machine::new(mass(Box::new(law), spinning, [1.0, 2.0, 0.0])).expect("a machine");
        for seed in 1..4 {
            let state = random_state(machine.size(), seed);
            let (coarse, fine) =
                (worst_column(&machine, &state, 1e-2), worst_column(&machine, &state, 1e-3));
            // Without that of θ, which is given.
            for (j, (coarse, fine)) in coarse.iter().zip(&fine).enumerate().skip(1) {
                assert!(*fine < 2e-5, "{} {seed} column {j}: {fine}", law.name);
                assert!(*fine <= 0.02 * coarse + 1e-9, "{} column {j}: {coarse} {fine}", law.name);
            }
        }
    }
}

#[test]
fn every_step_of_a_spinning_mass_is_solved() {
    for pair in pairs().iter().skip(4) {
        let spinning = Rotation::Spinning { speed: 60.0 };
        let parts = mass(Box::new(pair.law), spinning, [-30.0, 20.0, 0.0]);
        let mut options = strict(1e-4, 500);
        [options.initial[0].position, options.initial[0].velocity] =
            [vec![1e-5, 0.0], vec![0.1, -0.2]];
        audit(pair.law.name, parts, &[&pair.direct], &options);
    }
}

/// A journal at 400 rad/s on the half film of a short bearing stands where the film carries the load: at the
/// eccentricity ratio ε with W = μ ω R L³/(4 c²) · ε √(16 ε² + π² (1 − ε²))/(1 − ε²)², at the attitude angle
/// tan φ = π √(1 − ε²)/(4 ε) (Ocvirk). A film that is not given the
/// speed carries nothing.
#[test]
fn a_spinning_journal_is_carried_by_its_film() {
    let ocvirk = LAWS.iter().find(|law| law.origin.name == "ocvirk").expect("a shipped law");
    let (radius, length, c, mu) = (0.025, 0.02_f64, 5e-5_f64, 0.02);
    let carried = |e: f64| {
        let side = 1.0 - e * e;
        mu * SPEED * radius * length.powi(3) / (4.0 * c * c)
            * e
            * (16.0 * e * e + PI * PI * side).sqrt()
            / (side * side)
    };
    let ratio = 0.6;
    let spinning = Rotation::Spinning { speed: SPEED };
    let mut parts = mass(boxed(ocvirk), spinning, [-carried(ratio), 0.0, 0.0]);
    parts.bearings[0].angles = Vec::new();
    let machine = Machine::new(parts).expect("a machine");
    let outcome = march(&machine, &options(1e-4, 5000), &mut |_| ControlFlow::Continue(()));
    let history = outcome.unwrap_or_else(|failure| panic!("{}", failure.error)).history;
    let last = |name: &str| *history.column(name).expect("a column").last().expect("a row");
    let (x, y) = (1e-6 * last("EX1_um"), 1e-6 * last("EY1_um"));
    assert!((x.hypot(y) / c - ratio).abs() < 1e-5, "{x} {y}");
    // The journal turns from x to y: it is carried that way, off the load along −x.
    let attitude = (PI * (1.0 - ratio * ratio).sqrt() / (4.0 * ratio)).atan();
    let found = y.atan2(x) - PI;
    assert!((found.sin() - attitude.sin()).abs() < 1e-4, "{found} for {attitude}");
    assert!((last("RX1_N") / carried(ratio) - 1.0).abs() < 1e-6);
    assert_eq!((last("omega_rad_s"), last("theta_rad")), (SPEED, SPEED * last("t_s")));
}

/// A law that takes no speed does the same where nothing turns.
#[test]
fn a_spin_that_no_law_takes_changes_nothing() {
    let run = |rotation| {
        let mut parts = mass(Box::new(pairs()[1].law), rotation, [-30.0, 20.0, 0.0]);
        parts.bearings[0].journal_radius = None;
        let machine = Machine::new(parts).expect("a machine");
        let mut options = strict(1e-4, 200);
        options.initial[0].velocity = vec![0.3, 0.1];
        let outcome = march(&machine, &options, &mut |_| ControlFlow::Continue(()));
        outcome.unwrap_or_else(|failure| panic!("{}", failure.error)).history
    };
    let (spinning, held) = (run(Rotation::Spinning { speed: SPEED }), run(Rotation::Held));
    for name in ["X1_um", "Y1_um", "RX1_N", "RY1_N"] {
        let (spinning, held) = (spinning.column(name).unwrap(), held.column(name).unwrap());
        let largest = held.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        for (a, b) in spinning.iter().zip(held) {
            assert!((a - b).abs() <= 1e-11 * largest, "{name}: {a} for {b}");
        }
    }
}

/// What turns the mass against a moment does its work on no coordinate: the load's work is all kinetic energy.
#[test]
fn what_drives_a_spin_is_no_part_of_the_energy() {
    let spinning = Rotation::Spinning { speed: SPEED };
    for law in [&MOMENT, &DRAG] {
        let mut parts = mass(Box::new(law), spinning.clone(), [3.0, 0.0, 0.0]);
        parts.bearings[0].angles = (0..4).map(|k| f64::from(k) * PI / 2.0).collect();
        let machine = Machine::new(parts).expect("a machine");
        let outcome = march(&machine, &strict(1e-5, 200), &mut |_| ControlFlow::Continue(()));
        let energy = outcome.unwrap_or_else(|failure| panic!("{}", failure.error)).energy;
        assert!(
            energy.kinetic > 1e-9 && energy.error_fraction() < 1e-6,
            "{}: {energy:?}",
            law.name
        );
        let lost = energy.spring_dissipated.abs() + energy.spring_stored.abs();
        assert!(lost < 1e-6 * energy.kinetic, "{}: {energy:?}", law.name);
    }
}

/// Equal at all springs: around the bore they sum to a moment and nothing else.
static DRAG: Formula = Formula {
    name: "drag",
    inputs: &["v_t"],
    outputs: &["Q", "T"],
    value: |z| vec![Dual64::from_re(0.0), z[0] * 0.0 - 2.0],
};

/// Stiffer outwards.
static STIFFENING: Formula = Formula {
    name: "stiffening",
    inputs: &["e_x", "e_y"],
    outputs: &["F_x", "F_y"],
    value: |z| {
        let stiffness = (z[0] * z[0] + z[1] * z[1]) * 4e12 + 1e4;
        vec![-stiffness * z[0], -stiffness * z[1]]
    },
};

/// On a circle nothing flows and nothing is made, however much each of the two forces does.
#[test]
fn a_circular_whirl_makes_no_energy() {
    let parts = mass(Box::new(&STIFFENING), Rotation::Held, [0.0; 3]);
    let machine = Machine::new(parts).expect("a machine");
    let radius = 5e-5;
    let omega = (1e4 + 4e12 * radius * radius).sqrt();
    let mut options = strict(0.05 / omega, 4000);
    [options.initial[0].position, options.initial[0].velocity] =
        [vec![radius, 0.0], vec![0.0, omega * radius]];
    let outcome = march(&machine, &options, &mut |_| ControlFlow::Continue(()));
    let quality = outcome.unwrap_or_else(|failure| panic!("{}", failure.error)).quality;
    assert!(quality.energy_made_share < 0.02, "{quality:?}");
}

/// Along x by the angle, along y by the speed, which the journal would not have at rest.
static TURNING: Formula = Formula {
    name: "turning",
    inputs: &["theta", "omega"],
    outputs: &["F_x", "F_y"],
    value: |z| vec![z[0].cos() * 3.0, z[1] * 0.01],
};

/// The spring holds what the push along x takes from the mass; the other is lost. With 50 steps a radian both are
/// kinetic energy to (1/50)²/12.
#[test]
fn work_by_angle_is_stored_and_work_by_speed_is_not() {
    let parts = mass(Box::new(&TURNING), Rotation::Spinning { speed: SPEED }, [0.0; 3]);
    let machine = Machine::new(parts).expect("a machine");
    let mut march = March::new(&machine, &strict(0.02 / SPEED, 0)).expect("starts");
    let mut largest = 0.0;
    for _ in 0..400 {
        march.advance().unwrap_or_else(|error| panic!("{error}"));
        let kinetic = [1, 2].map(|i| 0.5 * march.state().v[i].powi(2));
        largest = f64::max(largest, kinetic[0]);
        let energy = march.energy();
        let [along_x, along_y] = [energy.spring_stored, energy.spring_dissipated];
        assert!((along_x + kinetic[0]).abs() < 1e-3 * largest, "{along_x} {kinetic:?}");
        assert!((along_y + kinetic[1]).abs() < 1e-9 * kinetic[1], "{along_y} {kinetic:?}");
    }
}
