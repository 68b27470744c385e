//! Text for people: the name that was meant, and numbers without the digits that rounding adds.

mod digits;
mod nearest;

pub use digits::{as_given, rounded, shown};
pub use nearest::{nearest, nearest_in_any_case};
