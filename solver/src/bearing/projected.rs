//! Single forces projected on the machine's coordinates.

use super::{SpringState, Springs};
use crate::bodies::Owner;
use crate::linalg::largest_and_sum;

impl SpringState {
    /// Of coordinate `place` of q the largest single force projected on it, and the sum of |force| over all that act
    /// on it: forces times how far a unit of the coordinate moves where they act.
    pub(crate) fn projected(&self, springs: &Springs, owner: Owner, place: usize) -> (f64, f64) {
        let (mut largest, mut sum) = (0.0, 0.0);
        let mut add = |(size, all): (f64, f64)| {
            largest = f64::max(largest, size);
            sum += all;
        };
        for (law, own) in springs.laws.iter().zip(&self.laws) {
            let bores = &springs.bores[law.bores];
            if owner.coordinate.is_none() || !bores.place.contains(&place) {
                continue;
            }
            let column = bores.rows.col(place - bores.place.start);
            for (row, rows) in law.bore_rows() {
                let (coefficients, forces) = (&column[rows], &own.bore_force[row]);
                add(largest_and_sum(forces.len(), |j| coefficients[j] * forces[j]));
            }
        }
        for (number, (plane, moved)) in springs.planes.iter().zip(&self.planes).enumerate() {
            let angle = plane.rows[0].iter().find(|(own, _)| *own == place);
            let turns = angle.map_or(0.0, |(_, part)| part.abs());
            let moves = springs.arms[(number, place)];
            if turns == 0.0 && moves == 0.0 {
                continue;
            }
            let law = &springs.laws[plane.law];
            let distance =
                moved.distance_from(plane.apart.and_then(|own| own.theta) == Some(place));
            let own = law.forces_of(&self.laws[plane.law]).zip(&law.bound.forces);
            for ((is_moment, forces), force) in own {
                let at_surface = law.bound.kind.forces[*force].radius;
                let around = match at_surface {
                    true => plane.radius + distance,
                    false => distance,
                };
                let arm = if is_moment { turns } else { turns * around + moves };
                let forces = &forces[plane.springs.clone()];
                add(largest_and_sum(forces.len(), |j| arm * forces[j]));
            }
        }
        (largest, sum)
    }
}
