//! A column of a history: what it is called and what it means.

use std::borrow::Cow;

/// A column of a history.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Its name, with the unit as files can have it, such as `omega_rad_s`.
    pub name: String,
    /// Its unit, such as `rad/s`; 1 of a number without one.
    pub unit: Cow<'static, str>,
    /// What it is.
    pub meaning: String,
}

impl Column {
    pub(crate) fn new(
        name: impl Into<String>,
        unit: impl Into<Cow<'static, str>>,
        meaning: impl Into<String>,
    ) -> Self {
        Column { name: name.into(), unit: unit.into(), meaning: meaning.into() }
    }
}
