//! A short steel shaft in two bearings, made and reduced in a moment: 289 nodes, 21 coordinates.

use whirl_benches::hand::elements::ELEMENTS;
use whirl_solver::bearing::{Bearing, Sides, SpringLaw};
use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::Constraints;
use whirl_solver::dynamics::{BodyStart, Integrator, MarchOptions, NewtonOptions, SteadyRule};
use whirl_solver::machine::{Body, MachineParts, Rotation};
use whirl_solver::mesh::shaft::{SectionCells, SolidShaft};
use whirl_solver::mesh::{Material, Mesh, NodeSetMean};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::{CLEARANCES, MOTIONS, Motion};

const LENGTH: f64 = 0.4;
/// z of the nodes of both journals: left end, middle, right end (m).
pub(crate) const JOURNALS: [[f64; 3]; 2] = [[0.04, 0.05, 0.06], [0.34, 0.35, 0.36]];
/// Radial clearance (m).
pub(crate) const CLEARANCE: f64 = 1e-3;
/// Springs of an even ring.
pub(crate) const SPRINGS: usize = 12;

/// Its mesh.
pub(crate) fn mesh() -> Mesh {
    let shaft = SolidShaft {
        length: LENGTH,
        diameter: 0.05,
        supports: JOURNALS.map(|journal| journal[1]).to_vec(),
        support_length: 0.02,
        layers_in_support: 2,
        layers_between: 8,
        loads: Vec::new(),
        sections: Vec::new(),
        section: SectionCells { sectors: 8, rings: 2, order: 1 },
        material: Material::isotropic("STEEL", 200e9, 0.3, 7860.0).expect("steel"),
    };
    shaft.mesh(&ELEMENTS).expect("a mesh")
}

/// Where the nodes of a journal stand in [`Shaft::nodes`]: left end, middle, right end.
pub(crate) fn journal(bearing: usize) -> [usize; 3] {
    [0, 1, 2].map(|place| 3 * bearing + place)
}

/// The shaft without damping, held along the axis, its drive end tied to the turning frame. Its first six
/// nodes are those of the journals, the others all nodes of the mesh.
pub(crate) fn shaft(mesh: &Mesh) -> Shaft {
    let mut retained = Vec::new();
    let mut retain = |set: &str, axis: usize| {
        let dof = 3 * mesh.single_node(set).expect("a set of the mesh") + axis;
        retained.push(Retained::dof(dof, format!("{set} {}", ["x", "y", "z"][axis])));
        retained.len() - 1
    };
    let mut nodes = Vec::new();
    for bearing in 1..=JOURNALS.len() {
        for place in ["LEFT", "MIDDLE", "RIGHT"] {
            let set = format!("JOURNAL{bearing}_{place}");
            for axis in [0, 1] {
                retain(&set, axis);
            }
            nodes.push(mesh.single_node(&set).expect("a set of the mesh"));
        }
    }
    nodes.extend(0..mesh.nodes().len());
    let axial = retain("JOURNAL1_MIDDLE", 2);
    let (top, bottom) = (retain("DRIVE_TOP", 1), retain("DRIVE_BOTTOM", 1));
    let in_the_middle = |&node: &usize| (mesh.nodes()[node][2] - 0.2).abs() < 1e-9;
    let middle: Vec<usize> = (0..mesh.nodes().len()).filter(in_the_middle).collect();
    let mut constraints = Constraints::new();
    constraints.fix("axial", axial);
    constraints.equation("drive", [(top, 1.0), (bottom, -1.0)]);
    let spec = BodySpec {
        corrections: Vec::new(),
        sections: Vec::new(),
        retained,
        held: Vec::new(),
        modes: 8,
        constraints,
        springs: Vec::new(),
        damping: Rayleigh::default(),
        nodes,
        stiffening: false,
        means: vec![NodeSetMean::new(mesh, &middle).expect("a section in the middle")],
        memory: 1 << 30,
    };
    Shaft::from_mesh(mesh, &spec).expect("a shaft")
}

/// η of a rigid displacement by (x, y) in the frame of the shaft: fixed-interface modes rest, retained dofs
/// follow.
pub(crate) fn translation(shaft: &Shaft, [x, y]: [f64; 2]) -> Vec<f64> {
    let value = |name: &String| match name.rsplit_once(' ') {
        Some((_, "x")) => x,
        Some((_, "y")) => y,
        _ => 0.0,
    };
    shaft.coordinates.iter().map(value).collect()
}

/// A motion by its name.
pub(crate) fn motion(name: &str) -> &'static Motion {
    MOTIONS.iter().find(|motion| motion.origin.name == name).expect("a shipped motion")
}

/// A free shaft: no bearings, no loads.
pub(crate) fn free(shaft: Shaft, motion: &'static Motion) -> MachineParts {
    MachineParts {
        bodies: vec![
            Body::turning("shaft", shaft, Rotation::Free),
            Body::standing("support", Support::rigid(&[])),
        ],
        motion,
        clearance: &CLEARANCES[0],
        laws: Vec::new(),
        bearings: Vec::new(),
        loads: Vec::new(),
    }
}

/// Angles of a ring of evenly spaced springs (rad).
pub(crate) fn ring() -> Vec<f64> {
    (0..SPRINGS).map(|j| std::f64::consts::TAU * j as f64 / SPRINGS as f64).collect()
}

/// Both bearings, with springs of the first law at `angles` (rad) around the three nodes of each journal.
/// `bore`: places in `Support::nodes` of the bore rings of each bearing.
pub(crate) fn bearings(angles: &[f64], bore: [[Vec<usize>; 3]; 2]) -> Vec<Bearing> {
    let bearing = |(number, bore): (usize, [Vec<usize>; 3])| Bearing {
        others: Vec::new(),
        name: format!("bearing {}", number + 1),
        label: None,
        sides: Sides::default(),
        journal: journal(number),
        bore,
        clearance: CLEARANCE,
        journal_radius: None,
        stations: vec![0.0, 0.5, 1.0],
        angles: angles.to_vec(),
        law: 0,
    };
    bore.into_iter().enumerate().map(bearing).collect()
}

/// A law given by h ↦ (Q, ∂Q/∂h).
pub(crate) struct LawOf<F>(pub(crate) &'static str, pub(crate) F);

impl<F: Fn(f64) -> [f64; 2] + Send + Sync> SpringLaw for LawOf<F> {
    fn name(&self) -> &str {
        self.0
    }
    fn hash(&self) -> &str {
        ""
    }
    fn inputs(&self) -> Vec<&str> {
        vec!["h"]
    }
    fn outputs(&self) -> Vec<&str> {
        vec!["Q"]
    }
    fn workspace(&self) -> usize {
        0
    }
    fn evaluate(&self, springs: usize, h: &[f64], outputs: &mut [f64], _: &mut [f64]) {
        for j in 0..springs {
            [outputs[j], outputs[springs + j]] = (self.1)(h[j]);
        }
    }
}

/// A march from rest with steps solved to rounding.
pub(crate) fn options(time_step: f64, steps: usize) -> MarchOptions {
    let newton = NewtonOptions {
        force_tolerance: 1e-6,
        residual_tolerance: 1e-12,
        ..NewtonOptions::default()
    };
    MarchOptions {
        time_step,
        automatic: None,
        steps,
        integrator: Integrator::default(),
        newton,
        cycle: None,
        steady_rule: SteadyRule::default(),
        stop_when_steady: false,
        initial: vec![BodyStart::default()],
        laws_at_rest: false,
    }
}
