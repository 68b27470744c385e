//! Loads before the bodies are reduced on which they act.

use super::place::Place;
use crate::bodies::Body;
use crate::body::BodyNode;
use crate::loads::{Frame, Load, Onset, TimeFunction};

/// A force or a couple on a place of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadModel {
    /// Its name; empty, if it has none.
    pub name: String,
    /// The body, by its place in the model.
    pub body: usize,
    /// Where it acts.
    pub place: Place,
    /// What it does there.
    pub action: LoadAction,
    /// How it varies.
    pub time_function: TimeFunction,
    /// From when on it acts.
    pub onset: Onset,
    /// In which frame its direction is constant.
    pub frame: Frame,
}

/// What a load does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LoadAction {
    /// A force (N) on each of the nodes, or on the point of a mean motion.
    Force([f64; 3]),
    /// A couple (N·m) on a mean motion; the part about z of one on two nodes, as ±F along y, F = M/(x₁ − x₂).
    Couple([f64; 3]),
}

impl LoadModel {
    /// The loads on the reduced body.
    pub(super) fn on(&self, bodies: &[Body]) -> Vec<Load> {
        let body = &bodies[self.body];
        let (nodes, means) = (body.nodes(), body.measures());
        let force = |node: BodyNode, force: [f64; 3]| {
            Load::force(self.body, node, force, self.time_function.clone(), self.frame)
        };
        let loads = match (self.action, &self.place) {
            (LoadAction::Force(parts), Place::Nodes(places)) => {
                places.iter().map(|&place| force(nodes[place].clone(), parts)).collect()
            }
            (LoadAction::Force(parts), &Place::Mean(mean)) => {
                vec![force(means[mean].node_at(means[mean].centre), parts)]
            }
            (LoadAction::Couple(parts), &Place::Mean(mean)) => {
                let (turn, time_function) =
                    (means[mean].rotation.clone(), self.time_function.clone());
                vec![Load::couple(self.body, turn, parts, time_function, self.frame)]
            }
            (LoadAction::Couple([.., couple]), Place::Nodes(places)) => {
                let [top, bottom] = [0, 1].map(|end| &nodes[places[end]]);
                let half = couple / (top.position[0] - bottom.position[0]);
                vec![force(top.clone(), [0.0, half, 0.0]), force(bottom.clone(), [0.0, -half, 0.0])]
            }
        };
        loads.into_iter().map(|load| load.named(&self.name).from(self.onset)).collect()
    }
}
