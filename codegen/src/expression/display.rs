//! Expressions as text in the formula language, with the spec's own names.

use num_traits::{One, Signed};

use super::graph::Graph;
use super::node::{Function, Id, Node, Rational, Relation, Shape};

/// How tightly the outermost operation of a text binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Truth,
    Sum,
    Product,
    Power,
    Atom,
}

/// Texts longer than this are cut: the graph shares what the text would repeat.
const LONGEST: usize = 20_000;

/// The expression as a formula; one that would be very long is cut and ends in `…`.
pub fn display(graph: &Graph, id: Id) -> String {
    let mut text = Printer { graph, room: LONGEST }.print(id).0;
    if let Some((cut, _)) = text.char_indices().nth(LONGEST) {
        text.truncate(cut);
        text.push('…');
    }
    text
}

struct Printer<'g> {
    graph: &'g Graph,
    room: usize,
}

impl Printer<'_> {
    fn at_least(&mut self, id: Id, least: Binding) -> String {
        let (text, binding) = self.print(id);
        if binding >= least { text } else { format!("({text})") }
    }

    fn print(&mut self, id: Id) -> (String, Binding) {
        if self.room == 0 {
            return ("…".into(), Binding::Atom);
        }
        let (text, binding) = self.node(id);
        self.room = self.room.saturating_sub(text.len());
        (text, binding)
    }

    fn node(&mut self, id: Id) -> (String, Binding) {
        match self.graph.node(id).clone() {
            Node::Number(value) => number(&value),
            Node::Zero(Shape::Vector) => ("zero vector".into(), Binding::Atom),
            Node::Zero(_) => ("zero matrix".into(), Binding::Atom),
            Node::Identity => ("identity".into(), Binding::Atom),
            Node::Symbol(symbol) => (symbol.name, Binding::Atom),
            Node::Sum(terms) => self.sum(&terms),
            Node::Product(factors) => self.product(&factors),
            Node::Function(function, a) => {
                let argument = self.print(a).0;
                (format!("{}({argument})", name(function)), Binding::Atom)
            }
            Node::Compare(relation, a, b) => {
                let (a, b) = (self.at_least(a, Binding::Sum), self.at_least(b, Binding::Sum));
                let sign = match relation {
                    Relation::Less => "<",
                    Relation::LessOrEqual => "<=",
                };
                (format!("{a} {sign} {b}"), Binding::Truth)
            }
            Node::Truth(value) => (value.to_string(), Binding::Atom),
            Node::And(a, b) => self.joined(a, " and ", b, Binding::Sum, Binding::Truth),
            Node::Or(a, b) => self.joined(a, " or ", b, Binding::Sum, Binding::Truth),
            Node::Not(a) => (format!("not {}", self.at_least(a, Binding::Sum)), Binding::Truth),
            Node::Select(mask, a, b) => {
                let (mask, a, b) = (self.print(mask).0, self.print(a).0, self.print(b).0);
                (format!("select({mask}, {a}, {b})"), Binding::Atom)
            }
            Node::Scale(a, b) | Node::Apply(a, b) => {
                self.joined(a, "*", b, Binding::Power, Binding::Product)
            }
            Node::Dot(a, b) => {
                let (a, b) = (self.print(a).0, self.print(b).0);
                (format!("dot({a}, {b})"), Binding::Atom)
            }
            Node::Transpose(a) => (format!("transpose({})", self.print(a).0), Binding::Atom),
            Node::Outer(a, b) => {
                let (a, b) = (self.print(a).0, self.print(b).0);
                (format!("outer({a}, {b})"), Binding::Atom)
            }
        }
    }

    fn joined(
        &mut self,
        a: Id,
        sign: &str,
        b: Id,
        least: Binding,
        is: Binding,
    ) -> (String, Binding) {
        let (a, b) = (self.at_least(a, least), self.at_least(b, least));
        (format!("{a}{sign}{b}"), is)
    }

    fn sum(&mut self, terms: &[(Id, Rational)]) -> (String, Binding) {
        let mut text = String::new();
        for (place, (term, coefficient)) in terms.iter().enumerate() {
            let sign = match (place, coefficient.is_negative()) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            };
            text.push_str(sign);
            let size = coefficient.abs();
            if self.graph.is_one(*term) {
                text.push_str(&number(&size).0);
            } else if size.is_one() {
                text.push_str(&self.at_least(*term, Binding::Product));
            } else {
                let term = self.at_least(*term, Binding::Product);
                text.push_str(&format!("{}*{term}", number(&size).0));
            }
        }
        let single = terms.len() == 1 && !terms[0].1.is_negative();
        (text, if single { Binding::Product } else { Binding::Sum })
    }

    fn product(&mut self, factors: &[(Id, Rational)]) -> (String, Binding) {
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for (base, exponent) in factors {
            let size = exponent.abs();
            let text = if size.is_one() {
                self.at_least(*base, Binding::Power)
            } else if size == Rational::new(1.into(), 2.into()) {
                format!("sqrt({})", self.print(*base).0)
            } else {
                let (exponent, binding) = number(&size);
                let base = self.at_least(*base, Binding::Atom);
                match binding {
                    Binding::Atom => format!("{base}^{exponent}"),
                    _ => format!("{base}^({exponent})"),
                }
            };
            if exponent.is_negative() { &mut below } else { &mut above }.push(text);
        }
        let above = if above.is_empty() { "1".to_owned() } else { above.join("*") };
        let text = match below.len() {
            0 => above,
            1 => format!("{above}/{}", below[0]),
            _ => format!("{above}/({})", below.join("*")),
        };
        (text, Binding::Product)
    }
}

fn number(value: &Rational) -> (String, Binding) {
    let text = if value.is_integer() {
        value.numer().to_string()
    } else {
        // A decimal where it is short and exact, else the fraction.
        let decimal = super::signature::to_f64(value).to_string();
        let exact = decimal.len() <= 12
            && crate::units::decimal(&decimal)
                .is_some_and(|(exact, _)| exact.as_ref() == Some(value));
        if exact { decimal } else { format!("{}/{}", value.numer(), value.denom()) }
    };
    let binding = match value.is_negative() {
        true => Binding::Sum,
        false if text.contains('/') => Binding::Product,
        false => Binding::Atom,
    };
    (text, binding)
}

fn name(function: Function) -> &'static str {
    match function {
        Function::Exp => "exp",
        Function::Ln => "log",
        Function::Sin => "sin",
        Function::Cos => "cos",
        Function::Tan => "tan",
        Function::Atan => "atan",
        Function::Tanh => "tanh",
        Function::Abs => "abs",
    }
}
