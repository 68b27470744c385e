//! Generalized-α against exact solutions, and what it does to motion that stands in space.

use std::f64::consts::TAU;

use nalgebra::Complex;
use whirl_solver::dynamics::{
    AutomaticStep, Integrator, March, MarchOptions, Newmark, RingingPart, equilibrium, findings,
};
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::{force, options, parts};

type Complex64 = Complex<f64>;

/// A mass on a spring and a damper in x and y, under a force along x.
fn mass(
    [mass, stiffness, damping]: [f64; 3],
    (push, time_function): (f64, TimeFunction),
    rotation: Rotation,
) -> Machine {
    let shaft = Shaft::lumped(mass, [stiffness; 2], [damping; 2], 0.0);
    let mut parts = parts(shaft, Support::rigid(&[]), rotation);
    let node = &parts.bodies[0].nodes()[0];
    parts.loads = vec![force(node, [push, 0.0, 0.0], time_function, Frame::Space)];
    Machine::new(parts).expect("a machine")
}

fn marched(machine: &Machine, options: &MarchOptions, mut each: impl FnMut(&March)) {
    let mut march = March::new(machine, options).expect("starts");
    while !march.is_done() {
        march.advance().unwrap_or_else(|error| panic!("{error}"));
        each(&march);
    }
}

/// q, q̇ and q̈ of a damped mass that is shaken from rest are wrong by what falls as Δt², whatever is damped; so they are where
/// the program chooses the parts of steps, as the tolerance does.
#[test]
fn places_velocities_and_accelerations_are_of_second_order() {
    let (m, k, c, shaken, phase) = (1.0, 900.0, 3.0, 20.0, 0.7);
    let sine = TimeFunction::Sine { frequency: shaken / TAU, phase };
    let machine = mass([m, k, c], (5.0, sine), Rotation::Held);
    let amplitude = 5.0 / Complex64::new(k - m * shaken * shaken, c * shaken);
    let (decay, free) = (c / (2.0 * m), (k / m - (c / (2.0 * m)).powi(2)).sqrt());
    let root = Complex64::new(-decay, free);
    let exact = |t: f64| -> [f64; 3] {
        let wave = |t: f64| {
            let own = amplitude * Complex64::from_polar(1.0, shaken * t + phase);
            [0, 1, 2].map(|n| (own * Complex64::new(0.0, shaken).powi(n)).im)
        };
        let [place, speed, _] = wave(0.0);
        // What is free of it: Re (z e^{root t}), at rest with the wave at the start.
        let z = Complex64::new(-place, (speed + decay * place) / free);
        let own = z * (root * t).exp();
        let free = [0, 1, 2].map(|n| (own * root.powi(n)).re);
        [0, 1, 2].map(|n| wave(t)[n] + free[n])
    };
    let errors = |integrator: Integrator, steps: usize, automatic: Option<AutomaticStep>| {
        let own = options(1.0 / steps as f64, steps);
        let own = MarchOptions { integrator, automatic, ..own };
        let mut squares = [0.0; 3];
        marched(&machine, &own, |march| {
            let (exact, state) = (exact(march.time()), march.state());
            let found = [state.q[1], state.v[1], state.a[1]];
            for n in 0..3 {
                squares[n] += (found[n] - exact[n]).powi(2) / steps as f64;
            }
        });
        squares.map(f64::sqrt)
    };
    for rho in [0.0, 0.5, 0.9, 1.0] {
        let integrator = Integrator::generalized_alpha(rho);
        let [coarse, fine] = [500, 1000].map(|steps| errors(integrator, steps, None));
        for (n, name) in ["q", "v", "a"].into_iter().enumerate() {
            // Four, but for terms of the fourth order: (ωΔt)² is 4e-3.
            let ratio = coarse[n] / fine[n];
            assert!((3.9..4.1).contains(&ratio), "ρ = {rho}, {name}: {coarse:?}, {fine:?}");
        }
    }
    // Chosen parts: an error of a part that is a tenth makes those of parts 10^(1/3) shorter, and what they sum up to
    // 10^(2/3) less, as lengths are halves of each other a factor of 4 more or less.
    let chosen = |tolerance: f64| {
        let automatic = AutomaticStep { tolerance, longest: f64::INFINITY };
        errors(Integrator::generalized_alpha(0.9), 100, Some(automatic))
    };
    let (coarse, fine) = (chosen(1e-4), chosen(1e-7));
    for n in 0..3 {
        let ratio = coarse[n] / fine[n];
        assert!((25.0..400.0).contains(&ratio), "{coarse:?}, {fine:?}");
    }
}

/// A mass on a spring that turns under a constant load stands in space. In its frame it turns backwards, and with e^{−iΩt} the
/// method's formulas give q̇ = s₁q and q̈ = s₂q: q = F/(k + m (s₂ + 2iΩs₁ − Ω²) + c s₁), which the march finds.
/// s₂ + 2iΩs₁ − Ω² is none exactly; the method leaves −i/2 ((1 − ρ)/(1 + ρ))³ (ΩΔt)³ Ω², a false damping, and nothing of it in
/// Newmark's method.
#[test]
fn what_stands_in_space_is_damped_falsely_by_the_third_power_of_the_step() {
    let (m, k, c, push, speed) = (2.0, 4e5, 300.0, 1000.0, 300.0);
    let rotation = || Rotation::Prescribed { speed, acceleration: 0.0 };
    let machine = mass([m, k, c], (push, TimeFunction::Constant), rotation());
    let roots = |integrator: Integrator, dt: f64| {
        let Integrator { newmark: Newmark { gamma, beta }, alpha_m, alpha_f } = integrator;
        let z = Complex64::from_polar(1.0, -speed * dt);
        let v = dt * ((1.0 - gamma) + gamma * z) / (z - 1.0);
        let q = (dt * v + dt * dt * ((0.5 - beta) + beta * z)) / (z - 1.0);
        let a = ((1.0 - alpha_m) * z + alpha_m) / ((1.0 - alpha_f) * z + alpha_f);
        [v / q, a / q]
    };
    for (rho, dt) in [(1.0, 1e-4), (0.9, 4e-4), (0.9, 2e-4), (0.5, 2e-4), (0.5, 1e-4), (0.0, 1e-4)]
    {
        let integrator = Integrator::generalized_alpha(rho);
        let [s1, s2] = roots(integrator, dt);
        let false_inertia = s2 + Complex64::new(0.0, 2.0 * speed) * s1 - speed * speed;
        let whole =
            0.5 * ((1.0 - rho) / (1.0 + rho)).powi(3) * (speed * dt).powi(3) * speed * speed;
        // The next term is of the fifth order; rounding of differences of s.
        let allowed = (speed * dt).powi(2) * whole + 1e-9 * speed * speed;
        assert!(
            (false_inertia.im + whole).abs() <= allowed,
            "{rho} {dt}: {false_inertia} for {whole}"
        );
        let expected = push / (k + m * false_inertia + c * s1);
        let own = MarchOptions {
            integrator,
            initial: equilibrium(&machine, &[None], None).expect("is there").bodies,
            ..options(dt, (1.0 / dt).round() as usize)
        };
        let mut last = Complex64::default();
        marched(&machine, &own, |march| {
            let q = &march.state().q;
            last = Complex64::new(q[1], q[2]) * Complex64::from_polar(1.0, q[0]);
        });
        // What the start lacks has died, forward whirl last: e^{−(c/2m)(1 − Ω/ω)t} is 2e-11.
        assert!(
            (last - expected).norm() < 1e-8 * expected.norm(),
            "{rho} {dt}: {last} for {expected}"
        );
    }
}

/// Energy that is lost in motion that the step resolves: amplitudes fall by (ωΔt)³ ½ ((1 − ρ)/(1 + ρ))³ an angle, as what stands
/// in space in a frame that turns. What is lost is the error of the balance.
#[test]
fn lost_energy_is_the_error_of_the_balance() {
    let (omega, dt, steps, rho) = (100.0_f64, 2e-3, 5000, 0.5);
    let machine = mass([1.0, omega * omega, 0.0], (0.0, TimeFunction::Constant), Rotation::Held);
    let mut own = options(dt, steps);
    own.integrator = Integrator::generalized_alpha(rho);
    own.initial[0].velocity = vec![1.0, 0.0];
    let (mut lost, mut error) = (0.0, 0.0);
    let mut march = March::new(&machine, &own).expect("starts");
    while !march.is_done() {
        march.advance().expect("converges");
        let balance = march.energy();
        (lost, error) = (-(balance.kinetic + balance.strain), balance.error());
    }
    // The damping ratio is half of what s₂ has.
    let third: f64 = ((1.0 - rho) / (1.0 + rho) * omega * dt).powi(3);
    let share = 1.0 - (-third * omega * dt * steps as f64).exp();
    assert!((lost / 0.5 / share - 1.0).abs() < 0.05, "{} for {share}", lost / 0.5);
    assert!((error - lost).abs() < 1e-9, "{error} for {lost}");
    let outcome = march.outcome();
    let found = findings(&outcome.quality, &outcome.energy, (dt, None));
    assert!(found.iter().any(|own| own.what.contains("energy balance")), "{found:?}");
}

/// A mass of 10 mg on a damper that would stop it in a nanosecond: Newmark's method has it move to and fro for ever.
#[test]
fn a_light_mass_on_a_stiff_damper_rings_unless_it_is_damped() {
    for stiffness in [1e6, 0.0] {
        let machine = mass([1e-5, stiffness, 1e4], (10.0, TimeFunction::Constant), Rotation::Held);
        for (integrator, rings) in
            [(Integrator::default(), true), (Integrator::generalized_alpha(0.9), false)]
        {
            let own = MarchOptions { integrator, ..options(1e-4, 2000) };
            let mut march = March::new(&machine, &own).expect("starts");
            while !march.is_done() {
                march.advance().expect("converges");
            }
            let speed = march.state().v[1];
            let outcome = march.outcome();
            let ringing = outcome.quality.ringing;
            let found = findings(&outcome.quality, &outcome.energy, (1e-4, None));
            let found = found.iter().any(|own| own.what.contains("alternates from step to step"));
            assert_eq!((found, ringing.damped), (rings, !rings), "{stiffness}: {ringing:?}");
            if rings {
                assert_eq!(ringing.of, Some(RingingPart::Velocity(0)));
            } else {
                // On the damper alone it moves at F/c; on the spring it creeps there within 10 ms.
                let exact = 1e-3 * (-stiffness / 1e4 * 0.2_f64).exp();
                assert!((speed - exact).abs() < 1e-9, "{speed} for {exact}");
            }
        }
    }
}

/// What rings over the first tenth of a run, and dies there.
#[test]
fn ringing_that_dies_early_is_seen() {
    // λ = (1 − x)/(1 + x), x = cΔt/2m.
    let (dt, x) = (1e-3, 99.0);
    let machine = mass([1.0, 0.0, 2.0 * x / dt], (10.0, TimeFunction::Constant), Rotation::Held);
    let share = |steps: usize| {
        let mut march = March::new(&machine, &options(dt, steps)).expect("starts");
        while !march.is_done() {
            march.advance().expect("converges");
        }
        march.outcome().quality.ringing.share
    };
    // Windows begin every 32 steps from step 22 on. The last of their ten has ½ · 0.98^n of the range; a twentieth of the windows may have more. Classes
    // of 1/50 decade round up.
    for steps in [640_usize, 1600] {
        let windows = steps / 32;
        let after = windows - (19 * windows).div_ceil(20);
        let exact = 0.5 * 0.98_f64.powi(22 + 32 * after as i32 + 9);
        let found = share(steps);
        assert!(found > 0.98 * exact && found < 1.06 * exact, "{steps}: {found} for {exact}");
    }
}
