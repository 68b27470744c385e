//! Single forces projected on the machine's coordinates.

use super::{SpringState, Springs};
use crate::linalg::largest_and_sum;

impl SpringState {
    /// Of coordinate `place` of q (θ is 0, η_j is 1 + j) the largest single force projected on it, and the sum
    /// of |force| over all that act on it: forces times how far a unit of the coordinate moves where they act.
    pub(crate) fn projected(&self, springs: &Springs, place: usize) -> (f64, f64) {
        let (mut largest, mut sum) = (0.0, 0.0);
        let mut add = |(size, all): (f64, f64)| {
            largest = f64::max(largest, size);
            sum += all;
        };
        let first = 1 + springs.shaft_size;
        if let Some(coordinate) = place.checked_sub(first) {
            let column = springs.bore.col(coordinate);
            for (law, own) in springs.laws.iter().zip(&self.laws) {
                for (row, rows) in law.bore_rows() {
                    let (coefficients, forces) = (&column[rows], &own.bore_force[row]);
                    add(largest_and_sum(forces.len(), |j| coefficients[j] * forces[j]));
                }
            }
            return (largest, sum);
        }
        for (number, (plane, moved)) in springs.planes.iter().zip(&self.planes).enumerate() {
            let law = &springs.laws[plane.law];
            let [_, x, y] = moved.ring.position;
            let own = law.forces_of(&self.laws[plane.law]).zip(&law.bound.forces);
            for ((is_moment, forces), force) in own {
                let at_surface = law.bound.kind.forces[*force].radius;
                let arm = match place.checked_sub(1) {
                    None if is_moment => 1.0,
                    None if at_surface => plane.radius + x.hypot(y),
                    None => x.hypot(y),
                    Some(_) if is_moment => 0.0,
                    Some(j) => springs.arms[(number, j)],
                };
                let forces = &forces[plane.springs.clone()];
                add(largest_and_sum(forces.len(), |j| arm * forces[j]));
            }
        }
        (largest, sum)
    }
}
