//! What a march leaves behind: one row a step.

use crate::machine::Machine;

/// Named columns of one length, stored row by row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct History {
    names: Vec<String>,
    values: Vec<f64>,
}

impl History {
    /// No rows yet. Names carry their units, such as `RX1_N`.
    pub(crate) fn new(names: Vec<String>) -> Self {
        History { names, values: Vec::new() }
    }

    /// The columns of a machine, as [`History::for_bearings`] has them.
    pub fn for_machine(machine: &Machine) -> Self {
        let monitors = machine.monitors.iter().enumerate();
        let turning: Vec<usize> = monitors.filter(|(_, own)| own.torque).map(|(k, _)| k).collect();
        History::for_bearings(machine.monitors.len(), &turning)
    }

    /// The columns of a machine with `bearings` bearings: time, angle, speed, then for every bearing the
    /// reaction on the shaft (fixed frame, N), the displacement of the journal's middle node (fixed frame,
    /// µm), its eccentricity against the bore (µm); then the torque on the journal about its own centre (N·m)
    /// for the bearings `turning`, counted from 0, whose laws give one; the Newton iterations of the step.
    pub fn for_bearings(bearings: usize, turning: &[usize]) -> Self {
        let mut names: Vec<String> =
            ["t_s", "theta_rad", "omega_rad_s"].map(str::to_owned).to_vec();
        for (prefix, unit) in [("R", "N"), ("", "um"), ("E", "um")] {
            for k in 1..=bearings {
                names.push(format!("{prefix}X{k}_{unit}"));
                names.push(format!("{prefix}Y{k}_{unit}"));
            }
        }
        names.extend(turning.iter().map(|k| format!("MZ{}_Nm", k + 1)));
        names.push("iterations".to_owned());
        History::new(names)
    }

    /// Reserves memory for that many more rows.
    pub(crate) fn reserve(&mut self, rows: usize) {
        self.values.reserve(rows * self.names.len());
    }

    /// Adds a row; one value a column.
    pub fn push(&mut self, row: &[f64]) {
        assert_eq!(row.len(), self.names.len(), "one value a column");
        self.values.extend_from_slice(row);
    }

    /// Names of the columns.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.values.len() / self.names.len().max(1)
    }

    /// A row.
    pub(crate) fn row(&self, place: usize) -> &[f64] {
        &self.values[place * self.names.len()..(place + 1) * self.names.len()]
    }

    /// The values of a column, if there is one of that name.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let place = self.names.iter().position(|column| column == name)?;
        Some((0..self.rows()).map(|row| self.row(row)[place]).collect())
    }
}
