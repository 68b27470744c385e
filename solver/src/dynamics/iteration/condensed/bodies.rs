//! L⁻¹ of the bodies of a machine, each by itself.

use std::ops::Range;

use crate::linalg::{Lu, Matrix, add_product};
use crate::machine::{Body, Machine};

/// L⁻¹ of a body.
pub(super) struct BodyInverse {
    /// Its rotation among the unknowns, if it is one, and its other coordinates.
    rotation: Option<usize>,
    flexible: Range<usize>,
    kind: Inverse,
}

enum Inverse {
    Diagonal(Vec<f64>),
    /// Rotation first; memory for it, and values of the body before and after.
    Block {
        lu: Lu,
        inverse: Matrix,
        given: Vec<f64>,
        solved: Vec<f64>,
    },
}

impl BodyInverse {
    /// Those of all bodies.
    pub(super) fn all(machine: &Machine) -> Vec<Self> {
        let first = machine.first_unknown();
        let bodies = machine.bodies.iter().zip(machine.places()).map(|(body, place)| {
            let flexible = place.flexible.start - first..place.flexible.end - first;
            let rotation = place.rotation.filter(|&theta| theta >= first).map(|own| own - first);
            let size = flexible.len() + usize::from(rotation.is_some());
            let kind = match body {
                Body::Standing { .. } => Inverse::Diagonal(vec![0.0; size]),
                Body::Turning { .. } => Inverse::Block {
                    lu: Lu::new(size),
                    inverse: Matrix::identity(size),
                    given: vec![0.0; size],
                    solved: vec![0.0; size],
                },
            };
            BodyInverse { rotation, flexible, kind }
        });
        bodies.collect()
    }

    /// Takes L⁻¹ of L of `size` rows over all coordinates, column after column, of which those from `first` on are unknown; whether
    /// there is one.
    pub(super) fn take(&mut self, whole: &[f64], size: usize, first: usize) -> bool {
        let places = self.places();
        match &mut self.kind {
            Inverse::Diagonal(inverse) => {
                let diagonal = places.map(|place| whole[(first + place) * (size + 1)]);
                inverse.iter_mut().zip(diagonal).for_each(|(own, l)| *own = 1.0 / l);
                inverse.iter().all(|own| own.is_finite())
            }
            Inverse::Block { lu, inverse, .. } => {
                let rows = inverse.rows;
                let entries = lu.values_mut().chunks_exact_mut(rows.max(1));
                for (column, values) in places.clone().zip(entries) {
                    let column = &whole[(first + column) * size..][..size];
                    let own = places.clone().map(|row| column[first + row]);
                    values.iter_mut().zip(own).for_each(|(own, value)| *own = value);
                }
                let done = lu.factor_in_place().is_ok();
                inverse.data.fill(0.0);
                inverse.data.iter_mut().step_by(rows + 1).for_each(|own| *own = 1.0);
                lu.solve_in_place(&mut inverse.data);
                done
            }
        }
    }

    pub(super) fn turns(&self) -> bool {
        matches!(self.kind, Inverse::Block { .. })
    }

    /// Its coordinates among the unknowns.
    pub(super) fn places(&self) -> impl Iterator<Item = usize> + Clone + use<> {
        self.rotation.into_iter().chain(self.flexible.clone())
    }

    /// Replaces the forces on its coordinates, among those on all unknowns, by L⁻¹ times them.
    pub(super) fn solve(&mut self, x: &mut [f64]) {
        match &mut self.kind {
            Inverse::Diagonal(inverse) => {
                let own = x[self.flexible.clone()].iter_mut().zip(inverse.iter());
                own.for_each(|(x, inverse)| *x *= inverse);
            }
            Inverse::Block { inverse, given, solved, .. } => {
                let (theta, rest) = given.split_at_mut(usize::from(self.rotation.is_some()));
                theta.iter_mut().zip(self.rotation).for_each(|(own, place)| *own = x[place]);
                rest.copy_from_slice(&x[self.flexible.clone()]);
                solved.fill(0.0);
                add_product(solved, inverse, given);
                let (theta, rest) = solved.split_at(usize::from(self.rotation.is_some()));
                theta.iter().zip(self.rotation).for_each(|(own, place)| x[place] = *own);
                x[self.flexible.clone()].copy_from_slice(rest);
            }
        }
    }
}
