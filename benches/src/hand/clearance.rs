//! The clearance of a journal in its bore, written by hand: everything that springs share is done once a
//! ring in the fixed frame, so that a spring costs a handful of operations.
//!
//! With u = A(θ)ε, s_j = ∂h_j/∂u = −(cos ψ_j, sin ψ_j), J = ∂u/∂(θ, ε) and W = ∂u̇/∂(θ, ε):
//! h_j = c + s_j·u + δ_j, ∂h_j/∂(θ, ε) = Jᵀs_j, ∂ḣ_j/∂(θ, ε) = Wᵀs_j.

use whirl_specs::{
    BoreMotion, Clearance, Contact, ContactPlace, ContactState, ContactTangent, ContactVariable,
    Origin, Ring,
};

/// The clearance of eqs. (14) and (24) with the shaft's displacement turned into the fixed frame.
pub static CLEARANCE: Clearance = Clearance {
    origin: Origin {
        name: "journal",
        title: "Radial clearance of the springs of a journal bearing, by hand",
        source: "eqs. (13), (14), (24)",
        spec: "",
        text: "",
        hash: "",
    },
    axial,
    apart,
    measures: &["h"],
    coordinates: 7,
    measure,
    contacts: &[NORMAL],
};

/// h at ψ, θ, ε_x, ε_y, δ, c and R.
fn measure(at: &[f64], out: &mut [f64]) {
    let &[psi, theta, x, y, delta, c, _] = at else {
        unreachable!("as many as are said, not {}", at.len())
    };
    let ((sin, cos), (sin_psi, cos_psi)) = (theta.sin_cos(), psi.sin_cos());
    out[0] = c - cos_psi * (cos * x - sin * y) - sin_psi * (sin * x + cos * y) + delta;
}

/// Laws Q(h, ḣ).
const NORMAL: Contact = Contact {
    name: "normal",
    place: ContactPlace::Spring,
    inputs: &[
        ContactVariable { name: "h", ..RADIAL },
        ContactVariable { name: "h_dot", unit: "m/s", rate: true, ..RADIAL },
    ],
    forces: &[ContactVariable { name: "Q", unit: "N", ..RADIAL }],
    rows: 2,
    measures: &[0],
    bore: &[BoreMotion::Radial],
    table: 2,
    prepare,
    evaluate: clearance,
    force,
    tangent,
};

const RADIAL: ContactVariable =
    ContactVariable { name: "", unit: "m", bore: &[0], radius: false, rate: false };

fn prepare(psi: &[f64], table: &mut [f64]) {
    let (cos, sin) = table.split_at_mut(psi.len());
    for ((psi, cos), sin) in psi.iter().zip(cos).zip(sin) {
        (*sin, *cos) = psi.sin_cos();
    }
}

/// The journal in the fixed frame.
struct Journal {
    /// u and u̇.
    u: [f64; 2],
    u_dot: [f64; 2],
    /// Columns of J and of W.
    j: [[f64; 2]; 3],
    w: [[f64; 2]; 3],
}

impl Journal {
    fn new(ring: &Ring) -> Self {
        let [theta, x, y] = ring.position;
        let [theta_dot, x_dot, y_dot] = ring.velocity;
        let (sin, cos) = theta.sin_cos();
        let turn = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y];
        let u = turn(x, y);
        let u_dot = turn(x_dot - theta_dot * y, y_dot + theta_dot * x);
        Journal {
            u,
            u_dot,
            j: [[-u[1], u[0]], [cos, sin], [-sin, cos]],
            w: [
                [-u_dot[1], u_dot[0]],
                [-theta_dot * sin, theta_dot * cos],
                [-theta_dot * cos, -theta_dot * sin],
            ],
        }
    }
}

/// cos ψ and sin ψ of every spring.
fn table<'t>(springs: usize, state: &ContactState<'t>) -> [&'t [f64]; 2] {
    [&state.table[..springs], &state.table[state.stride..][..springs]]
}

fn clearance(springs: usize, state: &ContactState, out: &mut [f64]) {
    let Journal { u, u_dot, .. } = Journal::new(state.ring);
    let ([cos, sin], c) = (table(springs, state), state.ring.c);
    let (delta, delta_dot) = (&state.bore[..springs], &state.bore_dot[..springs]);
    let (h, h_dot) = out.split_at_mut(state.stride);
    let (h, h_dot) = (&mut h[..springs], &mut h_dot[..springs]);
    for k in 0..springs {
        h[k] = c - cos[k] * u[0] - sin[k] * u[1] + delta[k];
        h_dot[k] = delta_dot[k] - cos[k] * u_dot[0] - sin[k] * u_dot[1];
    }
}

fn force(
    springs: usize,
    state: &ContactState,
    q: &[f64],
    ring_force: &mut [f64; 3],
    spring_force: &mut [f64],
) {
    let total = total(springs, state, q);
    let journal = Journal::new(state.ring);
    for (force, column) in ring_force.iter_mut().zip(&journal.j) {
        *force = dot(column, &total);
    }
    spring_force[..springs].copy_from_slice(&q[..springs]);
}

/// Σ Q_j s_j: the force on the shaft in the fixed frame.
fn total(springs: usize, state: &ContactState, q: &[f64]) -> [f64; 2] {
    let ([cos, sin], q) = (table(springs, state), &q[..springs]);
    let mut total = [0.0; 2];
    for k in 0..springs {
        total[0] -= q[k] * cos[k];
        total[1] -= q[k] * sin[k];
    }
    total
}

fn tangent(
    springs: usize,
    state: &ContactState,
    q: &[f64],
    slopes: &[f64],
    a1: f64,
    tangent: &mut ContactTangent,
) {
    let journal = Journal::new(state.ring);
    let [cos, sin] = table(springs, state);
    let (stiff, viscous) = (&slopes[..springs], &slopes[state.stride..][..springs]);
    let spring_spring = &mut tangent.bore_bore[..springs];
    // Σ k s sᵀ and Σ d s sᵀ as xx, xy, yy; k = ∂Q/∂h + a1 ∂Q/∂ḣ, d = ∂Q/∂ḣ.
    let (mut kss, mut dss) = ([0.0; 3], [0.0; 3]);
    for j in 0..springs {
        let (k, d) = (stiff[j] + a1 * viscous[j], viscous[j]);
        spring_spring[j] = k;
        let ss = [cos[j] * cos[j], cos[j] * sin[j], sin[j] * sin[j]];
        for i in 0..3 {
            kss[i] += k * ss[i];
            dss[i] += d * ss[i];
        }
    }
    let apply = |m: &[f64; 3], v: &[f64; 2]| [m[0] * v[0] + m[1] * v[1], m[1] * v[0] + m[2] * v[1]];
    for i in 0..3 {
        let (left_k, left_d) = (apply(&kss, &journal.j[i]), apply(&dss, &journal.j[i]));
        for j in 0..3 {
            tangent.ring_ring[i][j] = dot(&left_k, &journal.j[j]) + dot(&left_d, &journal.w[j]);
        }
        let (gradient, rate) = (journal.j[i], journal.w[i]);
        let ring_spring = &mut tangent.ring_bore[i * springs..][..springs];
        let spring_ring = &mut tangent.bore_ring[i * springs..][..springs];
        for j in 0..springs {
            let across = -spring_spring[j] * (cos[j] * gradient[0] + sin[j] * gradient[1]);
            ring_spring[j] = across;
            spring_ring[j] = across - viscous[j] * (cos[j] * rate[0] + sin[j] * rate[1]);
        }
    }
    // Q ∂²h/∂q²: ∂²u/∂θ² = −u, ∂²u/∂θ∂ε = A_θ.
    let total = total(springs, state, q);
    tangent.ring_ring[0][0] -= dot(&total, &journal.u);
    for i in 1..3 {
        let turned = [-journal.j[i][1], journal.j[i][0]];
        let moment = dot(&total, &turned);
        tangent.ring_ring[0][i] += moment;
        tangent.ring_ring[i][0] += moment;
    }
}

fn apart(angle: f64, [x, y]: [f64; 2]) -> [[f64; 2]; 3] {
    let (sin, cos) = angle.sin_cos();
    let [along, across] = [cos * x + sin * y, cos * y - sin * x];
    [[along, across], [across, -along], [-along, -across]]
}

fn axial(s: f64) -> [f64; 3] {
    [(2.0 * s - 3.0) * s + 1.0, (4.0 - 4.0 * s) * s, (2.0 * s - 1.0) * s]
}

fn dot(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
