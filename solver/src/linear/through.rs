//! Stiffness and damping of bearings with bodies of their own, pads on pivots or floating rings, as the shaft feels them: those
//! bodies move as the shaft moves them.
//!
//! With Z = K + iωC of the joints between a section of a shaft and such bodies, P their displacement by a unit of the coordinates of
//! those bodies, and D = K′ + iωC′ − ω²M′ over these, other shafts held: Z_b = Σ Z − Σ Z P D⁻¹ Σ Pᵀ Z. K_b is Re Z_b, C_b is Im Z_b/ω.

use num_complex::Complex64;

use super::linearised::{Linearised, Standstill};
use super::round::LinearMachine;
use crate::error::Error;
use crate::linalg::ComplexLu;

/// Share of the largest entry by which rows of one section may differ.
const SAME: f64 = 1e-9;

/// What a bearing with bodies of its own does against small motions of a shaft.
#[derive(Debug, Clone, PartialEq)]
pub struct Through {
    /// The shaft.
    pub shaft: String,
    /// What the columns of its joints are called by.
    pub joints: Vec<String>,
    /// The bodies that move with it.
    pub bodies: Vec<String>,
    /// K (N/m) and C (N·s/m) at the frequency, row the force along x or y of space, column the motion.
    pub stiffness: [[f64; 2]; 2],
    /// Likewise.
    pub damping: [[f64; 2]; 2],
}

/// A joint between a shaft and a body that moves with it.
struct Side {
    joint: usize,
    other: usize,
    /// 1 where the shaft is the journal, −1 where it is the bore.
    sign: f64,
    /// Displacement along x and y by a unit of the coordinates of the shaft, and of all.
    of_shaft: [Vec<f64>; 2],
    rows: [Vec<f64>; 2],
    /// Its Z.
    dynamic: [[Complex64; 2]; 2],
}

impl Side {
    /// Whether its other body is one of a group.
    fn of(&self, group: &[usize]) -> bool {
        group.contains(&self.other)
    }
}

impl LinearMachine {
    /// Those of all sections of the shafts among the bodies, at a frequency (rad/s, above zero); none of machines whose
    /// laws have states, or that vary with an angle. Only displacements across the axis pass from the shaft to the bodies.
    ///
    /// # Errors
    /// Bodies that nothing holds.
    pub fn through(
        &self,
        (at, equations): (&Standstill, &Linearised),
        shafts: &[usize],
        frequency: f64,
    ) -> Result<Vec<Through>, Error> {
        if equations.remembered.is_some() || !equations.stands_in_space() {
            return Ok(Vec::new());
        }
        let held = equations.at_frequency(frequency);
        let mut found = Vec::new();
        let groups = self.groups(at, shafts);
        for &shaft in shafts {
            for station in stations(self.sides(at, shaft, &groups, frequency)?) {
                let of_group = |group: &Vec<usize>| station.iter().any(|own| own.of(group));
                let bodies: Vec<usize> =
                    groups.iter().filter(|own| of_group(own)).flatten().copied().collect();
                let coordinates = self.coordinates(at, &bodies);
                let name = |body: usize| self.machine.bodies[body].name().to_owned();
                let label = |own: &Side| {
                    self.machine.monitors[own.joint].label.trim_start_matches('_').to_owned()
                };
                let [stiffness, damping] = condensed(&held, &coordinates, &station, frequency)?;
                found.push(Through {
                    shaft: name(shaft),
                    joints: station.iter().map(label).collect(),
                    bodies: bodies.into_iter().map(name).collect(),
                    stiffness,
                    damping,
                });
            }
        }
        Ok(found)
    }

    /// Bodies that move and are no shafts, those that joints tie to each other together.
    fn groups(&self, at: &Standstill, shafts: &[usize]) -> Vec<Vec<usize>> {
        let angles = at.angles.len();
        let moves = |body: &usize| !self.block(angles, *body).is_empty() && !shafts.contains(body);
        let mut groups: Vec<Vec<usize>> =
            (0..self.machine.bodies.len()).filter(moves).map(|own| vec![own]).collect();
        for joint in &self.machine.monitors {
            let of = |body: usize| groups.iter().position(|own| own.contains(&body));
            let [Some(a), Some(b)] = joint.bodies.map(of) else { continue };
            if a != b {
                let other = groups.remove(a.max(b));
                groups[a.min(b)].extend(other);
            }
        }
        groups
    }

    /// Places among the coordinates of small motions of bodies, with the angles by which they turn.
    fn coordinates(&self, at: &Standstill, group: &[usize]) -> Vec<usize> {
        let turns = |angle: &usize| {
            let theta = Some(at.angles[*angle]);
            group.iter().any(|body| self.machine.places()[*body].rotation == theta)
        };
        let angles = (0..at.angles.len()).filter(turns);
        angles.chain(group.iter().flat_map(|body| self.block(at.angles.len(), *body))).collect()
    }

    /// The joints between a shaft and bodies that move with it.
    fn sides(
        &self,
        at: &Standstill,
        shaft: usize,
        groups: &[Vec<usize>],
        frequency: f64,
    ) -> Result<Vec<Side>, Error> {
        let block = self.block(at.angles.len(), shaft);
        let all = self.coefficients_at(at, frequency)?;
        let moves = |body: usize| groups.iter().any(|own| own.contains(&body));
        let sides = all.iter().enumerate().filter_map(|(joint, own)| {
            let [a, b] = self.machine.monitors[joint].bodies;
            let (other, sign) = match (a == shaft && moves(b), b == shaft && moves(a)) {
                (true, _) => (b, 1.0),
                (_, true) => (a, -1.0),
                _ => return None,
            };
            let rows = self.rows(at, &self.journal(joint));
            let z = |i: usize, j: usize| {
                Complex64::new(own.stiffness[i][j], frequency * own.damping[i][j])
            };
            Some(Side {
                joint,
                other,
                sign,
                of_shaft: rows.each_ref().map(|row| row[block.clone()].to_vec()),
                rows,
                dynamic: [0, 1].map(|i| [0, 1].map(|j| z(i, j))),
            })
        });
        Ok(sides.collect())
    }
}

/// Joints by the section of the shaft at which they are.
fn stations(sides: Vec<Side>) -> Vec<Vec<Side>> {
    let mut stations: Vec<Vec<Side>> = Vec::new();
    for side in sides {
        let at = |own: &Vec<Side>| alike(&own[0].of_shaft, &side.of_shaft);
        match stations.iter().position(at) {
            Some(place) => stations[place].push(side),
            None => stations.push(vec![side]),
        }
    }
    stations
}

/// Whether rows are the same, or the one the other seen from the other side.
fn alike(a: &[Vec<f64>; 2], b: &[Vec<f64>; 2]) -> bool {
    let all = || a.iter().flatten().zip(b.iter().flatten());
    let most = all().fold(0.0, |most: f64, (a, b)| most.max(a.abs()).max(b.abs()));
    [1.0, -1.0].iter().any(|sign| all().all(|(a, b)| (a - sign * b).abs() <= SAME * most))
}

/// K and C of a station, the other bodies moving as they do at a frequency (rad/s).
fn condensed(
    held: &Linearised,
    coordinates: &[usize],
    station: &[Side],
    frequency: f64,
) -> Result<[[[f64; 2]; 2]; 2], Error> {
    let size = coordinates.len();
    let Linearised { mass, damping, stiffness, .. } = held;
    let entry = |i: usize, j: usize| {
        let (i, j) = (coordinates[i], coordinates[j]);
        let square = frequency * frequency;
        Complex64::new(stiffness[(i, j)] - square * mass[(i, j)], frequency * damping[(i, j)])
    };
    let matrix: Vec<Complex64> =
        (0..size).flat_map(|j| (0..size).map(move |i| (i, j))).map(|(i, j)| entry(i, j)).collect();
    let factors = ComplexLu::new(size, &matrix)?;
    let mut sums = [[Complex64::ZERO; 2]; 2];
    for j in 0..2 {
        // Forces on the other bodies where the shaft alone moves by one along this axis, and how they move.
        let mut moved = vec![Complex64::ZERO; size];
        for side in station {
            for (i, row) in side.rows.iter().enumerate() {
                let force = side.sign * side.dynamic[i][j];
                let places = moved.iter_mut().zip(coordinates);
                places.for_each(|(sum, place)| *sum -= force * row[*place]);
            }
        }
        factors.solve_in_place(&mut moved);
        for side in station {
            let across = side.rows.each_ref().map(|row| {
                let both = coordinates.iter().zip(&moved);
                both.map(|(place, own)| own * row[*place]).sum::<Complex64>()
            });
            for (i, row) in sums.iter_mut().enumerate() {
                let z = &side.dynamic[i];
                row[j] += z[j] + side.sign * (z[0] * across[0] + z[1] * across[1]);
            }
        }
    }
    let part = |of: &dyn Fn(Complex64) -> f64| sums.map(|row| row.map(of));
    Ok([part(&|own| own.re), part(&|own| own.im / frequency)])
}
