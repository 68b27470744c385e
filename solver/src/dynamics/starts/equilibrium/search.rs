//! The search for the balance: Newton's method with steps that journals can follow, and ways around where it fails.

use super::balance::Balance;
use super::rotations::Turn;
use crate::error::Error;
use crate::linalg::{Lu, Matrix};

/// Iterations of one attempt.
const NEWTON: usize = 60;
const DAMPED: usize = 400;
/// Largest move of a journal in its bearing by a step, as a share of the clearance: films diverge towards the wall.
const MOVE: f64 = 0.25;
/// Shortest step along a direction.
const SHORTEST: f64 = 1e-6;
/// Largest change of an unknown speed by a step, as a share of it.
const SPEED: f64 = 0.3;
/// Multiples of the speeds from which the search begins that are tried where it fails from these.
const SPEEDS: [f64; 4] = [1.0, 0.5, 2.0, 0.25];
/// First and least step of the share of the loads.
const SHARE: f64 = 0.25;
const LEAST_SHARE: f64 = 1e-3;
/// A tangent serves again where the step after it is below this share of its own.
const KEPT: f64 = 0.1;
/// Multiples of n · eps of the stiffest row over its inertia below which a motion is held by nothing.
const FLOATS: f64 = 16.0;

/// A balance that was found.
pub(super) struct Found {
    pub(super) iterations: usize,
}

/// The unknowns where an attempt came nearest, and how near that was.
#[derive(Clone)]
pub(super) struct Nearest {
    pub(super) z: Vec<f64>,
    pub(super) worst: f64,
    /// The largest share of the loads that was balanced.
    pub(super) share: f64,
}

/// Searches from unknowns nearby, if there are any, then from the middle of the bearings.
///
/// # Errors
/// Where the search came nearest.
pub(super) fn search(
    balance: &mut Balance,
    from: Option<&[f64]>,
) -> Result<Result<Found, Nearest>, Error> {
    let found = searched(balance, from)?;
    if found.is_ok() && !balance.gone.is_empty() {
        let (z, worst) = (balance.unknowns(), balance.worst());
        return Ok(Err(Nearest { z, worst, share: 1.0 }));
    }
    Ok(found)
}

fn searched(balance: &mut Balance, from: Option<&[f64]>) -> Result<Result<Found, Nearest>, Error> {
    let mut search = Search::new(balance)?;
    let middle = balance.unknowns();
    let mut nearest = Nearest { z: middle.clone(), worst: f64::INFINITY, share: 0.0 };
    if let Some(from) = from {
        search.kept = KEPT;
        if let Some(found) = search.newton(balance, from, &mut nearest)? {
            return Ok(Ok(found));
        }
        search.kept = 0.0;
    }
    // Pads are in balance where they would tip over, too, which Newton's method does not tell from where they stand: they move
    // there first.
    let tip = balance.machine.springs.have_arcs();
    if !tip && let Some(found) = search.newton(balance, &middle, &mut nearest)? {
        return Ok(Ok(found));
    }
    if search.damped(balance, &middle, &mut nearest)? {
        let z = balance.unknowns();
        if let Some(found) = search.newton(balance, &z, &mut nearest)? {
            return Ok(Ok(found));
        }
    }
    if let Some(found) = search.by_shares(balance, &middle, &mut nearest)? {
        return Ok(Ok(found));
    }
    if balance.rotations.iter().any(|own| matches!(own, Turn::Speed(_))) {
        for multiple in SPEEDS {
            if let Some(found) = search.at_speeds(balance, &middle, multiple, &mut nearest)? {
                return Ok(Ok(found));
            }
        }
    }
    Ok(Err(nearest))
}

struct Search {
    lu: Lu,
    /// Share of a step below which the next one must be for the tangent to serve again: most of the search from nearby is
    /// tangents.
    kept: f64,
    inertias: Vec<f64>,
    iterations: usize,
}

impl Search {
    fn new(balance: &Balance) -> Result<Self, Error> {
        let inertias = balance.inertias();
        Ok(Search { lu: Lu::new(inertias.len()), kept: 0.0, inertias, iterations: 0 })
    }

    /// √Σ M_ii Δz_i².
    fn norm(&self, moved: &[f64]) -> f64 {
        moved.iter().zip(&self.inertias).map(|(x, m)| m * x * x).sum::<f64>().sqrt()
    }

    /// The part of a step that moves no journal too far.
    fn length(&self, balance: &Balance, step: &[f64]) -> f64 {
        let machine = balance.machine;
        let rotations = machine.rotations();
        let mut moved = vec![0.0; machine.size()];
        moved[rotations..].copy_from_slice(&step[..balance.flexible]);
        let before = balance.eccentricities(&vec![0.0; machine.size()]);
        let after = balance.eccentricities(&moved);
        let lengths = balance.clearances().into_iter().zip(before.iter().zip(&after)).filter_map(
            |(clearance, ([x, y], [to_x, to_y]))| {
                let moved = (to_x - x).hypot(to_y - y);
                (clearance > 0.0 && moved > 0.0).then(|| MOVE * clearance / moved)
            },
        );
        let speeds = balance.rotations.iter().zip(&step[balance.flexible..]);
        let turned = speeds.filter_map(|(own, moved)| match own {
            Turn::Speed(_) if *moved != 0.0 && !balance.held => {
                let speed = own.value(&balance.state).abs();
                (speed > 0.0).then(|| SPEED * speed / moved.abs())
            }
            _ => None,
        });
        lengths.chain(turned).fold(1.0, f64::min)
    }

    /// Finds where films carry the loads at speeds that stay, and from there those at which couples are in balance, too.
    fn at_speeds(
        &mut self,
        balance: &mut Balance,
        z: &[f64],
        multiple: f64,
        nearest: &mut Nearest,
    ) -> Result<Option<Found>, Error> {
        let mut z = z.to_vec();
        for (value, own) in z[balance.flexible..].iter_mut().zip(&balance.rotations) {
            if matches!(own, Turn::Speed(_)) {
                *value *= multiple;
            }
        }
        balance.held = true;
        let mut there = self.newton(balance, &z, nearest)?.is_some();
        if !there && self.damped(balance, &z, nearest)? {
            there = self.newton(balance, &balance.unknowns(), nearest)?.is_some();
        }
        there = there || self.by_shares(balance, &z, nearest)?.is_some();
        balance.held = false;
        if !there {
            return Ok(None);
        }
        let z = balance.unknowns();
        if let Some(found) = self.newton(balance, &z, nearest)? {
            return Ok(Some(found));
        }
        if self.damped(balance, &z, nearest)? {
            let z = balance.unknowns();
            return self.newton(balance, &z, nearest);
        }
        Ok(None)
    }

    /// Newton's method from `z`. A step is taken if the next one by the same tangent is shorter (Deuflhard's natural
    /// test, which knows no units of rows). `nearest` gets the best of all.
    fn newton(
        &mut self,
        balance: &mut Balance,
        z: &[f64],
        nearest: &mut Nearest,
    ) -> Result<Option<Found>, Error> {
        let mut z = z.to_vec();
        if balance.set(&z).is_err() {
            return Ok(None);
        }
        let mut serves = false;
        for _ in 0..NEWTON {
            let worst = balance.worst();
            if balance.share == 1.0 && !balance.held && worst < nearest.worst {
                (nearest.z, nearest.worst) = (z.clone(), worst);
            }
            if !serves && self.lu.factor(&balance.tangent().data).is_err() {
                // Of what is balanced it is asked afterwards whether anything holds it.
                let balanced = worst <= 1.0;
                return Ok(balanced.then_some(Found { iterations: self.iterations }));
            }
            let step = self.solve(&balance.force);
            let norm = self.norm(&step);
            if !norm.is_finite() {
                return Ok(None);
            }
            self.iterations += 1;
            let mut length = self.length(balance, &step);
            let taken = loop {
                let trial: Vec<f64> = z.iter().zip(&step).map(|(z, dz)| z + length * dz).collect();
                if balance.set(&trial).is_ok() {
                    let next = self.solve(&balance.force);
                    let next = self.norm(&next);
                    // Solved rows have rounding left, which need not fall.
                    let solved = worst <= 1.0 && balance.worst() <= 1.0;
                    if next <= (1.0 - 0.25 * length) * norm || solved {
                        serves = length == 1.0 && next <= self.kept * norm;
                        break Some(trial);
                    }
                }
                length *= 0.5;
                if length < SHORTEST {
                    break None;
                }
            };
            let Some(trial) = taken else {
                if serves {
                    serves = false;
                    balance.set(&z)?;
                    continue;
                }
                if worst <= 1.0 {
                    balance.set(&z)?;
                    return Ok(Some(Found { iterations: self.iterations }));
                }
                return Ok(None);
            };
            z = trial;
            // The step after the one that solves the rows squares what is left of them.
            if worst <= 1.0 && length == 1.0 {
                return Ok(Some(Found { iterations: self.iterations }));
            }
        }
        Ok(None)
    }

    /// Moves along M ż = δ⁻¹ f in implicit steps that grow, so that what nothing holds falls until something does.
    /// Whether the rows came near to balance.
    fn damped(
        &mut self,
        balance: &mut Balance,
        z: &[f64],
        nearest: &mut Nearest,
    ) -> Result<bool, Error> {
        let mut z = z.to_vec();
        balance.set(&z)?;
        let clearance = balance.clearances().into_iter().filter(|c| *c > 0.0);
        let reach = clearance.fold(f64::INFINITY, f64::min);
        let reach = if reach.is_finite() { reach } else { 1e-4 };
        let rates = balance.force.iter().zip(&self.inertias).map(|(f, m)| (f / m).abs());
        let mut damping = rates.fold(0.0, f64::max) / reach;
        let first = damping;
        for _ in 0..DAMPED {
            let mut tangent = balance.tangent();
            for (i, inertia) in self.inertias.iter().enumerate() {
                tangent[(i, i)] += damping * inertia;
            }
            self.iterations += 1;
            let step = match self.lu.factor(&tangent.data) {
                Ok(()) => self.solve(&balance.force),
                Err(_) => vec![f64::NAN; z.len()],
            };
            let moves = self.norm(&step).is_finite() && self.length(balance, &step) == 1.0;
            let trial: Vec<f64> = z.iter().zip(&step).map(|(z, dz)| z + dz).collect();
            let taken = moves && balance.set(&trial).is_ok() && balance.worst().is_finite();
            if !taken {
                balance.set(&z)?;
                damping *= 4.0;
                if damping > 1e12 * first {
                    return Ok(false);
                }
                continue;
            }
            z = trial;
            damping *= 0.5;
            let worst = balance.worst();
            if !balance.held && worst < nearest.worst {
                (nearest.z, nearest.worst) = (z.clone(), worst);
            }
            if worst <= 1.0 {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Raises the loads from nothing, each balance from the one before.
    fn by_shares(
        &mut self,
        balance: &mut Balance,
        z: &[f64],
        nearest: &mut Nearest,
    ) -> Result<Option<Found>, Error> {
        let (mut z, mut share, mut step) = (z.to_vec(), 0.0, SHARE);
        while step >= LEAST_SHARE {
            balance.share = f64::min(1.0, share + step);
            match self.newton(balance, &z, nearest)? {
                Some(found) if balance.share == 1.0 => return Ok(Some(found)),
                Some(_) => {
                    share = balance.share;
                    if !balance.held {
                        nearest.share = share;
                    }
                    z = balance.unknowns();
                    step *= 1.5;
                }
                None => step *= 0.5,
            }
        }
        balance.share = 1.0;
        if share > 0.0 && nearest.share == share {
            // What full loads leave where the last share was balanced.
            nearest.z = z;
        }
        Ok(None)
    }

    fn solve(&mut self, force: &[f64]) -> Vec<f64> {
        let mut step = force.to_vec();
        self.lu.solve_in_place(&mut step);
        step
    }
}

/// The motion that nothing holds at a balance, if there is one: the largest parts of it, by their rows.
pub(super) fn floating(balance: &mut Balance) -> Option<Vec<usize>> {
    let (tangent, inertias) = (balance.tangent(), balance.inertias());
    let n = inertias.len();
    if n == 0 {
        return None;
    }
    let rates = (0..n).map(|i| tangent[(i, i)].abs() / inertias[i]);
    let stiffest = rates.fold(0.0, f64::max);
    let held = FLOATS * n as f64 * f64::EPSILON * stiffest;
    let mut lu = Lu::new(n);
    // Stiffer by what counts as nothing, the tangent of what floats can be factored.
    let shifted = Matrix::from_fn(n, n, |i, j| {
        tangent[(i, j)] + if i == j { 1e-3 * held * inertias[i] } else { 0.0 }
    });
    let weigh = |x: &[f64]| x.iter().zip(&inertias).map(|(x, m)| m * x * x).sum::<f64>().sqrt();
    let mut motion: Vec<f64> = (0..n).map(|i| 1.0 + 0.3 * (i as f64).sin()).collect();
    if stiffest > 0.0 {
        if lu.factor(&shifted.data).is_err() {
            return Some(Vec::new());
        }
        let mut rate = f64::INFINITY;
        // Inverse iteration: the motion with the least force for its inertia grows fastest.
        for _ in 0..12 {
            let norm = weigh(&motion);
            motion.iter_mut().zip(&inertias).for_each(|(x, m)| *x *= m / norm);
            lu.solve_in_place(&mut motion);
            rate = 1.0 / weigh(&motion);
        }
        if rate > held {
            return None;
        }
    }
    let mut rows: Vec<usize> = (0..n).collect();
    let size = |row: usize| motion[row].abs() * inertias[row].sqrt();
    rows.sort_by(|&a, &b| size(b).total_cmp(&size(a)));
    let most = rows.first().map_or(0.0, |&row| size(row));
    // Where sizes are no numbers, as of stiffnesses that none holds, the first rows stand for all.
    rows.retain(|&row| !(size(row) < 0.3 * most));
    rows.truncate(3);
    Some(rows)
}
