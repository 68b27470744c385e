//! The turns of bodies that nothing elastic holds, each of which is judged by itself: of one body, or of all whose rotations joints
//! couple. What turns is the whole, L/ΣJ0 with the angular momentum L about the axis, so that no deformation rings in it.
//!
//! A turn grows without bound, and most of it says nothing: a uniform one is integrated exactly. What its errors are
//! compared with is how far it departs from a uniform one in the time in which it does so: where the speed ranges over 2V
//! and accelerations are W at most that time is V/W, the time in which W changes the speed by V, and the way V²/W. Of a swing
//! a sin ωt it is a, of a run-up that takes the time τ to a speed half of the way that it takes. It is a radian at most,
//! or what one step turns by: beyond that it matters to nothing how far a turn has gone.

use serde::{Deserialize, Serialize};

use super::masses;
use super::worst::larger;
use crate::equations::State;
use crate::machine::Machine;

/// A way that counts as none (rad): it turns no force by more than a millionth of it.
const LEAST: f64 = 1e-6;

/// A turn that is judged.
pub(in crate::dynamics) struct FreeTurn {
    /// The body, or that of several which is hardest to turn.
    pub(in crate::dynamics) body: usize,
    /// What coordinates bring to it, by their places in q.
    pub(in crate::dynamics) row: Vec<(usize, f64)>,
    /// √(ΣJ0/m) (m).
    pub(in crate::dynamics) radius: f64,
}

impl FreeTurn {
    /// Of rotations at places of q, each with its inertia and its speed, which are coupled if there are several; none of bodies
    /// without inertia.
    pub(in crate::dynamics) fn new(
        machine: &Machine,
        members: &[(usize, f64, f64)],
    ) -> Option<Self> {
        let inertia: f64 = members.iter().map(|(_, own, ratio)| own * ratio * ratio).sum();
        let hardest = members.iter().max_by(|a, b| a.1.total_cmp(&b.1))?.0;
        if !(inertia > 0.0) {
            return None;
        }
        let (mut row, mut mass) = (Vec::new(), 0.0);
        for &(theta, own, ratio) in members {
            let body = machine.owner(theta).body;
            row.push((theta, ratio * own / inertia));
            let Some(shaft) = machine.bodies[body].shaft() else { continue };
            let coupled = machine.places()[body].flexible.clone().zip(&shaft.g0);
            let coupled = coupled.filter(|(_, g)| **g != 0.0);
            row.extend(coupled.map(|(place, g)| (place, ratio * g / inertia)));
            mass += masses::mass(&machine.bodies[body], shaft);
        }
        let radius = if mass > 0.0 { (inertia / mass).sqrt() } else { 1.0 };
        Some(FreeTurn { body: machine.owner(hardest).body, row, radius })
    }

    /// Its part in a motion, by places in q.
    pub(in crate::dynamics) fn of(&self, x: impl Fn(usize) -> f64) -> f64 {
        self.row.iter().map(|(place, own)| own * x(*place)).sum()
    }
}

/// What its speeds and accelerations were, from a time on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(in crate::dynamics) struct TurnRange {
    /// From when to when (s).
    times: [f64; 2],
    /// Least and largest speed (rad/s), largest acceleration (rad/s²).
    speeds: [f64; 2],
    acceleration: f64,
}

impl TurnRange {
    /// From a time and a state on.
    pub(in crate::dynamics) fn new(turn: &FreeTurn, start: (f64, &State)) -> Self {
        let speed = turn.of(|place| start.1.v[place]);
        let mut range = TurnRange { times: [start.0; 2], speeds: [speed; 2], acceleration: 0.0 };
        range.take(turn, start);
        range
    }

    /// Takes the end of a step: a time and the state.
    pub(in crate::dynamics) fn take(&mut self, turn: &FreeTurn, (t, state): (f64, &State)) {
        self.times[1] = t;
        let [speed, acceleration] = [&state.v, &state.a].map(|own| turn.of(|place| own[place]));
        widen(&mut self.speeds, speed);
        self.acceleration = larger(self.acceleration, acceleration.abs());
    }

    /// V²/W, for steps of `dt` s at most (rad).
    pub(in crate::dynamics) fn reach(&self, dt: f64) -> f64 {
        let [least, most] = self.speeds;
        // The mean of the accelerations is one of them.
        let mean = 0.5 * (most - least) / (self.times[1] - self.times[0]);
        reach(self.speeds, larger(self.acceleration, mean), dt)
    }
}

/// V²/W of a range of speeds and an acceleration, for steps of `dt` s at most (rad).
pub(in crate::dynamics) fn reach([least, most]: [f64; 2], acceleration: f64, dt: f64) -> f64 {
    let speed = 0.5 * (most - least);
    let way = if speed == 0.0 { 0.0 } else { speed * speed / acceleration };
    let limit = (larger(most, -least) * dt).max(1.0);
    if way > limit { limit } else { larger(way, LEAST) }
}

pub(in crate::dynamics) fn widen([least, most]: &mut [f64; 2], speed: f64) {
    (*least, *most) = (-larger(-*least, -speed), larger(*most, speed));
}
