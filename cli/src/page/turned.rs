//! What goes by the angle: charts over the last revolutions, row by row.

use std::f64::consts::TAU;

use serde::Serialize;

use super::encode::Packed;

/// Revolutions that are kept, and points at most.
const REVOLUTIONS: f64 = 2.0;
const POINTS: usize = 2000;
/// How far a row may be from the revolution to which it belongs, as a part of that: angles are rounded.
const ROUNDING: f64 = 1e-9;

/// A chart over the angle.
#[derive(Debug, Serialize)]
pub(super) struct Turned {
    /// The place of the chart over time that has the same columns.
    group: usize,
    /// Revolutions that the points span.
    revolutions: f64,
    /// Degrees since the first keyphasor at or before the first point, and a column each.
    degrees: Packed,
    columns: Vec<Packed>,
}

impl Turned {
    /// Of columns and the angle (rad) of rows: the last revolutions that end with the keyphasor, θ a multiple of 360°, or of so many
    /// times that; none where it turns by less than half of a revolution.
    pub(super) fn of(group: usize, columns: &[&[f64]], angle: &[f64], times: f64) -> Option<Self> {
        let (first, last) = (*angle.first()?, *angle.last()?);
        let sense = (last - first).signum();
        let turns = |k: usize| sense * angle[k] / TAU;
        let whole = times * (turns(angle.len() - 1) / times + ROUNDING).floor();
        // A run of less than a revolution behind the keyphasor is shown as it is.
        let end = if whole - turns(0) >= 1.0 { whole } else { turns(angle.len() - 1) };
        let count = (0..angle.len()).rfind(|k| turns(*k) <= end + ROUNDING)? + 1;
        // A row that is a rounding error too early belongs to it.
        let from = (0..count).find(|k| end - turns(*k) <= REVOLUTIONS + ROUNDING)?;
        let revolutions = turns(count - 1) - turns(from);
        if revolutions < 0.5 {
            return None;
        }
        let base = (turns(from) + ROUNDING).floor();
        let every = (count - from).div_ceil(POINTS).max(1);
        // The last row is one of them.
        let mut places: Vec<usize> = (from..count).rev().step_by(every).collect();
        places.reverse();
        let pick = |all: &&[f64]| Packed::single(places.iter().map(|k| all[*k]));
        Some(Turned {
            group,
            revolutions,
            degrees: Packed::single(places.iter().map(|k| 360.0 * (turns(*k) - base))),
            columns: columns.iter().map(pick).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_revolutions_to_the_keyphasor_are_kept() {
        for sense in [1.0, -1.0] {
            // It ends a quarter of a revolution behind the keyphasor.
            let angle: Vec<f64> = (0..=1025).map(|k| sense * TAU * f64::from(k) / 100.0).collect();
            let x: Vec<f64> = (0..=1025).map(f64::from).collect();
            let degrees = |from: f64| Packed::single((0..=200).map(|k| from + 3.6 * f64::from(k)));
            let own = Turned::of(3, &[&x], &angle, 1.0).expect("it turns");
            assert!((own.revolutions - 2.0).abs() < 1e-9 && own.group == 3);
            assert_eq!(own.columns[0], Packed::single(x[800..=1000].iter().copied()));
            assert_eq!(own.degrees, degrees(0.0));
            // A cycle of two revolutions begins with one.
            let own = Turned::of(3, &[&x[..951]], &angle[..951], 2.0).expect("it turns");
            assert_eq!(own.columns[0], Packed::single(x[600..=800].iter().copied()));
        }
        let half: Vec<f64> = (0..=80).map(|k| TAU * f64::from(k) / 100.0).collect();
        let own = Turned::of(0, &[&half], &half, 1.0).expect("it turns");
        assert!((own.revolutions - 0.8).abs() < 1e-9);
        assert!(Turned::of(0, &[&[1.0, 2.0]], &[0.0, 1.0], 1.0).is_none());
        assert!(Turned::of(0, &[&[]], &[], 1.0).is_none());
    }
}
