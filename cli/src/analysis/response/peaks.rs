//! Peaks of the points over speed, by what makes them move.

use std::collections::BTreeMap;

use whirl_solver::Error;
use whirl_solver::linear::{LinearMachine, Peaks, Point, Range, Resonance, Standstill};

use super::source::Source;
use crate::analysis::peaked::{Readings, notes, standing};
use crate::analysis::words;
use crate::case::Analysis;
use crate::signals::Interruption;

/// Over which speeds of which body peaks are sought.
pub(super) struct Over<'a> {
    pub(super) of: usize,
    /// Ends of the range (rad/s).
    pub(super) ends: [f64; 2],
    pub(super) analysis: &'a Analysis,
    /// By bodies how fast they turn over the speed of that body.
    pub(super) ratios: &'a [f64],
}

/// Finds the peaks of some sources, and what is said of them: of which they are sought, and of which something is said.
///
/// # Errors
/// Those of the machine at the speeds.
pub(super) fn find(
    linear: &LinearMachine,
    points: &[Point],
    sources: &mut [Source],
    over: &Over,
    (sought, told): (&dyn Fn(&Source) -> bool, &dyn Fn(&Source) -> bool),
    interruption: &Interruption,
) -> Result<String, Error> {
    let order = |own: &Source| own.order * over.ratios[own.body];
    let mut orders: Vec<f64> = sources.iter().filter(|own| sought(own)).map(order).collect();
    orders.sort_by(f64::total_cmp);
    orders.dedup();
    if orders.is_empty() {
        return Ok(String::new());
    }
    let Over { of, ends, analysis, .. } = *over;
    let range = Range {
        of,
        speeds: ends.to_vec(),
        ratios: analysis.ratios.clone(),
        count: analysis.count,
        orders,
    };
    let campbell = linear.resonating(&range, &|| !interruption.asked())?;
    let mut text = String::new();
    if campbell.growing.iter().any(Option::is_some) {
        text += &words::thresholds(linear, &campbell);
        text += "where the machine is not stable this response is not reached: something grows\n";
    }
    // What can be compared: motions of journals in their bores, and motions in space.
    let kind = |point: &Point| usize::from(point.name.starts_with("joint."));
    let mut bodies: Vec<usize> = sources.iter().map(|own| own.body).collect();
    bodies.dedup();
    for body in bodies {
        let places: Vec<usize> = (0..sources.len())
            .filter(|&own| sources[own].body == body && sought(&sources[own]))
            .collect();
        let wanted: Vec<f64> = places.iter().map(|&own| sources[own].order).collect();
        let mut near: Option<Standstill> = None;
        let mut at = |speed: f64| -> Result<Option<Vec<f64>>, Error> {
            if interruption.asked() {
                return Ok(None);
            }
            let speeds = linear.speeds(of, speed, &analysis.ratios);
            let Some(here) = standing(linear.standing(&speeds, near.as_ref()))? else {
                return Ok(None);
            };
            if linear.turning().any(|body| !linear.responds_at(&here, here.speeds[body])) {
                return Ok(None);
            }
            let equations = linear.linearised(&here)?;
            let Some(all) = standing(linear.response((&here, &equations), body, points))? else {
                return Ok(None);
            };
            near = Some(here);
            let all: BTreeMap<u64, Vec<f64>> = all
                .into_iter()
                .map(|(order, own)| {
                    (order.to_bits(), own.iter().map(|own| own.orbit().major).collect())
                })
                .collect();
            // What is small beside the other orders is left out of a response.
            let of_order = |order: &f64| {
                all.get(&order.to_bits()).cloned().unwrap_or_else(|| vec![f64::NAN; points.len()])
            };
            Ok(Some(wanted.iter().flat_map(of_order).collect()))
        };
        let kinds =
            (0..places.len()).flat_map(|own| points.iter().map(move |at| 2 * own + kind(at)));
        let mut readings = Readings::new(kinds.collect(), &mut at);
        for (number, &place) in places.iter().enumerate() {
            let own = order(&sources[place]);
            let resonances: Vec<Resonance> = (campbell.criticals.iter())
                .filter(|critical| critical.order == own)
                .map(Resonance::from)
                .collect();
            let found = (0..points.len())
                .map(|point| readings.peaks(number * points.len() + point, &resonances, ends))
                .collect::<Result<Vec<Peaks>, Error>>()?;
            if told(&sources[place]) && !interruption.asked() {
                let what = match sources.len() {
                    1 => String::new(),
                    _ => {
                        let name = linear.machine().bodies[body].name();
                        format!("order {} of {name}: ", sources[place].order)
                    }
                };
                let named = points.iter().map(|own| own.name.as_str()).zip(&found);
                text += &notes(&what, &named.collect::<Vec<_>>());
            }
            sources[place].peaks = found.into_iter().map(|own| own.all).collect();
        }
    }
    Ok(text)
}
