//! Instructions as `let` statements. A value that only one other value uses is written in place, in
//! parentheses where the order of operations needs them, so that a polynomial reads as one.

use proc_macro2::{Literal, Punct, Spacing, TokenStream};
use quote::{ToTokens, TokenStreamExt, quote};

use super::identifier::identifier;
use crate::operation::{Operand, Operation, Relation};
use crate::schedule::Program;

/// The number type of generated code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Numbers {
    /// A type parameter `L: Lane`, every operation rounded.
    Lanes,
    /// A type parameter `L: Lane`; a product that is added to something is not rounded where the lane type
    /// has an instruction for that.
    Fused,
    /// `f64`, with `Lane` in scope for the pinned functions.
    Plain,
}

/// Most operands of an expression that is written in place.
const LEAVES: usize = 4;

/// The statements of one stage: `let name = …;`, for all values that are not written in place. Values
/// of earlier stages and inputs are expected in scope under [`identifier`] of their names.
pub fn statements(program: &Program, stage: usize, numbers: Numbers) -> Vec<TokenStream> {
    let writer = Writer::new(program, numbers);
    program
        .stage(stage)
        .filter(|place| !writer.in_place[*place])
        .map(|place| {
            let name = identifier(&program.instructions[place].name);
            let (value, _) = writer.operation(place);
            quote!(let #name = #value;)
        })
        .collect()
}

/// An operand by its identifier, or as a number.
pub fn operand(program: &Program, operand: Operand, numbers: Numbers) -> TokenStream {
    match (operand, numbers) {
        (Operand::Constant(value), Numbers::Plain) => number(value).to_token_stream(),
        (Operand::Constant(value), _) => {
            let value = number(value);
            quote!(L::splat(#value))
        }
        (other, _) => {
            let name = identifier(program.name_of(other).expect("only constants have no name"));
            quote!(#name)
        }
    }
}

/// A number as Rust text that reads back as the same bits.
pub fn number(value: f64) -> NumberText {
    NumberText(value)
}

/// A number as Rust text.
#[derive(Debug, Clone, Copy)]
pub struct NumberText(f64);

impl ToTokens for NumberText {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        let value = self.0;
        if value.is_nan() {
            tokens.extend(quote!(f64::NAN));
        } else if value.is_infinite() {
            let infinity = if value > 0.0 { quote!(INFINITY) } else { quote!(NEG_INFINITY) };
            tokens.extend(quote!(f64::#infinity));
        } else {
            if value.is_sign_negative() {
                tokens.append(Punct::new('-', Spacing::Alone));
            }
            tokens.append(size(value.abs()));
        }
    }
}

fn size(value: f64) -> Literal {
    match value {
        0.0 | 1e-4..1e16 => Literal::f64_unsuffixed(value),
        // With a power of ten, which is shorter.
        _ => format!("{value:?}").parse().expect("a printed f64 is a literal"),
    }
}

/// How tightly the outermost operation of a text binds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Sign,
    Atom,
}

struct Writer<'a> {
    program: &'a Program,
    numbers: Numbers,
    in_place: Vec<bool>,
}

impl<'a> Writer<'a> {
    fn new(program: &'a Program, numbers: Numbers) -> Self {
        let in_place = in_place(program);
        Writer { program, numbers, in_place }
    }

    fn text(&self, operand: Operand) -> (TokenStream, Binding) {
        match operand {
            Operand::Value(place) if self.in_place[place] => self.operation(place),
            Operand::Constant(value) if self.numbers == Numbers::Plain => {
                let negative = value.is_sign_negative();
                (
                    number(value).to_token_stream(),
                    if negative { Binding::Sign } else { Binding::Atom },
                )
            }
            _ => (self::operand(self.program, operand, self.numbers), Binding::Atom),
        }
    }

    /// An operand that binds at least as tightly as `least`, in parentheses if need be.
    fn at_least(&self, operand: Operand, least: Binding) -> TokenStream {
        let (text, binding) = self.text(operand);
        if binding >= least { text } else { quote!((#text)) }
    }

    /// The right operand of an arithmetic operation: lanes take an f64 there.
    fn right(&self, operand: Operand, least: Binding) -> TokenStream {
        match operand {
            Operand::Constant(value) if value.is_sign_negative() => {
                let value = number(value);
                quote!((#value))
            }
            Operand::Constant(value) => number(value).to_token_stream(),
            _ => self.at_least(operand, least),
        }
    }

    fn call(&self, method: TokenStream, a: Operand) -> TokenStream {
        match self.numbers {
            Numbers::Lanes | Numbers::Fused => {
                let a = self.at_least(a, Binding::Atom);
                quote!(#a.#method())
            }
            Numbers::Plain => {
                // Not the method: f64 has its own, of the platform's library.
                let (a, _) = self.text(a);
                quote!(Lane::#method(#a))
            }
        }
    }

    /// a·b + c for a sum of which one operand is a product written in place.
    fn fused(&self, place: usize) -> Option<TokenStream> {
        if self.numbers != Numbers::Fused {
            return None;
        }
        let Operation::Add(a, b) = self.program.instructions[place].operation else { return None };
        let product = |operand: Operand| match operand {
            Operand::Value(value) if self.in_place[value] => {
                match self.program.instructions[value].operation {
                    Operation::Mul(a, b) => Some((a, b)),
                    _ => None,
                }
            }
            _ => None,
        };
        let ((x, y), other) = match (product(a), product(b)) {
            (_, Some(factors)) => (factors, a),
            (Some(factors), None) => (factors, b),
            (None, None) => return None,
        };
        let (x, y) = (self.at_least(x, Binding::Atom), self.text(y).0);
        let other = self.text(other).0;
        Some(quote!(#x.mul_add(#y, #other)))
    }

    fn operation(&self, place: usize) -> (TokenStream, Binding) {
        // Constants to the right where the order is free: there they need no lane.
        let ordered = |a: Operand, b: Operand| match a {
            Operand::Constant(_) => (b, a),
            _ => (a, b),
        };
        let plain = self.numbers == Numbers::Plain;
        if let Some(fused) = self.fused(place) {
            return (fused, Binding::Atom);
        }
        match self.program.instructions[place].operation {
            Operation::Add(a, b) => {
                let (a, b) = ordered(a, b);
                let (a, b) = (self.at_least(a, Binding::Sum), self.right(b, Binding::Product));
                (quote!(#a + #b), Binding::Sum)
            }
            Operation::Sub(a, b) => {
                let (a, b) = (self.at_least(a, Binding::Sum), self.right(b, Binding::Product));
                (quote!(#a - #b), Binding::Sum)
            }
            Operation::Mul(a, b) => {
                let (a, b) = ordered(a, b);
                let (a, b) = (self.at_least(a, Binding::Product), self.right(b, Binding::Sign));
                (quote!(#a * #b), Binding::Product)
            }
            Operation::Div(a, b) => {
                let (a, b) = (self.at_least(a, Binding::Product), self.right(b, Binding::Sign));
                (quote!(#a / #b), Binding::Product)
            }
            Operation::Neg(a) => {
                let a = self.at_least(a, Binding::Atom);
                (quote!(-#a), Binding::Sign)
            }
            Operation::Sqrt(a) => (self.call(quote!(sqrt), a), Binding::Atom),
            Operation::Function(function, a) => {
                let method = identifier(function.lane());
                (self.call(quote!(#method), a), Binding::Atom)
            }
            Operation::Power(a, b) => {
                let (a, b) = (self.text(a).0, self.text(b).0);
                (quote!(Lane::powf(#a, #b)), Binding::Atom)
            }
            Operation::Compare(relation, a, b) => {
                let (a, b) = (self.text(a).0, self.text(b).0);
                match (relation, plain) {
                    (Relation::Less, true) => (quote!(#a < #b), Binding::Sum),
                    (Relation::LessOrEqual, true) => (quote!(#a <= #b), Binding::Sum),
                    (Relation::Less, false) => (quote!(L::lt(#a, #b)), Binding::Atom),
                    (Relation::LessOrEqual, false) => (quote!(L::le(#a, #b)), Binding::Atom),
                }
            }
            Operation::And(a, b) => {
                let (a, b) = (self.text(a).0, self.text(b).0);
                (if plain { quote!(#a & #b) } else { quote!(L::and(#a, #b)) }, Binding::Sum)
            }
            Operation::Or(a, b) => {
                let (a, b) = (self.text(a).0, self.text(b).0);
                (if plain { quote!(#a | #b) } else { quote!(L::or(#a, #b)) }, Binding::Sum)
            }
            Operation::Not(a) => {
                let (a, _) = self.text(a);
                (if plain { quote!(!#a) } else { quote!(L::not(#a)) }, Binding::Sign)
            }
            Operation::Select(mask, a, b) => {
                let (mask, a, b) = (self.text(mask).0, self.text(a).0, self.text(b).0);
                let choice = if plain {
                    quote!(if #mask { #a } else { #b })
                } else {
                    quote!(L::select(#mask, #a, #b))
                };
                (choice, Binding::Atom)
            }
        }
    }
}

/// Values that are written where they are used: arithmetic, used once, by the same stage, without a name
/// of the spec's, and not too long.
fn in_place(program: &Program) -> Vec<bool> {
    let count = program.instructions.len();
    let (mut uses, mut user_stage) = (vec![0_usize; count], vec![usize::MAX; count]);
    for instruction in &program.instructions {
        for operand in instruction.operation.operands() {
            if let Operand::Value(place) = operand {
                uses[place] += 1;
                user_stage[place] = instruction.stage;
            }
        }
    }
    let mut leaves = vec![1_usize; count];
    let mut in_place = vec![false; count];
    for (place, instruction) in program.instructions.iter().enumerate() {
        let arithmetic = matches!(
            instruction.operation,
            Operation::Add(..) | Operation::Sub(..) | Operation::Mul(..) | Operation::Div(..)
        );
        let length: usize = (instruction.operation.operands())
            .map(|operand| match operand {
                Operand::Value(value) if in_place[value] => leaves[value],
                _ => 1,
            })
            .sum();
        leaves[place] = length;
        in_place[place] = arithmetic
            && !instruction.given
            && uses[place] == 1
            && user_stage[place] == instruction.stage
            && length <= LEAVES;
    }
    in_place
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emit::formatted;
    use crate::expression::{Function, Graph, Rational};
    use crate::schedule::{Request, schedule};

    fn ratio(numer: i64, denom: i64) -> Rational {
        Rational::new(numer, denom)
    }

    fn body(program: &Program, numbers: Numbers) -> Vec<String> {
        let statements = statements(program, 0, numbers);
        let text = formatted(quote!(fn f() { #(#statements)* })).expect("Rust");
        let lines = text.lines().filter(|line| line.starts_with("    "));
        lines.map(|line| line.trim().to_string()).collect()
    }

    #[test]
    fn a_polynomial_reads_as_one() {
        let mut g = Graph::new();
        let h = g.scalar("h");
        let (one, zero) = (g.integer(1), g.integer(0));
        let h2 = g.power(h, ratio(2, 1));
        let q = g.sum(&[(one, ratio(388, 1)), (h, ratio(-18632, 1)), (h2, ratio(217550, 1))]);
        let c0 = g.number(ratio(1, 28));
        let engaged = g.compare(Relation::Less, h, c0);
        let q = g.select(engaged, q, zero);
        let program =
            schedule(&mut g, &Request::flat(&[("h", h)], &[("Q", q)])).expect("a program");
        assert_eq!(
            body(&program, Numbers::Lanes),
            [
                "let h_below = L::lt(h, L::splat(0.03571428571428571));",
                "let Q_part4 = h * (h * 217550.0 - 18632.0) + 388.0;",
                "let Q = L::select(h_below, Q_part4, L::splat(0.0));",
            ]
        );
    }

    #[test]
    fn parentheses_keep_the_order_of_operations() {
        let mut g = Graph::new();
        let names = ["a", "b", "c", "d", "e"];
        let [a, b, c, d, e] = names.map(|name| g.scalar(name));
        let bc = g.add(b, c);
        let product = g.mul(a, bc);
        let quotient = g.div(d, product);
        let difference = g.sub(e, bc);
        let sine = g.function(Function::Sin, difference);
        let inputs: Vec<_> = names.iter().copied().zip([a, b, c, d, e]).collect();
        let outputs = [("q", quotient), ("s", sine)];
        let program = schedule(&mut g, &Request::flat(&inputs, &outputs)).expect("a program");
        assert_eq!(
            body(&program, Numbers::Plain),
            ["let q = d / (a * (b + c));", "let s = Lane::sin(e - b - c);"]
        );
    }
}
