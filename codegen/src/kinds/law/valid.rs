//! Where a law may be believed: measures of its inputs, each with limits. They cost nothing until they are asked for,
//! and are no part of its kernel.

use crate::expression::Id;
use crate::operation::Bytecode;
use crate::rational::Rational;
use crate::units::Unit;

/// A measure of the inputs of a law, and the limits within which the law may be believed.
#[derive(Debug, Clone)]
pub struct Validity {
    /// Name: that of its section, or of the table whose rows end.
    pub name: String,
    /// What is measured.
    pub title: String,
    /// What is wrong beyond the limits, and what to do about it.
    pub help: String,
    /// Unit in which the limits are given.
    pub unit: Unit,
    /// What is measured, as the file has it.
    pub text: String,
    /// Least and largest value at which the law may be believed, SI; infinite where there is no limit.
    pub limits: [f64; 2],
    /// The measure in the graph, SI.
    pub value: Id,
    pub(super) code: Bytecode,
    /// One of the units of the formulas in SI.
    pub(super) in_si: Rational,
}
