//! The cycle of a machine: the period after which rotation and loads are as they were.

use std::f64::consts::TAU;

use super::{Load, SystemDraft};

/// A cycle and what it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cycle {
    /// s.
    pub(super) time: f64,
    /// In messages.
    pub(super) called: &'static str,
    /// Whether loads and speeds that are constant repeat after it.
    pub(super) common: bool,
}

/// Periods of what is slowest that a common cycle has at most.
pub(super) const MOST_PERIODS: usize = 64;
/// Part of a period by which periods may miss the end of a common cycle: what an engineer writes has so many digits.
const MISSED: f64 = 1e-4;

/// The common period of rotation and loads; without one the longest period of the loads, or else two revolutions at the
/// fastest speed. Of an unbalance one revolution. None where nothing turns and no load changes.
pub(super) fn of(system: &SystemDraft) -> Option<Cycle> {
    let (loads, turns) = (frequencies(system), turns(system));
    let own = |time, called| Some(Cycle { time, called, common: true });
    let slowest = loads.iter().copied().reduce(f64::min);
    let Some(slowest) = slowest else {
        let (time, called) = revolutions(system)?;
        let fastest = turns.iter().copied().reduce(f64::max);
        // A film may whirl once in two revolutions.
        let both = common(&turns, fastest.map_or(0.0, |fastest| 0.5 * fastest));
        return match both {
            _ if turns.len() < 2 => own(time, called),
            Some(time) => own(time, "a common period of all rotations"),
            None => Some(Cycle { time, called, common: false }),
        };
    };
    let all: Vec<f64> = loads.iter().chain(&turns).copied().collect();
    let alone = (1.0 / slowest, "a period of the loads");
    match common(&all, all.iter().copied().fold(slowest, f64::min)) {
        Some(time) if time <= alone.0 * (1.0 + MISSED) => own(alone.0, alone.1),
        Some(time) if turns.is_empty() => own(time, "a common period of the loads"),
        Some(time) => own(time, "a common period of rotation and loads"),
        None => Some(Cycle { time: alone.0, called: alone.1, common: false }),
    }
}

/// The shortest time that is a whole number of periods of all `frequencies` (Hz), and of the slowest at least one of
/// `slowest`, if there is one within reason.
fn common(frequencies: &[f64], slowest: f64) -> Option<f64> {
    (1..=MOST_PERIODS).map(|k| k as f64 / slowest).find(|time| {
        let missed = frequencies.iter().map(|f| (f * time - (f * time).round()).abs());
        slowest > 0.0 && missed.fold(0.0, f64::max) <= MISSED
    })
}

/// Times within which something is given that the steps must show: the shortest period of the loads, revolutions.
pub(super) fn shortest(system: &SystemDraft) -> Vec<(f64, &'static str)> {
    let fastest = frequencies(system).into_iter().reduce(f64::max);
    let period = fastest.map(|frequency| (1.0 / frequency, "a period of the loads"));
    period.into_iter().chain(revolutions(system)).collect()
}

/// Frequencies of the loads (Hz).
fn frequencies(system: &SystemDraft) -> Vec<f64> {
    let loads: Vec<&Load> = match system {
        SystemDraft::Rotor(rotor) => rotor.loads.iter().collect(),
        SystemDraft::Lumped(_) => Vec::new(),
        SystemDraft::Joined(joined) => {
            let loads = joined.iter().flat_map(|joined| &joined.loads);
            loads.map(|own| &own.load).collect()
        }
    };
    loads.iter().filter_map(|load| load.frequency()).collect()
}

/// Revolutions a second of what turns at a constant speed in the end.
fn turns(system: &SystemDraft) -> Vec<f64> {
    let speeds = match system {
        SystemDraft::Rotor(rotor) => {
            let drive = rotor.drive.iter().filter(|drive| drive.acts);
            drive.map(|drive| drive.target_speed).collect()
        }
        SystemDraft::Joined(joined) => {
            joined.as_ref().map_or_else(Vec::new, |joined| joined.constant_speeds())
        }
        SystemDraft::Lumped(_) => Vec::new(),
    };
    speeds.iter().map(|speed| speed.abs() / TAU).filter(|turns| *turns > 0.0).collect()
}

/// Two revolutions at the speed that the drive aims at; one of an unbalance.
fn revolutions(system: &SystemDraft) -> Option<(f64, &'static str)> {
    match system {
        SystemDraft::Rotor(rotor) => {
            let drive = rotor.drive.as_ref()?;
            let aims = drive.acts && drive.target_speed != 0.0;
            let two = 2.0 * TAU / drive.target_speed.abs();
            aims.then_some((two, "a cycle of two revolutions"))
        }
        SystemDraft::Joined(joined) => {
            let fastest = joined.as_ref()?.speeds().into_iter().reduce(f64::max)?;
            Some((2.0 * TAU / fastest, "a cycle of two revolutions"))
        }
        SystemDraft::Lumped(lumped) => {
            let unbalance = lumped.as_ref()?.unbalance?;
            Some((TAU / unbalance.speed, "a revolution of the unbalance"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::common;

    #[test]
    fn the_common_period_is_the_shortest_one() {
        let near = |found: Option<f64>, expected: f64| {
            assert!(found.is_some_and(|own| (own - expected).abs() < 1e-12), "{found:?}");
        };
        near(common(&[37.5, 75.0], 37.5), 1.0 / 37.5);
        near(common(&[60.0, 75.0], 60.0), 1.0 / 15.0);
        near(common(&[200.0, 300.0], 150.0), 1.0 / 50.0);
        assert_eq!(common(&[50.0, 50.0 * 2.0_f64.sqrt()], 50.0), None);
        assert_eq!(common(&[], 0.0), None);
    }
}
