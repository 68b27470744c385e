//! Proofs with exact numbers: what an element's file says is an element.

use std::array::from_fn;

use num_traits::{One, Signed, Zero};

use super::direct;
use super::{ElementSpec, Enhanced, ModeJacobian, ReferenceNode};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::element::Polynomial;
use crate::element::quadrature::{Integrals, Quadrature};
use crate::expression::{Rational, normal};
use crate::rational::nearest;

/// Proves N_a(x_b) = δ_ab, Σ N_a p(x_a) = p for every monomial p up to the degree of completeness, the degree
/// of every rule, and that enhanced modes do no work against a constant stress.
///
/// # Errors
/// Every proof that fails, with the node, point or mode, the numbers, and the place in the file.
pub(super) fn prove(element: &ElementSpec) -> Result<(), Diagnostics> {
    let mut errors = Diagnostics::new();
    nodes_belong_to_the_cell(element, &mut errors);
    if errors.is_empty() {
        shape_functions_interpolate(element, &mut errors);
    }
    if errors.is_empty() {
        shape_functions_are_complete(element, &mut errors);
    }
    rules_have_their_degree(element, &mut errors);
    if let (Some(enhanced), true) = (&element.enhanced, errors.is_empty()) {
        modes_pass_the_patch_test(element, enhanced, &mut errors);
    }
    errors.into_result(())
}

fn tuple(at: &[Rational; 3]) -> String {
    format!("({}, {}, {})", at[0], at[1], at[2])
}

fn nodes_belong_to_the_cell(element: &ElementSpec, errors: &mut Diagnostics) {
    for (place, node) in element.nodes.iter().enumerate() {
        let other = element.nodes[..place].iter().position(|before| before.at == node.at);
        let message = match other {
            Some(other) => format!("node {} is where node {} is", place + 1, other + 1),
            None if element.cell.contains(&node.at) => continue,
            None => {
                let (at, cell) = (tuple(&node.at), element.cell);
                let (name, domain) = (cell.name(), cell.domain());
                format!("node {} at {at} lies outside the {name} ({domain})", place + 1)
            }
        };
        let place = node.place.clone();
        let error = Diagnostic::new(&element.file, Code::SHAPE_FUNCTION, place, message);
        errors.push(error.help("give each node a place of its own in the cell"));
    }
}

fn shape_functions_interpolate(element: &ElementSpec, errors: &mut Diagnostics) {
    for (a, function) in element.shape.iter().enumerate() {
        for (b, node) in element.nodes.iter().enumerate() {
            let found = match function.polynomial.at(element.cell, &node.at) {
                Some(value) if value == Rational::from(u8::from(a == b)) => continue,
                Some(value) => value.to_string(),
                None => "without a value".to_owned(),
            };
            let message = format!(
                "the shape function of node {} is {found} at node {} {}, not {}",
                a + 1,
                b + 1,
                tuple(&node.at),
                i32::from(a == b)
            );
            let error = function.text.error_here(Code::SHAPE_FUNCTION, message);
            errors.push(error.help("a shape function is 1 at its own node and 0 at all others"));
            // One failure a shape function: the rest follows from the same slip.
            break;
        }
    }
}

fn shape_functions_are_complete(element: &ElementSpec, errors: &mut Diagnostics) {
    for degree in 0..=element.complete as i32 {
        for i in (0..=degree).rev() {
            for j in (0..=degree - i).rev() {
                if let Err(error) = reproduces(element, [i, j, degree - i - j]) {
                    errors.push(*error);
                }
            }
        }
        // What lacks the linear functions lacks most of the quadratic ones.
        if degree > 0 && !errors.is_empty() {
            return;
        }
    }
}

/// Σ N_a p(x_a) = p for the monomial p of the coordinates with these powers.
fn reproduces(element: &ElementSpec, powers: [i32; 3]) -> Result<(), Box<Diagnostic>> {
    let (cell, one) = (element.cell, Rational::one());
    let mut sum = Polynomial::default();
    for (function, node) in element.shape.iter().zip(&element.nodes) {
        let factors = node.at.iter().zip(powers).map(|(x, power)| x.pow(power));
        sum.add(&function.polynomial, &factors.product::<Rational>());
    }
    let mut wanted = Some(Polynomial::monomial([0; 3], one.clone()));
    for (axis, power) in powers.into_iter().enumerate() {
        let coordinate = Polynomial::coordinate(cell, axis);
        wanted = (0..power).fold(wanted, |wanted, _| wanted?.multiply(&coordinate));
    }
    let wanted = wanted.expect("of low degree");
    let mut difference = sum.clone();
    difference.add(&wanted, &-&one);
    if difference.is_zero() {
        return Ok(());
    }
    let monomial = crate::element::Cell::Hexahedron.power(powers);
    let says = match powers {
        [0, 0, 0] => "the shape functions sum to".to_owned(),
        _ => format!("the shape functions times {monomial} at the nodes sum to"),
    };
    let point = cell.centre();
    let value = sum.at(cell, &point).map_or("no value".to_owned(), |value| value.to_string());
    let found: String = sum.display(cell).to_string().chars().take(200).collect();
    let message =
        format!("{says} {found}, not to {monomial} ({value} at the centre {})", tuple(&point));
    // The term in excess that stands in the fewest functions says best where the slip is.
    let holders = |powers: &[i32; 3]| -> Vec<usize> {
        let holds = |place: &usize| {
            element.shape[*place].polynomial.terms().any(|(other, _)| other == powers)
        };
        (0..element.shape.len()).filter(holds).collect()
    };
    let held = difference.terms().map(|(powers, _)| (holders(powers), powers));
    let fewest = held.filter(|(nodes, _)| !nodes.is_empty()).min_by_key(|(nodes, _)| nodes.len());
    let first = fewest.as_ref().map_or(0, |(nodes, _)| nodes[0]);
    let error = element.shape[first].text.error_here(Code::SHAPE_FUNCTION, message);
    let help = fewest.map(|(nodes, powers)| {
        let nodes: Vec<String> = nodes.iter().map(|node| (node + 1).to_string()).collect();
        let (term, plural) = (cell.power(*powers), if nodes.len() == 1 { "" } else { "s" });
        format!("look at the term in {term} at node{plural} {}", nodes.join(", "))
    });
    Err(Box::new(error.maybe_help(help)))
}

/// A negative weight can turn a stiffness indefinite.
fn weights_are_positive(element: &ElementSpec, rule: &Quadrature, errors: &mut Diagnostics) {
    for (q, point) in rule.points.iter().enumerate() {
        if !rule.field.fixed(&point.weight).is_positive() {
            let weight = rule.field.display(&point.weight);
            let message = format!("the weight of point {} is {weight}, not positive", q + 1);
            let place = rule.place.clone();
            let error = Diagnostic::new(&element.file, Code::QUADRATURE, place, message);
            errors.push(error.help("take a rule whose weights are all positive"));
        }
    }
}

fn rules_have_their_degree(element: &ElementSpec, errors: &mut Diagnostics) {
    for rule in std::iter::once(&element.quadrature).chain(element.quadrature_of.values()) {
        weights_are_positive(element, rule, errors);
        let Err(failure) = rule.prove(element.cell) else { continue };
        let message = format!(
            "the rule gives {} for the integral of {} over the {}, not {}",
            failure.found,
            element.cell.power(failure.powers),
            element.cell.name(),
            failure.exact
        );
        let degree = failure.powers.iter().sum::<i32>();
        let help = match degree {
            0 => "the weights must sum to the volume of the reference cell".to_owned(),
            _ => format!("take more points, or declare `degree = {}`", degree - 1),
        };
        let error = Diagnostic::new(&element.file, Code::QUADRATURE, rule.place.clone(), message);
        errors.push(error.help(help));
    }
}

/// Σ over the points of w det J · scale · ∇M = 0 for any nodes. The determinants and the entries of the
/// inverse Jacobians count as unknowns, those of different points as different ones: only where det J ·
/// scale and the Jacobian do not vary from point to point can the points cancel each other.
fn modes_pass_the_patch_test(element: &ElementSpec, enhanced: &Enhanced, errors: &mut Diagnostics) {
    let mut graph = element.graph.clone();
    let product = graph.mul(enhanced.scale, enhanced.det);
    let factor = normal::expand(&mut graph, product);
    let even = enhanced.jacobian == ModeJacobian::Centre && !graph.depends(factor, enhanced.det);
    for form in &enhanced.forms {
        let rule = element.rule(form.text());
        let table = element.table(form.text());
        let mut integrals = Integrals::new(rule, element.cell);
        for (m, mode) in enhanced.modes.iter().enumerate() {
            let vanishes = (0..3).all(|axis| match even {
                true => {
                    integrals.of_polynomial(&mode.slopes[axis]).is_some_and(|sum| sum.is_zero())
                }
                false => table.mode_slopes.iter().all(|slopes| slopes[m][axis].is_zero()),
            });
            if vanishes {
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

/// The integral over the reference cell with its nodes displaced by up to a quarter, in words.
fn numbers(element: &ElementSpec, form: &str, mode: usize) -> String {
    let displaced = |(a, node): (usize, &ReferenceNode)| {
        from_fn(|axis| {
            let (sign, step) = (if (a + axis) % 2 == 0 { 1.0 } else { -1.0 }, (3 * a + axis) % 5);
            nearest(&node.at[axis]) + sign * step as f64 / 16.0
        })
    };
    let nodes: Vec<[f64; 3]> = element.nodes.iter().enumerate().map(displaced).collect();
    let [x, y, z] = direct::mode_integrals(element, form, &nodes)[mode];
    format!(" (over a distorted reference cell it gives {x:.3}, {y:.3}, {z:.3})")
}
