//! Generated laws, clearances and motions against kernels written by hand, and against differences of the
//! formulas themselves.

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use whirl_benches::hand;
use whirl_specs::{
    CLEARANCES, ContactState, ContactTangent, LAWS, MOTIONS, Motion, MotionState, Ring,
};

fn config() -> TestRunner {
    TestRunner::new(Config { cases: 64, failure_persistence: None, ..Config::default() })
}

/// |a − b| within rounding of numbers of size `scale`.
fn close(a: f64, b: f64, scale: f64) -> bool {
    (a - b).abs() <= 1e-12 * scale
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}

#[test]
fn laws_agree_with_the_hand_written_ones_on_both_sides_of_the_root() {
    for reference in [&hand::law::LINEAR, &hand::law::NONLINEAR] {
        let law =
            LAWS.iter().find(|law| law.origin.name == reference.origin.name).expect("is shipped");
        let h: Vec<f64> = (0..1000).map(|i| 0.08e-3 * f64::from(i) / 999.0).collect();
        let (mut ours, mut theirs) = (vec![0.0; 2 * h.len()], vec![0.0; 2 * h.len()]);
        (law.evaluate)(h.len(), &h, &mut ours);
        (reference.evaluate)(h.len(), &h, &mut theirs);
        for i in 0..h.len() {
            assert!(close(ours[i], theirs[i], 400.0), "{} at {}", law.origin.name, h[i]);
            let slope = h.len() + i;
            assert!(close(ours[slope], theirs[slope], 2e7), "{} at {}", law.origin.name, h[i]);
        }
    }
}

/// A ring of springs with a state.
#[derive(Debug, Clone)]
struct Springs {
    ring: Ring,
    /// ψ, δ, δ̇, Q, ∂Q/∂h, ∂Q/∂ḣ of every spring.
    rows: [Vec<f64>; 6],
}

fn springs() -> impl Strategy<Value = Springs> {
    let row = || prop::collection::vec(-1.0..1.0f64, 7);
    let ring = (prop::array::uniform3(-3.0..3.0f64), prop::array::uniform3(-3.0..3.0f64));
    (ring, prop::array::uniform6(row()), 0.0..2.0f64).prop_map(|((position, velocity), rows, c)| {
        Springs { ring: Ring { position, velocity, c }, rows }
    })
}

#[test]
fn clearances_agree_with_the_hand_written_one() {
    let (reference, own) = (&hand::clearance::CLEARANCE, &CLEARANCES[0]);
    let check = |case: Springs| {
        let [psi, delta, delta_dot, q, dq_dh, dq_dh_dot] = &case.rows;
        let (n, slopes) = (psi.len(), [dq_dh.as_slice(), dq_dh_dot].concat());
        let evaluate = |clearance: &whirl_specs::Clearance| {
            let kernels = &clearance.contacts[0];
            let mut table = vec![0.0; kernels.table * n];
            (kernels.prepare)(psi, &mut table);
            let state = ContactState {
                stride: n,
                table: &table,
                ring: &case.ring,
                radius: 0.0,
                bore: delta,
                bore_dot: delta_dot,
            };
            let mut h = vec![0.0; 2 * n];
            (kernels.evaluate)(n, &state, &mut h);
            let (mut force, mut spring) = ([0.0; 3], vec![0.0; n]);
            (kernels.force)(n, &state, q, &mut force, &mut spring);
            let mut tangent = ContactTangent::new(n, 1);
            (kernels.tangent)(n, &state, q, &slopes, 3.7, &mut tangent);
            let mut all = [h, force.to_vec(), spring, tangent.ring_ring.concat()].concat();
            all.extend([tangent.ring_bore, tangent.bore_ring, tangent.bore_bore].concat());
            all.extend((clearance.axial)(psi[0]));
            all
        };
        let (ours, theirs) = (evaluate(own), evaluate(reference));
        for (place, (a, b)) in ours.iter().zip(&theirs).enumerate() {
            prop_assert!(close(*a, *b, 1e3), "value {}: {} and {}", place, a, b);
        }
        Ok(())
    };
    config().run(&springs(), check).unwrap_or_else(|error| panic!("{error}"));
}

/// Tensors of a shaft with four coordinates, and a state.
#[derive(Debug, Clone)]
struct Shaft {
    tensors: [Vec<f64>; 6],
    angle: [f64; 3],
    eta: [Vec<f64>; 3],
}

const N: usize = 4;

fn shaft() -> impl Strategy<Value = Shaft> {
    let vector = || prop::collection::vec(-2.0..2.0f64, N);
    let matrix = || prop::collection::vec(-2.0..2.0f64, N * N);
    let vectors = prop::array::uniform5(vector());
    let parts = (0.0..2.0f64, vectors, prop::array::uniform3(matrix()));
    (parts, prop::array::uniform3(-2.0..2.0f64)).prop_map(|((j0, vectors, matrices), angle)| {
        let [y0, g0, eta, eta_dot, eta_ddot] = vectors;
        let [m, y, h] = matrices;
        let with_transpose = |a: &[f64], sign: f64| -> Vec<f64> {
            (0..N * N).map(|k| a[k] + sign * a[k % N * N + k / N]).collect()
        };
        let matrices = [with_transpose(&m, 1.0), with_transpose(&y, 1.0), with_transpose(&h, -1.0)];
        let [m, y, h] = matrices;
        Shaft { tensors: [vec![j0], y0, g0, m, y, h], angle, eta: [eta, eta_dot, eta_ddot] }
    })
}

impl Shaft {
    fn tensors(&self, motion: &Motion) -> Vec<&[f64]> {
        let names = ["J0", "y0", "g0", "M", "Y", "H"];
        // Without stiffening Y − G is Y.
        let place = |name: &str| {
            let own = if name == "W" { "Y" } else { name };
            names.iter().position(|known| *known == own).expect("known tensor")
        };
        motion.tensors.iter().map(|tensor| self.tensors[place(tensor.name)].as_slice()).collect()
    }

    fn evaluate(&self, motion: &Motion) -> Vec<Vec<f64>> {
        let (tensors, n) = (self.tensors(motion), N);
        let [eta, eta_dot, eta_ddot] = &self.eta;
        let [theta, theta_dot, theta_ddot] = self.angle;
        let state = MotionState { theta, theta_dot, theta_ddot, eta, eta_dot, eta_ddot };
        let mut workspace = vec![f64::NAN; (motion.workspace)(n)];
        let mut vectors = vec![motion.inertia_force, motion.quadratic_velocity];
        vectors.extend(motion.momentum);
        let mut all = Vec::new();
        for kernel in vectors {
            let mut out = vec![f64::NAN; 1 + n];
            kernel(&tensors, &state, &mut workspace, &mut out);
            all.push(out);
        }
        for kernel in [motion.mass, motion.pf, motion.b, motion.p] {
            let mut out = vec![f64::NAN; (1 + n) * (1 + n)];
            kernel(&tensors, &state, &mut workspace, &mut out);
            all.push(out);
        }
        let mut out = vec![f64::NAN; (1 + n) * (1 + n)];
        (motion.tangent)(&tensors, &state, 3.1, 7.9, &mut workspace, &mut out);
        all.push(out);
        if let Some(energy) = motion.kinetic_energy {
            all.push(vec![energy(&tensors, &state, &mut workspace)]);
        }
        all
    }
}

#[test]
fn the_consistent_motion_agrees_with_the_hand_written_one() {
    let reference = &hand::motion::MOTION;
    let own = MOTIONS.iter().find(|motion| motion.origin.name == "consistent").expect("shipped");
    let check = |shaft: Shaft| {
        let (ours, theirs) = (shaft.evaluate(own), shaft.evaluate(reference));
        prop_assert_eq!(ours.len(), theirs.len());
        for (kernel, (a, b)) in ours.iter().zip(&theirs).enumerate() {
            let scale = 1.0 + largest(b);
            for (place, (a, b)) in a.iter().zip(b).enumerate() {
                prop_assert!(close(*a, *b, 10.0 * scale), "{} {}: {} {}", kernel, place, a, b);
            }
        }
        Ok(())
    };
    config().run(&shaft(), check).unwrap_or_else(|error| panic!("{error}"));
}
