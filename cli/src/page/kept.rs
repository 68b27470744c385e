//! Histories with no more points than a page can carry: all rows, or the least and the largest value of every few.

use serde::Serialize;

use super::encode::Packed;

/// Values of all columns together; half of them least ones where not all are kept.
const VALUES: usize = 180_000;
/// Points of a column, at least.
const LEAST: usize = 800;

/// Columns that are kept of a pass over the rows.
pub(super) struct Kept {
    /// Rows of a point.
    every: usize,
    count: usize,
    rows: u64,
    span: [f64; 2],
    times: Vec<f64>,
    /// A column each.
    least: Vec<Vec<f32>>,
    most: Vec<Vec<f32>>,
}

/// The same as a page has it.
#[derive(Debug, Serialize)]
pub(super) struct Histories {
    /// Rows of the file, and how many of them a point stands for.
    rows: u64,
    every: usize,
    /// Middles of the points (s).
    time: Packed,
    /// By column: the values, or least and largest ones.
    columns: Vec<Values>,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Values {
    All { values: Packed },
    Extremes { least: Packed, most: Packed },
}

impl Kept {
    /// Of so many columns over about so many rows.
    pub(super) fn new(columns: usize, rows: usize) -> Self {
        let most = (VALUES / columns.max(1)).max(LEAST);
        let every = if rows <= most { 1 } else { rows.div_ceil(most / 2) };
        Kept {
            every,
            count: 0,
            rows: 0,
            span: [0.0; 2],
            times: Vec::new(),
            least: vec![Vec::new(); columns],
            most: vec![Vec::new(); if every == 1 { 0 } else { columns }],
        }
    }

    /// Adds a row.
    pub(super) fn add(&mut self, time: f64, values: impl IntoIterator<Item = f64>) {
        let begins = self.count == 0;
        for (place, value) in values.into_iter().enumerate() {
            let value = value as f32;
            if begins {
                self.least[place].push(value);
            }
            if self.every > 1 {
                if begins {
                    self.most[place].push(value);
                }
                let last = self.times.len() - usize::from(!begins);
                let (least, most) = (&mut self.least[place][last], &mut self.most[place][last]);
                (*least, *most) = (least.min(value), most.max(value));
            }
        }
        self.span = [if begins { time } else { self.span[0] }, time];
        let middle = 0.5 * (self.span[0] + self.span[1]);
        match begins {
            true => self.times.push(time),
            false => *self.times.last_mut().expect("it was begun") = middle,
        }
        self.count = (self.count + 1) % self.every;
        self.rows += 1;
    }

    /// As a page has it.
    pub(super) fn finish(self) -> Histories {
        let packed = |own: &Vec<f32>| Packed::single(own.iter().map(|value| f64::from(*value)));
        let columns = match self.every {
            1 => self.least.iter().map(|own| Values::All { values: packed(own) }).collect(),
            _ => {
                let both = self.least.iter().zip(&self.most);
                let both =
                    both.map(|(a, b)| Values::Extremes { least: packed(a), most: packed(b) });
                both.collect()
            }
        };
        let time = Packed::double(self.times);
        Histories { rows: self.rows, every: self.every, time, columns }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_rows_are_all_kept_and_many_keep_their_spikes() {
        let mut few = Kept::new(2, 3);
        (0..3).for_each(|row| few.add(f64::from(row), [1.0, f64::from(row)]));
        assert_eq!((few.every, &few.least[1]), (1, &vec![0.0, 1.0, 2.0]));
        let rows = 1_000_003;
        let mut many = Kept::new(2, rows);
        for row in 0..rows {
            let spike = if row == 777_777 { -50.0 } else { (row % 7) as f64 };
            many.add(row as f64, [spike, row as f64]);
        }
        assert!(many.times.len() <= VALUES / 4 && many.times.len() > VALUES / 5);
        let place = 777_777 / many.every;
        assert_eq!((many.least[0][place], many.most[0][place]), (-50.0, 6.0));
        assert_eq!(many.least[0].iter().filter(|own| **own < 0.0).count(), 1);
        let first = many.every as f64 * place as f64;
        assert_eq!(many.times[place], first + 0.5 * (many.every as f64 - 1.0));
        assert_eq!(f64::from(*many.most[1].last().unwrap()), rows as f64 - 1.0);
    }
}
