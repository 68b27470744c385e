//! Files of coefficients over speed and frequency: a row for every pair of both.

use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source};
use whirl_codegen::kinds::law::{Column, Columns, Wanted, Which};
use whirl_codegen::rational::nearest;
use whirl_codegen::units::Dimension;
use whirl_solver::bearing::{Coefficients, FrequencyTable, OverWhat};

/// What the second coordinate may be called.
const FREQUENCY: &str = "frequency";
const RATIO: &str = "frequency_ratio";
/// Coefficients, in the order of [`Coefficients`].
const COEFFICIENTS: [&str; 8] = ["k_xx", "k_xy", "k_yx", "k_yy", "c_xx", "c_xy", "c_yx", "c_yy"];
/// Most speeds, most rows and most bytes.
const MOST_SPEEDS: usize = 128;
const LIMITS: (usize, usize) = (16_384, 4 << 20);

/// A file that was read.
pub(super) struct Read {
    /// All of it.
    pub(super) table: FrequencyTable,
    /// Its rows of the lowest frequency as a table over the speed alone.
    pub(super) still: String,
}

/// A value in SI with its place in the file.
type Cell = (f64, Located);

/// Whether the line of names has a column of frequencies.
pub(super) fn is_meant(has: &dyn Fn(&str) -> bool) -> bool {
    has(FREQUENCY) || has(RATIO)
}

/// A file that has all columns.
///
/// # Errors
/// Whatever is wrong with it, at its lines.
pub(super) fn read(file: &Arc<Source>, name: &Located) -> Result<Read, Diagnostics> {
    let columns = Columns::read_at_most(file, LIMITS)?;
    if columns.has(FREQUENCY) && columns.has(RATIO) {
        let message = format!("`{}` has both `{FREQUENCY}` and `{RATIO}`", name.text());
        let help = "leave one of the two columns out";
        return Err(name.error_here(Code::TABLE, message).help(help).into());
    }
    let over = if columns.has(RATIO) { OverWhat::Ratio } else { OverWhat::Frequency };
    let mut errors = Diagnostics::new();
    let mut of = |called: &str, allowed: &[Dimension], example: &str| {
        let wanted =
            Wanted { column: Which::Named(called.to_owned()), place: name.clone(), unit: None };
        let found = columns.column(&wanted).and_then(|own| cells(file, &own, allowed, example));
        found.map_err(|found| errors.append(found)).ok()
    };
    let speeds = of("speed", &[Dimension::ANGULAR_SPEED], "speed [rpm]");
    let seconds = match over {
        OverWhat::Ratio => of(RATIO, &[Dimension::NUMBER], "frequency_ratio [1]"),
        OverWhat::Frequency => {
            of(FREQUENCY, &[Dimension::FREQUENCY, Dimension::ANGULAR_SPEED], "frequency [Hz]")
        }
    };
    let coefficients = COEFFICIENTS.map(|own| {
        let stiffness = own.starts_with('k');
        let allowed = if stiffness { Dimension::STIFFNESS } else { Dimension::DAMPING };
        of(own, &[allowed], &format!("{own} [{}]", if stiffness { "N/m" } else { "N*s/m" }))
    });
    let (Some(speeds), Some(seconds)) = (speeds, seconds) else { return Err(errors) };
    let coefficients: Option<Vec<Vec<Cell>>> = coefficients.into_iter().collect();
    let Some(coefficients) = coefficients else { return Err(errors) };
    let row = |k: usize| std::array::from_fn(|own| coefficients[own][k].0);
    grid(file, (&speeds, &seconds), over, &row)
}

/// The values of a column in SI, frequencies as angular ones.
fn cells(
    file: &Arc<Source>,
    column: &Column,
    allowed: &[Dimension],
    example: &str,
) -> Result<Vec<Cell>, Diagnostics> {
    let dimension = column.unit.dimension();
    let Some(fits) = allowed.iter().find(|own| dimension.fits(own)) else {
        let shown = example.split(' ').next().unwrap_or_default();
        let message = format!("the column `{shown}` measures {dimension}");
        let error = Diagnostic::new(file, Code::WRONG_UNIT, column.head.clone(), message);
        return Err(error.help(format!("such as `{example}`")).into());
    };
    // A frequency in Hz counts cycles.
    let factor = if *fits == Dimension::FREQUENCY { std::f64::consts::TAU } else { 1.0 };
    let mut errors = Diagnostics::new();
    let mut cells = Vec::with_capacity(column.values.len());
    for (value, span) in &column.values {
        let place = Located::new(file, span.clone(), &file.text[span.clone()]);
        let value = factor * column.unit.to_si(nearest(value));
        if !value.is_finite() {
            let message = format!("`{}` is beyond all numbers in SI units", place.text());
            errors.push(place.error_here(Code::TABLE, message));
        }
        cells.push((value, place));
    }
    errors.into_result(cells)
}

/// The rows as a grid, in whatever order they are.
fn grid(
    file: &Arc<Source>,
    (speeds, seconds): (&[Cell], &[Cell]),
    over: OverWhat,
    row: &dyn Fn(usize) -> Coefficients,
) -> Result<Read, Diagnostics> {
    let called = if over == OverWhat::Ratio { RATIO } else { FREQUENCY };
    let refuse = |place: &Located, message: String, help: &str| -> Diagnostics {
        place.error_here(Code::TABLE, message).help(help.to_owned()).into()
    };
    if let Some((_, place)) = seconds.iter().find(|own| own.0 < 0.0) {
        let message = format!("a `{called}` is zero or more, not {}", place.text());
        let help = "stiffness and damping in the plane are real, and hold for backward whirl as for forward: leave negative rows out";
        return Err(refuse(place, message, help));
    }
    let axis = |cells: &[Cell]| {
        let mut own: Vec<f64> = cells.iter().map(|own| own.0).collect();
        own.sort_by(f64::total_cmp);
        own.dedup();
        own
    };
    let (across, along) = (axis(speeds), axis(seconds));
    for (own, called) in [(&across, "speed"), (&along, called)] {
        if own.len() < 2 {
            let place = if called == "speed" { &speeds[0].1 } else { &seconds[0].1 };
            let message = format!(
                "a table over speed and frequency has two of each at least, and this has one `{called}`"
            );
            let help = match called {
                "speed" => "give the rows of another speed, too",
                _ => "give the rows of another one, too, or leave the column out",
            };
            return Err(refuse(place, message, help));
        }
    }
    if across.len() > MOST_SPEEDS {
        let message =
            format!("a table has at most {MOST_SPEEDS} speeds, this has {}", across.len());
        return Err(Diagnostic::new(file, Code::LIMIT, None, message).into());
    }
    let place_in = |axis: &[f64], value: f64| axis.partition_point(|own| *own < value);
    let mut found: Vec<Vec<Option<usize>>> = vec![vec![None; across.len()]; along.len()];
    for (k, (speed, second)) in speeds.iter().zip(seconds).enumerate() {
        let own = &mut found[place_in(&along, second.0)][place_in(&across, speed.0)];
        if own.replace(k).is_some() {
            let (speed, second) = (speed.1.text(), second.1.text());
            let message = format!("the row of speed {speed} and {called} {second} is given twice");
            return Err(refuse(&seconds[k].1, message, "give each pair once"));
        }
    }
    for (place, own) in across.iter().enumerate() {
        let Some(lacks) = found.iter().position(|column| column[place].is_none()) else { continue };
        let (_, at) = speeds.iter().find(|cell| cell.0 == *own).expect("it is one of them");
        let (_, other) =
            seconds.iter().find(|cell| cell.0 == along[lacks]).expect("it is one of them");
        let message = format!(
            "there is no row of speed {} with the {called} {}, which another speed has",
            at.text(),
            other.text()
        );
        let help = match over {
            OverWhat::Frequency => {
                "give every speed the same frequencies; where they are the same shares of each speed, give these as `frequency_ratio [1]` instead"
            }
            OverWhat::Ratio => "give every speed the same ratios",
        };
        return Err(refuse(at, message, help));
    }
    let values: Vec<Vec<Coefficients>> =
        found.iter().map(|column| column.iter().flatten().map(|own| row(*own)).collect()).collect();
    let mut still = String::from("speed [rad/s]");
    for own in COEFFICIENTS {
        still
            .push_str(&format!(", {own} [{}]", if own.starts_with('k') { "N/m" } else { "N*s/m" }));
    }
    for (speed, own) in across.iter().zip(&values[0]) {
        still.push_str(&format!("\n{speed:?}"));
        own.iter().for_each(|value| still.push_str(&format!(", {value:?}")));
    }
    still.push('\n');
    let table = FrequencyTable::new(across, (over, along), values)
        .map_err(|error| Diagnostic::new(file, Code::TABLE, None, error.to_string()))?;
    Ok(Read { table, still })
}
