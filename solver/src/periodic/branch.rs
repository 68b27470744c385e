//! A branch of periodic motions over a parameter of the machine: from point to point by arc length, around folds, with its
//! stability, and where that changes.
//!
//! A point is u = (y/Y, λ/Λ), y the state in the energy norm and Y its size at the start, Λ the range of the parameter. The next
//! one is predicted on the straight line through the last two and found in the plane normal to it by Newton's method: kinks, as
//! contacts have them, stop tangents and not secants. Where the branch turns by more than half a radian steps are halved down to a
//! least one; where a contact begins all around it turns back at once, and the point beyond is looked for at fixed values of the
//! parameter, forward and back.

use std::ops::ControlFlow;

use super::events::{BranchEvent, between};
use super::family::{At, Family};
use super::options::{CycleProgress, PeriodicOptions};
use super::path::{BranchPoint, Node, Path, is_of_motion, norm};
use super::solve::Observe;
use crate::error::Error;
use crate::linalg::dot;

/// Corrections that leave the step as long as it is.
const USUAL: f64 = 4.0;
/// How far a branch may turn in a step (rad).
const TURN: f64 = 0.5;
/// How far the next point may be after the least step, over that.
const FAR: f64 = 10.0;
/// The least step, of the first one; the longest.
const LEAST: f64 = 1e-3;
const LONGEST: f64 = 20.0;
/// Multipliers beyond this say that nothing is known any more.
const WILD: f64 = 1e3;

/// How a branch is followed.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchOptions {
    /// Where the parameter begins and ends.
    pub range: [f64; 2],
    /// Points at most.
    pub points: usize,
    /// The first step, of the range.
    pub step: f64,
    /// How the first motion is found.
    pub first: PeriodicOptions,
}

/// Why a branch has ended.
#[derive(Debug, Clone, PartialEq)]
pub enum BranchEnd {
    /// The parameter has left its range.
    Range,
    /// There are as many points as were asked for.
    Points,
    /// It is back where it began.
    Closed,
    /// The shortest step is not solved.
    Step,
    /// Multipliers are so large that nothing is known any more.
    Wild,
    /// It was to end.
    Interrupted,
}

/// A branch.
#[derive(Debug, Clone)]
pub struct Branch {
    /// Its points, in their order.
    pub points: Vec<BranchPoint>,
    /// What happens between them.
    pub events: Vec<BranchEvent>,
    /// Why it has ended.
    pub end: BranchEnd,
    /// Cycles that were marched.
    pub cycles: usize,
}

/// Follows the motions of machines over a parameter from the motion at the start of its range, which is looked for from x. `observe`
/// is called after every cycle of the first motion and after every point, and may end it: what was found is kept.
///
/// # Errors
/// No first motion; a machine that cannot be made, or has no cycle.
pub fn branch(
    at: At,
    options: &BranchOptions,
    x: &[f64],
    observe: Observe,
) -> Result<Branch, Error> {
    let [from, to] = options.range;
    let range = (to - from).abs();
    let family = Family::new(at, options.first.newton, (from, range), x)?;
    let mut path = Path { family, size: 1.0, range };
    let y = path.family.weighed(x);
    let first = path.fixed((from, to - from), &y, &options.first, observe)?;
    path.size = norm(&first.y).max(f64::MIN_POSITIVE);
    let quick = PeriodicOptions { marched: Some(0), ..options.first.clone() };
    let mut step = options.step;
    let ahead = from + (to - from) * step;
    let second = path.fixed((ahead, to - from), &first.y, &quick, observe)?;
    let mut points = vec![path.point(&first, false)?, path.point(&second, false)?];
    let mut events = between(&mut path, [&first, &second], 0)?;
    let mut nodes = [first, second];
    let (least, longest) = (LEAST * options.step, LONGEST * options.step);
    let end = loop {
        let [before, last] = &nodes;
        if points.len() >= options.points {
            break BranchEnd::Points;
        }
        let progress = CycleProgress { cycles: path.family.cycles, miss: 0.0 };
        if observe(&progress) != ControlFlow::Continue(()) {
            break BranchEnd::Interrupted;
        }
        let (a, b) = (path.u(&before.y, before.value), path.u(&last.y, last.value));
        let mut secant: Vec<f64> = b.iter().zip(&a).map(|(b, a)| b - a).collect();
        let length = norm(&secant);
        secant.iter_mut().for_each(|own| *own /= length);
        let next = loop {
            let predicted: Vec<f64> = b.iter().zip(&secant).map(|(b, s)| b + step * s).collect();
            if let Some(node) = path.correct(&predicted, &secant)? {
                let moved: Vec<f64> =
                    path.u(&node.y, node.value).iter().zip(&b).map(|(a, b)| a - b).collect();
                let turn = (dot(&moved, &secant) / norm(&moved)).clamp(-1.0, 1.0).acos();
                if turn <= TURN || step <= least && norm(&moved) <= FAR * step {
                    let grown = step * (USUAL / node.corrections as f64).clamp(0.5, 2.0);
                    step = grown.clamp(least, longest);
                    break Some((node, turn > TURN));
                }
            }
            if step <= least {
                break None;
            }
            step = (0.5 * step).max(least);
        };
        let (node, corner) = match next {
            Some(found) => found,
            None => match beyond(&mut path, &nodes, (&secant, options.step), &quick, observe)? {
                Some(node) => {
                    step = options.step;
                    (node, true)
                }
                None => break BranchEnd::Step,
            },
        };
        let own =
            if corner { Vec::new() } else { between(&mut path, [last, &node], points.len() - 1)? };
        events.extend(own);
        points.push(path.point(&node, corner)?);
        let largest =
            points.last().and_then(|own| own.multipliers.first()).map_or(0.0, |own| own.norm());
        let [_, last] = nodes;
        nodes = [last, node];
        let (least_value, most_value) = (from.min(to), from.max(to));
        let value = nodes[1].value;
        if value < least_value - 1e-9 * range || value > most_value + 1e-9 * range {
            break BranchEnd::Range;
        }
        if largest > WILD {
            break BranchEnd::Wild;
        }
        if is_closed(&path, &points[0], &nodes, points.len()) {
            break BranchEnd::Closed;
        }
    };
    Ok(Branch { points, events, end, cycles: path.family.cycles })
}

/// Whether the last step has passed the first point in its direction.
fn is_closed(path: &Path, first: &BranchPoint, [a, b]: &[Node; 2], points: usize) -> bool {
    if points < 5 {
        return false;
    }
    let begin = path.u(&path.family.weighed(&first.state), first.value);
    let (a, b) = (path.u(&a.y, a.value), path.u(&b.y, b.value));
    let way: Vec<f64> = b.iter().zip(&a).map(|(b, a)| b - a).collect();
    let to: Vec<f64> = begin.iter().zip(&a).map(|(b, a)| b - a).collect();
    let share = dot(&to, &way) / dot(&way, &way);
    let off: Vec<f64> = to.iter().zip(&way).map(|(to, way)| to - share * way).collect();
    (0.0..=1.0).contains(&share) && norm(&off) < 0.1 * norm(&way)
}

/// A point beyond a corner: at values of the parameter a little ahead or back, from the state that the branch was going to; one that is
/// near, and not on the way that it came.
fn beyond(
    path: &mut Path,
    [before, last]: &[Node; 2],
    (secant, step): (&[f64], f64),
    options: &PeriodicOptions,
    observe: Observe,
) -> Result<Option<Node>, Error> {
    let (a, b) = (path.u(&before.y, before.value), path.u(&last.y, last.value));
    let ahead = if secant[secant.len() - 1] < 0.0 { -1.0 } else { 1.0 };
    for length in [0.05 * step, 0.2 * step] {
        for direction in [ahead, -ahead] {
            let value = last.value + direction * length * path.range;
            let guess: Vec<f64> = b.iter().zip(secant).map(|(b, s)| b + length * s).collect();
            let (y, _) = path.split(&guess);
            let node = match path.fixed((value, direction), &y, options, observe) {
                Ok(node) => node,
                Err(error) if is_of_motion(&error) => continue,
                Err(error) => return Err(error),
            };
            let u = path.u(&node.y, node.value);
            let apart = |other: &[f64]| {
                norm(&u.iter().zip(other).map(|(a, b)| a - b).collect::<Vec<f64>>())
            };
            let moved: Vec<f64> = u.iter().zip(&b).map(|(a, b)| a - b).collect();
            let back = dot(&moved, secant) < -0.5 * norm(&moved);
            if apart(&b) < 10.0 * length && !back && apart(&a) > 0.1 * length {
                return Ok(Some(node));
            }
        }
    }
    Ok(None)
}
