//! Orbits of the whole machine in space, at peaks and at some of the speeds.

use whirl_solver::Error;
use whirl_solver::linear::{LinearMachine, Standstill};

use super::source::Source;
use crate::analysis::peaked::standing;
use crate::analysis::space::{InSpace, SPEEDS, Told, evenly};
use crate::analysis::words;
use crate::signals::Interruption;

/// Speeds nearer than this share are one peak, seen at several points.
const SAME: f64 = 2e-3;

/// The state at a speed of the analysis, from one nearby.
type At<'a> = dyn Fn(f64, Option<&Standstill>) -> Result<Standstill, Error> + 'a;

/// Adds them by the bodies and orders that make them.
///
/// # Errors
/// Those of the machine at the speeds.
pub(super) fn add(
    (linear, at): (&LinearMachine, &At),
    (speeds, sources): (&[f64], &[&Source]),
    interruption: &Interruption,
    space: &mut InSpace,
) -> Result<(), Error> {
    for source in sources.iter().filter(|own| own.order != 0.0) {
        let body = linear.machine().bodies[source.body].name();
        let group = format!("{}X of {body}", source.order);
        let mut wanted: Vec<(f64, &str)> = Vec::new();
        let mut peaks: Vec<(f64, f64)> = source
            .peaks
            .iter()
            .flatten()
            .filter(|own| !own.is_undamped())
            .map(|own| (own.speed, own.height))
            .collect();
        // The highest of those that are one.
        peaks.sort_by(|a, b| b.1.total_cmp(&a.1));
        for (speed, _) in peaks {
            if !wanted.iter().any(|own| (own.0 - speed).abs() <= SAME * speed.abs()) {
                wanted.push((speed, "peak, "));
            }
        }
        wanted.sort_by(|a, b| a.0.total_cmp(&b.0));
        wanted.extend(evenly(speeds, SPEEDS).into_iter().map(|speed| (*speed, "")));
        for (speed, what) in wanted {
            if interruption.asked() || space.room() == 0 {
                return Ok(());
            }
            let excited = standing(at(speed, None).and_then(|here| {
                let equations = linear.linearised(&here)?;
                let excited = linear.excited((&here, &equations), source.body)?;
                Ok((here, excited))
            }))?;
            let Some((here, excited)) = excited else { continue };
            let all = excited.by_orders();
            let Some((order, shape)) = all.iter().find(|own| own.0 == source.order) else {
                continue;
            };
            let turns = here.speeds[source.body];
            let told = Told {
                group: group.clone(),
                name: format!("{what}{} rpm", words::speed(speed)),
                rpm: Some(words::rpm(speed)),
                hertz: (order * turns / std::f64::consts::TAU).abs(),
            };
            space.response((linear, &here), shape, (source.body, turns), told);
        }
    }
    Ok(())
}
