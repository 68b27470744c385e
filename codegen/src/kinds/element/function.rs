//! Functions of the reference cell's coordinates.

use crate::diagnostic::Located;
use crate::element::Polynomial;
use crate::expression::Id;

/// A function of ξ, η, ζ.
#[derive(Debug, Clone)]
pub struct Function {
    /// Its value.
    pub value: Id,
    /// ∂/∂ξ, ∂/∂η, ∂/∂ζ.
    pub(crate) gradient: [Id; 3],
    /// The value multiplied out.
    pub(crate) polynomial: Polynomial,
    /// The gradient multiplied out.
    pub slopes: [Polynomial; 3],
    /// The formula.
    pub text: Located,
}
