//! Builds instructions: folds constants, shares equal instructions, places each in its stage.

use rustc_hash::FxHashMap;

use super::program::Stage;
use crate::operation::{Operand, Operation};

/// ±operand. Constants carry their own sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Signed {
    pub(super) operand: Operand,
    pub(super) negative: bool,
}

impl Signed {
    pub(super) fn constant(value: f64) -> Self {
        Signed { operand: Operand::Constant(value), negative: false }
    }

    pub(super) fn plus(operand: Operand) -> Self {
        Signed { operand, negative: false }
    }

    pub(super) fn negated_if(self, condition: bool) -> Self {
        match self.operand {
            _ if !condition => self,
            Operand::Constant(value) => Signed::constant(-value),
            _ => Signed { negative: !self.negative, ..self },
        }
    }
}

/// Stages on which a value depends, one bit each.
pub(super) type Needs = u64;

/// First stage that has everything in `needs`.
pub(super) fn first_stage(covers: &[Needs], needs: Needs) -> Option<usize> {
    covers.iter().position(|cover| needs & !cover == 0)
}

/// What each stage can use: itself and, through the stages it sees, all that those can use.
pub(super) fn covers(stages: &[Stage]) -> Vec<Needs> {
    let mut covers: Vec<Needs> = Vec::with_capacity(stages.len());
    for (place, stage) in stages.iter().enumerate() {
        let seen = stage.sees.iter().filter(|&&seen| seen < place);
        covers.push(seen.fold(1 << place, |cover, &seen| cover | covers[seen]));
    }
    covers
}

pub(super) struct Builder {
    covers: Vec<Needs>,
    inputs: Vec<Needs>,
    pub(super) operations: Vec<Operation<Operand>>,
    needs: Vec<Needs>,
    /// Operations on operands that compare by their bits: equal ones have equal bits of their values.
    shared: FxHashMap<Operation<Atom>, Operand>,
}

impl Builder {
    pub(super) fn new(stages: &[Stage], inputs: impl Iterator<Item = usize>) -> Self {
        Builder {
            covers: covers(stages),
            inputs: inputs.map(|stage| 1 << stage).collect(),
            operations: Vec::new(),
            needs: Vec::new(),
            shared: FxHashMap::default(),
        }
    }

    pub(super) fn needs(&self, operand: Operand) -> Needs {
        match operand {
            Operand::Constant(_) => 0,
            Operand::Input(place) => self.inputs[place],
            Operand::Value(place) => self.needs[place],
        }
    }

    /// Stage of a value with these needs; past the last stage if none has them all.
    pub(super) fn stage(&self, needs: Needs) -> usize {
        first_stage(&self.covers, needs).unwrap_or(self.covers.len())
    }

    pub(super) fn stage_of(&self, operand: Operand) -> usize {
        self.stage(self.needs(operand))
    }

    /// The value of an operation: folded, shared with an equal one, or a new instruction.
    pub(super) fn emit(&mut self, operation: Operation<Operand>) -> Operand {
        if let Some(known) = folded(operation) {
            return known;
        }
        let key = key(operation);
        if let Some(operand) = self.shared.get(&key) {
            return *operand;
        }
        let needs = operation.operands().fold(0, |all, one| all | self.needs(one));
        let operand = Operand::Value(self.operations.len());
        self.operations.push(operation);
        self.needs.push(needs);
        self.shared.insert(key, operand);
        operand
    }

    /// A signed value as a plain operand; the sign of a multiple goes into its coefficient.
    pub(super) fn plain(&mut self, value: Signed) -> Operand {
        let operation = match value.operand {
            Operand::Value(place) if value.negative => match self.operations[place] {
                Operation::Mul(other, Operand::Constant(c))
                | Operation::Mul(Operand::Constant(c), other) => {
                    Operation::Mul(other, Operand::Constant(-c))
                }
                _ => Operation::Neg(value.operand),
            },
            operand if value.negative => Operation::Neg(operand),
            operand => return operand,
        };
        self.emit(operation)
    }

    pub(super) fn add(&mut self, a: Signed, b: Signed) -> Signed {
        if let Operand::Constant(value) = b.operand
            && value < 0.0
            && !a.negative
        {
            return Signed::plus(self.emit(Operation::Sub(a.operand, Operand::Constant(-value))));
        }
        match (a.negative, b.negative) {
            (false, false) => Signed::plus(self.emit(Operation::Add(a.operand, b.operand))),
            (false, true) => Signed::plus(self.emit(Operation::Sub(a.operand, b.operand))),
            (true, false) => Signed::plus(self.emit(Operation::Sub(b.operand, a.operand))),
            (true, true) => {
                let sum = Signed::plus(self.emit(Operation::Add(a.operand, b.operand)));
                sum.negated_if(true)
            }
        }
    }

    pub(super) fn mul(&mut self, a: Signed, b: Signed) -> Signed {
        let product = self.emit(Operation::Mul(a.operand, b.operand));
        Signed::plus(product).negated_if(a.negative != b.negative)
    }

    pub(super) fn div(&mut self, a: Signed, b: Signed) -> Signed {
        let quotient = self.emit(Operation::Div(a.operand, b.operand));
        Signed::plus(quotient).negated_if(a.negative != b.negative)
    }

    /// valueⁿ by squaring, n ≥ 1; the powers on the way are shared.
    pub(super) fn whole_power(&mut self, value: Signed, n: u64) -> Signed {
        let power = self.squared(value.operand, n);
        Signed::plus(power).negated_if(value.negative && !n.is_multiple_of(2))
    }

    fn squared(&mut self, base: Operand, n: u64) -> Operand {
        let (power, other) = match n {
            0 | 1 => return base,
            n if n.is_multiple_of(2) => {
                let root = self.squared(base, n / 2);
                (root, root)
            }
            n => (self.squared(base, n - 1), base),
        };
        self.emit(Operation::Mul(power, other))
    }
}

/// The result where all operands are constants, or where a constant makes the operation trivial.
fn folded(operation: Operation<Operand>) -> Option<Operand> {
    use Operand::Constant;
    let constant = |operand| match operand {
        Constant(value) => Some(value),
        _ => None,
    };
    if operation.operands().all(|operand| constant(operand).is_some()) {
        let values = operation.map(|operand| constant(operand).unwrap_or(f64::NAN));
        return Some(Constant(values.value()));
    }
    match operation {
        Operation::Mul(Constant(1.0), other) | Operation::Mul(other, Constant(1.0)) => Some(other),
        Operation::Div(other, Constant(1.0)) => Some(other),
        Operation::And(Constant(a), other) | Operation::And(other, Constant(a)) => {
            Some(if a == 0.0 { Constant(0.0) } else { other })
        }
        Operation::Or(Constant(a), other) | Operation::Or(other, Constant(a)) => {
            Some(if a == 0.0 { other } else { Constant(1.0) })
        }
        Operation::Select(Constant(mask), a, b) => Some(if mask == 0.0 { b } else { a }),
        Operation::Select(_, a, b) if atom(a) == atom(b) => Some(a),
        _ => None,
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
enum Atom {
    Constant(u64),
    Input(usize),
    Value(usize),
}

fn atom(operand: Operand) -> Atom {
    match operand {
        Operand::Constant(value) => Atom::Constant(value.to_bits()),
        Operand::Input(place) => Atom::Input(place),
        Operand::Value(place) => Atom::Value(place),
    }
}

/// Addition and multiplication commute.
fn key(operation: Operation<Operand>) -> Operation<Atom> {
    match operation.map(atom) {
        Operation::Add(a, b) => Operation::Add(a.min(b), a.max(b)),
        Operation::Mul(a, b) => Operation::Mul(a.min(b), a.max(b)),
        other => other,
    }
}
