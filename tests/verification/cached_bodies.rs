//! A reduced body is found again by all that its bits depend on, and by nothing else.

use std::collections::BTreeMap;

use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::cache::Key;
use whirl_solver::constraints::{Constraints, GroundSpring};
use whirl_solver::mesh::{Material, Mesh, MeshParts, NodeSetMean, Tie};
use whirl_solver::reduced::{BodyKind, Reduced};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use crate::small_shaft;

/// What a key is made of, free to be altered.
#[derive(Clone)]
struct Body {
    kind: BodyKind,
    mesh: MeshParts,
    spec: BodySpec,
}

impl Body {
    fn mesh(&self) -> Mesh {
        Mesh::new(self.mesh.clone()).expect("a mesh")
    }

    fn key(&self) -> Key {
        Reduced::key(self.kind, &self.mesh(), &self.spec)
    }
}

fn body() -> Body {
    let mesh = small_shaft::mesh();
    let node = |set: &str| mesh.single_node(set).expect("a set of the mesh");
    let ends = [node("JOURNAL1_MIDDLE"), node("JOURNAL2_MIDDLE")];
    let retained = ends.iter().flat_map(|end| [3 * end, 3 * end + 1]).chain([3 * ends[0] + 2]);
    let mut constraints = Constraints::new();
    constraints.fix("axial", 4);
    let spec = BodySpec {
        corrections: Vec::new(),
        sections: Vec::new(),
        retained: retained.map(|dof| Retained::dof(dof, format!("dof {dof}"))).collect(),
        held: Vec::new(),
        modes: 4,
        constraints,
        springs: vec![GroundSpring { name: "foot".to_owned(), dof: 30, stiffness: 1e6 }],
        damping: Rayleigh { alpha: 0.0, beta: 1e-5 },
        nodes: ends.to_vec(),
        stiffening: false,
        means: Vec::new(),
        memory: 1 << 30,
    };
    let mesh = MeshParts {
        origin: mesh.origin().to_owned(),
        nodes: mesh.nodes().to_vec(),
        labels: mesh.labels().to_vec(),
        blocks: mesh.blocks().to_vec(),
        materials: vec![
            mesh.materials()[0].clone(),
            Material::isotropic("OTHER", 210e9, 0.3, 7860.0).expect("a material"),
        ],
        node_sets: mesh.node_sets().clone(),
        element_sets: mesh.element_sets().clone(),
        ties: Vec::new(),
        matrices: None,
    };
    Body { kind: BodyKind::Shaft, mesh, spec }
}

fn tie(by: f64) -> Tie {
    Tie { name: "RBE2 1".to_owned(), rows: vec![vec![(60, 1.0), (63, -by)]] }
}

type Change = (&'static str, fn(&mut Body));

#[test]
fn every_ingredient_of_a_body_is_in_its_key() {
    let changes: [Change; 23] = [
        ("a tie", |b| b.mesh.ties.push(tie(2.0))),
        ("a coefficient of a tie", |b| b.mesh.ties.push(tie(2.0_f64.next_up()))),
        ("the kind of body", |b| b.kind = BodyKind::Support),
        ("a node along x, by a rounding", |b| b.mesh.nodes[7][0] = b.mesh.nodes[7][0].next_up()),
        ("a node along z", |b| b.mesh.nodes[7][2] = b.mesh.nodes[7][2].next_up()),
        ("the order of a cell's nodes", |b| b.mesh.blocks[0].connectivity.swap(0, 1)),
        ("the element", |b| {
            let own = b.mesh.blocks[0].element;
            let other = |e: &&whirl_specs::Element| {
                e.nodes == own.nodes && e.origin.hash != own.origin.hash
            };
            b.mesh.blocks[0].element =
                whirl_specs::ELEMENTS.iter().find(other).expect("another of its shape");
        }),
        ("the material of a block", |b| b.mesh.blocks[0].material = 1),
        ("E", |b| *property(b, "E") *= 1.0 + f64::EPSILON),
        ("nu", |b| *property(b, "nu") *= 1.0 + f64::EPSILON),
        ("rho", |b| *property(b, "rho") *= 1.0 + f64::EPSILON),
        ("a retained dof", |b| b.spec.retained[1].terms[0].0 += 30),
        ("the order of the retained dofs", |b| b.spec.retained.swap(0, 1)),
        ("one retained dof less", |b| b.spec.retained.truncate(4)),
        ("a held dof", |b| b.spec.held.push(45)),
        ("an answer to a load", |b| b.spec.corrections.push(vec![(45, 1.0)])),
        ("a mean that is output", |b| {
            // Of nodes that no set has.
            let mesh = b.mesh();
            let nodes = unnamed(&b.mesh);
            b.spec.means.push(NodeSetMean::new(&mesh, &nodes[..2]).expect("a mean"));
        }),
        ("the modes", |b| b.spec.modes += 1),
        ("the stiffening", |b| b.spec.stiffening = true),
        ("the stiffness of a ground spring", |b| b.spec.springs[0].stiffness = 2e6),
        ("where a ground spring stands", |b| b.spec.springs[0].dof += 1),
        ("no ground spring", |b| b.spec.springs.clear()),
        ("the nodes of a set", |b| {
            let nodes = unnamed(&b.mesh);
            b.mesh.node_sets.insert("MORE".to_owned(), nodes[..1].to_vec());
        }),
    ];
    let own = body().key();
    assert_eq!(own, body().key());
    let mut keys = BTreeMap::from([(own.hex(), "nothing")]);
    for (what, change) in changes {
        let mut other = body();
        change(&mut other);
        if let Some(same) = keys.insert(other.key().hex(), what) {
            panic!("{what} and {same} give one key");
        }
    }
}

/// Nodes that are in no set but that of all.
fn unnamed(mesh: &MeshParts) -> Vec<usize> {
    let all = mesh.nodes.len();
    let sets = mesh.node_sets.values().filter(|nodes| nodes.len() < all);
    let known: Vec<usize> = sets.flatten().copied().collect();
    (0..all).filter(|node| !known.contains(node)).collect()
}

fn property<'b>(body: &'b mut Body, name: &str) -> &'b mut f64 {
    body.mesh.materials[0].properties.get_mut(name).expect("a property of steel")
}

/// Damping, names, constraints, and which of the nodes with shapes are output do not touch the reduction: applied to
/// one that is found they give the body that a reduction of its own gives.
#[test]
fn what_is_applied_afterwards_reduces_nothing_again() {
    let own = body();
    for kind in [BodyKind::Shaft, BodyKind::Support] {
        let known = Reduced::new(kind, &own.mesh(), &own.spec).expect("reduces");
        let mut other = Body { kind, ..own.clone() };
        other.mesh.origin = "elsewhere".to_owned();
        other.mesh.labels.iter_mut().for_each(|label| *label += 1000);
        let sets = std::mem::take(&mut other.mesh.node_sets);
        other.mesh.node_sets =
            sets.into_iter().map(|(name, nodes)| (format!("{name}_B"), nodes)).collect();
        other.mesh.materials[0].name = "IRON".to_owned();
        other.spec.damping = Rayleigh { alpha: 3.0, beta: 2e-4 };
        other.spec.retained.iter_mut().for_each(|retained| retained.name.push('!'));
        other.spec.constraints = Constraints::new();
        other.spec.constraints.equation("tie", [(1, 1.0), (3, -1.0)]);
        other.spec.nodes = vec![own.mesh().single_node("JOURNAL1_LEFT").expect("a set")];
        other.spec.memory *= 2;
        assert_eq!(other.key(), Body { kind, ..own.clone() }.key());
        let (mesh, spec) = (other.mesh(), &other.spec);
        match kind {
            BodyKind::Shaft => {
                let fresh = Shaft::from_mesh(&mesh, spec).expect("reduces");
                assert_eq!(known.shaft(spec).expect("a shaft"), fresh);
                assert_ne!(known.shaft(&own.spec).expect("a shaft"), fresh);
            }
            BodyKind::Support => {
                let fresh = Support::from_mesh(&mesh, spec).expect("reduces");
                assert_eq!(known.support(spec).expect("a support"), fresh);
                assert_ne!(known.support(&own.spec).expect("a support"), fresh);
            }
        }
    }
}
