//! A machine with stations along its bodies, at which shapes are looked at.

use whirl_solver::body::BodyNode;
use whirl_solver::cache::Cache;
use whirl_solver::loads::Frame;
use whirl_solver::output::{Motion, Wanted};

use crate::case::{Case, Form, NamedBody, Output, OutputPoint};
use crate::errors::Failure;
use crate::machine::{self, JoinedPlan, PlannedBody, Watched};

/// Nodes of matrices at most so many planes stand in.
const PLANES: usize = 200;
/// Levels nearer than this are one (m).
const SAME: f64 = 1e-9;

/// Stations of a body.
pub(super) struct Along {
    /// The body, by its place.
    pub(super) body: usize,
    /// x and y of its axis (m).
    pub(super) axis: [f64; 2],
    /// By rising z.
    pub(super) stations: Vec<BodyNode>,
}

/// Stations along all bodies of a case, `count` on one with a mesh. They are of a machine of its own, which has the same coordinates:
/// points that are watched do not change how bodies are reduced.
///
/// # Errors
/// As the machine's.
pub(super) fn stations_along(
    case: &Case,
    count: usize,
    cache: Option<&Cache>,
) -> Result<Vec<Along>, Failure> {
    let own = Case { fields: None, ..case.clone() };
    let mut plan = machine::plan(&own, &mut Vec::new())?;
    let mut along: Vec<(usize, Watched)> = Vec::new();
    for (place, body) in own.machine.bodies.iter().enumerate() {
        let mut all = levels(body, &plan.bodies[place], &joints_of(&own, &plan, place), count);
        if let (true, Form::Rigid(rigid)) = (all.is_empty(), &body.form) {
            all.push(rigid.centre[2]);
        }
        all.sort_by(f64::total_cmp);
        all.dedup_by(|a, b| (*a - *b).abs() < SAME);
        along.push((place, Watched::Levels(all)));
    }
    plan.watch(along.iter().map(|(body, levels)| (*body, levels)));
    // What is to be said of the case has been said.
    let built = machine::build(&own, &plan, cache, &mut Vec::new())?;
    let along = built.machine.fields.into_iter().map(|field| Along {
        body: field.body,
        axis: own.machine.bodies[field.body].axis,
        stations: field.nodes,
    });
    Ok(along.collect())
}

/// z at which joints hold a body (m).
fn joints_of(case: &Case, plan: &JoinedPlan, body: usize) -> Vec<f64> {
    let joints = case.machine.joints.iter().enumerate();
    let on = joints.filter(|(_, own)| own.sides.iter().any(|side| side.body == Some(body)));
    on.map(|(place, _)| middle(plan, place)).collect()
}

/// z of the middle of a joint (m).
pub(super) fn middle(plan: &JoinedPlan, joint: usize) -> f64 {
    let z = plan.stations(joint);
    z.iter().sum::<f64>() / z.len().max(1) as f64
}

/// The motion of a section as an output of the case, under a name that no user writes.
pub(super) fn station(case: &Case, body: usize, z: f64, number: usize) -> Output {
    let own = &case.machine.bodies[body];
    let point = match own.form {
        Form::Meshed(_) => OutputPoint::Section(z, own.name.clone()),
        _ => OutputPoint::At(Some(z)),
    };
    let (motion, frame, components) = (Motion::Displacement, Frame::Space, vec![0, 1]);
    let what = Wanted::Motion { body, point, motion, frame, components };
    Output { name: format!("station {number}"), what }
}

/// Where shapes of modes are looked at (m), `count` on a mesh; `joints`: z of those on the body.
pub(super) fn levels(
    body: &NamedBody,
    planned: &PlannedBody,
    joints: &[f64],
    count: usize,
) -> Vec<f64> {
    let carried = body.attached.iter().map(|own| own.z);
    let Some(plan) = planned.meshed() else {
        return joints.iter().copied().chain(carried).collect();
    };
    let mut all: Vec<f64> =
        plan.mesh.nodes()[..plan.mesh.placed()].iter().map(|own| own[2]).collect();
    all.sort_by(f64::total_cmp);
    let (first, last) = (all[0], all[all.len() - 1]);
    all.dedup_by(|a, b| (*a - *b).abs() <= 1e-6 * (last - first));
    if plan.mesh.matrices().is_some() && all.len() <= PLANES {
        return all;
    }
    let even = |k: usize| first + (last - first) * k as f64 / (count - 1) as f64;
    // Ends of a mesh are planes of nodes, and sections between them are those of its cells.
    match plan.mesh.matrices() {
        Some(_) => all.iter().step_by(all.len().div_ceil(PLANES)).copied().collect(),
        None => (0..count).map(even).collect(),
    }
}
