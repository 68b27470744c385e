//! Motions that a machine has by itself, with a period of their own: oil whirl, friction that drives.
//!
//! Nothing that the machine is told changes, and its bodies that turn are round, so that space sees constant equations. A march from
//! beside the equilibrium grows into the motion, if it is stable. Its last cycles give the period and the harmonics from which Newton's
//! method begins.

use super::series::{INSTANTS, Series};
use super::solve::Motion;
use crate::error::{Error, PeriodicError};
use crate::linalg::Matrix;
use crate::periodic::in_space::InSpace;
use crate::periodic::map::CycleMap;
use crate::periodic::metric::{Metric, norm};
use crate::periodic::options::{CycleProgress, PeriodicOptions};
use crate::periodic::solve::Observe;

/// Part of the displacements, and of the speed, by which a march begins beside the equilibrium.
const BESIDE: f64 = 0.05;
/// Stretches marched at least, and the share by which the motion may still change when it has grown enough.
pub(super) const LEAST: usize = 8;
const GROWN: f64 = 1e-3;
/// What is left of a change from stretch to stretch at most where more is to be told of all that follow.
const FALLS: f64 = 0.99;
/// Share of the largest motion at which it has died.
const DEAD: f64 = 1e-4;
/// Stretches in which the period is looked for: it may be three times as long.
const LOOKED_AT: usize = 8;

/// A stretch of the motion into which a march has grown, in equal steps.
pub(super) struct Grown {
    /// z of all unknowns; a column a step.
    samples: Matrix,
    /// s.
    step: f64,
    /// The coordinate that moves most.
    pub(super) reference: usize,
    /// Stretches that were marched.
    pub(super) cycles: usize,
}

/// Marches until the motion no longer grows, `least` stretches or more. The cycle of the map is a stretch of about its period.
///
/// # Errors
/// It dies; an interruption; a step that does not converge.
pub(super) fn grown(
    map: &mut CycleMap,
    (metric, space): (&Metric, &InSpace),
    (options, least): (&PeriodicOptions, usize),
    x: &[f64],
    observe: Observe,
) -> Result<Grown, Error> {
    let (n, cycle) = (map.unknowns(), map.cycle());
    let mut x = beside(x, n, std::f64::consts::TAU / cycle.period);
    let (mut largest, mut before, mut stood) = (0.0_f64, f64::INFINITY, 0);
    let mut changed = f64::INFINITY;
    let mut last: Option<Vec<[f64; 2]>> = None;
    for stretch in 1..=options.most_cycles {
        let samples = seen(map, space, &mut x)?;
        // Over two stretches, which are a period or more, ranges do not hang on where in it they begin.
        let own = ranges(&samples, |column| metric.weighed_positions(column));
        let both = own.iter().zip(last.as_ref().unwrap_or(&own));
        let wide = both.map(|(a, b)| (a[1].max(b[1]) - a[0].min(b[0])).powi(2));
        let size = wide.sum::<f64>().sqrt();
        last = Some(own);
        largest = largest.max(size);
        // All changes that are to come, as they fall.
        let change = (size - before).abs();
        let falls = (change / changed).min(FALLS);
        stood = if change <= GROWN * size * (1.0 - falls) { stood + 1 } else { 0 };
        (before, changed) = (size, change);
        if observe(&CycleProgress { cycles: stretch, miss: size }).is_break() {
            return Err(PeriodicError::Interrupted { cycles: stretch }.into());
        }
        if size <= DEAD * largest {
            break;
        }
        if stretch >= least && stood >= 3 {
            return taken(map, space, x, stretch);
        }
    }
    match before <= 0.1 * largest || before == 0.0 {
        true => Err(PeriodicError::DiesOut.into()),
        // It still grows or beats: Newton's method is nearer than nothing.
        false => taken(map, space, x, options.most_cycles),
    }
}

/// A state beside one, with rates as of a slow whirl.
fn beside(x: &[f64], unknowns: usize, frequency: f64) -> Vec<f64> {
    let mut x = x.to_vec();
    let (q, v) = x.split_at_mut(unknowns);
    let size = norm(q);
    for (q, v) in q.iter_mut().zip(v) {
        *v += BESIDE * frequency * if size > 0.0 { *q } else { 1e-6 };
    }
    x
}

/// z over a stretch, which is marched from x on.
fn seen(map: &mut CycleMap, space: &InSpace, x: &mut [f64]) -> Result<Matrix, Error> {
    let mut samples = map.positions(x)?;
    let (steps, period) = (samples.cols, map.cycle().period);
    // The first column is the end.
    let end = samples.col(0).to_vec();
    samples.data.rotate_left(samples.rows);
    samples.col_mut(steps - 1).copy_from_slice(&end);
    for j in 0..steps {
        space.positions(samples.col_mut(j), period * (j + 1) as f64 / steps as f64);
    }
    Ok(samples)
}

/// Least and largest value of what is made of each sample.
fn ranges(samples: &Matrix, of: impl Fn(&[f64]) -> Vec<f64>) -> Vec<[f64; 2]> {
    let mut all = vec![[f64::INFINITY, f64::NEG_INFINITY]; samples.rows];
    for j in 0..samples.cols {
        for ([least, most], own) in all.iter_mut().zip(of(samples.col(j))) {
            (*least, *most) = (least.min(own), most.max(own));
        }
    }
    all
}

/// Some stretches more, side by side.
fn taken(
    map: &mut CycleMap,
    space: &InSpace,
    mut x: Vec<f64>,
    cycles: usize,
) -> Result<Grown, Error> {
    let mut data = Vec::new();
    let (mut rows, mut step) = (0, 0.0);
    for _ in 0..LOOKED_AT {
        // Each stretch begins in space where the one before ended.
        let mut samples = seen(map, space, &mut x)?;
        (rows, step) = (samples.rows, map.cycle().time_step());
        data.append(&mut samples.data);
    }
    let samples = Matrix { rows, cols: data.len() / rows.max(1), data };
    let range = |i: usize| {
        let all = (0..samples.cols).map(|j| samples[(i, j)]);
        let [least, most] = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], own| {
            [least.min(own), most.max(own)]
        });
        most - least
    };
    let reference = (0..rows).max_by(|a, b| range(*a).total_cmp(&range(*b))).unwrap_or(0);
    Ok(Grown { samples, step, reference, cycles })
}

impl Grown {
    /// So many harmonics of the motion; none where it does not come back.
    pub(super) fn motion(&self, count: usize) -> Option<Motion> {
        let Grown { samples, step, reference, .. } = self;
        let signal: Vec<f64> = (0..samples.cols).map(|j| samples[(*reference, j)]).collect();
        let mean = signal.iter().sum::<f64>() / signal.len() as f64;
        // Where it rises through its mean (in steps).
        let rises =
            signal.windows(2).enumerate().filter(|(_, own)| own[0] < mean && own[1] >= mean);
        let rises: Vec<f64> =
            rises.map(|(j, own)| j as f64 + (mean - own[0]) / (own[1] - own[0])).collect();
        let [first, .., last] = rises.as_slice() else { return None };
        let period = (last - first) / (rises.len() - 1) as f64;
        let instants = INSTANTS * count;
        let at = |place: f64| -> Vec<f64> {
            let before = (place.floor() as usize).min(samples.cols - 2);
            let share = place - before as f64;
            let both = samples.col(before).iter().zip(samples.col(before + 1));
            both.map(|(a, b)| a + share * (b - a)).collect()
        };
        let data = (0..instants).flat_map(|j| at(first + period * j as f64 / instants as f64));
        let sampled = Matrix { rows: samples.rows, cols: instants, data: data.collect() };
        let period = period * step;
        let coefficients = Series::new(period, count, instants).coefficients(&sampled);
        Some(Motion { coefficients, period })
    }
}
