//! The cycle of a machine: the period after which rotation and loads are as they were.

use std::f64::consts::TAU;

use whirl_solver::loads::TimeFunction;

use super::joined_machine::JoinedMachine;
use super::loads::Load;
use super::named_body::NamedBody;
use super::run::Run;

/// A cycle and what it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cycle {
    /// s.
    pub(super) time: f64,
    /// In messages.
    pub(super) called: &'static str,
    /// Whether loads and speeds that are constant repeat after it.
    pub(super) common: bool,
    /// Whether it is that of a speed at which a couple only aims.
    pub(super) aimed: bool,
}

/// Periods of what is slowest that a common cycle has at most.
pub(super) const MOST_PERIODS: usize = 64;
/// What the cycle is of what turns without a load that repeats in time.
pub(crate) const TWO_REVOLUTIONS: &str = "two revolutions";
/// Part of a period by which periods may miss the end of a common cycle: what an engineer writes has so many digits.
const MISSED: f64 = 1e-4;

/// The common period of rotation and loads; without one the longest period of the loads, or else two revolutions at the
/// fastest speed.  None where nothing turns and no load changes.
pub(super) fn of(machine: &JoinedMachine, run: Run) -> Option<Cycle> {
    let (mut loads, turns) = (frequencies(machine), turns(machine, run));
    loads.extend(of_tables_over_time(machine));
    let over_angles = over_angles(machine, run);
    let own = |time, called| Some(Cycle { time, called, common: true, aimed: false });
    let least = |all: &[f64]| all.iter().copied().reduce(f64::min);
    let all: Vec<f64> = loads.iter().chain(&over_angles).chain(&turns).copied().collect();
    let Some(slowest) = least(&loads) else {
        let (time, called) = revolutions(machine, |body| machine.top_speed(body, run))?;
        let told = revolutions(machine, |body| machine.told_speed(body, run));
        let aimed = told.is_none_or(|(told, _)| told > time);
        let fastest = turns.iter().copied().reduce(f64::max);
        // A film may whirl once in two revolutions.
        let whirl = fastest.map_or(0.0, |fastest| 0.5 * fastest);
        let both = common(&all, least(&over_angles).map_or(whirl, |own| own.min(whirl)));
        let own = |time, called| Some(Cycle { time, called, common: true, aimed });
        return match both {
            _ if turns.is_empty() => own(time, called),
            Some(time) if turns.len() == 1 && time <= (1.0 + MISSED) / whirl => own(time, called),
            Some(time) if over_angles.is_empty() => own(time, "a common period of all rotations"),
            Some(time) => own(time, "a common period of rotation and loads"),
            None => Some(Cycle { time, called, common: false, aimed }),
        };
    };
    let alone = (1.0 / slowest, of_loads(machine));
    match common(&all, least(&all).unwrap_or(slowest)) {
        Some(time) if time <= alone.0 * (1.0 + MISSED) => own(alone.0, alone.1),
        Some(time) if turns.is_empty() => own(time, "a common period of the loads"),
        Some(time) => own(time, "a common period of rotation and loads"),
        None => Some(Cycle { time: alone.0, called: alone.1, common: false, aimed: false }),
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

/// Times within which something is given that the steps must show, with what they are: the shortest period of the loads in
/// time, of those over an angle at the fastest that it turns, and revolutions: not those of a speed at which a couple only aims,
/// which may stand for never.
pub(super) fn shortest(machine: &JoinedMachine, run: Run) -> Vec<(f64, String)> {
    let fastest = |all: Vec<f64>| all.into_iter().reduce(f64::max);
    let period = fastest(frequencies(machine)).map(|own| (1.0 / own, of_loads(machine).into()));
    let table = fastest(of_tables_over_time(machine));
    let table = table.map(|own| (1.0 / own, "a period of a table over time".into()));
    let over_angle = periods_by_speed(machine, |body| Some(machine.top_speed(body, run)));
    let over_angle = over_angle.into_iter().reduce(|a, b| if b.0 > a.0 { b } else { a });
    let over_angle = over_angle.map(|(frequency, speed)| {
        let rpm = whirl_text::shown(speed * 60.0 / TAU, 6, 1e-3..1e7);
        (1.0 / frequency, format!("a period of a load over an angle at {rpm} rpm"))
    });
    let told = |body| machine.told_speed(body, run);
    let turns = revolutions(machine, told).map(|(time, called)| (time, called.to_owned()));
    [period, table, over_angle, turns].into_iter().flatten().collect()
}

fn loads(machine: &JoinedMachine) -> impl Iterator<Item = &Load> {
    machine.loads.iter().map(|own| &own.load)
}

/// Frequencies of the loads that are sines in time, the unbalance of a mass among them (Hz).
fn frequencies(machine: &JoinedMachine) -> Vec<f64> {
    let spins = machine.bodies.iter().filter_map(NamedBody::spin).map(|speed| speed / TAU);
    loads(machine).filter_map(Load::frequency).chain(spins).collect()
}

/// What a period of these is called.
fn of_loads(machine: &JoinedMachine) -> &'static str {
    if machine.is_mass() { "a revolution of the unbalance" } else { "a period of the loads" }
}

/// Of periodic tables over time (Hz). What happens within a period, and how fast, is no matter of the cycle.
fn of_tables_over_time(machine: &JoinedMachine) -> Vec<f64> {
    let all = loads(machine);
    let columns = all.filter_map(|load| match (&load.time_function, &load.table) {
        (TimeFunction::OverTime(_), Some((columns, true))) => Some(1.0 / columns.span()),
        _ => None,
    });
    columns.collect()
}

/// Of loads that follow the angle of what turns at a constant speed in the end, by an order or a periodic table (Hz).
fn over_angles(machine: &JoinedMachine, run: Run) -> Vec<f64> {
    let all = periods_by_speed(machine, |body| machine.constant_speed(body, run));
    all.into_iter().map(|(frequency, _)| frequency).collect()
}

/// Frequencies (Hz) of loads that follow an angle, by an order or a periodic table, at the speeds (rad/s) of bodies.
fn periods_by_speed(
    machine: &JoinedMachine,
    speed: impl Fn(usize) -> Option<f64>,
) -> Vec<(f64, f64)> {
    let all = loads(machine).filter_map(|load| {
        // Periods of the load in a revolution.
        let order = match (&load.time_function, &load.table) {
            (TimeFunction::Order { order, .. }, _) => order.abs(),
            (TimeFunction::OverAngle { .. }, Some((columns, true))) => TAU / columns.span(),
            _ => return None,
        };
        let speed = speed(load.followed()?)?.abs();
        Some((order * speed / TAU, speed))
    });
    all.filter(|(frequency, _)| *frequency > 0.0).collect()
}

/// Revolutions a second of what turns at a constant speed in the end.
fn turns(machine: &JoinedMachine, run: Run) -> Vec<f64> {
    let speeds = (0..machine.bodies.len()).filter_map(|body| machine.constant_speed(body, run));
    speeds.map(|speed| speed.abs() / TAU).filter(|turns| *turns > 0.0).collect()
}

/// Two revolutions at the fastest speed of the run.
fn revolutions(
    machine: &JoinedMachine,
    speed: impl Fn(usize) -> f64,
) -> Option<(f64, &'static str)> {
    let fastest = (0..machine.bodies.len()).map(speed).fold(0.0, f64::max);
    (fastest > 0.0).then_some((2.0 * TAU / fastest, TWO_REVOLUTIONS))
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
