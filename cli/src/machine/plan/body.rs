//! A body to be reduced: its mesh, with the dofs to retain, hold and watch.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::assembly::assemble;
use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::{Constraints, add_ground_springs, free_motions};
use whirl_solver::error::Error;
use whirl_solver::mesh::Mesh;
use whirl_solver::reduction::ReductionError;

use super::AXES;
use crate::case;
use crate::errors::Failure;
use crate::machine::{Counts, meshes};

/// Bytes that the factor of a stiffness matrix may take.
const FACTOR_MEMORY: usize = 8 << 30;
/// Most coordinates of a reduced body, whose matrices are dense.
const MOST_KEPT: usize = 5_000;

/// A body before its reduction.
pub(crate) struct BodyPlan {
    /// Mesh with materials.
    pub(crate) mesh: Mesh,
    /// How it is reduced; its nodes are those watched.
    pub(crate) spec: BodySpec,
    /// What holds it, as the case says it.
    held_by: Located,
    /// What it is made from, as the case says it.
    made_from: Located,
}

impl BodyPlan {
    pub(super) fn new(
        mesh: Mesh,
        made_from: Located,
        modes: usize,
        damping: f64,
        held_by: &Located,
    ) -> Self {
        let spec = BodySpec {
            retained: Vec::new(),
            modes,
            constraints: Constraints::new(),
            springs: Vec::new(),
            damping: Rayleigh { alpha: 0.0, beta: damping },
            nodes: Vec::new(),
            memory: FACTOR_MEMORY,
        };
        BodyPlan { mesh, spec, held_by: held_by.clone(), made_from }
    }

    /// Sizes of the body, as in the paper's Table 1.
    pub(crate) fn counts(&self) -> Counts {
        let (physical, retained) = (self.mesh.dof_count(), self.spec.retained.len());
        Counts {
            elements: self.mesh.cell_count(),
            nodes: self.mesh.nodes().len(),
            physical_dofs: physical,
            internal_dofs: physical - retained,
            retained_dofs: retained,
            modes: self.spec.modes,
            craig_bampton_dofs: self.spec.modes + retained,
        }
    }

    /// Coordinates left after the equations.
    pub(crate) fn active(&self) -> usize {
        let spec = &self.spec;
        spec.modes + spec.retained.len() - spec.constraints.equations().len()
    }

    /// An error of the reduction, at its place in the case or in the mesh's file.
    pub(in crate::machine) fn explain(&self, error: Error) -> Failure {
        match error {
            Error::InvertedCells { .. } => meshes::inverted(&error),
            Error::Reduction(ReductionError::Mechanism { motions }) => {
                let motions: Vec<String> = motions.iter().map(ToString::to_string).collect();
                let message =
                    format!("{} can still move freely: {}", self.mesh.origin(), motions.join("; "));
                let help = "against each of these motions hold more nodes or, on the support, add a spring \
                            `[[support.ground_spring]]`";
                Diagnostics::from(self.held_by.error_here(Code::BAD_VALUE, message).help(help))
                    .into()
            }
            Error::Reduction(_) | Error::Constraint { .. } => {
                let message = format!("{}: {error}", self.mesh.origin());
                Diagnostics::from(self.held_by.error_here(Code::BAD_VALUE, message)).into()
            }
            _ => {
                let message = error.to_string();
                Diagnostics::from(self.made_from.error_here(Code::BAD_VALUE, message)).into()
            }
        }
    }

    /// Looks for cells turned inside out and for motions that nothing stops.
    pub(super) fn verify(&self) -> Result<(), Error> {
        let elastic = assemble(&self.mesh, "stiffness")?;
        let stiffness = add_ground_springs(&elastic, &self.spec.springs)?;
        let mut held = Constraints::new();
        self.spec.retained.iter().for_each(|retained| held.fix(&retained.name, retained.dof));
        match free_motions(self.mesh.nodes(), &stiffness, &held)? {
            motions if motions.is_empty() => Ok(()),
            motions => Err(ReductionError::Mechanism { motions }.into()),
        }
    }

    /// Retains a dof; its place among the retained ones.
    pub(super) fn retain(&mut self, set: &Located, node: usize, axis: usize) -> usize {
        let dof = 3 * node + axis;
        let retained = &mut self.spec.retained;
        if let Some(place) = retained.iter().position(|known| known.dof == dof) {
            return place;
        }
        retained.push(Retained { dof, name: format!("{} {}", set.text(), AXES[axis]) });
        retained.len() - 1
    }

    /// Watches a node; its place among the watched ones.
    pub(super) fn watch(&mut self, node: usize) -> usize {
        self.spec.nodes.push(node);
        self.spec.nodes.len() - 1
    }

    /// Notes more coordinates than dense matrices of them have room for.
    pub(super) fn bound(&self, errors: &mut Diagnostics) {
        let kept = self.spec.retained.len();
        if kept + self.spec.modes > MOST_KEPT {
            let message = format!(
                "{} keeps {kept} degrees of freedom and {} modes, at most {MOST_KEPT} are allowed",
                self.mesh.origin(),
                self.spec.modes
            );
            let help = "lower `modes`, or hold and connect smaller sets of nodes";
            errors.push(self.held_by.error_here(Code::BAD_VALUE, message).help(help));
        }
    }

    /// Nodes of a set; what is wrong with it is noted, and none are given.
    pub(super) fn nodes(&self, set: &Located, errors: &mut Diagnostics) -> Vec<usize> {
        // A set that the case does not say is missing, which has been told.
        if set.text().is_empty() && !errors.is_empty() {
            return Vec::new();
        }
        match self.mesh.node_set(set.text()) {
            Ok(nodes) => nodes.to_vec(),
            Err(error) => {
                let message = format!("{} has no node set `{}`", self.mesh.origin(), set.text());
                let help = match error {
                    Error::MissingSet { nearest: Some(near), .. } => {
                        format!("did you mean `{near}`?")
                    }
                    _ => {
                        let sets = self.mesh.node_sets().keys();
                        let known: Vec<&str> = sets.map(String::as_str).collect();
                        format!("name one of its sets{}", listed(&known))
                    }
                };
                errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
                Vec::new()
            }
        }
    }

    /// The only node of a set; what is wrong with it is noted.
    pub(super) fn node(&self, set: &Located, errors: &mut Diagnostics) -> Option<usize> {
        let nodes = self.nodes(set, errors);
        let origin = self.mesh.origin();
        if nodes.len() != 1 && self.mesh.node_set(set.text()).is_ok() {
            let message = format!(
                "the node set `{}` of {origin} must have one node, but has {}",
                set.text(),
                nodes.len()
            );
            let single = self.mesh.node_sets().iter().filter(|(_, nodes)| nodes.len() == 1);
            let single: Vec<&str> = single.map(|(name, _)| name.as_str()).collect();
            let help = format!("name a set of one node{}", listed(&single));
            errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
        }
        nodes.first().copied()
    }

    /// The ends of the driven section move alike along y, which ties the flexible shaft to the frame that
    /// turns with it; their places among the watched nodes.
    pub(super) fn tie(&mut self, drive: &case::Drive, errors: &mut Diagnostics) -> [usize; 2] {
        let nodes = [&drive.top, &drive.bottom].map(|set| self.node(set, errors));
        if nodes[0].is_some() && nodes[0] == nodes[1] {
            let message = "the driven nodes `top` and `bottom` are the same node";
            let help = "name the sets of two nodes, at opposite ends of a diameter";
            errors.push(drive.bottom.error_here(Code::BAD_VALUE, message).help(help));
            return [0; 2];
        }
        let [top, bottom] = nodes.map(|node| node.unwrap_or(0));
        let ties = [self.retain(&drive.top, top, 1), self.retain(&drive.bottom, bottom, 1)];
        let name = format!("torsion ({} y = {} y)", drive.top.text(), drive.bottom.text());
        self.spec.constraints.equation(name, [(ties[0], 1.0), (ties[1], -1.0)]);
        [top, bottom].map(|node| self.watch(node))
    }
}

/// Names in a list after a colon, not too many of them; nothing if there are none.
fn listed(names: &[&str]) -> String {
    const MOST: usize = 16;
    let shown: Vec<String> = names.iter().take(MOST).map(|name| format!("`{name}`")).collect();
    let more = if names.len() > MOST { ", …" } else { "" };
    if names.is_empty() { String::new() } else { format!(": {}{more}", shown.join(", ")) }
}
