//! Points at which a law's expressions are evaluated while they are rewritten: within the ranges of its inputs,
//! and on both sides of every break.

use std::collections::BTreeMap;

use super::{LawSpec, scan};
use crate::expression::Points;

/// Points within the ranges.
const WITHIN: usize = 4;
/// Most points; and most values of nodes at points, of a law that is very long.
const MOST: usize = 32;
const EVALUATIONS: usize = 400_000;
/// Distance from a break, as a fraction of the range.
const BESIDE: f64 = 1e-4;
/// Multiples of powers of this, modulo 1, spread evenly: the inverse of the plastic number.
const PLASTIC: f64 = 0.754_877_666_246_692_8;

/// The points, for a law with its report.
pub(super) fn of(law: &LawSpec) -> Points {
    let ranges = scan::ranges(law);
    let inside = |place: usize| -> Vec<f64> {
        let mut fraction = 1.0;
        let at = |[low, high]: &[f64; 2]| {
            fraction *= PLASTIC;
            low + (high - low) * (0.37 + place as f64 * fraction).fract()
        };
        ranges.iter().map(at).collect()
    };
    let mut points: Vec<Vec<f64>> = (0..WITHIN).map(inside).collect();
    let breaks: Vec<_> = law.report.outputs.iter().flat_map(|output| &output.breaks).collect();
    // A point on each side of a break.
    let most = (EVALUATIONS / law.graph.size().max(1)).clamp(WITHIN + 2, MOST);
    let step = breaks.len().div_ceil((most - WITHIN) / 2).max(1);
    for found in breaks.into_iter().step_by(step) {
        let place_of = |name: &str| law.inputs.iter().position(|input| input.name == *name);
        let Some(crossed) = place_of(&found.input) else { continue };
        let mut point = inside(points.len());
        let mut set = |place: usize, at: f64| {
            point[place] = at * law.inputs[place].unit.factor().to_f64();
        };
        for (name, at, _) in &found.beside {
            if let Some(place) = place_of(name) {
                set(place, *at);
            }
        }
        set(crossed, found.at);
        let [low, high] = ranges[crossed];
        for side in [-BESIDE, BESIDE] {
            let mut beside = point.clone();
            beside[crossed] += side * (high - low);
            points.push(beside);
        }
    }
    let of_input = |place: usize| points.iter().map(|point| point[place]).collect();
    let given: BTreeMap<String, Vec<f64>> = (law.inputs.iter().enumerate())
        .map(|(place, input)| (input.name.clone(), of_input(place)))
        .collect();
    Points::of(given)
}
