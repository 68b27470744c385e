//! Oil whirl of a rigid rotor in two short films: the speed, or here the mass, at which its equilibrium is lost. Linear
//! theory: Holmes, J. Mech. Eng. Sci. 2 (1960) 337-341; here by the closed coefficients of the short film.

use whirl_solver::dynamics::{
    Coefficients, Equilibrium, March, MarchOptions, Newmark, equilibrium,
};
use whirl_solver::equations::{Equations, State};
use whirl_solver::machine::{Machine, Rotation};

use super::super::options;
use super::short_film::{coefficients, load};
use super::{C, SPEED, rigid_rotor};

/// p² = m c ω²/W at the threshold by Routh's criterion, for a mass m a bearing with the coefficients K c/W and C c ω/W.
fn threshold([a, b]: [[[f64; 2]; 2]; 2]) -> f64 {
    let [[k_uu, k_uv], [k_vu, k_vv]] = a;
    let [[c_uu, c_uv], [c_vu, c_vv]] = b;
    // At the threshold the stiffness against the whirl, κ = p²γ², balances the mass at the whirl frequency γ ω.
    let kappa = (k_uu * c_vv + k_vv * c_uu - k_uv * c_vu - k_vu * c_uv) / (c_uu + c_vv);
    let squared = ((k_uu - kappa) * (k_vv - kappa) - k_uv * k_vu) / (c_uu * c_vv - c_uv * c_vu);
    kappa / squared
}

/// K and C of one film in space at an equilibrium, from the tangent of the whole machine.
///
/// The rotor's equations are in the frame that turns. At θ = 0: η = x, η̇ = ẋ − ω k×x, η̈ = ẍ − 2ω k×ẋ − ω² x.
fn linearised(machine: &Machine, found: &Equilibrium, mass: f64) -> [[[f64; 2]; 2]; 2] {
    let own = &found.bodies[0];
    let mut state = State::new(5);
    state.v[0] = SPEED;
    state.q[1..5].copy_from_slice(&own.position);
    state.v[1..5].copy_from_slice(&own.velocity);
    // A standing deflection has no acceleration in space.
    for (axis, along) in [(1, -1.0), (2, -1.0)] {
        state.a[axis] = along * SPEED * SPEED * state.q[axis];
    }
    let mut equations = Equations::new(machine);
    let mut tangent = |dt: f64| {
        equations.evaluate(0.0, &state);
        let mut out = vec![0.0; 25];
        equations.tangent(
            0.0,
            &state,
            Coefficients::new(Newmark::default(), dt).weights(),
            &mut out,
        );
        // a1 = 2/Δt and a2 = 4/Δt² of the average acceleration.
        [[1, 1], [1, 2], [2, 1], [2, 2]].map(|[i, j]| out[5 * j + i])
    };
    // T(Δt) = K + (2/Δt) C + (4/Δt²) M at 2/Δt = s, 2s, 3s: second differences.
    let s = 2e3;
    let [one, two, three] = [1.0, 2.0, 3.0].map(|k| tangent(2.0 / (k * s)));
    let at = |entry: usize| {
        let m = (three[entry] - 2.0 * two[entry] + one[entry]) / (2.0 * s * s);
        let c = (two[entry] - one[entry]) / s - 3.0 * s * m;
        [one[entry] - s * c - s * s * m, c, m]
    };
    let [xx, xy, yx, yy] = [0, 1, 2, 3].map(at);
    assert!((xx[2] / mass - 1.0).abs() < 1e-6 && (yy[2] / mass - 1.0).abs() < 1e-6);
    // J = k×: J x = (−y, x).
    let j = [[0.0, -1.0], [1.0, 0.0]];
    let times_j = |m: [[f64; 2]; 2]| {
        [0, 1].map(|row| [0, 1].map(|col| (0..2).map(|k| m[row][k] * j[k][col]).sum::<f64>()))
    };
    let [k, c, m] = [0, 1, 2].map(|which| [[xx[which], xy[which]], [yx[which], yy[which]]]);
    let (cj, mj) = (times_j(c), times_j(m));
    let stiffness = [0, 1].map(|row| {
        [0, 1].map(|col| k[row][col] - SPEED * cj[row][col] - SPEED * SPEED * m[row][col])
    });
    let damping = [0, 1].map(|row| [0, 1].map(|col| c[row][col] - 2.0 * SPEED * mj[row][col]));
    [stiffness, damping].map(|matrix| matrix.map(|row| row.map(|own| 0.5 * own)))
}

fn rotor(mass: f64, eps: f64) -> Machine {
    let rotation = Rotation::Prescribed { speed: SPEED, acceleration: 0.0 };
    rigid_rotor(mass, 2.0 * load(eps, SPEED), 0.0, rotation)
}

#[test]
fn the_threshold_of_oil_whirl_is_that_of_linear_theory() {
    for eps in [0.1, 0.3, 0.5, 0.7] {
        let carried = load(eps, SPEED);
        let machine = rotor(10.0, eps);
        let found = equilibrium(&machine, &[None], None).expect("is there");
        let [stiffness, damping] = linearised(&machine, &found, 10.0);
        let scaled = |matrix: [[f64; 2]; 2], by: f64| {
            matrix.map(|row| row.map(|own| own * by * C / carried))
        };
        let own = threshold([scaled(stiffness, 1.0), scaled(damping, SPEED)]);
        let exact = threshold(coefficients(eps));
        println!("ε {eps}: p {:.4}, by linear theory {:.4}", own.sqrt(), exact.sqrt());
        assert!((own / exact - 1.0).abs() < 0.02, "{own} for {exact}");
    }
}

/// Distance of the centre from its equilibrium over that at the start, at its largest in the last of so many revolutions.
fn growth(mass: f64, eps: f64, revolutions: usize) -> f64 {
    const STEPS: usize = 100;
    let machine = rotor(mass, eps);
    let found = equilibrium(&machine, &[None], None).expect("is there");
    let at = [0, 1].map(|axis| found.bodies[0].position[axis]);
    let moved = 1e-3 * C;
    let mut initial = found.bodies;
    initial[0].position[0] += moved;
    initial[0].velocity[1] -= SPEED * moved;
    let dt = std::f64::consts::TAU / SPEED / STEPS as f64;
    let options = MarchOptions { initial, ..options(dt, STEPS * revolutions) };
    let mut march = March::new(&machine, &options).expect("starts");
    let mut largest = 0.0_f64;
    while !march.is_done() {
        march.advance().expect("the step converges");
        if march.progress().step > STEPS * (revolutions - 2) {
            let q = &march.state().q;
            let (sin, cos) = q[0].sin_cos();
            let [x, y] = [cos * q[1] - sin * q[2], sin * q[1] + cos * q[2]];
            largest = largest.max((x - at[0]).hypot(y - at[1]));
        }
    }
    largest / moved
}

#[test]
fn beyond_the_threshold_a_start_in_equilibrium_whirls_and_below_it_settles() {
    let eps = 0.5;
    let critical = 2.0 * threshold(coefficients(eps)) * load(eps, SPEED) / (C * SPEED * SPEED);
    let [below, beyond] = [0.95, 1.05].map(|share| growth(share * critical, eps, 60));
    println!("critical mass {critical:.3} kg: {below:.4} at 0.95 of it, {beyond:.4} at 1.05");
    assert!(below < 0.7 && beyond > 1.4, "{below} {beyond}");
}
