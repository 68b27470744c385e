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

    /// No rule changes it.
    fn is_left_alone(&mut self, id: Id, what: &str) {
        for (name, rule) in RULES {
            let other = rule(&mut self.graph, id);
            assert!(other.is_none_or(|other| other == id), "{name}: {what}");
        }
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

fn becomes(text: &str, expected: &str) {
    let mut r = Reader::new();
    let id = r.read(text);
    let found = r.simple(id);
    let (found, expected) = (r.read(&found), r.read(expected));
    assert_eq!(found, expected, "{text}: {}", display(&r.graph, found));
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
        becomes(text, expected);
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

/// The choice between a piece and nothing taken for nothing: right for all but a gap of 30 µm.
fn forgets_the_piece(graph: &mut Graph, id: Id) -> Option<Id> {
    match *graph.node(id) {
        Node::Select(_, _, behind) => Some(behind),
        _ => None,
    }
}

#[test]
fn a_rule_that_is_wrong_where_a_law_acts_is_noticed() {
    use crate::diagnostic::Source;
    use crate::kinds::law::LawSpec;
    let text = "kind = \"law\"\nname = \"gap\"\ntitle = \"t\"\nsource = \"s\"\n[inputs.h]\nunit = \"mm\"\n\
                [outputs.Q]\nunit = \"N\"\npieces = [\n\
                { when = 'h < 0.03', value = '1e-3*(0.03 - h)' },\n{ value = '0' },\n]\n";
    let law = LawSpec::read(&Source::new("laws/gap.toml", text)).expect("a law");
    let mut graph = law.graph.clone();
    let value = law.outputs[0].value;
    assert!(graph.points() >= 6);
    simplify(&mut graph, &[value]);
    assert_eq!(graph.changed(), None);
    simplify_by(&[("wrong", forgets_the_piece)], &mut graph, &[value]);
    assert_eq!(graph.changed(), Some(value));
    // The force is 3e-8 N at most: what is wrong by a millionth of it is noticed, too.
    let piece = law.outputs[0].pieces[0].node;
    let wrong = graph.times(Rational::new(1_000_001, 1_000_000), piece);
    let by = BTreeMap::from([(piece, wrong)]);
    let wrong = graph.substitute(value, &by);
    assert!(!graph.same_signature(value, wrong));
}

#[test]
fn costs_count_operations() {
    for (text, expected) in [
        ("a", 0),
        ("a + b", 1),
        ("2 + a", 1),
        ("a - b", 1),
        ("2*a - b", 2),
        ("2*a + 3*b", 3),
        ("a*b*c", 2),
        ("a^2", 1),
        ("a^3", 2),
        ("a^4", 2),
        ("a^7*b", 5),
        ("1/a", 8),
        ("sqrt(a)", 8),
        ("b/sqrt(a)", 17),
        ("a^2.5", 8),
        ("a^(1/3)", 40),
        ("a^2.25", 40),
        ("exp(a)", 40),
        ("abs(a)", 1),
        ("exp(a)*b + exp(a)*c + exp(a)", 44),
    ] {
        let mut r = Reader::new();
        let id = r.read(text);
        assert_eq!(cost(&r.graph, &[id]), expected, "{text}");
    }
    // The condition, one joined to it, and the choice.
    let mut r = Reader::new();
    let choice = r.select("c", "d");
    assert_eq!(cost(&r.graph, &[choice]), 2);
    let other = r.graph.compare(Relation::Less, r.names["b"], r.names["c"]);
    let both = r.graph.and(r.mask, other);
    let (c, d) = (r.names["c"], r.names["d"]);
    let joined = r.graph.select(both, c, d);
    assert_eq!(cost(&r.graph, &[joined]), 4);
    assert_eq!(cost(&r.graph, &[joined, choice]), 5, "what is shared counts once");
}

#[test]
fn what_costs_the_same_is_left_alone() {
    // c*d is needed anyhow: taking c out of the choice saves nothing.
    let mut r = Reader::new();
    let roots = [r.select("c*d", "c*b"), r.read("c*d")];
    assert_eq!(simplify(&mut r.graph, &roots), roots);
}

#[test]
fn trying_ends_where_the_budget_is_spent() {
    // One rule applies, once: at the root. Three nodes are visited again for it, once for each root and for the cost.
    let mut r = Reader::new();
    let root = r.read("log(exp(a))");
    let best = cost(&r.graph, &[root]);
    let mut budget = 5;
    assert_eq!(improved(RULES, &mut r.graph, &[root], best, &mut budget), None);
    budget = 7;
    assert_eq!(
        improved(RULES, &mut r.graph, &[root], best, &mut budget),
        Some((vec![r.names["a"]], 0))
    );
    assert_eq!(budget, 1);
}

#[test]
fn rules_leave_alone_what_only_resembles() {
    for text in [
        "log(a)",
        "exp(exp(a))",
        "atan(tan(a))",
        "log(a) + log(b)",
        "log(a + 1) + log(b + 1)",
        "log(exp(a) - 1) + log(exp(b) + 1)",
        "log(a*exp(b) + 1) + log(exp(b) + 1)",
        "0.5*log(exp(a) + 1) + log(exp(b) + 1)",
        "log(exp(a) + 1) + log(b)",
        "sin(a)^2 + cos(b)^2",
        "sin(a)^3 + cos(a)^2",
        "sin(a)^2 + cos(a)^3",
        "cos(a)^2 + tan(a)^2",
        "b*sin(a)^2 + c*cos(a)^2",
        "b*sin(a)^2 + cos(a)^2",
        "sin(a)/cos(b)",
        "sin(a)^2/cos(a)",
        "sin(a)*cos(a)",
        "sqrt(sin(a))/sqrt(cos(a))",
        "cos(a)/tan(a)",
        "(exp(a) - exp(-a))/(exp(a) + exp(-a))^2",
        "(exp(a) - exp(-a))*(exp(a) + exp(-a))",
        "sqrt(exp(a) - exp(-a))/sqrt(exp(a) + exp(-a))",
        "(exp(a) + exp(-a))/(exp(a) - exp(-a))",
        "(exp(a) - exp(-b))/(exp(a) + exp(-b))",
        "(exp(a) - exp(-a))/(exp(b) + exp(-b))",
        "(exp(a) - 2*exp(-a))/(exp(a) + exp(-a))",
        "(exp(a) - exp(-a))/(exp(a) + 2*exp(-a))",
        "(exp(a) - exp(-a) + 1)/(exp(a) + exp(-a))",
        "(a - b)/(a + b)",
        "abs(a)",
        "abs(a)^3",
        "1/abs(a)",
        "sqrt(a^3)",
        "sqrt(a^2*b)",
        "sqrt(a)",
    ] {
        let mut r = Reader::new();
        let id = r.read(text);
        r.is_left_alone(id, text);
    }
    let mut r = Reader::new();
    let other = r.graph.compare(Relation::Less, r.names["b"], r.names["c"]);
    let (c, d) = (r.names["c"], r.names["d"]);
    let (one, two) = (r.select("c", "d"), r.graph.select(other, d, c));
    let (sum, product) = (r.graph.add(one, two), r.graph.mul(one, two));
    let nested = [r.graph.select(r.mask, two, d), r.graph.select(r.mask, d, two)];
    for (id, what) in [(one, "choice"), (sum, "sum"), (product, "product")] {
        r.is_left_alone(id, what);
    }
    nested.into_iter().for_each(|id| r.is_left_alone(id, "another condition within"));
    // Where the first piece holds the second is not divided by.
    let (gap, ramp) = (r.select("c", "0"), r.select("d", "c"));
    let quotient = r.graph.div(ramp, gap);
    r.is_left_alone(quotient, "a quotient by a piece of zero");
}

#[test]
fn rules_apply_in_all_their_forms() {
    for (text, expected) in [
        ("2*sin(a)^2 + 3*cos(a)^2", "2 + cos(a)^2"),
        ("2*cos(a)^2 - 3*sin(a)^2 + d", "2 - 5*sin(a)^2 + d"),
        ("b*d*sin(a)^2 + b*d*cos(a)^2", "b*d"),
        ("c*cos(b)/sin(b)", "c/tan(b)"),
        ("(3*exp(a) - 3*exp(-a))/(2*exp(a) + 2*exp(-a))", "1.5*tanh(a)"),
        ("(exp(a) - exp(-a))^2/(exp(a) + exp(-a))^2", "tanh(a)^2"),
        ("(exp(-a) - exp(a))/(exp(a) + exp(-a))", "-tanh(a)"),
        ("2*log(exp(a) + 1) - log(exp(b) + 1) + c", "log((1 + exp(a))^2/(1 + exp(b))) + c"),
        (
            "log(exp(a)*(exp(b) + 1) + 1) + log(exp(b) + 2)",
            "log((1 + exp(a)*(1 + exp(b)))*(2 + exp(b)))",
        ),
        ("1/abs(a)^2", "1/a^2"),
        ("b*sqrt(a^6)", "b*abs(a)^3"),
    ] {
        becomes(text, expected);
    }
}

#[test]
fn choices_keep_what_stands_beside_them() {
    let mut r = Reader::new();
    let (x, y) = (r.select("c", "0"), r.select("d", "c"));
    let (two, three) = (Rational::from(2), Rational::from(-3));
    let rest = r.read("a*b");
    let sum = r.graph.sum(&[(x, two.clone()), (y, Rational::one()), (rest, Rational::one())]);
    let choice = r.select("2*c + d", "c");
    let expected = r.graph.add(choice, rest);
    assert_eq!(simplify(&mut r.graph, &[sum]), [expected]);
    // The piece of zero is multiplied by, and only divided by the other's.
    let product = r.graph.product(&[(x, two), (y, three), (r.names["a"], Rational::one())]);
    let choice = r.select("c^2/d^3", "0");
    let expected = r.graph.mul(choice, r.names["a"]);
    assert_eq!(simplify(&mut r.graph, &[product]), [expected]);
    // A choice of vectors has no factors that are scalars.
    let (u, v) = (r.graph.vector("u"), r.graph.vector("v"));
    let vectors = r.graph.select(r.mask, u, v);
    r.is_left_alone(vectors, "vectors");
}
