//! PF, B and P three ways: the emitted derivatives, central differences of the emitted Q_v and M q̈, and
//! dual numbers through the primal formulas; M and Q_v from the kinetic energy by hyper-dual numbers.

use nalgebra::DVector;
use whirl_specs::{MotionState, motions};

use super::sample::{LENGTHS, Random, Shaft, State, error, motion};
use crate::hyper::Hyper;

/// Rounding of sums over 77 terms of size 1, with a margin for cancellation: n² eps.
const ROUNDING: f64 = 1e-12;

type Primal = fn(&[&[f64]], &MotionState<Hyper>, &mut [Hyper], &mut [Hyper]);

/// The primal functions of a motion over hyper-dual numbers.
struct Primals {
    name: &'static str,
    quadratic_velocity: Primal,
    mass_times_acceleration: Primal,
}

const PRIMALS: [Primals; 2] = [
    Primals {
        name: "consistent",
        quadratic_velocity: motions::consistent::quadratic_velocity,
        mass_times_acceleration: motions::consistent::mass_times_acceleration,
    },
    Primals {
        name: "hu2003",
        quadratic_velocity: motions::hu2003::quadratic_velocity,
        mass_times_acceleration: motions::hu2003::mass_times_acceleration,
    },
];

/// q and q̇ of a state moved along two directions, by ε₁ and ε₂.
struct HyperState {
    q: Vec<Hyper>,
    v: Vec<Hyper>,
    a: Vec<Hyper>,
}

impl HyperState {
    fn new(at: &State, first: [&DVector<f64>; 2], second: [&DVector<f64>; 2]) -> Self {
        let lanes = |value: &DVector<f64>, k: usize| {
            (0..value.len()).map(|i| Hyper::new(value[i], first[k][i], second[k][i])).collect()
        };
        let a = at.a.iter().map(|value| Hyper::new(*value, 0.0, 0.0)).collect();
        HyperState { q: lanes(&at.q, 0), v: lanes(&at.v, 1), a }
    }

    fn view(&self) -> MotionState<'_, Hyper> {
        MotionState {
            theta: self.q[0],
            theta_dot: self.v[0],
            theta_ddot: self.a[0],
            eta: &self.q[1..],
            eta_dot: &self.v[1..],
            eta_ddot: &self.a[1..],
        }
    }

    fn rows(&self, shaft: &Shaft, name: &str, primal: Primal) -> Vec<Hyper> {
        let motion = motion(name);
        let mut workspace = vec![Hyper::new(0.0, 0.0, 0.0); (motion.workspace)(shaft.n)];
        let mut out = vec![Hyper::new(0.0, 0.0, 0.0); shaft.n + 1];
        primal(&shaft.tensors(motion), &self.view(), &mut workspace, &mut out);
        out
    }
}

fn directions(n: usize) -> impl Iterator<Item = (DVector<f64>, DVector<f64>)> {
    let mut random = Random::new(99);
    (0..5).map(move |_| (random.vector(n + 1), random.vector(n + 1)))
}

#[test]
fn dual_numbers_through_the_primal_formulas_give_the_emitted_derivatives() {
    for n in LENGTHS {
        let (shaft, at) = (Shaft::new(n), State::new(n, 11));
        for primals in PRIMALS {
            let motion = motion(primals.name);
            let [pf, b, p] =
                [motion.pf, motion.b, motion.p].map(|kernel| shaft.blocks(motion, kernel, &at));
            for (u, w) in directions(n) {
                let hyper = HyperState::new(&at, [&u, &w], [&w, &u]);
                let first = |rows: Vec<Hyper>| {
                    DVector::from_iterator(n + 1, rows.iter().map(|row| row.0.eps1))
                };
                let q_v = first(hyper.rows(&shaft, primals.name, primals.quadratic_velocity));
                let emitted = &b * &u + &p * &w;
                assert!(error(&q_v, &emitted) < ROUNDING, "{} {n}", primals.name);
                let ma = first(hyper.rows(&shaft, primals.name, primals.mass_times_acceleration));
                assert!(error(&ma, &(&pf * &u)) < ROUNDING, "{} {n}", primals.name);
            }
        }
    }
}

/// w·M u, w·Q_v = w·∂T/∂q − (q̇·∂/∂q)(w·∂T/∂q̇) and w·p from T alone.
#[test]
fn hyper_dual_numbers_through_the_energy_give_mass_forces_and_momenta() {
    for n in LENGTHS {
        let (shaft, at) = (Shaft::new(n), State::new(n, 12));
        let motion = motion("consistent");
        let mass = shaft.blocks(motion, motion.mass, &at);
        let q_v = shaft.rows(motion, motion.quadratic_velocity, &at);
        let momentum = shaft.rows(motion, motion.momentum.expect("it has momenta"), &at);
        let still = DVector::zeros(n + 1);
        let energy = |first: [&DVector<f64>; 2], second: [&DVector<f64>; 2]| {
            let hyper = HyperState::new(&at, first, second);
            let mut workspace = vec![Hyper::new(0.0, 0.0, 0.0); (motion.workspace)(n)];
            let tensors = shaft.tensors(motion);
            motions::consistent::kinetic_energy(&tensors, &hyper.view(), &mut workspace).0
        };
        for (u, w) in directions(n) {
            let scale = (1 + n * n) as f64;
            let by_velocities = energy([&still, &u], [&still, &w]);
            assert!((by_velocities.eps1eps2 - w.dot(&(&mass * &u))).abs() < ROUNDING * scale);
            assert!((by_velocities.eps2 - w.dot(&momentum)).abs() < ROUNDING * scale);
            let force = energy([&w, &still], [&still, &still]).eps1;
            let shift = energy([&at.v, &still], [&still, &w]).eps1eps2;
            assert!((force - shift - w.dot(&q_v)).abs() < ROUNDING * scale, "{n}");
        }
    }
}

/// Along a joint direction of q and q̇, Q_v is a cubic: the error of its central difference is exactly
/// proportional to step². Along q alone Q_v is linear and M q̈ quadratic: no error but rounding.
#[test]
fn central_differences_of_primal_kernels_agree_with_the_emitted_derivatives() {
    for n in LENGTHS {
        let (shaft, at) = (Shaft::new(n), State::new(n, 13));
        for name in ["consistent", "hu2003"] {
            let motion = motion(name);
            let [pf, b, p] =
                [motion.pf, motion.b, motion.p].map(|kernel| shaft.blocks(motion, kernel, &at));
            let still = DVector::zeros(n + 1);
            for (u, w) in directions(n) {
                let difference = |step: f64, u: &DVector<f64>, w: &DVector<f64>| {
                    let q_v = |s| shaft.rows(motion, motion.quadratic_velocity, &at.moved(s, u, w));
                    (q_v(step) - q_v(-step)) / (2.0 * step)
                };
                assert!(error(&difference(0.5, &u, &still), &(&b * &u)) < ROUNDING, "{name} {n}");
                let joint = &b * &u + &p * &w;
                let worst = [0.5, 0.25].map(|step| (difference(step, &u, &w) - &joint).amax());
                let rounding = ROUNDING * (1.0 + joint.amax());
                if n == 0 {
                    assert!(worst[0] < rounding, "{name}: {worst:?}");
                } else {
                    assert!((worst[0] - 4.0 * worst[1]).abs() < rounding, "{name} {n}: {worst:?}");
                    assert!(
                        worst[0] > 1e3 * rounding,
                        "{name} {n}: {worst:?} has no third derivative"
                    );
                }
                let ma = |s| {
                    let moved = at.moved(s, &u, &still);
                    shaft.blocks(motion, motion.mass, &moved) * &at.a
                };
                let found = ma(0.5) - ma(-0.5);
                assert!(error(&found, &(&pf * &u)) < ROUNDING, "{name} {n}");
            }
        }
    }
}
