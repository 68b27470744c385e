//! Springs between journals and bores: where they stand, how far the film is open there, what they push.

mod bore;
pub(crate) mod contact;
pub mod law;
mod spin;
mod spline;
pub(crate) mod state;
mod valid;
pub(crate) mod work;

use std::ops::Range;

use whirl_specs::{BoreMotion, Clearance};

pub(crate) use contact::Contacts;
pub(crate) use law::{Bound, BoundLaw, Input};
pub use law::{SpringLaw, Validity};
pub use spline::{periodic_spline, spline_passes};
pub use state::SpringState;
pub use valid::{Measure, Worst};

use bore::Bore;
pub(crate) use bore::axis_motion;
use valid::Measures;

use crate::error::Error;
use crate::linalg::Matrix;
use crate::shaft::Shaft;
use crate::support::Support;

/// A journal in its bore, as a case describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Bearing {
    /// Name in messages, such as `bearing 2`.
    pub name: String,
    /// Centre-line nodes at the left end, the middle and the right end, as places in `Shaft::nodes`.
    pub journal: [usize; 3],
    /// Bore nodes in the planes of the same three, as places in `Support::nodes`; all empty where the
    /// support is rigid.
    pub bore: [Vec<usize>; 3],
    /// Radial clearance c (m).
    pub clearance: f64,
    /// Radius of the journal (m), for laws that need it; without one the mean distance of the bore's nodes
    /// from the axis less c.
    pub journal_radius: Option<f64>,
    /// Planes of springs by their distance from the left end over the length L_b; 0, ½ and 1 are the three.
    pub stations: Vec<f64>,
    /// Fixed angles ψ_j of the springs of each plane (rad); of no effect on a law that acts once a plane.
    pub angles: Vec<f64>,
    /// Which of the laws given to [`Springs::new`].
    pub law: usize,
}

/// One plane of springs with a law Q(h, ḣ).
pub(crate) struct Plane {
    /// Which bearing, counted from 0.
    pub(crate) bearing: usize,
    /// Its springs among all.
    pub(crate) springs: Range<usize>,
    /// ε_x and ε_y as Σ coefficient · η.
    pub(crate) eccentricity: [Vec<(usize, f64)>; 2],
    /// Radial clearance c (m).
    pub(crate) clearance: f64,
    /// What the clearance kernels keep a spring.
    pub(crate) table: Vec<f64>,
}

/// All springs of a machine, law after law: those of laws Q(h, ḣ), and apart from them whatever takes or
/// gives more.
pub struct Springs {
    pub(crate) kernels: &'static Clearance,
    /// Number of bearings and stops.
    pub(crate) bearings: usize,
    pub(crate) contacts: Contacts,
    pub(crate) laws: Vec<(BoundLaw, Range<usize>)>,
    pub(crate) planes: Vec<Plane>,
    /// T_b: radial displacement of the bore at every spring from the support's coordinates
    /// (springs × coordinates), eq. (22).
    pub(crate) bore: Matrix,
    /// T_bᵀ: one column a spring.
    pub(crate) bore_transposed: Matrix,
    /// Number of η.
    shaft_size: usize,
    /// √Σ of the squares of how far a unit of each coordinate moves the springs: θ (at the farthest node that is
    /// known), η, the support's. A force that is missing at every spring in its own way is missing as this many in
    /// the coordinate's row.
    pub(crate) reach: Vec<f64>,
    /// How far the journal moves in a plane by a unit of η_j, in the direction in which it does (planes × η).
    arms: Matrix,
    /// Where the laws may be believed.
    pub(crate) measures: Measures,
}

impl Springs {
    /// Places the springs of all bearings.
    ///
    /// # Errors
    /// A law whose inputs no spring has; bore nodes through which no spline passes.
    pub fn new(
        kernels: &'static Clearance,
        laws: Vec<Box<dyn SpringLaw>>,
        bearings: &[Bearing],
        shaft: &Shaft,
        support: &Support,
    ) -> Result<Self, Error> {
        let mut planes = Vec::new();
        let mut bound = Vec::new();
        let mut contacts = Vec::new();
        let mut rows: Vec<Vec<f64>> = Vec::new();
        let mut errors = Vec::new();
        for (place, law) in laws.into_iter().enumerate() {
            let name = law.name().to_owned();
            let users = || bearings.iter().enumerate().filter(move |(_, b)| b.law == place);
            let law = Bound::new(law, kernels.contacts).map_err(|wrong| {
                let bearing = users().next().map(|(number, _)| number);
                Error::Law { law: name, bearing, what: wrong.what, help: wrong.help }
            });
            let law = match law {
                Err(error) => {
                    errors.push(error);
                    continue;
                }
                Ok(Bound::Normal(law)) => law,
                Ok(Bound::Contact(law)) => {
                    contacts.push((place, law));
                    continue;
                }
            };
            let first = rows.len();
            for (number, bearing) in users() {
                let bore = match Bore::new(kernels, (number, bearing), support, true) {
                    Ok(bore) => bore,
                    Err(wrong) => {
                        errors.extend(wrong);
                        continue;
                    }
                };
                for &station in &bearing.stations {
                    let start = rows.len();
                    rows.extend(bore.rows(station, BoreMotion::Radial));
                    let mut table = vec![0.0; kernels.table * bearing.angles.len()];
                    (kernels.prepare)(&bearing.angles, &mut table);
                    planes.push(Plane {
                        bearing: number,
                        springs: start..rows.len(),
                        eccentricity: eccentricity(kernels, bearing, station, shaft),
                        clearance: bearing.clearance,
                        table,
                    });
                }
            }
            bound.push((law, first..rows.len()));
        }
        let bore = Matrix::from_fn(rows.len(), support.size(), |i, j| rows[i][j]);
        let bore_transposed = bore.transpose();
        let contacts = Contacts::new(kernels, contacts, bearings, shaft, support, &mut errors);
        Error::of_all(errors)?;
        let arms = planes.iter().map(|plane: &Plane| &plane.eccentricity);
        let arms = arms_of(arms, shaft.size());
        let shaft_size = shaft.size();
        let ranges: Vec<Range<usize>> = bound.iter().map(|(_, range)| range.clone()).collect();
        let normal = bound.iter().map(|(law, _): &(BoundLaw, _)| law.law.as_ref());
        let measures = Measures::new(bearings, normal, &planes, &ranges, &contacts);
        let squares = |matrix: &Matrix, j: usize, springs: &dyn Fn(usize) -> usize| -> f64 {
            let column = matrix.col(j).iter().enumerate();
            column.map(|(row, coefficient)| springs(row) as f64 * coefficient * coefficient).sum()
        };
        let on_shaft = (0..shaft_size).map(|j| {
            let own = squares(&arms, j, &|plane| planes[plane].springs.len());
            (own + squares(&contacts.arms, j, &|plane| contacts.planes[plane].count)).sqrt()
        });
        let on_support = (0..support.size())
            .map(|j| (squares(&bore, j, &|_| 1) + squares(&contacts.bore, j, &|_| 1)).sqrt());
        let all = rows.len() + contacts.planes.iter().map(|plane| plane.count).sum::<usize>();
        let arm = |node: &crate::body::BodyNode| node.position[0].hypot(node.position[1]);
        let arm = shaft.nodes.iter().map(arm).fold(0.0, f64::max);
        let on_theta = std::iter::once(arm * (all as f64).sqrt());
        let reach = on_theta.chain(on_shaft).chain(on_support).collect();
        Ok(Springs {
            kernels,
            bearings: bearings.len(),
            contacts,
            laws: bound,
            planes,
            bore,
            bore_transposed,
            shaft_size,
            reach,
            arms,
            measures,
        })
    }

    /// Number of springs with a law Q(h, ḣ).
    pub fn len(&self) -> usize {
        self.bore.rows
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of forces tested for convergence: Q of every such spring, and whatever other laws give.
    pub(crate) fn forces(&self) -> usize {
        self.len() + self.contacts.forces()
    }

    /// Whether any law depends on the rate of the clearance.
    pub(crate) fn needs_rates(&self) -> bool {
        self.laws.iter().any(|(law, _)| law.uses(Input::ClearanceRate))
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
fn arms_of<'a>(
    planes: impl Iterator<Item = &'a [Vec<(usize, f64)>; 2]>,
    shaft_size: usize,
) -> Matrix {
    let rows: Vec<Vec<f64>> = planes
        .map(|rows| {
            let mut arms = vec![0.0_f64; shaft_size];
            rows.iter()
                .flatten()
                .for_each(|&(j, coefficient)| arms[j] = arms[j].hypot(coefficient));
            arms
        })
        .collect();
    Matrix::from_fn(rows.len(), shaft_size, |i, j| rows[i][j])
}
