//! Pairs of rows over the coordinates of a body that turn as a vector does when the body is turned about its axis:
//! displacements along x and y of points on the axis, and tilts about x and y.

use crate::body::BodyNode;
use crate::centre_of_mass::CentreOfMass;
use crate::linalg::{Cholesky, Matrix, dot};
use crate::measure::MeanMotion;

/// Share of the body's radius of gyration that is on the axis still: digits of a mesh file, and rounding of a mean.
const ON_AXIS: f64 = 1e-3;
/// Share by which the inertias that a pair moves along x and y may differ where those of most do not: a mean of nodes on one
/// side of the axis only is no pair, though the body is round.
const ALIKE: f64 = 1e-3;
/// A pair of which the pairs before leave a smaller share adds nothing of its own.
const OWN: f64 = 1e-4;

/// Two rows.
pub(super) type RowPair = [Vec<f64>; 2];

/// What is known of the motion of a body beside its matrices.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known<'a> {
    /// Points; those on the axis count.
    pub(super) nodes: &'a [BodyNode],
    /// Mean motions, seen where the axis is.
    pub(super) measures: &'a [MeanMotion],
    pub(super) centre_of_mass: &'a CentreOfMass,
    /// Moment of inertia about the axis (kg·m²), where it is known.
    pub(super) polar: Option<f64>,
    /// Whether nothing holds the body sideways.
    pub(super) free: bool,
}

impl Known<'_> {
    /// All pairs that the body shows, of which none need be independent of the others.
    pub(super) fn pairs(&self) -> Vec<RowPair> {
        let pair = |matrix: &Matrix| -> RowPair {
            [0, 1].map(|axis| (0..matrix.cols).map(|j| matrix[(axis, j)]).collect())
        };
        let mut pairs = Vec::new();
        // The centre of mass moves by the mean over the body, wherever unbalance has it.
        if self.centre_of_mass.mass > 0.0 {
            pairs.push(pair(&self.centre_of_mass.node.shapes));
        }
        let near = ON_AXIS * self.size();
        let on_axis = |node: &&BodyNode| node.position[0].hypot(node.position[1]) <= near;
        pairs.extend(self.nodes.iter().filter(on_axis).map(|node| pair(&node.shapes)));
        for mean in self.measures {
            pairs.push(pair(&mean.node_at([0.0, 0.0, mean.centre[2]]).shapes));
            pairs.push(pair(&mean.rotation));
        }
        pairs
    }

    /// Radius of gyration about the axis (m), or how far the nodes are from the origin where that is not known.
    fn size(&self) -> f64 {
        let mass = self.centre_of_mass.mass;
        if let Some(polar) = self.polar.filter(|_| mass > 0.0) {
            return (polar / mass).sqrt();
        }
        let all = self.nodes.iter().flat_map(|node| node.position);
        all.fold(0.0, |most: f64, own| most.max(own.abs()))
    }
}

/// Independent pairs among all, in coordinates ξ = Lᵀη in which M is the identity.
#[derive(Debug)]
pub(super) struct Chosen {
    /// The rows of each pair, of length 1 in the mean; n × 2m.
    pub(super) rows: Matrix,
    /// An orthonormal basis of what they span; n × 2m.
    pub(super) basis: Matrix,
    /// Places of all pairs that are alike in x and y.
    pub(super) alike: Vec<usize>,
}

impl Chosen {
    /// Takes pairs as long as each adds two directions, the one that adds most first.
    pub(super) fn new(mass: &Cholesky, n: usize, pairs: &[RowPair]) -> Chosen {
        let mut candidates: Vec<Candidate> = (pairs.iter().enumerate())
            .filter_map(|(place, pair)| Candidate::new(mass, place, pair))
            .collect();
        // Of a body that is not round few pairs are alike in x and y: that is not the fault of its rows.
        let mut usual: Vec<f64> = candidates.iter().map(|own| own.unlike).collect();
        usual.sort_by(f64::total_cmp);
        let usual = usual.get(usual.len() / 2).copied().unwrap_or(0.0);
        candidates.retain(|own| own.unlike <= f64::max(ALIKE, 10.0 * usual));
        let alike = candidates.iter().map(|own| own.place).collect();
        let (mut rows, mut basis) = (Vec::new(), Vec::new());
        loop {
            let mut most: Option<(f64, usize)> = None;
            for (place, candidate) in candidates.iter().enumerate() {
                let own = candidate.left();
                if own > most.map_or(OWN, |most| most.0) {
                    most = Some((own, place));
                }
            }
            let Some((_, place)) = most else { break };
            let next = candidates.remove(place);
            let directions = next.directions(&basis);
            for candidate in &mut candidates {
                candidate.left.iter_mut().for_each(|row| remove(row, &directions));
            }
            rows.extend(next.rows);
            basis.extend(directions);
        }
        let matrix = |columns: Vec<Vec<f64>>| Matrix {
            rows: n,
            cols: columns.len(),
            data: columns.into_iter().flatten().collect(),
        };
        Chosen { rows: matrix(rows), basis: matrix(basis), alike }
    }

    /// 2m.
    pub(super) fn count(&self) -> usize {
        self.rows.cols
    }
}

struct Candidate {
    /// Which of all pairs.
    place: usize,
    rows: RowPair,
    /// What the pairs that were taken leave of them.
    left: RowPair,
    /// Share by which both rows differ.
    unlike: f64,
}

impl Candidate {
    /// None of rows that move nothing, or one direction only.
    fn new(mass: &Cholesky, place: usize, pair: &RowPair) -> Option<Candidate> {
        let mut rows = scaled(mass, pair)?;
        let [x, y] = [0, 1].map(|i| dot(&rows[i], &rows[i]));
        let unlike = (x - y).hypot(2.0 * dot(&rows[0], &rows[1])) / (x + y);
        if unlike >= 1.0 - OWN {
            return None;
        }
        let scale = (0.5 * (x + y)).sqrt();
        rows.iter_mut().flatten().for_each(|value| *value /= scale);
        Some(Candidate { place, left: rows.clone(), rows, unlike })
    }

    /// The shorter direction of what is left.
    fn left(&self) -> f64 {
        let [x, y] = &self.left;
        let (xx, yy, xy) = (dot(x, x), dot(y, y), dot(x, y));
        let apart = (0.5 * (xx - yy)).hypot(xy);
        (0.5 * (xx + yy) - apart).max(0.0).sqrt()
    }

    /// Two orthonormal directions of what is left.
    fn directions(&self, basis: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let mut own: Vec<Vec<f64>> = Vec::with_capacity(2);
        for row in &self.left {
            let mut row = row.clone();
            // Twice is enough.
            for _ in 0..2 {
                remove(&mut row, basis);
                remove(&mut row, &own);
                let norm = dot(&row, &row).sqrt();
                row.iter_mut().for_each(|value| *value /= norm);
            }
            own.push(row);
        }
        own
    }
}

/// L⁻¹ of both rows; none of rows without a value.
pub(super) fn scaled(mass: &Cholesky, pair: &RowPair) -> Option<RowPair> {
    let mut rows = pair.clone();
    rows.iter_mut().for_each(|row| mass.solve_lower_in_place(row));
    rows.iter().flatten().any(|value| *value != 0.0).then_some(rows)
}

/// Takes the parts along orthonormal directions from a row.
fn remove(row: &mut [f64], directions: &[Vec<f64>]) {
    for direction in directions {
        let part = dot(row, direction);
        row.iter_mut().zip(direction).for_each(|(own, along)| *own -= part * along);
    }
}
