//! Oil films on their bores where the case wants `[fields]`: films.json.

use serde::Serialize;

use super::encode::Packed;
use crate::fields::{Motions, PlayedFilm};

/// Numbers of a film, at most: of more frames every few are taken.
const MOST: usize = 150_000;

/// Those of a run.
#[derive(Debug, Serialize)]
pub(crate) struct FilmMaps {
    films: Vec<FilmMap>,
}

/// A film at the nodes of its bore, row after row.
#[derive(Debug, Serialize)]
struct FilmMap {
    name: String,
    /// Of the nodes of a row from x to y, in the frame of the bore, and of the rows from the middle of the film.
    angle_deg: Vec<f64>,
    z_mm: Vec<f64>,
    /// Of the frames (s).
    time: Vec<f64>,
    pressure_mpa: Levels,
    gap_um: Levels,
    #[serde(skip_serializing_if = "Option::is_none")]
    fill: Option<Levels>,
    /// At every node over all frames of the run.
    largest_pressure_mpa: Levels,
    smallest_gap_um: Levels,
}

/// Numbers between two, in parts of 65535.
#[derive(Debug, Serialize)]
struct Levels {
    least: f64,
    most: f64,
    parts: Packed,
}

impl Levels {
    fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let ends = |(least, most): (f64, f64), own: f64| (least.min(own), most.max(own));
        let (least, most) = values.clone().fold((f64::INFINITY, f64::NEG_INFINITY), ends);
        let span = if most > least { most - least } else { 1.0 };
        let part = |own: f64| ((own - least) / span * 65535.0).round() as u16;
        Levels { least, most, parts: Packed::short(values.map(part)) }
    }
}

impl FilmMaps {
    /// Of a run with films and frames of them.
    pub(crate) fn of(motions: &Motions) -> Option<Self> {
        let all = motions.films().into_iter().filter(|own| !own.frames.is_empty());
        let films: Vec<FilmMap> = all.map(|own| FilmMap::of(&own)).collect();
        (!films.is_empty()).then_some(FilmMaps { films })
    }

    /// The text of the file.
    pub(crate) fn json(&self) -> String {
        serde_json::to_string(self).expect("the keys are strings") + "\n"
    }
}

impl FilmMap {
    fn of(film: &PlayedFilm) -> Self {
        let (grid, nodes) = (film.place.grid, film.place.grid.nodes());
        let places = grid.places();
        // From the last one on, which is the end of the cycle.
        let every = (3 * nodes * film.frames.len()).div_ceil(MOST).max(1);
        let last = film.frames.len() - 1;
        let shown =
            film.frames.iter().enumerate().filter(|own| (last - own.0).is_multiple_of(every));
        let shown: Vec<(f64, &[f64])> = shown.map(|own| *own.1).collect();
        let map = |place: usize, factor: f64| {
            let values = shown.iter().flat_map(move |own| &own.1[place * nodes..][..nodes]);
            Levels::of(values.map(move |own| factor * own))
        };
        let over = |place: usize, factor: f64, pick: fn(f64, f64) -> f64| {
            let at = |node: usize| film.frames.iter().map(move |own| own.1[place * nodes + node]);
            let extremes: Vec<f64> =
                (0..nodes).map(|node| factor * at(node).reduce(pick).unwrap_or(0.0)).collect();
            Levels::of(extremes.into_iter())
        };
        FilmMap {
            name: film.name.clone(),
            angle_deg: places[..grid.around].iter().map(|own| own[0].to_degrees()).collect(),
            z_mm: places.iter().step_by(grid.around).map(|own| 1e3 * own[1]).collect(),
            time: shown.iter().map(|own| own.0).collect(),
            pressure_mpa: map(0, 1e-6),
            gap_um: map(1, 1e6),
            fill: film.place.carries_fill.then(|| map(2, 1.0)),
            largest_pressure_mpa: over(0, 1e-6, f64::max),
            smallest_gap_um: over(1, 1e6, f64::min),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_parts_between_the_least_and_the_largest() {
        let own = Levels::of([2.0, -1.0, 0.5].into_iter());
        assert_eq!((own.least, own.most), (-1.0, 2.0));
        assert_eq!(own.parts, Packed::short([65535, 0, 32768]));
        assert_eq!(Levels::of([7.0; 2].into_iter()).parts, Packed::short([0, 0]));
    }
}
