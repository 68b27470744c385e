//! What the passes over a sum with a counter share: its bounds, and how much work it may make.

use std::cell::Cell;
use std::ops::RangeInclusive;

use crate::rational::Rational;
use num_traits::ToPrimitive;

use super::LIMITS;

/// Work left for the sums of one formula.
#[derive(Debug)]
pub(super) struct Budget(Cell<usize>);

impl Budget {
    pub(super) fn new() -> Self {
        Budget(Cell::new(LIMITS.repeats[1]))
    }

    /// The values of a counter, which are taken off what is left.
    ///
    /// # Errors
    /// What is wrong with the bounds, or that nothing is left.
    pub(super) fn counter(&self, ends: [Option<i64>; 2]) -> Result<RangeInclusive<i64>, String> {
        let [Some(first), Some(last)] = ends else {
            return Err("the bounds of a sum must be whole constants".to_owned());
        };
        if last < first {
            return Err(format!("this sum ends at {last}, before it starts at {first}"));
        }
        let [most, all] = LIMITS.repeats;
        let count = usize::try_from(last.abs_diff(first)).unwrap_or(usize::MAX).saturating_add(1);
        if count > most {
            return Err(format!("this sum has {count} terms; {most} are allowed"));
        }
        let left = self.0.get().checked_sub(count);
        let left = left.ok_or_else(|| {
            format!("the sums of this formula have more than {all} terms when written out")
        })?;
        self.0.set(left);
        Ok(first..=last)
    }
}

/// A whole number of moderate size.
pub(crate) fn whole(value: &Rational) -> Option<i64> {
    value.is_integer().then(|| value.to_i32()).flatten().map(i64::from)
}

/// The same of an f64.
pub(super) fn whole_f64(value: f64) -> Option<i64> {
    (value.fract() == 0.0 && value.abs() <= f64::from(i32::MAX)).then_some(value as i64)
}
