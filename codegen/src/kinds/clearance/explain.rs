//! What a clearance says, and all that follows from it for one spring.

use std::collections::BTreeMap;

use super::{ClearanceSpec, Contact, Coordinate, Derived};
use crate::expression::{Id, display_rounded};
use crate::kinds::page::Page;

impl ClearanceSpec {
    /// Everything about a clearance but its code.
    pub(in crate::kinds) fn explain(&self, page: &mut Page) {
        self.report(page);
        let show = |id| display_rounded(&self.graph, id);
        let h = &self.clearance;
        page.heading("As given");
        page.item(&format!("{h} = {}", self.formula.text.text()));
        page.heading("As derived, with the definitions in their places");
        for (name, value) in &self.definitions {
            page.item(&format!("{name} = {}", show(*value)));
        }
        page.item(&format!("{h} (m) = {}", show(self.value)));
        for (place, weight) in ["left", "middle", "right"].iter().zip(self.axial) {
            page.item(&format!(
                "weight of the {place} ring at {} = {}",
                self.axial_variable.name,
                show(weight)
            ));
        }
        for (value, ring) in self.apart.values.into_iter().zip(&self.ring[1..]) {
            page.item(&format!(
                "added to {} where the axes of both bodies are apart (m) = {}",
                ring.name,
                show(value)
            ));
        }
        if self.measures.len() > 1 {
            page.heading("What else laws may depend on, and their other forces work on");
            for (name, value) in self.measures.iter().skip(1) {
                page.item(&format!("{name} = {}", display_rounded(&self.graph, *value)));
            }
        }
        let (normal, others) = self.contacts.split_first().expect("the kind of Q(h, ḣ)");
        let derived = match self.derive(normal) {
            Ok(derived) => derived,
            Err(errors) => {
                page.paragraph(2, &format!("not differentiated: {errors}"));
                return;
            }
        };
        let mut parts = Parts::new(self, derived);
        let all: Vec<&Coordinate> = self.ring.iter().chain([&self.radial]).collect();
        page.heading(&format!("Gradient and rate of {h}"));
        for (k, coordinate) in all.iter().enumerate() {
            let unit = if coordinate.unit == "m" { "1" } else { "m/rad" };
            let slope = parts.derived.gradients[0][k];
            let name = format!("d{h}_d{}", coordinate.name);
            page.item(&format!("{name} ({unit}) = {}", parts.show(slope)));
            parts.name(slope, &name);
        }
        let rate = parts.derived.inputs[1];
        page.item(&format!("{h}_dot (m/s) = {}", parts.show(rate)));
        page.heading("Generalised forces of one spring with normal force Q (N)");
        let force = parts.derived.force.clone();
        for (coordinate, force) in all.iter().zip(force) {
            let unit = if coordinate.unit == "m" { "N" } else { "N m" };
            page.item(&format!("on {} ({unit}) = {}", coordinate.name, parts.show(force)));
        }
        page.heading("Derivatives of the gradient and of the rate that do not vanish");
        second(page, &mut parts, h, &all);
        page.heading("Tangent B + a1 P of the forces: row of the force, column of the coordinate");
        let tangent = parts.derived.tangent.clone();
        for (row, entries) in all.iter().zip(tangent) {
            for (column, entry) in all.iter().zip(entries) {
                page.item(&format!("{}.{} = {}", row.name, column.name, parts.show(entry)));
            }
        }
        others.iter().for_each(|kind| contact(page, self, kind));
    }

    /// The names of a clearance with what they measure.
    pub(in crate::kinds) fn report(&self, page: &mut Page) {
        let row = |role: &str, coordinate: &Coordinate| {
            let Coordinate { name, title, unit, .. } = coordinate;
            vec![name.clone(), unit.clone(), role.to_string(), title.clone()]
        };
        page.heading("Names");
        let mut rows = vec![row("a spring, fixed", &self.spring), row("a bearing", &self.constant)];
        rows.extend(self.radius.iter().map(|coordinate| row("a bearing", coordinate)));
        rows.extend(self.ring.iter().map(|coordinate| row("a ring", coordinate)));
        rows.push(row("a spring", &self.radial));
        rows.extend(self.tangential.iter().map(|coordinate| row("a spring", coordinate)));
        let means = self.bore.iter().chain(&self.section).chain(&self.sensor).chain(&self.gear);
        rows.extend(means.map(|coordinate| row("a ring", coordinate)));
        page.columns(&rows);
    }
}

/// What laws of more inputs and forces than Q(h, ḣ) take, and how their forces act.
fn contact(page: &mut Page, spec: &ClearanceSpec, kind: &Contact) {
    let each = kind.place.words();
    page.heading(&format!("Laws of a {}, {each}: what they take, as derived", kind.name));
    let mut derived = match spec.derive(kind) {
        Ok(derived) => derived,
        Err(errors) => {
            page.paragraph(2, &format!("not differentiated: {errors}"));
            return;
        }
    };
    let definitions = spec.definitions.iter();
    let names: BTreeMap<Id, Id> =
        definitions.map(|(name, value)| (*value, derived.graph.scalar(name))).collect();
    let mut show = |id| {
        let named = derived.graph.substitute(id, &names);
        display_rounded(&derived.graph, named)
    };
    for (input, value) in kind.inputs.iter().zip(&derived.inputs) {
        page.item(&format!("{} ({}) = {}", input.name, input.unit, show(*value)));
    }
    let forces: Vec<String> =
        kind.forces.iter().map(|force| format!("{} ({})", force.name, force.unit)).collect();
    page.heading(&format!("Laws of a {}: generalised forces of {}", kind.name, forces.join(", ")));
    let coordinates = spec.ring.iter().chain(kind.bore.iter().map(|(_, own)| own));
    for (coordinate, force) in coordinates.zip(&derived.force) {
        let unit = if coordinate.unit == "m" { "N" } else { "N m" };
        page.item(&format!("on {} ({unit}) = {}", coordinate.name, show(*force)));
    }
}

/// Says and names ∂²h/∂q∂q and ∂ḣ/∂q, of which the tangent is made.
fn second(page: &mut Page, parts: &mut Parts, h: &str, all: &[&Coordinate]) {
    let gradient = parts.derived.gradients[0].clone();
    let rate = parts.derived.inputs[1];
    let mut found = Vec::new();
    for (i, row) in all.iter().enumerate() {
        for column in &all[i..] {
            found.push((
                format!("d2{h}_d{}_d{}", row.name, column.name),
                gradient[i],
                column.symbol,
            ));
        }
    }
    found.extend(all.iter().map(|q| (format!("d{h}_dot_d{}", q.name), rate, q.symbol)));
    for (name, of, by) in found {
        let Ok(derivative) = parts.derived.graph.differentiate(of, by) else { continue };
        if parts.derived.graph.as_number(derivative).is_none() {
            page.item(&format!("{name} = {}", parts.show(derivative)));
            parts.name(derivative, &name);
        }
    }
}

/// What follows from a clearance, with names for parts that others are made of.
struct Parts {
    derived: Derived,
    names: BTreeMap<Id, Id>,
}

impl Parts {
    fn new(spec: &ClearanceSpec, mut derived: Derived) -> Self {
        let definitions = spec.definitions.iter();
        let names = definitions.map(|(name, value)| (*value, derived.graph.scalar(name)));
        Parts { names: names.collect(), derived }
    }

    /// Shows `part` by its name from now on; a part that is named already, or a number, stays as it is.
    fn name(&mut self, part: Id, name: &str) {
        if self.derived.graph.as_number(part).is_none() {
            let symbol = self.derived.graph.scalar(name);
            self.names.entry(part).or_insert(symbol);
        }
    }

    fn show(&mut self, id: Id) -> String {
        let named = self.derived.graph.substitute(id, &self.names);
        display_rounded(&self.derived.graph, named)
    }
}
