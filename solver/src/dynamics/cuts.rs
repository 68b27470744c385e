//! Where steps end at rows of tables.
//!
//! The trapezoidal rule sees of what acts over time the straight line between both ends of a step. So a step is cut at the
//! rows that it passes of a table, or at the ends of a ramp, wherever that line would miss them (`Curve::is_resolved`): each of
//! its parts then has a line of the table, or a small part of its cubic between two rows, and none is passed over, however close
//! they are.
//!
//! Times at which angles and speeds pass a row follow from the accelerations at the start of the part before it, and are met
//! to O(Δt³) of that part. Where a couple is so large that they are not, a part may pass rows all the same, or be thrown back over
//! them by what it saw of the first: it is taken in halves until it sees them.
//!
//! Parts of a step that is cut are those of the average acceleration, whatever the method: what generalized-α carries from part
//! to part is the slope of the acceleration, and that of a pulse says nothing of the part behind it.

use std::sync::Arc;

use super::jumps::SHORTEST;
use super::march::March;
use super::newmark::Integrator;
use crate::curve::Curve;
use crate::equations::State;
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
    fn hid(&self, dt: f64, ends: [&State; 2]) -> bool {
        let [from, to] = ends.map(|state| {
            let [x, rate, _] = self.over.motion(0.0, state);
            [x, rate]
        });
        !matches!(self.over, Over::Time) && self.hides(way(from, to, dt))
    }

    /// The first time after `looked` at which a row is passed by what is at `state` at time `t`, if that is before `end`.
    fn next(&self, (t, looked, end): (f64, f64, f64), state: &State) -> Option<f64> {
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

impl March<'_> {
    /// Whether a part of `dt` from `start`, just solved, passed rows over an angle or a speed unseen.
    pub(super) fn hides_rows(&self, dt: f64, start: &State) -> bool {
        dt > SHORTEST * SHORTEST * self.options.time_step
            && self.watched.iter().any(|own| own.hid(dt, [start, &self.state]))
    }

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
        self.begin_cut();
        let done = self.cut((t, dt), halvings);
        self.end_cut();
        done
    }

    /// Takes a step of `dt` from time `t` in parts that end at the rows that it would miss.
    fn cut(&mut self, (t, dt): (f64, f64), halvings: u32) -> Result<(), Error> {
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

    fn begin_cut(&mut self) {
        if !self.integrator.is_direct() {
            self.state.lag.fill(0.0);
            self.state.laws.lag.fill(0.0);
            self.newton.forget_factors();
            self.integrator = Integrator::default();
        }
    }

    /// What is kept of steps is that of the method of the march.
    fn end_cut(&mut self) {
        if self.integrator != self.options.integrator {
            self.newton.forget_factors();
            self.integrator = self.options.integrator;
        }
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
