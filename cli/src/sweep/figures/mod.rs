//! Figures of a sweep: functions of its journal. Over one value curves, a bifurcation diagram and spectra, over two values
//! maps, of a Latin hypercube its points over every key.

mod analysed;
mod cell;
mod curves;
mod grid;
mod maps;
mod quantities;
mod samples;
mod style;
mod traces;

use self::cell::{Cell, cells};
use self::grid::{Grid, MOST_OF_CURVE};
use self::quantities::Quantities;
use self::samples::Samples;
use super::definition::Sweep;
use super::kept::Kept;
use super::row::Verdict;
use crate::case::Case;
use crate::figures::{Figure, put_figure};

/// Whether figures need what [`super::trace`] finds: those of sweeps over one key, up to a bound. One over a single value may get
/// others later.
pub(super) fn need_traces(sweep: &Sweep) -> bool {
    if !sweep.marches {
        return false;
    }
    match grid::varying(sweep).as_slice() {
        [] => sweep.samples.is_none(),
        [axis] => grid::values(sweep, *axis) <= MOST_OF_CURVE,
        _ => false,
    }
}

/// Draws all figures of the points that are done, each written by `write`; why some are missing. `stop` ends it.
pub(super) fn draw(
    sweep: &Sweep,
    kept: &mut Kept,
    write: &dyn Fn(&str, &[u8]) -> Result<(), String>,
    stop: &dyn Fn() -> bool,
) -> Vec<String> {
    let (grid, samples) = (Grid::of(sweep), Samples::of(sweep));
    let points = match (&grid, &samples) {
        (Some(grid), _) => &grid.points,
        (_, Some(samples)) => &samples.points,
        _ => return Vec::new(),
    };
    let Some(case) = first_case(sweep, kept, points) else { return Vec::new() };
    let Quantities { topics, wanted } = {
        let analyses: Vec<&str> = sweep.analyses.iter().map(|own| own.text()).collect();
        Quantities::of(&case, &analyses, &kept.names)
    };
    let cells = match cells(kept, points, &wanted) {
        Ok(cells) => cells,
        Err(reason) => return vec![reason],
    };
    let mut all: Vec<(&str, Option<Figure>)> = Vec::new();
    for topic in &topics {
        let figure = match (&grid, &samples) {
            (Some(grid), _) if grid.y.is_some() => maps::figure(topic, grid, &cells),
            (Some(grid), _) => Some(curves::figure(topic, grid, &cells)),
            (_, Some(samples)) => Some(samples::figure(topic, samples, &cells)),
            _ => None,
        };
        all.push((topic.stem, figure));
    }
    if let Some(grid) = grid.filter(|grid| grid.y.is_none()) {
        all.push(("bifurcation", traces::bifurcation(&grid, &cells)));
        all.push(("waterfall", traces::waterfall(&grid, &cells)));
    }
    let mark = mark(&cells);
    let mut missing = Vec::new();
    for (stem, figure) in all {
        if stop() {
            missing.push("interrupted before all figures were drawn".to_owned());
            return missing;
        }
        let titled = figure.map(|figure| Figure {
            title: format!("{}: {}{mark}", sweep.name, figure.title),
            ..figure
        });
        missing.extend(put_figure(stem, || Ok(titled), write));
    }
    missing
}

/// The case of the first of these points that has numbers.
fn first_case(sweep: &Sweep, kept: &mut Kept, points: &[usize]) -> Option<Case> {
    for number in points {
        if let Ok(Some((_, row))) = kept.row(*number)
            && row.verdict != Verdict::Failed
        {
            return sweep.case(&sweep.point(*number), &mut Vec::new()).ok();
        }
    }
    None
}

/// How many points have no numbers, or none to be believed; nothing where all are sound.
fn mark(cells: &[Cell]) -> String {
    let count = |verdict| cells.iter().filter(|cell| cell.verdict == Some(verdict)).count();
    let (failed, doubted) = (count(Verdict::Failed), count(Verdict::NotSound));
    let mut words = Vec::new();
    if failed > 0 {
        words.push(format!("{failed} of {} failed", cells.len()));
    }
    if doubted > 0 {
        words.push(format!("{doubted} of {} NOT SOUND", cells.len()));
    }
    if words.is_empty() { String::new() } else { format!(" [{}]", words.join(", ")) }
}
