//! Stops: on which side of what strikes them they stand, and what fits there.

use whirl_codegen::diagnostic::Code;
use whirl_codegen::document::Table;
use whirl_codegen::kinds::law::{Acts, BearingValue, Parameter};
use whirl_codegen::rational::Rational;
use whirl_codegen::units::Quantity;

use super::law::NamedLaw;
use super::parameters;

/// The side on which a stop stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// Towards greater x.
    Above,
    /// Towards smaller x.
    Below,
    /// In all directions of x and y.
    Around,
}

/// On which side a stop stands.
pub(super) fn side(table: &Table) -> Side {
    match table.optional_word("side") {
        Some("around") => Side::Around,
        Some("below") => Side::Below,
        _ => Side::Above,
    }
}

/// The radial clearance that the case gives the law of a ring, in m; a `gap` that the law has no use for is
/// noted.
pub(super) fn around(table: &Table, law: &NamedLaw, gap: Option<&Quantity>) -> Option<Rational> {
    let gap = gap?;
    // That a law of springs cannot stand all around, is noted elsewhere.
    if law.source.acts() != Acts::Ring {
        return None;
    }
    let of = |parameter: &Parameter| {
        matches!(
            parameter.bearing,
            Some(BearingValue::RadialClearance | BearingValue::DiametralClearance)
        )
    };
    let (message, help) = if !law.source.parameters().iter().any(of) {
        let message = "a stop all around has no `gap` of its own: it is in its law";
        let help = "leave `gap` out; or mark in the law which of its parameters is the gap: \
                    `bearing = \"radial_clearance\"`";
        (message, help)
    } else if gap.si() <= 0.0 {
        ("`gap` must be greater than zero all around", "such as `gap = \"35 um\"`")
    } else {
        return Some(parameters::exactly(gap));
    };
    table.push(table.written("gap").error_here(Code::BAD_VALUE, message).help(help));
    None
}

/// Notes a law of springs all around, or one of rings on one side of it.
pub(super) fn fits(stop: &Table, side: Side, law: &NamedLaw) {
    let acts = law.source.acts();
    let wanted = if side == Side::Around { Acts::Ring } else { Acts::Spring };
    if acts != wanted {
        let message =
            format!("`{}` is {}, not {}", law.name.text(), acts.called(), wanted.called());
        let help = match side {
            Side::Around => {
                "write `side = \"above\"` or `\"below\"`, or name a law that gives F_x and F_y"
            }
            _ => "write `side = \"around\"`, or name a law that gives Q",
        };
        stop.push(law.name.error_here(Code::BAD_VALUE, message).help(help));
    }
}
