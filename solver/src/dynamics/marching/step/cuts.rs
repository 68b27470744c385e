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

use super::SHORTEST;
use crate::dynamics::iteration::Integrator;
use crate::dynamics::marching::March;
use crate::equations::State;
use crate::error::Error;

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
