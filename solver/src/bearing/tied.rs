//! Rotations that laws of the angle tie to each other: of torsional couplings and of gears.

use super::springs::Springs;

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
