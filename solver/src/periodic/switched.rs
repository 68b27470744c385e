//! The branch of motions of twice the period that begins where multipliers pass −1.
//!
//! There Φw = −w: a motion beside that of the branch, by w, goes over to its other side in every cycle, and closes after two. So the
//! map of two cycles has the points y + εw, with the parameter as the unknown: its branch leaves along w.

use super::branch::{Begun, Branch, BranchOptions, follow};
use super::cycle::Cycle;
use super::events::BranchEvent;
use super::family::{At, Family};
use super::path::{Node, Path, norm};
use super::solve::Observe;
use crate::error::Error;
use crate::linalg::{Lu, Matrix, dot};
use crate::machine::Machine;

/// By how much of the size of the motion the first point lies beside the branch, one after the other as long as none is found.
const BESIDE: [f64; 5] = [0.01, 0.003, 0.03, 0.001, 0.1];
/// What keeps Φ + 1 from being singular, and how often it is solved for its null vector.
const SHIFT: f64 = 1e-8;
const SOLVED: usize = 3;

/// Follows the motions of twice the period from a doubling of a branch whose cycle is `periods` of the machine's; none where none is
/// found beside it. They are followed to one side: those to the other are the same, a cycle of the branch later. It ends where it comes
/// back to motions of half its period.
///
/// # Errors
/// As [`branch`](super::branch()).
pub fn switched(
    at: At,
    options: &BranchOptions,
    (event, periods): (&BranchEvent, usize),
    observe: Observe,
) -> Result<Option<Branch>, Error> {
    let (newton, range) = (options.first.newton, options.range);
    let times =
        |count: usize| move |(machine, cycle): (Machine, Cycle)| (machine, cycle.times(count));
    let mut once = |value: f64| at(value).map(times(periods));
    let mut family = Family::new(&mut once, newton, range, &event.state)?;
    let y = family.weighed(&event.state);
    let (_, monodromy) = family.with(event.value, |map| map.monodromy(&y))?;
    let (metric, cycles) = (family.metric(), family.cycles);
    let Some(beside) = null_vector(&monodromy) else { return Ok(None) };
    let mut twice = |value: f64| at(value).map(times(2 * periods));
    let family = Family::of(&mut twice, newton, range, metric);
    let mut path =
        Path { family, size: norm(&y).max(f64::MIN_POSITIVE), range: (range[1] - range[0]).abs() };
    path.family.cycles = cycles;
    let from = path.u(&y, event.value);
    let mut normal = beside.clone();
    normal.push(0.0);
    let mut first = None;
    for share in BESIDE {
        let near: Vec<f64> = from.iter().zip(&normal).map(|(u, w)| u + share * w).collect();
        first = path.correct(&near, &normal)?;
        if first.is_some() {
            break;
        }
    }
    let Some(first) = first else { return Ok(None) };
    // The motion of one cycle, as one of two.
    let (_, of_two) = path.family.with(event.value, |map| map.monodromy(&y))?;
    let begin = Node {
        y: y.clone(),
        value: event.value,
        monodromy: of_two,
        tangent: normal,
        corrections: 0,
    };
    let points = vec![path.point(&begin, false)?, path.point(&first, false)?];
    let mut side = half(&mut path, &first)?;
    let mut meets = |path: &mut Path, node: &Node| -> Result<bool, Error> {
        let now = half(path, node)?;
        let passed = dot(&now, &side) < 0.0;
        side = now;
        Ok(passed)
    };
    // The first step leads out of the doubling: what changes there is that.
    let begun = Begun { points, events: Vec::new(), nodes: [begin, first] };
    follow(&mut path, options, begun, (&mut meets, observe)).map(Some)
}

/// By how much the motion of a point differs a half of its cycle later.
fn half(path: &mut Path, node: &Node) -> Result<Vec<f64>, Error> {
    let after = path.family.with(node.value, |map| map.half(&node.y))?;
    Ok(after.iter().zip(&node.y).map(|(after, own)| after - own).collect())
}

/// w of length 1 with Φw = −w.
fn null_vector(monodromy: &Matrix) -> Option<Vec<f64>> {
    let n = monodromy.rows;
    let size = monodromy.data.iter().map(|own| own * own).sum::<f64>().sqrt().max(1.0);
    let shifted = Matrix::from_fn(n, n, |i, j| {
        monodromy[(i, j)] + if i == j { 1.0 + SHIFT * size } else { 0.0 }
    });
    let mut lu = Lu::new(n);
    lu.factor(&shifted.data).ok()?;
    let mut w: Vec<f64> = (0..n).map(|i| 1.0 + (i as f64).sin()).collect();
    for _ in 0..SOLVED {
        lu.solve_in_place(&mut w);
        let length = norm(&w);
        w.iter_mut().for_each(|own| *own /= length);
    }
    w.iter().all(|own| own.is_finite()).then_some(w)
}
