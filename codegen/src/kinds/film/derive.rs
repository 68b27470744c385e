//! What follows from a film: the residual of a cell, forces and integrals, with all their slopes.
//!
//! With N_a the function of node a, f = Σ N_b f_b for every field, weights w and points of each term:
//! R_a = Σ w (∂t/∂v N_a + ∂t/∂(∂v/∂x) ∂N_a/∂x + ∂t/∂(∂v/∂z) ∂N_a/∂z), and ∂R_a/∂f_b by differentiation.

use std::collections::BTreeMap;

use super::operators::named;
use super::rule::{Rule, shape};
use super::spec::{FieldKind, FilmSpec, Term};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::expression::{Graph, Id, Rational};
use crate::operation::Relation;

/// Values of a cell over the fields at its nodes, with those slopes that are not zero.
#[derive(Debug, Clone)]
pub struct Derived {
    /// The graph of all that follows.
    pub graph: Graph,
    /// Fields that are taken, with their symbols at the nodes of the cell: those around run fastest.
    pub fields: Vec<(FieldKind, String, Vec<Id>)>,
    /// What is computed.
    pub values: Vec<Outcome>,
}

/// A value of a cell.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// What it is.
    pub name: String,
    /// The value.
    pub value: Id,
    /// Its slopes that are not zero.
    pub slopes: Vec<CellSlope>,
    /// Its slope by the speed, if that is not zero.
    pub by_speed: Option<Id>,
}

/// A slope of a value by a field at a node.
#[derive(Debug, Clone)]
pub struct CellSlope {
    /// Place of the field in [`Derived::fields`].
    pub field: usize,
    /// The node.
    pub node: usize,
    /// The slope.
    pub slope: Id,
}

/// A field at a node.
pub(super) fn at_node(field: &str, node: usize) -> String {
    format!("{field}_at{node}_")
}

impl FilmSpec {
    /// The residual of a cell, one value a node.
    ///
    /// # Errors
    /// What cannot be differentiated, or grows beyond the bounds of the graph.
    pub fn residual(&self) -> Result<Derived, Diagnostics> {
        let mut cell = Cell::new(self);
        let mut rows = vec![Vec::new(); cell.count()];
        for term in &self.terms {
            let mut parts = [term.value; 3];
            for (part, test) in parts.iter_mut().zip(self.test) {
                *part = cell.by(term.value, test)?;
            }
            for point in points(&term.rules, self.nodes) {
                let parts = cell.at(&parts, &point);
                for (a, row) in rows.iter_mut().enumerate() {
                    let ([value, x, z], weight) = (cell.function(a, &point), &point.weight);
                    for (part, factor) in parts.iter().zip([value, x, z]) {
                        let product = cell.graph.mul(*part, factor);
                        row.push((product, weight.clone()));
                    }
                }
            }
        }
        let area = cell.quarter_area();
        let names = (0..rows.len()).map(|a| format!("flow_of{a}_"));
        let values = names.zip(rows).map(|(name, row)| {
            let sum = cell.graph.sum(&row);
            (name, cell.graph.mul(area, sum))
        });
        let values: Vec<(String, Id)> = values.collect();
        cell.derived(values)
    }

    /// Forces at the nodes of a cell, as far as its own area goes: for every force a value a node; then the integrals of
    /// the outputs over the cell.
    ///
    /// # Errors
    /// As [`FilmSpec::residual`].
    pub fn surface(&self) -> Result<Derived, Diagnostics> {
        let mut cell = Cell::new(self);
        let area = cell.quarter_area();
        let mut values = Vec::new();
        let rules = self.nodes.map(Rule::nodes);
        for (place, force) in self.forces.iter().enumerate() {
            for (a, point) in points(&rules, self.nodes).into_iter().enumerate() {
                let [value] = cell.at(&[force.value], &point);
                let value = cell.graph.times(point.weight, value);
                values.push((format!("force{place}_of{a}_"), cell.graph.mul(area, value)));
            }
        }
        for (place, output) in self.outputs.iter().enumerate() {
            let total = cell.integral(&output.terms);
            values.push((format!("output{place}_"), cell.graph.mul(area, total)));
        }
        let forces = self.forces.len() * cell.count();
        let mut derived = cell.derived(values)?;
        for output in &mut derived.values[forces..] {
            output.slopes.clear();
            output.by_speed = None;
        }
        Ok(derived)
    }
}

/// A point of a cell.
struct Point {
    weight: Rational,
    /// Values and slopes by −1 … 1 of the functions of either direction.
    functions: [Vec<(Rational, Rational)>; 2],
}

/// Points of two rules; those around run fastest.
fn points(rules: &[Rule; 2], nodes: [usize; 2]) -> Vec<Point> {
    let mut all = Vec::new();
    for (z, along) in &rules[1].points {
        for (x, around) in &rules[0].points {
            let functions = [shape(nodes[0], x), shape(nodes[1], z)];
            all.push(Point { weight: around * along, functions });
        }
    }
    all
}

struct Cell<'s> {
    spec: &'s FilmSpec,
    graph: Graph,
    /// Symbols of every field at the nodes.
    fields: Vec<(FieldKind, String, Id, Vec<Id>)>,
    /// 2/dx, 2/dz.
    per_half: [Id; 2],
}

impl<'s> Cell<'s> {
    fn new(spec: &'s FilmSpec) -> Self {
        let mut graph = spec.graph.clone();
        let count = spec.nodes[0] * spec.nodes[1];
        let mut fields = Vec::new();
        for (kind, name, symbol) in spec.fields() {
            let nodes = (0..count).map(|node| graph.scalar(&at_node(name, node))).collect();
            fields.push((kind, name.to_owned(), symbol, nodes));
        }
        let two = graph.integer(2);
        let per_half = spec.lengths.map(|length| graph.div(two, length));
        Cell { spec, graph, fields, per_half }
    }

    fn count(&self) -> usize {
        self.spec.nodes[0] * self.spec.nodes[1]
    }

    /// dx/2·dz/2, by which weights are areas.
    fn quarter_area(&mut self) -> Id {
        let [dx, dz] = self.spec.lengths;
        let area = self.graph.mul(dx, dz);
        self.graph.times(Rational::new(1, 4), area)
    }

    fn by(&mut self, value: Id, symbol: Id) -> Result<Id, Diagnostics> {
        self.graph.differentiate(value, symbol).map_err(|error| {
            Diagnostic::new(&self.spec.file, Code::UNDEFINED, None, error.to_string()).into()
        })
    }

    /// N_a, ∂N_a/∂x and ∂N_a/∂z at a point, as numbers and numbers times 2/dx, 2/dz.
    fn function(&mut self, a: usize, point: &Point) -> [Id; 3] {
        let around = self.spec.nodes[0];
        let ((x, by_x), (z, by_z)) =
            (&point.functions[0][a % around], &point.functions[1][a / around]);
        let value = self.graph.number(x * z);
        let slopes = [by_x * z, x * by_z];
        let [dx, dz] = self.per_half;
        let slopes =
            [dx, dz].into_iter().zip(slopes).map(|(per, slope)| self.graph.times(slope, per));
        let slopes: Vec<Id> = slopes.collect();
        [value, slopes[0], slopes[1]]
    }

    /// Values over the fields at the nodes, at a point.
    fn at<const N: usize>(&mut self, values: &[Id; N], point: &Point) -> [Id; N] {
        let around = self.spec.nodes[0];
        let mut by = BTreeMap::new();
        let half_length = self.graph.times(Rational::new(1, 2), self.spec.lengths[0]);
        let zero = self.graph.integer(0);
        let forward = self.graph.compare(Relation::LessOrEqual, zero, self.spec.speed.symbol);
        let [plus, minus] = [1, -1].map(|sign| self.graph.integer(sign));
        let sign = self.graph.select(forward, plus, minus);
        for (_, name, symbol, nodes) in self.fields.clone() {
            let sum = |graph: &mut Graph, weight: &dyn Fn(usize) -> Rational| {
                let terms: Vec<(Id, Rational)> =
                    nodes.iter().enumerate().map(|(a, node)| (*node, weight(a))).collect();
                graph.sum(&terms)
            };
            let [x, z] = [&point.functions[0], &point.functions[1]];
            let value = sum(&mut self.graph, &|a| &x[a % around].0 * &z[a / around].0);
            let by_x = sum(&mut self.graph, &|a| &x[a % around].1 * &z[a / around].0);
            let by_z = sum(&mut self.graph, &|a| &x[a % around].0 * &z[a / around].1);
            let slope_x = self.graph.mul(self.per_half[0], by_x);
            let slope_z = self.graph.mul(self.per_half[1], by_z);
            let across = self.graph.mul(half_length, slope_x);
            let across = self.graph.mul(sign, across);
            let upstream = self.graph.sub(value, across);
            by.insert(symbol, value);
            for (operator, value) in [("ddx", slope_x), ("ddz", slope_z), ("upstream", upstream)] {
                by.insert(self.graph.scalar(&named(operator, &name)), value);
            }
        }
        let all = self.graph.substitute_all(values, &by);
        all.try_into().unwrap_or_else(|_| unreachable!("as many as were given"))
    }

    /// Sums of terms over their points, per dx/2·dz/2.
    fn integral(&mut self, terms: &[Term]) -> Id {
        let mut parts = Vec::new();
        for term in terms {
            for point in points(&term.rules, self.spec.nodes) {
                let [value] = self.at(&[term.value], &point);
                parts.push((value, point.weight));
            }
        }
        self.graph.sum(&parts)
    }

    /// With slopes by all fields; those that nothing depends on are left out.
    fn derived(mut self, values: Vec<(String, Id)>) -> Result<Derived, Diagnostics> {
        let used =
            |graph: &Graph, node: Id| values.iter().any(|(_, value)| graph.depends(*value, node));
        let fields = std::mem::take(&mut self.fields).into_iter();
        let fields: Vec<(FieldKind, String, Vec<Id>)> = fields
            .filter(|(.., nodes)| nodes.iter().any(|node| used(&self.graph, *node)))
            .map(|(kind, name, _, nodes)| (kind, name, nodes))
            .collect();
        let mut outcomes = Vec::new();
        for (name, value) in values {
            let mut slopes = Vec::new();
            for (field, (.., nodes)) in fields.iter().enumerate() {
                for (node, symbol) in nodes.iter().enumerate() {
                    let slope = self.by(value, *symbol)?;
                    if !self.graph.is_zero(slope) {
                        slopes.push(CellSlope { field, node, slope });
                    }
                }
            }
            let by_speed = self.by(value, self.spec.speed.symbol)?;
            let by_speed = (!self.graph.is_zero(by_speed)).then_some(by_speed);
            outcomes.push(Outcome { name, value, slopes, by_speed });
        }
        if self.graph.exceeded() {
            let message =
                "what follows from this film grows beyond the bounds on numbers and terms";
            return Err(Diagnostic::new(&self.spec.file, Code::LIMIT, None, message).into());
        }
        Ok(Derived { graph: self.graph, fields, values: outcomes })
    }
}

/// A value at a node with its slopes by both unknowns and the gap.
pub(super) struct AtNode {
    pub(super) graph: Graph,
    /// Name, value, slopes.
    pub(super) values: Vec<(String, [Id; 4])>,
}

impl FilmSpec {
    /// Fields that follow at a node.
    pub(super) fn nodal_values(&self) -> Result<AtNode, Diagnostics> {
        let own = self.nodal.iter().map(|field| (field.name.clone(), field.value));
        self.at_a_node(own.collect())
    }

    /// What a node holds.
    pub(super) fn stored_value(&self) -> Result<AtNode, Diagnostics> {
        self.at_a_node(vec![("stored".to_owned(), self.stored.1)])
    }

    fn at_a_node(&self, values: Vec<(String, Id)>) -> Result<AtNode, Diagnostics> {
        let mut cell = Cell::new(self);
        let inputs = [&self.unknowns[0], &self.unknowns[1], &self.gap].map(|own| own.symbol);
        let mut all = Vec::new();
        for (name, value) in values {
            let mut four = [value; 4];
            for (slope, input) in four[1..].iter_mut().zip(inputs) {
                *slope = cell.by(value, input)?;
            }
            all.push((name, four));
        }
        Ok(AtNode { graph: cell.graph, values: all })
    }
}
