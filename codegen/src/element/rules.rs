//! Named quadrature rules, with exact points and weights.

use std::collections::BTreeMap;

use super::algebraic::{Algebraic, Field};
use super::quadrature::Factor;
use crate::diagnostic::Located;
use crate::expression::Graph;
use crate::formula::{lower, parse};

/// A named rule: family, number of points, then for each point its coordinates and its weight.
type Named = (&'static str, usize, &'static [&'static [&'static str]]);

/// Rules on the line −1 … 1 (Gauss–Legendre), on the unit triangle (Strang & Fix; Cowper; Radon), on the unit
/// tetrahedron (Hammer & Stroud; Stroud T3:5-1) and on the pyramid (Gauss–Legendre across, Gauss–Jacobi along
/// the rays from the apex).
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
        6,
        &[
            &[
                "(8 - sqrt(10) + sqrt(38 - 44*sqrt(10)/5))/18",
                "(8 - sqrt(10) + sqrt(38 - 44*sqrt(10)/5))/18",
                "1/12 + (9*sqrt(10)/2 - 1)*sqrt(38 - 44*sqrt(10)/5)/1488",
            ],
            &[
                "(1 + sqrt(10) - sqrt(38 - 44*sqrt(10)/5))/9",
                "(8 - sqrt(10) + sqrt(38 - 44*sqrt(10)/5))/18",
                "1/12 + (9*sqrt(10)/2 - 1)*sqrt(38 - 44*sqrt(10)/5)/1488",
            ],
            &[
                "(8 - sqrt(10) + sqrt(38 - 44*sqrt(10)/5))/18",
                "(1 + sqrt(10) - sqrt(38 - 44*sqrt(10)/5))/9",
                "1/12 + (9*sqrt(10)/2 - 1)*sqrt(38 - 44*sqrt(10)/5)/1488",
            ],
            &[
                "(8 - sqrt(10) - sqrt(38 - 44*sqrt(10)/5))/18",
                "(8 - sqrt(10) - sqrt(38 - 44*sqrt(10)/5))/18",
                "1/12 - (9*sqrt(10)/2 - 1)*sqrt(38 - 44*sqrt(10)/5)/1488",
            ],
            &[
                "(1 + sqrt(10) + sqrt(38 - 44*sqrt(10)/5))/9",
                "(8 - sqrt(10) - sqrt(38 - 44*sqrt(10)/5))/18",
                "1/12 - (9*sqrt(10)/2 - 1)*sqrt(38 - 44*sqrt(10)/5)/1488",
            ],
            &[
                "(8 - sqrt(10) - sqrt(38 - 44*sqrt(10)/5))/18",
                "(1 + sqrt(10) + sqrt(38 - 44*sqrt(10)/5))/9",
                "1/12 - (9*sqrt(10)/2 - 1)*sqrt(38 - 44*sqrt(10)/5)/1488",
            ],
        ],
    ),
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
    (
        "tetrahedron",
        15,
        &[
            &["1/4", "1/4", "1/4", "8/405"],
            &[
                "(7 - sqrt(15))/34",
                "(7 - sqrt(15))/34",
                "(7 - sqrt(15))/34",
                "(2665 + 14*sqrt(15))/226800",
            ],
            &[
                "(13 + 3*sqrt(15))/34",
                "(7 - sqrt(15))/34",
                "(7 - sqrt(15))/34",
                "(2665 + 14*sqrt(15))/226800",
            ],
            &[
                "(7 - sqrt(15))/34",
                "(13 + 3*sqrt(15))/34",
                "(7 - sqrt(15))/34",
                "(2665 + 14*sqrt(15))/226800",
            ],
            &[
                "(7 - sqrt(15))/34",
                "(7 - sqrt(15))/34",
                "(13 + 3*sqrt(15))/34",
                "(2665 + 14*sqrt(15))/226800",
            ],
            &[
                "(7 + sqrt(15))/34",
                "(7 + sqrt(15))/34",
                "(7 + sqrt(15))/34",
                "(2665 - 14*sqrt(15))/226800",
            ],
            &[
                "(13 - 3*sqrt(15))/34",
                "(7 + sqrt(15))/34",
                "(7 + sqrt(15))/34",
                "(2665 - 14*sqrt(15))/226800",
            ],
            &[
                "(7 + sqrt(15))/34",
                "(13 - 3*sqrt(15))/34",
                "(7 + sqrt(15))/34",
                "(2665 - 14*sqrt(15))/226800",
            ],
            &[
                "(7 + sqrt(15))/34",
                "(7 + sqrt(15))/34",
                "(13 - 3*sqrt(15))/34",
                "(2665 - 14*sqrt(15))/226800",
            ],
            &["(10 - 2*sqrt(15))/40", "(10 - 2*sqrt(15))/40", "(10 + 2*sqrt(15))/40", "5/567"],
            &["(10 - 2*sqrt(15))/40", "(10 + 2*sqrt(15))/40", "(10 - 2*sqrt(15))/40", "5/567"],
            &["(10 - 2*sqrt(15))/40", "(10 + 2*sqrt(15))/40", "(10 + 2*sqrt(15))/40", "5/567"],
            &["(10 + 2*sqrt(15))/40", "(10 - 2*sqrt(15))/40", "(10 - 2*sqrt(15))/40", "5/567"],
            &["(10 + 2*sqrt(15))/40", "(10 - 2*sqrt(15))/40", "(10 + 2*sqrt(15))/40", "5/567"],
            &["(10 + 2*sqrt(15))/40", "(10 + 2*sqrt(15))/40", "(10 - 2*sqrt(15))/40", "5/567"],
        ],
    ),
    ("pyramid", 1, &[&["0", "0", "1/4", "4/3"]]),
    (
        "pyramid",
        4,
        &[
            &["-sqrt(3)/4", "-sqrt(3)/4", "1/4", "1/3"],
            &["sqrt(3)/4", "-sqrt(3)/4", "1/4", "1/3"],
            &["-sqrt(3)/4", "sqrt(3)/4", "1/4", "1/3"],
            &["sqrt(3)/4", "sqrt(3)/4", "1/4", "1/3"],
        ],
    ),
    (
        "pyramid",
        8,
        &[
            &[
                "-(10 + sqrt(10))/(15*sqrt(3))",
                "-(10 + sqrt(10))/(15*sqrt(3))",
                "(5 - sqrt(10))/15",
                "1/6 + sqrt(10)/48",
            ],
            &[
                "(10 + sqrt(10))/(15*sqrt(3))",
                "-(10 + sqrt(10))/(15*sqrt(3))",
                "(5 - sqrt(10))/15",
                "1/6 + sqrt(10)/48",
            ],
            &[
                "-(10 + sqrt(10))/(15*sqrt(3))",
                "(10 + sqrt(10))/(15*sqrt(3))",
                "(5 - sqrt(10))/15",
                "1/6 + sqrt(10)/48",
            ],
            &[
                "(10 + sqrt(10))/(15*sqrt(3))",
                "(10 + sqrt(10))/(15*sqrt(3))",
                "(5 - sqrt(10))/15",
                "1/6 + sqrt(10)/48",
            ],
            &[
                "-(10 - sqrt(10))/(15*sqrt(3))",
                "-(10 - sqrt(10))/(15*sqrt(3))",
                "(5 + sqrt(10))/15",
                "1/6 - sqrt(10)/48",
            ],
            &[
                "(10 - sqrt(10))/(15*sqrt(3))",
                "-(10 - sqrt(10))/(15*sqrt(3))",
                "(5 + sqrt(10))/15",
                "1/6 - sqrt(10)/48",
            ],
            &[
                "-(10 - sqrt(10))/(15*sqrt(3))",
                "(10 - sqrt(10))/(15*sqrt(3))",
                "(5 + sqrt(10))/15",
                "1/6 - sqrt(10)/48",
            ],
            &[
                "(10 - sqrt(10))/(15*sqrt(3))",
                "(10 - sqrt(10))/(15*sqrt(3))",
                "(5 + sqrt(10))/15",
                "1/6 - sqrt(10)/48",
            ],
        ],
    ),
];

/// Every named rule, such as `gauss(2)`.
pub(crate) fn names() -> Vec<String> {
    RULES.iter().map(|(family, n, _)| format!("{family}({n})")).collect()
}

/// The family of a named rule, such as `gauss` of `gauss(2)`; `None` if there is no such rule.
pub(crate) fn family(name: &str) -> Option<&'static str> {
    find(name).map(|(family, ..)| *family)
}

fn find(name: &str) -> Option<&'static Named> {
    RULES.iter().find(|(family, n, _)| *name == format!("{family}({n})"))
}

/// The named rules as factors of a rule whose numbers are in `field`. `None` if a name is unknown.
pub(crate) fn factors(field: &mut Field, names: &[&str]) -> Option<Vec<Factor>> {
    let (mut factors, mut graph, mut axis) = (Vec::new(), Graph::new(), 0);
    for name in names {
        let (.., rule) = find(name)?;
        let mut points = Vec::with_capacity(rule.len());
        let mut known: BTreeMap<&str, Algebraic> = BTreeMap::new();
        for numbers in *rule {
            let number = |text: &&'static str| {
                known.entry(text).or_insert_with(|| constant(field, &mut graph, text)).clone()
            };
            let mut numbers: Vec<Algebraic> = numbers.iter().map(number).collect();
            let weight = numbers.pop()?;
            points.push((numbers, weight));
        }
        let axes = axis..axis + points[0].0.len();
        axis = axes.end;
        factors.push(Factor { axes, points });
    }
    Some(factors)
}

fn constant(field: &mut Field, graph: &mut Graph, text: &str) -> Algebraic {
    let formula = parse(&Located::alone("named rule", text));
    let id = formula.and_then(|formula| lower(&formula, graph, &BTreeMap::new()));
    field.read(graph, id.expect("a constant")).expect("made by square roots")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::{Cell, Quadrature};

    fn proven(cell: Cell, rules: &[&str], degree: u32) -> Result<(), String> {
        let mut field = Field::default();
        let factors = factors(&mut field, rules).expect("known rules");
        let rule = Quadrature::new(rules.join(" × "), field, factors, degree, 0..0);
        rule.expect("three coordinates").prove(cell).map_err(|failure| {
            format!(
                "{}: {} instead of {}",
                cell.power(failure.powers),
                failure.found,
                failure.exact
            )
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
        for (name, degree) in
            [("triangle(1)", 1), ("triangle(3)", 2), ("triangle(6)", 4), ("triangle(7)", 5)]
        {
            assert_eq!(proven(Cell::Wedge, &[name, "gauss(4)"], degree), Ok(()), "{name}");
            assert!(proven(Cell::Wedge, &[name, "gauss(4)"], degree + 1).is_err(), "{name}");
        }
        for (name, degree) in [("tetrahedron(1)", 1), ("tetrahedron(4)", 2), ("tetrahedron(15)", 5)]
        {
            assert_eq!(proven(Cell::Tetrahedron, &[name], degree), Ok(()), "{name}");
            assert!(proven(Cell::Tetrahedron, &[name], degree + 1).is_err(), "{name}");
        }
        for (name, degree) in [("pyramid(1)", 1), ("pyramid(4)", 1), ("pyramid(8)", 3)] {
            assert_eq!(proven(Cell::Pyramid, &[name], degree), Ok(()), "{name}");
            assert!(proven(Cell::Pyramid, &[name], degree + 1).is_err(), "{name}");
        }
    }

    #[test]
    fn a_failure_names_the_monomial_and_both_numbers() {
        let failure = proven(Cell::Wedge, &["triangle(3)", "gauss(2)"], 3).unwrap_err();
        assert_eq!(failure, "xi^3: 11/108 instead of 1/10");
    }
}
