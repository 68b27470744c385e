//! The equations of a machine, evaluated from its tensors, its bearings as a test describes them and forces in
//! closed form: nothing of the solver's evaluation, and none of its norms.

use whirl_solver::bearing::Bearing;
use whirl_solver::equations::State;
use whirl_solver::linalg::Matrix;
use whirl_solver::loads::{Action, Frame, Load, TimeFunction};
use whirl_solver::machine::{Body, BodyPlace, Machine, Rotation};
use whirl_solver::shaft::Shaft;

/// What a law takes at one place, in the fixed frame.
#[derive(Default)]
pub(in super::super) struct LawInputs {
    pub(super) h: f64,
    pub(super) h_dot: f64,
    pub(super) slip: f64,
    pub(super) e: [f64; 2],
    pub(super) e_dot: [f64; 2],
    pub(super) omega: f64,
}

/// A law in closed form.
pub(in super::super) enum Direct {
    /// Normal and tangential force of one spring.
    Spring(fn(&LawInputs) -> [f64; 2]),
    /// F_x, F_y and M_z of a ring.
    Ring(fn(&LawInputs) -> [f64; 3]),
}

/// One row: r, its terms, the largest force projected on it, and the sum of everything in it.
#[derive(Clone, Default)]
struct Row {
    r: f64,
    largest: f64,
    projected: f64,
    sum: f64,
}

/// The rows of a machine at one instant.
pub(in super::super) struct Rows(Vec<Row>);

impl Rows {
    /// Takes a force projected on row `i`.
    pub(in super::super) fn project(&mut self, i: usize, force: f64) {
        self.0[i].projected = self.0[i].projected.max(force);
    }

    /// Adds a term of row `i`, made of products.
    pub(in super::super) fn term(&mut self, i: usize, products: impl IntoIterator<Item = f64>) {
        let (mut value, row) = (0.0, &mut self.0[i]);
        for product in products {
            value += product;
            row.sum += product.abs();
        }
        row.r += value;
        row.largest = row.largest.max(value.abs());
    }
}

/// At most 1 if every row of the unknowns is right at the end of a step, by the bound of the audit: |r| ≤ 1e-6 of
/// the largest term + 1e-9 of the largest force projected + 32 ε Σ |terms|, those of the start of the step, from
/// which its end follows, included.
pub(in super::super) fn worst_row(before: &Rows, after: &Rows, first: usize) -> f64 {
    let ratio = |(before, after): (&Row, &Row)| {
        let bound = 1e-6 * after.largest
            + 1e-9 * after.projected
            + 32.0 * f64::EPSILON * (before.sum + after.sum);
        if after.r == 0.0 { 0.0 } else { after.r.abs() / bound }
    };
    let ratios = before.0[first..].iter().zip(&after.0[first..]).map(ratio);
    ratios.fold(0.0, |worst: f64, r| if r.is_nan() { f64::INFINITY } else { worst.max(r) })
}

/// The rows of a machine but for its bearings.
pub(in super::super) fn without_bearings(machine: &Machine, t: f64, state: &State) -> Rows {
    let mut rows = Rows(vec![Row::default(); machine.size()]);
    for (body, place) in machine.bodies.iter().zip(machine.places()) {
        match body {
            Body::Turning { shaft, .. } => turning(shaft, place, state, &mut rows),
            Body::Standing { support, .. } => {
                for (i, place) in place.flexible.clone().enumerate() {
                    rows.term(place, [-state.a[place]]);
                    rows.term(place, [-support.damping[i] * state.v[place]]);
                    rows.term(place, [-support.stiffness[i] * state.q[place]]);
                }
            }
        }
    }
    let mut loads = vec![Vec::new(); machine.size()];
    for load in &machine.loads {
        let place = &machine.places()[load.body];
        let theta = place.rotation.map_or(0.0, |theta| state.q[theta]);
        let (sin, cos) = theta.sin_cos();
        let Action::Force { node, .. } = &load.action else { panic!("forces only") };
        let force = load_in_body(load, t, [sin, cos]);
        let shape = |axis: usize, j: usize| node.shapes[(axis, j)];
        let size = force.iter().map(|x| x * x).sum::<f64>().sqrt();
        if let Some(theta) = place.rotation {
            let moved = |axis: usize| {
                place
                    .flexible
                    .clone()
                    .enumerate()
                    .map(move |(j, own)| shape(axis, j) * state.q[own])
            };
            let at = |axis: usize| node.position[axis] + moved(axis).sum::<f64>();
            loads[theta].extend([at(0) * force[1], -at(1) * force[0]]);
            rows.project(theta, size * at(0).hypot(at(1)));
        }
        for (j, own) in place.flexible.clone().enumerate() {
            loads[own].extend([0, 1, 2].map(|axis| shape(axis, j) * force[axis]));
            let reach = [0, 1, 2].map(|axis| shape(axis, j).powi(2)).iter().sum::<f64>().sqrt();
            rows.project(own, size * reach);
        }
    }
    for (i, products) in loads.into_iter().enumerate() {
        rows.term(i, products);
    }
    rows
}

/// Adds the terms of a body that turns: kinetic energy ½ θ̇² J + θ̇ g·η̇ + ½ η̇ᵀMη̇ with J = J0 + 2 y0·η + ηᵀYη and
/// g = g0 − Hη.
fn turning(shaft: &Shaft, place: &BodyPlace, state: &State, rows: &mut Rows) {
    let (n, theta, own) = (shaft.size(), place.rotation.expect("it turns"), place.flexible.clone());
    let (omega, alpha) = (state.v[theta], state.a[theta]);
    let (q, v, a) = (&state.q[own.clone()], &state.v[own.clone()], &state.a[own.clone()]);
    let times = |m: &Matrix, i: usize, x: &[f64]| -> Vec<f64> {
        (0..n).map(|j| m[(i, j)] * x[j]).collect()
    };
    let total = |products: &[f64]| products.iter().sum::<f64>();
    let (y, h) = (&shaft.spin_net, &shaft.spin_coupling);
    let arm: Vec<f64> = (0..n).map(|i| shaft.y0[i] + total(&times(y, i, q))).collect();
    let g: Vec<f64> = (0..n).map(|i| shaft.g0[i] - total(&times(h, i, q))).collect();
    let inertia = shaft.j0
        + (0..n).map(|i| 2.0 * shaft.y0[i] * q[i] + q[i] * total(&times(y, i, q))).sum::<f64>();
    let row: Vec<f64> = (0..n).map(|i| -g[i] * a[i]).collect();
    rows.term(theta, row.into_iter().chain([-inertia * alpha]));
    rows.term(theta, (0..n).map(|i| -2.0 * arm[i] * v[i] * omega));
    for (i, place) in own.enumerate() {
        let mass = times(&shaft.mass, i, a).into_iter().map(|x| -x);
        rows.term(place, mass.chain([-g[i] * alpha]));
        let coriolis = times(h, i, v).into_iter().map(|x| 2.0 * x * omega);
        rows.term(place, coriolis.chain([arm[i] * omega * omega]));
        rows.term(place, times(&shaft.damping, i, v).into_iter().map(|x| -x));
        rows.term(place, times(&shaft.stiffness, i, q).into_iter().map(|x| -x));
    }
}

/// The rows of a machine whose bearings stand in a support that moves as one mass.
pub(super) fn rows(
    machine: &Machine,
    bearings: &[(&Bearing, &Direct)],
    t: f64,
    state: &State,
) -> Rows {
    let shaft = machine.bodies[0].shaft().expect("it turns");
    let support = machine.bodies[1].support().expect("it stands");
    let (n, size) = (shaft.size(), machine.size());
    let (theta, omega) = (state.q[0], state.v[0]);
    let (q, v) = (&state.q[1..=n], &state.v[1..=n]);
    let mut rows = without_bearings(machine, t, state);
    let (sin, cos) = theta.sin_cos();
    // What laws see as the speed of the journal.
    let turns = match machine.bodies[0].rotation() {
        Some(Rotation::Spinning { speed }) => *speed,
        _ => omega,
    };
    let mut springs = vec![Vec::new(); size];
    for (bearing, law) in bearings {
        for &station in &bearing.stations {
            // Quadratic in z through the three nodes.
            let s = station;
            let weights = [(2.0 * s - 1.0) * (s - 1.0), 4.0 * s * (1.0 - s), s * (2.0 * s - 1.0)];
            let shape = |axis: usize, j: usize| -> f64 {
                let parts = bearing.journal.iter().zip(weights);
                parts.map(|(&node, w)| w * shaft.nodes[node].shapes[(axis, j)]).sum()
            };
            let along = |x: &[f64]| [0, 1].map(|k| (0..n).map(|j| shape(k, j) * x[j]).sum::<f64>());
            let turn = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
            let (u, rate) = (turn(along(q)), turn(along(v)));
            // u̇ = A ε̇ + θ̇ ẑ×u.
            let u_dot = [rate[0] - omega * u[1], rate[1] + omega * u[0]];
            let bore_shape = |axis: usize, i: usize| match bearing.bore[1].first() {
                Some(&node) => support.nodes[node].shapes[(axis, i)],
                None => 0.0,
            };
            let m = support.size();
            let bore = |x: &[f64]| {
                [0, 1].map(|k| (0..m).map(|i| bore_shape(k, i) * x[1 + n + i]).sum::<f64>())
            };
            let (b, b_dot) = (bore(&state.q), bore(&state.v));
            let e = [u[0] - b[0], u[1] - b[1]];
            let e_dot = [u_dot[0] - b_dot[0], u_dot[1] - b_dot[1]];
            let radius = bearing.journal_radius.unwrap_or(0.0);
            // A force on the journal's centre with a moment; what the bore feels is the opposite.
            let mut push = |force: [f64; 2], moment: f64| {
                springs[0].extend([u[0] * force[1], -u[1] * force[0], moment]);
                let size = force[0].hypot(force[1]);
                let reach = size * (radius + u[0].hypot(u[1])) + moment.abs();
                rows.project(0, reach);
                let turned = [cos * force[0] + sin * force[1], -sin * force[0] + cos * force[1]];
                for j in 0..n {
                    springs[1 + j].extend([0, 1].map(|axis| shape(axis, j) * turned[axis]));
                    let reach = size * shape(0, j).hypot(shape(1, j));
                    rows.project(1 + j, reach);
                }
                for i in 0..m {
                    springs[1 + n + i]
                        .extend([0, 1].map(|axis| -bore_shape(axis, i) * force[axis]));
                    let reach = size * bore_shape(0, i).hypot(bore_shape(1, i));
                    rows.project(1 + n + i, reach);
                }
            };
            match law {
                Direct::Spring(law) => {
                    for psi in &bearing.angles {
                        let (normal, tangent) = ([psi.cos(), psi.sin()], [-psi.sin(), psi.cos()]);
                        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
                        let [q, t] = law(&LawInputs {
                            h: bearing.clearance - dot(normal, e),
                            h_dot: -dot(normal, e_dot),
                            slip: radius * turns + dot(tangent, e_dot),
                            omega: turns,
                            ..LawInputs::default()
                        });
                        let force = [0, 1].map(|k| t * tangent[k] - q * normal[k]);
                        push(force, radius * t);
                    }
                }
                Direct::Ring(law) => {
                    let [x, y, moment] =
                        law(&LawInputs { e, e_dot, omega: turns, ..LawInputs::default() });
                    push([x, y], moment);
                }
            }
        }
    }
    for (i, products) in springs.into_iter().enumerate() {
        rows.term(i, products);
    }
    rows
}

/// A load in the frame of its body (N).
fn load_in_body(load: &Load, t: f64, [sin, cos]: [f64; 2]) -> [f64; 3] {
    let factor = match load.time_function {
        TimeFunction::Constant => 1.0,
        TimeFunction::Sine { frequency, phase } => {
            (std::f64::consts::TAU * frequency * t + phase).sin()
        }
        _ => panic!("no other load in an audit"),
    };
    let Action::Force { force, .. } = load.action else { panic!("forces only") };
    let [x, y, z] = force.map(|part| factor * part);
    match load.frame {
        Frame::Body => [x, y, z],
        Frame::Space => [cos * x + sin * y, -sin * x + cos * y, z],
    }
}
