//! A history as named columns, in the units that results are written in.

/// Named columns of equal length.
#[derive(Debug, Clone, Default)]
pub struct Columns {
    names: Vec<String>,
    values: Vec<Vec<f64>>,
}

impl Columns {
    /// Adds a column.
    pub fn push(&mut self, name: impl Into<String>, values: Vec<f64>) {
        self.names.push(name.into());
        self.values.push(values);
    }

    /// The values of the column called `name`, if there is one.
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        let index = self.names.iter().position(|own| own == name)?;
        Some(&self.values[index])
    }

    /// Names in order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.values.first().map_or(0, Vec::len)
    }

    /// Values of row `row` in the order of the names.
    pub fn row(&self, row: usize) -> impl Iterator<Item = f64> {
        self.values.iter().map(move |column| column[row])
    }
}

impl std::ops::Index<&str> for Columns {
    type Output = [f64];

    /// # Panics
    /// If there is no such column.
    fn index(&self, name: &str) -> &[f64] {
        self.get(name).unwrap_or_else(|| panic!("no column {name}"))
    }
}
