//! What an element says, and what was proved of it.

use num_traits::{ToPrimitive, Zero};

use super::{ElementSpec, Function, ModeJacobian};
use crate::element::Quadrature;
use crate::expression::{Graph, Id, Node, Rational, display_rounded, normal};
use crate::kinds::page::{Page, count};

impl ElementSpec {
    /// Everything about an element but its code.
    pub(in crate::kinds) fn explain(&self, page: &mut Page) {
        functions(page, self);
        self.report(page);
    }

    /// What was proved when the element was read.
    pub(in crate::kinds) fn report(&self, page: &mut Page) {
        page.heading("Shapes");
        let nodes = self.nodes.len();
        page.item(&format!(
            "{} on the {} ({}); 3 displacements each: {} degrees of freedom",
            count(nodes, "node"),
            self.cell.name(),
            self.cell.domain(),
            3 * nodes
        ));
        let degree = |of: &dyn Fn(&Function) -> Vec<Id>| {
            let mut graph = self.graph.clone();
            let all = self.shape.iter().flat_map(of);
            let all: Option<Vec<u32>> =
                all.map(|id| total_degree(&mut graph, id, &self.coordinates)).collect();
            all.map_or("rational functions".to_string(), |degrees| {
                format!("polynomials of degree {}", degrees.into_iter().max().unwrap_or(0))
            })
        };
        page.item(&format!("shape functions: {}", degree(&|f| vec![f.value])));
        page.item(&format!("their gradients: {}", degree(&|f| f.gradient.to_vec())));
        rule(page, "quadrature", &self.quadrature);
        for (form, quadrature) in &self.quadrature_of {
            rule(page, &format!("quadrature of {form}"), quadrature);
        }
        page.heading("Proved with exact numbers");
        page.item(&format!("N_a(x_b) = 1 for a = b and 0 else, for all {} pairs", nodes * nodes));
        page.item(
            "sum of N_a = 1 and sum of N_a x_a = x: a rigid motion and a constant strain are exact",
        );
        page.item(
            "every node lies in the cell, no two in the same place; all weights are positive",
        );
        for quadrature in std::iter::once(&self.quadrature).chain(self.quadrature_of.values()) {
            page.item(&format!(
                "{} integrates every monomial up to degree {} exactly",
                quadrature.title, quadrature.degree
            ));
        }
        if self.enhanced.is_some() {
            page.item(
            "enhanced modes do no work against a constant stress on any cell: the patch test holds",
        );
        }
    }
}

fn functions(page: &mut Page, element: &ElementSpec) {
    page.heading("Shape functions, as given");
    // One formula serves all nodes, or every node has its own.
    let one = element.shape.iter().all(|f| f.text.span() == element.shape[0].text.span());
    let given = if one { &element.shape[..1] } else { &element.shape[..] };
    for (a, function) in given.iter().enumerate() {
        let name = if one { "N_a".to_string() } else { format!("N{}", a + 1) };
        page.item(&format!("{name} = {}", function.text.text()));
    }
    page.heading("As derived, node by node");
    let rows = element.nodes.iter().zip(&element.shape).enumerate().map(|(a, (node, function))| {
        let at = node.at.each_ref().map(ToString::to_string).join(", ");
        let value = display_rounded(&element.graph, function.value);
        vec![format!("N{}", a + 1), format!("at ({at})"), format!("= {value}")]
    });
    page.columns(&rows.collect::<Vec<_>>());
    if let Some(enhanced) = &element.enhanced {
        page.heading("Enhanced modes, condensed out of the cell's matrix");
        for (m, mode) in enhanced.modes.iter().enumerate() {
            page.item(&format!("M{} = {}", m + 1, mode.text.text()));
        }
        let jacobian = match enhanced.jacobian {
            ModeJacobian::Centre => "the centre",
            ModeJacobian::Point => "the point",
        };
        let scale = display_rounded(&element.graph, enhanced.scale);
        let forms: Vec<&str> = enhanced.forms.iter().map(|form| form.text()).collect();
        page.item(&format!(
            "their gradients with the Jacobian of {jacobian}, times {scale}, in {}",
            forms.join(", ")
        ));
    }
}
fn rule(page: &mut Page, name: &str, quadrature: &Quadrature) {
    let Quadrature { title, points, degree, reduced, affine, .. } = quadrature;
    let points = count(points.len(), "point");
    let reduced =
        if *reduced { ", reduced: fewer points than the products of a form need" } else { "" };
    let affine = if *affine { ", patch test on affine images of the cell only" } else { "" };
    page.item(&format!("{name}: {title}, {points}, exact to degree {degree}{reduced}{affine}"));
}

/// Highest sum of exponents of the coordinates; `None` for what is no polynomial.
fn total_degree(graph: &mut Graph, id: Id, coordinates: &[Id; 3]) -> Option<u32> {
    let expanded = normal::expand(graph, id);
    let mut most = 0;
    for (term, _) in graph.terms(expanded) {
        let factors: Vec<(Id, Rational)> = match graph.node(term) {
            Node::Product(factors) => factors.clone(),
            _ => vec![(term, Rational::from(1))],
        };
        let mut degree = Rational::zero();
        for (base, exponent) in factors {
            if coordinates.contains(&base) {
                degree += exponent;
            } else if coordinates.iter().any(|x| graph.depends(base, *x)) {
                return None;
            }
        }
        most = most.max(degree.is_integer().then(|| degree.to_u32())??);
    }
    Some(most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Source;

    #[test]
    fn degrees_are_those_of_the_polynomials() {
        let text = include_str!("../../../../specs/elements/hex8.toml");
        let element = ElementSpec::read(&Source::new("hex8.toml", text)).unwrap();
        let mut graph = element.graph.clone();
        let xi = element.coordinates;
        let shape = &element.shape[0];
        assert_eq!(total_degree(&mut graph, shape.value, &xi), Some(3));
        assert_eq!(total_degree(&mut graph, shape.gradient[1], &xi), Some(2));
        let rational = graph.div(xi[0], xi[1]);
        let one = graph.integer(1);
        let sum = graph.add(one, xi[2]);
        let inverse = graph.div(one, sum);
        assert_eq!(total_degree(&mut graph, rational, &xi), Some(0));
        assert_eq!(total_degree(&mut graph, inverse, &xi), None);
        assert_eq!(total_degree(&mut graph, one, &xi), Some(0));
    }
}
