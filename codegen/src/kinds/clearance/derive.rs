//! Kinds of laws, and what follows for each by differentiation.
//!
//! With measures x_m(q) on which forces F_m work, and inputs z_n(q, q̇) of the law (measures, their rates,
//! coordinates): the generalised force is Σ_m F_m ∂x_m/∂qᵢ; B + a1·P is
//! Σ_m [ Σ_n ∂F_m/∂z_n (∂z_n/∂q_k + a1 ∂z_n/∂q̇_k) ∂x_m/∂qᵢ + F_m ∂²x_m/∂qᵢ∂q_k ].

use num_traits::One;

use super::{ClearanceSpec, Contact, Coordinate, Taken};
use crate::diagnostic::{Code, Diagnostics};
use crate::expression::{Graph, Id, Rational};

/// What follows for one spring, or one ring. Coordinates are those of the ring, then those of the bore.
#[derive(Debug, Clone)]
pub struct Derived {
    /// The graph of all that follows.
    pub graph: Graph,
    /// Rates of the coordinates.
    pub rates: Vec<Coordinate>,
    /// F_m with their names.
    pub forces: Vec<(String, Id)>,
    /// ∂F_m/∂z_n with their names: one row a force.
    pub slopes: Vec<Vec<(String, Id)>>,
    /// a1 of the time integration, ∂q̇/∂q.
    pub a1: Id,
    /// z_n, then the measures on which forces work and that are no inputs.
    pub inputs: Vec<Id>,
    /// ∂x_m/∂q: one row a force.
    pub gradients: Vec<Vec<Id>>,
    /// Generalised forces, one a coordinate.
    pub(crate) force: Vec<Id>,
    /// B + a1·P, row by row.
    pub tangent: Vec<Vec<Id>>,
}

impl ClearanceSpec {
    /// Inputs, generalised forces and their tangent for a kind of law.
    ///
    /// # Errors
    /// None for a spec that was read without errors.
    pub fn derive(&self, contact: &Contact) -> Result<Derived, Diagnostics> {
        let mut graph = self.graph.clone();
        let coordinates: Vec<&Coordinate> =
            self.ring.iter().chain(contact.bore.iter().map(|(_, own)| own)).collect();
        let rates: Vec<Coordinate> = coordinates
            .iter()
            .map(|coordinate| {
                let name = format!("{}_dot", coordinate.name);
                let symbol = graph.scalar(&name);
                let title = format!("rate of {}", coordinate.name);
                let unit = format!("{}/s", coordinate.unit);
                Coordinate { name, title, unit, symbol }
            })
            .collect();
        let names = contact.forces.iter().map(|force| force.name.clone());
        let forces: Vec<(String, Id)> =
            names.map(|name| (name.clone(), graph.scalar(&name))).collect();
        let mut slope = |name: String| {
            let symbol = graph.scalar(&name);
            (name, symbol)
        };
        let slopes: Vec<Vec<(String, Id)>> = contact
            .slopes()
            .into_iter()
            .map(|row| row.into_iter().map(&mut slope).collect())
            .collect();
        let a1 = graph.scalar("a1_");
        let q: Vec<Id> = coordinates.iter().map(|own| own.symbol).collect();
        let v: Vec<Id> = rates.iter().map(|own| own.symbol).collect();
        let mut d = Derivation { graph: &mut graph, spec: self, q: &q, v: &v, a1 };
        let (mut inputs, mut changes) = (Vec::new(), Vec::new());
        for input in &contact.inputs {
            let value = d.input(input.taken)?;
            inputs.push(value);
            changes.push(d.changes(value)?);
        }
        inputs.extend(contact.further_measures().map(|force| force.measure));
        let gradients = contact.forces.iter().map(|force| d.gradient(force.measure));
        let gradients = gradients.collect::<Result<Vec<_>, _>>()?;
        let (mut force, mut tangent) = (Vec::new(), Vec::new());
        for i in 0..q.len() {
            let parts: Vec<Id> = (forces.iter().zip(&gradients))
                .map(|((_, f), gradient)| d.graph.mul(*f, gradient[i]))
                .collect();
            force.push(d.sum(&parts));
            let mut row = Vec::new();
            for k in 0..q.len() {
                let mut parts = Vec::new();
                for (((_, f), slopes), gradient) in forces.iter().zip(&slopes).zip(&gradients) {
                    let by_inputs: Vec<Id> = (slopes.iter().zip(&changes))
                        .map(|((_, slope), change)| d.graph.mul(*slope, change[k]))
                        .collect();
                    let change = d.sum(&by_inputs);
                    parts.push(d.graph.mul(change, gradient[i]));
                    let second = d.by(gradient[i], q[k])?;
                    parts.push(d.graph.mul(*f, second));
                }
                row.push(d.sum(&parts));
            }
            tangent.push(row);
        }
        Ok(Derived { graph, rates, forces, slopes, a1, inputs, gradients, force, tangent })
    }
}

struct Derivation<'a> {
    graph: &'a mut Graph,
    spec: &'a ClearanceSpec,
    q: &'a [Id],
    v: &'a [Id],
    a1: Id,
}

impl Derivation<'_> {
    fn input(&mut self, taken: Taken) -> Result<Id, Diagnostics> {
        let Taken::Rate(measure) = taken else { return Ok(taken.expression()) };
        let gradient = self.gradient(measure)?;
        let parts: Vec<Id> =
            gradient.iter().zip(self.v).map(|(g, v)| self.graph.mul(*g, *v)).collect();
        Ok(self.sum(&parts))
    }

    fn gradient(&mut self, of: Id) -> Result<Vec<Id>, Diagnostics> {
        self.q.iter().map(|q| self.by(of, *q)).collect()
    }

    /// ∂z/∂q_k + a1 ∂z/∂q̇_k.
    fn changes(&mut self, of: Id) -> Result<Vec<Id>, Diagnostics> {
        let mut changes = Vec::new();
        for (q, v) in self.q.iter().zip(self.v) {
            let (direct, by_rate) = (self.by(of, *q)?, self.by(of, *v)?);
            let by_rate = self.graph.mul(self.a1, by_rate);
            changes.push(self.graph.add(direct, by_rate));
        }
        Ok(changes)
    }

    fn sum(&mut self, parts: &[Id]) -> Id {
        let terms: Vec<(Id, Rational)> = parts.iter().map(|id| (*id, Rational::one())).collect();
        self.graph.sum(&terms)
    }

    fn by(&mut self, expression: Id, symbol: Id) -> Result<Id, Diagnostics> {
        self.graph.differentiate(expression, symbol).map_err(|error| {
            let text = &self.spec.formula.text;
            Diagnostics::from(text.error_here(Code::UNDEFINED, error.to_string()))
        })
    }
}
