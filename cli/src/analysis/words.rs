//! What modes are called, and in which units they are shown.

use whirl_solver::linear::{LinearMachine, Mode, Whirl};
use whirl_text::{rounded, shown};

/// rad/s in rpm.
pub(super) fn rpm(speed: f64) -> f64 {
    speed * 60.0 / std::f64::consts::TAU
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

/// The bodies that move most in a mode, with their share of its inertia.
pub(super) fn movers(linear: &LinearMachine, mode: &Mode) -> String {
    let bodies = &linear.machine().bodies;
    let mut shares: Vec<(usize, f64)> = mode.shares.iter().copied().enumerate().collect();
    shares.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let large = shares.iter().filter(|(_, share)| *share >= 0.1).take(2);
    let named = large
        .map(|(body, share)| format!("{} {} %", bodies[*body].name(), (100.0 * share).round()));
    named.collect::<Vec<_>>().join(", ")
}
