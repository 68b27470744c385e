//! The search for a state that a cycle leaves as it is.

use std::ops::ControlFlow;

use super::anderson::Anderson;
use super::metric::norm;
use super::options::{CycleProgress, Method, PeriodicOptions};
use super::shooting::Shot;
use super::weighed::{Weighed, miss};
use crate::error::{Error, PeriodicError};

/// What a state may miss that is rounding.
const ROUNDING: f64 = 1e-15;
/// Cycles after which what is left no longer falls.
const STALLS: usize = 3;
/// Cycles marched at first: of few states, where Newton's method follows, and of many.
const MARCHED: [usize; 2] = [8, 2];
/// Marches that may fail on the way.
const FAILURES: usize = 4;

/// Multiple of the states that were marched beyond which none is one that a cycle leaves: what grows by the same in every cycle, as the
/// time that a law counts, changes by nothing beside a value that is large enough.
const BEYOND: f64 = 1e6;

/// A state that a cycle leaves as it is.
pub(super) struct Solved {
    pub(super) y: Vec<f64>,
    pub(super) miss: f64,
    pub(super) method: Method,
}

/// Watches the search, and may end it.
pub(super) type Observe<'o> = &'o mut dyn FnMut(&CycleProgress) -> ControlFlow<()>;

/// The best state so far, and whether it still gets better.
struct Best {
    y: Vec<f64>,
    miss: f64,
    stalled: usize,
    /// Whether cycles are still marched one after the other, and the largest state among these.
    marches: bool,
    marched: f64,
}

impl Best {
    /// Takes a state that the map makes `image` of.
    fn take(&mut self, y: &[f64], image: &[f64]) -> f64 {
        self.marched = self.marched.max(if self.marches { norm(image) } else { 0.0 });
        let gone = self.marched > 0.0 && norm(image) > BEYOND * self.marched;
        let missed = if gone { f64::INFINITY } else { miss(y, image) };
        self.stalled = if missed < 0.5 * self.miss { 0 } else { self.stalled + 1 };
        // What is no number is never better.
        if missed < self.miss {
            (self.y, self.miss) = (y.to_vec(), missed);
        }
        missed
    }

    fn is_done(&self, tolerance: f64) -> bool {
        self.miss <= ROUNDING || self.miss <= tolerance && self.stalled >= STALLS
    }
}

/// Looks for the state from y on.
///
/// # Errors
/// There is none nearby; an interruption; a step that does not converge.
pub(super) fn solve(
    map: &mut Weighed,
    mut y: Vec<f64>,
    options: &PeriodicOptions,
    observe: Observe,
) -> Result<Solved, Error> {
    // By differences a derivative takes more cycles than acceleration does.
    let few = map.map.is_small() && map.map.memory() == 0;
    let usual = if few { Method::Shooting } else { Method::Accelerated };
    let method = options.method.filter(|own| *own != Method::Harmonic).unwrap_or(usual);
    let marched = options.marched.unwrap_or(MARCHED[usize::from(method != Method::Shooting)]);
    let marched = marched.min(options.most_cycles);
    let mut best =
        Best { y: y.clone(), miss: f64::INFINITY, stalled: 0, marches: true, marched: 0.0 };
    for _ in 0..marched {
        let image = map.apply(&y)?;
        let missed = best.take(&y, &image);
        watch(map, missed, observe)?;
        if best.is_done(options.tolerance) {
            return Ok(Solved { y: best.y, miss: best.miss, method });
        }
        y = image;
    }
    best.marches = false;
    let other = match method {
        Method::Shooting => Method::Accelerated,
        _ => Method::Shooting,
    };
    let methods = if options.method.is_some() { vec![method] } else { vec![method, other] };
    for method in methods {
        best.stalled = 0;
        match method {
            Method::Shooting => shoot(map, y.clone(), options, &mut best, observe)?,
            _ => accelerate(map, y.clone(), options, &mut best, observe)?,
        }
        if best.miss <= options.tolerance {
            return Ok(Solved { y: best.y, miss: best.miss, method });
        }
    }
    let cycles = map.map.cycles();
    Err(PeriodicError::NotFound { cycles, miss: best.miss, least: best.miss }.into())
}

fn watch(map: &Weighed, miss: f64, observe: Observe) -> Result<(), Error> {
    let cycles = map.map.cycles();
    match observe(&CycleProgress { cycles, miss }) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(PeriodicError::Interrupted { cycles }.into()),
    }
}

fn shoot(
    map: &mut Weighed,
    y: Vec<f64>,
    options: &PeriodicOptions,
    best: &mut Best,
    observe: Observe,
) -> Result<(), Error> {
    let end = map.map.cycles() + options.most_cycles;
    let Some(mut shot) = Shot::new(map, y)? else { return Ok(()) };
    while map.map.cycles() < end {
        let missed = best.take(&shot.y, &shot.image);
        watch(map, missed, observe)?;
        if best.is_done(options.tolerance) {
            break;
        }
        match shot.next(map) {
            Some(next) => shot = next,
            None => break,
        }
    }
    Ok(())
}

fn accelerate(
    map: &mut Weighed,
    mut y: Vec<f64>,
    options: &PeriodicOptions,
    best: &mut Best,
    observe: Observe,
) -> Result<(), Error> {
    let end = map.map.cycles() + options.most_cycles;
    let (mut anderson, mut failures) = (Anderson::new(), 0);
    let mut last: Option<Vec<f64>> = None;
    while map.map.cycles() < end {
        let image = match (map.apply(&y), last.take()) {
            (Ok(image), _) => image,
            // Beyond what the march gets through: go on from the last cycle by marching.
            (Err(_), Some(marched)) if failures < FAILURES => {
                failures += 1;
                (y, anderson) = (marched, Anderson::new());
                continue;
            }
            (Err(error), _) => return Err(error),
        };
        let missed = best.take(&y, &image);
        watch(map, missed, observe)?;
        if best.is_done(options.tolerance) {
            break;
        }
        y = anderson.next(&y, &image);
        last = Some(image);
    }
    Ok(())
}
