//! Where steps end at rows of tables.
//!
//! The trapezoidal rule sees of what acts over time the straight line between both ends of a step. So a step is cut at the
//! rows that it passes of a table, or at the ends of a ramp, wherever that line would miss them (`Curve::is_resolved`): each of
//! its parts then has a line of the table, or a small part of its cubic between two rows, and none is passed over, however close
//! they are.
//!
//! Times at which angles and speeds pass a row follow from the accelerations at the start of the part before it, and are met
//! to O(Δt³) of that part.

use std::sync::Arc;

use super::jumps::SHORTEST;
use super::march::March;
use super::newmark::State;
use crate::curve::Curve;
use crate::error::Error;
use crate::loads::{Load, Onset, TimeFunction};
use crate::machine::Machine;

/// A curve by which a load varies, and over what.
pub(super) struct Watched {
    curve: Arc<Curve>,
    over: Over,
    /// Whether the step at work would miss rows of it.
    missed: bool,
}

enum Over {
    Time,
    /// θ at this place of q.
    Angle(usize),
    /// Its rate.
    Speed(usize),
}

/// All curves of the loads of a machine, ramps included, each once.
pub(super) fn watched(machine: &Machine) -> Vec<Watched> {
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
    fn is_missed(&self, (t, dt): (f64, f64), state: &State) -> bool {
        !self.curve.is_resolved(self.ends(self.over.motion(t, state), dt))
    }

    fn ends(&self, [x, rate, second]: [f64; 3], dt: f64) -> [f64; 2] {
        [x, x + dt * (rate + 0.5 * dt * second)]
    }

    /// The first time after `looked` at which a row is passed by what is at `state` at time `t`, if that is before `end`.
    fn next(&self, (t, looked, end): (f64, f64, f64), state: &State) -> Option<f64> {
        let motion = self.over.motion(t, state);
        let [x, rate, second] = motion;
        let rows = self.curve.between_ends(self.ends(motion, end - t));
        let times = rows.map(|[row, _]| match self.over {
            Over::Time => row,
            _ => t + passage(row - x, rate, second),
        });
        times.filter(|time| *time > looked && *time < end).reduce(f64::min)
    }
}

/// The first time at which something has gone so far from a speed and with an acceleration; no number if it never has.
fn passage(way: f64, speed: f64, acceleration: f64) -> f64 {
    let root = (speed * speed + 2.0 * acceleration * way).sqrt();
    2.0 * way / (speed + root.copysign(way))
}

impl March<'_> {
    /// Takes a step of `dt` from time `t` in which nothing jumps, in parts where it would miss rows of tables.
    pub(super) fn smooth(&mut self, (t, dt): (f64, f64), halvings: u32) -> Result<(), Error> {
        let mut is_cut = false;
        for own in &mut self.watched {
            own.missed = own.is_missed((t, dt), &self.state);
            is_cut |= own.missed;
        }
        if !is_cut {
            return self.part((t, dt), 0, halvings);
        }
        let (near, end) = (SHORTEST * dt, t + dt);
        let (mut begun, mut looked) = (t, t);
        while looked < end {
            let missed = self.watched.iter().filter(|own| own.missed);
            let cuts = missed.filter_map(|own| own.next((begun, looked, end), &self.state));
            looked = cuts.reduce(f64::min).unwrap_or(end);
            if looked - begun > near {
                self.part((begun, looked - begun), 0, halvings)?;
                begun = looked;
            } else {
                // Rows so close to each other are a jump.
                self.jump(looked)?;
            }
        }
        Ok(())
    }
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
