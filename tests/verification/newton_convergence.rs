//! Newton's method inside a step: its order on the whole machine, a case where the plain method cycles, and
//! what a march that fails leaves behind.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use whirl_solver::Error;
use whirl_solver::bearing::{Bearing, Sides, SpringLaw};
use whirl_solver::body::BodyNode;
use whirl_solver::dynamics::{
    BodyStart, Failure, March, MarchOptions, NewtonOptions, Outcome, march,
};
use whirl_solver::loads::{Frame, Load, TimeFunction};
use whirl_solver::machine::{Body, Machine, MachineParts, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::CLEARANCES;

use crate::small_shaft::{
    CLEARANCE, JOURNALS, LawOf, bearings, journal, mesh, motion, options, shaft,
};

/// A ring of nodes of a bore around z = 0.
const BORE: usize = 6;

/// A spinning flexible shaft in a support that vibrates, on shells of Hertz-like springs below it (x is down
/// here), pressed in by 0.1 mm at rest and more by the load: Q = 100 MN/m^1.5 · (1.1 mm − h)^1.5. Not a
/// number out of contact, so that no spring can have switched.
/// `share`: of 70 kN.
fn on_hertz_springs(shaft: Shaft, share: f64) -> Machine {
    let law = LawOf("hertz", |h: f64| {
        let depth = 1.1 * CLEARANCE - h;
        [1e8 * depth.powf(1.5), -1.5e8 * depth.sqrt()]
    });
    let around = |k: usize| 2.0 * PI * k as f64 / BORE as f64;
    let positions: Vec<[f64; 3]> = JOURNALS
        .as_flattened()
        .iter()
        .flat_map(|&z| (0..BORE).map(move |k| [around(k).cos(), around(k).sin(), z]))
        .map(|[x, y, z]| [0.026 * x, 0.026 * y, z])
        .collect();
    let ring = |bearing: usize, place: usize| -> Vec<usize> {
        let first = journal(bearing)[place] * BORE;
        (first..first + BORE).collect()
    };
    let bore = [0, 1].map(|bearing| [0, 1, 2].map(|place| ring(bearing, place)));
    let shell: Vec<f64> = [-60.0, -30.0, 0.0, 30.0, 60.0].map(f64::to_radians).to_vec();
    let load = |node: usize, force: [f64; 3], time_function: TimeFunction| {
        let node: BodyNode = shaft.nodes[node].clone();
        Load::force(0, node, force, time_function, Frame::Space)
    };
    // At rest each ring pushes with Σ Q cos ψ, which a constant load balances.
    let push = 1e8 * 1e-4_f64.powf(1.5) * shell.iter().map(|psi| psi.cos()).sum::<f64>();
    let mut loads: Vec<Load> = (0..2)
        .flat_map(journal)
        .map(|node| load(node, [push, 0.0, 0.0], TimeFunction::Constant))
        .collect();
    let pulse = TimeFunction::Sine { frequency: 250.0, phase: 0.0 };
    loads.extend([
        load(1, [4e4 * share, 5e3 * share, 0.0], pulse.clone()),
        load(4, [3e4 * share, -5e3 * share, 0.0], pulse),
    ]);
    Machine::new(MachineParts {
        laws: vec![Box::new(law)],
        bearings: bearings(&shell, bore),
        loads,
        bodies: vec![
            Body::turning("shaft", shaft, Rotation::Free),
            Body::standing("support", Support::lumped(200.0, [2e8, 3e8], [1e4, 1e4], &positions)),
        ],
        motion: motion("consistent"),
        clearance: &CLEARANCES[0],
    })
    .expect("a machine")
}

#[test]
fn full_newton_converges_quadratically_in_large_steps() {
    let shaft = shaft(&mesh());
    let mut count = 0;
    for share in [0.25, 0.5, 1.0, 2.0] {
        let machine = on_hertz_springs(shaft.clone(), share);
        // A quarter of the load's period: none of it at the start, all of it at the end of the step, so that
        // the springs get several times stiffer in it.
        let mut options = options(1e-3, 1);
        options.initial[0].speed = 400.0;
        options.newton = NewtonOptions { keep_factors: false, max_halvings: 0, ..options.newton };
        let mut march = March::new(&machine, &options).expect("starts");
        march.advance().unwrap_or_else(|error| panic!("{error}"));
        let e = march.residuals();
        // From the first residual that is a tenth of the start down to where rounding takes over, an order
        // from any three in a row.
        let (near, rounding) = (0.1 * e[0], 1e-12 * e[0]);
        for w in e.windows(3).filter(|w| w[0] <= near && w[2] >= rounding) {
            let order = (w[2] / w[1]).ln() / (w[1] / w[0]).ln();
            assert!(order > 1.8, "{order} from {e:?}");
            count += 1;
        }
    }
    assert!(count >= 3, "only {count} orders could be measured");
}

/// Half the way between two stops (m).
const GAP: f64 = 50e-6;
/// A stop holds with 1 MN/m until it yields at 20 N.
const STIFF: f64 = 1e6;
const YIELD: f64 = 20.0;
/// What is left of the stiffness then, at the stop towards +x and at that towards −x (N/m).
const YIELDED: [f64; 2] = [2e4, 1e4];
const MASS: f64 = 1.0;
const STEP: f64 = 1e-2;

/// Q and ∂Q/∂h of a stop.
fn stop(yielded: f64) -> impl Fn(f64) -> [f64; 2] {
    move |h| match -h {
        depth if depth <= 0.0 => [0.0, 0.0],
        depth if depth <= YIELD / STIFF => [STIFF * depth, -STIFF],
        depth => [YIELD + yielded * (depth - YIELD / STIFF), -yielded],
    }
}

/// A mass between two stops, free to fly between them.
fn between_stops() -> Machine {
    let [right, left] = YIELDED;
    let laws: Vec<Box<dyn SpringLaw>> =
        vec![Box::new(LawOf("right", stop(right))), Box::new(LawOf("left", stop(left)))];
    let bearing = |law: usize, angle: f64| Bearing {
        others: Vec::new(),
        name: format!("stop {}", law + 1),
        label: None,
        sides: Sides::default(),
        journal: [0; 3],
        bore: [Vec::new(), Vec::new(), Vec::new()],
        clearance: GAP,
        journal_radius: None,
        stations: vec![0.5],
        angles: vec![angle],
        law,
    };
    Machine::new(MachineParts {
        bodies: vec![
            Body::turning("mass", Shaft::lumped(MASS, [0.0; 2], [0.0; 2], 0.0), Rotation::Held),
            Body::standing("ground", Support::rigid(&[])),
        ],
        laws,
        bearings: vec![bearing(0, 0.0), bearing(1, PI)],
        motion: motion("consistent"),
        clearance: &CLEARANCES[0],
        loads: Vec::new(),
    })
    .expect("a machine")
}

fn thrown(position: f64, speed: f64, steps: usize, newton: NewtonOptions) -> MarchOptions {
    MarchOptions {
        initial: vec![BodyStart {
            angle: 0.0,
            speed: 0.0,
            position: vec![position, 0.0],
            velocity: vec![speed, 0.0],
        }],
        newton,
        ..options(STEP, steps)
    }
}

fn plain() -> NewtonOptions {
    NewtonOptions {
        line_search: false,
        keep_factors: false,
        max_halvings: 0,
        max_iterations: 200,
        ..NewtonOptions::default()
    }
}

fn run(machine: &Machine, options: &MarchOptions) -> Result<Outcome, Box<Failure>> {
    march(machine, options, &mut |_| ControlFlow::Continue(()))
}

/// Residual of a step from (x, ẋ, ẍ = 0): 4m/Δt² (x_n + Δt ẋ_n − x) less the push of the stops.
fn balance(flight: f64, x: f64) -> f64 {
    let inertia = 4.0 * MASS / (STEP * STEP);
    let [right, left] = YIELDED.map(stop);
    inertia * (flight - x) - right(GAP - x)[0] + left(GAP + x)[0]
}

/// Where the plain method goes for ever when the mass would fly to x̂ beyond the yield point g + w. Past
/// either stop the residual is linear, −s x + s x̂ − Q there, with s = 4m/Δt²; its root lies past the other
/// stop. Written with the residuals at both ends over √s, the norm that the march reports.
fn cycle(flight: f64) -> [f64; 2] {
    let inertia = 4.0 * MASS / (STEP * STEP);
    let bend = GAP + YIELD / STIFF;
    let [right, left] = YIELDED;
    let from_right = (inertia * flight - YIELD + right * bend) / (inertia + right);
    let from_left = (inertia * flight + YIELD - left * bend) / (inertia + left);
    assert!(from_right < -bend && from_left > bend, "each end leads to the other");
    [from_left, from_right].map(|x| balance(flight, x).abs() / inertia.sqrt())
}

#[test]
fn plain_newton_cycles_between_two_stops_where_ours_converges() {
    let machine = between_stops();
    let speed = 0.03;
    let flight = STEP * speed;
    let [beyond_right, beyond_left] = cycle(flight);

    let options = thrown(0.0, speed, 1, plain());
    let mut march = March::new(&machine, &options).expect("starts");
    let Err(Error::NewtonDiverged { iterations, .. }) = march.advance() else {
        panic!("the plain method cycles")
    };
    assert_eq!(iterations, 200);
    // After the prediction, beyond the left stop and beyond the right one by turns, to rounding.
    for (k, norm) in march.residuals().iter().enumerate().skip(1) {
        let expected = if k % 2 == 1 { beyond_left } else { beyond_right };
        assert!((norm / expected - 1.0).abs() < 1e-12, "iteration {k}: {norm} {expected}");
    }

    let ours = NewtonOptions::default();
    let outcome = run(&machine, &thrown(0.0, speed, 1, ours)).expect("ours converges");
    assert_eq!(outcome.halved_steps, 0);
    let found = 1e-6 * outcome.history.column("X1_um").expect("a column")[0];
    // The balance falls everywhere, so that halving an interval finds its only root.
    let (mut below, mut above) = (-1.0, 1.0);
    while above - below > 1e-15 {
        let middle = 0.5 * (below + above);
        if balance(flight, middle) > 0.0 { below = middle } else { above = middle }
    }
    // On the stiff part of the right stop; a residual of 1e-7 of the largest force, which is YIELD plus the
    // post-yield part at the prediction, is that over the slope there; any other slope is at least 4m/Δt².
    assert!(below > GAP && below < GAP + YIELD / STIFF);
    let inertia = 4.0 * MASS / (STEP * STEP);
    let allowed = ours.residual_tolerance * 2.0 * YIELD / inertia;
    assert!((found - below).abs() < allowed, "{found} {below} {allowed:e}");
}

#[test]
fn a_march_that_fails_says_where_and_keeps_what_it_had() {
    let machine = between_stops();
    // At −5 and 35 µm after two steps, between the stops; the third would end 5 µm beyond the yield point.
    let (start, speed) = (-45e-6, 4e-3);
    let failure = run(&machine, &thrown(start, speed, 10, plain())).expect_err("it cycles");
    let Error::NewtonDiverged {
        step,
        time,
        time_step,
        iterations,
        residual,
        force_change,
        worst_dof,
    } = &failure.error
    else {
        panic!("{}", failure.error)
    };
    assert_eq!((*step, *iterations, worst_dof.as_str()), (3, 200, "mass, mass x"));
    assert!((time - 3.0 * STEP).abs() < 1e-15 && *time_step == STEP);
    // An even iteration ends beyond the right stop, with 20 N and more where there was nothing.
    let [beyond_right, _] = cycle(start + 3.0 * STEP * speed);
    assert!((residual / beyond_right - 1.0).abs() < 1e-9, "{residual} {beyond_right}");
    assert!(*force_change > YIELD, "{force_change}");

    let outcome = &failure.outcome;
    assert_eq!(outcome.history.rows(), 2);
    let x = outcome.history.column("X1_um").expect("a column");
    for (x, expected) in x.iter().zip([-5.0, 35.0]) {
        assert!((x - expected).abs() < 1e-9, "{x} {expected}");
    }
    // Free flight: whatever was counted of the failed step would show here. ½ m v² is 8e-6 J.
    let energy = outcome.energy;
    let springs = [energy.spring_stored, energy.spring_dissipated];
    let others = [energy.work_in, energy.kinetic, energy.strain, energy.error()];
    for part in springs.into_iter().chain(others) {
        assert!(part.abs() < 1e-18, "{energy:?}");
    }
}
