//! Curves by which loads vary, and the rows of their tables that steps pass.

use std::sync::Arc;

use crate::curve::Curve;
use crate::equations::State;
use crate::loads::{Load, Onset, TimeFunction};
use crate::machine::Machine;

/// A curve by which a load varies, and over what.
pub(in crate::dynamics) struct Watched {
    curve: Arc<Curve>,
    over: Over,
    /// Whether the step at work would miss rows of it.
    pub(in crate::dynamics) missed: bool,
}

enum Over {
    Time,
    /// θ at this place of q.
    Angle(usize),
    /// Its rate.
    Speed(usize),
}

/// All curves of the loads of a machine, ramps included, each once.
pub(in crate::dynamics) fn watched(machine: &Machine) -> Vec<Watched> {
    let mut all: Vec<Watched> = Vec::new();
    let mut add = |curve: &Arc<Curve>, over: Over| {
        let is_same = |own: &Watched| own.over.is(&over) && own.curve == *curve;
        if !all.iter().any(is_same) {
            all.push(Watched { curve: curve.clone(), over, missed: false });
        }
    };
    let turns = |body: usize| machine.places()[body].rotation;
    for Load { body, time_function, onset, .. } in &machine.loads {
        if let Onset::Ramp(from, to) = *onset
            && let Ok(ramp) = Curve::linear(&[[from, 0.0], [to, 1.0]], false)
        {
            add(&Arc::new(ramp), Over::Time);
        }
        match time_function {
            TimeFunction::OverTime(curve) => add(curve, Over::Time),
            TimeFunction::OverAngle { body, curve } => {
                turns(*body).into_iter().for_each(|place| add(curve, Over::Angle(place)));
            }
            TimeFunction::OverSpeed(curve) => {
                turns(*body).into_iter().for_each(|place| add(curve, Over::Speed(place)));
            }
            _ => {}
        }
    }
    all
}

impl Over {
    fn is(&self, other: &Over) -> bool {
        match (self, other) {
            (Over::Time, Over::Time) => true,
            (Over::Angle(own), Over::Angle(other)) | (Over::Speed(own), Over::Speed(other)) => {
                own == other
            }
            _ => false,
        }
    }

    /// x, ẋ and ẍ of a curve over x at the start of a step, which begins at time `t`.
    fn motion(&self, t: f64, state: &State) -> [f64; 3] {
        match *self {
            Over::Time => [t, 1.0, 0.0],
            Over::Angle(place) => [state.q[place], state.v[place], state.a[place]],
            Over::Speed(place) => [state.v[place], state.a[place], 0.0],
        }
    }
}

impl Watched {
    /// Whether a step of `dt` from time `t` would miss rows.
    pub(in crate::dynamics) fn is_missed(&self, (t, dt): (f64, f64), state: &State) -> bool {
        self.hides(self.way(t, dt, state))
    }

    /// The way of x from a state with its ẋ and ẍ in `dt`.
    fn way(&self, t: f64, dt: f64, state: &State) -> [f64; 3] {
        let [x, rate, second] = self.over.motion(t, state);
        way([x, rate], [x + dt * (rate + 0.5 * dt * second), rate + dt * second], dt)
    }

    /// Whether straight lines along a way miss rows.
    fn hides(&self, [from, turn, to]: [f64; 3]) -> bool {
        !self.curve.is_resolved([from, turn]) || turn != to && !self.curve.is_resolved([turn, to])
    }

    /// Whether what moved in `dt` from one state to another passed rows that straight lines along its way miss.
    pub(in crate::dynamics) fn hid(&self, dt: f64, ends: [&State; 2]) -> bool {
        let [from, to] = ends.map(|state| {
            let [x, rate, _] = self.over.motion(0.0, state);
            [x, rate]
        });
        !matches!(self.over, Over::Time) && self.hides(way(from, to, dt))
    }

    /// The first time after `looked` at which a row is passed by what is at `state` at time `t`, if that is before `end`.
    pub(in crate::dynamics) fn next(
        &self,
        (t, looked, end): (f64, f64, f64),
        state: &State,
    ) -> Option<f64> {
        let [x, rate, second] = self.over.motion(t, state);
        let way = self.way(t, end - t, state);
        let ends = [f64::min, f64::max].map(|of| way.into_iter().reduce(of).unwrap_or(x));
        let rows = self.curve.between_ends(ends);
        let times = rows.map(|[row, _]| match self.over {
            Over::Time => row,
            _ => t + passage(row - x, rate, second),
        });
        times.filter(|time| *time > looked && *time < end).reduce(f64::min)
    }
}

/// Where something starts, turns back, or comes to, if it does not turn, and where it ends that has `x` and `ẋ` at both ends of
/// `dt`.
fn way([x, rate]: [f64; 2], [to, last]: [f64; 2], dt: f64) -> [f64; 3] {
    let turn = if rate * last < 0.0 { x + 0.5 * rate * dt * (rate / (rate - last)) } else { to };
    [x, turn, to]
}

/// The first time at which something has gone so far from a speed and with an acceleration; no number if it never has.
fn passage(way: f64, speed: f64, acceleration: f64) -> f64 {
    let root = (speed * speed + 2.0 * acceleration * way).sqrt();
    2.0 * way / (speed + root.copysign(way))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_passed_when_what_is_accelerated_has_come_there() {
        for (time, speed, acceleration) in
            [(0.3, 2.0, 0.0), (0.3, 2.0, 5.0), (0.1, -2.0, 5.0), (0.3, -2.0, -5.0), (0.2, 0.0, 3.0)]
        {
            let way = time * (speed + 0.5 * acceleration * time);
            let found: f64 = passage(way, speed, acceleration);
            assert!((found - time).abs() < 1e-14, "{found} for {time}");
        }
        assert!(passage(1.0, 1.0, -1.0).is_nan());
    }
}
