//! What a set of forms says, and the structure found in each.

use std::collections::BTreeMap;

use num_traits::One;

use super::{Form, FormSpec, Place, Structure};
use crate::expression::{Graph, Id, Rational, display_rounded};
use crate::kinds::page::Page;

impl FormSpec {
    /// Everything about a set of forms.
    pub(in crate::kinds) fn explain(&self, page: &mut Page) {
        page.heading("Material");
        let rows = self.material.iter().map(|property| {
            vec![property.name.clone(), property.unit.to_string(), property.title.clone()]
        });
        page.columns(&rows.collect::<Vec<_>>());
        if !self.coefficients.is_empty() {
            page.heading("Coefficients");
            for coefficient in &self.coefficients {
                page.item(&format!("{} = {}", coefficient.name, coefficient.text.text()));
            }
        }
        page.heading("Forms as given, integrated over a cell; v: rows, u: columns");
        for form in &self.forms {
            page.item(&format!("{} = {}", form.name, form.text.text()));
        }
        self.report(page);
        for form in &self.forms {
            components(page, self, form);
        }
        for stress in &self.stresses {
            stress_components(page, self, stress);
        }
    }

    /// The structure found in every form.
    pub(in crate::kinds) fn report(&self, page: &mut Page) {
        page.heading("Structure found, for an element of n nodes");
        for form in &self.forms {
            let material: Vec<&str> =
                self.material_of(form).into_iter().map(|property| property.name.as_str()).collect();
            page.item(&format!("{} over {}", form.name, material.join(", ")));
            match &form.structure {
                Structure::Symmetric => {
                    page.item(
                        "  symmetric, 3n × 3n; the upper triangle is stored: 3n(3n+1)/2 values",
                    );
                }
                Structure::Full => page.item("  no structure, 3n × 3n: 9n² values"),
                Structure::Kronecker { pattern, .. } => {
                    let skew = (0..3).any(|i| (0..3).any(|j| pattern[i][j] != pattern[j][i]));
                    let word = if skew { "skew" } else { "symmetric" };
                    let rows = pattern.each_ref().map(|row| {
                        format!("[{}]", row.each_ref().map(ToString::to_string).join(", "))
                    });
                    page.item(&format!(
                        "  Kronecker, {word}: one symmetric n × n matrix s ⊗ [{}]; n(n+1)/2 values",
                        rows.join(", ")
                    ));
                }
            }
        }
    }
}

/// Letters of the components of u and v.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The entries of a pair of nodes a (rows) and b (columns), under the integral.
fn components(page: &mut Page, spec: &FormSpec, form: &Form) {
    page.heading(&format!("{} of nodes a and b, as derived, under the integral", form.name));
    let mut graph = spec.graph.clone();
    if let Structure::Kronecker { scalar, .. } = &form.structure {
        let terms: Vec<_> = scalar.iter().map(|(parts, id)| (*parts, *id)).collect();
        let sum = sum(&mut graph, &terms);
        page.item(&format!("s_ab = {sum}"));
        return;
    }
    for (i, row) in AXES.iter().enumerate() {
        for (j, column) in AXES.iter().enumerate() {
            let here = form.bilinear.iter().filter(|(place, _)| (place.i, place.j) == (i, j));
            let terms: Vec<_> =
                here.map(|(Place { test, trial, .. }, id)| ((*test, *trial), *id)).collect();
            page.item(&format!("k_{row}{column} = {}", sum(&mut graph, &terms)));
        }
    }
}

/// The components of a stress over the slopes of the displacement.
fn stress_components(page: &mut Page, spec: &FormSpec, form: &Form) {
    let Some(stress) = &form.stress else { return };
    page.heading(&format!(
        "{}, the stress of a displacement w in {}, as derived",
        form.name, stress.form
    ));
    let mut graph = spec.graph.clone();
    let slopes: BTreeMap<Id, Id> = (0..9)
        .map(|n| (n / 3, n % 3))
        .map(|(j, l)| {
            let name = format!("dw{}_d{}", AXES[j], AXES[l]);
            (stress.slopes[j][l], graph.scalar(&name))
        })
        .collect();
    for (i, k) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)] {
        let component = graph.substitute(stress.components[i][k], &slopes);
        let text = display_rounded(&graph, component);
        page.item(&format!("{}_{}{} = {text}", form.name, AXES[i], AXES[k]));
    }
}

/// Σ coefficient · (part of N_a) · (part of N_b), where a part is the value or a derivative.
fn sum(graph: &mut Graph, terms: &[((usize, usize), Id)]) -> String {
    let part = |graph: &mut Graph, node: &str, part: usize| match part {
        0 => graph.scalar(&format!("N{node}")),
        axis => graph.scalar(&format!("dN{node}_d{}", AXES[axis - 1])),
    };
    let mut parts = Vec::with_capacity(terms.len());
    for ((test, trial), coefficient) in terms {
        let (a, b) = (part(graph, "a", *test), part(graph, "b", *trial));
        let product = graph.mul(a, b);
        parts.push((graph.mul(*coefficient, product), Rational::one()));
    }
    let sum = graph.sum(&parts);
    display_rounded(graph, sum)
}
