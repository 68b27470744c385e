//! Operations on scalars, and straight-line code made of them.

use super::{Function, Number};

/// Order relations; the others follow by swapping or negating.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Relation {
    /// a < b
    Less,
    /// a ≤ b
    LessOrEqual,
}

impl Relation {
    /// Whether it holds.
    pub(crate) fn holds<T: PartialOrd>(self, a: T, b: T) -> bool {
        match self {
            Relation::Less => a < b,
            Relation::LessOrEqual => a <= b,
        }
    }
}

/// What an operation of straight-line code works on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Operand {
    /// The f64 nearest to an exact number, or one folded from such numbers.
    Constant(f64),
    /// An input, by its place among them.
    Input(usize),
    /// The value of an operation, by its place in the code.
    Value(usize),
}

/// What is done to operands of some kind. No operation is fused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Operation<T> {
    /// a + b
    Add(T, T),
    /// a − b
    Sub(T, T),
    /// a · b
    Mul(T, T),
    /// a / b
    Div(T, T),
    /// −a
    Neg(T),
    /// √a
    Sqrt(T),
    /// A function of one scalar.
    Function(Function, T),
    /// aᵇ for an exponent that is neither whole nor half, or that varies.
    Power(T, T),
    /// A comparison; the value is a truth.
    Compare(Relation, T, T),
    /// Both.
    And(T, T),
    /// Either.
    Or(T, T),
    /// Not.
    Not(T),
    /// The second where the first holds, else the third. Both are computed in any case.
    Select(T, T, T),
}

impl<T> Operation<T> {
    /// The operands, in order.
    pub fn operands(self) -> impl DoubleEndedIterator<Item = T> {
        let operands = match self {
            Operation::Neg(a)
            | Operation::Sqrt(a)
            | Operation::Function(_, a)
            | Operation::Not(a) => [Some(a), None, None],
            Operation::Add(a, b)
            | Operation::Sub(a, b)
            | Operation::Mul(a, b)
            | Operation::Div(a, b)
            | Operation::Power(a, b)
            | Operation::Compare(_, a, b)
            | Operation::And(a, b)
            | Operation::Or(a, b) => [Some(a), Some(b), None],
            Operation::Select(mask, a, b) => [Some(mask), Some(a), Some(b)],
        };
        operands.into_iter().flatten()
    }

    /// The same operation on other operands.
    pub fn map<U>(self, mut of: impl FnMut(T) -> U) -> Operation<U> {
        match self {
            Operation::Add(a, b) => Operation::Add(of(a), of(b)),
            Operation::Sub(a, b) => Operation::Sub(of(a), of(b)),
            Operation::Mul(a, b) => Operation::Mul(of(a), of(b)),
            Operation::Div(a, b) => Operation::Div(of(a), of(b)),
            Operation::Neg(a) => Operation::Neg(of(a)),
            Operation::Sqrt(a) => Operation::Sqrt(of(a)),
            Operation::Function(function, a) => Operation::Function(function, of(a)),
            Operation::Power(a, b) => Operation::Power(of(a), of(b)),
            Operation::Compare(relation, a, b) => Operation::Compare(relation, of(a), of(b)),
            Operation::And(a, b) => Operation::And(of(a), of(b)),
            Operation::Or(a, b) => Operation::Or(of(a), of(b)),
            Operation::Not(a) => Operation::Not(of(a)),
            Operation::Select(mask, a, b) => Operation::Select(of(mask), of(a), of(b)),
        }
    }

    /// What it costs, where the cheap ones count 1.
    pub(crate) fn weight(&self) -> u64 {
        match self {
            Operation::Div(..) | Operation::Sqrt(_) => 8,
            Operation::Function(Function::Abs, _) => 1,
            Operation::Function(..) | Operation::Power(..) => 40,
            _ => 1,
        }
    }

    /// Whether the value is a truth.
    pub(crate) fn is_truth(&self) -> bool {
        matches!(
            self,
            Operation::Compare(..) | Operation::And(..) | Operation::Or(..) | Operation::Not(_)
        )
    }
}

impl<N: Number> Operation<N> {
    /// The value; truth is 1 and 0.
    pub fn value(self) -> N {
        let truth = |value: bool| N::near(f64::from(u8::from(value)));
        let holds = |value: &N| value.value() == 1.0;
        match self {
            Operation::Add(a, b) => a.add(&b),
            Operation::Sub(a, b) => a.sub(&b),
            Operation::Mul(a, b) => a.mul(&b),
            Operation::Div(a, b) => a.div(&b),
            Operation::Neg(a) => N::near(-1.0).mul(&a),
            Operation::Sqrt(a) => a.sqrt(),
            Operation::Function(function, a) => a.function(function),
            Operation::Power(a, b) => a.power(&b),
            Operation::Compare(relation, a, b) => truth(relation.holds(a.value(), b.value())),
            Operation::And(a, b) => truth(holds(&a) && holds(&b)),
            Operation::Or(a, b) => truth(holds(&a) || holds(&b)),
            Operation::Not(a) => truth(!holds(&a)),
            Operation::Select(mask, a, b) => N::chosen(holds(&mask), a, b),
        }
    }
}

/// Straight-line code: every operation uses inputs and values before it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Bytecode {
    pub(crate) operations: Vec<Operation<Operand>>,
    pub(crate) outputs: Vec<Operand>,
}

impl Bytecode {
    /// The outputs where the inputs have the given values.
    pub(crate) fn values<N: Number>(&self, inputs: &[N]) -> Vec<N> {
        let values = self.run(inputs);
        self.outputs.iter().map(|output| read(*output, inputs, &values)).collect()
    }

    /// The only output.
    pub(crate) fn value<N: Number>(&self, inputs: &[N]) -> N {
        read(self.outputs[0], inputs, &self.run(inputs))
    }

    /// Whether the only output, a condition, holds.
    pub(crate) fn holds<N: Number>(&self, inputs: &[N]) -> bool {
        self.value(inputs).value() == 1.0
    }

    fn run<N: Number>(&self, inputs: &[N]) -> Vec<N> {
        let mut values: Vec<N> = Vec::with_capacity(self.operations.len());
        for operation in &self.operations {
            values.push(operation.map(|operand| read(operand, inputs, &values)).value());
        }
        values
    }
}

fn read<N: Number>(operand: Operand, inputs: &[N], values: &[N]) -> N {
    match operand {
        Operand::Constant(value) => N::near(value),
        Operand::Input(place) => inputs[place].clone(),
        Operand::Value(place) => values[place].clone(),
    }
}
