//! Curves through the rows of a table: straight lines, or monotone cubics with a continuous slope; periodic or not.

use num_complex::Complex64;

use crate::error::Error;

/// Rows of a table, and what lies between them. Beyond the first and the last row a curve stays at their values, unless it
/// is periodic.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    x: Vec<f64>,
    y: Vec<f64>,
    /// dy/dx at the rows; none of straight lines.
    slopes: Option<Vec<f64>>,
    /// The first and the last row are one.
    periodic: bool,
    /// The largest |y| of a row.
    largest: f64,
}

/// Points of a cubic that count as rows do, from row to row: of one that rises from 0 to 1 and is level at both ends, the lines
/// between them are off by 1.2 % at most.
const EIGHTHS: usize = 8;

/// Part of the values at a row and at both ends of a step by which the row may lie off the straight line between the ends:
/// between 23 values in a period of a sine lies (2π/23)²/8 of its amplitude.
const RESOLVED: f64 = 0.01;
/// The same of the largest value of all, below which it is of no account.
const NEGLIGIBLE: f64 = 1e-3;

impl Curve {
    /// Straight lines through rows (x, y).
    ///
    /// # Errors
    /// As [`Curve::smooth`].
    pub fn linear(rows: &[[f64; 2]], periodic: bool) -> Result<Curve, Error> {
        check(rows, periodic)?;
        let column = |k: usize| rows.iter().map(|row| row[k]).collect();
        let largest = rows.iter().fold(0.0, |most: f64, row| most.max(row[1].abs()));
        Ok(Curve { x: column(0), y: column(1), slopes: None, periodic, largest })
    }

    /// Cubics through rows (x, y) with a continuous slope, monotone wherever the rows are: see `whirl_slopes`.
    ///
    /// # Errors
    /// Fewer than two rows, x that does not rise, values that are no numbers; a periodic curve that does not end with the
    /// value with which it begins.
    pub fn smooth(rows: &[[f64; 2]], periodic: bool) -> Result<Curve, Error> {
        let curve = Curve::linear(rows, periodic)?;
        let slopes = whirl_slopes::slopes(&curve.x, &curve.y, periodic);
        Ok(Curve { slopes: Some(slopes), ..curve })
    }

    /// The x beyond which y stays as it is; none of a periodic one.
    pub(crate) fn last_change(&self) -> Option<f64> {
        let last = self.y.last().filter(|_| !self.periodic)?;
        let changing = self.y.iter().rposition(|own| own != last);
        Some(self.x[changing.map_or(0, |row| row + 1)])
    }

    /// Whether y is the same everywhere.
    pub(crate) fn is_constant(&self) -> bool {
        self.y.windows(2).all(|pair| pair[0] == pair[1])
    }

    /// The last x at which y falls through zero, or comes to it.
    pub(crate) fn last_fall(&self) -> Option<f64> {
        let falls = |row: &usize| self.y[*row] > 0.0 && self.y[row + 1] <= 0.0;
        let row = (0..self.x.len() - 1).rev().find(falls)?;
        let share = self.y[row] / (self.y[row] - self.y[row + 1]);
        Some(self.x[row] + share * (self.x[row + 1] - self.x[row]))
    }

    /// After which x it is periodic, if it is.
    pub(crate) fn period(&self) -> Option<f64> {
        self.periodic.then(|| self.x[self.x.len() - 1] - self.x[0])
    }

    /// Points between two x, in the order of their x: rows, and of cubics eighths between them, those of whole periods again and
    /// again; none where there is a period between the two or more, which no point could mend.
    pub(crate) fn between_ends(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
        let (least, most) = (from.min(to), from.max(to));
        let period = self.period();
        let shows = period.is_none_or(|period| most - least < period);
        let first = period.map_or(0.0, |period| ((least - self.x[0]) / period).floor());
        let parts = if self.slopes.is_some() { EIGHTHS } else { 1 };
        let last = (self.x.len() - 1) * parts;
        let periods = if self.periodic { 2 } else { 1 };
        let moved = (0..if shows { periods } else { 0 }).flat_map(move |k| {
            let by = period.map_or(0.0, |period| (first + f64::from(k)) * period);
            let [start, end] = [least, most].map(|x| self.x.partition_point(|own| own + by <= x));
            // The first row of a periodic curve is the last one of the period before.
            let points = (start.saturating_sub(1) * parts).max(usize::from(self.periodic));
            (points..=(end * parts).min(last)).map(move |point| {
                let [x, y] = self.point(point / parts, point % parts);
                [x + by, y]
            })
        });
        moved.filter(move |[x, _]| *x > least && *x < most)
    }

    /// So many eighths of the way behind a row.
    fn point(&self, row: usize, eighths: usize) -> [f64; 2] {
        if eighths == 0 {
            return [self.x[row], self.y[row]];
        }
        let part = eighths as f64 / EIGHTHS as f64;
        let x = self.x[row] + part * (self.x[row + 1] - self.x[row]);
        [x, self.between(row, x)[0]]
    }

    /// Whether a straight line between two x stays so close to the points between them that nothing of the curve is lost; of values
    /// far smaller than others of the curve nothing is.
    pub(crate) fn is_resolved(&self, [from, to]: [f64; 2]) -> bool {
        let mut points = self.between_ends([from, to]).peekable();
        if points.peek().is_none() {
            return true;
        }
        let [start, end] = [from, to].map(|x| self.value(x));
        let (mut size, mut off) = (start.abs().max(end.abs()), 0.0_f64);
        for [x, y] in points {
            size = size.max(y.abs());
            off = off.max((y - start - (end - start) * ((x - from) / (to - from))).abs());
        }
        off <= f64::max(RESOLVED * size, NEGLIGIBLE * self.largest)
    }

    /// x of the end beyond which y goes on driving x away from 0, where there is one: positive beyond the last x, else
    /// negative before the first.
    pub(crate) fn driven_end(&self) -> Option<f64> {
        let last = self.x.len() - 1;
        if self.y[last] > 0.0 && self.x[last] > 0.0 {
            return Some(self.x[last]);
        }
        (self.y[0] < 0.0 && self.x[0] < 0.0).then_some(self.x[0])
    }

    /// y at x.
    pub fn value(&self, x: f64) -> f64 {
        match self.piece(x) {
            Piece::End(row) => self.y[row],
            Piece::Between(row, x) => self.between(row, x)[0],
        }
    }

    /// dy/dx at x; between two straight lines that of the second.
    pub fn slope(&self, x: f64) -> f64 {
        match self.piece(x) {
            Piece::End(_) => 0.0,
            Piece::Between(row, x) => self.between(row, x)[1],
        }
    }

    /// The mean over the rows.
    pub(crate) fn mean(&self) -> f64 {
        let whole: f64 = (0..self.x.len() - 1)
            .map(|row| {
                let width = self.x[row + 1] - self.x[row];
                let bent = self.slopes.as_ref().map_or(0.0, |own| own[row] - own[row + 1]);
                width * (0.5 * (self.y[row] + self.y[row + 1]) + width * bent / 12.0)
            })
            .sum();
        whole / (self.x[self.x.len() - 1] - self.x[0])
    }

    /// (1/P) ∫ y e^{−iωx} dx over the period P, of which ω > 0 is a multiple: exact. By parts what is left of it are the jumps of the
    /// derivatives at the rows, each over a power of iω.
    pub(crate) fn harmonic(&self, omega: f64) -> Complex64 {
        let last = self.x.len() - 1;
        let by = Complex64::new(0.0, omega).inv();
        let mut sum = Complex64::ZERO;
        for row in 0..last {
            // The first row is the last one, a period later.
            let before = self.derivatives(if row == 0 { last } else { row } - 1)[1];
            let behind = self.derivatives(row)[0];
            let mut jumps = Complex64::ZERO;
            for order in (0..3).rev() {
                jumps = (jumps + (behind[order] - before[order])) * by;
            }
            sum += jumps * by * Complex64::from_polar(1.0, -omega * self.x[row]);
        }
        sum / (self.x[last] - self.x[0])
    }

    /// First, second and third derivative of the piece behind a row, at both of its ends.
    fn derivatives(&self, row: usize) -> [[f64; 3]; 2] {
        let width = self.x[row + 1] - self.x[row];
        let secant = (self.y[row + 1] - self.y[row]) / width;
        let Some(slopes) = &self.slopes else { return [[secant, 0.0, 0.0]; 2] };
        let (m0, m1) = (slopes[row], slopes[row + 1]);
        let b = (3.0 * secant - 2.0 * m0 - m1) / width;
        let c = (m0 + m1 - 2.0 * secant) / (width * width);
        [[m0, 2.0 * b, 6.0 * c], [m1, 2.0 * b + 6.0 * c * width, 6.0 * c]]
    }

    fn piece(&self, x: f64) -> Piece {
        let (first, last) = (self.x[0], self.x[self.x.len() - 1]);
        let x = if self.periodic { first + (x - first).rem_euclid(last - first) } else { x };
        // What is no number is in the first piece, and makes its value one, too.
        if x < first {
            Piece::End(0)
        } else if x > last {
            Piece::End(self.x.len() - 1)
        } else {
            let after = self.x.partition_point(|own| *own <= x);
            Piece::Between(after.clamp(1, self.x.len() - 1) - 1, x)
        }
    }

    /// Value and slope in the piece after a row.
    fn between(&self, row: usize, x: f64) -> [f64; 2] {
        let width = self.x[row + 1] - self.x[row];
        let t = x - self.x[row];
        let secant = (self.y[row + 1] - self.y[row]) / width;
        let Some(slopes) = &self.slopes else { return [self.y[row] + secant * t, secant] };
        let (m0, m1) = (slopes[row], slopes[row + 1]);
        let b = (3.0 * secant - 2.0 * m0 - m1) / width;
        let c = (m0 + m1 - 2.0 * secant) / (width * width);
        [self.y[row] + t * (m0 + t * (b + t * c)), m0 + t * (2.0 * b + 3.0 * t * c)]
    }
}

/// Where x is.
enum Piece {
    /// Before the first row or after the last one.
    End(usize),
    /// After a row, x within the rows.
    Between(usize, f64),
}

/// How far the ends of a periodic curve may be apart, as a part of its largest value: rounding of its digits.
const CLOSED: f64 = 1e-9;

fn check(rows: &[[f64; 2]], periodic: bool) -> Result<(), Error> {
    let wrong = |what: &str| Err(Error::Machine(format!("a table {what}")));
    if rows.len() < 2 {
        return wrong("has two rows at least");
    }
    if rows.iter().flatten().any(|value| !value.is_finite()) {
        return wrong("has values that are no numbers");
    }
    if rows.windows(2).any(|pair| pair[1][0] <= pair[0][0]) {
        return wrong("rises in its first column");
    }
    let largest = rows.iter().fold(0.0, |most: f64, row| most.max(row[1].abs()));
    if periodic && (rows[rows.len() - 1][1] - rows[0][1]).abs() > CLOSED * largest {
        return wrong("that is periodic ends with the value with which it begins");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn rows(count: usize) -> Vec<[f64; 2]> {
        // Unevenly, from 0 to 2π.
        let x = |i: usize| {
            let u = i as f64 / count as f64;
            TAU * (u + 0.05 * (TAU * u).sin())
        };
        (0..=count).map(|i| [x(i), (x(i) + 0.3).sin()]).collect()
    }

    #[test]
    fn a_smooth_curve_is_of_third_order_but_at_extremes_and_has_a_continuous_slope() {
        // Everywhere; and where no extreme is near, whose intervals reach to π/10 at most.
        let errors = [40, 80].map(|count| {
            let curve = Curve::smooth(&rows(count), true).expect("a curve");
            let error = |most: [f64; 2], i: i32| {
                let x = -7.0 + 0.02 * f64::from(i);
                let error = (curve.value(x) - (x + 0.3).sin()).abs();
                let far = f64::from((x + 0.3).cos().abs() > 0.6);
                [most[0].max(error), most[1].max(far * error)]
            };
            (0..1000).fold([0.0; 2], error)
        });
        // With rows at most 1.3 · 2π/40 apart: a slope of no more than that, times 4/27 of that, at an extreme.
        assert!(errors[0][0] < 4.0 / 27.0 * (1.3_f64 * TAU / 40.0).powi(2), "{errors:?}");
        assert!(errors[0][0] / errors[1][0] > 3.0, "{errors:?}");
        assert!(errors[0][1] < 2e-4 && errors[0][1] / errors[1][1] > 7.0, "{errors:?}");
        let rows = rows(40);
        let curve = Curve::smooth(&rows, true).expect("a curve");
        for [x, y] in &rows {
            assert!((curve.value(*x) - y).abs() < 1e-12);
            let [left, right] = [-1e-9, 1e-9].map(|h| curve.slope(x + h));
            assert!((left - right).abs() < 1e-6, "{x}");
            let difference = (curve.value(x + 1e-5) - curve.value(x - 1e-5)) / 2e-5;
            assert!((curve.slope(*x) - difference).abs() < 1e-5, "{x}");
        }
    }

    /// Whatever the distance of the rows: no value lies beyond those of the rows on both sides of it.
    #[test]
    fn a_smooth_curve_is_monotone_between_its_rows() {
        let degrees: Vec<f64> =
            (0..18).map(|i| 20.0 * f64::from(i)).chain([360.0, 420.0]).collect();
        let even = degrees.iter().chain(&[440.0, 700.0, 720.0]);
        let peak: Vec<[f64; 2]> = even.map(|x| [*x, if *x == 360.0 { 1e4 } else { 0.0 }]).collect();
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut at = 0.0;
        let mut uneven = vec![[0.0, 0.5]];
        for _ in 0..60 {
            at += random().powi(6) + 1e-6;
            uneven.push([at, random()]);
        }
        let first = [at + 0.5, 0.5];
        uneven.push(first);
        for (rows, periodic) in [(&peak, false), (&peak, true), (&uneven, false), (&uneven, true)] {
            let curve = Curve::smooth(rows, periodic).expect("a curve");
            for pair in rows.windows(2) {
                let (least, most) = (pair[0][1].min(pair[1][1]), pair[0][1].max(pair[1][1]));
                for part in 1..50 {
                    let x = pair[0][0] + (pair[1][0] - pair[0][0]) * f64::from(part) / 50.0;
                    let y = curve.value(x);
                    let rounding = 1e-12 * most.abs().max(least.abs());
                    assert!(y >= least - rounding && y <= most + rounding, "{x}: {y}");
                }
            }
        }
        let zero = Curve::smooth(&peak, true).expect("a curve");
        assert_eq!([227.0, 100.0, 500.0].map(|x| zero.value(x)), [0.0; 3]);
    }

    #[test]
    fn rows_within_a_step_are_found_in_every_period_and_either_way() {
        let rows = [[1.0, 0.0], [2.0, 5.0], [4.0, 0.0]];
        let found = |curve: &Curve, ends| curve.between_ends(ends).collect::<Vec<_>>();
        let once = Curve::linear(&rows, false).expect("a curve");
        assert_eq!(found(&once, [1.0, 4.0]), [[2.0, 5.0]]);
        assert_eq!(found(&once, [9.0, 1.5]), [[2.0, 5.0], [4.0, 0.0]]);
        let again = Curve::linear(&rows, true).expect("a curve");
        assert_eq!(found(&again, [3.0, 5.5]), [[4.0, 0.0], [5.0, 5.0]]);
        assert_eq!(found(&again, [-4.5, -6.5]), [[-5.0, 0.0]]);
        assert_eq!(found(&again, [-4.5, -7.2]), [[-7.0, 5.0], [-5.0, 0.0]]);
        assert_eq!(found(&again, [0.0, 3.0]), [[0.0; 2]; 0]);
    }

    #[test]
    fn what_a_line_misses_is_not_resolved() {
        let rows = [[0.0, 0.0], [1.0, 0.0], [1.01, 8.0], [1.02, 0.0], [2.0, 100.0], [9.0, 100.0]];
        let curve = Curve::linear(&rows, false).expect("a curve");
        // A pulse between two zeros; a slope that changes; a corner that is cut by 8 % of what is there, and by less.
        assert!(!curve.is_resolved([0.5, 1.02]) && !curve.is_resolved([1.02, 0.5]));
        assert!(curve.is_resolved([1.1, 1.9]));
        assert!(!curve.is_resolved([1.8, 2.2]) && curve.is_resolved([1.99, 2.01]));
        // 0.4 % of what is there; 10 % of what is there, which is 0.05 % of the largest.
        let rows = [[0.0, 1.0], [1.0, 1.0], [2.0, 1.02], [3.0, 0.0], [4.0, 0.1], [5.0, 200.0]];
        let curve = Curve::linear(&rows, false).expect("a curve");
        assert!(curve.is_resolved([0.0, 1.5]) && curve.is_resolved([2.9, 3.5]));
    }

    #[test]
    fn beyond_its_rows_a_curve_stays_as_it_is() {
        let curve = Curve::linear(&[[1.0, 2.0], [3.0, 6.0], [4.0, 5.0]], false).expect("a curve");
        let values = [0.0, 1.0, 2.0, 3.5, 4.0, 9.0].map(|x| (curve.value(x), curve.slope(x)));
        assert_eq!(
            values,
            [(2.0, 0.0), (2.0, 2.0), (4.0, 2.0), (5.5, -1.0), (5.0, -1.0), (5.0, 0.0)]
        );
        assert!(curve.value(f64::NAN).is_nan());
    }

    #[test]
    fn rows_that_make_no_curve_are_refused() {
        for (rows, periodic) in [
            (vec![[0.0, 1.0]], false),
            (vec![[0.0, 1.0], [0.0, 2.0]], false),
            (vec![[0.0, 1.0], [1.0, f64::NAN]], false),
            (vec![[0.0, 1.0], [1.0, 2.0]], true),
        ] {
            assert!(Curve::smooth(&rows, periodic).is_err(), "{rows:?}");
        }
    }
}
