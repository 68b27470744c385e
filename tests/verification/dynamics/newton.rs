//! Newton's method inside a step: its order, cycles of the plain method, and what is said on failure.

use std::ops::ControlFlow;

use whirl_solver::Error;
use whirl_solver::bearing::{Bearing, SpringLaw};
use whirl_solver::dynamics::{HalvedAt, March, MarchOptions, NewtonOptions, march};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::Law;

use super::{bearing, bores, boxed, discs, force, law, options, parts, stops};
use whirl_solver::loads::{Frame, TimeFunction};

/// Q = 100 MN/m^1.5 · (2 mm − h)^1.5: Hertz-like, in contact all around so that nothing switches.
static HERTZ: Law = law("hertz", false, |n, h, out| {
    for j in 0..n {
        let depth = 2e-3 - h[j];
        let root = depth.max(0.0).sqrt();
        out[j] = 1e8 * depth * root;
        out[n + j] = -1.5e8 * root;
    }
});

/// Five discs pressed into a law that acts all around, in steps so large that the order of Newton's method
/// shows: near the solution and above rounding the number of right digits doubles.
pub(super) fn converges_quadratically(law: Box<dyn SpringLaw>, journal_radius: Option<f64>) {
    let mut parts = parts(discs(1e6), Support::rigid(&[]), Rotation::Free);
    parts.laws = vec![law];
    parts.bearings = vec![Bearing { bore: Default::default(), journal_radius, ..bearing(0) }];
    parts.loads = vec![force(
        &parts.bodies[0].nodes()[2],
        [3e4, 1e4, 0.0],
        TimeFunction::Constant,
        Frame::Space,
    )];
    let machine = Machine::new(parts).expect("a machine");
    let mut options = options(5e-3, 3);
    options.initial[0].speed = 100.0;
    options.newton.keep_factors = false;
    options.newton.max_halvings = 0;
    let mut march = March::new(&machine, &options).expect("starts");
    let mut measured = 0;
    for _ in 0..options.steps {
        march.advance().unwrap_or_else(|error| panic!("{error}"));
        let r: Vec<f64> = march.residuals().to_vec();
        assert!(r.len() <= 12, "{r:?}");
        for w in r.windows(3) {
            let (a, b, c) = (w[0] / r[0], w[1] / r[0], w[2] / r[0]);
            if a < 2e-3 && c > 1e-13 {
                let order = (c / b).ln() / (b / a).ln();
                assert!(order > 1.7, "order {order} in {r:?}");
                measured += 1;
            }
        }
    }
    assert!(measured >= 2, "the case is hard enough to show the order");
}

#[test]
fn full_newton_converges_quadratically_in_large_steps() {
    converges_quadratically(boxed(&HERTZ), None);
}

/// Springs that yield at 1 µm: 1 GN/m up to there, then a constant push. Two of them face each other.
static YIELDING: Law = law("yielding", false, |n, h, out| {
    for j in 0..n {
        let depth = 1e-3 - h[j];
        let acts = depth > 0.0 && depth < 1e-6;
        out[j] = 1e9 * depth.clamp(0.0, 1e-6);
        out[n + j] = if acts { -1e9 } else { 0.0 };
    }
});

/// With effective stiffness s = 4m/Δt² = 10 MN/m, a hundredth of the springs', a prediction 10 µm out leads
/// plain Newton to −90 µm, from there to 110 µm, and so on for ever.
fn between_yielding_springs() -> Machine {
    beside_yielding_springs(2.5, &[0.0, std::f64::consts::PI])
}

fn beside_yielding_springs(mass: f64, angles: &[f64]) -> Machine {
    let mut parts =
        parts(Shaft::lumped(mass, [0.0; 2], [0.0; 2], 0.0), Support::rigid(&[]), Rotation::Held);
    parts.laws = vec![boxed(&YIELDING)];
    parts.bearings = vec![stops("yielding", 1e-3, angles, 0)];
    Machine::new(parts).expect("a machine")
}

fn thrown(newton: NewtonOptions) -> MarchOptions {
    let mut options = options(1e-3, 1);
    options.initial[0].velocity = vec![0.01, 0.0];
    options.newton = newton;
    options
}

#[test]
fn plain_newton_cycles_where_ours_converges() {
    let machine = between_yielding_springs();
    let ours = NewtonOptions { force_tolerance: 1e-6, max_halvings: 0, ..NewtonOptions::default() };
    let mut go_on = |_: &_| ControlFlow::Continue(());
    let plain = NewtonOptions { line_search: false, keep_factors: false, ..ours };
    let failure = march(&machine, &thrown(plain), &mut go_on).expect_err("it cycles");
    let Error::NewtonDiverged { step, iterations, worst_dof, force_change, .. } = &failure.error
    else {
        panic!("{}", failure.error)
    };
    assert_eq!((*step, *iterations), (1, plain.max_iterations));
    assert_eq!(worst_dof, "shaft, mass x");
    assert!(*force_change > 900.0, "the springs go from one side to the other: {force_change}");
    assert_eq!(failure.outcome.history.rows(), 0);

    let outcome = march(&machine, &thrown(ours), &mut go_on).expect("ours converges");
    // The springs carry s (10 µm − x): x = 10 µm · s/(s + k) = 10/101 µm.
    let x = outcome.history.column("X1_um").expect("a column")[0];
    assert!((x - 10.0 / 101.0).abs() < 1e-6, "{x}");
    assert_eq!(outcome.halved_steps, 0);
}

/// One spring leads the plain method from 10 µm to −90 µm and back, with 1000 N left at both ends. Between two
/// beside a tenth of the mass, s = 1 MN/m, only steps below a hundredth lessen what is left.
#[test]
fn steps_that_bring_nothing_are_shortened_however_far() {
    let facing = [0.0, std::f64::consts::PI];
    for (mass, angles) in [(2.5, &facing[..1]), (0.25, &facing)] {
        let machine = beside_yielding_springs(mass, angles);
        let mut go_on = |_: &_| ControlFlow::Continue(());
        let ours = NewtonOptions { max_halvings: 0, ..options(1e-3, 1).newton };
        let plain = NewtonOptions { line_search: false, keep_factors: false, ..ours };
        march(&machine, &thrown(plain), &mut go_on).expect_err("it cycles");
        let outcome = march(&machine, &thrown(ours), &mut go_on).expect("ours converges");
        let x = outcome.history.column("X1_um").expect("a column")[0];
        let s = 4.0 * mass / 1e-6;
        assert!((x - 10.0 * s / (s + 1e9)).abs() < 1e-9, "{x}");
    }
}

#[test]
fn step_cutting_saves_the_plain_method() {
    let machine = between_yielding_springs();
    let cut = NewtonOptions { line_search: false, keep_factors: false, ..NewtonOptions::default() };
    let mut options = thrown(cut);
    options.steps = 3;
    let outcome = march(&machine, &options, &mut |_| ControlFlow::Continue(())).expect("halves");
    assert!(outcome.halved_steps > 0);
    // The springs go from one side to the other.
    let halved = outcome.quality.halved;
    assert_eq!((halved.steps, halved.of), (outcome.halved_steps, 3));
    assert!(halved.halvings >= halved.steps as u64, "{halved:?}");
    assert_eq!(halved.at, Some(HalvedAt::Bearing(0)));
    let times = outcome.history.column("t_s").expect("a column");
    for (row, time) in times.iter().enumerate() {
        assert!((time - 1e-3 * (row + 1) as f64).abs() < 1e-15, "back on the grid: {time}");
    }
}

/// A load that turns within a step makes the parts of a halved step differ: they are the steps of a march with
/// half the step.
#[test]
fn the_halves_of_a_step_are_steps_of_their_own() {
    // As above with 20 kg, s = 80 MN/m: from 10 µm the plain method goes to −2.5 and 22.5 µm and on for ever;
    // in half the step, s = 320 MN/m, 5 µm lead to 1.9 µm, where the springs yield, too.
    let mut parts =
        parts(Shaft::lumped(20.0, [0.0; 2], [0.0; 2], 0.0), Support::rigid(&[]), Rotation::Held);
    parts.laws = vec![boxed(&YIELDING)];
    parts.bearings = vec![stops("between springs", 1e-3, &[0.0, std::f64::consts::PI], 0)];
    let sine = TimeFunction::Sine { frequency: 400.0, phase: 0.9 };
    parts.loads = vec![force(&parts.bodies[0].nodes()[0], [40.0, 25.0, 0.0], sine, Frame::Space)];
    let machine = Machine::new(parts).expect("a machine");
    let newton =
        NewtonOptions { line_search: false, keep_factors: false, ..options(1.0, 1).newton };
    let end = |parts: usize| {
        let mut options = thrown(newton);
        (options.time_step, options.steps) = (1e-3 / parts as f64, parts);
        let mut march = March::new(&machine, &options).expect("starts");
        (0..parts).for_each(|_| march.advance().unwrap_or_else(|error| panic!("{error}")));
        (march.state().clone(), march.outcome().halved_steps)
    };
    let ((whole, halved), (halves, again)) = (end(1), end(2));
    // Of the halves, one is halved again.
    assert_eq!((halved, again), (1, 1));
    // Along x and y: positions, velocities and accelerations, each the same sums of the same numbers.
    for (a, b) in [(&whole.q, &halves.q), (&whole.v, &halves.v), (&whole.a, &halves.a)] {
        let size = b.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        for (a, b) in a.iter().zip(b) {
            assert!((a - b).abs() <= 1e-9 * size, "{whole:?} {halves:?}");
        }
    }
    assert!(halves.q[2].abs() > 1e-9, "the load moves the mass along y");
}

/// A spring of 15 MN/m that yields at 750 N.
static SOFTENING: Law = law("softening", false, |n, h, out| {
    for j in 0..n {
        let depth = 1e-3 - h[j];
        let acts = depth > 0.0 && depth < 50e-6;
        out[j] = 15e6 * depth.clamp(0.0, 50e-6);
        out[n + j] = if acts { -15e6 } else { 0.0 };
    }
});

/// A mass pushed to and fro against one.
fn softening() -> Machine {
    let mut parts =
        parts(Shaft::lumped(2.5, [0.0; 2], [0.0; 2], 0.0), Support::rigid(&[]), Rotation::Held);
    parts.laws = vec![boxed(&SOFTENING)];
    parts.bearings = vec![stops("softening", 1e-3, &[0.0], 0)];
    // Slow beside the steps: yields within some of them, and not to and fro.
    let sine = TimeFunction::Sine { frequency: 10.0, phase: 0.0 };
    parts.loads = vec![force(&parts.bodies[0].nodes()[0], [1000.0, 0.0, 0.0], sine, Frame::Space)];
    Machine::new(parts).expect("a machine")
}

/// Factors of [AK] with a spring that has yielded since contract by 15/(15 + 10) = 0.6 an iteration: too
/// little to be kept. Made anew they solve the step, for the residual is linear from there on.
#[test]
fn factors_that_contract_badly_are_recomputed() {
    let machine = softening();
    let mut options = options(1e-3, 20);
    options.newton = NewtonOptions::default();
    let outcome = march(&machine, &options, &mut |_| ControlFlow::Continue(())).expect("marches");
    let column = |name| outcome.history.column(name).expect("a column");
    assert!(column("RX1_N").last().is_some_and(|force| (force + 750.0).abs() < 1e-9), "it yields");
    // Two show how they contract, the third is exact, and the spring may yield between any of them; kept, they
    // would take 0.6ⁿ = 1e-7, n = 31.
    let most = column("iterations").into_iter().fold(0.0, f64::max);
    assert!(most <= 6.0, "{most} iterations in a step");
}

/// Tolerances so wide that the first shortened iteration is within them: forces may change by more than the
/// springs have, and the residual there, at 3.75 µm, is 937.5 N.
#[test]
fn a_shortened_iteration_does_not_end_a_step() {
    let wide = NewtonOptions {
        force_tolerance: 1e4,
        relative_force_tolerance: f64::INFINITY,
        residual_tolerance: 4.0,
        max_halvings: 0,
        ..NewtonOptions::default()
    };
    let machine = between_yielding_springs();
    let mut go_on = |_: &_| ControlFlow::Continue(());
    let outcome = march(&machine, &thrown(wide), &mut go_on).expect("converges");
    // The first whole one is that on the springs' slope, which ends at the solution.
    let x = outcome.history.column("X1_um").expect("a column")[0];
    assert!((x - 10.0 / 101.0).abs() < 1e-6, "{x}");
}

/// A spring that yields under a load, so that steps differ in their iterations.
#[test]
fn iterations_and_factorisations_are_counted() {
    let machine = softening();
    let mut options = options(1e-3, 20);
    options.newton = NewtonOptions { keep_factors: false, ..NewtonOptions::default() };
    let outcome = march(&machine, &options, &mut |_| ControlFlow::Continue(())).expect("marches");
    let steps = outcome.history.column("iterations").expect("a column");
    assert!(steps.iter().all(|own| *own >= 1.0) && steps.iter().any(|own| *own > 1.0), "{steps:?}");
    assert_eq!(outcome.iterations as f64, steps.iter().sum::<f64>());
    // Without kept factors each iteration makes its own.
    assert_eq!(outcome.factorisations, outcome.iterations);
}

/// Nothing moves, so that every cycle is like the one before.
#[test]
fn a_steady_march_goes_on_unless_it_is_to_stop() {
    let machine = between_yielding_springs();
    for stop_when_steady in [false, true] {
        let options = MarchOptions { cycle: Some(5e-3), stop_when_steady, ..options(1e-3, 100) };
        let go_on = &mut |_: &_| ControlFlow::Continue(());
        let outcome = march(&machine, &options, go_on).expect("marches");
        assert!(outcome.steady.is_some());
        assert_eq!(outcome.history.rows() < 100, stop_when_steady);
    }
}

#[test]
fn an_observer_stops_the_march_and_keeps_what_there_is() {
    let machine = between_yielding_springs();
    let mut options = thrown(NewtonOptions::default());
    options.steps = 100;
    let outcome = march(&machine, &options, &mut |progress| match progress.step {
        7 => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    assert_eq!(outcome.expect("marches").history.rows(), 7);
}

#[test]
fn laws_that_want_what_no_spring_has_are_refused_by_name() {
    static STRANGE: Law = Law {
        inputs: &[whirl_specs::Variable { name: "h_dott", unit: "m/s", title: "" }],
        ..law("strange", true, |_, _, _| {})
    };
    let mut parts = parts(discs(1e5), bores(), Rotation::Free);
    parts.laws = vec![boxed(&STRANGE)];
    parts.bearings = vec![bearing(0)];
    let Err(error) = Machine::new(parts) else { panic!("no spring has h_dott") };
    let text = error.to_string();
    assert!(text.contains("strange") && text.contains("did you mean h_dot?"), "{text}");
}
