//! Equations of motion from a kinetic energy, and the derivatives that a Newton iteration needs.
//!
//! With momenta p = ∂T/∂q̇, Lagrange's equations d/dt p − ∂T/∂q = Q become M(q) q̈ = Q_v + Q with
//! M = ∂p/∂q̇ and Q_v = ∂T/∂q − (∂p/∂q) q̇.

use crate::expression::{DifferentiateError, Graph, Id, Shape};

/// A generalised coordinate with its rates: symbols of one shape, scalar or vector.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Coordinate {
    /// Name in the spec, such as `theta`.
    pub name: String,
    /// q.
    pub(crate) position: Id,
    /// q̇, the symbol `<name>_dot`.
    pub(crate) velocity: Id,
    /// q̈, the symbol `<name>_ddot`.
    pub(crate) acceleration: Id,
}

impl Coordinate {
    /// The coordinate called `name`, its symbols added to the graph.
    pub(crate) fn new(graph: &mut Graph, name: &str, shape: Shape) -> Self {
        let mut symbol = |suffix: &str| {
            graph.symbol(&format!("{name}{suffix}"), shape, crate::expression::Symmetry::None)
        };
        Coordinate {
            position: symbol(""),
            velocity: symbol("_dot"),
            acceleration: symbol("_ddot"),
            name: name.to_owned(),
        }
    }
}

/// A matrix over the coordinates, block by block, rows first. The block of a scalar row and a vector
/// column is a vector standing for a row; of a vector row and a scalar column, a column.
pub(crate) type Blocks = Vec<Vec<Id>>;

/// M and Q_v over the coordinates, and where they come from an energy, its momenta.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Equations {
    /// T, where the equations come from one.
    pub(crate) kinetic_energy: Option<Id>,
    /// p = ∂T/∂q̇, likewise.
    pub(crate) momentum: Option<Vec<Id>>,
    /// M(q), eq. (31).
    pub(crate) mass: Blocks,
    /// Q_v, eq. (27).
    pub(crate) quadratic_velocity: Vec<Id>,
}

/// What Newton's method needs beside M and Q_v.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Derivatives {
    /// M q̈ as expressions.
    pub(crate) mass_times_acceleration: Vec<Id>,
    /// PF = ∂(M q̈)/∂q, eq. (37).
    pub(crate) pf: Blocks,
    /// B = ∂Q_v/∂q, eq. (38).
    pub b: Blocks,
    /// P = ∂Q_v/∂q̇, eq. (39).
    pub(crate) p: Blocks,
}

/// The equations of motion of a kinetic energy.
///
/// # Errors
/// A derivative that the graph cannot hold.
pub(crate) fn lagrange(
    graph: &mut Graph,
    energy: Id,
    coordinates: &[Coordinate],
) -> Result<Equations, DifferentiateError> {
    let momentum = coordinates
        .iter()
        .map(|coordinate| graph.differentiate(energy, coordinate.velocity))
        .collect::<Result<Vec<_>, _>>()?;
    let mass = jacobian(graph, &momentum, coordinates, |coordinate| coordinate.velocity)?;
    let by_position = jacobian(graph, &momentum, coordinates, |coordinate| coordinate.position)?;
    let mut quadratic_velocity = Vec::with_capacity(coordinates.len());
    for (coordinate, row) in coordinates.iter().zip(&by_position) {
        let force = graph.differentiate(energy, coordinate.position)?;
        let shift = contracted(graph, row, coordinates, |coordinate| coordinate.velocity);
        quadratic_velocity.push(graph.sub(force, shift));
    }
    Ok(Equations {
        kinetic_energy: Some(energy),
        momentum: Some(momentum),
        mass,
        quadratic_velocity,
    })
}

/// PF, B and P of equations of motion.
///
/// # Errors
/// A derivative that the graph cannot hold.
pub(crate) fn derivatives(
    graph: &mut Graph,
    equations: &Equations,
    coordinates: &[Coordinate],
) -> Result<Derivatives, DifferentiateError> {
    let mass_times_acceleration: Vec<Id> = equations
        .mass
        .iter()
        .map(|row| contracted(graph, row, coordinates, |coordinate| coordinate.acceleration))
        .collect();
    let q_v = &equations.quadratic_velocity;
    Ok(Derivatives {
        pf: jacobian(graph, &mass_times_acceleration, coordinates, |c| c.position)?,
        b: jacobian(graph, q_v, coordinates, |coordinate| coordinate.position)?,
        p: jacobian(graph, q_v, coordinates, |coordinate| coordinate.velocity)?,
        mass_times_acceleration,
    })
}

fn jacobian(
    graph: &mut Graph,
    rows: &[Id],
    coordinates: &[Coordinate],
    of: fn(&Coordinate) -> Id,
) -> Result<Blocks, DifferentiateError> {
    let row = |row: &Id| coordinates.iter().map(|c| graph.differentiate(*row, of(c))).collect();
    rows.iter().map(row).collect()
}

/// Σ_j block_ij x_j of one row of blocks.
fn contracted(
    graph: &mut Graph,
    row: &[Id],
    coordinates: &[Coordinate],
    of: fn(&Coordinate) -> Id,
) -> Id {
    let products: Vec<Id> = row
        .iter()
        .zip(coordinates)
        .map(|(block, coordinate)| {
            let x = of(coordinate);
            match (graph.shape(*block), graph.shape(x)) {
                (Shape::Vector, Shape::Vector) => graph.dot(*block, x),
                _ => graph.mul(*block, x),
            }
        })
        .collect();
    products.into_iter().reduce(|sum, product| graph.add(sum, product)).expect("a coordinate")
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::expression::{Symmetry, normal};

    /// The shaft of PHYSICS section 2 in a graph, and a reader of formulas over its names.
    struct Shaft {
        graph: Graph,
        coordinates: Vec<Coordinate>,
        names: BTreeMap<String, Id>,
    }

    impl Shaft {
        fn new() -> Self {
            let mut graph = Graph::new();
            let coordinates = vec![
                Coordinate::new(&mut graph, "theta", Shape::Scalar),
                Coordinate::new(&mut graph, "eta", Shape::Vector),
            ];
            let mut names = BTreeMap::new();
            for coordinate in &coordinates {
                names.insert(coordinate.name.clone(), coordinate.position);
                names.insert(format!("{}_dot", coordinate.name), coordinate.velocity);
                names.insert(format!("{}_ddot", coordinate.name), coordinate.acceleration);
            }
            names.insert("J0".into(), graph.scalar("J0"));
            for name in ["y0", "g0"] {
                names.insert(name.into(), graph.vector(name));
            }
            for (name, symmetry) in
                [("M", Symmetry::Symmetric), ("Y", Symmetry::Symmetric), ("H", Symmetry::Skew)]
            {
                names.insert(name.into(), graph.matrix(name, symmetry));
            }
            Shaft { graph, coordinates, names }
        }

        fn formula(&mut self, text: &str) -> Id {
            let text = crate::diagnostic::Located::alone("energy", text);
            let formula = crate::formula::parse(&text).expect("a formula");
            crate::formula::lower(&formula, &mut self.graph, &self.names).expect("a meaning")
        }

        fn assert_equal(&mut self, derived: Id, formula: &str) {
            let expected = self.formula(formula);
            assert!(self.graph.same_signature(derived, expected), "{formula}");
            assert!(normal::equal(&mut self.graph, derived, expected), "{formula}");
        }
    }

    #[test]
    fn the_energy_of_the_shaft_gives_the_terms_of_its_equations() {
        let mut shaft = Shaft::new();
        let energy = shaft.formula(
            "1/2*theta_dot^2*(J0 + 2*dot(y0, eta) + dot(eta, Y*eta)) \
             + theta_dot*dot(g0 - H*eta, eta_dot) + 1/2*dot(eta_dot, M*eta_dot)",
        );
        let coordinates = shaft.coordinates.clone();
        let equations = lagrange(&mut shaft.graph, energy, &coordinates).expect("equations");
        let derived = derivatives(&mut shaft.graph, &equations, &coordinates).expect("derivatives");

        shaft.assert_equal(equations.mass[0][0], "J0 + 2*dot(y0, eta) + dot(eta, Y*eta)");
        shaft.assert_equal(equations.mass[0][1], "g0 - H*eta");
        shaft.assert_equal(equations.mass[1][0], "g0 - H*eta");
        shaft.assert_equal(equations.mass[1][1], "M");
        let q_v = &equations.quadratic_velocity;
        shaft.assert_equal(q_v[0], "-2*dot(y0 + Y*eta, eta_dot)*theta_dot");
        shaft.assert_equal(q_v[1], "(y0 + Y*eta)*theta_dot^2 + 2*(H*eta_dot)*theta_dot");

        shaft.assert_equal(derived.pf[0][1], "2*(y0 + Y*eta)*theta_ddot + H*eta_ddot");
        shaft.assert_equal(derived.pf[1][1], "-theta_ddot*H");
        assert!(shaft.graph.is_zero(derived.pf[0][0]) && shaft.graph.is_zero(derived.pf[1][0]));
        shaft.assert_equal(derived.b[0][1], "-2*theta_dot*(Y*eta_dot)");
        shaft.assert_equal(derived.b[1][1], "theta_dot^2*Y");
        assert!(shaft.graph.is_zero(derived.b[0][0]) && shaft.graph.is_zero(derived.b[1][0]));
        shaft.assert_equal(derived.p[0][0], "-2*dot(y0 + Y*eta, eta_dot)");
        shaft.assert_equal(derived.p[0][1], "-2*theta_dot*(y0 + Y*eta)");
        shaft.assert_equal(derived.p[1][0], "2*theta_dot*(y0 + Y*eta) + 2*(H*eta_dot)");
        shaft.assert_equal(derived.p[1][1], "2*theta_dot*H");
    }
}
