//! Bodies of matrices that other programs wrote, against the meshes that they are of.

mod calculix;
mod errors;
mod formats;
mod mutants;
mod op4;
mod programs;
mod superelement;
mod turning;
mod wrong_programs;

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::Constraints;
use whirl_solver::error::InputErrors;
use whirl_solver::mesh::format::MeshUnits;
use whirl_solver::mesh::matrices::{Files, ReadMatrices, Request, read};
use whirl_solver::mesh::shaft::{SectionCells, SolidShaft};
use whirl_solver::mesh::{Material, Mesh};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::ELEMENTS;

/// A short steel shaft.
fn bar() -> Mesh {
    let shaft = SolidShaft {
        length: 0.2,
        diameter: 0.03,
        supports: vec![0.05, 0.15],
        support_length: 0.02,
        layers_in_support: 2,
        layers_between: 2,
        loads: Vec::new(),
        sections: Vec::new(),
        section: SectionCells { sectors: 8, rings: 2, order: 1 },
        material: Material::isotropic("STEEL", 200e9, 0.3, 7860.0).expect("steel"),
    };
    let elements: Vec<_> = ELEMENTS.iter().collect();
    shaft.mesh(&elements).expect("a mesh")
}

/// Texts by the names of their files.
#[derive(Debug, Clone, Default)]
struct Texts(BTreeMap<PathBuf, String>);

impl Texts {
    fn with(mut self, name: &str, text: impl Into<String>) -> Texts {
        self.0.insert(PathBuf::from(name), text.into());
        self
    }

    fn read(&self, request: &Request) -> Result<ReadMatrices, InputErrors> {
        let load = |path: &Path| {
            let found = self.0.get(path).ok_or(io::ErrorKind::NotFound)?;
            Ok(found.clone().into_bytes())
        };
        read(request, &load)
    }

    /// The mesh of files that are right.
    fn mesh(&self, request: &Request) -> Mesh {
        match self.read(request) {
            Ok(read) => read.mesh,
            Err(errors) => panic!("{errors}"),
        }
    }
}

fn request(files: Files) -> Request {
    Request {
        files,
        spin_inertia: None,
        spin_coupling: None,
        spin_load: None,
        stiffening: None,
        folder: PathBuf::new(),
        units: MeshUnits::default(),
    }
}

fn market() -> Request {
    request(Files::Market {
        stiffness: "K.mtx".into(),
        mass: "M.mtx".into(),
        dofs: "dofs.csv".into(),
    })
}

fn dmig() -> Request {
    request(Files::Dmig {
        file: "body.pch".into(),
        nodes: "body.bdf".into(),
        stiffness: "KAAX".to_owned(),
        mass: "MAAX".to_owned(),
    })
}

fn calculix() -> Request {
    request(Files::Calculix { job: "job".into(), nodes: "job.inp".into() })
}

/// How a body is reduced that stands: these nodes retained in x, y, z.
fn spec(mesh: &Mesh, retained: &[usize], modes: usize) -> BodySpec {
    let dofs = retained.iter().flat_map(|node| [3 * node, 3 * node + 1, 3 * node + 2]);
    BodySpec {
        corrections: Vec::new(),
        sections: Vec::new(),
        retained: dofs.map(|dof| Retained::dof(dof, format!("dof {dof}"))).collect(),
        held: mesh.matrices().map(|own| own.absent().collect()).unwrap_or_default(),
        modes,
        constraints: Constraints::new(),
        springs: Vec::new(),
        damping: Rayleigh { alpha: 0.0, beta: 1e-5 },
        nodes: retained.to_vec(),
        stiffening: false,
        means: Vec::new(),
        memory: 1 << 30,
    }
}

/// How a body is reduced that stands on three feet.
fn on_feet(mesh: &Mesh, modes: usize) -> BodySpec {
    let mut spec = spec(mesh, &[], modes);
    spec.held
        .extend(feet(mesh).into_iter().flat_map(|node| [3 * node, 3 * node + 1, 3 * node + 2]));
    spec.nodes = vec![mesh.placed() - 1];
    spec
}

/// The nodes of three feet, which hold a body in all directions.
fn feet(mesh: &Mesh) -> Vec<usize> {
    let far = |axis: usize, node: &[f64; 3]| node[2].abs() < 1e-9 && node[axis].abs() > 5e-3;
    let nodes = mesh.nodes()[..mesh.placed()].iter().enumerate();
    let end = nodes.filter(|(_, node)| far(0, node) || far(1, node));
    end.map(|(place, _)| place).take(3).collect()
}

fn close(one: f64, other: f64, part: f64) -> bool {
    (one - other).abs() <= part * one.abs().max(other.abs())
}

/// Two bodies that stand are alike to this part of their largest values.
fn supports_agree(one: &Support, other: &Support, part: f64) {
    assert_eq!(one.stiffness.len(), other.stiffness.len());
    let largest = one.stiffness.iter().fold(0.0, |most: f64, k| most.max(*k));
    for (a, b) in one.stiffness.iter().zip(&other.stiffness) {
        // Rigid motions have values near zero.
        assert!((a - b).abs() <= part * a.max(1e-6 * largest), "{a} {b}");
    }
    let [mine, theirs] = [one, other].map(|own| &own.centre_of_mass);
    assert!(close(mine.mass, theirs.mass, part), "{} {}", mine.mass, theirs.mass);
    for k in 0..3 {
        let (a, b) = (mine.node.position[k], theirs.node.position[k]);
        assert!((a - b).abs() <= part, "{a} {b}");
    }
}

/// Two bodies that turn have the same tensors to this part of the largest value of each.
fn shafts_agree(one: &Shaft, other: &Shaft, part: f64) {
    for name in ["J0", "y0", "g0", "M", "Y", "W", "H"] {
        let [mine, theirs] = [one, other].map(|own| own.tensor(name).expect(name));
        assert_eq!(mine.len(), theirs.len(), "{name}");
        let largest = mine.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (a, b) in mine.iter().zip(theirs) {
            assert!((a - b).abs() <= part * largest, "{name}: {a} {b} of {largest}");
        }
    }
    for (a, b) in one.stiffness.data.iter().zip(&other.stiffness.data) {
        let largest = one.stiffness.data.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        assert!((a - b).abs() <= part * largest, "K: {a} {b}");
    }
}
