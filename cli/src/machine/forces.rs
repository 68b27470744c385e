//! Loads and drives of a case.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use whirl_codegen::diagnostic::Located;
use whirl_codegen::units::Dimension;
use whirl_solver::bodies::Body;
use whirl_solver::curve::Curve;
use whirl_solver::loads::{Frame, Onset, Target, TimeFunction};
use whirl_solver::model::{Attachment, AttachmentKind, LoadAction, LoadModel, Place};

use crate::case::{Columns, Gravity, GroundMotion, JoinedDrive, JoinedLoad, JoinedMachine};

/// A load of a case.
pub(super) fn load(own: &JoinedLoad, place: &Place) -> LoadModel {
    let JoinedLoad { name, body, load: own, .. } = own;
    let (name, body, place) = (format!("load.{}", name.text()), *body, place.clone());
    let (action, time_function) = (own.acting, own.time_function.clone());
    LoadModel { name, body, place, action, time_function, onset: own.onset, frame: own.frame }
}

/// The force of an unbalance on a body that turns in its frame at a speed (rad/s): a sine each along x and y.
pub(super) fn of_unbalance((body, speed): (usize, f64)) -> impl Fn(&Attachment) -> Vec<LoadModel> {
    move |own| {
        let AttachmentKind::Unbalance([x, y]) = own.kind else { return Vec::new() };
        let (force, angle) = (x.hypot(y) * speed * speed, y.atan2(x));
        let along = |axis: &str, parts: [f64; 3], phase: f64| LoadModel {
            name: format!("unbalance.{axis}"),
            body,
            place: own.at.clone(),
            action: LoadAction::Force(parts),
            time_function: TimeFunction::Sine { frequency: speed / TAU, phase },
            onset: Onset::Start,
            frame: Frame::Space,
        };
        vec![along("x", [force, 0.0, 0.0], angle + 0.5 * PI), along("y", [0.0, force, 0.0], angle)]
    }
}

/// Tables are checked where they are read.
const CHECKED: &str = "rows that rise and close";

/// The couple of a drive, if it acts.
pub(super) fn drive(own: &JoinedDrive, place: &Place) -> Option<LoadModel> {
    let JoinedDrive { name, body, couple: own, .. } = own;
    let (name, body) = (format!("drive.{}", name.text()), *body);
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
    let place = place.clone();
    own.acts.then_some(LoadModel { name, body, place, action, time_function, onset, frame })
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

/// Accelerations of the ground (m/s² over s) along x, y and z.
pub(super) fn ground(own: Option<&GroundMotion>) -> [Option<Arc<Curve>>; 3] {
    own.map_or([None, None, None], |own| own.axes.clone())
}

/// What is to be said of bodies that do not move along gravity, nor with the ground.
pub(super) fn unmoved(machine: &JoinedMachine, bodies: &[Body]) -> Vec<String> {
    let gravity = machine.gravity.as_ref().filter(|own| own.acceleration[2] != 0.0);
    let ground = machine.ground.as_ref().filter(|own| own.largest[2] != 0.0);
    let gravity = gravity.map(|own| ("`gravity`", &own.place));
    let ground = ground.map(|own| ("`[ground_motion]`", &own.name));
    let all = gravity.into_iter().chain(ground);
    all.filter_map(|(what, place)| without_effect(what, place, bodies)).collect()
}

/// That the part along z of what acts on all bodies has no effect on some.
fn without_effect(what: &str, place: &Located, bodies: &[Body]) -> Option<String> {
    let heavy = bodies.iter().filter(|body| body.centre_of_mass().mass > 0.0);
    let moves = |body: &Body| {
        let shapes = &body.centre_of_mass().node.shapes;
        (0..shapes.cols).any(|j| shapes[(2, j)] != 0.0)
    };
    let still: Vec<String> =
        heavy.filter(|body| !moves(body)).map(|body| format!("`{}`", body.name())).collect();
    (!still.is_empty()).then(|| {
        format!(
            "{}: the part of {what} along z has no effect on {}, which {} not move along z: with `moves_along_z = true` \
             a rigid body does",
            place.source().path.display(),
            still.join(", "),
            if still.len() == 1 { "does" } else { "do" }
        )
    })
}
