//! What a body of matrices has less of than a mesh: dofs of its nodes, and modes.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};

use whirl_solver::mesh::matrices::TurnAboutZ;
use whirl_solver::model::LoadAction;

use super::body::BodyPlan;
use crate::case;
use crate::machine::wording::AXES;

/// Dofs beside those that are retained of which all modes are kept where the case does not say how many.
const ALL_MODES: usize = 200;

impl BodyPlan {
    /// Notes dofs that are retained, which a body of matrices does not have; and takes as many modes as there are.
    pub(super) fn settle_matrices(&mut self, errors: &mut Diagnostics) {
        let Some(matrices) = self.mesh.matrices() else { return };
        let (origin, labels) = (self.mesh.origin(), self.mesh.labels());
        for (retained, set) in self.spec.retained.iter().zip(&self.retained_for) {
            let absent = retained.terms.iter().find(|(dof, _)| !matrices.has(*dof));
            if let Some(&(dof, _)) = absent {
                let message = format!(
                    "`{}` needs the displacement along {} of node {}, and {origin} has no such dof",
                    set.text(),
                    AXES[dof % 3],
                    labels[dof / 3]
                );
                errors.push(set.error_here(Code::BAD_VALUE, message).help(KEEP));
            }
        }
        let spec = &self.spec;
        let singles: Vec<usize> = spec.retained.iter().filter_map(|own| own.single()).collect();
        let means = spec.retained.len() - singles.len();
        let taken: Vec<usize> = singles.iter().chain(&spec.held).copied().collect();
        let free = matrices.inner(&taken);
        if self.all_modes && free.len() > ALL_MODES {
            let message =
                format!("{origin} has {} dofs beside those that are retained or held", free.len());
            let help =
                "say how many modes are kept: add `modes = 20` to the body; more change little";
            errors.push(self.made_from.error_here(Code::MISSING_KEY, message).help(help));
            return;
        }
        let most = matrices.modes(&free).saturating_sub(means);
        self.spec.modes = if self.all_modes { most } else { spec.modes.min(most) };
    }

    /// Whether nothing of a body of matrices could turn about its axis, so that nothing ties it to its frame.
    pub(in crate::machine) fn cannot_turn(&mut self) -> bool {
        let found = self.mesh.matrices().map(|own| own.turn_about_z(&self.mesh));
        let nothing = found == Some(TurnAboutZ::Nothing);
        self.mean_frame &= !nothing;
        nothing
    }

    /// Notes a set of which a body of matrices has only some nodes.
    pub(super) fn has_all(&self, set: &Located, errors: &mut Diagnostics) {
        let Some(matrices) = self.mesh.matrices() else { return };
        let Some((count, label)) = matrices.lacking(set.text()) else { return };
        let message = format!(
            "{count} of the nodes of `{}` have no dofs in {}, such as node {label}",
            set.text(),
            self.mesh.origin()
        );
        let help = "keep their displacements when the matrices are made; or name a set of nodes that have dofs, such as \
                    `NODE_7` for node 7 alone";
        errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
    }

    /// Notes a force along a dof that a body of matrices does not have.
    pub(super) fn carries(&self, load: &case::Load, nodes: &[usize], errors: &mut Diagnostics) {
        let (Some(matrices), LoadAction::Force(force)) = (self.mesh.matrices(), load.acting) else {
            return;
        };
        for axis in (0..3).filter(|&axis| force[axis] != 0.0) {
            if let Some(node) = nodes.iter().find(|&&node| !matrices.has(3 * node + axis)) {
                let message = format!(
                    "the force along {} acts on node {}, which has no such dof in {}",
                    AXES[axis],
                    self.mesh.labels()[*node],
                    self.mesh.origin()
                );
                errors.push(load.place.error_here(Code::BAD_VALUE, message).help(KEEP));
            }
        }
    }
}

const KEEP: &str = "keep this dof when the matrices are made, or name a node that has it";
