//! The machine of bodies by name.

mod attached;
mod bodies;
mod compare;
mod joints;
mod section;

use std::sync::Arc;
use std::time::Instant;

use whirl_codegen::diagnostic::{Diagnostics, Located};
use whirl_solver::bearing::{Bearing, Sides};
use whirl_solver::cache::Cache;
use whirl_solver::dynamics::BodyStart;
use whirl_solver::loads::Release;
use whirl_solver::machine::{Body, Machine, MachineParts, Rotation};
use whirl_solver::mesh::NodeSetMean;
use whirl_solver::reduced::BodyKind;
use whirl_solver::rigid::RigidInertia;
use whirl_solver::schedule::Schedule;
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use self::attached::{PlannedAttached, attach};
pub(crate) use self::bodies::PlannedBody;
use self::joints::PlannedJoint;
use super::forces::{self, Loaded, Place};
use super::laws::laws_of;
use super::plan::{BodyPlan, geometry};
use super::springs::{Laws, angles, clearance, explain};
use super::{BodyFact, BodyFacts, Built, bodies as reduced_bodies, outputs, rotor};
use crate::case::{self, Form, JoinedMachine, LawSource, Output, Turning};
use crate::errors::Failure;

/// Bodies, joints, drives and loads before the reduction of what has a mesh.
pub(crate) struct JoinedPlan {
    /// In the order of the case.
    pub(crate) bodies: Vec<PlannedBody>,
    /// What each body carries.
    attached: Vec<Vec<PlannedAttached>>,
    /// In the order of the case.
    joints: Vec<PlannedJoint>,
    /// Where each drive acts on its body; of two nodes top, then bottom.
    drives: Vec<Place>,
    /// Where each load acts on its body.
    loads: Vec<Place>,
    /// Places of the points of outputs among the output nodes of their bodies, an output each.
    outputs: Vec<usize>,
    /// The laws with the values with which the joints use them, a joint each.
    pub(crate) laws: Vec<LawSource>,
}

impl JoinedPlan {
    /// Reads or makes the meshes, finds the sets that the case names, and places the joints.
    ///
    /// # Errors
    /// Everything that is wrong with the meshes, every set that is missing or of the wrong size, what does not fit
    /// together, and what is wrong with laws.
    pub(crate) fn new(
        joined: &JoinedMachine,
        wanted: &[Output],
        warnings: &mut Vec<String>,
    ) -> Result<JoinedPlan, Failure> {
        warnings.extend(joined.joints.iter().flat_map(joints::pushes_away));
        let mut errors = Diagnostics::new();
        let mut bodies = bodies::plan(joined, warnings)?;
        let carried = joined.bodies.iter().zip(&mut bodies);
        let attached =
            carried.map(|(own, body)| attached::plan(&own.attached, body, &mut errors)).collect();
        let mut joints = Vec::with_capacity(joined.joints.len());
        for joint in &joined.joints {
            joints.extend(joints::place(joint, joined, &mut bodies, &mut errors));
        }
        if joints.len() == joined.joints.len() {
            compare::compare(joined, &joints, &bodies, &mut errors)?;
        }
        let (mut drives, mut loads) = (Vec::new(), Vec::new());
        for drive in &joined.drives {
            let body = &mut bodies[drive.body];
            if let PlannedBody::Meshed(plan) = &*body {
                geometry::driven(&drive.couple, &plan.mesh, &mut errors);
            }
            drives.push(body.driven(&drive.couple, &mut errors));
        }
        for load in &joined.loads {
            let body = &mut bodies[load.body];
            if let PlannedBody::Meshed(plan) = &*body {
                geometry::loaded_twice(&load.load, &plan.mesh, &mut errors);
            }
            loads.push(body.loaded(load, &mut errors));
        }
        for (place, body) in bodies.iter_mut().enumerate() {
            body.hold(place, joined, &mut errors);
        }
        // Last, so that their points are the last nodes of their bodies.
        let outputs = outputs::places(wanted, |body, set, z| match (&mut bodies[body], set) {
            (PlannedBody::Meshed(plan), Some(set)) => outputs::on_mesh(plan, set, &mut errors),
            (PlannedBody::Meshed(_), None) => 0,
            (PlannedBody::Rigid(own), _) => {
                let [x, y, centre] = own.body.centre;
                own.node([x, y, z.unwrap_or(centre)])
            }
        });
        errors.into_result(())?;
        let measured = joints.iter().map(|joint| (&joint.bearing, joint.measured(&bodies)));
        let laws = laws_of(measured.collect(), "the joint")?;
        Ok(JoinedPlan { bodies, attached, joints, drives, loads, outputs, laws })
    }

    /// Checks for what would keep the bodies from being reduced, without reducing them.
    ///
    /// # Errors
    /// Cells turned inside out, motions that nothing stops.
    pub(crate) fn verify(&self) -> Result<(), Failure> {
        let mut errors = Diagnostics::new();
        for body in &self.bodies {
            let PlannedBody::Meshed(plan) = body else { continue };
            if plan.rigid {
                continue;
            }
            match plan.verify().map_err(|error| plan.explain(error)) {
                Ok(()) => {}
                Err(Failure::Input(found)) => errors.append(found),
                Err(other) => return Err(other),
            }
        }
        Ok(errors.into_result(())?)
    }
}

pub(super) fn build(
    (joined, wanted): (&JoinedMachine, &[Output]),
    plan: &JoinedPlan,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<Built, Failure> {
    let assembled = assemble(joined, plan, cache, warnings)?;
    let Assembled { mut parts, laws, law_hashes, facts } = assembled;
    let made = outputs::taken_off(wanted, &plan.outputs, &mut parts.bodies);
    let initial = joined.bodies.iter().map(|body| BodyStart {
        speed: match body.turning {
            Some(Turning::Free { initial_speed }) => initial_speed.unwrap_or(0.0),
            _ => 0.0,
        },
        ..BodyStart::default()
    });
    let machine = Machine::new(parts).map_err(|error| {
        let law = |place: usize| &joined.joints[place].bearing.law.name;
        explain(error, law, |place| joined.joints[place].bearing.bore.as_slice())
    })?;
    Ok(Built {
        machine: machine.with_outputs(made)?,
        initial: initial.collect(),
        clearances: joined.joints.iter().map(|own| own.bearing.radial_clearance).collect(),
        laws,
        law_hashes,
        bodies: facts,
    })
}

/// What a machine is made from, and what results say about it.
pub(super) struct Assembled {
    pub(super) parts: MachineParts,
    laws: Vec<LawSource>,
    law_hashes: Vec<(String, String)>,
    facts: Option<BodyFacts>,
}

/// Reduces the bodies and places springs and loads.
pub(super) fn assemble(
    joined: &JoinedMachine,
    plan: &JoinedPlan,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<Assembled, Failure> {
    let (mut bodies, facts) = reduced(joined, plan, cache, warnings)?;
    bodies.push(Body::standing("ground", Support::rigid(&[])));
    let mut placed = Laws::default();
    let mut bearings = Vec::with_capacity(joined.joints.len());
    for ((joint, own), law) in joined.joints.iter().zip(&plan.joints).zip(&plan.laws) {
        let springs = own.bearing.springs;
        bearings.push(Bearing {
            name: format!("{} {}", joint.kind.words().0, joint.name.text()),
            label: Some(format!("_{}", joint.name.text())),
            sides: Sides { run_out: joint.run_out, ..own.sides.clone() },
            journal: own.journal,
            bore: own.bore.clone(),
            clearance: own.bearing.radial_clearance,
            journal_radius: own.bearing.journal_radius,
            stations: rotor::stations(&own.bearing, [own.z[0], own.z[2]]),
            angles: joint.angle.map_or_else(|| angles(springs), |angle| vec![angle]),
            law: placed.place(law)?,
        });
    }
    let on =
        |body: usize| Loaded { body, nodes: bodies[body].nodes(), means: bodies[body].measures() };
    let mut loads = Vec::new();
    for (load, place) in joined.loads.iter().zip(&plan.loads) {
        loads.extend(forces::loads(&load.load, on(load.body), place));
    }
    for (drive, place) in joined.drives.iter().zip(&plan.drives) {
        loads.extend(forces::drive(&drive.couple, on(drive.body), place));
    }
    loads.extend(forces::gravity(joined.gravity.as_ref(), &bodies, warnings));
    let (laws, law_hashes) = (placed.used(), placed.hashes());
    let parts = MachineParts {
        bodies,
        motion: joined.motion,
        clearance: clearance(),
        laws: placed.into_laws(),
        bearings,
        loads,
    };
    Ok(Assembled { parts, laws, law_hashes, facts })
}

/// The bodies, each from the cache if it is there, and facts about those with a mesh.
fn reduced(
    joined: &JoinedMachine,
    plan: &JoinedPlan,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<(Vec<Body>, Option<BodyFacts>), Failure> {
    let start = Instant::now();
    let (mut bodies, mut facts, mut cached) = (Vec::new(), Vec::new(), true);
    let carried = plan.bodies.iter().zip(&plan.attached);
    for (body, (own, attached)) in joined.bodies.iter().zip(carried) {
        let name = body.name.text();
        let rotation = body.turning.as_ref().map(|turning| match turning {
            Turning::Free { .. } => Rotation::Free,
            Turning::Prescribed { speed, acceleration } => {
                Rotation::Prescribed { speed: *speed, acceleration: *acceleration }
            }
            Turning::Table(columns) => {
                let schedule = Schedule::of_speeds(&columns.rows).expect("rows that rise");
                Rotation::Scheduled(Arc::new(schedule))
            }
        });
        let plan = match (own, &rotation) {
            (PlannedBody::Meshed(plan), _) => plan,
            (PlannedBody::Rigid(rigid), Some(rotation)) => {
                let shaft = attach(rigid.body.turning(&rigid.nodes), attached);
                bodies.push(Body::turning(name, shaft, rotation.clone()));
                continue;
            }
            (PlannedBody::Rigid(rigid), None) => {
                bodies.push(Body::standing(name, rigid.body.standing(&rigid.nodes)));
                continue;
            }
        };
        if plan.rigid {
            bodies.push(rigid(name, plan, rotation, attached)?);
            continue;
        }
        let kind = if rotation.is_some() { BodyKind::Shaft } else { BodyKind::Support };
        let (found, content, known) = reduced_bodies::reduced(kind, plan, cache, warnings)?;
        cached &= known;
        let explained = |error| plan.explain(error);
        let made = match rotation {
            Some(rotation) => {
                let mut shaft = found.shaft(&plan.spec).map_err(explained)?;
                shaft.nodes = plan.outputs(&shaft.nodes, &shaft.measures);
                Body::turning(name, plan.in_frame(attach(shaft, attached)), rotation)
            }
            None => {
                let mut support = found.support(&plan.spec).map_err(explained)?;
                support.nodes = plan.outputs(&support.nodes, &support.measures);
                Body::standing(name, support)
            }
        };
        let hertz = match &made {
            Body::Turning { shaft, .. } => shaft.hertz.clone(),
            Body::Standing { support, .. } => support.hertz.clone(),
        };
        let (name, counts) = (name.to_owned(), plan.counts());
        facts.push(BodyFact { name, counts, hertz, content });
        bodies.push(made);
    }
    let wall = start.elapsed().as_secs_f64();
    let facts = (!facts.is_empty()).then_some(BodyFacts { bodies: facts, wall, cached });
    Ok((bodies, facts))
}

/// A mesh taken as rigid.
fn rigid(
    name: &str,
    plan: &BodyPlan,
    rotation: Option<Rotation>,
    attached: &[PlannedAttached],
) -> Result<Body, Failure> {
    let inertia = RigidInertia::of(&plan.mesh).map_err(|error| plan.explain(error))?;
    let positions: Vec<[f64; 3]> =
        plan.spec.nodes.iter().map(|&node| plan.mesh.nodes()[node]).collect();
    let centres: Vec<[f64; 3]> = plan.spec.means.iter().map(NodeSetMean::centre).collect();
    let measures = inertia.measures(&centres, rotation.is_some());
    Ok(match rotation {
        Some(rotation) => {
            let shaft = inertia.turning(&positions);
            let nodes = plan.outputs(&shaft.nodes, &measures);
            Body::turning(name, attach(Shaft { nodes, measures, ..shaft }, attached), rotation)
        }
        None => {
            let support = inertia.standing(&positions, [0.0; 2], [0.0; 2]);
            let nodes = plan.outputs(&support.nodes, &measures);
            Body::standing(name, Support { nodes, measures, ..support })
        }
    })
}

/// Text at the place of another.
fn at(place: &Located, text: String) -> Located {
    Located::new(place.source(), place.span(), text)
}

/// As the section of a drive one that the case names for a body: a set, or two of one node.
fn section_of(sets: &[Located]) -> case::Drive {
    let (first, last) = (&sets[0], &sets[sets.len() - 1]);
    case::Drive {
        top: first.clone(),
        bottom: last.clone(),
        section: (sets.len() == 1).then(|| first.clone()),
        torque: 0.0,
        target_speed: 0.0,
        release: Release::Located,
        table: None,
        acts: false,
    }
}

/// Whether a body turns.
fn turns(joined: &JoinedMachine, body: usize) -> bool {
    joined.bodies[body].turning.is_some()
}

/// The mesh of a body, as the case says it.
fn meshed(joined: &JoinedMachine, body: usize) -> Option<&case::MeshedBody> {
    match &joined.bodies[body].form {
        Form::Meshed(meshed) => Some(meshed),
        Form::Rigid(_) => None,
    }
}
