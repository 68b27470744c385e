//! A machine small enough to say every number of it, for tests.

use whirl_specs::{CLEARANCES, MOTIONS};

use crate::bearing::{Bearing, Sides, SpringLaw};
use crate::body::BodyNode;
use crate::centre_of_mass::CentreOfMass;
use crate::equations::State;
use crate::linalg::Matrix;
use crate::loads::{Frame, Load, TimeFunction};
use crate::machine::{Body, Machine, MachineParts, Rotation};
use crate::shaft::Shaft;
use crate::support::Support;

/// Angles of the springs.
pub(super) const ANGLES: [f64; 3] = [0.3, 2.0, 4.4];
/// Radius of the journal in bearings with friction or a moment (m).
pub(super) const RADIUS: f64 = 0.25;
/// The force of the load (N).
pub(super) const FORCE: [f64; 3] = [1.0, 4.0, 8.0];

/// A law by its formula. Its slopes are zero.
struct Formula {
    names: [&'static [&'static str]; 2],
    value: fn(&[f64]) -> Vec<f64>,
}

impl SpringLaw for Formula {
    fn name(&self) -> &str {
        "formula"
    }
    fn hash(&self) -> &str {
        ""
    }
    fn inputs(&self) -> Vec<&str> {
        self.names[0].to_vec()
    }
    fn outputs(&self) -> Vec<&str> {
        self.names[1].to_vec()
    }
    fn workspace(&self) -> usize {
        0
    }
    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], _: &mut [f64]) {
        outputs.fill(0.0);
        let rows = 1 + self.names[0].len();
        for j in 0..springs {
            let z: Vec<f64> = inputs.iter().skip(j).step_by(springs).copied().collect();
            for (output, value) in (self.value)(&z).into_iter().enumerate() {
                outputs[output * rows * springs + j] = value;
            }
        }
    }
}

fn law(names: [&'static [&'static str]; 2], value: fn(&[f64]) -> Vec<f64>) -> Box<dyn SpringLaw> {
    Box::new(Formula { names, value })
}

/// Two coordinates that move a node at (0.3, 0.4) m by (3, 4) and (5, −12); around it three bearings in a bore of
/// 4 kg: springs Q(h), springs with friction, and a ring with a moment.
pub(super) fn machine(rotation: Rotation) -> Machine {
    let matrix = |a: f64, b: f64, c: f64| Matrix { rows: 2, cols: 2, data: vec![a, b, b, c] };
    let shapes = Matrix { rows: 3, cols: 2, data: vec![3.0, 4.0, 0.0, 5.0, -12.0, 0.0] };
    let node = BodyNode { position: [0.3, 0.4, 0.0], shapes };
    let shaft = Shaft {
        j0: 7.0,
        y0: vec![0.2, -0.1],
        g0: vec![0.3, 0.6],
        mass: matrix(2.0, 0.5, 3.0),
        stiffness: matrix(900.0, -300.0, 1700.0),
        damping: matrix(13.0, 3.0, 17.0),
        spin_inertia: matrix(1.5, 0.2, 2.5),
        spin_coupling: Matrix { rows: 2, cols: 2, data: vec![0.0, -0.7, 0.7, 0.0] },
        spin_net: matrix(1.2, 0.4, 1.9),
        hertz: Vec::new(),
        coordinates: vec!["mode 1".to_owned(), "mode 2".to_owned()],
        nodes: vec![node.clone()],
        measures: Vec::new(),
        sections: Vec::new(),
        centre_of_mass: CentreOfMass::none(2),
    };
    let around: Vec<[f64; 3]> =
        (0..5).map(|i| f64::from(i).sin_cos()).map(|(y, x)| [x, y, 0.0]).collect();
    let support = Support::lumped(4.0, [500.0, 800.0], [20.0, 28.0], &around);
    let bearing = |law: usize| Bearing {
        others: Vec::new(),
        name: format!("bearing {law}"),
        label: None,
        sides: Sides::default(),
        journal: [0; 3],
        bore: [Vec::new(), (0..5).collect(), Vec::new()],
        clearance: 0.5,
        journal_radius: Some(RADIUS),
        stations: vec![0.5],
        angles: ANGLES.to_vec(),
        law,
    };
    let parts = MachineParts {
        bodies: vec![Body::turning("shaft", shaft, rotation), Body::standing("support", support)],
        motion: MOTIONS.iter().find(|own| own.origin.name == "consistent").expect("is shipped"),
        clearance: &CLEARANCES[0],
        laws: vec![
            law([&["h"], &["Q"]], |z| vec![40.0 * z[0]]),
            law([&["h"], &["Q", "T"]], |z| vec![30.0 * z[0], -70.0 * z[0]]),
            law([&["e_x", "e_y"], &["F_x", "F_y", "M_z"]], |z| {
                vec![20.0 * z[0], 60.0 * z[1], 5.0 + z[0]]
            }),
        ],
        bearings: (0..3).map(bearing).collect(),
        loads: vec![Load::force(0, node, FORCE, TimeFunction::Constant, Frame::Body)],
    };
    Machine::new(parts).expect("a machine")
}

/// A state in which nothing is zero but θ, so that both frames are one.
pub(super) fn state(size: usize) -> State {
    let values = |first: f64| (0..size).map(|i| (first + 1.7 * i as f64).sin()).collect();
    let (q, v, a) = (values(0.4), values(1.1), values(2.3));
    let mut state = State { q, v, a, ..State::new(size) };
    state.q.iter_mut().for_each(|q| *q *= 0.03);
    state.q[0] = 0.0;
    state
}
