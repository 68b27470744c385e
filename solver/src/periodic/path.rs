//! Points of a branch in the coordinates in which it is followed, and how one is found.

use num_complex::Complex64;

use super::family::Family;
use super::multipliers::{Multiplier, Stability, paired, stability};
use super::options::PeriodicOptions;
use super::solve::{Observe, solve};
use crate::error::{Error, PeriodicError};
use crate::history::History;
use crate::linalg::{Lu, Matrix, dot, eigenvalues};

/// Corrections of a point at most, and what is a point.
const CORRECTIONS: usize = 10;
const FOUND: f64 = 1e-9;

/// The smallest part of a correction that is tried.
const LEAST_SHARE: f64 = 0.05;

/// A correction of u, as far as it is taken, and the residual before it.
struct Correction {
    from: Vec<f64>,
    way: Vec<f64>,
    missed: f64,
    share: f64,
}

impl Correction {
    fn reached(&self) -> Vec<f64> {
        self.from.iter().zip(&self.way).map(|(from, way)| from - self.share * way).collect()
    }
}

/// A point of a branch.
#[derive(Debug, Clone)]
pub struct BranchPoint {
    /// The parameter.
    pub value: f64,
    /// x at the start of the cycle.
    pub state: Vec<f64>,
    /// Period (s).
    pub period: f64,
    /// All multipliers, the largest first.
    pub multipliers: Vec<Complex64>,
    /// What they say.
    pub stability: Stability,
    /// The rows of its cycle.
    pub history: History,
    /// Corrections that it took.
    pub corrections: usize,
    /// Whether the branch turns sharply there: no fold, but a contact that begins or ends all around.
    pub corner: bool,
}

/// What is known at a point.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub(super) y: Vec<f64>,
    pub(super) value: f64,
    pub(super) monodromy: Matrix,
    /// Along the branch there, of length 1, in u; not against the way in which it was looked for.
    pub(super) tangent: Vec<f64>,
    pub(super) corrections: usize,
}

/// The sizes of u, and the machines.
pub(super) struct Path<'f> {
    pub(super) family: Family<'f>,
    /// Y and Λ.
    pub(super) size: f64,
    pub(super) range: f64,
}

impl Node {
    /// λ/Λ along the branch, over its length.
    pub(super) fn along(&self) -> f64 {
        self.tangent[self.tangent.len() - 1]
    }
}

impl Path<'_> {
    pub(super) fn u(&self, y: &[f64], value: f64) -> Vec<f64> {
        y.iter().map(|own| own / self.size).chain([value / self.range]).collect()
    }

    /// y and the parameter of u.
    pub(super) fn split(&self, u: &[f64]) -> (Vec<f64>, f64) {
        let (last, rest) = u.split_last().expect("the parameter");
        (rest.iter().map(|own| own * self.size).collect(), last * self.range)
    }

    /// The point in the plane through `from` normal to `normal`; none where Newton's method does not come to it. A correction
    /// that makes the residual larger is halved: between the two sides of a contact whole ones go to and fro for ever.
    ///
    /// # Errors
    /// A machine that cannot be made.
    pub(super) fn correct(&mut self, from: &[f64], normal: &[f64]) -> Result<Option<Node>, Error> {
        let mut u = from.to_vec();
        let n = u.len() - 1;
        let (mut corrections, mut halvings) = (0, 0);
        let mut before: Option<Correction> = None;
        while corrections < CORRECTIONS {
            let (y, value) = self.split(&u);
            let found = match self.family.evaluate(value, &y) {
                Ok(found) => found,
                // Beyond what the march gets through.
                Err(error) if is_of_motion(&error) => return Ok(None),
                Err(error) => return Err(error),
            };
            let bordered = Matrix::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
                (true, true) => found.monodromy[(i, j)] - f64::from(u8::from(i == j)),
                (true, false) => found.slope[i] * self.range / self.size,
                (false, _) => normal[j],
            });
            let mut lu = Lu::new(n + 1);
            if lu.factor(&bordered.data).is_err() {
                return Ok(None);
            }
            let mut way: Vec<f64> = found.residual.iter().map(|own| own / self.size).collect();
            let missed = norm(&way);
            way.push(u.iter().zip(from).zip(normal).map(|((u, from), n)| (u - from) * n).sum());
            lu.solve_in_place(&mut way);
            let length = norm(&way);
            if !length.is_finite() {
                return Ok(None);
            }
            // The correction after one of this size is below rounding, as convergence is quadratic; kinks want another one.
            if length < FOUND {
                u.iter_mut().zip(&way).for_each(|(u, own)| *u -= own);
                let mut tangent = vec![0.0; n + 1];
                tangent[n] = 1.0;
                lu.solve_in_place(&mut tangent);
                let length = norm(&tangent);
                tangent.iter_mut().for_each(|own| *own /= length);
                let (y, value) = self.split(&u);
                let monodromy = found.monodromy;
                let corrections = corrections + halvings + 1;
                return Ok(Some(Node { y, value, monodromy, tangent, corrections }));
            }
            let last = match before.take() {
                Some(mut last) if missed > last.missed && last.share > LEAST_SHARE => {
                    last.share *= 0.5;
                    halvings += 1;
                    u = last.reached();
                    before = Some(last);
                    continue;
                }
                last => last.map_or(1e-6, |own| norm(&own.way).max(1e-6)),
            };
            if length > 4.0 * last && corrections > 0 {
                return Ok(None);
            }
            corrections += 1;
            let correction = Correction { from: u, way, missed, share: 1.0 };
            u = correction.reached();
            before = Some(correction);
        }
        Ok(None)
    }

    /// The point at a value to which the parameter goes up or down, looked for from the state of another one; none where Newton's
    /// method does not come to it.
    ///
    /// # Errors
    /// As [`Path::correct`].
    pub(super) fn at_value(
        &mut self,
        from: &[f64],
        (value, direction): (f64, f64),
    ) -> Result<Option<Node>, Error> {
        let mut from = from.to_vec();
        let mut normal = vec![0.0; from.len()];
        let last = from.len() - 1;
        (from[last], normal[last]) = (value / self.range, direction.signum());
        Ok(self.correct(&from, &normal)?.map(|node| Node { value, ..node }))
    }

    /// The motion near y at a value, to which the parameter goes up or down.
    pub(super) fn fixed(
        &mut self,
        (value, direction): (f64, f64),
        y: &[f64],
        options: &PeriodicOptions,
        observe: Observe,
    ) -> Result<Node, Error> {
        let y = self.family.with(value, |map| Ok(solve(map, y.to_vec(), options, observe)?.y))?;
        if let Some(node) = self.at_value(&self.u(&y, value), (value, direction))? {
            return Ok(node);
        }
        // Where Newton's method sees no more than rounding of it.
        let monodromy = self.family.with(value, |map| map.monodromy(&y))?.1;
        let mut tangent = vec![0.0; y.len() + 1];
        tangent[y.len()] = direction.signum();
        Ok(Node { y, value, monodromy, tangent, corrections: 0 })
    }

    pub(super) fn point(&mut self, node: &Node, corner: bool) -> Result<BranchPoint, Error> {
        let multipliers = values(&node.monodromy)?;
        let (state, history, period) = self.family.with(node.value, |map| {
            let state = map.state(&node.y);
            let history = map.map.orbit(&state)?.history;
            Ok((state, history, map.map.cycle().period))
        })?;
        let all: Vec<Multiplier> = paired((&multipliers, &vec![false; multipliers.len()]), &[]);
        Ok(BranchPoint {
            value: node.value,
            state,
            period,
            stability: stability(&all),
            multipliers,
            history,
            corrections: node.corrections,
            corner,
        })
    }
}

/// Whether it says that a motion is not there, and not that a machine is wrong.
pub(super) fn is_of_motion(error: &Error) -> bool {
    matches!(
        error,
        Error::NewtonDiverged { .. }
            | Error::NoForce { .. }
            | Error::Periodic(PeriodicError::NotFound { .. } | PeriodicError::NoMachine { .. })
    )
}

/// The plain norm.
pub(super) fn norm(u: &[f64]) -> f64 {
    dot(u, u).sqrt()
}

/// All multipliers, the largest first.
pub(super) fn values(monodromy: &Matrix) -> Result<Vec<Complex64>, Error> {
    let mut all: Vec<Complex64> =
        eigenvalues(monodromy)?.into_iter().map(|[re, im]| Complex64::new(re, im)).collect();
    all.sort_by(|a, b| b.norm().total_cmp(&a.norm()).then(b.im.total_cmp(&a.im)));
    Ok(all)
}
