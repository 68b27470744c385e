//! A law as it is read: its data, and its values by direct evaluation of the file's formulas.

use std::sync::Arc;

use super::acts::Acts;
use super::bearing::BearingValue;
use super::limits::Limits;
use super::report::LawReport;
use super::table::LawTable;
use super::valid::Validity;
use crate::diagnostic::{Diagnostic, Located, Source};
use crate::expression::{Graph, Id};
use crate::formula::Formula;
use crate::kinds::kind::About;
use crate::operation::{Bytecode, Number};
use crate::rational::{Rational, nearest};
use crate::units::Unit;

/// A law, ready to be scheduled: see [`crate::kinds::law`] for the file.
#[derive(Debug, Clone)]
pub struct LawSpec {
    /// Name by which cases refer to it.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// Paper and equation.
    pub(crate) reference: String,
    /// The file.
    pub file: Arc<Source>,
    /// What it acts on.
    pub acts: Acts,
    /// The inputs, in the order of the file, then the states: for formulas and derivatives they are one.
    pub inputs: Vec<LawInput>,
    /// The parameters, in the order of the file.
    pub parameters: Vec<Parameter>,
    /// The tables, in the order of the file.
    pub tables: Vec<LawTable>,
    /// The definitions, in the order of the file.
    pub(crate) definitions: Vec<Definition>,
    /// The outputs, in the order of the file, then the rates of the states.
    pub outputs: Vec<LawOutput>,
    /// The states, in the order of the file.
    pub states: Vec<LawState>,
    /// The energy that it stores, if the file says so.
    pub(crate) stored: Option<Stored>,
    /// Where the law may be believed: the sections of the file, then the ends of its tables.
    pub valid: Vec<Validity>,
    /// The graph that holds symbols, values and derivatives, all SI.
    pub graph: Graph,
    /// What was found about the law.
    pub report: LawReport,
    /// What tables are looked up by, and definitions, in the order in which their values become known.
    pub(super) code: Vec<NameCode>,
}

/// Values of the names of a law in the units of its file: inputs, then tables and definitions.
pub(super) type Named<N> = Vec<N>;

/// A name that gets its value after the inputs.
#[derive(Debug, Clone)]
pub(super) enum NameCode {
    /// Place of the table, and what it is looked up by.
    Table(usize, Bytecode),
    Definition(Bytecode),
}

/// An input of a law.
#[derive(Debug, Clone)]
pub struct LawInput {
    /// Symbol, such as `h`.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// Unit in which the file's formulas take it.
    pub unit: Unit,
    /// The symbol in the graph, SI.
    pub symbol: Id,
    /// Range over which the law is meant to be used, in SI, if the file says so.
    pub range: Option<[f64; 2]>,
}

/// A state of a law beside what it has as an input.
#[derive(Debug, Clone, PartialEq)]
pub struct LawState {
    /// The value at which it begins, SI; none where its rate is zero.
    pub start: Option<f64>,
}

/// The energy that a law stores.
#[derive(Debug, Clone)]
pub(crate) struct Stored {
    /// The formula, in the units of the file.
    pub(crate) text: String,
    /// The same in the graph, J.
    pub(crate) value: Id,
}

/// A constant of a law.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Symbol, such as `c0`.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// Unit in which the file gives it.
    pub unit: Unit,
    /// Value in that unit.
    pub written: Rational,
    /// What it is of the bearing, if the file says so.
    pub bearing: Option<BearingValue>,
    /// Values that it may have, in the unit of the file.
    pub limits: Limits,
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
    /// One-line description.
    pub title: String,
    /// Unit in which the file's formulas give it.
    pub unit: Unit,
    /// Whether the file accepts jumps of the value.
    pub accepts_jumps: bool,
    /// The pieces; the first whose condition holds applies, the last has none.
    pub(crate) pieces: Vec<Piece>,
    /// The value in the graph, SI.
    pub value: Id,
    /// Its derivatives by [`LawSpec::inputs`], SI.
    pub(crate) derivatives: Vec<Id>,
    /// What evaluates the pieces.
    pub(super) code: Vec<PieceCode>,
}

/// A piece for evaluation.
#[derive(Debug, Clone)]
pub(super) struct PieceCode {
    /// The condition, if it is a formula.
    pub(super) when: Option<Bytecode>,
    pub(super) value: Bytecode,
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

    /// The inputs without the states.
    pub fn taken(&self) -> &[LawInput] {
        &self.inputs[..self.inputs.len() - self.states.len()]
    }

    /// The states as inputs of formulas.
    pub fn remembered(&self) -> &[LawInput] {
        &self.inputs[self.inputs.len() - self.states.len()..]
    }

    /// The outputs without the rates of the states.
    pub fn given(&self) -> &[LawOutput] {
        &self.outputs[..self.outputs.len() - self.states.len()]
    }

    /// Whether an output, by its place, is the rate of a state.
    pub(super) fn is_rate(&self, output: usize) -> bool {
        output >= self.given().len()
    }

    /// Whether it says how much energy it stores.
    pub fn stores(&self) -> bool {
        self.stored.is_some()
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

    /// Whether an output depends on an input at all, both by their places.
    pub fn depends(&self, output: usize, input: usize) -> bool {
        self.graph.depends(self.outputs[output].value, self.inputs[input].symbol)
    }

    /// The measures of [`LawSpec::valid`] where the inputs (SI) have the given values, by direct evaluation of
    /// the file's formulas.
    pub fn measures<N: Number>(&self, inputs: &[N]) -> Vec<N> {
        let names = self.names(inputs);
        let measure = |own: &Validity| own.code.value(&names).mul(&N::exact(&own.in_si));
        self.valid.iter().map(measure).collect()
    }

    /// Values of all names but parameters, in the units of the file.
    pub(super) fn names<N: Number>(&self, inputs: &[N]) -> Named<N> {
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
    pub(super) fn input_of<N: Number>(&self, table: usize, names: &Named<N>) -> Option<N> {
        self.code.iter().find_map(|code| match code {
            NameCode::Table(place, input) if *place == table => Some(input.value(names)),
            _ => None,
        })
    }
}

impl LawOutput {
    /// Place of the piece that applies; where two are blended, the one on this side of the break.
    pub(super) fn active<N: Number>(&self, inputs: &[N], names: &Named<N>) -> usize {
        let applies = (0..self.pieces.len()).find(|place| self.holds(*place, inputs, names));
        applies.unwrap_or(self.pieces.len() - 1)
    }

    /// Whether the condition of a piece holds.
    pub(super) fn holds<N: Number>(&self, place: usize, inputs: &[N], names: &Named<N>) -> bool {
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
    pub(super) fn value_of<N: Number>(&self, piece: usize, names: &Named<N>) -> N {
        self.code[piece].value.value(names).mul(&N::exact(&in_si(&self.unit)))
    }
}

/// Factor of a unit to SI; the units of inputs and outputs were checked to have rational ones.
pub(super) fn in_si(unit: &Unit) -> Rational {
    let inexact = || Rational::from_float(unit.factor().to_f64());
    let factor = unit.rational().cloned().or_else(inexact);
    factor.unwrap_or_else(|| Rational::from(1))
}
