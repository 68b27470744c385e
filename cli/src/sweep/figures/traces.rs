//! What oscillates over the values of one key: where it is once a cycle, and its spectra.

use super::cell::Cell;
use super::curves::over;
use super::grid::Grid;
use super::style::style;
use crate::figures::{Cloud, Figure, Stacked, stack};
use crate::sweep::row::Verdict;
use crate::sweep::trace::Traced;

/// Values of which a bifurcation diagram shows the positions, at most, and spectra that stand one above the other.
const DIAGRAM: usize = 400;
const SPECTRA: usize = 40;

/// Positions once a cycle, a panel a signal. None where no point has more than one of them.
pub(super) fn bifurcation(grid: &Grid, cells: &[Cell]) -> Option<Figure> {
    let mut panels = Vec::new();
    for (k, first) in signals(cells).iter().enumerate() {
        let y = format!("{} ({})", first.quantity, first.unit);
        let mut panel = over(&grid.x, &first.title, y);
        let mut several = false;
        for (way, name) in grid.ways.iter().enumerate() {
            for (axis, letter) in first.axes.iter().enumerate() {
                let mut points = Vec::new();
                for (x, traced) in along(grid, cells, (way, k), DIAGRAM) {
                    let own = traced.positions.get(axis).map_or(&[][..], Vec::as_slice);
                    several |= own.len() > 1;
                    let own = own.iter().filter(|own| own.is_finite());
                    points.extend(own.map(|y| (x, f64::from(*y))));
                }
                let way_called = name.map_or(String::new(), |way| format!(", {way}"));
                let (name, style) = (format!("{letter}{way_called}"), style(axis, way));
                if !points.is_empty() {
                    panel.clouds.push(Cloud { points, style, radius: 1.1, name });
                }
            }
        }
        if several {
            panels.push(panel);
        }
    }
    let title = "Bifurcation diagram: sampled once a cycle".to_owned();
    let columns = panels.len().min(2);
    (columns > 0).then_some(Figure { title, panels, columns })
}

/// Spectra one above the other, a panel a signal and way. None where fewer than two points have one.
pub(super) fn waterfall(grid: &Grid, cells: &[Cell]) -> Option<Figure> {
    grid.x.values.as_ref()?;
    let mut panels = Vec::new();
    for (k, first) in signals(cells).iter().enumerate() {
        for (way, name) in grid.ways.iter().enumerate() {
            let of = |(height, traced): (f64, &Traced)| Stacked {
                height,
                speed: traced.speed,
                points: traced
                    .spectrum
                    .iter()
                    .map(|own| own.map(f64::from))
                    .map(Into::into)
                    .collect(),
            };
            let found = along(grid, cells, (way, k), SPECTRA);
            let mut all: Vec<Stacked> =
                found.into_iter().filter(|own| !own.1.spectrum.is_empty()).map(of).collect();
            if all.len() < 2 {
                continue;
            }
            let points = || all.iter().flat_map(|own| &own.points);
            let largest = points().fold(0.0, |most, own| f64::max(most, own.1));
            if !(largest > 0.0) {
                continue;
            }
            // Amplitudes beyond are small, whatever the spectra of single points hold there.
            let end = points().filter(|own| own.1 >= 0.01 * largest).map(|own| own.0);
            let fastest = all.iter().map(|own| 2.2 * own.speed).fold(0.0, f64::max);
            let end = (1.1 * end.fold(0.0, f64::max)).max(fastest);
            // Each reaches from side to side, as what is small of it was left out.
            for own in &mut all {
                own.points.push((end, own.points.last().map_or(0.0, |last| last.1)));
            }
            let axis = first.axes.first().map_or("", String::as_str);
            let way = name.map_or(String::new(), |way| format!(", {way}"));
            let title = format!("{}, {} {axis}{way}", first.title, first.quantity);
            let amplitudes = (largest, first.unit.as_str());
            let heights = (grid.x.name(), grid.x.unit.as_str());
            panels.push(stack(&all, end, amplitudes, (title, heights)));
        }
    }
    let title = "Spectra of the last cycles (Hann window)".to_owned();
    let columns = panels.len().min(2);
    (columns > 0).then_some(Figure { title, panels, columns })
}

/// The signals of a point that has them all.
fn signals(cells: &[Cell]) -> &[Traced] {
    let all = cells.iter().filter_map(|cell| cell.trace.as_ref());
    all.map(|trace| trace.0.as_slice()).max_by_key(|own| own.len()).unwrap_or_default()
}

/// A signal along a way: of many points some, evenly chosen, and none of those that failed.
fn along<'c>(
    grid: &Grid,
    cells: &'c [Cell],
    (way, signal): (usize, usize),
    most: usize,
) -> Vec<(f64, &'c Traced)> {
    let count = grid.x.count();
    let chosen = (0..count.min(most)).map(|k| match count > most {
        true => k * (count - 1) / (most - 1),
        false => k,
    });
    let traced = |k: usize| {
        let cell = &cells[grid.place(way, 0, k)];
        let trace = cell.trace.as_ref().filter(|_| cell.verdict != Some(Verdict::Failed))?;
        Some((grid.x.at(k), trace.0.get(signal)?))
    };
    chosen.filter_map(traced).collect()
}
