//! The formula language: text → tokens → terms with byte spans → shapes and dimensions checked →
//! expression graph; and the direct evaluation of terms, against which everything else is tested.
//!
//! ```text
//! condition = "or"-chain of "and"-chains of ["not"] comparison
//! comparison = sum { ("<" | "<=" | ">" | ">=") sum }          0 < h < c is a chain
//! sum        = product { ("+" | "-") product }
//! product    = unary { ("*" | "/") unary }
//! unary      = ("-" | "+") unary | power
//! power      = atom [ "^" unary ]                             −2^2 = −4, 2^3^2 = 512
//! atom       = number | name | name "(" condition { "," condition } ")" | "(" condition ")"
//!            | "sum" "(" counter "," first "," last "," condition ")"
//! ```
//!
//! Names are ASCII; Greek letters, a dot above and subscript digits stand for their ASCII spelling
//! (θ̇ is `theta_dot`, c₀ is `c0`).

mod bytecode;
mod check;
mod evaluate;
mod function;
mod lower;
mod parse;
mod series;
mod token;
pub(crate) mod undefined;
mod unit;
mod walk;

use std::collections::BTreeMap;
use std::ops::Range;

use crate::operation::Relation;
use crate::rational::Rational;

pub(crate) use bytecode::bytecode;
pub use check::{Scope, check};
pub use evaluate::{Value, evaluate};
pub use lower::lower;
pub use parse::parse;
pub(crate) use series::whole;
pub(crate) use unit::dimension_of_pure;
pub use unit::{Meaning, dimension};

use crate::diagnostic::Located;

/// What a formula may cost; beyond it, an error (`E015`).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    /// Bytes of text, which bounds the number of terms.
    pub(crate) length: usize,
    /// Parentheses, signs and powers inside one another.
    pub(crate) depth: usize,
    /// Largest absolute constant exponent.
    pub(crate) exponent: u32,
    /// Terms of one `sum`, and of all sums of a formula when those inside others are written out.
    pub(crate) repeats: [usize; 2],
}

/// The limits of every formula. (Digits and powers of ten of a number are bounded with the units; bits of
/// exact numbers, and nodes, by the graph.)
pub(crate) const LIMITS: Limits =
    Limits { length: 8192, depth: 64, exponent: 100, repeats: [64, 512] };

/// Name of the number π in formulas.
pub(crate) const PI: &str = "pi";

/// The f64 nearest to π, as an exact number.
pub(crate) fn pi() -> Rational {
    Rational::from_float(std::f64::consts::PI).expect("a finite number")
}

/// Name of the sum over a counter.
pub(crate) const SUM: &str = "sum";

/// Words that cannot be names.
pub(crate) const RESERVED: [&str; 4] = ["and", "or", "not", PI];

/// A formula: its text, where it stands, and what it says.
#[derive(Debug, Clone, PartialEq)]
pub struct Formula {
    /// The text and its place in the file.
    pub text: Located,
    /// What it says.
    pub(crate) root: Term,
}

/// A part of a formula.
#[derive(Debug, Clone, PartialEq)]
pub struct Term {
    /// What it says.
    pub(crate) kind: TermKind,
    /// Byte range in the formula's text.
    pub span: Range<usize>,
}

/// Whether a part of a sum is added, or of a product multiplied, or the opposite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    /// `+` or `*`.
    With,
    /// `-` or `/`.
    Against,
}

/// `<`, `<=`, `>` and `>=`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Comparison {
    /// a < b
    Less,
    /// a ≤ b
    LessOrEqual,
    /// a > b
    Greater,
    /// a ≥ b
    GreaterOrEqual,
}

impl Comparison {
    /// The same as a relation of its sides or of the exchanged ones.
    fn of<T>(self, left: T, right: T) -> (Relation, T, T) {
        match self {
            Comparison::Less => (Relation::Less, left, right),
            Comparison::LessOrEqual => (Relation::LessOrEqual, left, right),
            Comparison::Greater => (Relation::Less, right, left),
            Comparison::GreaterOrEqual => (Relation::LessOrEqual, right, left),
        }
    }
}

/// What a term says. Chains are kept as lists, so that long sums are not deep.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum TermKind {
    /// A number, exactly.
    Number(Rational),
    /// A name, in its ASCII spelling.
    Name(String),
    /// −a
    Negate(Box<Term>),
    /// a + b − c …; at least two parts.
    Sum(Vec<(Side, Term)>),
    /// a·b / c …, from the left; at least two parts.
    Product(Vec<(Side, Term)>),
    /// aᵇ
    Power(Box<Term>, Box<Term>),
    /// f(a, b, …)
    Call {
        /// Name of the function, in its ASCII spelling.
        function: String,
        /// Where the name stands.
        name: Range<usize>,
        /// The arguments.
        arguments: Vec<Term>,
    },
    /// Σ body for a counter that goes from first to last in steps of one.
    Series {
        /// Name of the counter.
        counter: String,
        /// Where it stands.
        name: Range<usize>,
        /// First and last value of the counter; whole constants.
        ends: Box<[Term; 2]>,
        /// What is added up.
        body: Box<Term>,
    },
    /// first < second ≤ …; at least one comparison.
    Compare(Box<Term>, Vec<(Comparison, Term)>),
    /// All of them; at least two.
    And(Vec<Term>),
    /// Any of them; at least two.
    Or(Vec<Term>),
    /// The opposite.
    Not(Box<Term>),
}

impl Term {
    /// The terms that it is made of, in the order of the text.
    pub(crate) fn parts(&self) -> Vec<&Term> {
        match &self.kind {
            TermKind::Number(_) | TermKind::Name(_) => Vec::new(),
            TermKind::Negate(a) | TermKind::Not(a) => vec![a],
            TermKind::Sum(parts) | TermKind::Product(parts) => {
                parts.iter().map(|(_, part)| part).collect()
            }
            TermKind::Power(a, b) => vec![a, b],
            TermKind::Series { ends, body, .. } => ends.iter().chain([&**body]).collect(),
            TermKind::Compare(first, rest) => {
                std::iter::once(&**first).chain(rest.iter().map(|(_, part)| part)).collect()
            }
            TermKind::Call { arguments: parts, .. }
            | TermKind::And(parts)
            | TermKind::Or(parts) => parts.iter().collect(),
        }
    }

    /// Calls `visit` for this term and every term inside, in the order of the text.
    pub(crate) fn visit<'t>(&'t self, visit: &mut impl FnMut(&'t Term)) {
        visit(self);
        self.parts().into_iter().for_each(|part| part.visit(visit));
    }
}

impl Formula {
    /// Every name in the formula but the counters of sums, with the first place where it stands in the
    /// text.
    pub fn names(&self) -> BTreeMap<&str, Range<usize>> {
        let mut names = BTreeMap::new();
        let mut counters = Vec::new();
        self.root.visit(&mut |term| match &term.kind {
            TermKind::Name(name) => {
                names.entry(name.as_str()).or_insert_with(|| term.span.clone());
            }
            TermKind::Series { counter, .. } => counters.push(counter.as_str()),
            _ => {}
        });
        // A counter never has the name of something declared.
        counters.into_iter().for_each(|counter| {
            names.remove(counter);
        });
        names
    }
}

/// The ASCII spelling of a name as it may be written in a spec: `θ̇` → `theta_dot`.
///
/// # Errors
/// What is wrong, if the text is no name or a word of the grammar.
pub fn name(text: &str) -> Result<String, String> {
    let name = token::name(text).ok_or_else(|| {
        format!("`{text}` is not a name: a letter, then letters, digits and `_` are wanted")
    })?;
    if RESERVED.contains(&name.as_str()) {
        return Err(format!("`{name}` is a word of the formula language and cannot be a name"));
    }
    if name.ends_with('_') {
        return Err(format!("`{name}` ends in `_`, as only names of the generator do"));
    }
    Ok(name)
}
