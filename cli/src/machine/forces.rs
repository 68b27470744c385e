//! Loads and drives of a case on reduced bodies.

use std::sync::Arc;

use whirl_codegen::units::Dimension;
use whirl_solver::bodies::Body;
use whirl_solver::body::BodyNode;
use whirl_solver::curve::Curve;
use whirl_solver::gravity::weights;
use whirl_solver::loads::{Frame, Load, TimeFunction};
use whirl_solver::measure::MeanMotion;

use crate::case::{self, Acting, Columns, Gravity, Variation};

/// Where a load or a drive acts on a body.
#[derive(Debug, Clone)]
pub(super) enum Place {
    /// On output nodes of the body.
    Nodes(Vec<usize>),
    /// On one of its mean motions.
    Mean(usize),
}

/// A reduced body, as loads see it.
#[derive(Clone, Copy)]
pub(super) struct Loaded<'a> {
    /// Its place in the machine.
    pub(super) body: usize,
    /// Its output nodes.
    pub(super) nodes: &'a [BodyNode],
    /// Its mean motions.
    pub(super) means: &'a [MeanMotion],
}

/// The loads that one of a case is.
pub(super) fn loads(own: &case::Load, on: Loaded, place: &Place) -> Vec<Load> {
    let time_function = time_function(own, on.body);
    let force = |node: BodyNode, force: [f64; 3]| {
        Load::force(on.body, node, force, time_function.clone(), own.frame)
    };
    let loads: Vec<Load> = match (own.acting, place) {
        (Acting::Force(parts), Place::Nodes(nodes)) => {
            nodes.iter().map(|&node| force(on.nodes[node].clone(), parts)).collect()
        }
        (Acting::Force(parts), Place::Mean(mean)) => {
            let mean = &on.means[*mean];
            vec![force(mean.node_at(mean.centre), parts)]
        }
        (Acting::Couple(parts), Place::Mean(mean)) => {
            let turn = on.means[*mean].rotation.clone();
            vec![Load::couple(on.body, turn, parts, time_function.clone(), own.frame)]
        }
        (Acting::Couple(_), Place::Nodes(_)) => unreachable!("couples act on mean motions"),
    };
    loads.into_iter().map(|load| load.from(own.onset)).collect()
}

fn time_function(own: &case::Load, body: usize) -> TimeFunction {
    let followed = own.of.unwrap_or(body);
    match &own.variation {
        Variation::Constant => TimeFunction::Constant,
        Variation::Sine(frequency, phase) => {
            TimeFunction::Sine { frequency: *frequency, phase: *phase }
        }
        Variation::Order(order, phase) => {
            TimeFunction::Order { body: followed, order: *order, phase: *phase }
        }
        Variation::Table(columns, periodic) if columns.measures[0] == Dimension::ANGLE => {
            let curve = Curve::smooth(&columns.rows, *periodic).expect(CHECKED);
            TimeFunction::OverAngle { body: followed, curve: Arc::new(curve) }
        }
        Variation::Table(columns, periodic) => {
            let curve = Curve::linear(&columns.rows, *periodic).expect(CHECKED);
            TimeFunction::OverTime(Arc::new(curve))
        }
    }
}

/// Tables are checked where they are read.
const CHECKED: &str = "rows that rise and close";

/// The couple of a drive: ±F along y of the body's frame at two nodes, F = torque / distance along x, or on a mean
/// rotation.
pub(super) fn drive(own: &case::Drive, on: Loaded, place: &Place) -> Vec<Load> {
    if !own.acts {
        return Vec::new();
    }
    let (torque, time_function) = match &own.table {
        Some(columns) => (1.0, curve(columns)),
        None => {
            let (target, release) = (own.target_speed, own.release);
            (own.torque, TimeFunction::UntilSpeed { target, release })
        }
    };
    match place {
        Place::Nodes(nodes) => {
            let [top, bottom] = [0, 1].map(|end| &on.nodes[nodes[end]]);
            let force = torque / (top.position[0] - bottom.position[0]);
            let half = |node: &BodyNode, force| {
                let time_function = time_function.clone();
                Load::force(on.body, node.clone(), [0.0, force, 0.0], time_function, Frame::Body)
            };
            vec![half(top, force), half(bottom, -force)]
        }
        Place::Mean(mean) => {
            let turn = on.means[*mean].rotation.clone();
            let couple = [0.0, 0.0, torque];
            vec![Load::couple(on.body, turn, couple, time_function, Frame::Body)]
        }
    }
}

fn curve(columns: &Columns) -> TimeFunction {
    let curve = Arc::new(Curve::linear(&columns.rows, false).expect(CHECKED));
    match columns.measures[0] == Dimension::TIME {
        true => TimeFunction::OverTime(curve),
        false => TimeFunction::OverSpeed(curve),
    }
}

/// The weights of bodies, and what is to be said of those that do not move along gravity.
pub(super) fn gravity(
    own: Option<&Gravity>,
    bodies: &[Body],
    warnings: &mut Vec<String>,
) -> Vec<Load> {
    let Some(own) = own else { return Vec::new() };
    let heavy = bodies.iter().filter(|body| body.centre_of_mass().mass > 0.0);
    let moves = |body: &Body| {
        let shapes = &body.centre_of_mass().node.shapes;
        (0..shapes.cols).any(|j| shapes[(2, j)] != 0.0)
    };
    let still: Vec<String> =
        heavy.filter(|body| !moves(body)).map(|body| format!("`{}`", body.name())).collect();
    if own.acceleration[2] != 0.0 && !still.is_empty() {
        warnings.push(format!(
            "{}: the part of `gravity` along z has no effect on {}, which {} not move along z",
            own.place.source().path.display(),
            still.join(", "),
            if still.len() == 1 { "does" } else { "do" }
        ));
    }
    weights(bodies, own.acceleration)
}
