//! The machine of bodies by name.

mod attached;
mod bodies;
mod clearance;
mod compare;
mod eccentric;
mod idle;
mod joints;
mod of_case;
mod others;
mod pads;
mod planes;
mod planned_body;
mod planned_joint;
mod pushing;
mod section;
mod surfaces;
mod watched;

use whirl_codegen::diagnostic::{Code, Diagnostics};
use whirl_solver::bearing::{Bearing, OtherMotion, Sides};
use whirl_solver::mesh::measure::Circle;
use whirl_solver::model::{Attachment, BodyModel, Form, Model, Place};
use whirl_solver::output::{self, Wanted};

pub(crate) use self::idle::of_loads as idle_loads;
pub(crate) use self::planned_body::PlannedBody;
use self::planned_joint::PlannedJoint;
pub(crate) use self::watched::Watched;
use super::forces;
use super::laws::laws_of;
use super::plan::{BodyPlan, geometry};
use super::springs::{self, Laws, angles};
use crate::case::{Case, Fields, InputForm, JoinedMachine, LawSource, NamedBody, Output};
use crate::errors::Failure;

/// Bodies, joints, drives and loads before the reduction of what has a mesh.
pub(crate) struct JoinedPlan {
    /// In the order of the case.
    pub(crate) bodies: Vec<PlannedBody>,
    /// What each body carries.
    attached: Vec<Vec<Attachment>>,
    /// In the order of the case.
    joints: Vec<PlannedJoint>,
    /// Where each drive acts on its body; of two nodes top, then bottom.
    drives: Vec<Place>,
    /// Where each load acts on its body.
    loads: Vec<Place>,
    /// The outputs, with the places of their points among the output nodes of their bodies.
    outputs: Vec<output::Output<usize>>,
    /// Bodies that are written as wholes, with the place of their first node among the output nodes.
    fields: Vec<(usize, usize)>,
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
        (wanted, fields): (&[Output], Option<&Fields>),
        warnings: &mut Vec<String>,
    ) -> Result<JoinedPlan, Failure> {
        warnings.extend(joined.joints.iter().flat_map(pushing::pushes_away));
        warnings.extend(joined.joints.iter().flat_map(|joint| others::on_nothing(joint, joined)));
        let mut errors = Diagnostics::new();
        let mut bodies = bodies::plan(joined, warnings)?;
        let carried = joined.bodies.iter().zip(&mut bodies);
        let attached =
            carried.map(|(own, body)| attached::plan(&own.attached, body, &mut errors)).collect();
        let mut joints = Vec::with_capacity(joined.joints.len());
        for joint in &joined.joints {
            let placed = joints::place(joint, joined, &mut bodies, &mut errors);
            if placed.is_none() && errors.is_empty() {
                // A machine without one of its joints must not run, whatever the reason.
                let message =
                    format!("the joint `{}` cannot be placed on its bodies", joint.name.text());
                errors.push(joint.name.error_here(Code::BAD_VALUE, message));
            }
            joints.extend(placed);
        }
        if joints.len() == joined.joints.len() {
            let placed = joined.joints.iter().zip(&joints);
            warnings.extend(placed.filter_map(|(joint, own)| own.torque_on_frame(joint, &bodies)));
            compare::compare(joined, &joints, &bodies, warnings, &mut errors)?;
            eccentric::warn(joined, &bodies, warnings);
        }
        let (mut drives, mut loads) = (Vec::new(), Vec::new());
        for drive in &joined.drives {
            let body = &mut bodies[drive.body];
            if let PlannedBody::Meshed(plan) = &*body {
                geometry::driven(&drive.couple.section, &plan.mesh, &mut errors);
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
        for (joint, own) in joined.joints.iter().zip(&joints) {
            own.add_bore(joint, &mut bodies);
        }
        for (place, body) in bodies.iter_mut().enumerate() {
            body.hold(place, joined, &mut errors);
        }
        // Last, so that their points are the last nodes of their bodies.
        let mut point = |body: usize, own| bodies[body].output(&own, &mut errors);
        let outputs: Vec<output::Output<usize>> =
            wanted.iter().cloned().map(|own| own.with_points(&mut point)).collect();
        correct(&mut bodies, &outputs, &mut errors);
        let fields = fields.iter().flat_map(|own| &own.bodies);
        let fields = fields.filter_map(|&body| match &mut bodies[body] {
            PlannedBody::Meshed(plan) => Some((body, plan.output_all())),
            PlannedBody::Rigid(_) => None,
        });
        let fields = fields.collect();
        errors.into_result(())?;
        let measured = joints.iter().map(|joint| (&joint.bearing, joint.measured(&bodies)));
        let place = match joined.form {
            InputForm::Named => Some("the joint"),
            InputForm::Shaft => Some("the bearing, or to `[springs]` for all"),
            // What nothing gives is as the file of the law has it.
            InputForm::Mass => None,
        };
        let laws = laws_of(measured.collect(), place)?;
        let plan = JoinedPlan { bodies, attached, joints, drives, loads, outputs, fields, laws };
        let placed = |place: usize| (plan.clearance(place).0, plan.stations(place));
        warnings.extend(pads::warnings(&joined.joints, &plan.laws, &placed));
        Ok(plan)
    }

    /// The bodies that have meshes.
    pub(crate) fn meshed(&mut self) -> impl Iterator<Item = &mut BodyPlan> {
        self.bodies.iter_mut().filter_map(|body| match body {
            PlannedBody::Meshed(own) => Some(&mut **own),
            PlannedBody::Rigid(_) => None,
        })
    }

    /// Radial clearance of a joint (m), and the circles of journal and bore where the meshes have both.
    pub(crate) fn clearance(&self, joint: usize) -> (f64, Option<[Circle; 2]>) {
        let own = &self.joints[joint];
        (own.bearing.radial_clearance, own.circles)
    }

    /// x and y of a bushing (m).
    pub(crate) fn place_of_bushing(&self, joint: usize) -> [f64; 2] {
        self.joints[joint].sides.bore_axis
    }

    /// To how many pressures of the film of a joint the answers of its bore are kept; none where it does not give way.
    pub(crate) fn pressures(&self, joint: usize) -> Option<usize> {
        let own = &self.joints[joint];
        let body = self.bodies.get(own.sides.bodies[1])?.meshed()?;
        own.film.as_ref().map(|_| body.pressures_of_films())
    }

    /// z of the rings of springs of a joint, or of the planes in which its law acts (m).
    pub(crate) fn stations(&self, joint: usize) -> Vec<f64> {
        let own = &self.joints[joint];
        let [left, _, right] = own.z;
        let along = joints::stations(&own.bearing, [left, right]);
        along.into_iter().map(|part| left + part * (right - left)).collect()
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

/// Asks for the static answers that the bodies keep beside their modes, those to unit forces at outputs among them.
fn correct(
    bodies: &mut [PlannedBody],
    outputs: &[output::Output<usize>],
    errors: &mut Diagnostics,
) {
    for own in outputs {
        let Wanted::Motion { body, point, components, .. } = &own.what else { continue };
        if let PlannedBody::Meshed(plan) = &mut bodies[*body] {
            plan.ask_for(*point, components);
        }
    }
    for body in bodies {
        if let PlannedBody::Meshed(plan) = body {
            plan.correct(errors);
        }
    }
}

/// The laws as a case uses them, and names and hashes of what they were made from.
pub(super) type UsedLaws = (Vec<LawSource>, Vec<(String, String)>);

/// The case as the solver takes it, with its laws.
///
/// # Errors
/// Whatever is wrong with laws.
pub(super) fn model<'a>(
    case: &'a Case,
    plan: &'a JoinedPlan,
) -> Result<(Model<'a>, UsedLaws), Failure> {
    let joined = &*case.machine;
    let planned = || joined.bodies.iter().zip(&plan.bodies).zip(&plan.attached);
    let body = |((own, planned), carried): ((&'a NamedBody, &'a PlannedBody), &Vec<Attachment>)| {
        // What turns in its frame loads it with its unbalance.
        let carried = if own.spin().is_some() { Vec::new() } else { carried.clone() };
        let (name, rotation) = (own.name.text(), own.rotation.clone());
        BodyModel { name, form: planned.form(), rotation, carried }
    };
    let mut bodies: Vec<BodyModel> = planned().map(body).collect();
    let ground = Form::Ground;
    bodies.push(BodyModel { name: "ground", form: ground, rotation: None, carried: Vec::new() });
    let mut laws = Laws::default();
    let mut bearings = Vec::with_capacity(joined.joints.len());
    for ((joint, own), law) in joined.joints.iter().zip(&plan.joints).zip(&plan.laws) {
        let springs = own.bearing.springs;
        let mut others = Vec::with_capacity(own.others.len());
        for other in &own.others {
            let law = laws.place(&other.law)?;
            others.push(OtherMotion { kind: other.kind, sections: other.sections, law });
        }
        bearings.push(Bearing {
            name: format!("{} {}", joint.kind.words().0, joint.name.text()),
            label: Some(joint.called.label.clone()),
            sides: Sides { run_out: joint.run_out, ..own.sides.clone() },
            journal: own.journal,
            bore: own.bore.clone(),
            clearance: own.bearing.radial_clearance,
            journal_radius: own.bearing.journal_radius,
            stations: joints::stations(&own.bearing, [own.z[0], own.z[2]]),
            angles: joint.angle.map_or_else(|| angles(springs), |angle| vec![angle]),
            law: laws.place(law)?,
            others,
        });
    }
    let loads = joined.loads.iter().zip(&plan.loads);
    let loads = loads.map(|(load, place)| forces::load(load, place));
    let spinning = planned().enumerate().filter_map(|(body, ((own, _), carried))| {
        Some(carried.iter().flat_map(forces::of_unbalance((body, own.spin()?))))
    });
    let drives = joined.drives.iter().zip(&plan.drives);
    let drives = drives.filter_map(|(drive, place)| forces::drive(drive, place));
    let used = (laws.used(), laws.hashes());
    let model = Model {
        bodies,
        motion: joined.motion,
        clearance: springs::clearance(),
        laws: laws.into_laws(),
        bearings,
        loads: loads.chain(spinning.flatten()).chain(drives).collect(),
        gravity: forces::acceleration(joined.gravity.as_ref()),
        ground: forces::ground(joined.ground.as_ref()),
        outputs: plan.outputs.clone(),
        fields: plan.fields.clone(),
    };
    Ok((model, used))
}
