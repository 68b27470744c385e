//! Periodic cubic splines in angle: the bore moves at its mesh nodes, the springs stand between them.

use crate::linalg::{Lu, Matrix};

/// The linear map from values at `knots` (rad, in any order, distinct modulo 2π, at least three) to the
/// values at `angles` (rad) of the periodic cubic spline through them: angles × knots.
///
/// The spline has continuous first and second derivatives all around. `None` where two knots coincide or
/// there are fewer than three.
pub fn periodic_spline(knots: &[f64], angles: &[f64]) -> Option<Matrix> {
    let n = knots.len();
    if !spline_passes(knots) {
        return None;
    }
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| wrapped(knots[a]).total_cmp(&wrapped(knots[b])));
    let sorted: Vec<f64> = order.iter().map(|&knot| wrapped(knots[knot])).collect();
    let width = |i: usize| match i + 1 < n {
        true => sorted[i + 1] - sorted[i],
        false => sorted[0] + std::f64::consts::TAU - sorted[i],
    };
    let curvature = curvatures(n, width)?;
    let mut map = Matrix::zeros(angles.len(), n);
    for (row, &angle) in angles.iter().enumerate() {
        let angle = wrapped(angle);
        // The interval before the first knot is the end of the last one.
        let (i, from) = match sorted.partition_point(|&knot| knot <= angle) {
            0 => (n - 1, sorted[n - 1] - std::f64::consts::TAU),
            after => (after - 1, sorted[after - 1]),
        };
        let (next, w) = ((i + 1) % n, width(i));
        let b = (angle - from) / w;
        let a = 1.0 - b;
        map[(row, order[i])] += a;
        map[(row, order[next])] += b;
        let (bend, bend_next) = ((a * a * a - a) * w * w / 6.0, (b * b * b - b) * w * w / 6.0);
        for knot in 0..n {
            map[(row, order[knot])] +=
                bend * curvature[(i, knot)] + bend_next * curvature[(next, knot)];
        }
    }
    Some(map)
}

/// Whether a periodic spline goes through values at `knots` (rad, in any order): three at least, no two of which
/// coincide.
pub fn spline_passes(knots: &[f64]) -> bool {
    let mut sorted: Vec<f64> = knots.iter().map(|&angle| wrapped(angle)).collect();
    sorted.sort_by(f64::total_cmp);
    let around = sorted.first().map(|first| first + std::f64::consts::TAU);
    let next = sorted.iter().skip(1).copied().chain(around);
    knots.len() >= 3 && sorted.iter().zip(next).all(|(knot, next)| next - knot > 1e-9)
}

/// The same angle from 0 to 2π.
fn wrapped(angle: f64) -> f64 {
    angle.rem_euclid(std::f64::consts::TAU)
}

/// Second derivatives at the sorted knots from the values there: n × n.
fn curvatures(n: usize, width: impl Fn(usize) -> f64) -> Option<Matrix> {
    let mut system = Matrix::zeros(n, n);
    let mut values = Matrix::zeros(n, n);
    for i in 0..n {
        let (before, next) = ((i + n - 1) % n, (i + 1) % n);
        let (left, right) = (width(before), width(i));
        system[(i, before)] += left / 6.0;
        system[(i, i)] += (left + right) / 3.0;
        system[(i, next)] += right / 6.0;
        values[(i, before)] += 1.0 / left;
        values[(i, i)] -= 1.0 / left + 1.0 / right;
        values[(i, next)] += 1.0 / right;
    }
    let mut lu = Lu::new(n);
    lu.factor(&system.data).ok()?;
    lu.solve_in_place(&mut values.data);
    Some(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Uneven knots, not in order.
    const KNOTS: [f64; 7] = [2.9, 0.1, 0.9, 1.4, 3.6, 4.9, 5.8];

    fn at(angle: f64, values: &[f64]) -> f64 {
        periodic_spline(&KNOTS, &[angle]).expect("distinct knots").apply(values)[0]
    }

    #[test]
    fn it_passes_through_the_knots_and_keeps_constants() {
        let map = periodic_spline(&KNOTS, &KNOTS).expect("distinct knots");
        for i in 0..KNOTS.len() {
            for j in 0..KNOTS.len() {
                assert!((map[(i, j)] - f64::from(i == j)).abs() <= 1e-13);
            }
        }
        for angle in [-1.0, 0.0, 0.05, 2.0, 6.2, 9.0] {
            assert!((at(angle, &[1.0; 7]) - 1.0).abs() <= 1e-13);
        }
    }

    #[test]
    fn slope_and_curvature_are_continuous_all_around() {
        let values = [0.3, -1.0, 0.7, 0.2, 1.5, -0.4, 0.9];
        let step = 1e-4;
        for knot in KNOTS {
            let f = |shift: f64| at(knot + shift, &values);
            let second =
                |side: f64| (f(0.0) - 2.0 * f(side * step) + f(2.0 * side * step)) / (step * step);
            let first = |side: f64| {
                side * (-1.5 * f(0.0) + 2.0 * f(side * step) - 0.5 * f(2.0 * side * step)) / step
            };
            // One-sided differences are off by step times the third derivative, here below 100.
            assert!((first(1.0) - first(-1.0)).abs() <= 100.0 * step * step);
            assert!((second(1.0) - second(-1.0)).abs() <= 200.0 * step + 1e-6);
        }
    }

    #[test]
    fn a_smooth_function_is_met_with_fourth_order() {
        let error = |n: usize| {
            let knots: Vec<f64> =
                (0..n).map(|i| std::f64::consts::TAU * i as f64 / n as f64 + 0.2).collect();
            let values: Vec<f64> = knots.iter().map(|x| (2.0 * x).sin() + x.cos()).collect();
            let angles: Vec<f64> = (0..97).map(|i| 0.07 * f64::from(i)).collect();
            let map = periodic_spline(&knots, &angles).expect("distinct knots");
            let got = map.apply(&values);
            let want = angles.iter().map(|x| (2.0 * x).sin() + x.cos());
            got.iter().zip(want).fold(0.0_f64, |e, (a, b)| e.max((a - b).abs()))
        };
        let order = (error(24) / error(48)).log2();
        assert!((3.7..4.3).contains(&order), "measured order {order}");
    }

    #[test]
    fn knots_that_coincide_are_refused() {
        assert!(periodic_spline(&[0.0, 1.0, std::f64::consts::TAU], &[0.5]).is_none());
        assert!(periodic_spline(&[3.0, 0.5, 1.0, 3.0], &[0.5]).is_none());
        assert!(periodic_spline(&[0.0, 1.0], &[0.5]).is_none());
    }
}
