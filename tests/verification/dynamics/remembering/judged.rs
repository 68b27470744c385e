//! What a run believes of its states.

use whirl_solver::dynamics::{Integrator, March, MarchOptions, findings};
use whirl_solver::loads::TimeFunction;
use whirl_solver::machine::Rotation;

use super::super::options;
use super::{Taped, mass_on, on_mount};

fn sine(frequency: f64) -> (f64, TimeFunction) {
    (500.0, TimeFunction::Sine { frequency, phase: 0.0 })
}

/// The share of the local error of states, and what is found of the run.
fn judged(machine: &whirl_solver::machine::Machine, own: &MarchOptions) -> (f64, Vec<String>) {
    let mut march = March::new(machine, own).expect("starts");
    while !march.is_done() {
        march.advance().expect("converges");
    }
    let outcome = march.outcome();
    let found = findings(&outcome.quality, &outcome.energy, (own.time_step, None));
    let found = found.into_iter().map(|own| format!("{}: {}", own.what, own.remedy));
    (outcome.quality.states.expect("has states").local.0, found.collect())
}

/// Of a state that is shaken at ω the trapezoidal rule misses (ωΔt)³/12 of its amplitude in a step, half of that of its range.
#[test]
fn the_error_of_a_state_is_what_a_step_misses() {
    let frequency = 20.0;
    let machine = on_mount(sine(frequency));
    for per_period in [100, 200] {
        let dt = 1.0 / (frequency * f64::from(per_period));
        let (share, found) = judged(&machine, &options(dt, 60 * per_period as usize));
        let exact = (std::f64::consts::TAU / f64::from(per_period)).powi(3) / 24.0;
        // 95 % of |sin| stay below 0.997; classes round up by a twentieth, and the mass moves by itself, too.
        assert!((0.8..1.6).contains(&(share / exact)), "{share} for {exact}");
        assert!(!found.iter().any(|own| own.contains("state of a law")), "{found:?}");
    }
}

/// A state that comes to rest within a hundredth of a step, pushed about by a load that changes at once, alternates: found, with the
/// remedy that helps.
#[test]
fn a_state_far_faster_than_the_step_is_found() {
    let fast = "[inputs]
e_x = { unit = \"mm\", range = [-1, 1] }
e_y = { unit = \"mm\", range = [-1, 1] }
[states.z]
unit = \"mm\"
start = 0.3
range = [-1, 1]
[parameters]
k = { value = 900, unit = \"N/mm\" }
tau = { value = 10, unit = \"us\" }
[rates]
z = '(e_x - z)/tau'
[outputs]
F_x = { unit = \"N\", value = '-k*(e_x + z/10)' }
F_y = { unit = \"N\", value = '-k*e_y' }
";
    let machine = mass_on(Box::new(Taped::new(fast)), sine(20.0), Rotation::Held);
    let (share, found) = judged(&machine, &options(1e-3, 100));
    assert!(share > 0.1, "{share}");
    let own = found.iter().find(|own| own.contains("state of a law")).expect("found");
    assert!(own.contains("1e5 1/s") || own.contains("100000 1/s"), "{own}");
    assert!(own.contains("generalized-alpha"), "{own}");
    let damped =
        MarchOptions { integrator: Integrator::generalized_alpha(0.5), ..options(1e-3, 1000) };
    let (share, _) = judged(&machine, &damped);
    assert!(share < 1e-2, "{share}");
}

/// A temperature that a step far too long has alternate by a millionth of a kelvin: nothing of the hundred kelvins that its
/// law declares, but all of what it does by itself, which counts where nothing is declared.
#[test]
fn a_state_that_stands_still_is_measured_by_the_range_of_its_law() {
    let judged = |range: &str| {
        let law = format!(
            "[inputs]
e_x = {{ unit = \"mm\"{range} }}
e_y = {{ unit = \"mm\"{range} }}
[states.T]
unit = \"K\"
start = 320.000001
{}
[parameters]
k = {{ value = 900, unit = \"N/mm\" }}
T_0 = {{ value = 320, unit = \"K\" }}
tau = {{ value = 10, unit = \"us\" }}
[rates]
T = '(T_0 - T)/tau'
[outputs]
F_x = {{ unit = \"N\", value = '-k*e_x*T_0/T' }}
F_y = {{ unit = \"N\", value = '-k*e_y*T_0/T' }}
",
            if range.is_empty() { "" } else { "range = [310, 420]" }
        );
        let machine = mass_on(Box::new(Taped::new(&law)), sine(20.0), Rotation::Held);
        judged(&machine, &options(1e-3, 100))
    };
    let (share, found) = judged(", range = [-1, 1]");
    assert!(share < 2e-3, "{share}");
    assert!(!found.iter().any(|own| own.contains("state of a law")), "{found:?}");
    let (share, found) = judged("");
    assert!(share > 0.1, "{share}");
    assert!(found.iter().any(|own| own.contains("state of a law")), "{found:?}");
}

/// A mass that passes a place where a state changes, in a twelve hundredth of the run: few steps see it, and what they miss stays.
#[test]
fn what_few_steps_miss_of_a_state_is_found() {
    let bump = "[inputs]
e_x = { unit = \"mm\", range = [-1, 1] }
e_y = { unit = \"mm\", range = [-1, 1] }
[states.z]
unit = \"mm\"
start = 0
range = [-1, 1]
[parameters]
k = { value = 1, unit = \"N/mm\" }
place = { value = 0.5, unit = \"mm\" }
width = { value = 0.9, unit = \"um\" }
rate = { value = 1, unit = \"mm/s\" }
[rates]
z = 'rate*exp(-((e_x - place)/width)^2)'
[outputs]
F_x = { unit = \"N\", value = '-k*e_x' }
F_y = { unit = \"N\", value = '-k*(e_y + z)' }
";
    let push = (0.5, TimeFunction::Constant);
    let machine = mass_on(Box::new(Taped::new(bump)), push, Rotation::Held);
    let marched = |steps: usize| {
        let own = options(0.44 / steps as f64, steps);
        let (share, found) = judged(&machine, &own);
        assert!(share < 1e-4, "{share}: few steps");
        found.into_iter().find(|own| own.contains("state of a law"))
    };
    let coarse = marched(1000).expect("found");
    assert!(coarse.contains("add up to") && coarse.contains("time_step"), "{coarse}");
    assert_eq!(marched(16_000), None);
}
