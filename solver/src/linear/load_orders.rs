//! Orders of loads that go by the angle of a body: exact, whatever they are and however narrow a table is.

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::curve::Curve;
use crate::loads::{Load, TimeFunction};

/// Turns over which loads come again, as those of engines do: orders are told in parts of so many.
pub(super) const HALVES: f64 = 2.0;
/// Share by which a multiple of half an order may be off.
const WHOLE: f64 = 1e-9;
/// The highest order in halves that is told from its neighbours.
const MOST: f64 = 1e6;
/// Orders in halves up to which all of a table count, those beyond it that are larger than a share of its largest, and the last.
const ALL: i32 = 47;
const LARGE: f64 = 1e-3;
const LAST: i32 = 600;
/// Complex amplitudes c_k of a factor Re Σ c_k e^{ikθ/2} over the angle, k ≥ 0 in rising order.
pub(super) type Harmonics = Vec<(i32, Complex64)>;

/// Those of a load that goes by an angle and comes again after two turns; none of other loads. An error where it does not come
/// again after two turns: the order that it has.
pub(super) fn harmonics(load: &Load) -> Result<Option<Harmonics>, f64> {
    match &load.time_function {
        TimeFunction::Order { order, phase, .. } => {
            let (k, sign) = (halves(order.abs())?, order.signum());
            // sin(nθ + φ) = Re(−i e^{iφ} e^{inθ}).
            let along = -Complex64::i() * Complex64::from_polar(1.0, *phase);
            Ok(Some(vec![match (k, sign < 0.0) {
                (0, _) => (0, phase.sin().into()),
                (_, true) => (k, along.conj()),
                (_, false) => (k, along),
            }]))
        }
        TimeFunction::OverAngle { curve, .. } => match curve.period() {
            Some(period) => of_table(curve, halves(TAU / period)?).map(Some),
            None => Ok(None),
        },
        _ => Ok(None),
    }
}

/// An order in halves.
fn halves(order: f64) -> Result<i32, f64> {
    let halves = HALVES * order;
    let whole = halves.round();
    let is_whole = (halves - whole).abs() <= WHOLE * whole.max(1.0) && whole <= MOST;
    if is_whole { Ok(whole as i32) } else { Err(order) }
}

fn of_table(curve: &Curve, first: i32) -> Result<Harmonics, f64> {
    if first == 0 {
        return Err(0.5 / HALVES);
    }
    let mut all = vec![(0, Complex64::from(curve.mean()))];
    let (mut largest, mut k) = (0.0_f64, first);
    while k <= LAST {
        let own = 2.0 * curve.harmonic(f64::from(k) / HALVES);
        largest = largest.max(own.norm());
        if k <= ALL || own.norm() > LARGE * largest {
            all.push((k, own));
        }
        k += first;
    }
    Ok(all)
}
