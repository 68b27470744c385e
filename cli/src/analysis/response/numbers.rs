//! What a response comes to in numbers: the largest amplitude of every point, and its peaks.

use whirl_solver::linear::{LinearMachine, Point};

use super::source::Source;
use crate::analysis::facts::Facts;
use crate::analysis::words;

/// Of all points, by what makes them move where that is not the order 1 of the only body that turns.
pub(super) fn facts(
    linear: &LinearMachine,
    points: &[Point],
    (speeds, sources): (&[f64], &[Source]),
) -> Facts {
    let mut facts = Facts::default();
    let several = linear.turning().count() > 1;
    for source in sources {
        let body = linear.machine().bodies[source.body].name();
        let mut head = if several { format!("{body}.") } else { String::new() };
        if source.order != 1.0 {
            head += &format!("{}X.", source.order);
        }
        for (place, point) in points.iter().enumerate() {
            let name = format!("{head}{}", point.name);
            let listed = speeds.iter().zip(&source.motions);
            let listed = listed.map(|(speed, own)| (own[place].orbit().major, *speed));
            let peaks = &source.peaks[place];
            // What grows without limit has no number.
            let finite = |value: f64| if value.is_finite() { value } else { f64::NAN };
            let damped = peaks.iter().filter(|own| !own.is_undamped());
            let all = listed.chain(damped.map(|own| (own.height, own.speed)));
            let most = all.reduce(|most, own| if own.0 > most.0 { own } else { most });
            facts.put(format!("{name}.amplitude_um"), most.map(|own| 1e6 * own.0));
            facts.put(format!("{name}.amplitude_rpm"), most.map(|own| words::rpm(own.1)));
            let rpm = peaks.iter().map(|own| words::rpm(own.speed));
            facts.each(&format!("{name}.peak_rpm."), rpm);
            facts.each(
                &format!("{name}.peak_um."),
                peaks.iter().map(|own| finite(1e6 * own.height)),
            );
            let factors = peaks.iter().map(|own| own.amplification().map_or(f64::NAN, finite));
            facts.each(&format!("{name}.amplification_factor."), factors);
        }
    }
    facts
}
