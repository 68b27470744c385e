//! Coordinates of small motions: those of each body turned back from its frame.
//!
//! A body whose frame stands at the angle φ against the frame of small motions, and turns against it by φ̇, has
//! q = R(−φ) z, q̇ = R(−φ)(ż − φ̇ S z), q̈ = R(−φ)(z̈ − 2φ̇ S ż + φ̇² S² z), R(α) = exp(αS) = 1 + sin α S + (1 − cos α) S².

use super::round::LinearMachine;
use crate::equations::Tangents;
use crate::linalg::{Matrix, multiply, transpose_multiply};

/// How the frame of a body stands against that of small motions.
pub(super) struct Seen<'a> {
    /// S and S².
    pub(super) generators: [&'a Matrix; 2],
    /// φ (rad).
    pub(super) angle: f64,
    /// φ̇ (rad/s).
    pub(super) rate: f64,
}

impl Seen<'_> {
    /// R(−φ).
    pub(super) fn back(&self) -> Matrix {
        let [once, twice] = self.generators;
        let (sin, cos) = self.angle.sin_cos();
        Matrix::from_fn(once.rows, once.cols, |i, j| {
            let own = f64::from(u8::from(i == j));
            own - sin * once[(i, j)] + (1.0 - cos) * twice[(i, j)]
        })
    }
}

impl LinearMachine {
    /// M′ = RᵀMR, C′ = Rᵀ(CR − 2MRD) and K′ = Rᵀ(KR − CRD + MRD²) over the angles that are `found`, by
    /// their places in q, and the coordinates of bodies, R and
    /// D = φ̇S of each body as it is seen; one that is not is left as it is.
    pub(super) fn in_frame(
        &self,
        (found, tangents): (&[usize], &Tangents),
        seen: &[Option<Seen>],
    ) -> [Matrix; 3] {
        let first = self.machine.first_unknown();
        let flexible = self.machine.rotations()..self.machine.size();
        let places = found.iter().copied().chain(flexible).map(|place| place - first);
        let kept: Vec<usize> = places.collect();
        let Tangents { mass, damping, stiffness, .. } = tangents;
        let [mut mass, mut damping, mut stiffness] =
            [mass, damping, stiffness].map(|own| own.select(&kept, &kept));
        let (rows, angles) = (mass.rows, found.len());
        let seen = || {
            let seen = seen.iter().enumerate();
            seen.filter_map(|(body, own)| Some((self.block(angles, body), own.as_ref()?)))
        };
        for (block, own) in seen() {
            let range = block.start * rows..block.end * rows;
            if own.angle != 0.0 {
                let back = own.back();
                for matrix in [&mut mass, &mut damping, &mut stiffness] {
                    let turned = multiply(matrix.columns(block.clone()), back.view());
                    matrix.data[range.clone()].copy_from_slice(&turned.data);
                }
            }
            if own.rate != 0.0 {
                let [once, twice] = own.generators;
                let by_rate = multiply(damping.columns(block.clone()), once.view());
                let by_inertia = multiply(mass.columns(block.clone()), once.view());
                let square = multiply(mass.columns(block.clone()), twice.view());
                for (own_rate, turned) in
                    damping.data[range.clone()].iter_mut().zip(&by_inertia.data)
                {
                    *own_rate -= 2.0 * own.rate * turned;
                }
                let turned = by_rate.data.iter().zip(&square.data);
                for (sum, (rate, square)) in stiffness.data[range].iter_mut().zip(turned) {
                    *sum += own.rate * (own.rate * square - rate);
                }
            }
        }
        for (block, own) in seen().filter(|(_, own)| own.angle != 0.0) {
            let back = own.back();
            for matrix in [&mut mass, &mut damping, &mut stiffness] {
                let part = Matrix::from_fn(block.len(), rows, |i, j| matrix[(block.start + i, j)]);
                let turned = transpose_multiply(back.view(), part.view());
                for j in 0..rows {
                    let column = &mut matrix.col_mut(j)[block.clone()];
                    column.copy_from_slice(turned.col(j));
                }
            }
        }
        [mass.symmetric_part(), damping, stiffness]
    }
}
