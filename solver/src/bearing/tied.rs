//! Rotations that laws of the angle tie to each other: of torsional couplings and of gears.

use super::springs::Springs;
use super::state::SpringState;

/// Places in q of rotations that a plane ties elastically, each with a speed that goes with those of the others.
pub(crate) type Tied = Vec<(usize, f64)>;

impl Springs {
    /// The rotations between which the law of a plane acts by their angles.
    pub(crate) fn tied(&self, plane: usize, rotations: usize) -> Tied {
        let plane = &self.planes[plane];
        match &plane.flank {
            Some(own) => vec![(own.rotations[0], 1.0), (own.rotations[1], own.flank.speed_ratio())],
            None => {
                let places = plane.rows[0].iter().map(|(place, _)| *place);
                places.filter(|&place| place < rotations).map(|place| (place, 1.0)).collect()
            }
        }
    }

    /// Speed of the body on the second side of a plane over that on the first where teeth mesh, even if they do not touch.
    pub(crate) fn gear_ratio(&self, plane: usize) -> Option<f64> {
        self.planes[plane].flank.map(|own| own.flank.speed_ratio())
    }

    /// Base radii of the gears of a plane (m), with their signs.
    pub(crate) fn base_radii(&self, plane: usize) -> Option<[f64; 2]> {
        self.planes[plane].flank.map(|own| own.flank.radii)
    }
}

impl SpringState {
    /// Adds the generalised forces on q of laws that do not tie rotations to each other.
    pub(crate) fn add_forces_but_ties(&self, springs: &Springs, rotations: usize, out: &mut [f64]) {
        for (place, plane) in springs.planes.iter().enumerate() {
            if springs.may_twist(place) && springs.tied(place, rotations).len() > 1 {
                continue;
            }
            for (row, force) in self.rows(place).iter().zip(self.plane_force(place)) {
                row.iter().for_each(|&(j, part)| out[j] += part * force);
            }
            let (law, own) = (&springs.laws[plane.law], &self.laws[plane.law]);
            let bores = &springs.bores[law.bores];
            for (motion, first) in law.motions.iter().enumerate() {
                let Some(first) = *first else { continue };
                for j in plane.springs.clone() {
                    let force = own.bore_force[motion * law.springs + j];
                    let column = bores.transposed.col(first + j);
                    let own = out[bores.place.clone()].iter_mut().zip(column);
                    own.for_each(|(sum, part)| *sum += part * force);
                }
            }
        }
    }
}
