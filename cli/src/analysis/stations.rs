//! A machine with stations along its bodies, at which shapes are looked at.

use whirl_solver::cache::Cache;
use whirl_solver::linear::{LinearMachine, Point};
use whirl_solver::loads::Frame;
use whirl_solver::output::{Motion, Wanted};

use crate::case::{Case, Form, NamedBody, Output, OutputPoint};
use crate::errors::Failure;
use crate::machine::{self, JoinedPlan, PlannedBody};
use crate::streams;

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
    /// z (m), rising, and the motion there.
    pub(super) stations: Vec<(f64, Point)>,
}

/// Stations along all bodies of a case, `count` on one with a mesh.
///
/// # Errors
/// As the machine's.
pub(super) fn stations_along(
    case: &Case,
    count: usize,
    cache: Option<&Cache>,
) -> Result<Vec<Along>, Failure> {
    let mut own = case.clone();
    own.outputs.clear();
    own.fields = None;
    let plan = streams::warned(|_| machine::plan(&own, &mut Vec::new()))?;
    let mut along: Vec<(usize, Vec<f64>)> = Vec::new();
    for (place, body) in own.machine.bodies.iter().enumerate() {
        let mut all = levels(body, &plan.bodies[place], &joints_of(&own, &plan, place), count);
        if let (true, Form::Rigid(rigid)) = (all.is_empty(), &body.form) {
            all.push(rigid.centre[2]);
        }
        all.sort_by(f64::total_cmp);
        all.dedup_by(|a, b| (*a - *b).abs() < SAME);
        along.push((place, all));
    }
    let mut number = 0;
    for (body, levels) in &along {
        for z in levels {
            own.outputs.push(station(&own, *body, *z, number));
            number += 1;
        }
    }
    let build = || streams::warned(|warnings| machine::build_planned(&own, cache, warnings));
    let linear = LinearMachine::new(build()?.machine)?;
    let mut points = linear.points();
    let mut points = points.split_off(points.len() - number).into_iter();
    let along = along.into_iter().map(|(body, levels)| Along {
        body,
        axis: own.machine.bodies[body].axis,
        stations: levels.into_iter().zip(points.by_ref()).collect(),
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
