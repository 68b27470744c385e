//! Small motions with what acts on them and what is seen of them: M′z̈ + C′ż + K′z = F u, y = R z, and the same in states.

use super::linearised::{Linearised, Standstill};
use super::round::LinearMachine;
use crate::error::Error;
use crate::linalg::{Cholesky, Matrix};
use crate::loads::{Load, Position};

/// Directions of space in which points move and forces act, as names have them.
const DIRECTIONS: [&str; 2] = ["x", "y"];

/// Inputs and outputs of small motions, by name. With the states (z, ż) the rates of these are A (z, ż) + B u, and the
/// outputs C (z, ż); nothing of u goes to the outputs at once.
#[derive(Debug, Clone, PartialEq)]
pub struct StateSpace {
    /// The coordinates z, in their order: n of them.
    pub coordinates: Vec<String>,
    /// u: cos Ωt and sin Ωt of what turns with a body (`unbalance.BODY.cos`), the factor of a load that stands in space
    /// (`load.NAME`), a force between journal and bore (`joint.NAME.x`, N) or on a point (`output.NAME.x`, N) along x and y.
    pub inputs: Vec<String>,
    /// y: displacements along x and y (m): of journals in their bores (`joint.NAME.x`), of points (`output.NAME.x`).
    pub outputs: Vec<String>,
    /// F, generalised forces by inputs: n rows.
    pub input: Matrix,
    /// R, outputs by coordinates: n columns.
    pub output: Matrix,
    /// A: 2n × 2n.
    pub a: Matrix,
    /// B: 2n rows.
    pub b: Matrix,
    /// C: 2n columns.
    pub c: Matrix,
}

impl LinearMachine {
    /// Those of the machine at a state.
    ///
    /// # Errors
    /// A mass that is not positive definite.
    pub fn state_space(
        &self,
        at: &Standstill,
        equations: &Linearised,
    ) -> Result<StateSpace, Error> {
        let n = equations.mass.rows;
        let points = self.points();
        let rows = points.iter().flat_map(|point| {
            let rows = self.rows(at, point);
            DIRECTIONS
                .into_iter()
                .zip(rows)
                .map(|(axis, row)| (format!("{}.{axis}", point.name), row))
        });
        let (outputs, rows): (Vec<String>, Vec<Vec<f64>>) = rows.unzip();
        let mut inputs = Vec::new();
        for body in self.unbalanced() {
            let name = self.machine.bodies[body].name();
            let force = self.unbalance_force(at, body);
            let parts = [
                ("cos", force.iter().map(|own| own.re).collect()),
                ("sin", force.iter().map(|own| -own.im).collect()),
            ];
            inputs.extend(parts.map(|(part, force)| (format!("unbalance.{name}.{part}"), force)));
        }
        inputs.extend(self.load_forces(at));
        inputs.extend(outputs.iter().cloned().zip(rows.iter().cloned()));
        let (inputs, forces): (Vec<String>, Vec<Vec<f64>>) = inputs.into_iter().unzip();
        let input = Matrix::from_fn(n, inputs.len(), |i, j| forces[j][i]);
        let output = Matrix::from_fn(outputs.len(), n, |i, j| rows[i][j]);
        let mut factor = Cholesky::new(n);
        factor.factor(&equations.mass.data)?;
        let mut by_mass = |matrix: &Matrix| {
            let mut out = matrix.clone();
            factor.solve_in_place(&mut out.data);
            out
        };
        let [stiffness, damping, force] =
            [&equations.stiffness, &equations.damping, &input].map(&mut by_mass);
        let a = Matrix::from_fn(2 * n, 2 * n, |i, j| match (i.checked_sub(n), j.checked_sub(n)) {
            (None, Some(k)) if i == k => 1.0,
            (None, _) => 0.0,
            (Some(i), None) => -stiffness[(i, j)],
            (Some(i), Some(j)) => -damping[(i, j)],
        });
        let b = Matrix::from_fn(2 * n, inputs.len(), |i, j| {
            i.checked_sub(n).map_or(0.0, |i| force[(i, j)])
        });
        let c =
            Matrix::from_fn(outputs.len(), 2 * n, |i, j| if j < n { output[(i, j)] } else { 0.0 });
        let places = self.kept(at).into_iter();
        let coordinates = places.map(|place| self.machine.coordinate(place)).collect();
        Ok(StateSpace { coordinates, inputs, outputs, input, output, a, b, c })
    }

    /// Generalised forces of all loads that stand in space and of couples about the axes, at the factor 1, by their names.
    fn load_forces(&self, at: &Standstill) -> Vec<(String, Vec<f64>)> {
        let mut found: Vec<(String, Vec<f64>)> = Vec::new();
        let state = &at.found.state;
        let named = |load: &&Load| !load.name.is_empty() && !load.turns_with_its_body();
        for load in self.machine.loads.iter().filter(named) {
            let place = &self.machine.places()[load.body];
            let position = Position::new(place.rotation.map_or(0.0, |theta| state.q[theta]));
            let mut all = vec![0.0; self.machine.size()];
            load.add_force((&load.action.amplitude(), 1.0), &position, &state.q, place, &mut all);
            if place.rotation.is_some() {
                self.force_in_space(at, (load.body, 0.0), &mut all[place.flexible.clone()]);
            }
            let own = self.kept(at).into_iter().map(|place| all[place]);
            // A load on several nodes is one of each.
            match found.iter_mut().find(|(name, _)| *name == load.name) {
                Some((_, sum)) => sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += own),
                None => found.push((load.name.clone(), own.collect())),
            }
        }
        found
    }
}
