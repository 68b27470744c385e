//! Speeds beside which a response may have peaks: damped critical speeds with their widths.

use super::campbell::{Campbell, Critical};
use super::range::Range;
use super::round::LinearMachine;
use crate::error::Error;

/// Damping ratio up to which it is rounding.
const UNDAMPED: f64 = 1e-7;
/// Modes beyond those that a range asks for that are looked at for critical speeds.
const MOST: usize = 100;
/// Speeds at which modes are looked for.
const SPEEDS: usize = 31;
/// Share of their half width to which critical speeds are found: peaks are looked for about them.
const WIDTH: f64 = 0.05;

/// A damped critical speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resonance {
    /// rad/s.
    pub speed: f64,
    /// Half the width over speed at half power (rad/s): ζ times the speed.
    pub half_width: f64,
}

impl Resonance {
    /// Whether it has no damping but rounding.
    pub(super) fn is_undamped(&self) -> bool {
        self.half_width <= UNDAMPED * self.speed.abs()
    }
}

impl From<&Critical> for Resonance {
    fn from(own: &Critical) -> Resonance {
        let speed = own.speed;
        Resonance { speed, half_width: speed.abs() * own.mode.damping_ratio().abs() }
    }
}

impl LinearMachine {
    /// The modes over the range of speeds for a search of peaks, whatever its speeds are: at speeds of its own between the ends,
    /// and as many modes as have a critical speed of the orders in it. Of these the [`Resonance`]s follow.
    ///
    /// # Errors
    /// As [`LinearMachine::campbell`].
    pub fn resonating(
        &self,
        range: &Range,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Campbell, Error> {
        let [Some(first), Some(last)] = [range.speeds.first(), range.speeds.last()] else {
            return self.campbell(range, goes_on);
        };
        let at = |k: usize| first + (last - first) * k as f64 / (SPEEDS - 1) as f64;
        let order = range.orders.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        let fastest = order * first.abs().max(last.abs());
        let mut count = range.count;
        for speed in [*first, *last] {
            count = count.max(self.slower_than(range, (speed, fastest), goes_on)?.min(MOST));
        }
        let mut speeds: Vec<f64> = (0..SPEEDS).map(at).collect();
        speeds[SPEEDS - 1] = *last;
        self.campbell_within((&Range { speeds, count, ..range.clone() }, WIDTH), goes_on)
    }

    /// How many modes are slower than a frequency (rad/s) at a speed; none where the machine does not stand there, or where it was
    /// asked to end.
    fn slower_than(
        &self,
        range: &Range,
        (speed, frequency): (f64, f64),
        goes_on: &dyn Fn() -> bool,
    ) -> Result<usize, Error> {
        let stood = self.stood(range, speed, None);
        match stood.and_then(|own| self.modes_while(&own.equations, MOST, goes_on)) {
            Ok(modes) => {
                Ok(modes.oscillating.iter().filter(|own| own.value.im < frequency).count())
            }
            Err(Error::Interrupted) => Ok(0),
            Err(error) if error.is_of_balance() => Ok(0),
            Err(error) => Err(error),
        }
    }
}
