//! The machine of one mass: a point shaft in a frame at rest, stops as single springs in a rigid support.

use std::f64::consts::{PI, TAU};

use whirl_solver::bearing::{Bearing, Sides};
use whirl_solver::dynamics::BodyStart;
use whirl_solver::loads::{Frame, Load, TimeFunction};
use whirl_solver::machine::{Body, Machine, MachineParts, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::forces;
use super::springs::{Laws, clearance, explain};
use super::{Built, outputs};
use crate::case::{Lumped, Output, Side, Unbalance};
use crate::errors::Failure;

pub(super) fn build(
    (lumped, wanted): (&Lumped, &[Output]),
    warnings: &mut Vec<String>,
) -> Result<Built, Failure> {
    let stiffness = [lumped.stiffness; 2];
    let shaft = Shaft::lumped(lumped.mass, stiffness, [lumped.damping; 2], 0.0);
    let mut laws = Laws::default();
    let mut bearings = Vec::with_capacity(lumped.stops.len());
    for (place, stop) in lumped.stops.iter().enumerate() {
        bearings.push(Bearing {
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
    let load = |[x, y]: [f64; 2], time_function: TimeFunction| {
        Load::force(0, shaft.nodes[0].clone(), [x, y, 0.0], time_function, Frame::Space)
    };
    let mut loads = Vec::new();
    if lumped.force != 0.0 {
        loads.push(load([lumped.force, 0.0], TimeFunction::Constant));
    }
    if let Some(Unbalance { eccentricity, speed }) = lumped.unbalance {
        let force = lumped.mass * eccentricity * speed * speed;
        let turning = |phase: f64| TimeFunction::Sine { frequency: speed / TAU, phase };
        loads.push(load([force, 0.0], turning(0.5 * PI)));
        loads.push(load([0.0, force], turning(0.0)));
    }
    let (used, law_hashes) = (laws.used(), laws.hashes());
    let rotation = match lumped.unbalance {
        Some(Unbalance { speed, .. }) => Rotation::Spinning { speed },
        None => Rotation::Held,
    };
    let bodies =
        vec![Body::turning("mass", shaft, rotation), Body::standing("ground", Support::rigid(&[]))];
    loads.extend(forces::gravity(lumped.gravity.as_ref(), &bodies, warnings));
    let machine = Machine::new(MachineParts {
        bodies,
        motion: lumped.motion,
        clearance: clearance(),
        laws: laws.into_laws(),
        bearings,
        loads,
    })
    .map_err(|error| explain(error, |place| &lumped.stops[place].law_name, |_| &[]))?;
    // The mass is a point.
    let made = outputs::of_bodies(wanted, &vec![0; wanted.len()], &machine.bodies);
    let machine = machine.with_outputs(made)?;
    Ok(Built {
        machine,
        initial: vec![BodyStart {
            speed: 0.0,
            position: vec![lumped.displacement, 0.0],
            velocity: vec![lumped.velocity, 0.0],
        }],
        clearances: lumped.stops.iter().map(|stop| stop.gap).collect(),
        laws: used,
        law_hashes,
        bodies: None,
    })
}
