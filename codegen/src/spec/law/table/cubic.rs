//! Monotone cubics through points, exactly.
//!
//! The slope at a point is that of the parabola through it and its neighbours, limited to what keeps every
//! interval monotone: zero between secants of different signs, else at most three times the flatter secant
//! (the square region of Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980) 238–246). Where the limit does
//! not bind, values are of third order.

use crate::operation::Number;
use crate::rational::{Rational, nearest};
use num_traits::{Signed, Zero};

/// y + t(m + t(b + t c)), where t is the distance from the start of the interval.
#[derive(Debug, Clone)]
pub(super) struct Cubic {
    pub(super) start: Rational,
    /// y, m, b, c.
    pub(super) coefficients: [Rational; 4],
    /// The f64 nearest to the start and to the coefficients.
    near: [f64; 5],
}

impl Cubic {
    pub(super) fn new(start: Rational, coefficients: [Rational; 4]) -> Self {
        let [y, m, b, c] = &coefficients;
        let near = [&start, y, m, b, c].map(nearest);
        Cubic { start, coefficients, near }
    }

    /// The value by direct evaluation.
    pub(super) fn value<N: Number>(&self, input: &N) -> N {
        let [start, y, m, b, c] = self.near.map(N::near);
        let t = input.sub(&start);
        y.add(&t.mul(&m.add(&t.mul(&b.add(&t.mul(&c))))))
    }
}

/// Slopes at the points; `x` rises. `periodic`: the last point is the first again.
pub(super) fn slopes(x: &[Rational], y: &[Rational], periodic: bool) -> Vec<Rational> {
    let last = x.len() - 1;
    let widths: Vec<Rational> = (0..last).map(|i| &x[i + 1] - &x[i]).collect();
    let secants: Vec<Rational> = (0..last).map(|i| (&y[i + 1] - &y[i]) / &widths[i]).collect();
    let between = |left: usize, right: usize| {
        let (a, b) = (&secants[left], &secants[right]);
        let (wa, wb) = (&widths[left], &widths[right]);
        limited((a * wb + b * wa) / (wa + wb), a, b)
    };
    // The slope at the end of the parabola through the three points at an end.
    let end = |near: usize, far: usize| {
        let (a, b) = (&secants[near], &secants[far]);
        let (wa, wb) = (&widths[near], &widths[far]);
        limited(a + (a - b) * wa / (wa + wb), a, a)
    };
    (0..=last)
        .map(|i| match i {
            _ if last == 1 && !periodic => secants[0].clone(),
            0 if periodic => between(last - 1, 0),
            0 => end(0, 1),
            i if i == last && periodic => between(last - 1, 0),
            i if i == last => end(last - 1, last - 2),
            i => between(i - 1, i),
        })
        .collect()
}

fn limited(slope: Rational, a: &Rational, b: &Rational) -> Rational {
    let three = Rational::from(3);
    let most = three * a.abs().min(b.abs());
    let fine = a.signum() == b.signum() && slope.signum() == a.signum();
    match fine {
        false => Rational::zero(),
        true if slope.abs() <= most => slope,
        true => most * a.signum(),
    }
}

/// The cubics between the points.
pub(super) fn cubics(x: &[Rational], y: &[Rational], slopes: &[Rational]) -> Vec<Cubic> {
    let two = Rational::from(2);
    let three = Rational::from(3);
    (0..x.len() - 1)
        .map(|i| {
            let width = &x[i + 1] - &x[i];
            let secant = (&y[i + 1] - &y[i]) / &width;
            let (m0, m1) = (&slopes[i], &slopes[i + 1]);
            let b = (&three * &secant - &two * m0 - m1) / &width;
            let c = (m0 + m1 - &two * &secant) / (&width * &width);
            Cubic::new(x[i].clone(), [y[i].clone(), m0.clone(), b, c])
        })
        .collect()
}
