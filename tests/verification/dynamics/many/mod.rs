//! Machines of several bodies: turning freely, as prescribed, or not at all, with bearings between any two of them.

mod action;
mod equations;
mod floating_ring;
mod invariants;
mod torsion;

use std::sync::Arc;

use num_dual::{Dual64, DualNum};
use whirl_solver::bearing::{Bearing, MotionKind, OtherMotion, Sides, periodic_spline};
use whirl_solver::body::BodyNode;
use whirl_solver::centre_of_mass::CentreOfMass;
use whirl_solver::curve::Curve;
use whirl_solver::gravity::weights;
use whirl_solver::linalg::Matrix;
use whirl_solver::loads::{Frame, Load, Onset, TimeFunction};
use whirl_solver::machine::{Body, Machine, MachineParts, Rotation};
use whirl_solver::measure::MeanMotion;
use whirl_solver::rigid::RigidBody;
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::CLEARANCES;

use super::contacts::{FILM, Formula, RADIUS, RING, laws};
use super::{bores, discs, force, motion, wild};

/// Springs whose force is a curve.
static CUBIC: Formula = Formula {
    name: "cubic",
    inputs: &["h"],
    outputs: &["Q"],
    value: |z| vec![(z[0] / -4e-4).exp() * 80.0 - z[0] * z[0] * z[0] * 1e9],
};

/// Springs with a damper.
static DAMPED: Formula = Formula {
    name: "damped",
    inputs: &["h_dot", "h"],
    outputs: &["Q"],
    value: |z| vec![(z[1] / -5e-4).exp() * (z[0] * -0.3 + 1.0) * 50.0],
};

/// A bushing with cross terms.
static BUSHING: Formula = Formula {
    name: "bushing",
    inputs: &["e_x", "e_y", "e_x_dot", "e_y_dot"],
    outputs: &["F_x", "F_y"],
    value: |z| {
        vec![
            z[0] * -3e5 - z[1] * 2e5 - z[2] * 70.0 + z[3] * 20.0,
            z[0] * 1e5 - z[1] * 4e5 - z[2] * 30.0 - z[3] * 90.0,
        ]
    },
};

/// A torsional coupling.
static COUPLING: Formula = Formula {
    name: "coupling",
    inputs: &["omega", "theta"],
    outputs: &["F_x", "F_y", "M_z"],
    value: |z| vec![z[0] * 0.0, z[0] * 0.0, z[1] * -400.0 - z[0] * 3.0],
};

/// A law of a whole joint, in which every force and moment depends on every motion.
static WHOLE: Formula = Formula {
    name: "whole",
    inputs: &[
        "e_x",
        "e_y",
        "e_z",
        "alpha_x",
        "alpha_y",
        "e_x_dot",
        "e_y_dot",
        "e_z_dot",
        "alpha_x_dot",
        "alpha_y_dot",
        "omega",
        "theta",
    ],
    outputs: &["F_x", "F_y", "F_z", "M_x", "M_y", "M_z"],
    value: |z| {
        let [x, y, along, a, b, v_x, v_y, v_z, w_a, w_b, omega, theta] = z else {
            panic!("twelve inputs")
        };
        let stiff = (*x * x + *y * y + *along * along) * 1e12 + (*a * a + *b * b) * 1e8 + 3e5;
        let (spin, turn) = (*omega * 0.5, theta.sin());
        let torque = turn * -40.0 - *omega * 0.02;
        vec![
            -stiff * x - *along * 1e5 + *b * 700.0 - *v_x * 70.0 - spin * y * 60.0,
            -stiff * y + *along * 5e4 - *a * 600.0 - *v_y * 80.0 + spin * x * 60.0,
            -stiff * along - *x * 7e4 + *y * 9e4 + *a * 300.0 - *v_z * 90.0 + turn,
            -stiff * a * 1e-3 - *y * 500.0 + *along * 200.0 + *b * 90.0 - *w_a * 0.3 - *w_b * 0.1,
            -stiff * b * 2e-3 + *x * 800.0 - *along * 100.0 - *a * 50.0 - *w_b * 0.2 + *v_x * 0.4,
            torque + *a * *b * 1e3 + *x * 2e3,
        ]
    },
};

/// The laws of the machine of everything, by their places.
const LAWS: [&Formula; 7] = [&FILM, &RING, &CUBIC, &DAMPED, &BUSHING, &COUPLING, &WHOLE];

/// Seven nodes unevenly around a bore, moved by `size` coordinates in any way.
fn uneven(radius: f64, centre: [f64; 2], size: usize, seed: u64) -> Vec<BodyNode> {
    let mut random = wild(seed);
    let node = |angle: f64| {
        let position = [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin(), 0.2];
        BodyNode { position, shapes: Matrix::from_fn(3, size, |_, _| random()) }
    };
    [0.1, 0.8, 1.9, 2.7, 3.9, 4.6, 5.7].map(node).into()
}

/// Nodes all around a body that moves along x and y as one.
fn around(radius: f64) -> Vec<[f64; 3]> {
    (0..8)
        .map(|k| std::f64::consts::TAU * f64::from(k) / 8.0)
        .map(|angle| [radius * angle.cos(), radius * angle.sin(), 0.0])
        .collect()
}

/// A rigid body of a mass (kg) and a moment of inertia about its axis (kg·m²), with nodes at `positions` (m).
fn rigid(mass: f64, polar_inertia: f64, positions: &[[f64; 3]]) -> Shaft {
    let body = RigidBody {
        along: false,
        rocks: false,
        mass,
        polar_inertia,
        transverse_inertia: None,
        centre: [0.0; 3],
        stiffness: [0.0; 2],
        damping: [0.0; 2],
    };
    body.turning(positions)
}

/// A section that moves with `size` coordinates in any way.
fn section(size: usize, seed: u64) -> MeanMotion {
    let mut random = wild(seed);
    MeanMotion {
        centre: [0.0; 3],
        rotation: Matrix::from_fn(3, size, |_, _| 20.0 * random()),
        displacement: Matrix::from_fn(3, size, |_, _| random()),
    }
}

/// A rotor, a floating ring, a casing whose bores stand off its axis, a second rotor that is driven as prescribed, and
/// a pedestal.
fn bodies() -> Vec<Body> {
    let mut second = discs(2e5);
    let coordinates = second.size();
    second.nodes.extend(uneven(0.05, [0.0; 2], coordinates, 11));
    // The centre of mass off the axis, and moved in any way.
    second.centre_of_mass = CentreOfMass { mass: 3.0, node: second.nodes[9].clone() };
    second.measures.push(section(coordinates, 12));
    let mut rotor = discs(1e5);
    rotor.measures.push(section(rotor.size(), 13));
    let mut casing = bores();
    let shift = |node: &mut BodyNode| {
        node.position[0] += CASING_AXIS[0];
        node.position[1] += CASING_AXIS[1];
    };
    casing.nodes.iter_mut().for_each(shift);
    casing.measures.push(section(casing.size(), 14));
    let mut ring = vec![[0.0; 3]];
    ring.extend(around(0.04));
    let driven = Rotation::Prescribed { speed: 80.0, acceleration: -300.0 };
    vec![
        Body::turning("rotor", rotor, Rotation::Free),
        Body::turning("ring", rigid(0.7, 1.3e-3, &ring), Rotation::Free),
        Body::standing("casing", casing),
        Body::turning("second", second, driven),
        Body::standing("pedestal", Support::lumped(4.0, [500.0, 800.0], [20.0, 28.0], &ring)),
    ]
}

/// Where the bores of the casing stand (m).
const CASING_AXIS: [f64; 2] = [0.4, -0.3];

/// Eight bearings of four laws, with offsets, run-outs, crooked bores and axes apart; a bushing, and a coupling of two
/// sections, both with laws on tilts and along z; and two joints of a law of the whole, in a bore that stands and in one that
/// turns.
fn bearings() -> Vec<Bearing> {
    let row = |first: usize| (first..first + 7).collect::<Vec<usize>>();
    let angles = |count: usize, first: f64| {
        (0..count).map(|j| first + std::f64::consts::TAU * j as f64 / count as f64).collect()
    };
    let base = |place: usize, law: usize, bodies: [usize; 2]| Bearing {
        others: Vec::new(),
        name: format!("joint {place}"),
        label: Some(format!("_{place}")),
        sides: Sides { bodies, ..Sides::default() },
        journal: [0; 3],
        bore: [Vec::new(), (1..9).collect(), Vec::new()],
        clearance: 1e-3,
        journal_radius: Some(RADIUS),
        stations: vec![0.5],
        angles: angles(5, 0.3),
        law,
    };
    let in_casing = |bearing: Bearing| Bearing {
        bore: [row(0), row(7), row(14)],
        sides: Sides { bore_axis: CASING_AXIS, ..bearing.sides.clone() },
        journal: [1, 2, 3],
        stations: vec![0.0, 0.3, 1.0],
        angles: angles(11, 0.05),
        ..bearing
    };
    let crooked = |sides: Sides| Sides {
        run_out: [[1e-4, 2e-5], [-5e-5, 8e-5], [3e-5, -1e-4]],
        offset: [[6e-5, -2e-5], [1e-5, 1e-4], [-7e-5, 4e-5]],
        ..sides
    };
    let apart = |bearing: Bearing, apart: [f64; 2]| Bearing {
        sides: Sides { apart, ..crooked(bearing.sides.clone()) },
        ..bearing
    };
    let in_second =
        |bearing: Bearing| Bearing { bore: [Vec::new(), row(5), Vec::new()], ..bearing };
    let first = in_casing(base(0, 0, [0, 2]));
    let driven = in_casing(base(3, 3, [3, 2]));
    let ends = |node: usize, bearing: Bearing| Bearing { journal: [node; 3], ..bearing };
    let twisted = |bearing: Bearing| Bearing {
        sides: Sides { torque_section: Some(0), ..bearing.sides.clone() },
        ..bearing
    };
    let whole = |bearing: Bearing| Bearing {
        sides: Sides { whole_sections: [Some(0); 2], ..twisted(bearing.clone()).sides },
        ..bearing
    };
    vec![
        twisted(Bearing { sides: crooked(first.sides.clone()), ..first }),
        twisted(base(1, 1, [0, 1])),
        base(2, 2, [1, 4]),
        Bearing { sides: crooked(driven.sides.clone()), ..driven },
        twisted(apart(ends(4, in_second(base(4, 0, [0, 3]))), [2e-4, -3e-4])),
        twisted(apart(ends(8, in_second(base(5, 1, [2, 3]))), [-1e-4, 2e-4])),
        Bearing {
            bore: [Vec::new(), row(7), Vec::new()],
            sides: Sides { bodies: [4, 2], bore_axis: CASING_AXIS, ..Sides::default() },
            ..base(6, 3, [4, 2])
        },
        apart(base(7, 0, [3, 1]), [3e-4, 1e-4]),
        Bearing {
            bore: [Vec::new(), row(14), Vec::new()],
            sides: Sides { bodies: [0, 2], bore_axis: CASING_AXIS, ..Sides::default() },
            others: vec![
                OtherMotion { kind: MotionKind::Tilts, sections: [Some(0); 2], law: 4 },
                OtherMotion { kind: MotionKind::Along, sections: [Some(0); 2], law: 4 },
            ],
            ..ends(3, base(8, 4, [0, 2]))
        },
        Bearing {
            bore: [const { Vec::new() }; 3],
            sides: Sides { sections: [Some(0); 2], bodies: [0, 3], ..Sides::default() },
            others: vec![
                OtherMotion { kind: MotionKind::Tilts, sections: [Some(0); 2], law: 4 },
                OtherMotion { kind: MotionKind::Along, sections: [None, Some(0)], law: 4 },
            ],
            ..base(9, 5, [0, 3])
        },
        whole(Bearing {
            bore: [Vec::new(), row(14), Vec::new()],
            sides: Sides { bore_axis: CASING_AXIS, ..crooked(base(10, 6, [0, 2]).sides) },
            ..ends(3, base(10, 6, [0, 2]))
        }),
        whole(apart(ends(2, in_second(base(11, 6, [0, 3]))), [-2e-4, 1e-4])),
    ]
}

/// The machine of everything at once.
fn everything() -> MachineParts {
    let bodies = bodies();
    let sine = TimeFunction::Sine { frequency: 30.0, phase: 0.4 };
    let mut driven = bodies[0].nodes()[0].clone();
    driven.position[0] = 0.03;
    let mut loads = vec![
        force(&bodies[0].nodes()[2], [100.0, -40.0, 7.0], sine.clone(), Frame::Space),
        force(&driven, [0.0, 60.0, 0.0], TimeFunction::Constant, Frame::Body),
        force(&bodies[2].nodes()[3], [30.0, 20.0, 5.0], TimeFunction::Constant, Frame::Space),
        force(&bodies[3].nodes()[1], [-10.0, 25.0, 0.0], sine, Frame::Space),
    ];
    (loads[2].body, loads[3].body) = (2, 3);
    MachineParts {
        bodies,
        motion: motion("consistent"),
        clearance: &CLEARANCES[0],
        laws: laws(&LAWS),
        bearings: bearings(),
        loads,
    }
}

/// How a spring or a ring of a bearing is seen: what laws take, and what their forces work on.
struct Measures {
    /// h, s, α, e_x, e_y, e_z, α_x, α_y.
    values: [Dual64; 8],
    theta: Dual64,
    /// The mean turn of the bore in its body, with which the axes of e_x and e_y turn.
    beta: Dual64,
}

/// The measures at a spring of a bearing, from positions in space: of the centre of the journal and of the bore.
fn measures(
    machine: &Machine,
    own: &Bearing,
    station: f64,
    spring: usize,
    q: &[Dual64],
) -> Measures {
    let [a, b] = own.sides.bodies.map(|body| (&machine.bodies[body], &machine.places()[body]));
    let angle = |place: Option<usize>| place.map_or(Dual64::from(0.0), |place| q[place]);
    let (theta_a, theta_b) = (angle(a.1.rotation), angle(b.1.rotation));
    let turn = |theta: Dual64, [x, y]: [Dual64; 2]| {
        let (sin, cos) = theta.sin_cos();
        [cos * x - sin * y, sin * x + cos * y]
    };
    let s = station;
    let weights = [(2.0 * s - 1.0) * (s - 1.0), 4.0 * s * (1.0 - s), s * (2.0 * s - 1.0)];
    let moved = |side: &(&Body, &whirl_solver::machine::BodyPlace), node: usize, axis: usize| {
        let shapes = &side.0.nodes()[node].shapes;
        let place = side.1.flexible.clone();
        let parts = place.enumerate().map(|(j, place)| q[place] * shapes[(axis, j)]);
        parts.fold(Dual64::from(0.0), |sum, part| sum + part)
    };
    let between = |values: &[[f64; 2]; 3], axis: usize| -> f64 {
        values.iter().zip(weights).map(|(own, weight)| weight * own[axis]).sum()
    };
    let centre = [0, 1].map(|axis| {
        let nodes = own.journal.iter().zip(weights);
        let parts = nodes.map(|(&node, weight)| moved(&a, node, axis) * weight);
        parts.fold(Dual64::from(between(&own.sides.run_out, axis)), |sum, part| sum + part)
    });
    let centre = turn(theta_a, centre);
    let [x, y] = turn(-theta_b, [0, 1].map(|axis| centre[axis] + own.sides.apart[axis]));
    // The bore in its own frame: by a spline at the spring, by the rigid fit as a whole.
    let psi = own.angles.get(spring).copied().unwrap_or(0.0);
    let offset = [0, 1].map(|axis| Dual64::from(between(&own.sides.offset, axis)));
    let (mut delta, mut axis_moved, mut turned) = (offset, offset, Dual64::from(0.0));
    for (ring, weight) in own.bore.iter().zip(weights).filter(|(ring, _)| !ring.is_empty()) {
        let at = |node: usize| {
            let [x, y, _] = b.0.nodes()[node].position;
            [x - own.sides.bore_axis[0], y - own.sides.bore_axis[1]]
        };
        let knots: Vec<f64> = ring.iter().map(|&node| at(node)[1].atan2(at(node)[0])).collect();
        let spline = periodic_spline(&knots, &[psi]).expect("a spline");
        let n = ring.len() as f64;
        let mean = |of: &dyn Fn(usize) -> Dual64| {
            ring.iter().fold(Dual64::from(0.0), |sum, &node| sum + of(node)) / n
        };
        let centroid = [0, 1].map(|k| mean(&|node| Dual64::from(at(node)[k])).re);
        let plain = [0, 1].map(|k| mean(&|node| moved(&b, node, k)));
        let arm = |node: usize| [0, 1].map(|k| at(node)[k] - centroid[k]);
        let square: f64 = ring.iter().map(|&i| arm(i)[0].powi(2) + arm(i)[1].powi(2)).sum();
        let beta = mean(&|node| {
            let [x, y] = arm(node);
            moved(&b, node, 1) * x - moved(&b, node, 0) * y
        }) * (n / square);
        turned += beta * weight;
        axis_moved[0] += (plain[0] + beta * centroid[1]) * weight;
        axis_moved[1] += (plain[1] - beta * centroid[0]) * weight;
        for (knot, &node) in ring.iter().enumerate() {
            for (axis, sum) in delta.iter_mut().enumerate() {
                *sum += moved(&b, node, axis) * (weight * spline[(0, knot)]);
            }
        }
    }
    // The offset of the axis turns with the bore.
    axis_moved[0] -= turned * offset[1];
    axis_moved[1] += turned * offset[0];
    let (sin, cos) = psi.sin_cos();
    let along = |[x, y]: [Dual64; 2]| x * cos + y * sin;
    let across = |[x, y]: [Dual64; 2]| y * cos - x * sin;
    let of_section = |side: &(&Body, &whirl_solver::machine::BodyPlace),
                      section: Option<usize>,
                      turns: bool,
                      axis: usize| {
        let Some(section) = section else { return Dual64::from(0.0) };
        let section = &side.0.measures()[section];
        let rows = if turns { &section.rotation } else { &section.displacement };
        let parts = side.1.flexible.clone().enumerate();
        let parts = parts.map(|(j, place)| q[place] * rows[(axis, j)]);
        parts.fold(Dual64::from(0.0), |sum, part| sum + part)
    };
    let twist = |side: &(&Body, &whirl_solver::machine::BodyPlace), section: Option<usize>| {
        of_section(side, section, true, 2)
    };
    let [of_a, of_b] = own.sides.sections;
    let theta = theta_a + twist(&a, of_a) - theta_b - twist(&b, of_b);
    let of_torque = theta + twist(&a, own.sides.torque_section);
    let [e_x, e_y] = turn(-turned, [x - axis_moved[0], y - axis_moved[1]]);
    let [whole_a, whole_b] = own.sides.whole_sections;
    let tilts = turn(theta_a - theta_b, [0, 1].map(|axis| of_section(&a, whole_a, true, axis)));
    let tilts = [0, 1].map(|axis| tilts[axis] - of_section(&b, whole_b, true, axis));
    let [alpha_x, alpha_y] = turn(-turned, tilts);
    Measures {
        values: [
            along(delta) - along([x, y]) + own.clearance,
            of_torque * RADIUS + across([x, y]) - across(delta),
            of_torque - turned,
            e_x,
            e_y,
            of_section(&a, whole_a, false, 2) - of_section(&b, whole_b, false, 2),
            alpha_x,
            alpha_y,
        ],
        theta,
        beta: turned,
    }
}

/// The measures of a law on another motion of the sides of a bearing: e_x and e_y are tilts in the frame of the second
/// side, or a displacement along z.
fn other_measures(machine: &Machine, own: &Bearing, other: &OtherMotion, q: &[Dual64]) -> Measures {
    let side = |k: usize, axis: usize| {
        let Some(section) = other.sections[k] else { return Dual64::from(0.0) };
        let body = own.sides.bodies[k];
        let section = &machine.bodies[body].measures()[section];
        let (rows, row) = match other.kind {
            MotionKind::Tilts => (&section.rotation, axis),
            MotionKind::Along => (&section.displacement, 2),
        };
        let parts = machine.places()[body].flexible.clone().enumerate();
        parts.fold(Dual64::from(0.0), |sum, (j, place)| sum + q[place] * rows[(row, j)])
    };
    let angle =
        |body: usize| machine.places()[body].rotation.map_or(Dual64::from(0.0), |place| q[place]);
    let zero = Dual64::from(0.0);
    let [x, y] = match other.kind {
        MotionKind::Along => [side(0, 2) - side(1, 2), zero],
        MotionKind::Tilts => {
            let [first, second] = own.sides.bodies;
            let (sin, cos) = (angle(first) - angle(second)).sin_cos();
            let (x, y) = (side(0, 0), side(0, 1));
            let [x, y] = [cos * x - sin * y - side(1, 0), sin * x + cos * y - side(1, 1)];
            // Along axes that turn with the second section.
            let (sin, cos) = side(1, 2).sin_cos();
            [cos * x + sin * y, cos * y - sin * x]
        }
    };
    let beta = if other.kind == MotionKind::Tilts { side(1, 2) } else { zero };
    Measures { values: [zero, zero, zero, x, y, zero, zero, zero], theta: zero, beta }
}

/// One load of every kind on the bodies of the machine of everything.
fn every_load(bodies: &[Body]) -> Vec<(&'static str, Load)> {
    let mut random = wild(23);
    let mut turn = |body: usize| Matrix::from_fn(3, bodies[body].size(), |_, _| random());
    let node = |body: usize, place: usize| bodies[body].nodes()[place].clone();
    let rows: Vec<[f64; 2]> = (0..=24)
        .map(|k| std::f64::consts::TAU * f64::from(k) / 24.0)
        .map(|angle| [angle, (2.0 * angle).cos() + 0.3])
        .collect();
    let curve = Arc::new(Curve::smooth(&rows, true).expect("a curve"));
    let brake = Curve::linear(&[[-300.0, 5.0], [300.0, -4.0]], false).expect("a curve");
    let over_angle = |body| TimeFunction::OverAngle { body, curve: curve.clone() };
    let order = |body| TimeFunction::Order { body, order: 1.5, phase: 0.4 };
    let (space, body) = (Frame::Space, Frame::Body);
    let speed = || TimeFunction::OverSpeed(Arc::new(brake.clone()));
    let mut loads = vec![
        ("order", Load::force(0, node(0, 2), [90.0, -30.0, 5.0], order(0), space)),
        ("order in the body", Load::force(0, node(0, 1), [20.0, 60.0, 0.0], order(0), body)),
        ("order of another", Load::force(2, node(2, 3), [30.0, -20.0, 5.0], order(1), space)),
        ("angle of another", Load::force(0, node(0, 3), [-70.0, 15.0, 0.0], over_angle(1), space)),
        ("couple", Load::couple(0, turn(0), [3.0, -2.0, 4.0], TimeFunction::Constant, space)),
        ("couple in the body", Load::couple(0, turn(0), [1.0, 2.0, 3.0], order(1), body)),
        ("couple over the angle", Load::couple(3, turn(3), [2.0, 0.5, -1.0], over_angle(0), space)),
        ("couple on what stands", Load::couple(4, turn(4), [2.0, 3.0, 1.0], order(0), space)),
        ("couple over speed", Load::couple(0, turn(0), [0.0, 1.0, 2.0], speed(), body)),
        ("force over speed", Load::force(1, node(1, 2), [4.0, -3.0, 0.0], speed(), space)),
        ("ramp", {
            Load::force(0, node(0, 2), [8.0, 9.0, 1.0], order(0), space)
                .from(Onset::Ramp(0.0, 0.03))
        }),
    ];
    loads.extend(weights(bodies, [-9.81, 2.0, 1.0]).into_iter().map(|load| ("weight", load)));
    loads
}
