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
mod kernels;
mod lint;
mod points;
mod poles;
mod program;
mod region;
mod report;
mod root;
mod scan;
mod schema;
mod system;
mod table;
mod valid;

use std::sync::Arc;

use crate::rational::{Rational, nearest};

pub use acts::{Acts, Quantity};
pub use bearing::BearingValue;
pub use describe::short;
pub use report::{Break, LawReport, OutputReport, TableReport, Trend};
pub(super) use schema::KIND;
pub use table::{Extend, LawTable};
pub use valid::Validity;

use super::kind::About;
use super::read::Beside;
use crate::diagnostic::{Diagnostic, Diagnostics, Located, Source};
use crate::expression::{Graph, Id};
use crate::formula::Formula;
use crate::operation::{Bytecode, Number};
use crate::units::Unit;

/// A law, ready to be scheduled: see the module for the file.
#[derive(Debug, Clone)]
pub struct LawSpec {
    /// Name by which cases refer to it.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Paper and equation.
    pub(crate) reference: String,
    /// The file.
    pub file: Arc<Source>,
    /// What it acts on.
    pub acts: Acts,
    /// The inputs, in the order of the file.
    pub inputs: Vec<LawInput>,
    /// The parameters, in the order of the file.
    pub parameters: Vec<Parameter>,
    /// The tables, in the order of the file.
    pub tables: Vec<LawTable>,
    /// The definitions, in the order of the file.
    pub(crate) definitions: Vec<Definition>,
    /// The outputs, in the order of the file.
    pub outputs: Vec<LawOutput>,
    /// Where the law may be believed: the sections of the file, then the ends of its tables.
    pub valid: Vec<Validity>,
    /// The graph that holds symbols, values and derivatives, all SI.
    pub graph: Graph,
    /// What was found about the law.
    pub report: LawReport,
    /// What tables are looked up by, and definitions, in the order in which their values become known.
    code: Vec<NameCode>,
}

/// Values of the names of a law in the units of its file: inputs, then tables and definitions.
type Named<N> = Vec<N>;

/// A name that gets its value after the inputs.
#[derive(Debug, Clone)]
enum NameCode {
    /// Place of the table, and what it is looked up by.
    Table(usize, Bytecode),
    Definition(Bytecode),
}

/// An input of a law.
#[derive(Debug, Clone)]
pub struct LawInput {
    /// Symbol, such as `h`.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Unit in which the file's formulas take it.
    pub unit: Unit,
    /// The symbol in the graph, SI.
    pub symbol: Id,
    /// Range over which the law is meant to be used, in SI, if the file says so.
    pub range: Option<[f64; 2]>,
}

/// A constant of a law.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Symbol, such as `c0`.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Unit in which the file gives it.
    pub unit: Unit,
    /// Value in that unit.
    pub written: Rational,
    /// What it is of the bearing, if the file says so.
    pub bearing: Option<BearingValue>,
    /// Value in the system of units of the file's inputs and outputs.
    pub value: Rational,
}

/// A value that holds in place of the one in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Given {
    /// Name of the parameter.
    pub name: String,
    /// The value.
    pub value: Rational,
    /// Its unit, which measures what the file's unit does.
    pub unit: Unit,
}

/// A named formula that others use.
#[derive(Debug, Clone)]
pub(crate) struct Definition {
    /// Symbol.
    pub name: String,
    /// What it stands for, in the units of the file.
    pub(crate) formula: Formula,
}

/// An output of a law.
#[derive(Debug, Clone)]
pub struct LawOutput {
    /// Symbol, such as `Q`.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Unit in which the file's formulas give it.
    pub unit: Unit,
    /// Whether the file accepts jumps of the value.
    pub(crate) accepts_jumps: bool,
    /// The pieces; the first whose condition holds applies, the last has none.
    pub(crate) pieces: Vec<Piece>,
    /// The value in the graph, SI.
    pub value: Id,
    /// Its derivatives by [`LawSpec::inputs`], SI.
    pub(crate) derivatives: Vec<Id>,
    /// What evaluates the pieces.
    code: Vec<PieceCode>,
}

/// A piece for evaluation.
#[derive(Debug, Clone)]
struct PieceCode {
    /// The condition, if it is a formula.
    when: Option<Bytecode>,
    value: Bytecode,
}

/// A piece of an output.
#[derive(Debug, Clone)]
pub(crate) struct Piece {
    /// When it applies; `None` for the last.
    pub(crate) when: Option<Condition>,
    /// What it gives, in the units of the file.
    pub value: Formula,
    /// The same in the graph, SI.
    pub(crate) node: Id,
}

/// When a piece applies.
#[derive(Debug, Clone)]
pub(crate) enum Condition {
    /// On one side of a value of one input.
    Threshold {
        /// Place of the input in [`LawSpec::inputs`].
        input: usize,
        /// The value, SI, exactly or to 2⁻¹²⁰.
        at: Rational,
        /// Whether the piece applies below it.
        below: bool,
        /// Whether it applies at the value itself.
        inclusive: bool,
        /// The value that the file gives, if `engage` moved it.
        moved_from: Option<Rational>,
        /// Half of the length over which `smooth` blends this piece with what follows, SI.
        blend: Option<Rational>,
        /// The condition as the file gives it.
        text: Located,
    },
    /// Where a formula holds.
    Formula(Formula),
}

impl LawSpec {
    /// What it says about itself.
    pub(crate) fn about(&self) -> About<'_> {
        let LawSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: self.texts().skip(1).collect() }
    }

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
    pub fn read_with(file: &Arc<Source>, beside: &Beside<'_>) -> Result<Self, Diagnostics> {
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
        beside: &Beside<'_>,
        given: &[Given],
    ) -> Result<Self, Diagnostics> {
        let mut draft = draft::read(file, beside)?;
        draft.give(given)?;
        let mut law = build::build(draft)?;
        law.report = report::report(&law)?;
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
        beside: &Beside<'_>,
    ) -> Result<Vec<Parameter>, Diagnostics> {
        build::parameters_of(draft::read(file, beside)?)
    }

    /// The texts that the law was made from: its own file, then those of its tables.
    pub fn texts(&self) -> impl Iterator<Item = &str> {
        let tables = self.tables.iter().map(|table| table.file.text.as_str());
        std::iter::once(self.file.text.as_str()).chain(tables)
    }

    /// The outputs where the inputs (SI, in the order of [`LawSpec::inputs`]) have the given values, by
    /// direct evaluation of the file's formulas: neither graph nor derivative is used.
    ///
    /// # Errors
    /// None for a law that was read without errors.
    pub fn evaluate<N: Number>(&self, inputs: &[N]) -> Result<Vec<N>, Diagnostic> {
        let names = self.names(inputs);
        Ok(self.outputs.iter().map(|output| output.value_at(inputs, &names)).collect())
    }

    /// Values of all names but parameters, in the units of the file.
    fn names<N: Number>(&self, inputs: &[N]) -> Named<N> {
        let mut names = Vec::with_capacity(self.inputs.len() + self.code.len());
        for (input, value) in self.inputs.iter().zip(inputs) {
            names.push(value.mul(&N::exact(&in_si(&input.unit).recip())));
        }
        for code in &self.code {
            names.push(match code {
                NameCode::Table(place, input) => self.tables[*place].value(&input.value(&names)),
                NameCode::Definition(code) => code.value(&names),
            });
        }
        names
    }

    /// What a table is looked up by.
    fn input_of<N: Number>(&self, table: usize, names: &Named<N>) -> Option<N> {
        self.code.iter().find_map(|code| match code {
            NameCode::Table(place, input) if *place == table => Some(input.value(names)),
            _ => None,
        })
    }
}

impl LawOutput {
    /// Place of the piece that applies; where two are blended, the one on this side of the break.
    fn active<N: Number>(&self, inputs: &[N], names: &Named<N>) -> usize {
        let applies = (0..self.pieces.len()).find(|place| self.holds(*place, inputs, names));
        applies.unwrap_or(self.pieces.len() - 1)
    }

    /// Whether the condition of a piece holds.
    fn holds<N: Number>(&self, place: usize, inputs: &[N], names: &Named<N>) -> bool {
        match &self.pieces[place].when {
            Some(Condition::Threshold { input, at, below, inclusive, .. }) => {
                let (x, at) = (inputs[*input].value(), nearest(at));
                let strictly = if *below { x < at } else { x > at };
                strictly || *inclusive && x == at
            }
            _ => self.code[place].when.as_ref().is_none_or(|when| when.holds(names)),
        }
    }

    /// Value of a piece, SI, whether it applies or not.
    fn value_of<N: Number>(&self, piece: usize, names: &Named<N>) -> N {
        self.code[piece].value.value(names).mul(&N::exact(&in_si(&self.unit)))
    }
}

/// Factor of a unit to SI; the units of inputs and outputs were checked to have rational ones.
fn in_si(unit: &Unit) -> Rational {
    let inexact = || Rational::from_float(unit.factor().to_f64());
    let factor = unit.rational().cloned().or_else(inexact);
    factor.unwrap_or_else(|| Rational::from(1))
}

#[cfg(test)]
mod tests;
