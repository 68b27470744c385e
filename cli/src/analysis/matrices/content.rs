//! What the files of all formats hold, by the names that they give it.

use whirl_solver::linalg::Matrix;
use whirl_solver::linear::{LinearMachine, Linearised, Standstill, StateSpace};

/// Arrays at a speed.
pub(super) struct Content<'a> {
    /// Matrices by name.
    pub(super) matrices: Vec<(&'static str, &'a Matrix)>,
    /// D, which is zero.
    pub(super) through: (&'static str, Matrix),
    /// What rows and columns are, by name.
    pub(super) names: Vec<(&'static str, Vec<String>)>,
    /// Numbers by name: the speeds of bodies that turn (rad/s).
    pub(super) numbers: Vec<(&'static str, Vec<f64>)>,
}

impl<'a> Content<'a> {
    pub(super) fn new(
        linear: &LinearMachine,
        at: &Standstill,
        equations: &'a Linearised,
        space: &'a StateSpace,
    ) -> Self {
        let rates = space.coordinates.iter().map(|own| format!("rate of {own}"));
        let bodies: Vec<usize> = linear.turning().collect();
        let named = bodies.iter().map(|body| linear.machine().bodies[*body].name().to_owned());
        Content {
            matrices: vec![
                ("mass", &equations.mass),
                ("damping", &equations.damping),
                ("stiffness", &equations.stiffness),
                ("input", &space.input),
                ("output", &space.output),
                ("A", &space.a),
                ("B", &space.b),
                ("C", &space.c),
            ],
            through: ("D", Matrix::zeros(space.outputs.len(), space.inputs.len())),
            names: vec![
                ("coordinates", space.coordinates.clone()),
                ("states", space.coordinates.iter().cloned().chain(rates).collect()),
                ("inputs", space.inputs.clone()),
                ("outputs", space.outputs.clone()),
                ("bodies", named.collect()),
            ],
            numbers: vec![("speeds", bodies.iter().map(|body| at.speeds[*body]).collect())],
        }
    }

    /// All matrices by name.
    pub(super) fn matrices(&self) -> impl Iterator<Item = (&'static str, &Matrix)> {
        let own = self.matrices.iter().map(|(name, matrix)| (*name, *matrix));
        own.chain([(self.through.0, &self.through.1)])
    }
}
