//! Where the stability of a branch changes between two of its points: folds, doublings of the period, second frequencies.

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::path::{Node, Path, norm, values};
use crate::error::Error;
use crate::linalg::dot;

/// Divisions of a step at most, and the part of it to which an event is located.
const DIVISIONS: usize = 40;
const LOCATED: f64 = 1e-10;
/// How near to the unit circle a multiplier is where it passes; where none is, they have jumped.
const PASSES: f64 = 0.01;
/// sin² of the angle between the tangents on both sides of a place where the branch goes straight on.
const ALONG: f64 = 0.01;
/// How often a corner is approached, and by how much of the way each time.
const APPROACHES: usize = 12;
const MOST: f64 = 0.9;
/// 1 − cos² of tangents that do not meet, and how far from two points they meet at most, of the distance between these.
const STRAIGHT: f64 = 1e-6;
const FARTHEST: f64 = 20.0;

/// A change between two points of a branch.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchEvent {
    /// What it is.
    pub kind: EventKind,
    /// The parameter there.
    pub value: f64,
    /// x at the start of the cycle there.
    pub state: Vec<f64>,
    /// The multiplier that is on the unit circle there; before a corner the largest one.
    pub multiplier: Complex64,
    /// The place of the point before it.
    pub after: usize,
    /// Whether the multiplier jumps over the circle though the branch goes straight on, as a contact comes to another step: it is
    /// located to the nearest of such places.
    pub jumps: bool,
}

/// What happens to a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventKind {
    /// It turns back: two motions meet, and there is none beyond.
    Fold,
    /// A real multiplier passes 1 and the branch goes on: another one crosses it.
    Crossing,
    /// Motions of twice the period begin or end there.
    Doubling,
    /// A second frequency appears (Neimark and Sacker).
    Torus,
    /// It turns at once, as contacts begin or end all around, and multipliers jump.
    Corner,
}

/// How many multipliers are outside of the unit circle: real ones above 1, below −1, and others.
fn outside(all: &[Complex64]) -> [usize; 3] {
    let mut counts = [0; 3];
    for own in all.iter().filter(|own| own.norm() > 1.0) {
        let real = own.im.abs() < 1e-12 * own.norm();
        let place = if !real { 2 } else { usize::from(own.re < 0.0) };
        counts[place] += 1;
    }
    counts
}

/// The sign of det [∂R/∂u; t] but for one that all points have in common: along a branch it changes where another one crosses it, and
/// neither at folds nor at corners.
pub(super) fn oriented(node: &Node) -> Result<bool, Error> {
    let beyond_one = outside(&values(&node.monodromy)?)[0];
    Ok((node.along() < 0.0) ^ (beyond_one % 2 == 1))
}

/// What is zero where an event of a kind is.
fn measure(kind: EventKind, node: &Node) -> Result<f64, Error> {
    let all = values(&node.monodromy)?;
    let product = |at: f64| all.iter().map(|own| own - at).product::<Complex64>().re;
    Ok(match kind {
        EventKind::Fold | EventKind::Corner => node.along(),
        EventKind::Crossing => product(1.0),
        EventKind::Doubling => product(-1.0),
        EventKind::Torus => {
            let complex = all.iter().filter(|own| own.im.abs() > 1e-9 * own.norm());
            complex
                .map(|own| own.norm() - 1.0)
                .min_by(|a, b| a.abs().total_cmp(&b.abs()))
                .unwrap_or(1.0)
        }
    })
}

/// The events between two points, of which the first is the `after`-th of the branch.
///
/// # Errors
/// Eigenvalues that are not found; a machine that cannot be made.
pub(super) fn between(
    path: &mut Path,
    [a, b]: [&Node; 2],
    after: usize,
) -> Result<Vec<BranchEvent>, Error> {
    let [before, behind] = [values(&a.monodromy)?, values(&b.monodromy)?].map(|own| outside(&own));
    let mut kinds = Vec::new();
    if a.along() * b.along() < 0.0 {
        kinds.push(EventKind::Fold);
    } else if before[0].abs_diff(behind[0]) % 2 == 1 {
        kinds.push(EventKind::Crossing);
    }
    if before[1].abs_diff(behind[1]) % 2 == 1 {
        kinds.push(EventKind::Doubling);
    }
    // Two real ones that become a pair outside of the circle cross nothing.
    let whole: [usize; 2] = [before, behind].map(|own| own.iter().sum());
    if before[2] != behind[2] && whole[0].abs_diff(whole[1]) >= 2 {
        kinds.push(EventKind::Torus);
    }
    let mut events = Vec::new();
    for kind in kinds {
        events.extend(located(path, kind, [a, b], after)?);
    }
    Ok(events)
}

/// An event by regula falsi on the straight way between two points (Dowell and Jarratt, BIT 11, 1971, 168-174).
fn located(
    path: &mut Path,
    kind: EventKind,
    [a, b]: [&Node; 2],
    after: usize,
) -> Result<Option<BranchEvent>, Error> {
    let (from, to) = (path.u(&a.y, a.value), path.u(&b.y, b.value));
    let way: Vec<f64> = to.iter().zip(&from).map(|(to, from)| to - from).collect();
    let length = way.iter().map(|own| own * own).sum::<f64>().sqrt();
    let normal: Vec<f64> = way.iter().map(|own| own / length).collect();
    let (mut low, mut high) = ((0.0, measure(kind, a)?), (1.0, measure(kind, b)?));
    let mut best: Option<Node> = None;
    let mut sides = [a.clone(), b.clone()];
    if low.1 * high.1 > 0.0 {
        return Ok(None);
    }
    for _ in 0..DIVISIONS {
        let share: f64 = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        let share = if share > low.0 && share < high.0 { share } else { 0.5 * (low.0 + high.0) };
        let at: Vec<f64> = from.iter().zip(&way).map(|(from, way)| from + share * way).collect();
        let Some(node) = path.correct(&at, &normal)? else { break };
        let value = measure(kind, &node)?;
        sides[usize::from(value * low.1 <= 0.0)] = node.clone();
        best = Some(node);
        if value == 0.0 || high.0 - low.0 < LOCATED {
            break;
        }
        let (kept, new) =
            if value * low.1 > 0.0 { (&mut high, &mut low) } else { (&mut low, &mut high) };
        let shrunk = 1.0 - value / new.1;
        let moved = (new.0 - share).abs();
        // The end that stays counts less each time, so that it moves, too.
        kept.1 *= if shrunk > 0.0 { shrunk } else { 0.5 };
        *new = (share, value);
        if moved < LOCATED {
            break;
        }
    }
    let off = |own: &&Complex64| match kind {
        EventKind::Fold | EventKind::Crossing | EventKind::Corner => (*own - 1.0).norm(),
        EventKind::Doubling => (*own + 1.0).norm(),
        EventKind::Torus => match own.im > 0.0 {
            true => (own.norm() - 1.0).abs(),
            false => f64::INFINITY,
        },
    };
    let nearest = |node: &Node| -> Result<Option<Complex64>, Error> {
        let all = values(&node.monodromy)?;
        Ok(all.into_iter().min_by(|a, b| off(&a).total_cmp(&off(&b))))
    };
    let Some(mut node) = best else { return corner(path, [a, b], after).map(Some) };
    let Some(mut multiplier) = nearest(&node)? else { return Ok(None) };
    let jumps = off(&&multiplier) >= PASSES;
    if jumps {
        let alike = dot(&sides[0].tangent, &sides[1].tangent);
        let goes_on = alike > 0.0 && 1.0 - alike * alike < ALONG;
        if !goes_on {
            return corner(path, [a, b], after).map(Some);
        }
        for side in sides {
            if let Some(own) = nearest(&side)?.filter(|own| off(&own) < off(&&multiplier)) {
                (node, multiplier) = (side, own);
            }
        }
    }
    let (value, state) = (node.value, path.family.state(&node.y));
    Ok(Some(BranchEvent { kind, value, state, multiplier, after, jumps }))
}

/// The corner between two points: where the tangents of both meet, again from points that are nearer to it.
pub(super) fn corner(
    path: &mut Path,
    [a, b]: [&Node; 2],
    after: usize,
) -> Result<BranchEvent, Error> {
    let (mut a, mut b) = (a.clone(), b.clone());
    let mut value = b.value;
    for _ in 0..APPROACHES {
        let [from, to] = [&a, &b].map(|own| path.u(&own.y, own.value));
        let between: Vec<f64> = to.iter().zip(&from).map(|(to, from)| to - from).collect();
        let alike = dot(&a.tangent, &b.tangent);
        let [by_a, by_b] = [&a, &b].map(|own| dot(&between, &own.tangent));
        let turned = 1.0 - alike * alike;
        if turned < STRAIGHT {
            break;
        }
        let [ahead, back] = [(by_a - alike * by_b) / turned, (alike * by_a - by_b) / turned];
        value = a.value + ahead * a.along() * path.range;
        let size = norm(&between);
        if size < LOCATED || ahead.abs().max(back.abs()) > size * FARTHEST {
            break;
        }
        let near_a =
            nearer(path, &from, (&a, ahead))?.filter(|own| apart(own, &a) < apart(own, &b));
        let near_b = nearer(path, &to, (&b, back))?.filter(|own| apart(own, &b) < apart(own, &a));
        if near_a.is_none() && near_b.is_none() {
            break;
        }
        a = near_a.unwrap_or(a);
        b = near_b.unwrap_or(b);
    }
    Ok(BranchEvent {
        kind: EventKind::Corner,
        value,
        state: path.family.state(&a.y),
        multiplier: values(&a.monodromy)?.first().copied().unwrap_or_default(),
        after,
        jumps: false,
    })
}

/// The point most of the way along a tangent.
fn nearer(path: &mut Path, u: &[f64], (at, way): (&Node, f64)) -> Result<Option<Node>, Error> {
    let near: Vec<f64> = u.iter().zip(&at.tangent).map(|(u, t)| u + MOST * way * t).collect();
    path.correct(&near, &at.tangent)
}

/// How far the derivatives of two cycles are from each other.
pub(super) fn apart(a: &Node, b: &Node) -> f64 {
    let pairs = a.monodromy.data.iter().zip(&b.monodromy.data);
    pairs.map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

impl BranchEvent {
    /// Frequency (Hz) of what appears beside whole multiples of that of a cycle of `period` s.
    pub fn beside(&self, period: f64) -> f64 {
        self.multiplier.arg().abs() / (TAU * period)
    }
}
