//! Gradients of shape functions three ways: the tables that kernels are made with, dual numbers over the
//! formulas of the spec, and differences of the formulas with their order.

use std::collections::BTreeMap;

use whirl_codegen::diagnostic::Located;
use whirl_codegen::formula::{Value, evaluate, parse};
use whirl_codegen::kinds::element::{ElementSpec, Function};
use whirl_codegen::operation::{Dual, Number};
use whirl_specs::ELEMENTS;

use super::spec;

/// A function of the spec at a point, over any numbers.
fn value<N: Number>(
    text: &Located,
    node: Option<[f64; 3]>,
    at: [N; 3],
    constant: fn(f64) -> N,
) -> N {
    let mut names: BTreeMap<String, Value<N>> = BTreeMap::new();
    for (name, x) in ["xi", "eta", "zeta"].iter().zip(at) {
        names.insert((*name).to_owned(), Value::Scalar(x));
    }
    for (name, x) in ["xi_a", "eta_a", "zeta_a"].iter().zip(node.into_iter().flatten()) {
        names.insert((*name).to_owned(), Value::Scalar(constant(x)));
    }
    let formula = parse(text).expect("a formula");
    evaluate(&formula, &names).expect("a value").scalar().expect("a number")
}

/// Calls `check` with every function, its node if it has one, a point of a rule, and what the table has there.
fn at_all_points(
    element: &ElementSpec,
    check: impl Fn(&Function, Option<[f64; 3]>, [f64; 3], Option<f64>, [f64; 3]),
) {
    let nodes: Vec<[f64; 3]> =
        (element.nodes.iter()).map(|node| node.at.each_ref().map(Number::exact)).collect();
    for form in ["stiffness", "mass"] {
        let (rule, table) = (element.rule(form), element.table(form));
        let modes = element.enhanced_in(form).map_or(&[][..], |enhanced| &enhanced.modes);
        for (q, point) in rule.points.iter().enumerate() {
            let at = point.at.each_ref().map(|x| rule.field.to_f64(x));
            for (a, function) in element.shape.iter().enumerate() {
                let found = (Some(table.values[q][a]), table.slopes[q][a]);
                check(function, Some(nodes[a]), at, found.0, found.1);
            }
            for (m, mode) in modes.iter().enumerate() {
                check(mode, None, at, None, table.mode_slopes[q][m]);
            }
        }
    }
}

#[test]
fn tables_agree_with_dual_numbers() {
    for element in ELEMENTS {
        at_all_points(spec(element), |function, node, at, found, slopes| {
            for axis in 0..3 {
                let mut seeded = at.map(Dual::constant);
                seeded[axis] = Dual::variable(at[axis]);
                let dual = value(&function.text, node, seeded, Dual::constant);
                // A few dozen operations on numbers of the order of one.
                let near = |a: f64, b: f64| (a - b).abs() < 64.0 * f64::EPSILON;
                let (name, text) = (element.origin.name, function.text.text());
                assert!(near(dual.slope, slopes[axis]), "{name} {text}: {dual:?} {slopes:?}");
                assert!(
                    found.is_none_or(|found| near(found, dual.value)),
                    "{name} {text}: {dual:?}"
                );
            }
        });
    }
}

#[test]
fn tables_agree_with_differences_to_the_second_order() {
    for element in ELEMENTS {
        at_all_points(spec(element), |function, node, at, _, slopes| {
            for axis in 0..3 {
                let off = |h: f64| {
                    let side = |h: f64| {
                        let mut at = at;
                        at[axis] += h;
                        value(&function.text, node, at, |x| x)
                    };
                    ((side(h) - side(-h)) / (2.0 * h) - slopes[axis]).abs()
                };
                let (coarse, fine) = (off(0.02), off(0.002));
                // A hundredth, or rounding of values of the order of one over the step.
                let rounding = 64.0 * f64::EPSILON / 0.002;
                let (name, text) = (element.origin.name, function.text.text());
                assert!(
                    fine < 0.0102 * coarse + rounding,
                    "{name} {text}: {coarse:.1e} {fine:.1e}"
                );
                assert!(coarse < 0.01, "{name} {text}: {coarse:.1e}");
            }
        });
    }
}
