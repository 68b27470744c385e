//! What is carried of states: checkpoints, other runs, starts.

use whirl_solver::bearing::SpringLaw;
use whirl_solver::dynamics::{
    AutomaticStep, Checkpoint, Integrator, March, MarchOptions, equilibrium,
};
use whirl_solver::loads::TimeFunction;
use whirl_solver::machine::Rotation;

use super::super::options;
use super::{RELAXING, SLOW, Taped, mass_on, on_mount, shipped};

const PUSH: f64 = 500.0;
const STEPS: usize = 400;

fn shaken() -> (f64, TimeFunction) {
    (PUSH, TimeFunction::Sine { frequency: 47.0, phase: 0.4 })
}

fn finish(march: &mut March, cut: Option<usize>) -> (Vec<Vec<u64>>, Option<Vec<u8>>) {
    let (mut rows, mut kept) = (Vec::new(), None);
    while !march.is_done() {
        march.advance().expect("converges");
        rows.push(march.row().iter().map(|value| value.to_bits()).collect());
        if Some(rows.len()) == cut {
            kept = Some(postcard::to_allocvec(&march.checkpoint()).expect("plain data"));
        }
    }
    (rows, kept)
}

#[test]
fn a_resumed_march_with_states_has_the_bits_of_one_never_interrupted() {
    let machine = on_mount(shaken());
    let chosen = AutomaticStep { tolerance: 1e-4, ..AutomaticStep::default() };
    let damped = Integrator::generalized_alpha(0.8);
    let methods = [
        (None, Integrator::default()),
        (Some(chosen), Integrator::default()),
        (None, damped),
        (Some(chosen), damped),
    ];
    for (automatic, integrator) in methods {
        let options = MarchOptions { automatic, integrator, ..options(1e-3, STEPS) };
        let mut whole = March::new(&machine, &options).expect("starts");
        for cut in [1, 133] {
            let (rows, kept) =
                finish(&mut March::new(&machine, &options).expect("starts"), Some(cut));
            let checkpoint: Checkpoint = postcard::from_bytes(&kept.expect("kept")).expect("read");
            let mut resumed = March::resume(&machine, &options, checkpoint).expect("resumes");
            assert!(finish(&mut resumed, None).0 == rows[cut..], "{integrator:?} {cut}");
        }
        finish(&mut whole, None);
        let quality = whole.outcome().quality;
        assert!(quality.states.expect("has states").local.0 > 0.0);
    }
}

/// Another march goes on from the last state, the states with it: with the bits of one that was never cut.
#[test]
fn another_march_goes_on_with_the_states() {
    let machine = on_mount(shaken());
    let whole = options(1e-3, STEPS);
    let (rows, _) = finish(&mut March::new(&machine, &whole).expect("starts"), None);
    let mut first = March::new(&machine, &options(1e-3, 133)).expect("starts");
    finish(&mut first, None);
    let last = first.last_state();
    let rest = options(1e-3, STEPS - 133);
    let mut second = March::from_last(&machine, &rest, &last).expect("goes on");
    assert_eq!(second.state().laws, first.state().laws);
    assert!(finish(&mut second, None).0 == rows[133..]);
    // With another law the states begin anew.
    let other = mass_on(Box::new(Taped::new(ONE)), shaken(), Rotation::Held);
    let march = March::from_last(&other, &rest, &last).expect("goes on");
    assert_eq!(march.state().laws.known, [2e-5]);
}

/// One state, which does not relax.
const ONE: &str = "[inputs]
e_x = { unit = \"mm\", range = [-1, 1] }
e_y = { unit = \"mm\", range = [-1, 1] }
[states.i]
unit = \"mm*s\"
start = 0.02
range = [-1, 1]
[parameters]
k = { value = 900, unit = \"N/mm\" }
g = { value = 10, unit = \"N/mm/s\" }
[rates]
i = 'e_x'
[outputs]
F_x = { unit = \"N\", value = '-k*e_x - g*i' }
F_y = { unit = \"N\", value = '-k*e_y' }
";

/// States begin as the law says: at a value, or where their rates are zero.
#[test]
fn states_begin_as_the_law_says() {
    let march = |law: Box<dyn SpringLaw>| {
        let machine = mass_on(law, (PUSH, TimeFunction::Constant), Rotation::Held);
        let march = March::new(&machine, &options(1e-4, 1)).expect("starts");
        (march.state().laws.known.clone(), march.state().a[1])
    };
    // The mass begins in the middle.
    assert_eq!(march(shipped("zener-mount")), (vec![0.0; 2], PUSH / super::MASS));
    let (known, acceleration) = march(Box::new(Taped::new(ONE)));
    assert_eq!(known, [2e-5]);
    let exact = (PUSH - 1e4 * 2e-5) / super::MASS;
    assert!((acceleration - exact).abs() < 1e-12 * exact, "{acceleration}");
}

/// A shaft that turns in a mount that stands, under a constant load: the mount has relaxed, and nothing moves.
#[test]
fn a_start_at_equilibrium_has_relaxed() {
    let turning = Rotation::Prescribed { speed: 300.0, acceleration: 0.0 };
    let load = || (PUSH, TimeFunction::Constant);
    let machine = mass_on(shipped("zener-mount"), load(), turning);
    let (dt, steps) = (1e-4, 500);
    let found = equilibrium(&machine, &[], Some(dt)).expect("stands");
    let initial = found.bodies;
    let exact = PUSH / SLOW;
    // A row of the balance is solved to 1e-6 of its largest term, and the mass moves about what is left.
    let left = 1e-6 * exact;
    assert!((initial[0].position[0] - exact).abs() < left, "{initial:?}");
    let own = MarchOptions { initial, laws_at_rest: true, ..options(dt, steps) };
    let mut march = March::new(&machine, &own).expect("starts");
    let states = march.state().laws.known.clone();
    assert!((states[0] - exact).abs() < left && states[1].abs() < left, "{states:?}");
    while !march.is_done() {
        march.advance().expect("converges");
        let now = &march.state().laws;
        assert!((now.known[0] - states[0]).abs() < 2.0 * left, "{now:?}");
        assert!((now.rates[0] * dt).abs() < 2.0 * left, "{now:?}");
    }
    // A mount that has not relaxed is stiffer.
    assert!(exact > 1.1 * PUSH / (SLOW + RELAXING));
}

/// Where the rate of a state that only integrates is zero, it carries what stands; where its rate is zero nowhere, nothing stands.
#[test]
fn an_integral_carries_what_stands_if_its_rate_can_be_zero() {
    let held = |law: &str| {
        let law = Box::new(Taped::new(law));
        let machine = mass_on(law, (PUSH, TimeFunction::Constant), Rotation::Held);
        equilibrium(&machine, &[], None)
    };
    let stands = held(ONE).expect("an integral that carries the push");
    let apart = stands.bodies[0].position[0];
    assert!(
        apart.abs() < 1e-3 * PUSH / 900e3,
        "{apart}: the spring alone would carry it at 0.56 mm"
    );
    let always = ONE
        .replace("i = 'e_x'", "i = 'a'")
        .replace("[rates]", "a = { value = 1, unit = \"mm\" }\n[rates]");
    let error = held(&always).expect_err("an integral that goes on");
    let error = error.to_string();
    assert!(error.contains("its law taped were found at rest nowhere"), "{error}");
}
