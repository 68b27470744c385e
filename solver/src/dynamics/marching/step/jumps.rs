//! Steps in which loads begin at once, or the accelerations of told rotations jump.
//!
//! The trapezoidal rule averages a jump into the step in which it is, which makes the motion wrong by O(Δt). So the step is
//! split there: its first part ends with what acts before the jump, and the accelerations start anew from what acts after it.

use super::SHORTEST;
use crate::dynamics::marching::{March, accelerate};
use crate::error::Error;

impl March<'_> {
    /// Takes a step of `dt` from time `t`, in parts where something jumps within it. `halvings`: of a step, which led to `dt`.
    pub(in crate::dynamics::marching) fn step(
        &mut self,
        t: f64,
        dt: f64,
        halvings: u32,
    ) -> Result<(), Error> {
        let (near, end) = (SHORTEST * dt, t + dt);
        let upto = |time: f64| self.jumps.partition_point(|jump| *jump <= time + near);
        let within = upto(t)..upto(end);
        if within.is_empty() {
            return self.smooth((t, dt), halvings);
        }
        let mut begun = t;
        for place in within {
            let at = self.jumps[place];
            let next = if at < end - near { at } else { end };
            let taken = if begun == t && next == end { dt } else { next - begun };
            if taken > near {
                self.equations.before = true;
                let solved = self.smooth((begun, taken), halvings);
                self.equations.before = false;
                solved?;
                begun = next;
            }
            self.jump(at.max(begun))?;
        }
        if end - begun > near { self.smooth((begun, end - begun), halvings) } else { Ok(()) }
    }

    /// Starts the accelerations anew from what acts from time `t` (s) on.
    pub(in crate::dynamics::marching) fn jump(&mut self, t: f64) -> Result<(), Error> {
        self.set_given(t, false);
        accelerate(&mut self.equations, t, &mut self.state)?;
        self.meters.jump(&self.equations);
        match &mut self.linear {
            Some(linear) => linear.begin(&mut self.equations, &self.state),
            None => Ok(()),
        }
    }
}
