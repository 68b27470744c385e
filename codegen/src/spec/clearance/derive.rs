//! What follows from a clearance h by differentiation, for one spring with normal force Q(h, ḣ).
//!
//! With q the ring coordinates and the spring's own, g = ∂h/∂q and ḣ = Σ gᵢ q̇ᵢ:
//! the generalised force is Q g; B + a1·P is
//! (∂Q/∂h g_k + ∂Q/∂ḣ ∂ḣ/∂q_k) gᵢ + Q ∂²h/∂qᵢ∂q_k + a1 ∂Q/∂ḣ g_k gᵢ.

use num_traits::One;

use super::{ClearanceSpec, Coordinate, RING};
use crate::diagnostic::{Code, Diagnostics};
use crate::expression::{Graph, Id, Rational};

/// Everything that the kernels compute, for one spring.
#[derive(Debug, Clone)]
pub struct Derived {
    /// The graph of all that follows.
    pub graph: Graph,
    /// Rates of the ring coordinates.
    pub ring_rates: [Coordinate; RING],
    /// Rate of the spring's coordinate.
    pub radial_rate: Coordinate,
    /// Q, the normal force.
    pub q: Id,
    /// ∂Q/∂h.
    pub dq_dh: Id,
    /// ∂Q/∂ḣ.
    pub dq_dh_dot: Id,
    /// a1 of the time integration, ∂q̇/∂q.
    pub a1: Id,
    /// ∂h/∂q of the ring coordinates and of the spring's own, in this order.
    pub gradient: Vec<Id>,
    /// ḣ.
    pub h_dot: Id,
    /// Generalised forces.
    pub force: Force,
    /// Their tangent.
    pub tangent: Tangent,
}

/// Generalised forces of one spring.
#[derive(Debug, Clone)]
pub struct Force {
    /// On the ring coordinates.
    pub ring: [Id; RING],
    /// On the spring's coordinate.
    pub radial: Id,
}

/// Derivatives B + a1·P of the generalised forces of one spring.
#[derive(Debug, Clone)]
pub struct Tangent {
    /// Ring forces by ring coordinates, row by row.
    pub ring_ring: [[Id; RING]; RING],
    /// Ring forces by the spring's coordinate.
    pub ring_radial: [Id; RING],
    /// The spring's force by ring coordinates.
    pub radial_ring: [Id; RING],
    /// The spring's force by its own coordinate.
    pub radial_radial: Id,
}

pub(super) fn derive(spec: &ClearanceSpec) -> Result<Derived, Diagnostics> {
    let mut graph = spec.graph.clone();
    let mut rate = |coordinate: &Coordinate| {
        let name = format!("{}_dot", coordinate.name);
        let title = format!("rate of {}", coordinate.name);
        let symbol = graph.scalar(&name);
        Coordinate { name, title, unit: format!("{}/s", coordinate.unit), symbol }
    };
    let ring_rates = spec.ring.each_ref().map(&mut rate);
    let radial_rate = rate(&spec.radial);
    let [q, dq_dh, dq_dh_dot, a1] =
        ["Q", "dQ_dh", "dQ_dh_dot", "a1_"].map(|name| graph.scalar(name));

    // All four coordinates together; the spring's own is the last.
    let coordinates: Vec<Id> =
        spec.ring.iter().chain([&spec.radial]).map(|coordinate| coordinate.symbol).collect();
    let rates: Vec<Id> =
        ring_rates.iter().chain([&radial_rate]).map(|coordinate| coordinate.symbol).collect();
    let mut d = Derivation { graph: &mut graph, spec };
    let mut gradient = Vec::with_capacity(coordinates.len());
    for coordinate in &coordinates {
        gradient.push(d.by(spec.value, *coordinate)?);
    }
    let terms: Vec<(Id, Rational)> = gradient
        .iter()
        .zip(&rates)
        .map(|(g, rate)| (d.graph.mul(*g, *rate), Rational::one()))
        .collect();
    let h_dot = d.graph.sum(&terms);
    let mut forces = Vec::with_capacity(coordinates.len());
    let mut tangent = Vec::with_capacity(coordinates.len());
    for g in &gradient {
        forces.push(d.graph.mul(q, *g));
        let mut row = Vec::with_capacity(coordinates.len());
        for (coordinate, g_k) in coordinates.iter().zip(&gradient) {
            let by_rate = d.graph.mul(a1, *g_k);
            let slip = d.by(h_dot, *coordinate)?;
            let second = d.by(*g, *coordinate)?;
            let rates = d.graph.add(slip, by_rate);
            let (elastic, viscous) = (d.graph.mul(dq_dh, *g_k), d.graph.mul(dq_dh_dot, rates));
            let change = d.graph.add(elastic, viscous);
            let (direct, geometric) = (d.graph.mul(change, *g), d.graph.mul(q, second));
            row.push(d.graph.add(direct, geometric));
        }
        tangent.push(row);
    }
    let ring = |row: &[Id]| std::array::from_fn(|k| row[k]);
    let derived = Derived {
        ring_rates,
        radial_rate,
        q,
        dq_dh,
        dq_dh_dot,
        a1,
        gradient,
        h_dot,
        force: Force { ring: ring(&forces), radial: forces[RING] },
        tangent: Tangent {
            ring_ring: std::array::from_fn(|i| ring(&tangent[i])),
            ring_radial: std::array::from_fn(|i| tangent[i][RING]),
            radial_ring: ring(&tangent[RING]),
            radial_radial: tangent[RING][RING],
        },
        graph,
    };
    Ok(derived)
}

struct Derivation<'a> {
    graph: &'a mut Graph,
    spec: &'a ClearanceSpec,
}

impl Derivation<'_> {
    fn by(&mut self, expression: Id, symbol: Id) -> Result<Id, Diagnostics> {
        self.graph.differentiate(expression, symbol).map_err(|error| {
            let text = &self.spec.formula.text;
            Diagnostics::from(text.error_here(Code::UNDEFINED, error.to_string()))
        })
    }
}
