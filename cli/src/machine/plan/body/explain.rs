//! What is wrong with a body, said with the words of its case and the labels of its mesh.

use whirl_codegen::diagnostic::{Code, Diagnostics};
use whirl_solver::body::BodySpec;
use whirl_solver::error::{Error, FreeMotion, ReductionError};
use whirl_solver::linalg::{LinearAlgebraError, readable_bytes, readable_estimate};
use whirl_solver::mesh::{Cell, Material};

use super::BodyPlan;
use super::sets::listed;
use crate::errors::Failure;
use crate::machine::meshes;

impl BodyPlan {
    /// An error of the reduction, at its place in the case or in the mesh's file.
    pub(crate) fn explain(&self, error: Error) -> Failure {
        match error {
            Error::InvertedCells { .. } => meshes::inverted(&error),
            Error::Reduction(ReductionError::Mechanism { motions }) => self.free(&motions).into(),
            Error::Reduction(ReductionError::Hidden { .. }) => {
                let message = format!("{}: {error}", self.mesh.origin());
                let help =
                    "look for a material, a cell or a spring that is far stiffer than the rest";
                Diagnostics::from(self.made_from.error_here(Code::BAD_VALUE, message).help(help))
                    .into()
            }
            Error::Reduction(ReductionError::LinearAlgebra(LinearAlgebraError::TooLarge {
                bytes,
                limit,
                ..
            })) => self.too_large(bytes, limit).into(),
            Error::StiffSpring { place, stiffness, body, most, .. } => {
                let message = format!(
                    "this spring of {stiffness:e} N/m is {:.0e} times as stiff as the stiffest node of {} \
                     ({body:.1e} N/m)",
                    stiffness / body,
                    self.mesh.origin()
                );
                let materials = self.mesh.materials().iter();
                let softest = materials.min_by(|a, b| modulus(a).total_cmp(&modulus(b)));
                let made = softest.map_or(String::new(), |softest| {
                    format!(", or check E = {:e} Pa of `{}`", modulus(softest), softest.name)
                });
                let help = format!(
                    "write a stiffness of {most:.0e} N/m at most, name the set in `{}` if it is to be held{made}",
                    self.words.held
                );
                let at = self.sprung.get(place).unwrap_or(&self.held_by);
                Diagnostics::from(at.error_here(Code::BAD_VALUE, message).help(help)).into()
            }
            Error::Reduction(
                ReductionError::TooManyModes { .. }
                | ReductionError::NotConverged { .. }
                | ReductionError::Miscounted { .. },
            ) => {
                let message = format!("{}: {error}", self.mesh.origin());
                let help = "write a smaller number of `modes` for this body";
                Diagnostics::from(self.made_from.error_here(Code::BAD_VALUE, message).help(help))
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

    /// A reduction that would take more memory than it may.
    fn too_large(&self, bytes: usize, limit: usize) -> Diagnostics {
        let BodySpec { modes, retained, .. } = &self.spec;
        let (origin, dofs) = (self.mesh.origin(), self.mesh.dof_count());
        let what = format!(
            "{origin}: the reduction of {dofs} degrees of freedom to {modes} modes and {} retained ones takes",
            retained.len()
        );
        let message = match bytes {
            // It was not got so far as to say how much.
            usize::MAX => format!("{what} more memory than the system gives"),
            _ => format!(
                "{what} about {} of memory, more than the {} that it may take",
                readable_estimate(bytes),
                readable_bytes(limit)
            ),
        };
        let help = "make the mesh coarser, lower `modes`, or write a larger `memory_limit` in `[reduction]`; without one \
                    it is what the machine has left";
        self.made_from.error_here(Code::BAD_VALUE, message).help(help).into()
    }

    /// What can move freely: the whole body, or loose parts of it.
    fn free(&self, motions: &[FreeMotion]) -> Diagnostics {
        let mut errors = Diagnostics::new();
        let origin = self.mesh.origin();
        let mut whole = Vec::new();
        for motion in motions {
            match motion {
                FreeMotion::Part { node } => {
                    let message =
                        format!("a part of {origin} is loose: {}", self.part_around(*node));
                    let help = "let it share nodes with the rest, hold it, or take its cells out";
                    errors.push(self.made_from.error_here(Code::BAD_VALUE, message).help(help));
                }
                motion => whole.push(motion.to_string()),
            }
        }
        if !whole.is_empty() {
            let message = format!("{origin} can still move freely: {}", whole.join("; "));
            let help =
                format!("against each of these motions hold more nodes{}", self.words.springs);
            errors.push(self.held_by.error_here(Code::BAD_VALUE, message).help(help));
        }
        errors
    }

    /// The part of the mesh with the node of this label: its cells, and the sets that lie in it.
    fn part_around(&self, label: u64) -> String {
        let mesh = &self.mesh;
        let part_of = mesh.parts();
        let Some(node) = mesh.labels().iter().position(|&own| own == label) else {
            return format!("that around node {label}");
        };
        let inside = |node: usize, part: usize| part_of[node] == part;
        let part = part_of[node];
        let blocks = mesh.blocks().iter();
        let cells = blocks.flat_map(|block| block.cells().zip(&block.labels));
        let mut labels: Vec<u64> =
            cells.filter(|(nodes, _)| inside(nodes[0], part)).map(|(_, &label)| label).collect();
        labels.sort_unstable();
        if mesh.matrices().is_some() {
            return format!("what is around node {label} can move without strain");
        }
        if labels.len() == mesh.cell_count() {
            return format!("the cells around node {label} can move without strain");
        }
        let of_cell = |cell: &Cell| mesh.blocks()[cell.block].cells().nth(cell.cell).map(|n| n[0]);
        let node_sets = mesh
            .node_sets()
            .iter()
            .filter(|(_, nodes)| !nodes.is_empty() && nodes.iter().all(|&node| inside(node, part)));
        let element_sets = mesh.element_sets().iter().filter(|(_, cells)| {
            !cells.is_empty()
                && cells.iter().all(|cell| of_cell(cell).is_some_and(|node| inside(node, part)))
        });
        let sets: Vec<&str> = element_sets
            .map(|(name, _)| name.as_str())
            .chain(node_sets.map(|(name, _)| name.as_str()))
            .collect();
        let shown: Vec<String> = labels.iter().take(4).map(ToString::to_string).collect();
        let (first, more) = (shown.join(", "), if labels.len() > shown.len() { ", …" } else { "" });
        let named =
            if sets.is_empty() { String::new() } else { format!("; sets{}", listed(&sets)) };
        let noun = if labels.len() == 1 { "cell shares" } else { "cells share" };
        format!(
            "{} {noun} no node with the rest ({first}{more}{named}), and nothing holds {}",
            labels.len(),
            if labels.len() == 1 { "it" } else { "them" }
        )
    }
}

/// Young's modulus (Pa).
fn modulus(material: &Material) -> f64 {
    material.properties.get("E").copied().unwrap_or(f64::INFINITY)
}
