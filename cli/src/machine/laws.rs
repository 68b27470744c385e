//! The laws of the bearings, with the values that the case and the meshes give them.

use whirl_codegen::diagnostic::Diagnostics;
use whirl_codegen::kinds::law::BearingValue;
use whirl_codegen::rational::Rational;
use whirl_solver::mesh::measure::mean_radius;

use crate::case::{Bearing, BearingFacts, LawSource, NamedLaw, rounded};
use crate::errors::Failure;

/// What meshes say of a bearing.
pub(super) struct Measured {
    /// Positions of the nodes of its bore about the axis, m.
    pub(super) bore: Vec<[f64; 2]>,
    /// z of the left and the right end of its journal, m.
    pub(super) ends: [f64; 2],
}

/// The law of every bearing. What the case does not say of a bearing is measured on the meshes: the radius of its
/// bore, and its length between the ends of the journal. `place`: where a case says what is missing; without it the file
/// of the law does.
///
/// # Errors
/// A value that nothing gives; whatever is wrong with a law once it has these values.
pub(super) fn laws_of(
    bearings: Vec<(&Bearing, Measured)>,
    place: Option<&str>,
) -> Result<Vec<LawSource>, Failure> {
    // Bearings that are alike share their law.
    let mut read: Vec<(&Bearing, BearingFacts, LawSource)> = Vec::new();
    let mut laws = Vec::with_capacity(bearings.len());
    let mut errors = Diagnostics::new();
    for (bearing, measured) in bearings {
        let facts = facts(bearing, &measured);
        let known = read.iter().find(|(other, own, _)| {
            // Of films what else the joint says is not told here.
            let alike = other.law.source.name() == bearing.law.source.name()
                && bearing.law.source.film().is_none();
            alike && *own == facts && other.parameters == bearing.parameters
        });
        if let Some((_, _, law)) = known {
            laws.push(law.clone());
            continue;
        }
        let lacking = place.map(|place| bearing.law.lacking(&bearing.parameters, &facts, place));
        let lacking = lacking.unwrap_or_default();
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
fn facts(bearing: &Bearing, measured: &Measured) -> BearingFacts {
    let mut facts = bearing.facts.clone();
    if facts.value(BearingValue::BoreRadius).is_none() {
        let radius = rounded(mean_radius(measured.bore.iter().copied()));
        facts.bore_radius = radius.filter(|radius| *radius > Rational::from(0));
    }
    if let (None, Some(bore), Some(clearance)) =
        (&facts.journal_radius, &facts.bore_radius, &facts.radial_clearance)
    {
        facts.journal_radius = Some(bore - clearance);
    }
    if facts.length.is_none() {
        let [left, right] = measured.ends;
        facts.length = rounded((right - left).abs()).filter(|length| *length > Rational::from(0));
    }
    facts
}
