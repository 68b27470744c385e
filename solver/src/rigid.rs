//! Rigid bodies, given by numbers or taken from a mesh: displacements of the centre along x and y, two tilts where it may
//! tilt, the displacement along z where it may move so, and a small turn about z of a body that does not turn but rocks.
//!
//! A body that turns has its coordinates in the frame that turns with it. A point at (ξ, η, ζ) from the centre moves by
//! (u + βζ, v − αζ, αη − βξ) with tilts α about x and β about y, and by (αβη − β²ξ, αβξ − α²η)/2 of second order towards
//! the axis, so that with S = ∫ρ (ξ, η, ζ)(ξ, η, ζ)ᵀ dV and the centre at (a, b) from the axis J gets S_zz − S_yy of α² and
//! S_zz − S_xx of β², 2 S_xy of αβ, and y0 and g0 get m a, m b, S_xz and S_yz.

use crate::assembly::mass_properties;
use crate::body::BodyNode;
use crate::centre_of_mass::CentreOfMass;
use crate::error::Error;
use crate::linalg::Matrix;
use crate::measure::MeanMotion;
use crate::mesh::Mesh;
use crate::shaft::Shaft;
use crate::support::Support;

/// A rigid body by numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidBody {
    /// m (kg), > 0.
    pub mass: f64,
    /// I_p (kg·m²) about the axis; of no effect on a body that neither turns nor rocks.
    pub polar_inertia: f64,
    /// I_d (kg·m²) about x and y through the centre; a body without does not tilt.
    pub transverse_inertia: Option<f64>,
    /// Whether it may move along z.
    pub along: bool,
    /// Whether it may turn a little about z, as pads do; of no effect on a body that turns.
    pub rocks: bool,
    /// Its centre (m), among the nodes of the body.
    pub centre: [f64; 3],
    /// To the ground along x and y (N/m); of a body that turns, along those of its frame.
    pub stiffness: [f64; 2],
    /// To the ground along x and y (N·s/m); likewise.
    pub damping: [f64; 2],
}

impl RigidBody {
    /// As a body that turns, with nodes at `positions` (m, from its axis).
    ///
    /// Its one measure is its motion as a whole.
    pub fn turning(&self, positions: &[[f64; 3]]) -> Shaft {
        let mut shaft = self.inertia().turning(positions);
        for axis in 0..2 {
            shaft.stiffness[(axis, axis)] = self.stiffness[axis];
            shaft.damping[(axis, axis)] = self.damping[axis];
        }
        shaft
    }

    /// As a body that does not turn, with nodes at `positions` (m).
    ///
    /// Its one measure is its motion as a whole.
    pub fn standing(&self, positions: &[[f64; 3]]) -> Support {
        self.inertia().standing(positions, self.stiffness, self.damping)
    }

    fn inertia(&self) -> RigidInertia {
        let half = 0.5 * self.polar_inertia;
        let along = self.transverse_inertia.map_or(0.0, |own| own - half);
        RigidInertia {
            mass: self.mass,
            centre: self.centre,
            second: [[half, 0.0, 0.0], [0.0, half, 0.0], [0.0, 0.0, along]],
            tilts: self.transverse_inertia.is_some(),
            along: self.along,
            rocks: self.rocks,
        }
    }
}

/// Mass, centre and second moments of a rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidInertia {
    /// m (kg).
    pub mass: f64,
    /// Its centre (m).
    pub centre: [f64; 3],
    /// S (kg·m²), about the centre.
    pub second: [[f64; 3]; 3],
    /// Whether the body may tilt.
    pub tilts: bool,
    /// Whether it may move along z.
    pub along: bool,
    /// Whether it may turn a little about z, if it does not turn.
    pub rocks: bool,
}

/// Motions of the centre along x and y, tilts about x and y, motion along z, turn about z: those that a body has are its
/// coordinates.
const MOTIONS: usize = 6;

/// A number for each of the motions by each.
type Entries = [[f64; MOTIONS]; MOTIONS];

impl RigidInertia {
    /// Of a mesh that tilts and, if it is `along`, moves along z, but does not deform.
    ///
    /// # Errors
    /// As [`mass_properties`].
    pub fn of(mesh: &Mesh, along: bool) -> Result<RigidInertia, Error> {
        let own = mass_properties(mesh)?;
        let second = [0, 1, 2].map(|i| {
            [0, 1, 2].map(|j| own.second_moment[i][j] - own.mass * own.centre[i] * own.centre[j])
        });
        let (mass, centre) = (own.mass, own.centre);
        Ok(RigidInertia { mass, centre, second, tilts: true, along, rocks: false })
    }

    /// As a body that turns, with nodes at `positions` (m, from its axis).
    pub fn turning(&self, positions: &[[f64; 3]]) -> Shaft {
        if self.rocks {
            return RigidInertia { rocks: false, ..*self }.turning(positions);
        }
        let &RigidInertia { mass, centre: [a, b, _], second, .. } = self;
        let [[xx, xy, xz], [_, yy, yz], [.., zz]] = second;
        let first = |values: [f64; MOTIONS]| self.own(&values);
        let matrix = |entries: Entries| self.square(&entries);
        let pairs = |[lateral, axial]: [f64; 2], tilts: [[f64; 2]; 2]| {
            let [[p, q], [r, s]] = tilts;
            matrix([
                [lateral, 0.0, 0.0, 0.0, 0.0, 0.0],
                [0.0, lateral, 0.0, 0.0, 0.0, 0.0],
                [0.0, 0.0, p, q, 0.0, 0.0],
                [0.0, 0.0, r, s, 0.0, 0.0],
                [0.0, 0.0, 0.0, 0.0, axial, 0.0],
                [0.0; MOTIONS],
            ])
        };
        let n = self.size();
        Shaft {
            j0: xx + yy + mass * (a * a + b * b),
            y0: first([mass * a, mass * b, -yz, xz, 0.0, 0.0]),
            g0: first([-mass * b, mass * a, -xz, -yz, 0.0, 0.0]),
            mass: pairs([mass; 2], [[zz + yy, -xy], [-xy, zz + xx]]),
            stiffness: Matrix::zeros(n, n),
            damping: Matrix::zeros(n, n),
            spin_inertia: pairs([mass, 0.0], [[zz, 0.0], [0.0, zz]]),
            spin_net: pairs([mass, 0.0], [[zz - yy, xy], [xy, zz - xx]]),
            spin_coupling: matrix([
                [0.0, mass, 0.0, 0.0, 0.0, 0.0],
                [-mass, 0.0, 0.0, 0.0, 0.0, 0.0],
                [0.0, 0.0, 0.0, zz, 0.0, 0.0],
                [0.0, 0.0, -zz, 0.0, 0.0, 0.0],
                [0.0; MOTIONS],
                [0.0; MOTIONS],
            ]),
            hertz: Vec::new(),
            coordinates: self.names(),
            nodes: positions.iter().map(|&position| self.node(position, &UNIT)).collect(),
            measures: self.measures(&[self.centre], true),
            sections: Vec::new(),
            centre_of_mass: self.centre_of_mass(&UNIT),
        }
    }

    /// As a body that does not turn, with nodes at `positions` (m), and to the ground along x and y `stiffness` (N/m) and
    /// `damping` (N·s/m).
    pub fn standing(
        &self,
        positions: &[[f64; 3]],
        stiffness: [f64; 2],
        damping: [f64; 2],
    ) -> Support {
        let scales = self.to_unit_mass();
        let by_mass = |values: [f64; 2]| {
            self.own(&[values[0] / self.mass, values[1] / self.mass, 0.0, 0.0, 0.0, 0.0])
        };
        Support {
            stiffness: by_mass(stiffness),
            damping: by_mass(damping),
            hertz: Vec::new(),
            coordinates: self.names(),
            nodes: positions.iter().map(|&position| self.node(position, &scales)).collect(),
            measures: self.measures(&[self.centre], false),
            sections: Vec::new(),
            centre_of_mass: self.centre_of_mass(&scales),
        }
    }

    /// The motions of sections with these centres (m), of a body that turns or one that stands.
    pub fn measures(&self, centres: &[[f64; 3]], turns: bool) -> Vec<MeanMotion> {
        let by = if turns { UNIT } else { self.to_unit_mass() };
        let motions = self.motions();
        let rotation = Matrix::from_fn(3, motions.len(), |i, j| match i {
            0 | 1 if self.tilts => by[2 + i][motions[j]],
            2 if motions.contains(&ROCKS) => by[ROCKS][motions[j]],
            _ => 0.0,
        });
        let measure = |&centre: &[f64; 3]| MeanMotion {
            centre,
            displacement: self.node(centre, &by).shapes,
            rotation: rotation.clone(),
        };
        centres.iter().map(measure).collect()
    }

    fn centre_of_mass(&self, by: &Entries) -> CentreOfMass {
        CentreOfMass { mass: self.mass, node: self.node(self.centre, by) }
    }

    /// The motions that it has.
    fn motions(&self) -> Vec<usize> {
        let has = [true, true, self.tilts, self.tilts, self.along, self.rocks];
        (0..MOTIONS).filter(|&motion| has[motion]).collect()
    }

    fn size(&self) -> usize {
        self.motions().len()
    }

    /// Values of the motions that it has.
    fn own<T: Clone>(&self, values: &[T; MOTIONS]) -> Vec<T> {
        self.motions().into_iter().map(|motion| values[motion].clone()).collect()
    }

    /// Of the motions that it has by each other.
    fn square(&self, entries: &Entries) -> Matrix {
        let motions = self.motions();
        Matrix::from_fn(motions.len(), motions.len(), |i, j| entries[motions[i]][motions[j]])
    }

    fn names(&self) -> Vec<String> {
        self.own(
            &["centre x", "centre y", "tilt about x", "tilt about y", "centre z", "turn about z"]
                .map(str::to_owned),
        )
    }

    /// Displacements of the centre and turns by a unit of each of the coordinates in which M is the identity: row by row.
    fn to_unit_mass(self) -> Entries {
        let [[xx, xy, xz], [_, yy, yz], [.., zz]] = self.second;
        let lateral = 1.0 / self.mass.sqrt();
        // The inverse of Lᵀ, with L Lᵀ the block of the turns that it has.
        let first = (zz + yy).sqrt();
        let below = -xy / first;
        let second = (zz + xx - below * below).sqrt();
        let [left, right] = match self.tilts {
            true => [-xz / first, (-yz + below * xz / first) / second],
            false => [0.0; 2],
        };
        let last = (xx + yy - left * left - right * right).sqrt();
        let [by_last, across] = match self.rocks {
            true => [1.0 / last, (below * right - left * second) / (first * second * last)],
            false => [0.0; 2],
        };
        [
            [lateral, 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, lateral, 0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0 / first, -below / (first * second), 0.0, across],
            [0.0, 0.0, 0.0, 1.0 / second, 0.0, -right / second * by_last],
            [0.0, 0.0, 0.0, 0.0, lateral, 0.0],
            [0.0, 0.0, 0.0, 0.0, 0.0, by_last],
        ]
    }

    /// A node that moves with the body; `by`: displacements of the centre and tilts by a unit of each coordinate.
    fn node(&self, position: [f64; 3], by: &Entries) -> BodyNode {
        let [x, y, z] = [0, 1, 2].map(|axis| position[axis] - self.centre[axis]);
        let columns = [
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, -z, y],
            [z, 0.0, -x],
            [0.0, 0.0, 1.0],
            [-y, x, 0.0],
        ];
        let motions = self.motions();
        let shapes = Matrix::from_fn(3, motions.len(), |i, j| {
            motions.iter().map(|&k| columns[k][i] * by[k][motions[j]]).sum()
        });
        BodyNode { position, shapes }
    }
}

/// Place of the turn about z among the motions.
const ROCKS: usize = 5;

/// The motions as coordinates themselves.
const UNIT: Entries = [
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
];

#[cfg(test)]
mod tests;
