//! Single forces projected on the machine's coordinates.

use super::{SpringState, Springs};
use crate::linalg::largest_and_sum;

impl SpringState {
    /// Takes the largest |force| and the sum of all of every force of every plane, for [`SpringState::projected`].
    pub(crate) fn size_forces(&mut self, springs: &Springs) {
        self.sizes.clear();
        for plane in &springs.planes {
            let forces = springs.laws[plane.law].forces_of(&self.laws[plane.law]);
            let sizes = forces.map(|(_, forces)| {
                let forces = &forces[plane.springs.clone()];
                largest_and_sum(forces.len(), |j| forces[j])
            });
            self.sizes.extend(sizes);
        }
    }

    /// Of coordinate `place` of q the largest single force projected on it, and the sum of |force| over all that act
    /// on it: forces times how far a unit of the coordinate moves where they act. Forces as they were sized last.
    pub(crate) fn projected(&self, springs: &Springs, place: usize) -> (f64, f64) {
        let (mut largest, mut sum) = (0.0, 0.0);
        let mut add = |(size, all): (f64, f64)| {
            largest = f64::max(largest, size);
            sum += all;
        };
        for (law, own) in springs.laws.iter().zip(&self.laws) {
            let bores = &springs.bores[law.bores];
            if !bores.place.contains(&place) {
                continue;
            }
            let column = bores.rows.col(place - bores.place.start);
            for (row, rows) in law.bore_rows() {
                let (coefficients, forces) = (&column[rows], &own.bore_force[row]);
                add(largest_and_sum(forces.len(), |j| coefficients[j] * forces[j]));
            }
        }
        let mut rest = self.sizes.as_slice();
        for (number, (plane, moved)) in springs.planes.iter().zip(&self.planes).enumerate() {
            let law = &springs.laws[plane.law];
            let (sizes, others) = rest.split_at(law.bound.forces.len());
            rest = others;
            let angle = plane.rows[0].iter().find(|(own, _)| *own == place);
            let turns = angle.map_or(0.0, |(_, part)| part.abs());
            let moves = springs.arms[(number, place)];
            if turns == 0.0 && moves == 0.0 {
                continue;
            }
            let distance =
                moved.distance_from(plane.apart.and_then(|own| own.theta) == Some(place));
            for ((size, all), force) in sizes.iter().zip(&law.bound.forces) {
                let kind = &law.bound.kind.forces[*force];
                let around = if kind.radius { plane.radius.abs() + distance } else { distance };
                let arm = if kind.unit == "N" { turns * around + moves } else { turns };
                add((arm * size, arm * all));
            }
        }
        (largest, sum)
    }
}
