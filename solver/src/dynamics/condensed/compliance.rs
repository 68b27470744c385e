//! Z = N A⁻¹Nᵀ: how forces on the measures of the joints move them, in single precision, as what comes of it is judged by the
//! laws.

use crate::bearing::Springs;
use crate::linalg::{Columns, add_columns};

/// Z of an A⁻¹, and memory to apply it.
pub(super) struct Compliance {
    first: usize,
    form: Form,
    /// T_b of the bores of every body.
    bores: Vec<Vec<f32>>,
    /// Values of measures.
    given: Vec<f32>,
    found: Vec<f32>,
    /// Values of the unknowns.
    forces: Vec<f64>,
    solved: Vec<f32>,
    motion: Vec<f64>,
}

/// What is kept, column after column: whichever is less to read.
enum Form {
    /// Z.
    Whole(Vec<f32>),
    /// A⁻¹, between N and its transpose.
    Inverse(Vec<f32>),
}

impl Compliance {
    /// Of a machine whose coordinates from `first` on are unknown.
    pub(super) fn new(springs: &Springs, first: usize, unknowns: usize) -> Self {
        let measured = springs.measured();
        let rows = springs.bores.iter().map(|own| own.rows.data.len()).sum::<usize>();
        let form = match measured * measured <= 2 * rows + unknowns * unknowns {
            true => Form::Whole(vec![0.0; measured * measured]),
            false => Form::Inverse(vec![0.0; unknowns * unknowns]),
        };
        Compliance {
            first,
            form,
            bores: springs.rough_bores(),
            given: vec![0.0; measured],
            found: vec![0.0; measured],
            forces: vec![0.0; unknowns],
            solved: vec![0.0; unknowns],
            motion: vec![0.0; unknowns],
        }
    }

    /// Takes A⁻¹, column after column; whether single precision holds it.
    pub(super) fn take(&mut self, springs: &Springs, inverse: &[f64]) -> bool {
        let n = self.forces.len();
        let rough = |own: &mut [f32], values: &[f64]| {
            own.iter_mut().zip(values).for_each(|(own, value)| *own = *value as f32);
            own.iter().all(|own| own.is_finite())
        };
        match &mut self.form {
            Form::Whole(own) => {
                let inverse = Columns { rows: n, cols: n, data: inverse };
                rough(own, &springs.compliance(self.first, inverse).data)
            }
            Form::Inverse(own) => rough(own, inverse),
        }
    }

    /// u = N times a motion of the unknowns.
    pub(super) fn measure(&mut self, springs: &Springs, motion: &[f64], u: &mut [f64]) {
        springs.measure((self.first, &self.bores), motion, &mut self.found, u);
    }

    /// u = Z times forces on the measures.
    pub(super) fn apply(
        &mut self,
        springs: &Springs,
        forces: impl Iterator<Item = f32>,
        u: &mut [f64],
    ) {
        self.found.fill(0.0);
        match &self.form {
            Form::Whole(own) => {
                add_columns(&mut self.found, own.chunks_exact(u.len()).zip(forces));
                u.iter_mut().zip(&self.found).for_each(|(u, own)| *u = f64::from(*own));
            }
            Form::Inverse(own) => {
                self.given.iter_mut().zip(forces).for_each(|(own, force)| *own = force);
                self.forces.fill(0.0);
                let rough = (self.first, self.bores.as_slice());
                springs.add_roughly(rough, &self.given, &mut self.solved, &mut self.forces);
                self.solved.fill(0.0);
                let forces = self.forces.iter().map(|force| *force as f32);
                add_columns(&mut self.solved, own.chunks_exact(self.forces.len()).zip(forces));
                let solved = self.motion.iter_mut().zip(&self.solved);
                solved.for_each(|(motion, own)| *motion = f64::from(*own));
                springs.measure(rough, &self.motion, &mut self.found, u);
            }
        }
    }
}
