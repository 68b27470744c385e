//! A branch of periodic motions over a parameter of the machine: from point to point by arc length, around folds, with its
//! stability, and where that changes.
//!
//! A point is u = (y/Y, λ/Λ), y the state in the energy norm and Y its size at the start, Λ the range of the parameter. The next
//! one is predicted on the straight line through the last two and found in the plane normal to it by Newton's method: kinks, as
//! contacts have them, stop tangents and not secants. Where the branch turns by more than half a radian steps are halved down to a
//! least one; where a contact begins all around it turns back at once, and the point beyond is looked for at fixed values of the
//! parameter, forward and back.

use std::ops::ControlFlow;

use super::events::{BranchEvent, EventKind, apart, between, corner, oriented};
use super::family::{At, Family};
use super::options::{CycleProgress, PeriodicOptions};
use super::path::{BranchPoint, Node, Path, norm};
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
/// Changes of the parameter with which a motion is looked for beyond a corner, and how far the states lie from it where the search
/// begins, of the first step.
const BEYOND: [f64; 5] = [0.1, 0.5, 2.5, 10.0, 40.0];
/// By how much the derivative of the cycle jumps there at least, and how much of it is left half way.
const LEAST_JUMP: f64 = 1e-2;
const JUMPED: f64 = 0.75;
/// How often the way back to the corner is halved, and how far the last point is from it at most, of the first one.
const HALVINGS: usize = 6;
const NEARER: f64 = 0.75;
/// How near to each other two corners are one, of the range.
const SAME: f64 = 1e-6;
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
    /// It has come to motions of half its period, from which it began.
    Meets,
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
    let family = Family::new(at, options.first.newton, options.range, x)?;
    let mut path = Path { family, size: 1.0, range };
    let y = path.family.weighed(x);
    let first = path.fixed((from, to - from), &y, &options.first, observe)?;
    path.size = norm(&first.y).max(f64::MIN_POSITIVE);
    let quick = PeriodicOptions { marched: Some(0), ..options.first.clone() };
    let ahead = from + (to - from) * options.step;
    let second = path.fixed((ahead, to - from), &first.y, &quick, observe)?;
    let points = vec![path.point(&first, false)?, path.point(&second, false)?];
    let events = between(&mut path, [&first, &second], 0)?;
    let begun = Begun { points, events, nodes: [first, second] };
    follow(&mut path, options, begun, (&mut |_, _| Ok(false), observe))
}

/// What a branch begins with: its first points, and what is known at the last two.
pub(super) struct Begun {
    pub(super) points: Vec<BranchPoint>,
    pub(super) events: Vec<BranchEvent>,
    pub(super) nodes: [Node; 2],
}

/// Whether a branch has come to another one with a point.
pub(super) type Meets<'m> = &'m mut dyn FnMut(&mut Path, &Node) -> Result<bool, Error>;

/// Follows a branch from its first points on.
pub(super) fn follow(
    path: &mut Path,
    options: &BranchOptions,
    begun: Begun,
    (meets, observe): (Meets, Observe),
) -> Result<Branch, Error> {
    let Begun { mut points, mut events, mut nodes } = begun;
    let mut step = options.step;
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
        let way = Way::through(path, [before, last]);
        let next = loop {
            let next = stepped(path, last, &way, step, options.range)?;
            // Near a corner it may be on the way back already. Where branches cross it changes in the least step, too.
            let goes_on =
                |node: &Node| Ok::<_, Error>(step <= least || oriented(node)? == oriented(last)?);
            if let Some((node, is_last)) = next
                && goes_on(&node)?
            {
                let moved = way.moved(path, &node);
                let turn = (dot(&moved, &way.secant) / norm(&moved)).clamp(-1.0, 1.0).acos();
                if turn <= TURN || step <= least && norm(&moved) <= FAR * step {
                    let grown = step * (USUAL / node.corrections as f64).clamp(0.5, 2.0);
                    step = grown.clamp(least, longest);
                    let is_corner = turn > TURN && apart(&node, last) > LEAST_JUMP;
                    break Some((node, is_last, is_corner));
                }
            }
            if step <= least {
                break None;
            }
            step = (0.5 * step).max(least);
        };
        let (node, is_last, is_corner) = match next {
            Some(found) => found,
            None => {
                let ahead = (options.step, options.range);
                let Some(node) = beyond(path, last, &way, ahead)? else {
                    break BranchEnd::Step;
                };
                step = options.step;
                (node, false, true)
            }
        };
        if meets(path, &node)? {
            break BranchEnd::Meets;
        }
        let after = points.len() - 1;
        let found = match is_corner {
            true => vec![corner(path, [last, &node], after)?],
            false => between(path, [last, &node], after)?,
        };
        // A corner that takes two steps is one.
        let is_same = |own: &BranchEvent| {
            let near = |other: &BranchEvent| (own.value - other.value).abs() < SAME * path.range;
            let at_corner = |own: &&BranchEvent| own.kind == EventKind::Corner;
            at_corner(&own) && events.last().filter(at_corner).is_some_and(near)
        };
        let found: Vec<BranchEvent> = found.into_iter().filter(|own| !is_same(own)).collect();
        events.extend(found);
        points.push(path.point(&node, is_corner)?);
        let largest =
            points.last().and_then(|own| own.multipliers.first()).map_or(0.0, |own| own.norm());
        let [_, last] = nodes;
        nodes = [last, node];
        if is_last {
            break BranchEnd::Range;
        }
        if largest > WILD {
            break BranchEnd::Wild;
        }
        if is_closed(path, &points[0], &nodes, points.len()) {
            break BranchEnd::Closed;
        }
    };
    Ok(Branch { points, events, end, cycles: path.family.cycles })
}

/// The straight way on from the last of two points.
struct Way {
    from: Vec<f64>,
    /// Of length 1.
    secant: Vec<f64>,
}

impl Way {
    fn through(path: &Path, [before, last]: [&Node; 2]) -> Way {
        let [before, from] = [before, last].map(|own| path.u(&own.y, own.value));
        let mut secant: Vec<f64> = from.iter().zip(&before).map(|(b, a)| b - a).collect();
        let length = norm(&secant);
        secant.iter_mut().for_each(|own| *own /= length);
        Way { from, secant }
    }

    fn at(&self, length: f64) -> Vec<f64> {
        self.from.iter().zip(&self.secant).map(|(from, s)| from + length * s).collect()
    }

    /// From the last point to another one.
    fn moved(&self, path: &Path, node: &Node) -> Vec<f64> {
        path.u(&node.y, node.value).iter().zip(&self.from).map(|(a, b)| a - b).collect()
    }
}

/// The end of the range that a value has passed.
fn passed(value: f64, [from, to]: [f64; 2]) -> Option<f64> {
    let (least, most) = (from.min(to), from.max(to));
    let held = value.clamp(least, most);
    (held != value).then_some(held)
}

/// The point after a step, and whether that is at an end of the range: the step then ends there.
fn stepped(
    path: &mut Path,
    last: &Node,
    way: &Way,
    step: f64,
    range: [f64; 2],
) -> Result<Option<(Node, bool)>, Error> {
    let predicted = way.at(step);
    let (_, value) = path.split(&predicted);
    let mut end = passed(value, range);
    let mut ahead: Vec<f64> = predicted.iter().zip(&way.from).map(|(a, b)| a - b).collect();
    if end.is_none() {
        let Some(node) = path.correct(&predicted, &way.secant)? else { return Ok(None) };
        end = passed(node.value, range);
        if end.is_none() {
            return Ok(Some((node, false)));
        }
        ahead = way.moved(path, &node);
    }
    let Some(end) = end else { return Ok(None) };
    let share = (end - last.value) / (ahead.last().expect("the parameter") * path.range);
    let guess: Vec<f64> = way.from.iter().zip(&ahead).map(|(a, b)| a + share * b).collect();
    Ok(path.at_value(&guess, (end, end - last.value))?.map(|node| (node, true)))
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

/// A point beyond a corner: at values of the parameter ahead and back, from states that the branch was going to. The derivative of its
/// cycle has jumped, and half way to it there are others that are nearer: it lies on a branch that begins at the corner, and not on
/// that which ends there, nor on a third one.
fn beyond(
    path: &mut Path,
    last: &Node,
    way: &Way,
    (step, range): (f64, [f64; 2]),
) -> Result<Option<Node>, Error> {
    let ahead = if way.secant[way.secant.len() - 1] < 0.0 { -1.0 } else { 1.0 };
    for change in BEYOND.map(|own| own * step) {
        for direction in [ahead, -ahead] {
            let value = last.value + direction * change * (range[1] - range[0]).abs();
            let value = passed(value, range).unwrap_or(value);
            if value == last.value {
                continue;
            }
            for reach in BEYOND.map(|own| own * step) {
                let Some(node) = path.at_value(&way.at(reach), (value, direction))? else {
                    continue;
                };
                if let Some(node) = out_of_corner(path, last, way, (node, direction))? {
                    return Ok(Some(node));
                }
            }
        }
    }
    Ok(None)
}

/// A point nearer to a corner on the branch of one, if that branch begins at the corner.
fn out_of_corner(
    path: &mut Path,
    last: &Node,
    way: &Way,
    (mut node, direction): (Node, f64),
) -> Result<Option<Node>, Error> {
    let jump = apart(&node, last);
    let mut moved = way.moved(path, &node);
    let far = norm(&moved);
    for _ in 0..HALVINGS {
        let middle: Vec<f64> =
            way.from.iter().zip(&moved).map(|(from, own)| from + 0.5 * own).collect();
        let value = 0.5 * (last.value + node.value);
        let Some(half) = path.at_value(&middle, (value, direction))? else { break };
        let nearer = way.moved(path, &half);
        if apart(&half, last) < JUMPED * jump || norm(&nearer) > norm(&moved) {
            break;
        }
        (node, moved) = (half, nearer);
    }
    let begins_there = jump > LEAST_JUMP && norm(&moved) < NEARER * far;
    Ok(begins_there.then_some(node))
}
