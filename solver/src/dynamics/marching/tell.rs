//! Telling a march between two steps what acts from there on.
//!
//! A load that jumps there begins as one whose onset is at that time: accelerations start anew from what acts behind the jump.

use super::march::March;
use crate::equations::State;
use crate::error::Error;
use crate::told::{ToldLoad, ToldTurn};

/// The amplitude of a load from the end of a step on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplitude {
    /// The load, by its place in the machine.
    pub load: usize,
    /// Along x, y, z now (N, N·m).
    pub value: [f64; 3],
    /// Its rate from now on (N/s, N·m/s).
    pub rate: [f64; 3],
}

/// The acceleration of a rotation from the end of a step on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Acceleration {
    /// The body, by its place in the machine: one whose rotation is given.
    pub body: usize,
    /// θ̈ (rad/s²).
    pub rate: f64,
}

impl March<'_> {
    /// Lets loads and rotations go on from the end of the last step as they are told, until they are told otherwise. Told
    /// amplitudes stand in place of those of the machine, multiplied by what its time functions say.
    ///
    /// # Errors
    /// A load or a body that there is not; a body whose rotation is no given one; a mass matrix that cannot be inverted.
    pub fn tell(&mut self, loads: &[Amplitude], turns: &[Acceleration]) -> Result<(), Error> {
        let now = self.time();
        let mut jumps = false;
        for told in loads {
            let Some(own) = self.machine.loads.get(told.load) else {
                return Err(Error::Machine(format!("load {} is none", told.load)));
            };
            let place = &mut self.equations.told[told.load];
            let before = place.map_or_else(|| own.action.amplitude(), |line| line.at(now));
            jumps |= before != told.value;
            *place = Some(ToldLoad { since: now, value: told.value, rate: told.rate });
        }
        for told in turns {
            let rotation = self.machine.bodies.get(told.body).and_then(|body| body.rotation());
            let theta = self.machine.places().get(told.body).and_then(|place| place.rotation);
            let Some(theta) = theta.filter(|_| rotation.is_some_and(|own| own.takes_a_couple()))
            else {
                let message = format!("body {} has no rotation that can be told", told.body);
                return Err(Error::Machine(message));
            };
            let State { q, v, a, .. } = &self.state;
            jumps |= a[theta] != told.rate;
            let line = ToldTurn { since: now, angle: q[theta], speed: v[theta], rate: told.rate };
            self.turns[theta] = Some(line);
        }
        if jumps { self.jump(now) } else { Ok(()) }
    }

    /// Angle (rad), speed (rad/s) and acceleration (rad/s²) of a body's rotation as it is given or told at time `t` (s); none of
    /// one that follows from its couples.
    pub fn given(&self, body: usize, t: f64) -> Option<[f64; 3]> {
        let theta = self.machine.places().get(body)?.rotation?;
        let told = self.turns.get(theta).copied().flatten();
        let own = || self.machine.bodies[body].rotation()?.given(t, false);
        told.map(|line| line.at(t)).or_else(own)
    }

    /// Sets the rotations that are given, or told, to what they are at time `t` (s). `before`: what jumps at this instant has
    /// not done so yet.
    pub(super) fn set_given(&mut self, t: f64, before: bool) {
        let State { q, v, a, .. } = &mut self.state;
        self.machine.set_given(t, before, [&mut *q, &mut *v, &mut *a]);
        for (theta, line) in self.turns.iter().enumerate() {
            if let Some(line) = line {
                [q[theta], v[theta], a[theta]] = line.at(t);
            }
        }
    }
}
