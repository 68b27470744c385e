//! What modes are called, and in which units they are shown.

use std::f64::consts::TAU;
use std::fmt::Write;

use whirl_solver::linear::{
    Campbell, Doubt, Growing, LinearMachine, Mode, Modes, Threshold, Way, Whirl,
};
use whirl_text::{as_given, rounded, shown};

use crate::case::Case;

/// A joint by its name; bearings of a shaft in its support have numbers.
pub(super) fn joint(label: &str) -> String {
    let numbered = label.bytes().all(|own| own.is_ascii_digit());
    if numbered { format!("bearing {label}") } else { label.to_owned() }
}

/// rad/s in rpm.
pub(super) fn rpm(speed: f64) -> f64 {
    as_given(speed * 60.0 / TAU)
}

/// A speed for people (rpm).
pub(super) fn speed(speed: f64) -> String {
    shown(rpm(speed), 6, 1e-3..1e7)
}

/// A frequency for people (Hz).
pub(super) fn hertz(mode: &Mode) -> String {
    rounded(mode.hertz(), 6).to_string()
}

/// Logarithmic decrement for people.
pub(super) fn decrement(mode: &Mode) -> String {
    plain(mode.log_decrement())
}

/// Damping ratio for people.
pub(super) fn damping(mode: &Mode) -> String {
    plain(mode.damping_ratio())
}

/// Four digits, without a sign on what is zero but for rounding.
fn plain(value: f64) -> String {
    if value.abs() < 1e-9 { "0".to_owned() } else { shown(value, 4, 1e-4..1e4) }
}

/// How a mode whirls against the body that turns at a speed.
pub(super) fn whirl(mode: &Mode, speed: f64) -> &'static str {
    match mode.whirl(speed) {
        Whirl::Forward => "forward",
        Whirl::Backward => "backward",
        Whirl::None => "-",
    }
}

/// Which way a mode moves.
pub(super) fn way(way: Way) -> &'static str {
    match way {
        Way::Lateral => "lateral",
        Way::Axial => "axial",
        Way::Torsional => "torsional",
    }
}

/// How a mode whirls, or which way it moves where it does not.
pub(super) fn whirl_or_way(whirl: &'static str, own: Way) -> &'static str {
    match (whirl, own) {
        ("-", Way::Axial | Way::Torsional) => way(own),
        _ => whirl,
    }
}

/// The bodies that move most in a mode, with their share of its inertia.
pub(super) fn movers(linear: &LinearMachine, mode: &Mode) -> String {
    most(linear, &mode.shares)
}

/// A motion that grows, with its bodies.
pub(super) fn growing(linear: &LinearMachine, own: &Growing) -> String {
    let (rate, bodies) = (plain(own.value.re), most(linear, &own.shares));
    let what = match own.value.im {
        0.0 => "a motion without oscillation".to_owned(),
        frequency => format!("a motion of {} Hz", rounded(frequency / TAU, 6)),
    };
    format!("{what} grows by {rate} 1/s ({bodies})")
}

/// That a machine is not stable, and the motion that grows fastest, if one does.
pub(super) fn not_stable(linear: &LinearMachine, modes: &Modes) -> Option<String> {
    let fastest = growing(linear, modes.growing.first()?);
    let more = match modes.growing.len() - 1 {
        0 => String::new(),
        1 => ", and another one grows".to_owned(),
        more => format!(", and {more} others grow"),
    };
    Some(format!("the machine is NOT STABLE in this state: {fastest}{more}"))
}

/// The bodies with the largest shares.
pub(super) fn most(linear: &LinearMachine, shares: &[f64]) -> String {
    let bodies = &linear.machine().bodies;
    let mut shares: Vec<(usize, f64)> = shares.iter().copied().enumerate().collect();
    shares.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let large = shares.iter().filter(|(_, share)| *share >= 0.1).take(2);
    let named = large
        .map(|(body, share)| format!("{} {} %", bodies[*body].name(), (100.0 * share).round()));
    named.collect::<Vec<_>>().join(", ")
}

/// Share of the largest part from which another one is named.
const NAMED: f64 = 0.05;

/// Frequencies (Hz) with which a mode moves besides, where a body is not round, largest parts first.
pub(super) fn beside(mode: &Mode) -> String {
    let mut parts: Vec<(f64, f64)> =
        mode.beside.iter().copied().filter(|own| own.1 > NAMED).collect();
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let hertz = parts.iter().map(|own| (own.0 / TAU).to_string());
    hertz.collect::<Vec<_>>().join(" ")
}

/// What limits the worth of modes, a line each.
pub(super) fn doubts(all: &[Doubt]) -> String {
    all.iter().map(|own| format!("note: {own}\n")).collect()
}

/// Which joints have coefficients over the frequency, and at which they are here, if there are any.
pub(super) fn at_the_speed(linear: &LinearMachine) -> String {
    let joints = linear.over_frequency();
    if joints.is_empty() {
        return String::new();
    }
    format!(
        "note: coefficients of {} depend on the frequency: these are those at the frequency of the rotation\n",
        joints.join(", ")
    )
}

/// Which joints have laws with states, whose forces at a frequency are others, if there are any.
pub(super) fn stateful(linear: &LinearMachine) -> String {
    let joints = linear.with_states();
    if joints.is_empty() {
        return String::new();
    }
    format!(
        "note: the laws of {} have states: the table is of motions that are slow beside these, at 0 Hz, without what the states do against faster ones; \
         modes, responses and runs have all of it\n",
        joints.join(", ")
    )
}

/// Which joints read sensors, whose forces by what these read are no coefficients, if there are any.
pub(super) fn sensed(case: &Case) -> String {
    let joints = case.machine.joints.iter().filter(|own| own.sensor.is_some());
    let joints: Vec<&str> = joints.map(|own| own.called.word.as_str()).collect();
    if joints.is_empty() {
        return String::new();
    }
    format!(
        "note: these are forces by the displacement of the journals alone: what {} make of the readings of their sensors counts in modes, \
         responses and runs\n",
        joints.join(", ")
    )
}

/// Heads of stiffness and damping in the plane, for people.
pub(super) const OF_PLANE: [&str; 8] =
    ["k_xx (N/m)", "k_xy", "k_yx", "k_yy", "c_xx (N s/m)", "c_xy", "c_yx", "c_yy"];

/// Where modes begin or end to grow, whether the machine is stable, and speeds at which it does not stand; of a range that was
/// interrupted, as far as it was reached.
pub(super) fn thresholds(linear: &LinearMachine, all: &Campbell) -> String {
    let mut text = String::new();
    for own in &all.thresholds {
        let how = match (&own.mode, &own.other) {
            (Some(mode), _) => {
                let share = rounded(mode.value.im / own.speed.abs(), 4);
                let whirl = whirl(mode, own.speed);
                let jump = own.before.as_ref().map_or(String::new(), |before| {
                    let (from, to) = (decrement(before), decrement(mode));
                    format!(
                        "; its log decrement jumps between {from} and {to} there, as a film or a contact changes at once"
                    )
                });
                format!("{} Hz, {share} of the rotation, {whirl}{jump}", hertz(mode))
            }
            (None, Some(other)) => growing(linear, other),
            (None, None) => "without oscillation".to_owned(),
        };
        let what = match (own.grows, own.others) {
            (true, false) => "UNSTABLE",
            (true, true) => "a further motion becomes unstable",
            (false, false) => "stable",
            (false, true) => "one motion stops growing, others do not,",
        };
        let _ = writeln!(text, "{what} above {} rpm: {how}", speed(own.speed));
    }
    let grow = all.growing.iter().zip(&all.speeds);
    let grow = grow.filter_map(|(own, speed)| Some((own.as_ref()?, *speed)));
    let fastest = grow.max_by(|a, b| a.0.value.re.total_cmp(&b.0.value.re));
    let fastest = fastest.map_or(String::new(), |(own, at)| {
        format!("at {} rpm {}", speed(at), growing(linear, own))
    });
    match all.growing.iter().flatten().count() {
        0 if !all.thresholds.is_empty() => {}
        0 if all.interrupted => {
            let ends = [all.speeds.first(), all.speeds.last()];
            let [from, to] = ends.map(|own| own.map_or(String::new(), |own| speed(*own)));
            let _ = writeln!(text, "stable from {from} to {to} rpm, where it was interrupted");
        }
        0 if all.lost.is_empty() => text.push_str("stable at all these speeds\n"),
        0 => text.push_str("stable at all of these speeds at which there is an equilibrium\n"),
        some if some == all.speeds.len() => {
            text.insert_str(0, &format!("UNSTABLE at all these speeds: {fastest}\n"));
        }
        _ if all.interrupted => {
            text.push_str("interrupted: thresholds between these speeds may be missing\n");
        }
        // Thresholds of further motions alone do not say that something grew before.
        some if !all.thresholds.iter().any(|own| own.grows && !own.others) => {
            let of = all.speeds.len();
            text.insert_str(0, &format!("UNSTABLE at {some} of these {of} speeds: {fastest}\n"));
        }
        _ => {}
    }
    if let Some((_, error)) = all.lost.last() {
        let speeds: Vec<String> = all.lost.iter().map(|own| speed(own.0)).collect();
        let _ = writeln!(text, "left out: {} rpm, as {error}", speeds.join(", "));
    }
    text
}

/// What a threshold is, as files say it.
pub(super) fn threshold(own: &Threshold) -> &'static str {
    match (own.grows, own.others) {
        (true, false) => "unstable above",
        (false, false) => "stable above",
        (true, true) => "one more grows above",
        (false, true) => "one less grows above",
    }
}

/// The same as rows of a file.
pub(super) fn thresholds_file(all: &Campbell) -> String {
    let mut text = String::from("what,speed_rpm,frequency_hz,whirl\n");
    for own in &all.thresholds {
        let what = threshold(own);
        let how = match (&own.mode, &own.other) {
            (Some(mode), _) => format!("{},{}", mode.hertz(), whirl(mode, own.speed)),
            (None, Some(other)) if other.value.im > 0.0 => format!("{},", other.value.im / TAU),
            _ => ",".to_owned(),
        };
        writeln!(text, "{what},{},{how}", rpm(own.speed)).expect("text can be written");
    }
    text
}
