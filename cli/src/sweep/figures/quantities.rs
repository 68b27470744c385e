//! Which numbers of the table are drawn: those of the supports, amplitudes of orders, stresses, and those of analyses.

use std::collections::BTreeSet;

use super::analysed::{KINDS, Panelled, panels};
use crate::case::Case;

/// A panel of a figure: numbers with one unit.
#[derive(Debug, Clone)]
pub(super) struct Group {
    /// Shown above the panel.
    pub(super) title: String,
    /// What its numbers are, without their unit.
    pub(super) quantity: String,
    pub(super) unit: String,
    pub(super) series: Vec<Series>,
    /// The column of a limit on both sides of zero, among those that are wanted.
    pub(super) limit: Option<usize>,
}

/// Numbers of one kind.
#[derive(Debug, Clone)]
pub(super) struct Series {
    /// What the legend calls it.
    pub(super) name: String,
    /// The letters of its quantity.
    pub(super) symbol: String,
    /// One column, or those of its least and its largest value, among those that are wanted.
    pub(super) columns: Vec<usize>,
}

/// A figure, for which there are groups.
#[derive(Debug, Clone)]
pub(super) struct Topic {
    /// Name of its files, without their endings.
    pub(super) stem: &'static str,
    /// What stands above it.
    pub(super) title: &'static str,
    pub(super) groups: Vec<Group>,
}

/// What is drawn, and the columns that it takes.
#[derive(Debug, Default)]
pub(super) struct Quantities {
    pub(super) topics: Vec<Topic>,
    /// Names of numbers of rows.
    pub(super) wanted: Vec<String>,
}

impl Quantities {
    /// Of a case and analyses whose rows have these numbers.
    pub(super) fn of(case: &Case, analyses: &[&str], names: &[Vec<String>]) -> Self {
        let mut wanted = Wanted { known: names.iter().flatten().collect(), names: Vec::new() };
        let mut topics = Vec::new();
        let mut add = |stem, title, groups: Vec<Group>| {
            if !groups.is_empty() {
                topics.push(Topic { stem, title, groups });
            }
        };
        add(
            "reactions",
            "Reactions at the supports in the last cycle",
            reactions(case, &mut wanted),
        );
        match case.machine.is_mass() {
            true => add(
                "displacement",
                "Displacement of the mass in the last cycle",
                displacement(case, &mut wanted),
            ),
            false => add(
                "eccentricity",
                "Eccentricity of the journals in the last cycle",
                eccentricities(case, &mut wanted),
            ),
        }
        add("orders", "Amplitudes at 1X and 2X", orders(&mut wanted));
        add("stresses", "Largest von Mises stresses", stresses(&mut wanted));
        for kind in &KINDS {
            let panels = panels(kind, analyses, &wanted.known);
            add(kind.stem, kind.title, panels.into_iter().map(|own| wanted.panel(own)).collect());
        }
        Quantities { topics, wanted: wanted.names }
    }
}

/// Columns that are wanted so far, of those that there are.
struct Wanted<'n> {
    known: BTreeSet<&'n String>,
    names: Vec<String>,
}

impl Wanted<'_> {
    /// Place of a column, if rows have it.
    fn place(&mut self, name: String) -> Option<usize> {
        self.known.contains(&name).then(|| {
            self.names.push(name);
            self.names.len() - 1
        })
    }

    /// The least and the largest value of a column of histories.
    fn ends(&mut self, column: &str) -> Option<Vec<usize>> {
        ["min", "max"].map(|end| self.place(format!("{column}.{end}"))).into_iter().collect()
    }

    /// Numbers of analyses.
    fn panel(&mut self, own: Panelled) -> Group {
        let series = own.series.into_iter().filter_map(|(name, column)| {
            let columns = vec![self.place(column)?];
            Some(Series { symbol: name.clone(), name, columns })
        });
        Group {
            title: own.title,
            quantity: own.quantity.to_owned(),
            unit: own.unit.to_owned(),
            series: series.collect(),
            limit: None,
        }
    }

    fn series(&mut self, column: &str, symbol: &str, name: &str) -> Option<Series> {
        Some(Series {
            name: name.to_owned(),
            symbol: symbol.to_owned(),
            columns: self.ends(column)?,
        })
    }
}

fn reactions(case: &Case, wanted: &mut Wanted) -> Vec<Group> {
    let mut groups = Vec::new();
    for own in case.supports() {
        let series = [("RX", "RX, vertical"), ("RY", "RY, lateral")]
            .map(|(letters, name)| wanted.series(&own.column(letters, "N"), letters, name));
        let series: Vec<Series> = series.into_iter().flatten().collect();
        if !series.is_empty() {
            groups.push(Group {
                title: own.title,
                quantity: "force on the shaft".to_owned(),
                unit: "N".to_owned(),
                series,
                limit: None,
            });
        }
    }
    groups
}

fn eccentricities(case: &Case, wanted: &mut Wanted) -> Vec<Group> {
    let mut groups = Vec::new();
    for own in case.supports() {
        let series = [("EX", "EX, vertical"), ("EY", "EY, lateral")]
            .map(|(letters, name)| wanted.series(&own.column(letters, "um"), letters, name));
        let series: Vec<Series> = series.into_iter().flatten().collect();
        if !series.is_empty() {
            groups.push(Group {
                limit: wanted.place(own.column("clearance", "um")),
                title: own.title,
                quantity: "eccentricity".to_owned(),
                unit: "µm".to_owned(),
                series,
            });
        }
    }
    groups
}

fn displacement(case: &Case, wanted: &mut Wanted) -> Vec<Group> {
    // Stops are all around one mass.
    let Some(first) = case.supports().into_iter().next() else { return Vec::new() };
    let series = wanted.series(&first.column("X", "um"), "X", "X, vertical");
    let group = |series| Group {
        title: String::new(),
        quantity: "displacement".to_owned(),
        unit: "µm".to_owned(),
        series: vec![series],
        limit: None,
    };
    series.map(group).into_iter().collect()
}

fn orders(wanted: &mut Wanted) -> Vec<Group> {
    const FIRST: &str = ".1X.amplitude";
    let signals: Vec<String> = wanted
        .known
        .iter()
        .filter_map(|name| name.strip_suffix(FIRST))
        .map(str::to_owned)
        .collect();
    let mut groups = Vec::new();
    for signal in signals {
        let mut order = |symbol: &str, name: &str| {
            let place = wanted.place(format!("{signal}.{symbol}.amplitude"))?;
            let columns = vec![place];
            Some(Series { name: String::from(name), symbol: String::from(symbol), columns })
        };
        let series = [order("1X", "1X, once a revolution"), order("2X", "2X, twice a revolution")];
        let unit = unit(&signal).to_owned();
        let series = series.into_iter().flatten().collect();
        let quantity = "amplitude".to_owned();
        groups.push(Group { title: signal, quantity, unit, series, limit: None });
    }
    groups
}

fn stresses(wanted: &mut Wanted) -> Vec<Group> {
    const HEAD: &str = "stress.";
    let bodies: Vec<String> =
        wanted.known.iter().filter_map(|name| name.strip_prefix(HEAD)).map(str::to_owned).collect();
    let group = |body: String| {
        let place = wanted.place(format!("{HEAD}{body}"))?;
        let (name, symbol) = ("largest stress".to_owned(), "σ".to_owned());
        let series = Series { name, symbol, columns: vec![place] };
        Some(Group {
            title: body,
            quantity: "von Mises stress".to_owned(),
            unit: "MPa".to_owned(),
            series: vec![series],
            limit: None,
        })
    };
    bodies.into_iter().filter_map(group).collect()
}

/// The unit at the end of the name of a column, as people print it.
fn unit(column: &str) -> &'static str {
    const UNITS: [(&str, &str); 9] = [
        ("_um", "µm"),
        ("_mm_s", "mm/s"),
        ("_m_s2", "m/s²"),
        ("_N", "N"),
        ("_Nm", "N·m"),
        ("_rad", "rad"),
        ("_rad_s", "rad/s"),
        ("_J", "J"),
        ("_W", "W"),
    ];
    UNITS.iter().find(|(end, _)| column.ends_with(end)).map_or("", |(_, unit)| unit)
}
