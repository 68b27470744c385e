//! Where springs stand: every law in the planes of the bearings that name it.

use std::ops::Range;

use whirl_specs::Clearance;

use super::bore::{Bore, at_springs, journal_radius};
use super::law::{BoundLaw, SpringLaw};
use super::valid::Measures;
use super::{Bearing, PlacedLaw, Plane, Springs};
use crate::body::BodyNode;
use crate::error::Error;
use crate::linalg::Matrix;
use crate::shaft::Shaft;
use crate::support::Support;

impl Springs {
    /// Places the springs of all bearings.
    ///
    /// # Errors
    /// A law whose inputs no spring has, or that needs a radius which nothing gives; bore nodes through which no
    /// spline passes.
    pub(crate) fn new(
        kernels: &'static Clearance,
        laws: Vec<Box<dyn SpringLaw>>,
        bearings: &[Bearing],
        shaft: &Shaft,
        support: &Support,
    ) -> Result<Self, Error> {
        let mut placing = Placing {
            kernels,
            shaft,
            support,
            laws: Vec::new(),
            planes: Vec::new(),
            rows: Vec::new(),
            errors: Vec::new(),
        };
        for (place, law) in laws.into_iter().enumerate() {
            let name = law.name().to_owned();
            let users = bearings.iter().enumerate().filter(|(_, bearing)| bearing.law == place);
            let users: Vec<(usize, &Bearing)> = users.collect();
            match BoundLaw::new(law, kernels.contacts) {
                Ok(law) => placing.place(law, &users),
                Err(wrong) => {
                    let bearing = users.first().map(|(number, _)| *number);
                    let (what, help) = (wrong.what, wrong.help);
                    placing.errors.push(Error::Law { law: name, bearing, what, help });
                }
            }
        }
        let Placing { laws, planes, rows, errors, .. } = placing;
        Error::of_all(errors)?;
        let bore = Matrix::from_fn(rows.len(), support.size(), |i, j| rows[i][j]);
        let arms = arms(&planes, shaft.size());
        let measures = Measures::new(bearings, &laws, &planes);
        Ok(Springs {
            bearings: bearings.len(),
            reach: reach(&planes, shaft, &bore, &arms),
            bore_transposed: bore.transpose(),
            bore,
            laws,
            planes,
            shaft_size: shaft.size(),
            arms,
            measures,
        })
    }
}

/// Springs that stand so far.
struct Placing<'a> {
    kernels: &'a Clearance,
    shaft: &'a Shaft,
    support: &'a Support,
    laws: Vec<PlacedLaw>,
    planes: Vec<Plane>,
    /// Rows of T_b.
    rows: Vec<Vec<f64>>,
    errors: Vec<Error>,
}

impl Placing<'_> {
    /// Places a law in the bearings that name it.
    fn place(&mut self, law: BoundLaw, users: &[(usize, &Bearing)]) {
        let (kind, first) = (law.kind, self.planes.len());
        let needed = law.motions();
        // Rows of T_b of every motion, and the angles of all springs.
        let mut rows: Vec<Vec<Vec<f64>>> = vec![Vec::new(); kind.bore.len()];
        let mut angles = Vec::new();
        for &(number, bearing) in users {
            let radius = self.radius(&law, (number, bearing));
            let along_ring = kind.bore.iter().zip(&needed).any(|(m, own)| *own && at_springs(*m));
            let bore = Bore::new(self.kernels, (number, bearing), self.support, along_ring);
            let (radius, bore) = match (radius, bore) {
                (Ok(radius), Ok(bore)) => (radius, bore),
                (radius, bore) => {
                    self.errors.extend(radius.err());
                    self.errors.extend(bore.err().into_iter().flatten());
                    continue;
                }
            };
            let count = if kind.each_spring { bearing.angles.len() } else { 1 };
            for &station in &bearing.stations {
                for ((motion, needed), rows) in kind.bore.iter().zip(&needed).zip(&mut rows) {
                    if *needed {
                        // A motion of the whole ring is that of each of its springs.
                        let own = bore.rows(station, *motion);
                        rows.extend(own.into_iter().cycle().take(count));
                    }
                }
                let start = angles.len();
                angles.extend(bearing.angles.iter().copied().chain([0.0]).take(count));
                self.planes.push(Plane {
                    law: self.laws.len(),
                    bearing: number,
                    springs: start..angles.len(),
                    eccentricity: eccentricity(self.kernels, bearing, station, self.shaft),
                    clearance: bearing.clearance,
                    radius: radius.unwrap_or(0.0),
                    arm: radius.filter(|radius| *radius > 0.0).unwrap_or(1.0),
                });
            }
        }
        let mut table = vec![0.0; kind.table * angles.len()];
        (kind.prepare)(&angles, &mut table);
        let motions = rows.into_iter().zip(&needed).map(|(rows, needed)| {
            let first = self.rows.len();
            self.rows.extend(rows);
            needed.then_some(first)
        });
        let (planes, springs) = (first..self.planes.len(), angles.len());
        let motions = motions.collect();
        self.laws.push(PlacedLaw { bound: law, planes, springs, table, motions });
    }

    /// The journal's radius, where it is known.
    fn radius(
        &self,
        law: &BoundLaw,
        (place, bearing): (usize, &Bearing),
    ) -> Result<Option<f64>, Error> {
        let radius = bearing.journal_radius.or_else(|| journal_radius(bearing, self.support));
        match (radius, law.needs_radius()) {
            (None, Some(name)) => Err(Error::Law {
                law: law.law.name().to_owned(),
                bearing: Some(place),
                what: format!(
                    "needs the journal's radius for {name}, but {} gives none and has no bore to take it from",
                    bearing.name
                ),
                help: "add `journal_radius = \"25 mm\"`, with the radius that the journal has"
                    .to_owned(),
            }),
            _ => Ok(radius),
        }
    }
}

/// ε(z) = Σ A_i(z) ε_i, eqs. (11) to (13), as rows over η.
fn eccentricity(
    kernels: &Clearance,
    bearing: &Bearing,
    station: f64,
    shaft: &Shaft,
) -> [Vec<(usize, f64)>; 2] {
    let weights = (kernels.axial)(station);
    [0, 1].map(|direction| {
        (0..shaft.size())
            .map(|j| {
                let parts = bearing.journal.iter().zip(weights);
                let shape = |node: &usize| shaft.nodes[*node].shapes[(direction, j)];
                (j, parts.map(|(node, weight)| weight * shape(node)).sum())
            })
            .filter(|&(_, value): &(usize, f64)| value != 0.0)
            .collect()
    })
}

/// √(ε_x² + ε_y²) by a unit of each η, one row a plane.
fn arms(planes: &[Plane], shaft_size: usize) -> Matrix {
    let rows = planes.iter().map(|plane| {
        let mut arms = vec![0.0_f64; shaft_size];
        let both = plane.eccentricity.iter().flatten();
        both.for_each(|&(j, coefficient)| arms[j] = arms[j].hypot(coefficient));
        arms
    });
    let rows: Vec<Vec<f64>> = rows.collect();
    Matrix::from_fn(rows.len(), shaft_size, |i, j| rows[i][j])
}

/// See [`Springs::reach`].
fn reach(planes: &[Plane], shaft: &Shaft, bore: &Matrix, arms: &Matrix) -> Vec<f64> {
    let count = |springs: &Range<usize>| springs.len() as f64;
    let all: f64 = planes.iter().map(|plane| count(&plane.springs)).sum();
    let arm = |node: &BodyNode| node.position[0].hypot(node.position[1]);
    let arm = shaft.nodes.iter().map(arm).fold(0.0, f64::max);
    let on_shaft = (0..shaft.size()).map(|j| {
        let squares = planes.iter().zip(arms.col(j)).map(|(p, arm)| count(&p.springs) * arm * arm);
        squares.sum::<f64>().sqrt()
    });
    let on_support =
        (0..bore.cols).map(|j| bore.col(j).iter().map(|own| own * own).sum::<f64>().sqrt());
    std::iter::once(arm * all.sqrt()).chain(on_shaft).chain(on_support).collect()
}
