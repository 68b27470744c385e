//! Proofs on the graph, with exact numbers: what an element's file says is an element.

use std::array::from_fn;
use std::collections::BTreeMap;

use num_traits::{One, Signed, Zero};

use super::quadrature::Quadrature;
use super::table::Table;
use super::{direct, exact};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::expression::{Graph, Id, Rational, normal};
use crate::spec::element::{ElementSpec, Enhanced, ModeJacobian, ReferenceNode};
use crate::units::nearest;

/// Names of the reference coordinates in messages.
const AXES: [&str; 3] = ["xi", "eta", "zeta"];

/// Proves ΣN = 1, N_a(x_b) = δ_ab, ΣN_a x_a = x, the degree of every rule, and that enhanced modes do no
/// work against a constant stress.
///
/// # Errors
/// Every proof that fails, with the node, point or mode, the numbers, and the place in the file.
pub fn prove(element: &mut ElementSpec) -> Result<(), Diagnostics> {
    let mut errors = Diagnostics::new();
    nodes_belong_to_the_cell(element, &mut errors);
    if errors.is_empty() {
        shape_functions_interpolate(element, &mut errors);
    }
    if errors.is_empty() {
        shape_functions_are_complete(element, &mut errors);
    }
    rules_have_their_degree(element, &mut errors);
    if errors.is_empty() {
        tables_exist(element, &mut errors);
    }
    if let (Some(enhanced), true) = (element.enhanced.clone(), errors.is_empty()) {
        modes_pass_the_patch_test(element, &enhanced, &mut errors);
    }
    errors.into_result(())
}

fn tuple(at: &[Rational; 3]) -> String {
    format!("({}, {}, {})", at[0], at[1], at[2])
}

fn nodes_belong_to_the_cell(element: &ElementSpec, errors: &mut Diagnostics) {
    for (place, node) in element.nodes.iter().enumerate() {
        let twin = element.nodes[..place].iter().position(|other| other.at == node.at);
        let message = match twin {
            Some(twin) => format!("node {} is where node {} is", place + 1, twin + 1),
            None if element.cell.contains(&node.at) => continue,
            None => {
                let (at, cell) = (tuple(&node.at), element.cell);
                let (name, domain) = (cell.name(), cell.domain());
                format!("node {} at {at} lies outside the {name} ({domain})", place + 1)
            }
        };
        let place = node.place.clone();
        errors.push(Diagnostic::new(&element.file, Code::SHAPE_FUNCTION, place, message));
    }
}

fn shape_functions_interpolate(element: &mut ElementSpec, errors: &mut Diagnostics) {
    let inside = element.cell.centre();
    let graph = &mut element.graph;
    for (a, function) in element.shape.iter().enumerate() {
        for (b, node) in element.nodes.iter().enumerate() {
            let at = node.at.each_ref().map(|x| graph.number(x.clone()));
            let value = exact::value_at(graph, function.value, &element.coordinates, &at, &inside);
            let wanted = graph.integer(i64::from(a == b));
            let found = match value {
                Some(value) if normal::equal(graph, value, wanted) => continue,
                Some(value) => exact::display(graph, value),
                None => "without a value".to_owned(),
            };
            let message = format!(
                "the shape function of node {} is {found} at node {} {}, not {}",
                a + 1,
                b + 1,
                tuple(&node.at),
                i32::from(a == b)
            );
            errors.push(function.text.error_here(Code::SHAPE_FUNCTION, message));
            // One failure a shape function: the rest follows from the same slip.
            break;
        }
    }
}

fn shape_functions_are_complete(element: &mut ElementSpec, errors: &mut Diagnostics) {
    let graph = &mut element.graph;
    let one = graph.integer(1);
    let ones = vec![Rational::one(); element.nodes.len()];
    let mut claims = vec![("1", "the shape functions sum to", one, ones)];
    for (axis, name) in AXES.iter().enumerate() {
        let at = element.nodes.iter().map(|node| node.at[axis].clone()).collect();
        let says = "the shape functions times the nodes' coordinates sum to";
        claims.push((name, says, element.coordinates[axis], at));
    }
    for (wanted, says, exact, factors) in claims {
        let terms: Vec<_> = element.shape.iter().map(|f| f.value).zip(factors).collect();
        let sum = graph.sum(&terms);
        let difference = graph.sub(sum, exact);
        if exact::is_zero(graph, difference) {
            continue;
        }
        let point = element.cell.centre();
        let at = point.each_ref().map(|x| graph.number(x.clone()));
        let expanded = normal::expand(graph, sum);
        let value = exact::value_at(graph, sum, &element.coordinates, &at, &point);
        let value = value.map_or("no value".to_owned(), |value| exact::display(graph, value));
        let found = crate::expression::display(graph, expanded);
        let found: String = found.chars().take(200).collect();
        let message =
            format!("{says} {found}, not to {wanted} ({value} at the centre {})", tuple(&point));
        let text = &element.shape[0].text;
        errors.push(text.error_here(Code::SHAPE_FUNCTION, message));
    }
}

/// A negative weight can turn a stiffness indefinite.
fn weights_are_positive(element: &ElementSpec, rule: &Quadrature, errors: &mut Diagnostics) {
    for (q, point) in rule.points.iter().enumerate() {
        let weight = exact::approximate(&element.graph, point.weight);
        if weight.is_none_or(|weight| weight.is_negative() || weight.is_zero()) {
            let weight = exact::display(&element.graph, point.weight);
            let message = format!("the weight of point {} is {weight}, not positive", q + 1);
            let place = rule.place.clone();
            errors.push(Diagnostic::new(&element.file, Code::QUADRATURE, place, message));
        }
    }
}

/// Every function has an exact value wherever it is tabulated.
fn tables_exist(element: &ElementSpec, errors: &mut Diagnostics) {
    for form in std::iter::once("").chain(element.quadrature_of.keys().map(String::as_str)) {
        if let Err(error) = Table::new(element, form) {
            errors.push(*error);
            return;
        }
    }
}

fn rules_have_their_degree(element: &mut ElementSpec, errors: &mut Diagnostics) {
    let rules: Vec<Quadrature> = std::iter::once(&element.quadrature)
        .chain(element.quadrature_of.values())
        .cloned()
        .collect();
    for rule in rules {
        weights_are_positive(element, &rule, errors);
        let Err(failure) = rule.prove(&mut element.graph, element.cell) else { continue };
        let message = format!(
            "the rule gives {} for the integral of {} over the {}, not {}",
            failure.found,
            failure.monomial(),
            element.cell.name(),
            failure.exact
        );
        let degree = failure.powers.iter().sum::<u32>();
        let help = match degree {
            0 => "the weights must sum to the volume of the reference cell".to_owned(),
            _ => format!("take more points, or declare `degree = {}`", degree - 1),
        };
        let error = Diagnostic::new(&element.file, Code::QUADRATURE, rule.place.clone(), message);
        errors.push(error.help(help));
    }
}

/// Σ over the points of w det J ∇M = 0 for any nodes: the determinants and the entries of the inverse
/// Jacobians count as unknowns, those of different points as different ones.
fn modes_pass_the_patch_test(
    element: &mut ElementSpec,
    enhanced: &Enhanced,
    errors: &mut Diagnostics,
) {
    for form in &enhanced.forms {
        let rule = element.rule(form.text()).clone();
        for (m, mode) in enhanced.modes.iter().enumerate() {
            let graph = &mut element.graph;
            let mut sums = Vec::new();
            for axis in 0..3 {
                let sum =
                    integral(graph, &rule, enhanced, mode.gradient, element.coordinates, axis);
                sums.push(normal::expand(graph, sum));
            }
            if sums.iter().all(|sum| graph.is_zero(*sum)) {
                continue;
            }
            let message = format!(
                "the gradient of mode {} does not integrate to zero{}: a patch of distorted cells \
                 fails under constant strain",
                m + 1,
                numbers(element, form.text(), m)
            );
            let error = Diagnostic::new(
                &element.file,
                Code::PATCH_TEST,
                enhanced.scale_place.clone(),
                message,
            );
            let help = "write `jacobian = \"centre\"` and `scale = 'det0/det'` (Taylor, Beresford & \
                        Wilson), and modes whose reference gradients integrate to zero";
            errors.push(error.help(help));
        }
    }
}

/// Σ_q w_q det_q scale(det_q, det0) Σ_k ∂M/∂ξ_k(q) J⁻¹[k, axis].
fn integral(
    graph: &mut Graph,
    rule: &Quadrature,
    enhanced: &Enhanced,
    gradient: [Id; 3],
    coordinates: [Id; 3],
    axis: usize,
) -> Id {
    let mut terms = vec![(graph.integer(0), Rational::one())];
    for (q, point) in rule.points.iter().enumerate() {
        let det = graph.scalar(&format!("det_{q}"));
        let scale = graph.substitute(enhanced.scale, &BTreeMap::from([(enhanced.det, det)]));
        let at: BTreeMap<Id, Id> = coordinates.into_iter().zip(point.at).collect();
        for (k, slope) in gradient.into_iter().enumerate() {
            let place = match enhanced.jacobian {
                ModeJacobian::Centre => format!("inverse_{k}_{axis}"),
                ModeJacobian::Point => format!("inverse_{k}_{axis}_{q}"),
            };
            let inverse = graph.scalar(&place);
            let slope = graph.substitute(slope, &at);
            let factors = [point.weight, det, scale, slope, inverse];
            let term = graph.product(&factors.map(|factor| (factor, Rational::one())));
            terms.push((term, Rational::one()));
        }
    }
    graph.sum(&terms)
}

/// The integral over the reference cell with its nodes displaced by up to a quarter, in words.
fn numbers(element: &ElementSpec, form: &str, mode: usize) -> String {
    let displaced = |(a, node): (usize, &ReferenceNode)| {
        from_fn(|axis| {
            let (sign, step) = (if (a + axis) % 2 == 0 { 1.0 } else { -1.0 }, (3 * a + axis) % 5);
            nearest(&node.at[axis]) + sign * step as f64 / 16.0
        })
    };
    let nodes: Vec<[f64; 3]> = element.nodes.iter().enumerate().map(displaced).collect();
    match direct::mode_integrals(element, form, &nodes) {
        Ok(integrals) => {
            let [x, y, z] = integrals[mode];
            format!(" (over a distorted reference cell it gives {x:.3}, {y:.3}, {z:.3})")
        }
        Err(_) => String::new(),
    }
}
