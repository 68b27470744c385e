//! What goes by the angle: charts over the last revolutions, row by row.

use std::f64::consts::TAU;

use serde::Serialize;

use super::encode::Packed;

/// Revolutions that are kept, and points at most.
const REVOLUTIONS: f64 = 2.0;
const POINTS: usize = 2000;

/// A chart over the angle.
#[derive(Debug, Serialize)]
pub(super) struct Turned {
    /// The place of the chart over time that has the same columns.
    group: usize,
    /// Revolutions that the points span.
    revolutions: f64,
    /// Degrees before the end, and a column each.
    before: Packed,
    columns: Vec<Packed>,
}

impl Turned {
    /// Of columns and the angle (rad) of rows up to the end; none where it turns by less than half of a revolution.
    pub(super) fn of(group: usize, columns: &[&[f64]], angle: &[f64]) -> Option<Self> {
        let count = angle.len();
        let last = *angle.last()?;
        let before = |k: usize| (last - angle[k]).abs() / TAU;
        // A row that is a rounding error too early belongs to it.
        let from = (0..count).find(|k| before(*k) <= REVOLUTIONS * (1.0 + 1e-9))?;
        if before(from) < 0.5 {
            return None;
        }
        let every = (count - from).div_ceil(POINTS).max(1);
        // The last row is one of them.
        let mut places: Vec<usize> = (from..count).rev().step_by(every).collect();
        places.reverse();
        let pick = |all: &&[f64]| Packed::single(places.iter().map(|k| all[*k]));
        Some(Turned {
            group,
            revolutions: before(from),
            before: Packed::single(places.iter().map(|k| 360.0 * before(*k))),
            columns: columns.iter().map(pick).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_revolutions_are_kept() {
        for sense in [1.0, -1.0] {
            let angle: Vec<f64> = (0..=1000).map(|k| sense * TAU * f64::from(k) / 100.0).collect();
            let x: Vec<f64> = (0..=1000).map(f64::from).collect();
            let own = Turned::of(3, &[&x], &angle).expect("it turns");
            assert!((own.revolutions - 2.0).abs() < 1e-12 && own.group == 3);
            assert_eq!(own.columns[0], Packed::single(x[800..].iter().copied()));
        }
        assert!(Turned::of(0, &[&[1.0, 2.0]], &[0.0, 1.0]).is_none());
        assert!(Turned::of(0, &[&[]], &[]).is_none());
    }
}
