//! Where loads and drives act on a mesh.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::mesh::MeanComponent;
use whirl_solver::model::{LoadAction, Place};

use super::BodyPlan;
use crate::case::{self, Spread};
use crate::machine::wording::AXES;

/// The turn of a section against the frame: Σ cᵢ qᵢ over retained motions i.
pub(in crate::machine) struct Turn {
    pub(in crate::machine) name: String,
    pub(in crate::machine) terms: Vec<(usize, f64)>,
}

impl BodyPlan {
    /// Where a load acts: on each node of its sets, or on their mean motion.
    pub(in crate::machine) fn loaded(
        &mut self,
        (load, name): (&case::Load, &str),
        errors: &mut Diagnostics,
    ) -> Place {
        let nodes: Vec<usize> = load.sets.iter().flat_map(|set| self.nodes(set, errors)).collect();
        self.carries(load, &nodes, errors);
        let couple = match load.acting {
            LoadAction::Force(force) if load.spread == Spread::Each => {
                for axis in self.acts_along(force) {
                    let row = nodes.iter().map(|node| (3 * node + axis, 1.0)).collect();
                    self.loads.push((name.to_owned(), row));
                }
                return Place::Nodes(
                    nodes.into_iter().map(|node| self.output_node(node)).collect(),
                );
            }
            LoadAction::Force(_) => [0.0; 3],
            LoadAction::Couple(couple) => couple,
        };
        if nodes.is_empty() {
            return Place::Mean(0);
        }
        let mean = self.mean_of(&load.sets, &nodes);
        for (axis, letter) in AXES.iter().enumerate() {
            if couple[axis] != 0.0 && !self.spec.means[mean].turns_about(axis) {
                let sets: Vec<&str> = load.sets.iter().map(Located::text).collect();
                let message = format!(
                    "the nodes of `{}` define no rotation about {letter}, on which a couple could act",
                    sets.join("`, `")
                );
                let help = "name sets of nodes that are not on one line, such as a section";
                errors.push(load.place.error_here(Code::BAD_VALUE, message).help(help));
            }
        }
        let (parts, component): (_, fn(usize) -> MeanComponent) = match load.acting {
            LoadAction::Force(force) => (force, MeanComponent::Displacement),
            LoadAction::Couple(couple) => (couple, MeanComponent::Rotation),
        };
        let couples = matches!(load.acting, LoadAction::Couple(_));
        for axis in self.acts_along(parts) {
            if couples && !self.spec.means[mean].turns_about(axis) {
                continue;
            }
            let row = self.spec.means[mean].row(component(axis));
            self.loads.push((name.to_owned(), row));
        }
        Place::Mean(mean)
    }

    /// Axes of the body along which a force or a couple acts: along x and y where either turns against the body, and all of one that
    /// is zero, in the place of which another program pushes.
    pub(super) fn acts_along(&self, parts: [f64; 3]) -> Vec<usize> {
        if parts == [0.0; 3] {
            return vec![0, 1, 2];
        }
        let across = self.turning && (parts[0] != 0.0 || parts[1] != 0.0);
        (0..3).filter(|&axis| parts[axis] != 0.0 || across && axis < 2).collect()
    }

    /// The section of a drive, or of a body, turns with the frame, which ties the flexible shaft to it; where the couple
    /// acts.
    pub(in crate::machine) fn tie(
        &mut self,
        section: &[Located],
        errors: &mut Diagnostics,
    ) -> Place {
        let (place, turn) = self.driven(section, errors);
        turn.into_iter().for_each(|turn| self.turns_with_frame(turn));
        place
    }

    /// Where a couple acts, and the turn of that section; none where what is wrong with it is noted.
    pub(in crate::machine) fn driven(
        &mut self,
        section: &[Located],
        errors: &mut Diagnostics,
    ) -> (Place, Option<Turn>) {
        match section {
            [set] => {
                let (mean, turn) = self.turn_of_section(set, errors);
                (Place::Mean(mean), turn)
            }
            [top, bottom] => {
                let (ends, turn) = self.turn_of_ends([top, bottom], errors);
                (Place::Nodes(ends.into()), turn)
            }
            _ => (Place::Mean(0), None),
        }
    }

    /// A section turns with the frame, or, in a frame in which deformations have no angular momentum, its turn follows from
    /// all others.
    pub(in crate::machine) fn turns_with_frame(&mut self, turn: Turn) {
        match (self.mean_frame, turn.terms.first()) {
            (true, Some((first, _))) => self.follows = Some(*first),
            _ => {
                self.spec.constraints.equation(turn.name, turn.terms);
            }
        }
    }

    /// The mean rotation of a set about z, which is retained; its place among the means.
    fn turn_of_section(
        &mut self,
        set: &Located,
        errors: &mut Diagnostics,
    ) -> (usize, Option<Turn>) {
        let nodes = self.nodes(set, errors);
        if nodes.is_empty() {
            return (0, None);
        }
        let mean = self.mean_of(std::slice::from_ref(set), &nodes);
        if !self.spec.means[mean].turns_about(2) {
            let message = format!("the nodes of `{}` define no rotation about z", set.text());
            let help = "name a set of nodes around the axis, such as those of a section";
            errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
            return (mean, None);
        }
        let turn = self.retain_mean(set, mean, MeanComponent::Rotation(2));
        let name = format!("torsion (mean rotation of {})", set.text());
        (mean, Some(Turn { name, terms: vec![(turn, 1.0)] }))
    }

    /// The ends of the driven section, which turns if they do not move alike along y; their places among the output nodes.
    fn turn_of_ends(
        &mut self,
        sets: [&Located; 2],
        errors: &mut Diagnostics,
    ) -> ([usize; 2], Option<Turn>) {
        let nodes = sets.map(|set| self.node(set, errors));
        if nodes[0].is_some() && nodes[0] == nodes[1] {
            let message = "the driven nodes `top` and `bottom` are the same node";
            let help = "name the sets of two nodes, at opposite ends of a diameter";
            errors.push(sets[1].error_here(Code::BAD_VALUE, message).help(help));
            return ([0; 2], None);
        }
        let [top, bottom] = nodes.map(|node| node.unwrap_or(0));
        let ties = [self.retain(sets[0], top, 1), self.retain(sets[1], bottom, 1)];
        let name = format!("torsion ({} y = {} y)", sets[0].text(), sets[1].text());
        let turn = Turn { name, terms: vec![(ties[0], 1.0), (ties[1], -1.0)] };
        ([top, bottom].map(|node| self.output_node(node)), Some(turn))
    }
}
