//! Action and reaction, over every kind of joint between every kind of body: what a joint does to both of its bodies sums to
//! nothing, as forces and as moments.

use whirl_solver::bearing::{Bearing, MotionKind, OtherMotion, Sides};
use whirl_solver::body::BodyNode;
use whirl_solver::centre_of_mass::CentreOfMass;
use whirl_solver::equations::{Equations, State};
use whirl_solver::linalg::Matrix;
use whirl_solver::machine::{Body, Machine, MachineParts, Rotation};
use whirl_solver::measure::MeanMotion;
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::CLEARANCES;

use super::super::contacts::{FILM, Formula, RING, laws};
use super::super::{motion, wild};
use super::{BUSHING, COUPLING, DAMPED, WHOLE, around, rigid};

/// Coordinates of a body that deforms: x and y of all its nodes, the turn of its section, two tilts, z.
const SIZE: usize = 6;

/// What stands at either side of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// A rigid body that turns.
    Rigid,
    /// A body that deforms, and turns freely or as prescribed.
    Flexible(bool),
    /// A body that deforms and does not turn.
    Standing,
    /// A rigid body that moves along x and y.
    Block,
}

fn points() -> Vec<[f64; 3]> {
    let mut points = vec![[0.0; 3]];
    points.extend(around(0.04));
    points
}

/// Nodes that move with the coordinates as one body, and their section.
fn moved_as_one() -> (Vec<BodyNode>, MeanMotion) {
    let unit = |place: usize| Matrix::from_fn(3, SIZE, |i, j| f64::from(u8::from(place + i == j)));
    let node = |position: [f64; 3]| {
        let mut shapes = unit(0);
        shapes[(2, 2)] = 0.0;
        (shapes[(0, 2)], shapes[(1, 2)]) = (-position[1], position[0]);
        shapes[(2, 5)] = 1.0;
        BodyNode { position, shapes }
    };
    let nodes: Vec<BodyNode> = points().into_iter().map(node).collect();
    let rotation = Matrix::from_fn(3, SIZE, |i, j| f64::from(u8::from([3, 4, 2][i] == j)));
    let displacement = nodes[0].shapes.clone();
    (nodes, MeanMotion { centre: [0.0; 3], displacement, rotation })
}

fn body(kind: Kind) -> Body {
    let (nodes, section) = moved_as_one();
    let centre_of_mass = CentreOfMass { mass: 1.0, node: nodes[0].clone() };
    let coordinates = || (0..SIZE).map(|j| format!("coordinate {j}")).collect::<Vec<String>>();
    match kind {
        Kind::Rigid => Body::turning("rigid", rigid(0.7, 1.3e-3, &points()), Rotation::Free),
        Kind::Block => {
            let block = Support::lumped(0.7, [0.0; 2], [0.0; 2], &points());
            Body::standing("block", block)
        }
        Kind::Standing => {
            let support = Support {
                stiffness: vec![0.0; SIZE],
                damping: vec![0.0; SIZE],
                hertz: Vec::new(),
                coordinates: coordinates(),
                nodes,
                measures: vec![section],
                sections: Vec::new(),
                centre_of_mass,
            };
            Body::standing("standing", support)
        }
        Kind::Flexible(free) => {
            let zeros = || Matrix::zeros(SIZE, SIZE);
            let shaft = Shaft {
                j0: 1e-3,
                y0: vec![0.0; SIZE],
                g0: vec![0.0; SIZE],
                mass: Matrix::from_diagonal(&[1.0; SIZE]),
                stiffness: zeros(),
                damping: zeros(),
                spin_inertia: zeros(),
                spin_coupling: zeros(),
                spin_net: zeros(),
                hertz: Vec::new(),
                coordinates: coordinates(),
                nodes,
                measures: vec![section],
                sections: Vec::new(),
                centre_of_mass,
            };
            let driven = Rotation::Prescribed { speed: 80.0, acceleration: 0.0 };
            Body::turning("flexible", shaft, if free { Rotation::Free } else { driven })
        }
    }
}

const KINDS: [Kind; 5] =
    [Kind::Rigid, Kind::Flexible(true), Kind::Flexible(false), Kind::Standing, Kind::Block];

impl Kind {
    fn section(self) -> Option<usize> {
        matches!(self, Kind::Flexible(_) | Kind::Standing).then_some(0)
    }

    fn turns(self) -> bool {
        matches!(self, Kind::Rigid | Kind::Flexible(_))
    }

    /// How its coordinates move as it goes along x, y and z, turns about z through the origin of space and tilts about x and
    /// y; none of a motion that it does not have.
    fn as_one(self, machine: &Machine, place: usize, q: &[f64]) -> [Option<Vec<(usize, f64)>>; 6] {
        let own = &machine.places()[place];
        let first = own.flexible.start;
        let z = self.section().map(|_| vec![(first + 5, 1.0)]);
        let unit = match &machine.bodies[place] {
            Body::Standing { support, .. } => support.nodes[0].shapes[(0, 0)],
            Body::Turning { .. } => 1.0,
        };
        let turn = match (own.rotation, self) {
            (Some(theta), _) => Some(vec![(theta, 1.0)]),
            (None, Kind::Standing) => {
                let [x, y, .., tilt_x, tilt_y] = [0, 1, 2, 3, 4].map(|j| q[first + j]);
                let parts = [-y, x, 1.0, -tilt_y, tilt_x].into_iter().enumerate();
                Some(parts.map(|(j, part)| (first + j, part)).collect())
            }
            _ => None,
        };
        let (sin, cos) = own.rotation.map_or(0.0, |theta| q[theta]).sin_cos();
        let along = |x: f64, y: f64| Some(vec![(first, x / unit), (first + 1, y / unit)]);
        let tilt = |x: f64, y: f64| self.section().map(|_| vec![(first + 3, x), (first + 4, y)]);
        [along(cos, -sin), along(sin, cos), z, turn, tilt(cos, -sin), tilt(sin, cos)]
    }
}

/// A joint by its law, what else it acts on, and whether its law stands at springs.
fn joint(law: usize, kinds: [Kind; 2]) -> Bearing {
    let coupling = law == 4;
    let sections = kinds.map(Kind::section);
    let bore = if coupling { Vec::new() } else { (1..9).collect() };
    let other = |kind: MotionKind| OtherMotion { kind, sections, law: 3 };
    Bearing {
        others: match law == 3 {
            true => vec![other(MotionKind::Tilts), other(MotionKind::Along)],
            false => Vec::new(),
        },
        name: "joint".to_owned(),
        label: None,
        sides: Sides {
            // Of a body that does not turn the arm of a force on its journal is that to its nodes.
            run_out: [if kinds[0].turns() { [3e-5, -1e-5] } else { [0.0; 2] }; 3],
            offset: [[-2e-5, 4e-5]; 3],
            sections: if coupling { sections } else { [None; 2] },
            torque_section: if coupling { None } else { sections[0] },
            whole_sections: if law == 5 { sections } else { [None; 2] },
            ..Sides::default()
        },
        journal: [0; 3],
        bore: [Vec::new(), bore, Vec::new()],
        clearance: 1e-3,
        journal_radius: Some(0.03),
        stations: vec![0.5],
        angles: (0..5).map(|j| 0.3 + std::f64::consts::TAU * f64::from(j) / 5.0).collect(),
        law,
    }
}

/// Laws of springs without and with friction, of rings without and with a torque, of a coupling, and of a whole joint.
const LAWS: [&Formula; 6] = [&DAMPED, &FILM, &RING, &BUSHING, &COUPLING, &WHOLE];

#[test]
fn every_joint_leaves_no_force_and_no_moment_on_bodies_of_every_kind() {
    let mut turned = 0;
    for law in 0..LAWS.len() {
        for kinds in KINDS.into_iter().flat_map(|one| KINDS.map(|other| [one, other])) {
            if kinds == [Kind::Block; 2] || law == 4 && !kinds[0].turns() {
                continue;
            }
            let residual = |bearings: Vec<Bearing>, state: Option<&State>| {
                let parts = MachineParts {
                    bodies: kinds.map(body).into(),
                    motion: motion("consistent"),
                    clearance: &CLEARANCES[0],
                    laws: laws(&LAWS),
                    bearings,
                    loads: Vec::new(),
                };
                let machine = Machine::new(parts).expect("a machine");
                let mut own = State::new(machine.size());
                let mut random = wild(31);
                // Sizes of displacements, of which measures are linear: what is left is their square. Angles come after.
                own.q.iter_mut().for_each(|q| *q = 1e-6 * random());
                own.v.iter_mut().for_each(|v| *v = random());
                for place in machine.places().iter().filter_map(|own| own.rotation) {
                    (own.q[place], own.v[place]) = (40.0 * random(), 3000.0 * random());
                }
                let state = state.unwrap_or(&own);
                let mut equations = Equations::new(&machine);
                equations.evaluate(0.0, state);
                let residual = equations.residual().to_vec();
                (machine, own, residual)
            };
            let (machine, state, with) = residual(vec![joint(law, kinds)], None);
            let (_, _, without) = residual(Vec::new(), Some(&state));
            let forces: Vec<f64> = with.iter().zip(&without).map(|(a, b)| a - b).collect();
            let motions = [0, 1].map(|place| kinds[place].as_one(&machine, place, &state.q));
            let all = ["x", "y", "z", "a turn about z", "a tilt about x", "a tilt about y"];
            for (axis, what) in all.into_iter().enumerate() {
                let [Some(one), Some(other)] = [0, 1].map(|side| motions[side][axis].as_ref())
                else {
                    continue;
                };
                // As in the paper: a bore whose nodes carry springs has them act at its undeformed radius.
                if axis == 3 && law < 2 && !kinds[1].turns() {
                    continue;
                }
                let work = |motion: &Vec<(usize, f64)>| -> [f64; 2] {
                    let terms = motion.iter().map(|&(i, part)| part * forces[i]);
                    let inertia = motion.iter().map(|&(i, part)| (part * without[i]).abs());
                    terms.zip(inertia).fold([0.0; 2], |[sum, size], (own, other)| {
                        [sum + own, size + own.abs() + other]
                    })
                };
                let ([a, size_a], [b, size_b]) = (work(one), work(other));
                if axis == 3 {
                    turned += usize::from(a.abs() > 1e-6);
                }
                // Rounding: sums of a few dozen terms, each of which has a handful of factors.
                // Sections of bodies that do not turn do so by up to 1e-6, and offsets of bores with them, to first order.
                let square = if axis == 3 && !kinds[1].turns() { 1e-6 } else { 0.0 };
                let allowed = (512.0 * f64::EPSILON + square) * (size_a + size_b) + 1e-18;
                assert!(
                    (a + b).abs() <= allowed,
                    "law {law} between {kinds:?}, {what}: {a:e} and {b:e}, {:e} beyond {allowed:e}",
                    a + b
                );
            }
        }
    }
    assert!(turned > 40, "moments in {turned} joints");
}
