//! Monotone cubics through points, exactly; their slopes are those of `whirl_slopes`.

use crate::operation::Number;
use crate::rational::{Rational, nearest};

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
