//! Text for people: the name that was meant, and numbers without the digits that rounding adds.

mod nearest;
mod number;

pub use nearest::{nearest, nearest_in_any_case};
pub use number::{rounded, shown};
