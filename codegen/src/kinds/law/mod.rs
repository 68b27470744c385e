//! Bearing laws: named inputs to named outputs, in pieces, with units; read, checked, lowered and
//! differentiated.
//!
//! ```toml
//! kind = "law"
//! name = "hu2003-linear"
//! title = "…"
//! source = "paper and equation"
//!
//! [inputs.h]
//! unit = "mm"
//!
//! [parameters.c0]
//! value = 0.035687
//! unit = "mm"
//!
//! [outputs.Q]
//! unit = "N"
//! engage = "root"
//! pieces = [
//!   { when = 'h < c0', value = '233 - 6517*h' },
//!   { value = '0' },
//! ]
//! ```
//!
//! A law that remembers has states with rates of their own; for all that is derived, proved and evaluated a state
//! is one more input and its rate one more output:
//!
//! ```toml
//! [states.s]
//! unit = "mm"
//! start = "rest"
//!
//! [rates]
//! s = '(x - s)/tau'
//! ```
//!
//! Formulas work in the units of the file: a bare number takes the unit that its place wants, a parameter
//! is converted to the system of the inputs' and outputs' units. Kernels work in SI.

mod acts;
mod analysis;
mod bearing;
mod blend;
mod branch;
mod build;
mod describe;
mod draft;
mod equations;
mod exact;
mod explain;
mod findings;
mod kernels;
mod limits;
mod lint;
mod points;
mod poles;
mod program;
mod region;
mod report;
mod root;
mod scan;
mod schema;
mod spec;
mod system;
mod table;
mod valid;

use std::sync::Arc;

pub use acts::{Acts, Quantity};
pub use bearing::BearingValue;
pub use describe::short;
pub use limits::Limits;
pub use report::{Break, LawReport, OutputReport, TableReport, Trend};
pub(super) use schema::KIND;
pub(crate) use spec::{Condition, Definition, Piece};
pub use spec::{Given, LawInput, LawOutput, LawSpec, LawState, Parameter};
use spec::{NameCode, Named, PieceCode, in_si};
pub use table::{Column, Columns, Extend, LawTable, Wanted, Which};
pub use valid::Validity;

use super::read::FindFile;
use crate::diagnostic::{Diagnostics, Source};

impl LawSpec {
    /// Reads a law file that has no tables.
    ///
    /// # Errors
    /// Those of [`LawSpec::read_with`]; a table is one.
    pub fn read(file: &Arc<Source>) -> Result<Self, Diagnostics> {
        Self::read_with(file, &|name| Err(format!("there is no file `{name}` beside this law")))
    }

    /// Reads a law file, and the files of its tables as `beside` finds them.
    ///
    /// # Errors
    /// Everything that is wrong with them, each with its place.
    pub fn read_with(file: &Arc<Source>, beside: &FindFile<'_>) -> Result<Self, Diagnostics> {
        Self::read_given(file, beside, &[])
    }

    /// Reads a law file as if these values stood in it: all that follows from them, such as breaks moved to
    /// roots, follows from these.
    ///
    /// # Errors
    /// Everything that is wrong with the file; a name that is none of its parameters; whatever is wrong with
    /// these values.
    pub fn read_given(
        file: &Arc<Source>,
        beside: &FindFile<'_>,
        given: &[Given],
    ) -> Result<Self, Diagnostics> {
        let mut draft = draft::read(file, beside)?;
        draft.give(given)?;
        let mut law = build::build(draft)?;
        law.report = findings::report(&law)?;
        law.graph.evaluate_at(points::of(&law));
        Ok(law)
    }

    /// The law with these values in place of those in its file; its tables are not read again.
    ///
    /// # Errors
    /// As [`LawSpec::read_given`].
    pub fn read_again(&self, given: &[Given]) -> Result<Self, Diagnostics> {
        let beside = |name: &str| {
            let table = self.tables.iter().find(|table| table.path == name);
            let file = table.map(|table| table.file.clone());
            file.ok_or_else(|| format!("there is no file `{name}` beside this law"))
        };
        Self::read_given(&self.file, &beside, given)
    }

    /// The parameters of a law file, of which only the syntax is checked.
    ///
    /// # Errors
    /// Everything that is wrong with keys, names, units and the grammar of formulas.
    pub fn parameters_of(
        file: &Arc<Source>,
        beside: &FindFile<'_>,
    ) -> Result<Vec<Parameter>, Diagnostics> {
        build::parameters_of(draft::read(file, beside)?)
    }
}

#[cfg(test)]
mod tests;
