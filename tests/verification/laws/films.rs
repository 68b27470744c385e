//! Oil films, against Reynolds' equation integrated around the bore and against published figures.

use std::f64::consts::PI;

use super::kernel::{Kernel, integral};

/// A short film: μ R L³, clearance, and the squeeze velocity ė − ω/2 k × e of a point.
struct Film {
    law: &'static str,
    scale: f64,
    clearance: f64,
}

const DAMPER: Film = Film {
    law: "squeeze-film-damper",
    scale: 0.01 * 0.05 * 0.025 * 0.025 * 0.025,
    clearance: 1e-4,
};
const JOURNAL: Film =
    Film { law: "ocvirk", scale: 0.02 * 0.025 * 0.02 * 0.02 * 0.02, clearance: 5e-5 };

/// Position, velocity and speed of the journal.
#[derive(Clone, Copy, Debug)]
struct State {
    e: [f64; 2],
    e_dot: [f64; 2],
    omega: f64,
}

impl Film {
    fn force(&self, state: State) -> [f64; 2] {
        ["F_x", "F_y"].map(|output| self.output(output, state))
    }

    fn output(&self, output: &str, State { e, e_dot, omega }: State) -> f64 {
        let mut inputs =
            vec![("e_x", e[0]), ("e_y", e[1]), ("e_x_dot", e_dot[0]), ("e_y_dot", e_dot[1])];
        if self.law == "ocvirk" {
            inputs.push(("omega", omega));
        }
        Kernel::named(self.law).value(output, &inputs)
    }

    /// −∫ p n R dψ dz with the pressure of a short film, (L³/6)·(6 μ/h³)(v·n) once integrated over z, where
    /// it is positive; all around for `full`.
    fn by_quadrature(&self, State { e, e_dot, omega }: State, full: bool) -> [f64; 2] {
        let v = [e_dot[0] + omega / 2.0 * e[1], e_dot[1] - omega / 2.0 * e[0]];
        let middle = v[1].atan2(v[0]);
        let half = if full { PI } else { PI / 2.0 };
        [0, 1].map(|i| {
            -self.scale
                * integral(middle - half, middle + half, |psi| {
                    let n = [psi.cos(), psi.sin()];
                    let h = self.clearance - e[0] * n[0] - e[1] * n[1];
                    (v[0] * n[0] + v[1] * n[1]) / h.powi(3) * n[i]
                })
        })
    }
}

fn close(found: [f64; 2], expected: [f64; 2], tolerance: f64, place: &str) {
    let size = f64::hypot(expected[0], expected[1]);
    let off = f64::hypot(found[0] - expected[0], found[1] - expected[1]);
    assert!(off <= tolerance * size, "{place}: {found:?} {expected:?}");
}

/// Eccentricities, and velocities in directions that are in no way special. At millions of times the speed
/// below which a film damps as if centred, that changes nothing: its share enters squared.
fn states(clearance: f64, omega: f64) -> Vec<State> {
    let mut states = Vec::new();
    for (place, ratio) in [0.0, 1e-6, 0.1, 0.5, 0.9].into_iter().enumerate() {
        for turn in 0..5 {
            let (at, along) = (0.3 + 1.1 * place as f64, 0.2 + 1.3 * f64::from(turn));
            let (e, speed) = (ratio * clearance, 3.0);
            states.push(State {
                e: [e * at.cos(), e * at.sin()],
                e_dot: [speed * along.cos(), speed * along.sin()],
                omega,
            });
        }
    }
    states
}

#[test]
fn half_films_carry_what_the_positive_pressure_does() {
    for (film, omega) in [(DAMPER, 0.0), (JOURNAL, 0.0), (JOURNAL, 3e4)] {
        for state in states(film.clearance, omega) {
            let place = format!("{} {state:?}", film.law);
            close(film.force(state), film.by_quadrature(state, false), 1e-11, &place);
        }
    }
}

#[test]
fn the_full_film_carries_pressure_and_suction() {
    let film = Film { law: "squeeze-film-damper-full", ..DAMPER };
    for state in states(film.clearance, 0.0) {
        let place = format!("{state:?}");
        close(film.force(state), film.by_quadrature(state, true), 1e-11, &place);
    }
}

#[test]
fn dampers_on_circular_orbits_have_the_published_coefficients() {
    let c = DAMPER.clearance;
    for ratio in [0.1, 0.4, 0.8] {
        let (e, whirl) = (ratio * c, 100.0);
        let state = State { e: [e, 0.0], e_dot: [0.0, whirl * e], omega: 0.0 };
        let root = f64::sqrt(1.0 - ratio * ratio);
        // Gunter, Barrett, Allaire (1977), pi film: K₀ = 2 μ R L³ ω ε/(c³ (1 − ε²)²),
        // C₀ = π μ R L³/(2 c³ (1 − ε²)^1.5).
        let stiffness = 2.0 * DAMPER.scale * whirl * ratio / (c.powi(3) * root.powi(4));
        let damping = PI * DAMPER.scale / (2.0 * c.powi(3) * root.powi(3));
        let blended = 20.0 * (1e-6 / (whirl * e)).powi(2);
        let expected = [-stiffness * e, -damping * whirl * e];
        close(DAMPER.force(state), expected, 1e-12 + blended, "half film");
        // Full film: no stiffness, twice the damping.
        let full = Film { law: "squeeze-film-damper-full", ..DAMPER };
        close(full.force(state), [0.0, 2.0 * expected[1]], 1e-12, "full film");
    }
}

#[test]
fn the_journal_bearing_has_ocvirks_attitude_and_load() {
    let omega = 300.0;
    for (ratio, attitude, load) in
        [(0.1, 82.71, 0.0804), (0.5, 53.68, 0.7504), (0.9, 20.83, 24.006)]
    {
        for at in [0.0_f64, 1.0, 4.0] {
            let e = [at.cos(), at.sin()].map(|x| ratio * JOURNAL.clearance * x);
            let force = JOURNAL.force(State { e, e_dot: [0.0; 2], omega });
            // The load balances the force; the line of centres leads it by the attitude angle.
            let lead = (at - f64::atan2(-force[1], -force[0])).rem_euclid(2.0 * PI);
            assert!(
                (lead.to_degrees() - attitude).abs() <= 0.005,
                "{ratio}: {}",
                lead.to_degrees()
            );
            let size = f64::hypot(force[0], force[1]);
            let number = size * JOURNAL.clearance.powi(2) / (JOURNAL.scale * omega);
            // Half a unit of the last printed digit.
            let digit = if ratio < 0.8 { 5e-5 } else { 5e-4 };
            assert!((number - load).abs() <= digit, "{ratio}: {number}");
        }
    }
}

#[test]
fn films_are_finite_at_the_centre_and_beyond_the_wall() {
    let c = JOURNAL.clearance;
    let still = State { e: [0.0; 2], e_dot: [0.0; 2], omega: 300.0 };
    assert_eq!(JOURNAL.force(still), [0.0, 0.0]);
    // Petroff: 2π μ R³ L ω/c.
    let petroff = -2.0 * PI * 0.02 * 0.025_f64.powi(3) * 0.02 * 300.0 / c;
    assert!((JOURNAL.output("M_z", still) / petroff - 1.0).abs() < 1e-14);
    // Half-speed whirl: the film squeezes as fast as the wedge draws in, and carries nothing.
    let e = 0.3 * c;
    let whirling = State { e: [e, 0.0], e_dot: [0.0, 150.0 * e], omega: 300.0 };
    let standing = State { e_dot: [0.0; 2], ..whirling };
    let size = |force: [f64; 2]| f64::hypot(force[0], force[1]);
    assert!(size(JOURNAL.force(whirling)) < 1e-12 * size(JOURNAL.force(standing)));
    let kernel = Kernel::named("ocvirk");
    for ratio in [0.0, 1e-9, 0.98999, 0.99, 0.99001, 1.0, 1.5, 100.0] {
        let inputs = [("e_x", -ratio * c), ("omega", 300.0)];
        for output in ["F_x", "F_y", "M_z"] {
            assert!(kernel.value(output, &inputs).is_finite());
            for by in ["e_x", "e_y", "e_x_dot", "e_y_dot", "omega"] {
                assert!(
                    kernel.slope(output, by, &inputs).is_finite(),
                    "d{output}/d{by} at {ratio}"
                );
            }
        }
    }
    // At the centre, half the damping of the full film and, through the wedge, ω/2 of it across.
    let damping = PI / 2.0 * JOURNAL.scale / c.powi(3);
    let slope = |output, by| kernel.slope(output, by, &[("omega", 300.0)]);
    assert!((slope("F_x", "e_x_dot") / -damping - 1.0).abs() < 1e-12);
    assert!((slope("F_x", "e_y") / (-damping * 150.0) - 1.0).abs() < 1e-12);
    assert!((slope("F_y", "e_x") / (damping * 150.0) - 1.0).abs() < 1e-12);
}

#[test]
fn friction_of_the_journal_and_of_the_bore_balance_the_couple_of_the_force() {
    // Shear of the film on the journal, −μ R²(ω R/h) all around and −R (h/2)∂p/∂ψ, by quadrature of the first
    // and by parts of the second: (R/2)∫ p ∂h/∂ψ with the pressure of the half film.
    let (radius, length, viscosity) = (0.025, 0.02, 0.02);
    for state in states(JOURNAL.clearance, 3e4) {
        let State { e, e_dot, omega } = state;
        let height = |psi: f64| JOURNAL.clearance - e[0] * psi.cos() - e[1] * psi.sin();
        let shear = -viscosity
            * omega
            * radius
            * radius
            * radius
            * length
            * integral(0.0, 2.0 * PI, |psi| 1.0 / height(psi));
        let v = [e_dot[0] + omega / 2.0 * e[1], e_dot[1] - omega / 2.0 * e[0]];
        let middle = v[1].atan2(v[0]);
        let wedge = 0.5
            * JOURNAL.scale
            * integral(middle - PI / 2.0, middle + PI / 2.0, |psi| {
                let along = v[0] * psi.cos() + v[1] * psi.sin();
                along / height(psi).powi(3) * (e[0] * psi.sin() - e[1] * psi.cos())
            });
        let found = JOURNAL.output("M_z", state);
        assert!((found - shear - wedge).abs() < 1e-11 * shear.abs(), "{found} {shear} {wedge}");
    }
}
