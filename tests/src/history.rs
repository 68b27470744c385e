//! A history that a run has written, or an independent program.

/// Columns by name, in the units of their names.
pub struct History {
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
}

impl History {
    /// Reads the text of a `history.csv`: a line of names, then a value a column in every line.
    ///
    /// # Panics
    /// If it is none.
    pub fn parse(text: &str) -> History {
        let mut lines = text.lines();
        let names: Vec<String> =
            lines.next().expect("a line of names").split(',').map(str::to_owned).collect();
        let mut columns = vec![Vec::new(); names.len()];
        for line in lines {
            let values: Vec<f64> =
                line.split(',').map(|cell| cell.parse().expect("a number")).collect();
            assert_eq!(values.len(), names.len(), "{line}");
            columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
        }
        History { names, columns }
    }

    /// Names of the columns, in order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns[0].len()
    }

    /// The values of a column.
    ///
    /// # Panics
    /// If there is none of this name.
    pub fn column(&self, name: &str) -> &[f64] {
        let place = self.names.iter().position(|own| own == name);
        &self.columns[place.unwrap_or_else(|| panic!("no column {name} in {:?}", self.names))]
    }

    /// The last value of a column.
    ///
    /// # Panics
    /// If there are no rows, or no such column.
    pub fn last(&self, name: &str) -> f64 {
        *self.column(name).last().expect("a row")
    }

    /// The last `rows` values of a column.
    ///
    /// # Panics
    /// If there are fewer, or no such column.
    pub fn tail(&self, name: &str, rows: usize) -> &[f64] {
        let column = self.column(name);
        &column[column.len() - rows..]
    }

    /// The value of a column at time `t` (s), linear between rows.
    ///
    /// # Panics
    /// If there are fewer than two rows, or no such column.
    pub fn at(&self, name: &str, t: f64) -> f64 {
        let (times, values) = (self.column("t_s"), self.column(name));
        let next = times.partition_point(|time| *time < t).clamp(1, times.len() - 1);
        let share = (t - times[next - 1]) / (times[next] - times[next - 1]);
        values[next - 1] + share * (values[next] - values[next - 1])
    }
}
