//! The laws with states of the library: friction that sticks, the inertia of a squeezed film, a film that warms up.

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, Matrix3};
use whirl_solver::bearing::SpringLaw;
use whirl_solver::dynamics::{MarchOptions, equilibrium};
use whirl_solver::linear::LinearMachine;
use whirl_solver::loads::TimeFunction;
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::super::{options, parts, stops};
use super::{MASS, Taped, marched, mass_on, shipped};

const STILL: (f64, TimeFunction) = (0.0, TimeFunction::Constant);

/// Outputs and rates of a law where inputs and states have these values; those not named are zero. SI.
fn values(name: &str, at: &[(&str, f64)]) -> Vec<f64> {
    let law = shipped(name);
    let states = law.states();
    let names: Vec<&str> =
        law.inputs().into_iter().chain(states.iter().map(|own| own.name.as_str())).collect();
    let mut inputs = vec![0.0; names.len()];
    for (name, value) in at {
        inputs[names.iter().position(|own| own == name).expect("a name")] = *value;
    }
    let rows = law.outputs().len() + states.len();
    let mut outputs = vec![f64::NAN; rows * (1 + names.len())];
    law.evaluate(1, &inputs, &mut outputs, &mut vec![0.0; law.workspace()]);
    outputs.chunks(1 + names.len()).map(|row| row[0]).collect()
}

/// A law of the library with other texts in its file.
fn changed(name: &str, changes: &[(&str, &str)]) -> Box<dyn SpringLaw> {
    let path = format!("{}/../specs/laws/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let mut text = std::fs::read_to_string(path).expect("a law");
    for (from, to) in changes {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text = text.replace(from, to);
    }
    Box::new(Taped::of(text))
}

/// The mass on a law of a ring and on springs of its own (N/m).
fn held_by(law: Box<dyn SpringLaw>, stiffness: f64, rotation: Rotation) -> Machine {
    let shaft = Shaft::lumped(MASS, [stiffness; 2], [0.0; 2], 0.0);
    let mut parts = parts(shaft, Support::rigid(&[]), rotation);
    parts.laws = vec![law];
    parts.bearings = vec![stops("film", 1e-3, &[0.0], 0)];
    Machine::new(parts).expect("a machine")
}

/// In steady sliding the bristles stay as they are, and friction is F_c + (F_s − F_c) e^{−(v/v_s)²} against the motion, whatever
/// its direction.
#[test]
fn friction_slides_at_the_curve_of_stribeck() {
    let (stiff, fast, slow, stribeck) = (1e7, 50.0, 60.0, 5e-3_f64);
    for speed in [1e-3, 4e-3, 2e-2, 1.0] {
        for angle in [0.0_f64, 2.1, 4.4] {
            let slips = fast + (slow - fast) * (-(speed / stribeck).powi(2)).exp();
            let bent = slips / stiff;
            let (sin, cos) = angle.sin_cos();
            let at = [
                ("e_x_dot", speed * cos),
                ("e_y_dot", speed * sin),
                ("z_x", bent * cos),
                ("z_y", bent * sin),
            ];
            let own = values("friction-lugre", &at);
            for (found, exact) in own.iter().zip([-slips * cos, -slips * sin, 0.0, 0.0]) {
                // v₀ is a thousandth of the slowest speed.
                let scale = if exact == 0.0 { speed.max(slips) } else { slips };
                assert!((found - exact).abs() < 1e-6 * scale, "{speed} {angle}: {own:?}");
            }
        }
    }
}

/// With F_s = F_c and no damping it is Dahl's: a mass that is thrown is braked by F_c (1 − e^{−k_t x/F_c}), whatever its speed.
#[test]
fn a_mass_is_braked_along_the_curve_of_dahl() {
    let (stiff, slips, speed) = (1e7, 50.0, 5e-3_f64);
    let dahl = [
        ("value = 60\n", "value = 50\n"),
        ("value = 1\nunit = \"N*s/mm\"", "value = 0\nunit = \"N*s/mm\""),
        // What creeps back is no part of his.
        ("value = 1e-3\nunit = \"mm/s\"", "value = 1e-9\nunit = \"mm/s\""),
    ];
    let errors = |steps: usize| {
        let machine = mass_on(changed("friction-lugre", &dahl), STILL, Rotation::Held);
        // Braked to two fifths at the end.
        let mut own: MarchOptions = options(2.6e-3 / steps as f64, steps);
        own.initial[0].velocity = vec![speed, 0.0];
        let (mut worst, mut last) = ([0.0_f64; 2], 0.0);
        marched(&machine, &own, |march| {
            let state = march.state();
            let (x, v) = (state.q[1], state.v[1]);
            let bent = slips / stiff * (1.0 - (-stiff * x / slips).exp());
            let lost = slips * (x - bent);
            let errors = [
                (state.laws.known[0] - bent) / bent,
                (v * v + 2.0 * lost / MASS) / speed.powi(2) - 1.0,
            ];
            worst = [0, 1].map(|place| worst[place].max(errors[place].abs()));
            last = v;
        });
        assert!(last > 0.2 * speed && last < 0.6 * speed, "{last}");
        worst
    };
    let [coarse, fine] = [500, 1000].map(errors);
    for place in 0..2 {
        assert!(fine[place] < 1e-4, "{fine:?}");
        assert!((3.5..4.5).contains(&(coarse[place] / fine[place])), "{coarse:?} {fine:?}");
    }
}

/// What inertia adds to the force of the film is −(6/5) ρ R (L³/12) ∫ (a·n) n/h dψ of the acceleration a that the lag of the states
/// stands for, at any eccentricity.
#[test]
fn the_inertia_of_a_film_is_that_of_its_pressure_around_the_bore() {
    let (rho, radius, length, clearance, tau) = (870.0, 0.05, 0.025_f64, 1e-4, 2e-5);
    for (eccentricity, angle) in [(0.0, 0.0), (0.3, 0.4), (0.7, 2.5), (0.95, 5.0_f64)] {
        let e = [angle.cos(), angle.sin()].map(|own| eccentricity * clearance * own);
        let (e_dot, a) = ([0.02, -0.01], [30.0, 50.0]);
        let motion = [("e_x", e[0]), ("e_y", e[1]), ("e_x_dot", e_dot[0]), ("e_y_dot", e_dot[1])];
        let d = [0, 1].map(|axis| e_dot[axis] - tau * a[axis]);
        let lagging = motion.into_iter().chain([("d_x", d[0]), ("d_y", d[1])]);
        let own = values("squeeze-film-damper-inertia", &lagging.collect::<Vec<_>>());
        let without = values("squeeze-film-damper-full", &motion);
        // Periodic: the plain sum converges as the powers of (1 − W)/ε do.
        let count = 4000;
        let mut sum = [0.0; 2];
        for place in 0..count {
            let psi = TAU * f64::from(place) / f64::from(count);
            let n = [psi.cos(), psi.sin()];
            let h = clearance - e[0] * n[0] - e[1] * n[1];
            let part = (a[0] * n[0] + a[1] * n[1]) / h * TAU / f64::from(count);
            sum = [0, 1].map(|axis| sum[axis] + part * n[axis]);
        }
        let scale = 1.2 * rho * radius * length.powi(3) / 12.0;
        let size = scale * sum[0].hypot(sum[1]);
        for axis in 0..2 {
            let added = own[axis] - without[axis];
            assert!((added + scale * sum[axis]).abs() < 1e-9 * size, "{eccentricity}: {added}");
            assert!((own[2 + axis] - a[axis]).abs() < 1e-9 * 50.0, "{own:?}");
        }
    }
}

/// A mass on a spring and in the film moves by the roots of its state space, its film's damping and added mass included.
#[test]
fn a_mass_in_a_film_with_inertia_has_the_roots_of_its_state_space() {
    let (stiffness, tau) = (1e9, 2e-5);
    let damping = PI * 0.01 * 0.05 * 0.025_f64.powi(3) / 1e-4_f64.powi(3);
    let added = PI * 870.0 * 0.05 * 0.025_f64.powi(3) / (10.0 * 1e-4);
    let rates = Matrix3::new(
        0.0,
        1.0,
        0.0,
        -stiffness / MASS,
        -(damping + added / tau) / MASS,
        added / tau / MASS,
        0.0,
        1.0 / tau,
        -1.0 / tau,
    );
    let exact = rates.complex_eigenvalues().iter().copied().find(|own| own.im > 0.0);
    let exact = exact.expect("it oscillates");
    // Nearly as a mass of both: the filter errs by the square of ωτ.
    let plain = (stiffness / (MASS + added) - (0.5 * damping / (MASS + added)).powi(2)).sqrt();
    assert!((exact.im / plain - 1.0).abs() < 2e-2, "{exact} {plain}");
    let rotation = Rotation::Prescribed { speed: 0.0, acceleration: 0.0 };
    let machine = held_by(shipped("squeeze-film-damper-inertia"), stiffness, rotation);
    let machine = LinearMachine::new(machine).unwrap_or_else(|error| panic!("{error}"));
    let at = machine.standing(&[Some(0.0), None], None).unwrap_or_else(|error| panic!("{error}"));
    let linear = machine.linearised(&at).unwrap_or_else(|error| panic!("{error}"));
    let modes = machine.modes(&linear, 10).expect("has modes").oscillating;
    assert_eq!(modes.len(), 2);
    for own in modes {
        let found = Complex::new(own.value.re, own.value.im);
        assert!((found - exact).norm() < 1e-8 * exact.norm(), "{found} {exact}");
    }
}

/// The shipped film: R, L, c (m), what it is fed with (m³/s), what the housing takes (W/K), and the heat capacities (J/m³/K, J/K).
const FILM: [f64; 3] = [0.025, 0.02, 5e-5];
const FED: f64 = 5e-7;
const HOUSING: f64 = 5.0;
const OIL: f64 = 870.0 * 1950.0;
const CAPACITY: f64 = 5.0;
const SUPPLY: f64 = 313.15;

fn viscosity(kelvin: f64) -> f64 {
    0.027 * (797.7 / (kelvin - 178.15) - 797.7 / (SUPPLY - 178.15)).exp()
}

/// Where the function, which rises, is zero.
fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// A loaded journal stands where Ocvirk's load and attitude at the temperature say so at which friction warms the oil as much as what
/// flows out and the housing cool it.
#[test]
fn a_journal_stands_where_load_and_heat_balance() {
    let (speed, load) = (300.0, 400.0);
    let [radius, length, clearance] = FILM;
    let carried = |eps: f64, mu: f64| {
        let w = (1.0 - eps * eps).sqrt();
        let scale = mu * speed * radius * length.powi(3) / (4.0 * clearance * clearance);
        scale * eps / w.powi(4) * (16.0 * eps * eps + (PI * w).powi(2)).sqrt()
    };
    let attitude = |eps: f64| (PI * (1.0 - eps * eps).sqrt()).atan2(4.0 * eps);
    let warmth = |eps: f64| {
        root(SUPPLY, 500.0, |kelvin| {
            let mu = viscosity(kelvin);
            let w = (1.0 - eps * eps).sqrt();
            let shear = TAU * mu * radius.powi(3) * length * speed / (clearance * w);
            let offset = 0.5 * eps * clearance * carried(eps, mu) * attitude(eps).sin();
            let flow = speed * radius * clearance * length * eps + FED;
            (OIL * flow + HOUSING) * (kelvin - SUPPLY) - (shear + offset) * speed
        })
    };
    let eps = root(1e-3, 0.95, |eps| carried(eps, viscosity(warmth(eps))) - load);
    let warm = warmth(eps);
    assert!((5.0..30.0).contains(&(warm - SUPPLY)), "{warm}");
    let rotation = Rotation::Prescribed { speed, acceleration: 0.0 };
    let machine = mass_on(shipped("ocvirk-warming"), (-load, TimeFunction::Constant), rotation);
    let found = equilibrium(&machine, &[None], None).expect("stands").bodies;
    let [x, y] = [found[0].position[0], found[0].position[1]];
    // x points against the load; the journal turns from x to y.
    let exact = [-attitude(eps).cos(), -attitude(eps).sin()].map(|own| eps * clearance * own);
    let apart = (x - exact[0]).hypot(y - exact[1]);
    assert!(apart < 1e-6 * clearance, "({x}, {y}) for {exact:?}, {warm} K");
}

/// A centred journal warms its cold film as C_h Ṫ = 2π μ(T) R³ L ω²/c − (ρ c_p Q + k_h) (T − T_s) does; the march to second order.
#[test]
fn a_cold_film_warms_up_in_time() {
    let [radius, length, clearance] = FILM;
    let speed = 300.0;
    // v₀ presses out 2 R L v₀.
    let flow = FED + 2.0 * radius * length * 1e-6;
    let rate = |kelvin: f64| {
        let power = TAU * viscosity(kelvin) * radius.powi(3) * length * speed * speed / clearance;
        (power - (OIL * flow + HOUSING) * (kelvin - SUPPLY)) / CAPACITY
    };
    let (duration, fine) = (2.0, 20_000);
    let mut exact = SUPPLY;
    for _ in 0..fine {
        let h = duration / f64::from(fine);
        let k1 = rate(exact);
        let k2 = rate(exact + 0.5 * h * k1);
        let k3 = rate(exact + 0.5 * h * k2);
        exact += h / 6.0 * (k1 + 2.0 * (k2 + k3) + rate(exact + h * k3));
    }
    assert!(exact > SUPPLY + 5.0, "{exact}");
    let error = |steps: usize| {
        let cold = changed("ocvirk-warming", &[("start = \"rest\"", "start = 313.15")]);
        let rotation = Rotation::Prescribed { speed, acceleration: 0.0 };
        let machine = held_by(cold, 1e9, rotation);
        let mut warm = 0.0;
        marched(&machine, &options(duration / steps as f64, steps), |march| {
            warm = march.state().laws.known[0];
        });
        (warm - exact).abs() / (exact - SUPPLY)
    };
    let (coarse, fine) = (error(50), error(100));
    assert!(fine < 1e-4 && (3.8..4.2).contains(&(coarse / fine)), "{coarse} {fine}");
}
