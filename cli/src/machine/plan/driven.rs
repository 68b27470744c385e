//! Where loads and drives act on a mesh.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::mesh::MeanComponent;

use super::{AXES, BodyPlan};
use crate::case::{self, Acting, Spread};
use crate::machine::forces::Place;

impl BodyPlan {
    /// Where a load acts: on each node of its sets, or on their mean motion.
    pub(in crate::machine) fn loaded(
        &mut self,
        load: &case::Load,
        errors: &mut Diagnostics,
    ) -> Place {
        let nodes: Vec<usize> = load.sets.iter().flat_map(|set| self.nodes(set, errors)).collect();
        let couple = match load.acting {
            Acting::Force(_) if load.spread == Spread::Each => {
                return Place::Nodes(
                    nodes.into_iter().map(|node| self.output_node(node)).collect(),
                );
            }
            Acting::Force(_) => [0.0; 3],
            Acting::Couple(couple) => couple,
        };
        if nodes.is_empty() {
            return Place::Mean(0);
        }
        let mean = self.mean(&nodes);
        for (axis, letter) in AXES.iter().enumerate() {
            if couple[axis] != 0.0 && !self.spec.means[mean].turns_about(axis) {
                let sets: Vec<&str> = load.sets.iter().map(Located::text).collect();
                let message = format!(
                    "the nodes of `{}` show no turn about {letter}, on which a couple could act",
                    sets.join("`, `")
                );
                let help = "name sets of nodes that do not stand on one line, such as a section";
                errors.push(load.place.error_here(Code::BAD_VALUE, message).help(help));
            }
        }
        Place::Mean(mean)
    }

    /// The section of a drive, or of a body, turns with the frame, which ties the flexible shaft to it; where the couple
    /// acts.
    pub(in crate::machine) fn tie(
        &mut self,
        drive: &case::Drive,
        errors: &mut Diagnostics,
    ) -> Place {
        match &drive.section {
            Some(set) => Place::Mean(self.tie_section(set, errors)),
            None => Place::Nodes(self.tie_ends(drive, errors).into()),
        }
    }

    /// The mean rotation of a set about z is that of the frame; its place among the means.
    fn tie_section(&mut self, set: &Located, errors: &mut Diagnostics) -> usize {
        let nodes = self.nodes(set, errors);
        if nodes.is_empty() {
            return 0;
        }
        let mean = self.mean(&nodes);
        if !self.spec.means[mean].turns_about(2) {
            let message = format!("the nodes of `{}` show no turn about z", set.text());
            let help = "name a set of nodes around the axis, such as those of a section";
            errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
            return mean;
        }
        let turn = self.retain_mean(set, mean, MeanComponent::Rotation(2));
        self.spec.constraints.fix(format!("torsion (mean turn of {})", set.text()), turn);
        mean
    }

    /// The ends of the driven section move alike along y; their places among the output nodes.
    fn tie_ends(&mut self, drive: &case::Drive, errors: &mut Diagnostics) -> [usize; 2] {
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
        [top, bottom].map(|node| self.output_node(node))
    }
}
