//! Expressions as text, in the formula language and with the spec's own names.

use std::cell::Cell;

use num_traits::{One, Signed};

use super::graph::Graph;
use super::node::{Id, Node, Rational, Relation};

/// How tightly the outermost operation of a text binds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Any,
    Not,
    Compare,
    Sum,
    Product,
    Power,
    Atom,
}

/// Texts longer than this are cut: the graph shares what the text would repeat.
const LONGEST: usize = 20_000;

/// Operations inside each other deeper than this are cut: no reader follows them, and a chain of definitions
/// could fill the stack.
const DEEPEST: usize = 200;

/// A node as a formula that reads back as the same node. Choices, which the formula language writes as
/// pieces, appear as `select(condition, a, b)`, the unit matrix as `identity`. A text that would be very
/// long is cut and ends in `…`.
pub fn display(graph: &Graph, id: Id) -> String {
    print(&Printer::new(graph, true), id)
}

/// The same for people: numbers that have no short decimal are rounded to 9 digits.
pub fn display_rounded(graph: &Graph, id: Id) -> String {
    print(&Printer::new(graph, false), id)
}

fn print(printer: &Printer, id: Id) -> String {
    let mut text = printer.at_least(id, Binding::Any);
    if let Some((cut, _)) = text.char_indices().nth(LONGEST) {
        text.truncate(cut);
        text.push('…');
    }
    text
}

struct Printer<'g> {
    graph: &'g Graph,
    /// Operations around what is being written.
    depth: Cell<usize>,
    /// Characters that may still be written.
    left: Cell<usize>,
    /// Whether numbers are written exactly.
    exact: bool,
}

impl<'g> Printer<'g> {
    fn new(graph: &'g Graph, exact: bool) -> Self {
        Printer { graph, depth: Cell::new(0), left: Cell::new(LONGEST), exact }
    }

    fn at_least(&self, id: Id, least: Binding) -> String {
        let (text, binding) = self.text(id);
        if binding >= least { text } else { format!("({text})") }
    }

    fn text(&self, id: Id) -> (String, Binding) {
        if self.left.get() == 0 || self.depth.get() == DEEPEST {
            return ("…".to_owned(), Binding::Atom);
        }
        self.depth.set(self.depth.get() + 1);
        let (text, binding) = self.node(id);
        self.depth.set(self.depth.get() - 1);
        self.left.set(self.left.get().saturating_sub(text.len()));
        (text, binding)
    }

    fn node(&self, id: Id) -> (String, Binding) {
        let list = |parts: &[Id]| {
            parts
                .iter()
                .map(|part| self.at_least(*part, Binding::Any))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let call = |name: &str, parts: &[Id]| (format!("{name}({})", list(parts)), Binding::Atom);
        match self.graph.node(id) {
            Node::Number(value) => self.number(value),
            Node::Zero(_) => ("0".to_owned(), Binding::Atom),
            Node::Identity => ("identity".to_owned(), Binding::Atom),
            Node::Symbol(symbol) => (symbol.name.clone(), Binding::Atom),
            Node::Truth(value) => (value.to_string(), Binding::Atom),
            Node::Sum(terms) => self.sum(terms),
            Node::Product(factors) => self.product(factors, None),
            Node::Function(function, a) => call(function.name(), &[*a]),
            Node::Compare(relation, a, b) => {
                let sign = match relation {
                    Relation::Less => "<",
                    Relation::LessOrEqual => "<=",
                };
                let (a, b) = (self.at_least(*a, Binding::Sum), self.at_least(*b, Binding::Sum));
                (format!("{a} {sign} {b}"), Binding::Compare)
            }
            Node::And(a, b) => self.chain(*a, "and", *b),
            Node::Or(a, b) => self.chain(*a, "or", *b),
            Node::Not(a) => (format!("not {}", self.at_least(*a, Binding::Compare)), Binding::Not),
            Node::Select(mask, a, b) => call("select", &[*mask, *a, *b]),
            Node::Scale(scalar, x) => match self.graph.node(*scalar) {
                Node::Product(factors) => self.product(factors, Some(*x)),
                _ => self.product(&[(*scalar, Rational::one())], Some(*x)),
            },
            Node::Dot(a, b) => call("dot", &[*a, *b]),
            Node::Apply(matrix, x) => {
                let matrix = self.at_least(*matrix, Binding::Atom);
                // A product of matrices and a vector needs no parentheses: only the vector ends it.
                let tight = matches!(self.graph.node(*x), Node::Apply(..));
                let x = self.at_least(*x, if tight { Binding::Product } else { Binding::Power });
                (format!("{matrix}*{x}"), Binding::Product)
            }
            Node::Transpose(a) => call("transpose", &[*a]),
            Node::Outer(a, b) => call("outer", &[*a, *b]),
        }
    }

    fn number(&self, value: &Rational) -> (String, Binding) {
        number(value, self.exact)
    }

    fn chain(&self, a: Id, word: &str, b: Id) -> (String, Binding) {
        // "and" and "or" are never mixed without parentheses.
        let (a, b) = (self.at_least(a, Binding::Not), self.at_least(b, Binding::Not));
        (format!("{a} {word} {b}"), Binding::Any)
    }

    fn sum(&self, terms: &[(Id, Rational)]) -> (String, Binding) {
        let mut text = String::new();
        for (place, (term, coefficient)) in terms.iter().enumerate() {
            let negative = coefficient.is_negative();
            text.push_str(match (place, negative) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            });
            text.push_str(&self.multiple(&coefficient.abs(), *term));
        }
        let alone = terms.len() == 1 && !terms[0].1.is_negative();
        (text, if alone { Binding::Product } else { Binding::Sum })
    }

    /// coefficient·term for a coefficient above zero.
    fn multiple(&self, coefficient: &Rational, term: Id) -> String {
        if self.graph.is_one(term) {
            return self.number(coefficient).0;
        }
        let text = self.at_least(term, Binding::Product);
        if coefficient.is_one() { text } else { format!("{}*{text}", self.number(coefficient).0) }
    }

    /// Π base^exponent, times a vector or matrix.
    fn product(&self, factors: &[(Id, Rational)], tensor: Option<Id>) -> (String, Binding) {
        let (above, below): (Vec<_>, Vec<_>) =
            factors.iter().partition(|(_, exponent)| exponent.is_positive());
        let mut parts: Vec<String> = above.iter().map(|(base, e)| self.power(*base, e)).collect();
        parts.extend(tensor.map(|tensor| self.at_least(tensor, Binding::Power)));
        let mut text = if parts.is_empty() { "1".to_owned() } else { parts.join("*") };
        for (base, exponent) in &below {
            text.push('/');
            text.push_str(&self.power(*base, &-exponent));
        }
        let single = parts.len() == 1 && below.is_empty();
        (text, if single { Binding::Power } else { Binding::Product })
    }

    /// base^exponent for an exponent above zero.
    fn power(&self, base: Id, exponent: &Rational) -> String {
        if exponent.is_one() {
            return self.at_least(base, Binding::Power);
        }
        if *exponent == Rational::half() {
            return format!("sqrt({})", self.at_least(base, Binding::Any));
        }
        let base = self.at_least(base, Binding::Atom);
        if exponent.is_integer() {
            format!("{base}^{exponent}")
        } else {
            format!("{base}^({exponent})")
        }
    }
}

/// A number: decimal where that is exact and short, else a fraction, or rounded unless `exact`.
fn number(value: &Rational, exact: bool) -> (String, Binding) {
    const SHORT: usize = 12;
    let text = if value.is_integer() && (exact || value.to_string().len() <= SHORT) {
        value.to_string()
    } else {
        let nearest = crate::rational::nearest(value);
        let decimal = nearest.to_string();
        let is_exact = decimal.len() <= SHORT
            && crate::units::decimal(&decimal)
                .is_some_and(|(read, _)| read.as_ref() == Some(value));
        let fraction = value.to_string();
        if is_exact {
            decimal
        } else if exact || fraction.len() <= 5 {
            fraction
        } else {
            whirl_text::shown(nearest, 9, 1e-4..1e9)
        }
    };
    let binding = match value.is_negative() {
        true => Binding::Sum,
        false if text.contains('/') => Binding::Product,
        false => Binding::Atom,
    };
    (text, binding)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::diagnostic::Located;
    use crate::expression::{Function, Symmetry};
    use crate::formula;

    fn names(graph: &mut Graph) -> BTreeMap<String, Id> {
        let mut names = BTreeMap::new();
        for name in ["a", "b", "c"] {
            names.insert(name.to_owned(), graph.scalar(name));
        }
        for name in ["x", "y"] {
            names.insert(name.to_owned(), graph.vector(name));
        }
        for (name, symmetry) in
            [("S", Symmetry::Symmetric), ("H", Symmetry::Skew), ("N", Symmetry::None)]
        {
            names.insert(name.to_owned(), graph.matrix(name, symmetry));
        }
        names
    }

    fn lowered(graph: &mut Graph, names: &BTreeMap<String, Id>, text: &str) -> Id {
        let formula = formula::parse(&Located::alone("f", text)).expect(text);
        formula::lower(&formula, graph, names).expect(text)
    }

    #[test]
    fn formulas_read_back_as_the_same_node() {
        let mut graph = Graph::new();
        let names = names(&mut graph);
        for text in [
            "a + b - c",
            "-(a + b)*c",
            "-a",
            "-2*a",
            "a - (b - c)",
            "2/3*a - 5/7",
            "a/(b*c)",
            "1/a",
            "1/(a + b)^2",
            "(a + b)^2*c^3",
            "(-2*a)^(1/3)",
            "a^(2/3)/b^(3/2)",
            "sqrt(a + b)",
            "exp(-a)*sin(b - c)",
            "log(a)^2 - tanh(a/b)",
            "(a*b + c)^(-1/3)",
            "a < b and (b <= c or not a < c)",
            "not (a < b and b < c)",
            "a*x - 2*y",
            "(a + b)*x",
            "-(x + y)",
            "S*(x + y)",
            "S*H*x - N*y",
            "S*(a*x + y)",
            "a*(S*x)",
            "transpose(N)*x",
            "dot(x + y, S*x)*y/b",
            "outer(x, S*y) - a*S + transpose(N)",
            "a/b*(x - y)",
            "(a - b)*S",
            "0.25*x",
        ] {
            let id = lowered(&mut graph, &names, text);
            let shown = display(&graph, id);
            assert_eq!(lowered(&mut graph, &names, &shown), id, "{text} shown as {shown}");
        }
    }

    #[test]
    fn deep_formulas_are_cut_before_the_stack_ends() {
        let mut graph = Graph::new();
        let mut id = graph.scalar("a");
        let one = graph.integer(1);
        for _ in 0..100_000 {
            let exponential = graph.function(Function::Exp, id);
            id = graph.add(exponential, one);
        }
        for shown in [display(&graph, id), display_rounded(&graph, id)] {
            assert!(shown.contains('…'), "{shown}");
            assert!(shown.len() < 20 * DEEPEST, "{} bytes", shown.len());
        }
    }

    #[test]
    fn numbers_for_people_are_short() {
        let mut graph = Graph::new();
        let names = names(&mut graph);
        for (text, expected) in [
            ("a/3 - 1/7", "1/3*a - 1/7"),
            ("233/6517*a", "0.0357526469*a"),
            ("-1e-9/7*a", "-1.42857143e-10*a"),
            ("123456789012345*a + 0.5", "1.23456789e14*a + 0.5"),
        ] {
            let id = lowered(&mut graph, &names, text);
            assert_eq!(display_rounded(&graph, id), expected);
        }
    }

    #[test]
    fn texts_are_short() {
        let mut graph = Graph::new();
        let names = names(&mut graph);
        for (text, expected) in [
            ("2*a*(x + S*y)", "2*a*(x + S*y)"),
            ("-2*dot(x + S*y, y)*a", "-2*a*dot(y, x + S*y)"),
            ("a^2*S - 2*a*H", "a^2*S - 2*a*H"),
            ("a - 1/2*b", "a - 0.5*b"),
        ] {
            let id = lowered(&mut graph, &names, text);
            assert_eq!(display(&graph, id), expected);
        }
    }
}
