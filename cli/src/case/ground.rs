//! The motion of the ground: its acceleration over time, from a table.

use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source};
use whirl_codegen::document::Table;
use whirl_codegen::kinds::law::{Column, Columns, Wanted, Which};
use whirl_codegen::rational::nearest;
use whirl_codegen::units::Dimension;
use whirl_solver::curve::Curve;
use whirl_text::rounded;

use super::library::FileStore;

/// Most rows and bytes of a record.
const LIMITS: (usize, usize) = (200_000, 16 << 20);
/// Standard gravity (m/s²), in which records are often given.
const STANDARD: f64 = 9.80665;
/// Columns, and keys that name others.
const AXES: [&str; 3] = ["x", "y", "z"];
/// Share of the largest acceleration below which the ground is at rest.
const AT_REST: f64 = 0.01;

/// How the ground is accelerated.
#[derive(Debug, Clone)]
pub(crate) struct GroundMotion {
    /// The file.
    pub(crate) source: Arc<Source>,
    /// Where the case names it.
    pub(crate) name: Located,
    /// Acceleration (m/s²) along x, y and z over t (s), where there is one.
    pub(crate) axes: [Option<Arc<Curve>>; 3],
    /// Times (s) of its first and last row.
    ends: [f64; 2],
    /// The largest of each (m/s²).
    pub(crate) largest: [f64; 3],
}

impl GroundMotion {
    /// What is to be said of a record that does not begin or end at rest, or beside the time of a run (s), if there is one.
    pub(crate) fn doubts(&self, duration: Option<f64>) -> Vec<String> {
        let [first, last] = self.ends;
        let file = self.name.text();
        let at_rest = |time: f64| {
            let moving = AXES.iter().zip(&self.axes).zip(self.largest);
            let moving = moving.filter_map(|((axis, own), largest)| {
                let value = own.as_ref()?.value(time);
                (value.abs() > AT_REST * largest)
                    .then(|| format!("{} m/s² along {axis}", rounded(value, 4)))
            });
            let moving: Vec<String> = moving.collect();
            if moving.is_empty() { Ok(()) } else { Err(moving.join(", ")) }
        };
        let mut all = Vec::new();
        if let Some(end) = duration.filter(|end| first >= *end) {
            all.push(format!(
                "the record `{file}` begins at {first} s, and the run ends at {end} s: none of its rows is reached"
            ));
        }
        if let (true, Err(values)) = (first >= 0.0, at_rest(first)) {
            all.push(format!(
                "the record `{file}` begins with {values}, which acts from the start of the run on: let it begin with a row of \
                 zeros, unless the ground is meant to be moving already"
            ));
        }
        if first < 0.0 {
            all.push(format!(
                "the record `{file}` begins at {first} s: what is before t = 0 does not act; shift its times"
            ));
        }
        if let (true, Err(values)) = (duration.is_none_or(|end| end > last), at_rest(last)) {
            all.push(format!(
                "the record `{file}` ends at {last} s with {values}, which goes on to act: let it end with a row of zeros"
            ));
        }
        all
    }

    /// Its acceleration (m/s²) at t = 0.
    pub(crate) fn at_start(&self) -> [f64; 3] {
        self.axes.each_ref().map(|own| own.as_ref().map_or(0.0, |own| own.value(0.0)))
    }

    /// Whether it moves the ground along x or y.
    pub(crate) fn is_across(&self) -> bool {
        self.axes[..2].iter().any(Option::is_some)
    }
}

/// The table `[ground_motion]`, if it is right.
pub(super) fn read(store: FileStore, file: &Table) -> Option<GroundMotion> {
    file.in_table("ground_motion", |table| read_one(store, table)).flatten()
}

fn read_one(store: FileStore, table: &Table) -> Option<GroundMotion> {
    let name = table.optional_string("table");
    let factor = match table.has("factor") {
        true => table.number_or_middle("factor"),
        false => 1.0,
    };
    let named = AXES.map(|axis| table.optional_string(axis));
    let name = name?;
    let source = store.read_named(table, &name)?;
    match of_file(&source, &name, (factor, &named)) {
        Ok(own) => Some(own),
        Err(errors) => {
            errors.into_iter().for_each(|error| table.push(error));
            None
        }
    }
}

/// A column in SI: values with their places.
type Cells = Vec<(f64, Located)>;

fn of_file(
    source: &Arc<Source>,
    name: &Located,
    (factor, named): (f64, &[Option<Located>; 3]),
) -> Result<GroundMotion, Diagnostics> {
    let columns = Columns::read_at_most(source, LIMITS)?;
    if !columns.is_named() {
        let message = format!("`{}` has no line of names", name.text());
        let help = "write one above the numbers, such as `time [s], x [g]`";
        return Err(name.error_here(Code::TABLE, message).help(help).into());
    }
    let mut errors = Diagnostics::new();
    let mut of = |called: &str, place: &Located, dimension: Dimension| {
        let column = Which::Named(called.to_owned());
        let wanted = Wanted { column, place: place.clone(), unit: None };
        let found = columns.column(&wanted).and_then(|own| cells(source, called, &own, dimension));
        found.map_err(|found| errors.append(found)).ok()
    };
    let times = of("time", name, Dimension::TIME);
    let mut all: [Option<Cells>; 3] = [None, None, None];
    for (place, axis) in AXES.into_iter().enumerate() {
        all[place] = match &named[place] {
            Some(own) => of(own.text(), own, Dimension::ACCELERATION),
            None if columns.has(axis) => of(axis, name, Dimension::ACCELERATION),
            None => None,
        };
    }
    errors.into_result(())?;
    let times = times.expect("without errors there are times");
    if let Some(pair) = times.windows(2).find(|pair| pair[1].0 <= pair[0].0) {
        let [before, after] = [&pair[0].1, &pair[1].1];
        let message = format!(
            "the times of a record rise from row to row, but {} follows {}",
            after.text(),
            before.text()
        );
        let help = "sort the rows, and give each time once";
        return Err(after.error_here(Code::TABLE, message).help(help).into());
    }
    if all.iter().all(Option::is_none) {
        let message = format!("`{}` has no column `x`, `y` or `z`", name.text());
        let help = "name its columns so, as in `x [g]` or `y [m/s^2]`, or say which they are, as in `x = \"NS\"`";
        return Err(name.error_here(Code::TABLE, message).help(help).into());
    }
    let largest = |own: &Option<Cells>| {
        let own = own.iter().flatten();
        own.fold(0.0, |most: f64, own| most.max((factor * own.0).abs()))
    };
    let curve = |own: &Option<Cells>| -> Option<Arc<Curve>> {
        let rows = times.iter().zip(own.as_ref()?);
        let rows: Vec<[f64; 2]> = rows.map(|(t, a)| [t.0, factor * a.0]).collect();
        // Times rise, and all are numbers.
        Some(Arc::new(Curve::linear(&rows, false).ok()?))
    };
    Ok(GroundMotion {
        ends: [times.first(), times.last()].map(|own| own.map_or(0.0, |own| own.0)),
        source: source.clone(),
        name: name.clone(),
        axes: all.each_ref().map(curve),
        largest: all.each_ref().map(largest),
    })
}

/// The values of a column in SI. What is called g is standard gravity here, as nothing else is in records.
fn cells(
    source: &Arc<Source>,
    called: &str,
    column: &Column,
    wanted: Dimension,
) -> Result<Cells, Diagnostics> {
    let in_gravity = wanted == Dimension::ACCELERATION && column.unit.text() == "g";
    if !in_gravity && !column.unit.dimension().fits(&wanted) {
        let is_time = wanted == Dimension::TIME;
        let such_as = if is_time { "time [s]" } else { "x [g]` or `x [m/s^2]" };
        let message = format!("the column `{called}` measures {}", column.unit.dimension());
        let error = Diagnostic::new(source, Code::WRONG_UNIT, column.head.clone(), message);
        return Err(error.help(format!("write its name with its unit, as in `{such_as}`")).into());
    }
    let mut errors = Diagnostics::new();
    let mut all = Vec::with_capacity(column.values.len());
    for (value, span) in &column.values {
        let place = Located::new(source, span.clone(), &source.text[span.clone()]);
        let value = match in_gravity {
            true => STANDARD * nearest(value),
            false => column.unit.to_si(nearest(value)),
        };
        if !value.is_finite() {
            let message = format!("`{}` is beyond all numbers in SI units", place.text());
            errors.push(place.error_here(Code::TABLE, message));
        }
        all.push((value, place));
    }
    errors.into_result(all)
}
