//! What a march leaves behind: one row a step.

use crate::machine::Machine;
use crate::output::Output;

/// What the columns of a bearing are called by, and which it has beside those that all have.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointColumns<'a> {
    /// Its label.
    pub label: &'a str,
    /// Whether its law gives a torque.
    pub torque: bool,
    /// Whether it has a law on tilts.
    pub tilts: bool,
    /// Whether it has a law along z.
    pub along: bool,
}

impl<'a> JointColumns<'a> {
    /// Of a bearing with the columns that all have.
    pub fn of(label: &'a str) -> Self {
        JointColumns { label, ..JointColumns::default() }
    }
}

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

    /// The columns of a machine: time, angle and speed of the first body that turns, then for every bearing the
    /// reaction on the journal (fixed frame, N), the displacement of the journal's middle node (fixed frame, µm), its
    /// eccentricity against the bore (µm); then the torque on the journal about its own centre (N·m) for the bearings
    /// whose laws give one, the moments on the first side about x and y (fixed frame, N·m) and the force on it along z (N)
    /// for those with laws on tilts and along z, angle and speed of the other bodies that turn, the couples (N·m) that turn bodies as they are
    /// told, the Newton iterations of the step; and the outputs by request.
    pub fn for_machine(machine: &Machine) -> Self {
        let monitors = machine.monitors.iter();
        let bearings = monitors.map(|own| JointColumns {
            label: own.label.as_str(),
            torque: own.torque,
            tilts: own.tilts.is_some(),
            along: own.along.is_some(),
        });
        let bearings: Vec<JointColumns> = bearings.collect();
        let others = machine.turning().skip(1).map(|body| machine.bodies[body].name());
        let driven: Vec<&str> = machine.driven().map(|body| machine.bodies[body].name()).collect();
        let others = others.collect::<Vec<&str>>();
        let mut history = History::for_bearings(&bearings, &others, &driven);
        history.names.extend(machine.outputs.iter().flat_map(Output::columns));
        history
    }

    /// The columns as [`History::for_machine`] has them, of bearings,
    /// of the bodies that turn beside the first, and of those that turn as they are told.
    pub fn for_bearings(bearings: &[JointColumns], turning: &[&str], driven: &[&str]) -> Self {
        let mut names: Vec<String> =
            ["t_s", "theta_rad", "omega_rad_s"].map(str::to_owned).to_vec();
        for (prefix, unit) in [("R", "N"), ("", "um"), ("E", "um")] {
            for JointColumns { label, .. } in bearings {
                names.push(format!("{prefix}X{label}_{unit}"));
                names.push(format!("{prefix}Y{label}_{unit}"));
            }
        }
        for JointColumns { label, torque, tilts, along } in bearings {
            names.extend(torque.then(|| format!("MZ{label}_Nm")));
            let moments = ["MX", "MY"].into_iter().filter(|_| *tilts);
            names.extend(moments.map(|prefix| format!("{prefix}{label}_Nm")));
            names.extend(along.then(|| format!("RZ{label}_N")));
        }
        for body in turning {
            names.push(format!("theta_{body}_rad"));
            names.push(format!("omega_{body}_rad_s"));
        }
        names.extend(driven.iter().map(|body| format!("M_{body}_Nm")));
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
