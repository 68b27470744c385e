//! Loads, drives and weights of machines as they run.

mod closer;
mod couple;
mod jumps;
mod orders;
mod prescribed;
mod release;
mod weight;

use whirl_benches::hand::elements::ELEMENTS;
use whirl_solver::dynamics::{March, MarchOptions};
use whirl_solver::equations::State;
use whirl_solver::linalg::Matrix;
use whirl_solver::machine::Machine;
use whirl_solver::mesh::shaft::{SectionCells, SolidShaft};
use whirl_solver::mesh::{Material, Mesh, NodeSetMean};

use super::DISCS;

/// No section of the discs turns against its frame: couples act on θ alone.
fn rigid_turn() -> Matrix {
    Matrix::zeros(3, 2 * DISCS)
}

/// The state at the end of a march.
fn end(machine: &Machine, options: &MarchOptions) -> State {
    let mut march = March::new(machine, options).expect("starts");
    while !march.is_done() {
        march.advance().expect("the step converges");
    }
    march.state().clone()
}

/// Length and diameter of a uniform shaft (m), E (Pa), ν and ρ (kg/m³).
const SHAFT: [f64; 5] = [1.0, 0.06, 200e9, 0.3, 7860.0];

fn uniform_shaft() -> Mesh {
    let [length, diameter, modulus, poisson, density] = SHAFT;
    let shaft = SolidShaft {
        length,
        diameter,
        supports: vec![0.49, 0.71],
        support_length: 0.02,
        layers_in_support: 2,
        layers_between: 20,
        loads: Vec::new(),
        sections: Vec::new(),
        section: SectionCells { sectors: 16, rings: 3, order: 1 },
        material: Material::isotropic("STEEL", modulus, poisson, density).expect("steel"),
    };
    shaft.mesh(&ELEMENTS).expect("a mesh")
}

/// The mean motion of the section of a mesh at z (m).
fn section(mesh: &Mesh, z: f64) -> NodeSetMean {
    let near = |node: &usize| (mesh.nodes()[*node][2] - z).abs() < 1e-9;
    let nodes: Vec<usize> = (0..mesh.nodes().len()).filter(near).collect();
    assert!(nodes.len() > 10, "{z}");
    NodeSetMean::new(mesh, &nodes).expect("a section")
}
