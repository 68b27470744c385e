//! Scalars and conditions of a graph as bytecode, in the order of the graph: nothing is rewritten, so that what is
//! rewritten can be compared with it.

use std::convert::Infallible;

use num_traits::{Signed, ToPrimitive};

use super::fold::{Algebra, Folded};
use super::graph::Graph;
use super::node::{Id, Node, Rational};
use crate::operation::{Bytecode, Operand, Operation};
use crate::rational::nearest;

impl Graph {
    /// The bytecode of some expressions; `inputs` are symbols in their order. Other symbols, and what is no scalar,
    /// are no numbers (NaN).
    pub(crate) fn bytecode(&self, inputs: &[Id], expressions: &[Id]) -> Bytecode {
        let mut writer = Writer { inputs, operations: Vec::new() };
        let Ok(outputs) = self.fold_all(expressions, &mut writer);
        Bytecode { operations: writer.operations, outputs }
    }
}

struct Writer<'i> {
    inputs: &'i [Id],
    operations: Vec<Operation<Operand>>,
}

const ZERO: Operand = Operand::Constant(0.0);
const ONE: Operand = Operand::Constant(1.0);

impl Writer<'_> {
    fn push(&mut self, operation: Operation<Operand>) -> Operand {
        self.operations.push(operation);
        Operand::Value(self.operations.len() - 1)
    }

    fn product(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (ONE, other) | (other, ONE) => other,
            _ => self.push(Operation::Mul(a, b)),
        }
    }

    fn power(&mut self, base: Operand, exponent: &Rational) -> Operand {
        let whole = exponent.abs().to_u32().filter(|_| exponent.is_integer());
        let Some(mut count) = whole else {
            return self.push(Operation::Power(base, Operand::Constant(nearest(exponent))));
        };
        let (mut power, mut square) = (ONE, base);
        while count > 0 {
            if !count.is_multiple_of(2) {
                power = self.product(power, square);
            }
            count /= 2;
            if count > 0 {
                square = self.product(square, square);
            }
        }
        if exponent.is_negative() { self.push(Operation::Div(ONE, power)) } else { power }
    }
}

impl Algebra for Writer<'_> {
    type Value = Operand;
    type Error = Infallible;

    fn number(&mut self, value: &Rational) -> Operand {
        Operand::Constant(nearest(value))
    }

    fn leaf(&mut self, id: Id, node: &Node) -> Folded<Self> {
        let input = self.inputs.iter().position(|input| *input == id);
        Ok(match (input, node) {
            (Some(place), _) => Operand::Input(place),
            (None, Node::Truth(value)) => Operand::Constant(f64::from(*value)),
            (None, _) => Operand::Constant(f64::NAN),
        })
    }

    fn add(&mut self, sum: Operand, term: &Operand, factor: &Rational) -> Folded<Self> {
        let term = self.product(Operand::Constant(nearest(factor)), *term);
        Ok(if sum == ZERO { term } else { self.push(Operation::Add(sum, term)) })
    }

    fn multiply(&mut self, product: Operand, base: &Operand, exponent: &Rational) -> Folded<Self> {
        let power = self.power(*base, exponent);
        Ok(self.product(product, power))
    }

    fn operation(&mut self, operation: Operation<&Operand>) -> Folded<Self> {
        Ok(self.push(operation.map(|operand| *operand)))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::diagnostic::Located;
    use crate::formula::{lower, parse};

    #[test]
    fn bytecode_has_the_values_of_nodes() {
        for text in [
            "3*x - y/7 + 2",
            "x^3*y^(-2) - x^(5/3)/sqrt(y) + x^5",
            "sin(x)*abs(y - 2) + erf(x - y)",
            "max(x, y) + min(2*x, y)",
        ] {
            let mut graph = Graph::new();
            let symbols = ["x", "y"].map(|name| graph.scalar(name));
            let names =
                BTreeMap::from([("x".to_owned(), symbols[0]), ("y".to_owned(), symbols[1])]);
            let formula = parse(&Located::alone("f", text)).expect("a formula");
            let id = lower(&formula, &mut graph, &names).expect("an expression");
            let code = graph.bytecode(&symbols, &[id]);
            let [x, y] = symbols.map(|symbol| graph.signature(symbol).collect::<Vec<f64>>());
            for (point, expected) in graph.signature(id).enumerate() {
                let found = code.value(&[x[point], y[point]]);
                assert!(
                    (found - expected).abs() <= 1e-14 * expected.abs().max(1.0),
                    "{text}: {found}"
                );
            }
            let without = graph.bytecode(&symbols[..1], &symbols).values(&[1.0]);
            assert!(without[0] == 1.0 && without[1].is_nan(), "{text}: {without:?}");
        }
    }
}
