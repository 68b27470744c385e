//! Random shafts and states, and the kernels evaluated on them.

use nalgebra::{DMatrix, DVector};
use whirl_specs::{MOTIONS, Motion, MotionKernel, MotionState};

/// Numbers of flexible coordinates to test with: none, one, and the reference shaft's.
pub(super) const LENGTHS: [usize; 3] = [0, 1, 77];

/// Numbers in (−1, 1), the same at every run.
pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Random(seed)
    }

    pub(super) fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(super) fn vector(&mut self, n: usize) -> DVector<f64> {
        DVector::from_fn(n, |_, _| self.next())
    }

    fn matrix(&mut self, n: usize) -> DMatrix<f64> {
        DMatrix::from_fn(n, n, |_, _| self.next())
    }
}

/// Tensors of a shaft with n flexible coordinates.
pub(super) struct Shaft {
    pub(super) n: usize,
    pub(super) j0: f64,
    pub(super) y0: DVector<f64>,
    pub(super) g0: DVector<f64>,
    pub(super) m: DMatrix<f64>,
    pub(super) y: DMatrix<f64>,
    pub(super) h: DMatrix<f64>,
}

impl Shaft {
    pub(super) fn new(n: usize) -> Self {
        let mut random = Random::new(7 + n as u64);
        let (a, b, c) = (random.matrix(n), random.matrix(n), random.matrix(n));
        Shaft {
            n,
            j0: 2.0 + random.next(),
            y0: random.vector(n),
            g0: random.vector(n),
            m: &a * a.transpose() + DMatrix::identity(n, n),
            y: &b + b.transpose(),
            h: &c - c.transpose(),
        }
    }

    /// The tensors in a motion's order.
    pub(super) fn tensors(&self, motion: &Motion) -> Vec<&[f64]> {
        let of = |name| match name {
            "J0" => std::slice::from_ref(&self.j0),
            "y0" => self.y0.as_slice(),
            "g0" => self.g0.as_slice(),
            "M" => self.m.as_slice(),
            "Y" | "W" => self.y.as_slice(),
            "H" => self.h.as_slice(),
            other => panic!("no tensor {other}"),
        };
        motion.tensors.iter().map(|tensor| of(tensor.name)).collect()
    }

    /// Runs a kernel that gives a vector.
    pub(super) fn rows(&self, motion: &Motion, kernel: MotionKernel, at: &State) -> DVector<f64> {
        let mut workspace = vec![f64::NAN; (motion.workspace)(self.n)];
        let mut out = vec![f64::NAN; self.n + 1];
        kernel(&self.tensors(motion), &at.view(), &mut workspace, &mut out);
        DVector::from_vec(out)
    }

    /// Runs a kernel that gives a matrix.
    pub(super) fn blocks(&self, motion: &Motion, kernel: MotionKernel, at: &State) -> DMatrix<f64> {
        let mut workspace = vec![f64::NAN; (motion.workspace)(self.n)];
        let mut out = vec![f64::NAN; (self.n + 1) * (self.n + 1)];
        kernel(&self.tensors(motion), &at.view(), &mut workspace, &mut out);
        DMatrix::from_vec(self.n + 1, self.n + 1, out)
    }
}

/// q, q̇ and q̈ with θ first.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub(super) q: DVector<f64>,
    pub(super) v: DVector<f64>,
    pub(super) a: DVector<f64>,
}

impl State {
    pub(super) fn new(n: usize, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let mut vector = || random.vector(n + 1);
        State { q: vector(), v: vector(), a: vector() }
    }

    pub(super) fn view(&self) -> MotionState<'_> {
        MotionState {
            theta: self.q[0],
            theta_dot: self.v[0],
            theta_ddot: self.a[0],
            eta: &self.q.as_slice()[1..],
            eta_dot: &self.v.as_slice()[1..],
            eta_ddot: &self.a.as_slice()[1..],
        }
    }

    /// The state with q and q̇ moved along a direction; q̈ stays.
    pub(super) fn moved(&self, step: f64, along_q: &DVector<f64>, along_v: &DVector<f64>) -> Self {
        State { q: &self.q + along_q * step, v: &self.v + along_v * step, a: self.a.clone() }
    }
}

/// A motion of the registry.
pub(super) fn motion(name: &str) -> &'static Motion {
    MOTIONS.iter().find(|motion| motion.origin.name == name).expect("the motion is listed")
}

/// Largest |a − b| over the largest |a| or |b|; 0 of nothing.
pub(super) fn error<'a>(
    a: impl IntoIterator<Item = &'a f64>,
    b: impl IntoIterator<Item = &'a f64>,
) -> f64 {
    let (a, b): (Vec<f64>, Vec<f64>) =
        (a.into_iter().copied().collect(), b.into_iter().copied().collect());
    assert_eq!(a.len(), b.len());
    let size = |all: f64, v: f64| {
        if all.is_nan() {
            all
        } else if v.is_nan() {
            v
        } else {
            all.max(v.abs())
        }
    };
    let scale = a.iter().chain(&b).copied().fold(0.0, size);
    let worst = a.iter().zip(&b).map(|(x, y)| x - y).fold(0.0, size);
    if worst == 0.0 { 0.0 } else { worst / scale }
}
