//! What a motion says, and the terms of its equations as derived.

use super::MotionSpec;
use super::lagrange::Blocks;
use crate::expression::{Shape, Symmetry, display_rounded};
use crate::kinds::page::Page;

impl MotionSpec {
    /// Everything about a motion but its code.
    pub(in crate::kinds) fn explain(&self, page: &mut Page) {
        self.report(page);
        let show = |id| display_rounded(&self.graph, id);
        let names: Vec<&str> = self.coordinates.iter().map(|c| c.name.as_str()).collect();
        let equations = &self.equations;
        if let (Some(energy), Some(momentum)) = (equations.kinetic_energy, &equations.momentum) {
            page.heading("Kinetic energy T (J), as given");
            page.item(&format!("T = {}", show(energy)));
            page.heading("As derived: momenta p = ∂T/∂q̇");
            for (name, p) in names.iter().zip(momentum) {
                page.item(&format!("p.{name} = {}", show(*p)));
            }
        }
        let from = if equations.kinetic_energy.is_some() { "As derived" } else { "As given" };
        let blocks = |page: &mut Page, name: &str, blocks: &Blocks| {
            let mut zeros = Vec::new();
            for (row, entries) in names.iter().zip(blocks) {
                for (column, entry) in names.iter().zip(entries) {
                    let place = format!("{name}.{row}.{column}");
                    match self.graph.is_zero(*entry) {
                        true => zeros.push(place),
                        false => page.item(&format!("{place} = {}", show(*entry))),
                    }
                }
            }
            if !zeros.is_empty() {
                page.item(&format!("{} = 0", zeros.join(" = ")));
            }
        };
        page.heading(&format!("{from}: mass matrix M(q), eq. (31)"));
        blocks(page, "M", &equations.mass);
        page.heading(&format!("{from}: quadratic velocity vector Q_v, eq. (27)"));
        for (name, row) in names.iter().zip(&equations.quadratic_velocity) {
            page.item(&format!("Q_v.{name} = {}", show(*row)));
        }
        for (heading, name, derived) in [
            ("PF = ∂(M q̈)/∂q, eqs. (37), (40)", "PF", &self.derivatives.pf),
            ("B = ∂Q_v/∂q, eqs. (38), (41)", "B", &self.derivatives.b),
            ("P = ∂Q_v/∂q̇, eqs. (39), (42)", "P", &self.derivatives.p),
        ] {
            page.heading(&format!("As derived: {heading}"));
            blocks(page, name, derived);
        }
    }

    /// Coordinates and tensors with their shapes, and what was proved.
    pub(in crate::kinds) fn report(&self, page: &mut Page) {
        page.heading("Coordinates, with rates _dot and _ddot");
        let rows = self.coordinates.iter().map(|coordinate| {
            let shape = shape(self.graph.shape(coordinate.position), Symmetry::None);
            vec![coordinate.name.clone(), shape.to_string()]
        });
        page.columns(&rows.collect::<Vec<_>>());
        page.heading("Constant tensors");
        let rows = self.tensors.iter().map(|tensor| {
            vec![tensor.name.clone(), shape(tensor.shape, tensor.symmetry).to_string()]
        });
        page.columns(&rows.collect::<Vec<_>>());
        page.heading("Proved on the graph");
        match self.equations.kinetic_energy {
            Some(_) => {
                page.item("M and Q_v follow from T by Lagrange's equations; M is free of rates")
            }
            None => {
                page.item("M is symmetric and free of rates");
                page.item("PF, B and P as declared are the derivatives of M q̈ and Q_v");
            }
        }
    }
}

fn shape(shape: Shape, symmetry: Symmetry) -> &'static str {
    match (shape, symmetry) {
        (Shape::Scalar | Shape::Truth, _) => "number",
        (Shape::Vector, _) => "n values",
        (Shape::Matrix, Symmetry::None) => "n × n",
        (Shape::Matrix, Symmetry::Symmetric) => "n × n, symmetric",
        (Shape::Matrix, Symmetry::Skew) => "n × n, skew",
    }
}
