//! The machine of a shaft on a support.

use whirl_solver::bearing::{Bearing, Sides};
use whirl_solver::bodies::Rotation;
use whirl_solver::model::{BodyModel, Model};

use super::described::Described;
use super::plan::{BodyPlan, MachinePlan};
use super::springs::{Laws, angles, clearance};
use super::{forces, outputs};
use crate::case::{self, Output, Rotor};
use crate::errors::Failure;

/// Place of the shaft among the bodies.
const SHAFT: usize = 0;

/// The case as the solver takes it.
///
/// # Errors
/// Whatever is wrong with laws.
pub(super) fn describe<'a>(
    rotor: &'a Rotor,
    outputs: &[Output],
    plan: &'a MachinePlan,
) -> Result<Described<'a>, Failure> {
    let MachinePlan { shaft, support, .. } = plan;
    let body = |name, plan: &'a BodyPlan, rotation| BodyModel {
        name,
        form: plan.form(),
        rotation,
        carried: Vec::new(),
    };
    let mut laws = Laws::default();
    let bearings = bearings(rotor, plan, &mut laws)?;
    let loads = rotor.loads.iter().zip(&plan.loads);
    let loads = loads.map(|(load, place)| forces::load(load, SHAFT, place));
    Ok(Described {
        laws: laws.used(),
        law_hashes: laws.hashes(),
        model: Model {
            bodies: vec![
                body("shaft", shaft, Some(Rotation::Free)),
                body("support", support, None),
            ],
            motion: rotor.shaft.motion,
            clearance: clearance(),
            laws: laws.into_laws(),
            bearings,
            loads: loads.chain(forces::drive(&rotor.drive, SHAFT, &plan.drive)).collect(),
            gravity: forces::acceleration(rotor.gravity.as_ref()),
            outputs: outputs::placed(outputs, &plan.outputs),
            fields: plan.fields.clone(),
        },
        axes: vec![[0.0; 2]; 2],
        plans: vec![Some(shaft), Some(support)],
        initial: Vec::new(),
        gravity: rotor.gravity.as_ref(),
        law_places: rotor.bearings.iter().map(|bearing| &bearing.law.name).collect(),
        bore_places: rotor.bearings.iter().map(|bearing| bearing.bore.as_slice()).collect(),
    })
}

fn bearings(rotor: &Rotor, plan: &MachinePlan, laws: &mut Laws) -> Result<Vec<Bearing>, Failure> {
    let mut bearings = Vec::with_capacity(rotor.bearings.len());
    for (place, bearing) in rotor.bearings.iter().enumerate() {
        let journal = plan.journals[place];
        let ends = [journal[0], journal[2]].map(|node| plan.shaft.position(node)[2]);
        bearings.push(Bearing {
            others: Vec::new(),
            name: format!("bearing {}", place + 1),
            label: None,
            sides: Sides::default(),
            journal,
            bore: plan.bores[place].clone(),
            clearance: bearing.radial_clearance,
            journal_radius: bearing.journal_radius,
            stations: stations(bearing, ends),
            angles: angles(bearing.springs),
            law: laws.place(&plan.laws[place])?,
        });
    }
    Ok(bearings)
}

/// Rings of springs by their distance from the left end over the length; `ends` are the z of the ends. A bearing
/// in one plane has its only ring there, which the middle is.
pub(super) fn stations(bearing: &case::Bearing, [left, right]: [f64; 2]) -> Vec<f64> {
    match bearing.stations.as_slice() {
        [] => vec![0.0, 0.5, 1.0],
        [_] if left == right => vec![0.5],
        stations => stations.iter().map(|z| (z - left) / (right - left)).collect(),
    }
}
