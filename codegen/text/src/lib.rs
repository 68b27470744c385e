//! Text for people: the name that was meant, and numbers without the digits that rounding adds.

mod nearest;
mod number;

pub use nearest::nearest;
pub use number::{rounded, shown};
