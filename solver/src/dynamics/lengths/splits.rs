//! Into how many parts a step may be split, and for how many lengths of parts factors are kept.

use super::control::MOST_HALVINGS;
use crate::dynamics::iteration::NewtonOptions;

/// Lengths of parts for which factors are kept beside those in use.
pub(in crate::dynamics) const SPARE_FACTORS: usize = 4;

/// How often a part may be split, in parts of parts, that would pass rows of tables unseen: down to a millionth of it.
pub(in crate::dynamics) const MOST_SPLITS: usize = 20;

/// How often a step may be halved.
pub(in crate::dynamics) fn most_halvings(is_automatic: bool, newton: &NewtonOptions) -> u32 {
    match is_automatic {
        true => MOST_HALVINGS,
        false => newton.max_halvings as u32,
    }
}
