//! The rotation of a shaft coupled to its deformation, written by hand: one pass over M, Y and H each
//! time, every product shared.
//!
//! With p = y0 + Yη, g = g0 − Hη and J = J0 + 2 y0·η + ηᵀYη, all of it follows from
//! T = ½ θ̇² J + θ̇ g·η̇ + ½ η̇ᵀMη̇.

use whirl_specs::{Motion, MotionState, Origin, Symmetry, Tensor, TensorShape};

const fn tensor(name: &'static str, shape: TensorShape, symmetry: Symmetry) -> Tensor {
    Tensor { name, shape, symmetry }
}

/// The consistent form.
pub static MOTION: Motion = Motion {
    origin: Origin {
        name: "consistent",
        title: "Rotation coupled to deformation, from the kinetic energy, by hand",
        source: "eqs. (25) to (42) without the second Yη θ̇² of (27)",
        spec: "",
        text: "",
        hash: "",
    },
    tensors: &[
        tensor("J0", TensorShape::Scalar, Symmetry::None),
        tensor("y0", TensorShape::Vector, Symmetry::None),
        tensor("g0", TensorShape::Vector, Symmetry::None),
        tensor("M", TensorShape::Matrix, Symmetry::Symmetric),
        tensor("W", TensorShape::Matrix, Symmetry::Symmetric),
        tensor("H", TensorShape::Matrix, Symmetry::Skew),
    ],
    workspace,
    kinetic_energy: Some(kinetic_energy),
    momentum: Some(momentum),
    inertia_force,
    quadratic_velocity,
    mass,
    pf,
    b,
    p,
    tangent,
};

struct Tensors<'a> {
    j0: f64,
    y0: &'a [f64],
    g0: &'a [f64],
    m: &'a [f64],
    y: &'a [f64],
    h: &'a [f64],
}

impl<'a> Tensors<'a> {
    fn new(tensors: &[&'a [f64]]) -> Self {
        let [j0, y0, g0, m, y, h] = tensors else { panic!("six tensors") };
        Tensors { j0: j0[0], y0, g0, m, y, h }
    }
    fn n(&self) -> usize {
        self.y0.len()
    }
    /// J from η and Yη.
    fn inertia(&self, eta: &[f64], y_eta: &[f64]) -> f64 {
        (0..self.n()).fold(self.j0, |sum, i| sum + eta[i] * (2.0 * self.y0[i] + y_eta[i]))
    }
}

fn workspace(n: usize) -> usize {
    5 * n
}

/// The five products of a tangent; not all are filled by all.
fn split(workspace: &mut [f64], n: usize) -> [&mut [f64]; 5] {
    let mut rows = workspace[..5 * n].chunks_exact_mut(n.max(1));
    std::array::from_fn(|_| rows.next().unwrap_or_default())
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Four sums, so that additions do not wait for each other.
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4.remainder().iter().zip(b4.remainder()).map(|(x, y)| x * y).sum();
    let mut sums = [0.0; 4];
    for (x, y) in a4.zip(b4) {
        for i in 0..4 {
            sums[i] += x[i] * y[i];
        }
    }
    rest + (sums[0] + sums[1]) + (sums[2] + sums[3])
}

/// y = A x.
fn product(a: &[f64], x: &[f64], y: &mut [f64]) {
    y.fill(0.0);
    for (column, &x) in a.chunks_exact(x.len().max(1)).zip(x) {
        y.iter_mut().zip(column).for_each(|(y, a)| *y += a * x);
    }
}

fn kinetic_energy(tensors: &[&[f64]], s: &MotionState, workspace: &mut [f64]) -> f64 {
    let t = Tensors::new(tensors);
    let [y_eta, h_eta, m_eta_dot, ..] = split(workspace, t.n());
    product(t.y, s.eta, y_eta);
    product(t.h, s.eta, h_eta);
    product(t.m, s.eta_dot, m_eta_dot);
    let coupling = dot(t.g0, s.eta_dot) - dot(h_eta, s.eta_dot);
    s.theta_dot * (0.5 * s.theta_dot * t.inertia(s.eta, y_eta) + coupling)
        + 0.5 * dot(s.eta_dot, m_eta_dot)
}

fn momentum(tensors: &[&[f64]], s: &MotionState, workspace: &mut [f64], out: &mut [f64]) {
    let t = Tensors::new(tensors);
    let [y_eta, h_eta, m_eta_dot, ..] = split(workspace, t.n());
    product(t.y, s.eta, y_eta);
    product(t.h, s.eta, h_eta);
    product(t.m, s.eta_dot, m_eta_dot);
    out[0] = t.inertia(s.eta, y_eta) * s.theta_dot;
    for i in 0..t.n() {
        let g = t.g0[i] - h_eta[i];
        out[0] += g * s.eta_dot[i];
        out[1 + i] = g * s.theta_dot + m_eta_dot[i];
    }
}

fn inertia_force(tensors: &[&[f64]], s: &MotionState, workspace: &mut [f64], out: &mut [f64]) {
    let t = Tensors::new(tensors);
    let n = t.n();
    let [y_eta, ..] = split(workspace, n);
    y_eta.fill(0.0);
    let (row, rows) = out.split_first_mut().expect("a row for θ");
    rows.fill(0.0);
    // η̈ᵀHη, while the columns of H are at hand for H(2θ̇η̇ + θ̈η).
    let mut coupling = 0.0;
    for j in 0..n {
        let (m, y, h) = (&t.m[j * n..][..n], &t.y[j * n..][..n], &t.h[j * n..][..n]);
        let eta = s.eta[j];
        let gyroscopic = 2.0 * s.theta_dot * s.eta_dot[j] + s.theta_ddot * eta;
        let acceleration = s.eta_ddot[j];
        for i in 0..n {
            y_eta[i] += y[i] * eta;
            rows[i] += h[i] * gyroscopic - m[i] * acceleration;
        }
        coupling += dot(h, s.eta_ddot) * eta;
    }
    *row = -s.theta_ddot * t.inertia(s.eta, y_eta) - dot(t.g0, s.eta_ddot) + coupling;
    let square = s.theta_dot * s.theta_dot;
    for i in 0..n {
        let p = t.y0[i] + y_eta[i];
        *row -= 2.0 * s.theta_dot * p * s.eta_dot[i];
        rows[i] += p * square - t.g0[i] * s.theta_ddot;
    }
}

fn quadratic_velocity(tensors: &[&[f64]], s: &MotionState, workspace: &mut [f64], out: &mut [f64]) {
    let t = Tensors::new(tensors);
    let [y_eta, h_eta_dot, ..] = split(workspace, t.n());
    product(t.y, s.eta, y_eta);
    product(t.h, s.eta_dot, h_eta_dot);
    out[0] = 0.0;
    for i in 0..t.n() {
        let p = t.y0[i] + y_eta[i];
        out[0] -= 2.0 * s.theta_dot * p * s.eta_dot[i];
        out[1 + i] = s.theta_dot * (p * s.theta_dot + 2.0 * h_eta_dot[i]);
    }
}

fn mass(tensors: &[&[f64]], s: &MotionState, workspace: &mut [f64], out: &mut [f64]) {
    let t = Tensors::new(tensors);
    let n = t.n();
    let [y_eta, h_eta, ..] = split(workspace, n);
    product(t.y, s.eta, y_eta);
    product(t.h, s.eta, h_eta);
    out[0] = t.inertia(s.eta, y_eta);
    for j in 0..n {
        let g = t.g0[j] - h_eta[j];
        out[1 + j] = g;
        let column = &mut out[(1 + j) * (1 + n)..][..1 + n];
        column[0] = g;
        column[1..].copy_from_slice(&t.m[j * n..][..n]);
    }
}

fn pf(tensors: &[&[f64]], s: &MotionState, workspace: &mut [f64], out: &mut [f64]) {
    let t = Tensors::new(tensors);
    let n = t.n();
    let [y_eta, h_eta_ddot, ..] = split(workspace, n);
    product(t.y, s.eta, y_eta);
    product(t.h, s.eta_ddot, h_eta_ddot);
    out[..1 + n].fill(0.0);
    for j in 0..n {
        let column = &mut out[(1 + j) * (1 + n)..][..1 + n];
        column[0] = 2.0 * (t.y0[j] + y_eta[j]) * s.theta_ddot + h_eta_ddot[j];
        let h = &t.h[j * n..][..n];
        column[1..].iter_mut().zip(h).for_each(|(out, h)| *out = -s.theta_ddot * h);
    }
}

fn b(tensors: &[&[f64]], s: &MotionState, workspace: &mut [f64], out: &mut [f64]) {
    let t = Tensors::new(tensors);
    let n = t.n();
    let [y_eta_dot, ..] = split(workspace, n);
    product(t.y, s.eta_dot, y_eta_dot);
    let square = s.theta_dot * s.theta_dot;
    out[..1 + n].fill(0.0);
    for j in 0..n {
        let column = &mut out[(1 + j) * (1 + n)..][..1 + n];
        column[0] = -2.0 * s.theta_dot * y_eta_dot[j];
        let y = &t.y[j * n..][..n];
        column[1..].iter_mut().zip(y).for_each(|(out, y)| *out = square * y);
    }
}

fn p(tensors: &[&[f64]], s: &MotionState, workspace: &mut [f64], out: &mut [f64]) {
    let t = Tensors::new(tensors);
    let n = t.n();
    let [y_eta, h_eta_dot, ..] = split(workspace, n);
    product(t.y, s.eta, y_eta);
    product(t.h, s.eta_dot, h_eta_dot);
    out[0] = 0.0;
    for j in 0..n {
        let p = t.y0[j] + y_eta[j];
        out[0] -= 2.0 * p * s.eta_dot[j];
        out[1 + j] = 2.0 * (p * s.theta_dot + h_eta_dot[j]);
        let column = &mut out[(1 + j) * (1 + n)..][..1 + n];
        column[0] = -2.0 * p * s.theta_dot;
        let h = &t.h[j * n..][..n];
        column[1..].iter_mut().zip(h).for_each(|(out, h)| *out = 2.0 * s.theta_dot * h);
    }
}

fn tangent(
    tensors: &[&[f64]],
    s: &MotionState,
    a1: f64,
    a2: f64,
    workspace: &mut [f64],
    out: &mut [f64],
) {
    let t = Tensors::new(tensors);
    let n = t.n();
    let [y_eta, y_eta_dot, h_eta, h_eta_dot, h_eta_ddot] = split(workspace, n);
    for row in [&mut *y_eta, y_eta_dot, h_eta, h_eta_dot, h_eta_ddot] {
        row.fill(0.0);
    }
    let square = s.theta_dot * s.theta_dot;
    let gyroscopic = s.theta_ddot + 2.0 * a1 * s.theta_dot;
    for j in 0..n {
        let (m, y, h) = (&t.m[j * n..][..n], &t.y[j * n..][..n], &t.h[j * n..][..n]);
        let (eta, eta_dot, eta_ddot) = (s.eta[j], s.eta_dot[j], s.eta_ddot[j]);
        let column = &mut out[(1 + j) * (1 + n) + 1..][..n];
        for i in 0..n {
            column[i] = a2 * m[i] - gyroscopic * h[i] - square * y[i];
            y_eta[i] += y[i] * eta;
            y_eta_dot[i] += y[i] * eta_dot;
            h_eta[i] += h[i] * eta;
            h_eta_dot[i] += h[i] * eta_dot;
            h_eta_ddot[i] += h[i] * eta_ddot;
        }
    }
    let turning = 2.0 * (s.theta_ddot + a1 * s.theta_dot);
    out[0] = a2 * t.inertia(s.eta, y_eta);
    for j in 0..n {
        let (p, g) = (t.y0[j] + y_eta[j], t.g0[j] - h_eta[j]);
        out[0] += 2.0 * a1 * p * s.eta_dot[j];
        out[(1 + j) * (1 + n)] =
            a2 * g + turning * p + h_eta_ddot[j] + 2.0 * s.theta_dot * y_eta_dot[j];
        out[1 + j] = a2 * g - 2.0 * a1 * (p * s.theta_dot + h_eta_dot[j]);
    }
}
