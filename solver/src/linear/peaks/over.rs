//! A response over speed, and what of it counts.

use crate::error::Error;

/// Share of a peak by which the response has to fall on both sides of it.
pub(super) const PROMINENT: f64 = 1e-6;

/// A response at a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplitude {
    /// In a unit of its own.
    pub own: f64,
    /// The largest one of its kind at this speed.
    pub largest: f64,
}

/// The response over speed (rad/s); none where the machine does not stand.
pub(super) type Over<'a> = dyn FnMut(f64) -> Result<Option<Amplitude>, Error> + 'a;
