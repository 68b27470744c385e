//! Machines small enough to reason about: discs on a massless elastic line, in bores that vibrate.

mod audit;
mod automatic;
mod contacts;
mod eccentricity;
mod equations;
mod films;
mod free_shaft;
mod friction;
mod generalized_alpha;
mod loads;
mod lumped;
mod many;
mod newton;
mod oil;
mod quality;
mod remembering;
mod resume;
mod spinning;
mod starts;
mod torques;
mod turns;
mod validity;

use whirl_solver::bearing::{Bearing, Sides, SpringLaw};
use whirl_solver::body::BodyNode;
use whirl_solver::centre_of_mass::CentreOfMass;
use whirl_solver::dynamics::{BodyStart, Integrator, MarchOptions, NewtonOptions, SteadyRule};
use whirl_solver::linalg::Matrix;
use whirl_solver::loads::{Frame, Load, TimeFunction};
use whirl_solver::machine::{Body, MachineParts, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::{CLEARANCES, Law, MOTIONS, Motion, Origin, Variable};

/// Number of discs.
pub(crate) const DISCS: usize = 5;
/// Mass of a disc (kg) and the moment of inertia of the whole about the axis (kg·m²).
pub(crate) const DISC: f64 = 2.0;
pub(crate) const INERTIA: f64 = 0.05;

/// A motion by its name.
pub(crate) fn motion(name: &str) -> &'static Motion {
    MOTIONS.iter().find(|motion| motion.origin.name == name).expect("a shipped motion")
}

/// Discs 0.1 m apart whose x and y are the coordinates; the line between them resists bending with
/// `bending` (N/m against the second difference) but neither translation nor tilt. For such a shaft
/// M = Y is diagonal and H is M times a quarter turn, exactly.
pub(crate) fn discs(bending: f64) -> Shaft {
    let n = 2 * DISCS;
    let mut stiffness = Matrix::zeros(n, n);
    for middle in 1..DISCS - 1 {
        for axis in 0..2 {
            let terms = [(middle - 1, 1.0), (middle, -2.0), (middle + 1, 1.0)];
            for (a, left) in terms {
                for (b, right) in terms {
                    stiffness[(2 * a + axis, 2 * b + axis)] += bending * left * right;
                }
            }
        }
    }
    let mass = Matrix::from_diagonal(&vec![DISC; n]);
    let mut spin_coupling = Matrix::zeros(n, n);
    for disc in 0..DISCS {
        spin_coupling[(2 * disc, 2 * disc + 1)] = DISC;
        spin_coupling[(2 * disc + 1, 2 * disc)] = -DISC;
    }
    let node = |disc: usize| {
        let mut shapes = Matrix::zeros(3, n);
        shapes[(0, 2 * disc)] = 1.0;
        shapes[(1, 2 * disc + 1)] = 1.0;
        BodyNode { position: [0.0, 0.0, 0.1 * disc as f64], shapes }
    };
    Shaft {
        hertz: Vec::new(),
        j0: INERTIA,
        y0: vec![0.0; n],
        g0: vec![0.0; n],
        damping: Matrix::zeros(n, n),
        spin_inertia: mass.clone(),
        spin_net: mass.clone(),
        mass,
        stiffness,
        spin_coupling,
        coordinates: (0..n).map(|i| format!("disc {} {}", i / 2 + 1, ["x", "y"][i % 2])).collect(),
        nodes: (0..DISCS).map(node).collect(),
        measures: Vec::new(),
        sections: Vec::new(),
        centre_of_mass: CentreOfMass::none(n),
    }
}

/// Values in (−1, 1), the same every time.
pub(crate) fn wild(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Three bore rings of seven nodes unevenly around, moved by four oscillators in any way.
pub(crate) fn bores() -> Support {
    let mut random = wild(5);
    let angles = [0.1, 0.8, 1.9, 2.7, 3.9, 4.6, 5.7_f64];
    let mut nodes = Vec::new();
    for ring in 0..3 {
        for angle in angles {
            let position = [0.03 * angle.cos(), 0.03 * angle.sin(), 0.1 * f64::from(1 + ring)];
            nodes.push(BodyNode { position, shapes: Matrix::from_fn(3, 4, |_, _| random()) });
        }
    }
    Support {
        hertz: Vec::new(),
        stiffness: vec![1e4, 2e4, 5e4, 9e4],
        damping: vec![1.0, 2.0, 5.0, 9.0],
        coordinates: (1..=4).map(|i| format!("mode {i}")).collect(),
        nodes,
        measures: Vec::new(),
        sections: Vec::new(),
        centre_of_mass: CentreOfMass::none(4),
    }
}

/// A bearing of the middle three discs in [`bores`], with springs in four planes.
pub(crate) fn bearing(law: usize) -> Bearing {
    Bearing {
        others: Vec::new(),
        name: "bearing 1".to_owned(),
        label: None,
        sides: Sides::default(),
        journal: [1, 2, 3],
        bore: [(0..7).collect(), (7..14).collect(), (14..21).collect()],
        clearance: 1e-3,
        journal_radius: None,
        stations: vec![0.0, 0.3, 0.5, 1.0],
        angles: (0..11).map(|j| 0.05 + std::f64::consts::TAU * f64::from(j) / 11.0).collect(),
        law,
    }
}

/// A bearing of one ring without a support, at a journal of one node.
pub(crate) fn stops(name: &str, gap: f64, angles: &[f64], law: usize) -> Bearing {
    Bearing {
        others: Vec::new(),
        name: name.to_owned(),
        label: None,
        sides: Sides::default(),
        journal: [0; 3],
        bore: [Vec::new(), Vec::new(), Vec::new()],
        clearance: gap,
        journal_radius: None,
        stations: vec![0.5],
        angles: angles.to_vec(),
        law,
    }
}

const H: Variable = Variable { name: "h", unit: "m", title: "clearance" };
const H_DOT: Variable = Variable { name: "h_dot", unit: "m/s", title: "its rate" };
const Q: Variable = Variable { name: "Q", unit: "N", title: "normal force" };

/// A law of a test.
pub(crate) const fn law(name: &'static str, rates: bool, evaluate: whirl_specs::LawKernel) -> Law {
    let origin = Origin { name, title: "", source: "", spec: "", text: "", hash: "" };
    let inputs: &[Variable] = if rates { &[H, H_DOT] } else { &[H] };
    Law {
        origin,
        inputs,
        outputs: &[Q],
        states: &[],
        evaluate,
        forces: None,
        skeleton: None,
        forces_skeleton: None,
        stored: None,
        valid: &[],
        measure: |_, _, _| {},
    }
}

/// Q = 50 N · exp(−h/0.5 mm) · (1 − ḣ/(2 m/s)): smooth, and a different force for every ḣ.
pub(crate) static FILM: Law = law("film", true, |n, inputs, outputs| {
    let (h, h_dot) = inputs.split_at(n);
    for j in 0..n {
        let thin = 50.0 * (-h[j] / 5e-4).exp();
        outputs[j] = thin * (1.0 - 0.5 * h_dot[j]);
        outputs[n + j] = -outputs[j] / 5e-4;
        outputs[2 * n + j] = -0.5 * thin;
    }
});

/// A law as machines take it.
pub(crate) fn boxed(law: &'static Law) -> Box<dyn SpringLaw> {
    Box::new(law)
}

/// The parts of a machine without bearings or loads.
pub(crate) fn parts(shaft: Shaft, support: Support, rotation: Rotation) -> MachineParts {
    MachineParts {
        bodies: vec![Body::turning("shaft", shaft, rotation), Body::standing("support", support)],
        motion: motion("consistent"),
        clearance: &CLEARANCES[0],
        laws: Vec::new(),
        bearings: Vec::new(),
        loads: Vec::new(),
    }
}

/// A force on a node.
pub(crate) fn force(
    node: &BodyNode,
    force: [f64; 3],
    time_function: TimeFunction,
    frame: Frame,
) -> Load {
    Load::force(0, node.clone(), force, time_function, frame)
}

/// A march from rest, accurate to rounding.
pub(crate) fn options(time_step: f64, steps: usize) -> MarchOptions {
    MarchOptions {
        time_step,
        automatic: None,
        steps,
        integrator: Integrator::default(),
        newton: NewtonOptions {
            force_tolerance: 1e-8,
            residual_tolerance: 1e-10,
            ..NewtonOptions::default()
        },
        cycle: None,
        steady_rule: SteadyRule::default(),
        stop_when_steady: false,
        initial: vec![BodyStart::default()],
        laws_at_rest: false,
    }
}
