//! Z = N A⁻¹Nᵀ: how forces on the measures of the joints move them, in single precision, as what comes of it is judged by the
//! laws.

use whirl_specs::columns::add_matrix;

use crate::bearing::{BlockMemory, Springs};
use crate::linalg::Columns;

/// Unknowns below which a product with A⁻¹ takes less than the way to the measures and back.
const FEWEST: usize = 40;

/// Z of an A⁻¹, and memory to apply it.
pub(super) struct Compliance {
    first: usize,
    unknowns: usize,
    memory: Vec<BlockMemory>,
    /// Z, column after column.
    whole: Vec<f32>,
    forces: Vec<f32>,
    found: Vec<f32>,
}

impl Compliance {
    /// Whether a machine is large enough for it, and Z less to read than what it spares: T_b, its transpose and A⁻¹, twice.
    pub(super) fn is_worth_it(springs: &Springs, unknowns: usize) -> bool {
        let bores = springs.bores.iter().map(|own| own.rows.data.len()).sum::<usize>();
        let measured = springs.measured();
        let is_less = measured * measured <= 4 * bores + unknowns * unknowns;
        measured > 0 && unknowns >= FEWEST && is_less
    }

    /// Of a machine whose coordinates from `first` on are unknown.
    pub(super) fn new(springs: &Springs, first: usize, unknowns: usize) -> Self {
        let measured = springs.measured();
        Compliance {
            first,
            unknowns,
            memory: springs.memory(),
            whole: vec![0.0; measured * measured],
            forces: vec![0.0; measured],
            found: vec![0.0; measured],
        }
    }

    /// Takes A⁻¹, column after column; whether single precision holds Z.
    pub(super) fn take(&mut self, springs: &Springs, inverse: &[f64]) -> bool {
        let inverse = Columns { rows: self.unknowns, cols: self.unknowns, data: inverse };
        let exact = springs.compliance(self.first, inverse).data;
        self.whole.iter_mut().zip(&exact).for_each(|(own, value)| *own = *value as f32);
        self.whole.iter().all(|own| own.is_finite())
    }

    /// u = N times a motion of the unknowns.
    pub(super) fn measure(&mut self, springs: &Springs, motion: &[f64], u: &mut [f64]) {
        springs.measure(self.first, motion, u, &mut self.memory);
    }

    /// Adds Nᵀ times forces on the measures.
    pub(super) fn add_forces(&mut self, springs: &Springs, forces: &[f64], out: &mut [f64]) {
        springs.add_measured(self.first, forces, out, &mut self.memory);
    }

    /// u = Z times forces on the measures.
    pub(super) fn apply(&mut self, forces: impl Iterator<Item = f32>, u: &mut [f64]) {
        self.forces.iter_mut().zip(forces).for_each(|(own, force)| *own = force);
        self.found.fill(0.0);
        add_matrix(&mut self.found, &self.whole, &self.forces);
        u.iter_mut().zip(&self.found).for_each(|(u, own)| *u = f64::from(*own));
    }
}
