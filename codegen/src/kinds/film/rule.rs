//! Points in one direction of a cell, and the functions of its nodes there.

use num_traits::{One, Zero};

use crate::rational::Rational;

/// Points in −1 … 1 with weights that sum to 2.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Rule {
    /// As the file says it.
    pub(crate) text: String,
    pub(crate) points: Vec<(Rational, Rational)>,
}

/// All that a file may say.
pub(super) const WORDS: &[&str] = &["midpoint", "gauss(2)", "gauss(3)", "lobatto(2)", "lobatto(3)"];

/// The word for the nodes of the cell in both directions.
pub(super) const NODES: &str = "nodes";

impl Rule {
    /// The rule of one of [`WORDS`].
    pub(super) fn called(word: &str) -> Option<Rule> {
        let ratio = |n: i64, d: i64| Rational::new(n, d);
        // Where a point is irrational: the nearest number, as the kernel would have it.
        let root = |of: f64| Rational::from_float(of.sqrt()).expect("a finite number");
        let symmetric = |at: Rational, weight: Rational, middle: Option<Rational>| {
            let mut points = vec![(-at.clone(), weight.clone())];
            points.extend(middle.map(|weight| (Rational::zero(), weight)));
            points.push((at, weight));
            points
        };
        let points = match word {
            "midpoint" => vec![(Rational::zero(), ratio(2, 1))],
            "gauss(2)" => symmetric(root(1.0 / 3.0), Rational::one(), None),
            "gauss(3)" => symmetric(root(0.6), ratio(5, 9), Some(ratio(8, 9))),
            "lobatto(2)" => symmetric(Rational::one(), Rational::one(), None),
            "lobatto(3)" => symmetric(Rational::one(), ratio(1, 3), Some(ratio(4, 3))),
            _ => return None,
        };
        Some(Rule { text: word.to_owned(), points })
    }

    /// The nodes of a direction with so many.
    pub(super) fn nodes(count: usize) -> Rule {
        Rule::called(if count == 2 { "lobatto(2)" } else { "lobatto(3)" }).expect("a rule")
    }
}

/// Values and slopes at ξ of the functions of 2 or 3 nodes, evenly spaced from −1 to 1.
pub(super) fn shape(nodes: usize, at: &Rational) -> Vec<(Rational, Rational)> {
    let half = Rational::new(1, 2);
    let one = Rational::one();
    let x = at;
    if nodes == 2 {
        let value = |sign: &Rational| &half * &(&one + &(sign * x));
        return [-one.clone(), one.clone()]
            .iter()
            .map(|sign| (value(sign), &half * sign))
            .collect();
    }
    let two = Rational::from(2);
    let side = |sign: &Rational| {
        let value = &half * &(x * &(x + sign));
        (value, &half * &(&(&two * x) + sign))
    };
    let middle = (&one - &(x * x), -(&two * x));
    vec![side(&-one.clone()), middle, side(&one)]
}

#[cfg(test)]
mod tests {
    use num_traits::ToPrimitive;

    use super::*;

    fn number(value: &Rational) -> f64 {
        value.to_f64().expect("a finite number")
    }

    #[test]
    fn rules_integrate_what_they_should() {
        for (word, degree) in [
            ("midpoint", 1),
            ("gauss(2)", 3),
            ("gauss(3)", 5),
            ("lobatto(2)", 1),
            ("lobatto(3)", 3),
        ] {
            let rule = Rule::called(word).unwrap();
            for power in 0..=degree {
                let terms =
                    rule.points.iter().map(|(at, weight)| number(weight) * number(at).powi(power));
                let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
                assert!((terms.sum::<f64>() - exact).abs() < 1e-15, "{word} {power}");
            }
        }
        assert!(WORDS.iter().all(|word| Rule::called(word).is_some()));
        assert_eq!(Rule::called("gauss(7)"), None);
    }

    #[test]
    fn functions_of_nodes_are_one_at_their_own() {
        for nodes in [2, 3] {
            for a in 0..nodes {
                let at = Rational::new(2 * a as i64, nodes as i64 - 1) - Rational::one();
                for (b, (value, _)) in shape(nodes, &at).iter().enumerate() {
                    assert_eq!(number(value), f64::from(u8::from(a == b)));
                }
            }
            let step = Rational::new(1, 1024);
            for at in [Rational::new(-2, 7), Rational::new(3, 5)] {
                let [below, here, above] =
                    [&at - &step, at.clone(), &at + &step].map(|at| shape(nodes, &at));
                for a in 0..nodes {
                    // Exact for parabolas.
                    let slope = &(&above[a].0 - &below[a].0) / &(&Rational::from(2) * &step);
                    assert_eq!(slope, here[a].1);
                }
            }
        }
    }
}
