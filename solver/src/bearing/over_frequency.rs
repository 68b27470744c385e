//! Stiffness and damping in the plane over the speed of a journal and the frequency with which it moves, as programs for seals
//! print them.

use crate::curve::Curve;
use crate::error::Error;

/// k_xx, k_xy, k_yx, k_yy (N/m), c_xx, c_xy, c_yx, c_yy (N·s/m): minus the force on the journal along the first axis by motion
/// along the second.
pub type Coefficients = [f64; 8];

/// What the second coordinate of a [`FrequencyTable`] is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OverWhat {
    /// The frequency of the motion (rad/s).
    Frequency,
    /// That frequency over the speed, whatever its sign.
    Ratio,
}

/// Coefficients on a grid of speeds and frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct FrequencyTable {
    speeds: Vec<f64>,
    over: OverWhat,
    columns: Vec<f64>,
    /// By columns, in each by speeds.
    values: Vec<Vec<Coefficients>>,
}

/// Coefficients over the frequency, at one speed.
#[derive(Debug, Clone, PartialEq)]
pub struct OverFrequency {
    frequencies: Vec<f64>,
    rows: Vec<Coefficients>,
    curves: Option<Vec<Curve>>,
    /// Those of what stands still.
    still: Coefficients,
}

impl FrequencyTable {
    /// `speeds` (rad/s) and `columns`, frequencies (rad/s) or ratios from zero on, both rising and two at least; `values` by
    /// columns, in each by speeds.
    ///
    /// # Errors
    /// Anything else.
    pub fn new(
        speeds: Vec<f64>,
        (over, columns): (OverWhat, Vec<f64>),
        values: Vec<Vec<Coefficients>>,
    ) -> Result<FrequencyTable, Error> {
        let rises = |own: &[f64]| own.len() >= 2 && own.windows(2).all(|pair| pair[0] < pair[1]);
        let is_full =
            values.len() == columns.len() && values.iter().all(|own| own.len() == speeds.len());
        let numbers = values.iter().flatten().flatten().chain(&speeds).chain(&columns);
        if !rises(&speeds) || !rises(&columns) || columns[0] < 0.0 || !is_full {
            let what = "a table over speed and frequency is no rising grid";
            return Err(Error::Machine(what.to_owned()));
        }
        if !numbers.into_iter().all(|own| own.is_finite()) {
            let what = "a table over speed and frequency has values that are no numbers";
            return Err(Error::Machine(what.to_owned()));
        }
        Ok(FrequencyTable { speeds, over, columns, values })
    }

    /// The coefficients over the frequency at a speed (rad/s): monotone cubics over the speed in every column; beyond the rows
    /// those of the nearest. Ratios have no meaning at rest: what moves there is beyond them all.
    ///
    /// # Errors
    /// None of a table that was made.
    pub fn at_speed(&self, speed: f64) -> Result<OverFrequency, Error> {
        let at = |column: &Vec<Coefficients>| -> Result<Coefficients, Error> {
            let mut found = [0.0; 8];
            for (place, found) in found.iter_mut().enumerate() {
                let rows = self.speeds.iter().zip(column).map(|(x, own)| [*x, own[place]]);
                *found = Curve::smooth(&rows.collect::<Vec<_>>(), false)?.value(speed);
            }
            Ok(found)
        };
        let rows = self.values.iter().map(at).collect::<Result<Vec<_>, Error>>()?;
        let still = rows[0];
        let frequencies = match self.over {
            OverWhat::Frequency => self.columns.clone(),
            OverWhat::Ratio => self.columns.iter().map(|own| own * speed.abs()).collect(),
        };
        if frequencies[0] == frequencies[frequencies.len() - 1] {
            let rows = vec![rows[rows.len() - 1]];
            return Ok(OverFrequency { frequencies: vec![0.0], rows, curves: None, still });
        }
        let curve = |place: usize| {
            let points = frequencies.iter().zip(&rows).map(|(x, own)| [*x, own[place]]);
            Curve::smooth(&points.collect::<Vec<_>>(), false)
        };
        let curves = Some((0..8).map(curve).collect::<Result<Vec<_>, Error>>()?);
        Ok(OverFrequency { frequencies, rows, curves, still })
    }
}

impl OverFrequency {
    /// The frequencies of its rows (rad/s), rising.
    pub fn frequencies(&self) -> &[f64] {
        &self.frequencies
    }

    /// The coefficients of what stands still: those of the first row.
    pub fn still(&self) -> Coefficients {
        self.still
    }

    /// The coefficients at a frequency (rad/s), backward as forward: monotone cubics; beyond the rows those of the nearest.
    pub fn at(&self, frequency: f64) -> Coefficients {
        let frequency = frequency.abs();
        match &self.curves {
            Some(curves) => std::array::from_fn(|place| curves[place].value(frequency)),
            None => self.rows[0],
        }
    }

    /// Whether a frequency is beyond the rows.
    pub fn is_beyond(&self, frequency: f64) -> bool {
        let frequency = frequency.abs();
        self.curves.is_none()
            || frequency < self.frequencies[0]
            || frequency > self.frequencies[self.frequencies.len() - 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(over: OverWhat) -> FrequencyTable {
        let (speeds, columns) = (vec![100.0, 200.0, 400.0], vec![0.0, 1.0, 3.0]);
        let value =
            |column: f64, speed: f64| std::array::from_fn(|k| speed + 10.0 * column + k as f64);
        let values = columns.iter().map(|&own| speeds.iter().map(|&x| value(own, x)).collect());
        let values = values.collect();
        FrequencyTable::new(speeds, (over, columns), values).expect("a grid")
    }

    /// Straight data are met between the rows, and the nearest row holds beyond them.
    #[test]
    fn values_are_met_between_the_rows_and_held_beyond() {
        let own = table(OverWhat::Frequency).at_speed(250.0).expect("rows");
        for (frequency, expected) in [(0.0, 250.0), (2.0, 270.0), (-2.0, 270.0), (9.0, 280.0)] {
            let found = own.at(frequency);
            assert!((found[0] - expected).abs() < 1e-9, "{frequency}: {found:?}");
            assert!((found[7] - expected - 7.0).abs() < 1e-9, "{frequency}: {found:?}");
        }
        assert!(own.is_beyond(3.1) && !own.is_beyond(3.0));
        let slow = table(OverWhat::Frequency).at_speed(5.0).expect("rows");
        assert!((slow.at(1.0)[0] - 110.0).abs() < 1e-9);
    }

    /// Ratios count by the speed, whatever its sense; at rest every motion is beyond them.
    #[test]
    fn ratios_are_those_of_the_speed() {
        let own = table(OverWhat::Ratio).at_speed(250.0).expect("rows");
        assert!((own.at(500.0)[0] - 270.0).abs() < 1e-9);
        assert_eq!(own.still()[0], own.at(0.0)[0]);
        let rest = table(OverWhat::Ratio).at_speed(0.0).expect("rows");
        assert_eq!((rest.still()[0], rest.at(0.0)[0]), (100.0, 130.0));
        assert!(rest.is_beyond(0.0));
    }

    #[test]
    fn what_is_no_grid_is_refused() {
        let of = |speeds: &[f64], columns: &[f64], rows: usize| {
            let values = vec![vec![[1.0; 8]; rows]; columns.len()];
            let own = (OverWhat::Frequency, columns.to_vec());
            FrequencyTable::new(speeds.to_vec(), own, values).is_err()
        };
        assert!(!of(&[1.0, 2.0], &[0.0, 1.0], 2));
        assert!(of(&[1.0, 1.0], &[0.0, 1.0], 2));
        assert!(of(&[1.0], &[0.0, 1.0], 1));
        assert!(of(&[1.0, 2.0], &[-1.0, 1.0], 2));
        assert!(of(&[1.0, 2.0], &[0.0, 1.0], 3));
        assert!(of(&[1.0, f64::INFINITY], &[0.0, 1.0], 2));
    }
}
