//! What a spinning shaft keeps: balance under rigid displacement, energy and angular momentum, and its
//! frequencies but for the turning of the frame. On a generated mesh, so that assembly, reduction and constraints
//! take part.

use std::f64::consts::TAU;

use nalgebra::DMatrix;
use whirl_solver::assembly::mass_properties;
use whirl_solver::dynamics::{March, march};
use whirl_solver::equations::{Equations, State};
use whirl_solver::linalg::{Lu, Matrix, generalised_symmetric_eigen};
use whirl_solver::machine::{Machine, MachineParts};
use whirl_solver::shaft::Shaft;
use whirl_specs::{CLEARANCES, ContactState, ContactTangent, MotionState, Ring};

use crate::small_shaft::{
    CLEARANCE, JOURNALS, LawOf, SPRINGS, bearings, free, journal, mesh, motion, options, ring,
    shaft, translation,
};

/// √(a_ii) Σ_j √(a_jj) |x_j|: what the terms of row i of a reduced matrix times x can be, whatever cancels
/// in its entries (|a_ij| ≤ √(a_ii a_jj) for a positive matrix).
fn sizes(a: &Matrix, x: &[f64]) -> Vec<f64> {
    let root = |i: usize| a[(i, i)].abs().sqrt();
    let sum: f64 = x.iter().enumerate().map(|(j, x)| root(j) * x.abs()).sum();
    (0..a.rows).map(|i| root(i) * sum).collect()
}

fn absolute_dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| (x * y).abs()).sum()
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// The state of a shaft at angle θ with θ̇ and θ̈ whose every node is displaced by d, constant in the fixed
/// frame: b = A(θ)ᵀd turns back in the frame of the shaft, ḃ = θ̇ (b_y, −b_x), b̈ = θ̈ (b_y, −b_x) − θ̇² b.
fn displaced(shaft: &Shaft, [theta, speed, acceleration]: [f64; 3], d: [f64; 2]) -> State {
    let (sin, cos) = theta.sin_cos();
    let b = [cos * d[0] + sin * d[1], cos * d[1] - sin * d[0]];
    let back = [b[1], -b[0]];
    let rate = back.map(|part| speed * part);
    let second = [0, 1].map(|axis| acceleration * back[axis] - speed * speed * b[axis]);
    let with = |first: f64, b| {
        let mut all = vec![first];
        all.extend(translation(shaft, b));
        all
    };
    let q = with(theta, b);
    let still = State::new(q.len());
    State { q, v: with(speed, rate), a: with(acceleration, second), ..still }
}

/// What rounding may leave in the residual of a state: every entry of the reduced matrices is a sum over
/// the dofs of the mesh and carries that many times eps of the terms summed. Those of H, y0 and g0 are no
/// larger than Y and J0 allow.
fn rounding(shaft: &Shaft, dofs: usize, state: &State) -> Vec<f64> {
    let (eta, eta_dot, eta_ddot) = (&state.q[1..], &state.v[1..], &state.a[1..]);
    let (speed, acceleration) = (state.v[0], state.a[0].abs());
    let n = shaft.size();
    let vector: Vec<f64> =
        (0..n).map(|i| (shaft.j0 * shaft.spin_inertia[(i, i)]).abs().sqrt()).collect();
    let lateral = |x: &[f64]| sizes(&shaft.spin_inertia, x);
    let (still, moving, pushed) = (lateral(eta), lateral(eta_dot), lateral(eta_ddot));
    let (inertia, bent) = (sizes(&shaft.mass, eta_ddot), sizes(&shaft.stiffness, eta));
    let about_axis = (shaft.j0 + 2.0 * absolute_dot(&vector, eta) + absolute_dot(&still, eta))
        * acceleration
        + absolute_dot(&vector, eta_ddot)
        + absolute_dot(&pushed, eta)
        + 2.0 * speed * (absolute_dot(&vector, eta_dot) + absolute_dot(&still, eta_dot));
    let row = |i: usize| {
        inertia[i]
            + bent[i]
            + 2.0 * speed * moving[i]
            + (speed * speed + acceleration) * (vector[i] + still[i])
    };
    let terms = std::iter::once(about_axis).chain((0..n).map(row));
    terms.map(|size| dofs as f64 * f64::EPSILON * size).collect()
}

#[test]
fn a_spinning_shaft_displaced_as_a_whole_is_in_the_balance_of_the_centred_one() {
    let mesh = mesh();
    let shaft = shaft(&mesh);
    let mass = mass_properties(&mesh).expect("a mass").mass;
    let d = [3e-4, -2e-4];
    let turning = [0.7, 471.0, 90.0];
    let centred = displaced(&shaft, turning, [0.0; 2]);
    let moved = displaced(&shaft, turning, d);
    let tolerance = rounding(&shaft, mesh.dof_count(), &moved);

    let (sin, cos) = turning[0].sin_cos();
    for node in &shaft.nodes {
        let b = node.shapes.apply(&moved.q[1..]);
        let space = [cos * b[0] - sin * b[1], sin * b[0] + cos * b[1], b[2]];
        for (got, wanted) in space.iter().zip([d[0], d[1], 0.0]) {
            // Shapes come from a solution with the stiffness of the mesh: eps times its condition, E h =
            // 3e9 N/m of a cell over some 1e6 N/m a node of the softest motion (torsion), and ten times that.
            assert!((got - wanted).abs() < 1e-11 * d[0], "{got} {wanted}");
        }
    }

    let residual = |name: &str, state: &State| {
        let machine = Machine::new(free(shaft.clone(), motion(name))).expect("a machine");
        let mut equations = Equations::new(&machine);
        equations.evaluate(0.0, state);
        equations.residual().to_vec()
    };
    let difference: Vec<f64> = residual("consistent", &moved)
        .iter()
        .zip(residual("consistent", &centred))
        .map(|(moved, centred)| moved - centred)
        .collect();
    for i in 0..difference.len() {
        let (left, allowed) = (difference[i], tolerance[i]);
        assert!(left.abs() <= allowed, "row {i}: {left:e}, rounding {allowed:e}");
    }

    // The force on the shaft as a whole, in its frame: none, or the extra term's m θ̇² b.
    let b = [cos * d[0] + sin * d[1], cos * d[1] - sin * d[0]];
    for (b, direction) in b.iter().zip([[1.0, 0.0], [0.0, 1.0]]) {
        let unit = translation(&shaft, direction);
        let allowed = dot(&unit, &tolerance[1..]);
        let force = |name: &str| dot(&unit, &residual(name, &moved)[1..]);
        assert!(force("consistent").abs() <= allowed, "{:e} {allowed:e}", force("consistent"));
        let expected = mass * turning[1] * turning[1] * b;
        let extra = force("hu2003");
        assert!((extra - expected).abs() <= allowed, "{extra} {expected} {allowed:e}");
        assert!(expected.abs() > 1e3 * allowed);
    }
}

/// Energy and angular momentum of the free shaft.
fn kept(machine: &Machine, equations: &mut Equations, state: &State) -> [f64; 2] {
    let shaft = machine.bodies[0].shaft().expect("it turns");
    let tensors: Vec<&[f64]> =
        machine.motion.tensors.iter().map(|t| shaft.tensor(t.name).expect("a tensor")).collect();
    let mut workspace = vec![0.0; (machine.motion.workspace)(shaft.size())];
    let mut momenta = vec![0.0; 1 + shaft.size()];
    let momentum = machine.motion.momentum.expect("a motion with an energy");
    momentum(&tensors, &motion_state(state), &mut workspace, &mut momenta);
    [equations.kinetic_energy(state) + equations.strain_energy(state), momenta[0]]
}

fn motion_state(state: &State) -> MotionState<'_> {
    MotionState {
        theta: state.q[0],
        theta_dot: state.v[0],
        theta_ddot: state.a[0],
        eta: &state.q[1..],
        eta_dot: &state.v[1..],
        eta_ddot: &state.a[1..],
    }
}

/// Modes of the shaft at rest on springs of `stiffness` (N/m, along x and y) at every journal node: ω² and
/// shapes.
fn modes_at_rest(shaft: &Shaft, stiffness: f64) -> (Vec<f64>, Matrix) {
    let mut sum = shaft.stiffness.clone();
    for node in &shaft.nodes[..3 * JOURNALS.len()] {
        for axis in 0..2 {
            for i in 0..shaft.size() {
                for j in 0..shaft.size() {
                    sum[(i, j)] += stiffness * node.shapes[(axis, i)] * node.shapes[(axis, j)];
                }
            }
        }
    }
    let modes = generalised_symmetric_eigen(&sum, &shaft.mass).expect("modes");
    (modes.values, modes.vectors)
}

#[test]
fn drifts_of_energy_and_angular_momentum_fall_as_the_square_of_the_step() {
    let mesh = mesh();
    let shaft = shaft(&mesh);
    let (squares, shapes) = modes_at_rest(&shaft, 0.0);
    // Two translations and two tilts are free; then bending, in two planes.
    let bending = squares[4].sqrt() / TAU;
    assert!(squares[3] < 1e-6 * squares[4] && bending > 500.0, "{squares:?}");
    let drive = 3.0 * JOURNALS[0][1];
    let eta: Vec<f64> =
        (0..shaft.size()).map(|i| 1.5e-3 * (shapes[(i, 4)] + 0.3 * shapes[(i, 5)])).collect();
    let eta_dot = translation(&shaft, [drive, -2.0 * drive]);
    let machine = Machine::new(free(shaft, motion("consistent"))).expect("a machine");
    let span = 4.0 / bending;
    let drifts = |steps: usize| {
        let mut options = options(span / steps as f64, steps);
        [options.initial[0].position, options.initial[0].velocity] = [eta.clone(), eta_dot.clone()];
        options.initial[0].speed = 300.0;
        let mut march = March::new(&machine, &options).expect("starts");
        let mut equations = Equations::new(&machine);
        let start = kept(&machine, &mut equations, march.state());
        let mut squares = [0.0; 2];
        for _ in 0..steps {
            march.advance().unwrap_or_else(|error| panic!("{error}"));
            let now = kept(&machine, &mut equations, march.state());
            for (sum, (now, start)) in squares.iter_mut().zip(now.iter().zip(start)) {
                *sum += (now / start - 1.0).powi(2) / steps as f64;
            }
        }
        squares.map(f64::sqrt)
    };
    // 40 steps a period of bending leave (ω Δt)²/12 = 0.2 % to terms of higher order, fewer with more.
    let measured = [160, 320, 640].map(drifts);
    for pair in measured.windows(2) {
        for (name, coarse, fine) in
            [("energy", pair[0][0], pair[1][0]), ("momentum", pair[0][1], pair[1][1])]
        {
            let order = (coarse / fine).log2();
            assert!((1.8..2.2).contains(&order), "{name}: {coarse:e}, {fine:e}: order {order}");
        }
    }
}

/// Of one spring (N/m); a ring of n such springs has n/2 times this in every direction.
const SPRING: f64 = 1.1e4;

/// The shaft in rings of springs Q = −k (h − c), which push and pull alike.
fn on_springs(shaft: Shaft) -> Machine {
    let linear = LawOf("isotropic", |h: f64| [-SPRING * (h - CLEARANCE), -SPRING]);
    let bore = || [Vec::new(), Vec::new(), Vec::new()];
    Machine::new(MachineParts {
        laws: vec![Box::new(linear)],
        bearings: bearings(&ring(), [bore(), bore()]),
        ..free(shaft, motion("consistent"))
    })
    .expect("a machine")
}

/// ω of the mode at rest that is a translation (rad/s).
fn translation_at_rest(shaft: &Shaft) -> f64 {
    let (squares, shapes) = modes_at_rest(shaft, 0.5 * SPRINGS as f64 * SPRING);
    let share = |mode: usize| -> f64 {
        let momentum = [[1.0, 0.0], [0.0, 1.0]].map(|axis| {
            dot(&shaft.mass.apply(&translation(shaft, axis)), shapes.col(mode)).powi(2)
        });
        momentum.iter().sum()
    };
    let most = (0..squares.len()).max_by(|&a, &b| share(a).total_cmp(&share(b)));
    squares[most.expect("modes")].sqrt()
}

/// Frequencies (rad/s, positive) of the equations about steady turning at `speed`:
/// M δq̈ − P δq̇ + (K + PF − B) δq = 0 from the generated blocks, springs included.
fn whirl_frequencies(shaft: &Shaft, speed: f64) -> Vec<f64> {
    let motion = motion("consistent");
    let n = 1 + shaft.size();
    let mut state = State::new(n);
    state.v[0] = speed;
    let tensors: Vec<&[f64]> =
        motion.tensors.iter().map(|t| shaft.tensor(t.name).expect("a tensor")).collect();
    let mut workspace = vec![0.0; (motion.workspace)(shaft.size())];
    let [mass, pf, b, p] = [motion.mass, motion.pf, motion.b, motion.p].map(|kernel| {
        let mut out = vec![0.0; n * n];
        kernel(&tensors, &motion_state(&state), &mut workspace, &mut out);
        out
    });
    let mut stiffness: Vec<f64> = pf.iter().zip(&b).map(|(pf, b)| pf - b).collect();
    for j in 1..n {
        for i in 1..n {
            stiffness[j * n + i] += shaft.stiffness[(i - 1, j - 1)];
        }
    }
    let springs = ring_tangent(speed);
    for node in (0..JOURNALS.len()).flat_map(journal) {
        // Rows of ∂(θ, ε_x, ε_y)/∂q.
        let row = |kind: usize, place: usize| match (kind, place) {
            (0, 0) => 1.0,
            (0, _) | (_, 0) => 0.0,
            _ => shaft.nodes[node].shapes[(kind - 1, place - 1)],
        };
        for (j, i) in (0..n).flat_map(|j| (0..n).map(move |i| (j, i))) {
            for (a, c) in (0..3).flat_map(|a| (0..3).map(move |c| (a, c))) {
                stiffness[j * n + i] -= row(a, i) * springs[a][c] * row(c, j);
            }
        }
    }
    // {δq, δq̇}' = [[0, 1], [−M⁻¹K, M⁻¹P]] {δq, δq̇}.
    let mut lu = Lu::new(n);
    lu.factor(&mass).expect("a mass matrix");
    let mut first_order = DMatrix::<f64>::zeros(2 * n, 2 * n);
    for j in 0..n {
        let (mut k, mut p) = (stiffness[j * n..][..n].to_vec(), p[j * n..][..n].to_vec());
        lu.solve_in_place(&mut k);
        lu.solve_in_place(&mut p);
        first_order[(j, n + j)] = 1.0;
        for i in 0..n {
            first_order[(n + i, j)] = -k[i];
            first_order[(n + i, n + j)] = p[i];
        }
    }
    let values = first_order.complex_eigenvalues();
    values.iter().map(|value| value.im).filter(|frequency| *frequency > 0.0).collect()
}

/// ∂(forces on θ, ε_x, ε_y)/∂(θ, ε_x, ε_y) of a ring at its centre.
fn ring_tangent(speed: f64) -> [[f64; 3]; 3] {
    let kernels = &CLEARANCES[0].contacts[0];
    let mut table = vec![0.0; kernels.table * SPRINGS];
    (kernels.prepare)(&ring(), &mut table);
    let centred = Ring { velocity: [speed, 0.0, 0.0], c: CLEARANCE, ..Ring::default() };
    let zeros = [0.0; SPRINGS];
    let state = ContactState {
        stride: SPRINGS,
        table: &table,
        ring: &centred,
        radius: 0.0,
        bore: &zeros,
        bore_dot: &zeros,
    };
    let slopes = [[-SPRING; SPRINGS], zeros].concat();
    let mut tangent = ContactTangent::new(SPRINGS, 1);
    (kernels.tangent)(SPRINGS, &state, &zeros, &slopes, 0.0, &mut tangent);
    tangent.ring_ring
}

#[test]
fn whirl_on_isotropic_springs_has_the_frequencies_of_rest_but_for_the_turning_frame() {
    let shaft = shaft(&mesh());
    let rest = translation_at_rest(&shaft);
    // Below, near and above the frequency of rest.
    for speed in [0.3 * rest, 1.1 * rest, 2.5 * rest] {
        let found = whirl_frequencies(&shaft, speed);
        for expected in [rest + speed, (rest - speed).abs()] {
            let error = |frequency: &f64| (frequency / expected - 1.0).abs();
            let nearest = found.iter().map(error).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-3, "{expected} rad/s is not among {found:?}");
        }
    }
}

#[test]
fn a_marched_whirl_has_the_frequencies_of_rest_but_for_the_turning_frame() {
    let shaft = shaft(&mesh());
    let rest = translation_at_rest(&shaft);
    let speed = 0.6 * rest;
    let machine = on_springs(shaft.clone());
    for whirl in [rest, -rest] {
        // A whirl of 1 µm: in the frame of the shaft its angle grows by ω − Ω.
        let seen = whirl - speed;
        let steps = 4000;
        let mut options = options(0.02 / rest, steps);
        let size = 1e-6;
        [options.initial[0].position, options.initial[0].velocity] =
            [translation(&shaft, [size, 0.0]), translation(&shaft, [0.0, seen * size])];
        options.initial[0].speed = speed;
        let outcome = march(&machine, &options, &mut |_| std::ops::ControlFlow::Continue(()));
        let history = outcome.unwrap_or_else(|failure| panic!("{}", failure.error)).history;
        let column = |name: &str| history.column(name).expect("a column");
        let (t, theta) = (column("t_s"), column("theta_rad"));
        let (x, y) = (column("X1_um"), column("Y1_um"));
        let mut angle = 0.0;
        let mut sums = [0.0; 2];
        let middle = 0.5 * (t[0] + t[steps - 1]);
        for i in 0..steps {
            let step = y[i].atan2(x[i]) - theta[i] - angle;
            angle += step - TAU * (step / TAU).round();
            // The line through all angles has the slope Σ (t − t̄) angle / Σ (t − t̄)².
            sums[0] += (t[i] - middle) * angle;
            sums[1] += (t[i] - middle).powi(2);
        }
        let error = sums[0] / sums[1] / seen - 1.0;
        assert!(error.abs() < 1e-3, "{seen} rad/s: off by {error:e}");
    }
}
