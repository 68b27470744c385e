//! Slopes at the rows of a table, of cubics between them that are monotone wherever the rows are: of tables of laws with exact
//! numbers, of tables of loads with floating ones.
//!
//! The slope at a row is that of the parabola through it and its neighbours, limited to what keeps every
//! interval monotone: zero between secants of different signs, else at most three times the flatter secant
//! (the square region of Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980) 238–246). Where the limit does
//! not bind, values are of third order in the distance of the rows; it binds next to a largest or smallest value that is
//! between two rows, where they are of second order.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// What slopes are computed with.
pub trait Number:
    Clone
    + PartialOrd
    + From<i32>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
}

impl<N> Number for N where
    N: Clone
        + PartialOrd
        + From<i32>
        + Add<Output = N>
        + Sub<Output = N>
        + Mul<Output = N>
        + Div<Output = N>
        + Neg<Output = N>
{
}

/// Slopes at two rows or more; `x` rises. `periodic`: the last row is the first again.
///
/// # Panics
/// Fewer than two rows.
pub fn slopes<N: Number>(x: &[N], y: &[N], periodic: bool) -> Vec<N> {
    let last = x.len() - 1;
    let differences = |of: &[N]| -> Vec<N> {
        of.windows(2).map(|pair| pair[1].clone() - pair[0].clone()).collect()
    };
    let (widths, rises) = (differences(x), differences(y));
    let secants = rises.into_iter().zip(&widths).map(|(rise, width)| rise / width.clone());
    let secants: Vec<N> = secants.collect();
    let at = |interval: usize| (secants[interval].clone(), widths[interval].clone());
    let between = |left: usize, right: usize| {
        let ((a, wa), (b, wb)) = (at(left), at(right));
        let slope = (a.clone() * wb.clone() + b.clone() * wa.clone()) / (wa + wb);
        limited(slope, a, b)
    };
    // The slope at the end of the parabola through the three rows at an end.
    let end = |near: usize, far: usize| {
        let ((a, wa), (b, wb)) = (at(near), at(far));
        let slope = a.clone() + (a.clone() - b) * wa.clone() / (wa + wb);
        limited(slope, a.clone(), a)
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

/// A slope between intervals with the secants `a` and `b`.
fn limited<N: Number>(slope: N, a: N, b: N) -> N {
    let zero = || N::from(0);
    let size = |own: N| if own < zero() { -own } else { own };
    let rises = slope > zero() && a > zero() && b > zero();
    let falls = slope < zero() && a < zero() && b < zero();
    if !rises && !falls {
        return zero();
    }
    let (a, b) = (size(a), size(b));
    let most = N::from(3) * if b < a { b } else { a };
    match (size(slope.clone()) <= most, rises) {
        (true, _) => slope,
        (false, true) => most,
        (false, false) => -most,
    }
}

#[cfg(test)]
mod tests {
    use super::slopes;

    #[test]
    fn slopes_are_those_of_parabolas_within_the_limit() {
        // x² at uneven rows: 2x where nothing limits; the secant from 0 to 1 is 1, and that of (0, 4) 4.
        let x = [0.0, 1.0, 3.0, 4.0];
        assert_eq!(slopes(&x, &x.map(|x| x * x), false), [0.0, 2.0, 6.0, 8.0]);
        assert_eq!(slopes(&x, &x.map(|x| -x * x), false), [0.0, -2.0, -6.0, -8.0]);
        // Between secants of different signs, and beside a level piece, there is no slope.
        assert_eq!(
            slopes(&x, &[0.0, 1.0, 1.0, 0.0], false),
            [1.0 + 1.0 / 3.0, 0.0, 0.0, -1.0 - 1.0 / 3.0]
        );
        // At most three times the flatter secant, with its sign.
        for sign in [1.0, -1.0] {
            let y = [0.0, 1.0, 9.0, 109.0].map(|y| sign * y);
            assert_eq!(slopes(&[0.0, 1.0, 2.0, 3.0], &y, false)[1..3], [sign * 3.0, sign * 24.0]);
        }
        assert_eq!(slopes(&[1.0, 3.0], &[2.0, 8.0], false), [3.0, 3.0]);
        assert_eq!(slopes(&[1.0, 3.0], &[2.0, 2.0], true), [0.0, 0.0]);
    }

    #[test]
    fn the_ends_of_a_periodic_table_are_one_row() {
        let x = [0.0, 1.0, 2.0, 4.0];
        let found = slopes(&x, &[1.0, 2.0, 0.0, 1.0], true);
        // Secants of 1/2 over a width of 2, and of 1 over a width of 1.
        assert_eq!(found, [5.0 / 6.0, 0.0, 0.0, 5.0 / 6.0]);
    }
}
