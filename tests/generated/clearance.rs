//! The clearance's rates, forces and tangent, against hyper-dual evaluation of the formula itself and
//! against central differences of the kernels.

use whirl_specs::clearances::journal::value;
use whirl_specs::{CLEARANCES, Clearance, Ring, RingTangent, SpringForce};

use crate::hyper::Hyper;
use crate::random::Random;

const SPRINGS: usize = 24;
/// Ring coordinates and one coordinate a spring.
const COORDINATES: usize = 3 + SPRINGS;
const C: f64 = 3.5e-5;
const A1: f64 = 27.0;

/// A smooth law, with derivatives: Q (N) of h (m) and ḣ (m/s).
fn law(h: f64, h_dot: f64) -> [f64; 3] {
    let (s, v) = (h / C, h_dot / 0.01);
    let q = 400.0 * (1.0 - s).powi(2) - 30.0 * v * (2.0 - s) + 5.0 * v * v;
    let by_s = -800.0 * (1.0 - s) + 30.0 * v;
    let by_v = -30.0 * (2.0 - s) + 10.0 * v;
    [q, by_s / C, by_v / 0.01]
}

fn psi(j: usize) -> f64 {
    15.0_f64.to_radians() * j as f64
}

/// All coordinates and their rates: θ, ε_x, ε_y, then δ of every spring.
#[derive(Clone)]
struct State {
    q: [f64; COORDINATES],
    rate: [f64; COORDINATES],
}

impl State {
    fn random(random: &mut Random) -> Self {
        let mut q = [0.0; COORDINATES];
        let mut rate = [0.0; COORDINATES];
        q.iter_mut().for_each(|q| *q = 2e-5 * (random.unit() - 0.5));
        rate.iter_mut().for_each(|rate| *rate = 0.02 * (random.unit() - 0.5));
        q[0] = 6.0 * random.unit();
        rate[0] = 471.0 * random.unit();
        State { q, rate }
    }

    /// Moved along `direction`, with the rates following as in a time step.
    fn moved(&self, direction: &[f64; COORDINATES], step: f64) -> Self {
        let mut moved = self.clone();
        for (place, d) in direction.iter().enumerate() {
            moved.q[place] += step * d;
            moved.rate[place] += step * A1 * d;
        }
        moved
    }

    fn ring(&self) -> Ring {
        let three = |values: &[f64]| [values[0], values[1], values[2]];
        Ring { position: three(&self.q), velocity: three(&self.rate), c: C }
    }

    /// h of spring j in numbers that carry derivatives along `first` and `second`.
    fn hyper(&self, j: usize, first: &[f64; COORDINATES], second: &[f64; COORDINATES]) -> Hyper {
        let at = |i: usize| Hyper::new(self.q[i], first[i], second[i]);
        let constant = |value: f64| Hyper::new(value, 0.0, 0.0);
        value(constant(psi(j)), at(0), at(1), at(2), at(3 + j), constant(C))
    }
}

struct Bench {
    kernels: &'static Clearance,
    table: Vec<f64>,
}

impl Bench {
    fn new() -> Self {
        let kernels = &CLEARANCES[0];
        let angles: Vec<f64> = (0..SPRINGS).map(psi).collect();
        let mut table = vec![0.0; kernels.table * SPRINGS];
        (kernels.prepare)(&angles, &mut table);
        Bench { kernels, table }
    }

    fn clearance(&self, state: &State) -> (Vec<f64>, Vec<f64>) {
        let (mut h, mut h_dot) = (vec![0.0; SPRINGS], vec![0.0; SPRINGS]);
        (self.kernels.clearance)(
            SPRINGS,
            &self.table,
            &state.ring(),
            &state.q[3..],
            &state.rate[3..],
            &mut h,
            &mut h_dot,
        );
        (h, h_dot)
    }

    fn law(&self, state: &State) -> [Vec<f64>; 3] {
        let (h, h_dot) = self.clearance(state);
        let rows: Vec<[f64; 3]> = h.iter().zip(&h_dot).map(|(h, v)| law(*h, *v)).collect();
        std::array::from_fn(|row| rows.iter().map(|values| values[row]).collect())
    }

    /// Generalised forces on all coordinates.
    fn force(&self, state: &State) -> Vec<f64> {
        let [q, ..] = self.law(state);
        let (mut ring, mut springs) = ([0.0; 3], vec![0.0; SPRINGS]);
        (self.kernels.force)(
            SPRINGS,
            &self.table,
            &state.ring(),
            &state.q[3..],
            &q,
            &mut ring,
            &mut springs,
        );
        ring.into_iter().chain(springs).collect()
    }

    /// B + a1·P times a direction.
    fn tangent(&self, state: &State, direction: &[f64; COORDINATES]) -> Vec<f64> {
        let [q, dq_dh, dq_dh_dot] = self.law(state);
        let forces = SpringForce { q: &q, dq_dh: &dq_dh, dq_dh_dot: &dq_dh_dot };
        let mut t = RingTangent::new(SPRINGS);
        (self.kernels.tangent)(
            SPRINGS,
            &self.table,
            &state.ring(),
            &state.q[3..],
            &state.rate[3..],
            &forces,
            A1,
            &mut t,
        );
        let mut product = vec![0.0; COORDINATES];
        for i in 0..3 {
            for (row, d) in t.ring_ring[i].iter().zip(direction) {
                product[i] += row * d;
            }
            for j in 0..SPRINGS {
                product[i] += t.ring_spring[i][j] * direction[3 + j];
                product[3 + j] += t.spring_ring[i][j] * direction[i];
            }
        }
        for j in 0..SPRINGS {
            product[3 + j] += t.spring_spring[j] * direction[3 + j];
        }
        product
    }
}

fn unit(place: usize) -> [f64; COORDINATES] {
    std::array::from_fn(|i| f64::from(u8::from(i == place)))
}

/// A direction whose parts move the clearance alike.
fn direction(random: &mut Random) -> [f64; COORDINATES] {
    std::array::from_fn(|i| (random.unit() - 0.5) * if i == 0 { 0.3 } else { 1e-5 })
}

/// Largest difference, each over the largest value of its kind (ring or spring coordinate).
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let mut worst = 0.0_f64;
    for kind in [0..1, 1..3, 3..COORDINATES] {
        let scale = b[kind.clone()].iter().fold(f64::MIN_POSITIVE, |m, v| m.max(v.abs()));
        for i in kind {
            worst = worst.max((a[i] - b[i]).abs() / scale);
        }
    }
    worst
}

/// Rounding in sums over 24 springs of terms that cancel by up to a factor of 100.
const ROUNDING: f64 = 24.0 * 100.0 * f64::EPSILON;

#[test]
fn clearance_and_rate_follow_from_the_formula() {
    let (bench, mut random) = (Bench::new(), Random::new(1));
    for _ in 0..20 {
        let state = State::random(&mut random);
        let (h, h_dot) = bench.clearance(&state);
        for j in 0..SPRINGS {
            let exact = state.hyper(j, &state.rate, &[0.0; COORDINATES]).0;
            assert!((h[j] - exact.re).abs() <= 8.0 * f64::EPSILON * C);
            let scale = state.rate[0].abs() * 2e-5 + 0.02;
            assert!((h_dot[j] - exact.eps1).abs() <= 16.0 * f64::EPSILON * scale);
        }
    }
}

#[test]
fn forces_and_tangent_follow_from_the_formula() {
    let (bench, mut random) = (Bench::new(), Random::new(2));
    for _ in 0..20 {
        let state = State::random(&mut random);
        let d = direction(&mut random);
        let (mut force, mut tangent) = (vec![0.0; COORDINATES], vec![0.0; COORDINATES]);
        for j in 0..SPRINGS {
            // ε₁ along the direction, ε₂ along the motion: h, dh, ḣ and dḣ of the spring.
            let motion = state.hyper(j, &d, &state.rate).0;
            let [q, dq_dh, dq_dh_dot] = law(motion.re, motion.eps2);
            let dh = motion.eps1;
            // The rates move by a1·d, along which ḣ changes by a1·dh.
            let dh_dot = motion.eps1eps2 + A1 * dh;
            for i in [0, 1, 2, 3 + j] {
                let slope = state.hyper(j, &d, &unit(i)).0;
                force[i] += q * slope.eps2;
                tangent[i] += (dq_dh * dh + dq_dh_dot * dh_dot) * slope.eps2 + q * slope.eps1eps2;
            }
        }
        assert!(difference(&bench.force(&state), &force) <= ROUNDING);
        assert!(difference(&bench.tangent(&state, &d), &tangent) <= ROUNDING);
    }
}

#[test]
fn central_differences_of_the_forces_approach_the_tangent_as_the_step_squared() {
    let (bench, mut random) = (Bench::new(), Random::new(3));
    for _ in 0..20 {
        let state = State::random(&mut random);
        let d = direction(&mut random);
        let tangent = bench.tangent(&state, &d);
        let error = |step: f64| {
            let (ahead, behind) =
                (bench.force(&state.moved(&d, step)), bench.force(&state.moved(&d, -step)));
            let slope: Vec<f64> =
                ahead.iter().zip(&behind).map(|(a, b)| (a - b) / (2.0 * step)).collect();
            difference(&slope, &tangent)
        };
        let (coarse, fine) = (error(0.1), error(0.01));
        let ratio = coarse / fine;
        assert!((ratio / 100.0 - 1.0).abs() < 0.05, "coarse {coarse:e}, fine {fine:e}");
    }
}

#[test]
fn the_rotation_feels_the_springs_off_centre() {
    // A fixed-frame argument would put a zero in the θ row: a displaced journal then swings.
    let bench = Bench::new();
    let state = State::random(&mut Random::new(4));
    assert!(bench.force(&state)[0].abs() > 1e-6);
}

#[test]
fn axial_functions_interpolate_quadratics() {
    let axial = CLEARANCES[0].axial;
    for (place, s) in [0.0, 0.5, 1.0].into_iter().enumerate() {
        let weights = axial(s);
        assert_eq!(weights, std::array::from_fn(|i| f64::from(u8::from(i == place))));
    }
    let [a, b, c] = axial(0.3);
    let f = |s: f64| 1.0 - 2.0 * s + 5.0 * s * s;
    let value = a * f(0.0) + b * f(0.5) + c * f(1.0);
    assert!((value - f(0.3)).abs() <= 8.0 * f64::EPSILON * 4.0);
}
