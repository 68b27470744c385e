//! Values of parameters as people write them.

use whirl_codegen::kinds::law::Given;
use whirl_codegen::rational::{Rational, nearest};

/// Values as people write them: `c = 0.04 mm, R = 20 mm`.
pub(super) fn listed(given: &[Given]) -> String {
    let one = |given: &Given| {
        let Given { name, value, unit } = given;
        match unit.text() {
            "1" => format!("{name} = {}", written(value)),
            unit => format!("{name} = {} {unit}", written(value)),
        }
    };
    given.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// All digits that its nearest number has.
pub(super) fn written(value: &Rational) -> String {
    whirl_text::shown(nearest(value), 17, 1e-4..1e7)
}
