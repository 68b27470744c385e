//! Loads and drives of a case.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use whirl_codegen::units::Dimension;
use whirl_solver::bodies::Body;
use whirl_solver::curve::Curve;
use whirl_solver::loads::{Frame, Onset, Target, TimeFunction};
use whirl_solver::model::{Attachment, AttachmentKind, LoadAction, LoadModel, Place};

use crate::case::{self, Columns, Gravity};

/// A load of a case.
pub(super) fn load(own: &case::Load, body: usize, place: &Place) -> LoadModel {
    let (place, time_function) = (place.clone(), own.time_function.clone());
    let (action, onset, frame) = (own.acting, own.onset, own.frame);
    LoadModel { body, place, action, time_function, onset, frame }
}

/// The force of an unbalance on a body that turns in its frame at a speed (rad/s): a sine each along x and y.
pub(super) fn of_unbalance((body, speed): (usize, f64)) -> impl Fn(&Attachment) -> Vec<LoadModel> {
    move |own| {
        let AttachmentKind::Unbalance([x, y]) = own.kind else { return Vec::new() };
        let (force, angle) = (x.hypot(y) * speed * speed, y.atan2(x));
        let along = |parts: [f64; 3], phase: f64| LoadModel {
            body,
            place: own.at.clone(),
            action: LoadAction::Force(parts),
            time_function: TimeFunction::Sine { frequency: speed / TAU, phase },
            onset: Onset::Start,
            frame: Frame::Space,
        };
        vec![along([force, 0.0, 0.0], angle + 0.5 * PI), along([0.0, force, 0.0], angle)]
    }
}

/// Tables are checked where they are read.
const CHECKED: &str = "rows that rise and close";

/// The couple of a drive, if it acts.
pub(super) fn drive(own: &case::Drive, body: usize, place: &Place) -> Option<LoadModel> {
    let (torque, time_function) = match &own.table {
        Some(columns) => (1.0, curve(columns)),
        None => {
            let (speed, release) = (own.target_speed, own.release);
            let target = Target { speed, from_above: own.torque < 0.0, release };
            (own.torque, TimeFunction::UntilSpeed(target))
        }
    };
    let (action, onset, frame) =
        (LoadAction::Couple([0.0, 0.0, torque]), Onset::Start, Frame::Body);
    own.acts.then(|| LoadModel { body, place: place.clone(), action, time_function, onset, frame })
}

fn curve(columns: &Columns) -> TimeFunction {
    let curve = Arc::new(Curve::linear(&columns.rows, false).expect(CHECKED));
    match columns.measures[0] == Dimension::TIME {
        true => TimeFunction::OverTime(curve),
        false => TimeFunction::OverSpeed(curve),
    }
}

/// Acceleration by gravity (m/s²).
pub(super) fn acceleration(own: Option<&Gravity>) -> [f64; 3] {
    own.map_or([0.0; 3], |own| own.acceleration)
}

/// What is to be said of bodies that do not move along gravity.
pub(super) fn unmoved(own: Option<&Gravity>, bodies: &[Body]) -> Option<String> {
    let own = own.filter(|own| own.acceleration[2] != 0.0)?;
    let heavy = bodies.iter().filter(|body| body.centre_of_mass().mass > 0.0);
    let moves = |body: &Body| {
        let shapes = &body.centre_of_mass().node.shapes;
        (0..shapes.cols).any(|j| shapes[(2, j)] != 0.0)
    };
    let still: Vec<String> =
        heavy.filter(|body| !moves(body)).map(|body| format!("`{}`", body.name())).collect();
    (!still.is_empty()).then(|| {
        format!(
            "{}: the part of `gravity` along z has no effect on {}, which {} not move along z: with `moves_along_z = true` \
             a rigid body does",
            own.place.source().path.display(),
            still.join(", "),
            if still.len() == 1 { "does" } else { "do" }
        )
    })
}
