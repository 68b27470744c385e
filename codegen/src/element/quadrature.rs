//! Quadrature rules with exact points and weights, and the proof of their degree.

use std::collections::BTreeMap;

use num_traits::{One, Zero};

use super::cell::Cell;
use super::exact;
use crate::diagnostic::Located;
use crate::expression::{Graph, Id, Rational, normal};
use crate::formula::{lower, parse};

/// A point of a rule: reference coordinates and weight, exact numbers of a graph.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Point {
    /// ξ, η, ζ.
    pub at: [Id; 3],
    /// Weight; the weights sum to the cell's volume.
    pub weight: Id,
}

/// A rule on a reference cell.
#[derive(Debug, Clone)]
pub struct Quadrature {
    /// The rule in words, such as `gauss(2) × gauss(2) × gauss(2)`.
    pub title: String,
    /// The points.
    pub points: Vec<Point>,
    /// Every monomial up to this total degree is integrated exactly.
    pub degree: u32,
    /// Where it stands in the file.
    pub place: std::ops::Range<usize>,
}

/// A monomial that a rule should integrate and does not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DegreeFailure {
    /// Exponents of ξ, η, ζ.
    pub powers: [u32; 3],
    /// What the rule gives.
    pub found: String,
    /// The exact integral.
    pub exact: String,
}

impl DegreeFailure {
    /// The monomial as in a formula, such as `xi^2*eta`; `1` of degree 0.
    pub fn monomial(&self) -> String {
        let factors: Vec<String> = ["xi", "eta", "zeta"]
            .iter()
            .zip(self.powers)
            .filter(|(_, power)| *power > 0)
            .map(
                |(name, power)| {
                    if power == 1 { name.to_string() } else { format!("{name}^{power}") }
                },
            )
            .collect();
        if factors.is_empty() { "1".to_owned() } else { factors.join("*") }
    }
}

impl Quadrature {
    /// Integrates every monomial up to `degree` and compares with the exact integral over the cell.
    ///
    /// # Errors
    /// The first monomial, by degree, that is not integrated exactly.
    pub fn prove(&self, graph: &mut Graph, cell: Cell) -> Result<(), DegreeFailure> {
        for total in 0..=self.degree {
            for i in (0..=total).rev() {
                for j in (0..=total - i).rev() {
                    self.integrates(graph, cell, [i, j, total - i - j])?;
                }
            }
        }
        Ok(())
    }

    fn integrates(
        &self,
        graph: &mut Graph,
        cell: Cell,
        powers: [u32; 3],
    ) -> Result<(), DegreeFailure> {
        let mut terms = vec![(graph.integer(0), Rational::one())];
        for point in &self.points {
            let mut factors = vec![(point.weight, Rational::one())];
            for (x, power) in point.at.iter().zip(powers) {
                factors.push((*x, Rational::from_integer(power.into())));
            }
            factors.retain(|(_, power)| !power.is_zero());
            terms.push((graph.product(&factors), Rational::one()));
        }
        let sum = graph.sum(&terms);
        let found = normal::expand(graph, sum);
        let exact = graph.number(cell.monomial(powers));
        if normal::equal(graph, found, exact) {
            return Ok(());
        }
        let [found, exact] = [found, exact].map(|id| exact::display(graph, id));
        Err(DegreeFailure { powers, found, exact })
    }
}

/// A named rule: family, number of points, then for each point its coordinates and its weight.
type Named = (&'static str, usize, &'static [&'static [&'static str]]);

/// Rules on the line −1 … 1 (Gauss–Legendre), on the unit triangle (Strang & Fix; Radon) and on the unit
/// tetrahedron (Hammer & Stroud).
const RULES: &[Named] = &[
    ("gauss", 1, &[&["0", "2"]]),
    ("gauss", 2, &[&["-1/sqrt(3)", "1"], &["1/sqrt(3)", "1"]]),
    ("gauss", 3, &[&["-sqrt(15)/5", "5/9"], &["0", "8/9"], &["sqrt(15)/5", "5/9"]]),
    (
        "gauss",
        4,
        &[
            &["-sqrt(3/7 + 2*sqrt(30)/35)", "1/2 - sqrt(30)/36"],
            &["-sqrt(3/7 - 2*sqrt(30)/35)", "1/2 + sqrt(30)/36"],
            &["sqrt(3/7 - 2*sqrt(30)/35)", "1/2 + sqrt(30)/36"],
            &["sqrt(3/7 + 2*sqrt(30)/35)", "1/2 - sqrt(30)/36"],
        ],
    ),
    ("triangle", 1, &[&["1/3", "1/3", "1/2"]]),
    ("triangle", 3, &[&["1/6", "1/6", "1/6"], &["2/3", "1/6", "1/6"], &["1/6", "2/3", "1/6"]]),
    (
        "triangle",
        7,
        &[
            &["1/3", "1/3", "9/80"],
            &["(6 - sqrt(15))/21", "(6 - sqrt(15))/21", "(155 - sqrt(15))/2400"],
            &["(9 + 2*sqrt(15))/21", "(6 - sqrt(15))/21", "(155 - sqrt(15))/2400"],
            &["(6 - sqrt(15))/21", "(9 + 2*sqrt(15))/21", "(155 - sqrt(15))/2400"],
            &["(6 + sqrt(15))/21", "(6 + sqrt(15))/21", "(155 + sqrt(15))/2400"],
            &["(9 - 2*sqrt(15))/21", "(6 + sqrt(15))/21", "(155 + sqrt(15))/2400"],
            &["(6 + sqrt(15))/21", "(9 - 2*sqrt(15))/21", "(155 + sqrt(15))/2400"],
        ],
    ),
    ("tetrahedron", 1, &[&["1/4", "1/4", "1/4", "1/6"]]),
    (
        "tetrahedron",
        4,
        &[
            &["(5 - sqrt(5))/20", "(5 - sqrt(5))/20", "(5 - sqrt(5))/20", "1/24"],
            &["(5 + 3*sqrt(5))/20", "(5 - sqrt(5))/20", "(5 - sqrt(5))/20", "1/24"],
            &["(5 - sqrt(5))/20", "(5 + 3*sqrt(5))/20", "(5 - sqrt(5))/20", "1/24"],
            &["(5 - sqrt(5))/20", "(5 - sqrt(5))/20", "(5 + 3*sqrt(5))/20", "1/24"],
        ],
    ),
];

/// Every named rule, such as `gauss(2)`.
pub fn names() -> Vec<String> {
    RULES.iter().map(|(family, n, _)| format!("{family}({n})")).collect()
}

/// The family of a named rule, such as `gauss` of `gauss(2)`; `None` if there is no such rule.
pub fn family(name: &str) -> Option<&'static str> {
    find(name).map(|(family, ..)| *family)
}

fn find(name: &str) -> Option<&'static Named> {
    RULES.iter().find(|(family, n, _)| *name == format!("{family}({n})"))
}

/// The product of named rules whose coordinates together are ξ, η, ζ; the first runs fastest. `None` if a
/// name is unknown or the coordinates are not three.
pub fn product(graph: &mut Graph, names: &[&str]) -> Option<Vec<Point>> {
    let mut points: Vec<(Vec<Id>, Id)> = vec![(Vec::new(), graph.integer(1))];
    for name in names {
        let (.., rule) = find(name)?;
        let mut next = Vec::new();
        for numbers in *rule {
            let numbers: Vec<Id> = numbers.iter().map(|text| constant(graph, text)).collect();
            let (weight, at) = numbers.split_last()?;
            for (before, factor) in &points {
                let at = before.iter().chain(at).copied().collect();
                next.push((at, graph.mul(*factor, *weight)));
            }
        }
        points = next;
    }
    points.into_iter().map(|(at, weight)| Some(Point { at: at.try_into().ok()?, weight })).collect()
}

fn constant(graph: &mut Graph, text: &str) -> Id {
    let formula = parse(&Located::alone("named rule", text));
    formula.and_then(|formula| lower(&formula, graph, &BTreeMap::new())).expect("a constant")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn proven(cell: Cell, rules: &[&str], degree: u32) -> Result<(), String> {
        let mut graph = Graph::new();
        let points = product(&mut graph, rules).expect("a rule");
        let rule = Quadrature { title: rules.join(" × "), points, degree, place: 0..0 };
        rule.prove(&mut graph, cell).map_err(|failure| {
            format!("{}: {} instead of {}", failure.monomial(), failure.found, failure.exact)
        })
    }

    #[test]
    fn every_named_rule_has_its_degree_and_no_more() {
        for n in 1..=4 {
            let name = format!("gauss({n})");
            let rules = [name.as_str(); 3];
            assert_eq!(proven(Cell::Hexahedron, &rules, 2 * n - 1), Ok(()), "{name}");
            assert!(proven(Cell::Hexahedron, &rules, 2 * n).is_err(), "{name}");
        }
        for (name, degree) in [("triangle(1)", 1), ("triangle(3)", 2), ("triangle(7)", 5)] {
            assert_eq!(proven(Cell::Wedge, &[name, "gauss(4)"], degree), Ok(()), "{name}");
            assert!(proven(Cell::Wedge, &[name, "gauss(4)"], degree + 1).is_err(), "{name}");
        }
        for (name, degree) in [("tetrahedron(1)", 1), ("tetrahedron(4)", 2)] {
            assert_eq!(proven(Cell::Tetrahedron, &[name], degree), Ok(()), "{name}");
            assert!(proven(Cell::Tetrahedron, &[name], degree + 1).is_err(), "{name}");
        }
    }

    #[test]
    fn a_failure_names_the_monomial_and_both_numbers() {
        let failure = proven(Cell::Wedge, &["triangle(3)", "gauss(2)"], 3).unwrap_err();
        assert_eq!(failure, "xi^3: 11/108 instead of 1/10");
    }
}
