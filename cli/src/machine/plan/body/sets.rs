//! Node sets that a case names, looked up in the mesh of a body; how many coordinates they may keep.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::error::Error;

use super::BodyPlan;

/// Most coordinates of a reduced body, whose matrices are dense.
const MOST_KEPT: usize = 5_000;

impl BodyPlan {
    /// Notes more coordinates than there is memory for dense matrices of.
    pub(in crate::machine) fn bound(&mut self, errors: &mut Diagnostics) {
        self.settle_matrices(errors);
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

    /// Nodes of a set, one at least; what is wrong with it is noted, and none are given.
    pub(in crate::machine) fn nodes(&self, set: &Located, errors: &mut Diagnostics) -> Vec<usize> {
        let nodes = self.members(set, errors);
        if nodes.is_empty() && self.mesh.node_set(set.text()).is_ok() {
            let message =
                format!("the node set `{}` of {} has no nodes", set.text(), self.mesh.origin());
            let full = self.mesh.node_sets().iter().filter(|(_, nodes)| !nodes.is_empty());
            let full: Vec<&str> = full.map(|(name, _)| name.as_str()).collect();
            let help = format!("name a set that has some{}", listed(&full));
            errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
        }
        nodes
    }

    /// Nodes of a set, if there is one of this name.
    fn members(&self, set: &Located, errors: &mut Diagnostics) -> Vec<usize> {
        // A set that the case does not say is missing, which has been noted.
        if set.text().is_empty() && !errors.is_empty() {
            return Vec::new();
        }
        match self.mesh.node_set(set.text()) {
            Ok(nodes) => {
                self.has_all(set, errors);
                nodes.to_vec()
            }
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
    pub(in crate::machine) fn node(
        &self,
        set: &Located,
        errors: &mut Diagnostics,
    ) -> Option<usize> {
        let nodes = self.members(set, errors);
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
}

/// Names in a list after a colon, not too many of them; nothing if there are none.
pub(super) fn listed(names: &[&str]) -> String {
    const MOST: usize = 16;
    let shown: Vec<String> = names.iter().take(MOST).map(|name| format!("`{name}`")).collect();
    let more = if names.len() > MOST { ", …" } else { "" };
    if names.is_empty() { String::new() } else { format!(": {}{more}", shown.join(", ")) }
}
