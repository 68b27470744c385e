//! The machine of a shaft on a support.

use whirl_solver::bearing::{Bearing, Sides};
use whirl_solver::cache::Cache;
use whirl_solver::loads::Load;
use whirl_solver::machine::{Body, Machine, MachineParts, Rotation};
use whirl_solver::shaft::Shaft;

use super::bodies::{Bodies, bodies};
use super::forces::{self, Loaded};
use super::plan::MachinePlan;
use super::springs::{Laws, angles, clearance, explain};
use super::{BodyFact, BodyFacts, Built, outputs};
use crate::case::{self, LawSource, Output, Rotor};
use crate::errors::Failure;

pub(super) fn build(
    (rotor, wanted): (&Rotor, &[Output]),
    plan: &MachinePlan,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<Built, Failure> {
    let assembled = assemble(rotor, plan, cache, warnings)?;
    let Assembled { mut parts, laws, law_hashes, facts } = assembled;
    let made = outputs::taken_off(wanted, &plan.outputs, &mut parts.bodies);
    let machine = Machine::new(parts).map_err(|error| {
        let bearing = |place: usize| &rotor.bearings[place];
        explain(error, |place| &bearing(place).law.name, |place| &bearing(place).bore)
    })?;
    Ok(Built {
        machine: machine.with_outputs(made)?,
        initial: Vec::new(),
        clearances: rotor.bearings.iter().map(|bearing| bearing.radial_clearance).collect(),
        laws,
        law_hashes,
        bodies: Some(facts),
    })
}

/// What a machine is made from, and what results say about it.
pub(super) struct Assembled {
    pub(super) parts: MachineParts,
    laws: Vec<LawSource>,
    law_hashes: Vec<(String, String)>,
    facts: BodyFacts,
}

/// Reduces the bodies and places springs and loads.
pub(super) fn assemble(
    rotor: &Rotor,
    plan: &MachinePlan,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<Assembled, Failure> {
    let mut bodies = bodies(plan, cache, warnings)?;
    let Bodies { shaft, support, .. } = &mut bodies;
    shaft.nodes = plan.shaft.outputs(&shaft.nodes, &shaft.measures);
    support.nodes = plan.support.outputs(&support.nodes, &support.measures);
    let mut placed = Laws::default();
    let bearings = bearings(rotor, plan, &bodies.shaft, &mut placed)?;
    let mut loads = loads(rotor, plan, &bodies.shaft);
    let [first, second] = bodies.content;
    let fact = |name: &str, counts, hertz: &[f64], content| BodyFact {
        name: name.to_owned(),
        counts,
        hertz: hertz.to_vec(),
        content,
    };
    let facts = BodyFacts {
        bodies: vec![
            fact("shaft", plan.shaft.counts(), &bodies.shaft.hertz, first),
            fact("support", plan.support.counts(), &bodies.support.hertz, second),
        ],
        wall: bodies.wall,
        cached: bodies.cached,
    };
    let (used, law_hashes) = (placed.used(), placed.hashes());
    let bodies = vec![
        Body::turning("shaft", bodies.shaft, Rotation::Free),
        Body::standing("support", bodies.support),
    ];
    loads.extend(forces::gravity(rotor.gravity.as_ref(), &bodies, warnings));
    let parts = MachineParts {
        bodies,
        motion: rotor.shaft.motion,
        clearance: clearance(),
        laws: placed.into_laws(),
        bearings,
        loads,
    };
    Ok(Assembled { parts, laws: used, law_hashes, facts })
}

fn bearings(
    rotor: &Rotor,
    plan: &MachinePlan,
    shaft: &Shaft,
    laws: &mut Laws,
) -> Result<Vec<Bearing>, Failure> {
    let mut bearings = Vec::with_capacity(rotor.bearings.len());
    for (place, bearing) in rotor.bearings.iter().enumerate() {
        let journal = plan.journals[place];
        let ends = [journal[0], journal[2]].map(|n| shaft.nodes[n].position[2]);
        bearings.push(Bearing {
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

fn loads(rotor: &Rotor, plan: &MachinePlan, shaft: &Shaft) -> Vec<Load> {
    let on = Loaded { body: 0, nodes: &shaft.nodes, means: &shaft.measures };
    let both = rotor.loads.iter().zip(&plan.loads);
    let loads = both.flat_map(|(load, place)| forces::loads(load, on, place));
    loads.chain(forces::drive(&rotor.drive, on, &plan.drive)).collect()
}
