//! What a march leaves behind: one row a step.

pub use crate::column::Column;
use crate::machine::Machine;
use crate::output::Output;

/// What the columns of a bearing are called by, and which it has beside those that all have.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointColumns<'a> {
    /// Its label.
    pub label: &'a str,
    /// Whether its law gives a torque.
    pub torque: bool,
    /// Whether a law gives moments about x and y.
    pub tilts: bool,
    /// Whether a law gives a force along z.
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
        History::with(History::columns_of(machine))
    }

    /// The columns of [`History::for_machine`] with their units and what they are.
    pub fn columns_of(machine: &Machine) -> Vec<Column> {
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
        let mut columns = columns_for(&bearings, &others, &driven);
        columns.extend(machine.outputs.iter().flat_map(Output::described));
        columns
    }

    /// The columns as [`History::for_machine`] has them, of bearings,
    /// of the bodies that turn beside the first, and of those that turn as they are told.
    pub fn for_bearings(bearings: &[JointColumns], turning: &[&str], driven: &[&str]) -> Self {
        History::with(columns_for(bearings, turning, driven))
    }

    fn with(columns: Vec<Column>) -> Self {
        History::new(columns.into_iter().map(|own| own.name).collect())
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

    /// The values of a row, one a column.
    pub fn values(&self, row: usize) -> &[f64] {
        self.row(row)
    }

    /// The values of a column, if there is one of that name.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let place = self.names.iter().position(|column| column == name)?;
        Some((0..self.rows()).map(|row| self.row(row)[place]).collect())
    }
}

fn columns_for(bearings: &[JointColumns], turning: &[&str], driven: &[&str]) -> Vec<Column> {
    let mut columns = vec![
        Column::new("t_s", "s", "time"),
        Column::new("theta_rad", "rad", "angle of the first body that turns"),
        Column::new("omega_rad_s", "rad/s", "speed of the first body that turns"),
    ];
    let quantities = [
        ("R", "N", "N", "force on the journal"),
        ("", "um", "um", "displacement of the journal's middle"),
        ("E", "um", "um", "eccentricity of the journal relative to the bore"),
    ];
    let at = |label: &str| match label.strip_prefix('_') {
        Some(name) => format!("joint {name}"),
        None => format!("bearing or stop {label}"),
    };
    for (prefix, suffix, unit, what) in quantities {
        for JointColumns { label, .. } in bearings {
            for (axis, letter) in [("X", "x"), ("Y", "y")] {
                let meaning = format!("{what} along {letter} in space, {}", at(label));
                columns.push(Column::new(format!("{prefix}{axis}{label}_{suffix}"), unit, meaning));
            }
        }
    }
    for JointColumns { label, torque, tilts, along } in bearings {
        let place = at(label);
        if *torque {
            let meaning = format!("torque on the journal about its own centre, {place}");
            columns.push(Column::new(format!("MZ{label}_Nm"), "N*m", meaning));
        }
        if *tilts {
            for (prefix, letter) in [("MX", "x"), ("MY", "y")] {
                let meaning = format!("moment on the first side about {letter} in space, {place}");
                columns.push(Column::new(format!("{prefix}{label}_Nm"), "N*m", meaning));
            }
        }
        if *along {
            let meaning = format!("force on the first side along z, {place}");
            columns.push(Column::new(format!("RZ{label}_N"), "N", meaning));
        }
    }
    for body in turning {
        columns.push(Column::new(format!("theta_{body}_rad"), "rad", format!("angle of {body}")));
        let speed = format!("speed of {body}");
        columns.push(Column::new(format!("omega_{body}_rad_s"), "rad/s", speed));
    }
    columns.extend(driven.iter().map(|body| {
        let meaning = format!("couple of the prescribed rotation of {body}");
        Column::new(format!("M_{body}_Nm"), "N*m", meaning)
    }));
    columns.push(Column::new("iterations", "1", "Newton iterations of the step"));
    columns
}
