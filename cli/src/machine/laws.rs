//! The laws of the bearings, with the values that the case and the meshes give them.

use whirl_codegen::diagnostic::Diagnostics;
use whirl_codegen::rational::Rational;
use whirl_codegen::spec::law::BearingValue;
use whirl_solver::mesh::measure::mean_radius;

use super::plan::MachinePlan;
use crate::case::{Bearing, BearingFacts, LawSource, NamedLaw, Rotor, rounded};
use crate::errors::Failure;

/// The law of every bearing. What the case does not say of a bearing is measured on the meshes: the radius of its
/// bore, and its length between the ends of the journal.
///
/// # Errors
/// A value that nothing gives; whatever is wrong with a law once it has these values.
pub(super) fn laws(rotor: &Rotor, plan: &MachinePlan) -> Result<Vec<LawSource>, Failure> {
    // Bearings that are alike share their law.
    let mut read: Vec<(&Bearing, BearingFacts, LawSource)> = Vec::new();
    let mut laws = Vec::with_capacity(rotor.bearings.len());
    let mut errors = Diagnostics::new();
    for (place, bearing) in rotor.bearings.iter().enumerate() {
        let facts = facts(bearing, place, plan);
        let known = read.iter().find(|(other, own, _)| {
            let alike = other.law.source.name() == bearing.law.source.name();
            alike && *own == facts && other.parameters == bearing.parameters
        });
        if let Some((_, _, law)) = known {
            laws.push(law.clone());
            continue;
        }
        let lacking = bearing.law.lacking(&bearing.parameters, &facts);
        if !lacking.is_empty() {
            lacking.into_iter().for_each(|error| errors.push(error));
            continue;
        }
        match NamedLaw::used(&bearing.law, &bearing.parameters, &facts) {
            Ok(law) => {
                laws.push(law.clone());
                read.push((bearing, facts, law));
            }
            Err(found) => errors.append(found),
        }
    }
    Ok(errors.into_result(laws)?)
}

/// What is known of a bearing from the case and the meshes.
fn facts(bearing: &Bearing, place: usize, plan: &MachinePlan) -> BearingFacts {
    let mut facts = bearing.facts.clone();
    if facts.value(BearingValue::BoreRadius).is_none() {
        facts.bore_radius = bore_radius(place, plan);
    }
    if let (None, Some(bore), Some(clearance)) =
        (&facts.journal_radius, &facts.bore_radius, &facts.radial_clearance)
    {
        facts.journal_radius = Some(bore - clearance);
    }
    if facts.length.is_none() {
        let [left, _, right] = plan.journals[place].map(|own| {
            let node = plan.shaft.spec.nodes[own];
            plan.shaft.mesh.nodes()[node][2]
        });
        facts.length = rounded((right - left).abs()).filter(|length| *length > Rational::from(0));
    }
    facts
}

/// Mean distance of the nodes of a bore from the axis, m.
fn bore_radius(place: usize, plan: &MachinePlan) -> Option<Rational> {
    let support = &plan.support;
    let nodes = plan.bores[place].iter().flatten().map(|&own| support.spec.nodes[own]);
    let points = nodes.map(|node| {
        let [x, y, _] = support.mesh.nodes()[node];
        [x, y]
    });
    rounded(mean_radius(points)).filter(|radius| *radius > Rational::from(0))
}
