//! Each rule by what it does and by signatures.

use super::*;
use crate::diagnostic::Located;
use crate::expression::{Relation, display};
use crate::formula;

/// `when(a < b)` cannot be written in a formula: m stands for it, and `select` for the choice.
struct Reader {
    graph: Graph,
    names: BTreeMap<String, Id>,
    mask: Id,
}

impl Reader {
    fn new() -> Self {
        let mut graph = Graph::new();
        let names: BTreeMap<String, Id> =
            ["a", "b", "c", "d"].map(|name| (name.to_owned(), graph.scalar(name))).into();
        let mask = graph.compare(Relation::Less, names["a"], names["b"]);
        Reader { graph, names, mask }
    }

    fn read(&mut self, text: &str) -> Id {
        let formula = formula::parse(&Located::alone("f", text)).expect(text);
        formula::lower(&formula, &mut self.graph, &self.names).expect(text)
    }

    fn select(&mut self, a: &str, b: &str) -> Id {
        let (a, b) = (self.read(a), self.read(b));
        self.graph.select(self.mask, a, b)
    }

    fn simple(&mut self, id: Id) -> String {
        let simple = simplify(&mut self.graph, &[id]);
        assert!(self.graph.same_signature(id, simple[0]));
        self.keeps_meaning_at_negative_values(id, simple[0]);
        display(&self.graph, simple[0])
    }

    /// Symbols are positive at the points of the signatures; here each in turn is not.
    fn keeps_meaning_at_negative_values(&mut self, id: Id, simple: Id) {
        for name in ["a", "b", "c", "d"] {
            let symbol = self.names[name];
            let by = BTreeMap::from([(symbol, self.graph.neg(symbol))]);
            let (x, y) = (self.graph.substitute(id, &by), self.graph.substitute(simple, &by));
            assert!(self.graph.same_signature(x, y), "{name} below zero");
        }
    }
}

#[test]
fn rules_apply_where_they_save_operations() {
    for (text, expected) in [
        ("log(exp(a*b))", "a*b"),
        ("exp(log(a))", "a"),
        ("tan(atan(a + b))", "a + b"),
        ("exp(a)*exp(b)*c", "c*exp(a + b)"),
        ("1/exp(a)", "exp(-a)"),
        ("exp(a)^2/exp(b)", "exp(2*a - b)"),
        ("log(exp(a) + 1) - log(exp(b) + 1)", "log((1 + exp(a))/(1 + exp(b)))"),
        ("sin(a)^2 + cos(a)^2", "1"),
        ("c*sin(a)^2 + c*cos(a)^2 + b", "b + c"),
        ("3*sin(a)^2 + 2*cos(a)^2", "2 + sin(a)^2"),
        ("sin(a)^2/cos(a)^2", "tan(a)^2"),
        ("b*(exp(a) - exp(-a))/(exp(a) + exp(-a))", "b*tanh(a)"),
        ("sinh(2*a)/cosh(2*a)", "tanh(2*a)"),
        ("abs(a)^2*b", "b*a^2"),
        ("sqrt(a^2)", "abs(a)"),
        ("(a^4)^(1/4)", "abs(a)"),
    ] {
        let mut reader = Reader::new();
        let id = reader.read(text);
        let found = reader.simple(id);
        let (found, expected) = (reader.read(&found), reader.read(expected));
        assert_eq!(found, expected, "{text}: {}", display(&reader.graph, found));
    }
}

#[test]
fn choices_of_one_condition_become_one() {
    let mut r = Reader::new();
    let (x, y) = (r.select("c", "0"), r.select("d^2", "c"));
    let (sum, expected) = (r.graph.add(x, y), r.select("c + d^2", "c"));
    assert_eq!(simplify(&mut r.graph, &[sum]), [expected]);
    let product = r.graph.mul(x, y);
    let one = r.select("c*d^2", "0");
    assert_eq!(simplify(&mut r.graph, &[product]), [one]);
    let third = r.read("d");
    let (nested, plain) = (r.graph.select(r.mask, third, y), r.select("d", "c"));
    assert_eq!(simplify(&mut r.graph, &[nested]), [plain]);
    let (common, inner) = (r.select("2*c*d", "c*b"), r.select("2*d", "b"));
    let expected = r.graph.mul(r.names["c"], inner);
    assert_eq!(simplify(&mut r.graph, &[common]), [expected]);
}

#[test]
fn what_costs_more_is_left_alone() {
    for text in ["a*b + a*c", "sin(a)*cos(a)", "exp(a) + exp(b)", "sin(a)^2", "a^2 + b^2"] {
        let mut r = Reader::new();
        let id = r.read(text);
        assert_eq!(simplify(&mut r.graph, &[id]), [id], "{text}");
    }
    // Both exponentials are needed anyhow: a third for their product would cost more.
    let mut r = Reader::new();
    let roots = [r.read("exp(a)*exp(b)"), r.read("exp(a)"), r.read("exp(b)")];
    assert_eq!(simplify(&mut r.graph, &roots), roots);
}

#[test]
fn every_rule_is_used_by_these_tests() {
    let texts = [
        "log(exp(a))",
        "exp(log(a))",
        "tan(atan(a))",
        "exp(a)*exp(b)",
        "log(exp(a) + 1) + log(exp(b) + 1)",
        "sin(a)^2 + cos(a)^2",
        "sin(a)/cos(a)",
        "(exp(a) - exp(-a))/(exp(a) + exp(-a))",
        "abs(a)^2",
        "sqrt(a^2)",
    ];
    let mut r = Reader::new();
    let mut ids: Vec<Id> = texts.iter().map(|text| r.read(text)).collect();
    let (x, y, z) = (r.select("c", "0"), r.select("d", "c"), r.select("c*d", "c*b"));
    let one = r.read("1");
    ids.extend([r.graph.select(r.mask, one, y), r.graph.add(x, y), r.graph.mul(x, y), z]);
    for (name, rule) in RULES {
        let applied = ids.iter().filter_map(|id| {
            rule(&mut r.graph, *id).filter(|other| other != id).map(|other| (*id, other))
        });
        let applied: Vec<_> = applied.collect();
        assert!(!applied.is_empty(), "{name}");
        for (id, other) in applied {
            assert!(r.graph.same_signature(id, other), "{name}");
            r.keeps_meaning_at_negative_values(id, other);
        }
    }
}
