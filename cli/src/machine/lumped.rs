//! The machine of one mass: a point shaft in a frame at rest, stops as single springs in a rigid support.

use std::f64::consts::{PI, TAU};

use whirl_solver::bearing::{Bearing, Sides};
use whirl_solver::bodies::Rotation;
use whirl_solver::dynamics::BodyStart;
use whirl_solver::loads::{Frame, Onset, TimeFunction};
use whirl_solver::model::{BodyModel, Form, LoadAction, LoadModel, Model, Place};
use whirl_solver::shaft::Shaft;

use super::described::Described;
use super::springs::{Laws, clearance};
use super::{forces, outputs};
use crate::case::{Lumped, Output, Side, Unbalance};
use crate::errors::Failure;

/// Place of the mass among the bodies.
const MASS: usize = 0;

/// The case as the solver takes it.
///
/// # Errors
/// Whatever is wrong with laws.
pub(super) fn describe<'a>(
    lumped: &'a Lumped,
    wanted: &[Output],
) -> Result<Described<'a>, Failure> {
    let stiffness = [lumped.stiffness; 2];
    let mut shaft = Shaft::lumped(lumped.mass, stiffness, [lumped.damping; 2], 0.0);
    let mut laws = Laws::default();
    let mut bearings = Vec::with_capacity(lumped.stops.len());
    for (place, stop) in lumped.stops.iter().enumerate() {
        bearings.push(Bearing {
            others: Vec::new(),
            name: format!("stop {}", place + 1),
            label: None,
            sides: Sides::default(),
            journal: [0; 3],
            bore: [const { Vec::new() }; 3],
            clearance: stop.gap,
            // Without an unbalance nothing turns, and a radius is of no effect.
            journal_radius: stop.journal_radius.or(lumped.unbalance.is_none().then_some(0.0)),
            stations: vec![0.5],
            angles: match stop.side {
                Side::Above => vec![0.0],
                Side::Below => vec![PI],
                Side::Around => Vec::new(),
            },
            law: laws.place(&stop.law)?,
        });
    }
    let load = |name: &str, force: [f64; 2], time_function: TimeFunction| LoadModel {
        name: name.to_owned(),
        body: MASS,
        place: Place::Nodes(vec![0]),
        action: LoadAction::Force([force[0], force[1], 0.0]),
        time_function,
        onset: Onset::Start,
        frame: Frame::Space,
    };
    let mut loads = Vec::new();
    if lumped.force != 0.0 {
        loads.push(load("force", [lumped.force, 0.0], TimeFunction::Constant));
    }
    if let Some(Unbalance { eccentricity, speed }) = lumped.unbalance {
        let force = lumped.mass * eccentricity * speed * speed;
        let turning = |phase: f64| TimeFunction::Sine { frequency: speed / TAU, phase };
        loads.push(load("unbalance.x", [force, 0.0], turning(0.5 * PI)));
        loads.push(load("unbalance.y", [0.0, force], turning(0.0)));
    }
    let rotation = match lumped.unbalance {
        Some(Unbalance { speed, .. }) => Rotation::Spinning { speed },
        None => Rotation::Held,
    };
    // The mass is a point, which every output has for itself.
    let own = shaft.nodes.len();
    shaft.nodes.extend(vec![shaft.nodes[0].clone(); wanted.len()]);
    let places: Vec<usize> = (own..shaft.nodes.len()).collect();
    let mass = Form::Lumped(Box::new(shaft));
    Ok(Described {
        laws: laws.used(),
        law_hashes: laws.hashes(),
        model: Model {
            bodies: vec![
                BodyModel {
                    name: "mass",
                    form: mass,
                    rotation: Some(rotation),
                    carried: Vec::new(),
                },
                BodyModel {
                    name: "ground",
                    form: Form::Ground,
                    rotation: None,
                    carried: Vec::new(),
                },
            ],
            motion: lumped.motion,
            clearance: clearance(),
            laws: laws.into_laws(),
            bearings,
            loads,
            gravity: forces::acceleration(lumped.gravity.as_ref()),
            outputs: outputs::placed(wanted, &places),
            fields: Vec::new(),
        },
        axes: Vec::new(),
        plans: vec![None, None],
        initial: vec![BodyStart {
            angle: 0.0,
            speed: 0.0,
            position: vec![lumped.displacement, 0.0],
            velocity: vec![lumped.velocity, 0.0],
        }],
        gravity: lumped.gravity.as_ref(),
        law_places: lumped.stops.iter().map(|stop| &stop.law_name).collect(),
        bore_places: vec![&[]; lumped.stops.len()],
    })
}
