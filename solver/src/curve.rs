//! Curves through the rows of a table: straight lines, or cubics with a continuous slope; periodic or not.

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
}

impl Curve {
    /// Straight lines through rows (x, y).
    ///
    /// # Errors
    /// As [`Curve::smooth`].
    pub fn linear(rows: &[[f64; 2]], periodic: bool) -> Result<Curve, Error> {
        check(rows, periodic)?;
        let column = |k: usize| rows.iter().map(|row| row[k]).collect();
        Ok(Curve { x: column(0), y: column(1), slopes: None, periodic })
    }

    /// Cubics through rows (x, y) with a continuous slope: at a row that of the parabola through it and its neighbours, so
    /// that values are of third order in the distance of the rows at least.
    ///
    /// # Errors
    /// Fewer than two rows, x that does not rise, values that are no numbers; a periodic curve that does not end with the
    /// value with which it begins.
    pub fn smooth(rows: &[[f64; 2]], periodic: bool) -> Result<Curve, Error> {
        let curve = Curve::linear(rows, periodic)?;
        let slopes = slopes(&curve.x, &curve.y, periodic);
        Ok(Curve { slopes: Some(slopes), ..curve })
    }

    /// The last x, beyond which the curve stays as it is; none of a periodic one.
    pub(crate) fn last(&self) -> Option<f64> {
        self.x.last().copied().filter(|_| !self.periodic)
    }

    /// The last x at which y falls through zero, or comes to it.
    pub(crate) fn last_fall(&self) -> Option<f64> {
        let falls = |row: &usize| self.y[*row] > 0.0 && self.y[row + 1] <= 0.0;
        let row = (0..self.x.len() - 1).rev().find(falls)?;
        let share = self.y[row] / (self.y[row] - self.y[row + 1]);
        Some(self.x[row] + share * (self.x[row + 1] - self.x[row]))
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

fn slopes(x: &[f64], y: &[f64], periodic: bool) -> Vec<f64> {
    let last = x.len() - 1;
    let width = |i: usize| x[i + 1] - x[i];
    let secant = |i: usize| (y[i + 1] - y[i]) / width(i);
    // Of the parabola through three rows, in the middle and at an end.
    let middle =
        |i: usize, j: usize| (secant(i) * width(j) + secant(j) * width(i)) / (width(i) + width(j));
    let end = |near: usize, far: usize| {
        secant(near) + (secant(near) - secant(far)) * width(near) / (width(near) + width(far))
    };
    let slope = |i: usize| match i {
        _ if last == 1 => {
            if periodic {
                0.0
            } else {
                secant(0)
            }
        }
        i if periodic && (i == 0 || i == last) => middle(last - 1, 0),
        0 => end(0, 1),
        i if i == last => end(last - 1, last - 2),
        i => middle(i - 1, i),
    };
    (0..=last).map(slope).collect()
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
    fn a_smooth_curve_is_of_third_order_and_has_a_continuous_slope() {
        let errors = [40, 80].map(|count| {
            let curve = Curve::smooth(&rows(count), true).expect("a curve");
            (0..1000).fold(0.0, |most: f64, i| {
                let x = -7.0 + 0.02 * f64::from(i);
                most.max((curve.value(x) - (x + 0.3).sin()).abs())
            })
        });
        assert!(errors[0] < 1e-3 && errors[0] / errors[1] > 7.0, "{errors:?}");
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
