//! Films on the nodes of their bores: pressure, gap and fill in every frame, and the largest pressure and smallest gap over them.

use std::io;
use std::path::Path;

use whirl_solver::bearing::FilmPlace;

use super::vtu::{self, Array, Cells, Values};

/// A film in all frames.
pub(crate) struct PlayedFilm<'a> {
    pub(crate) name: String,
    pub(crate) place: FilmPlace<'a>,
    /// Time (s), then pressures (Pa), gaps (m) and fills at the nodes, in the order of time.
    pub(crate) frames: Vec<(f64, &'a [f64])>,
}

/// Writes the files of a film: one a frame, one that lists them, and one of its extremes.
///
/// # Errors
/// What cannot be written.
pub(super) fn write(folder: &Path, film: &PlayedFilm) -> io::Result<()> {
    let (name, place) = (format!("film_{}", film.name), &film.place);
    let cells = Cells::between(place.grid);
    let mut listed = Vec::with_capacity(film.frames.len());
    let mut extremes = Extremes::of(place);
    for (number, (time, maps)) in film.frames.iter().enumerate() {
        extremes.add(maps);
        let file = format!("{name}_{number:04}.vtu");
        vtu::write(&folder.join(&file), &cells, &arrays(place, maps))?;
        listed.push((*time, file));
    }
    vtu::collection(&folder.join(format!("{name}.pvd")), &listed)?;
    if !film.frames.is_empty() {
        let arrays = extremes.arrays(place);
        vtu::write(&folder.join(format!("{name}_largest.vtu")), &cells, &arrays)?;
    }
    Ok(())
}

/// Nodes on the bore, about its centre and the middle of the film.
fn points(film: &FilmPlace) -> Array {
    let radius = film.grid.radius;
    let point = |[angle, z]: [f64; 2]| [radius * angle.cos(), radius * angle.sin(), z];
    Array::points(film.grid.places().into_iter().map(point).collect())
}

fn array(name: &'static str, values: &[f64]) -> Array {
    Array { name, values: Values::Scalars(values.to_vec()) }
}

fn arrays(film: &FilmPlace, maps: &[f64]) -> Vec<Array> {
    let nodes = film.grid.nodes();
    let (pressure, rest) = maps.split_at(nodes);
    let (gap, fill) = rest.split_at(nodes);
    let mut all = vec![points(film), array("pressure_Pa", pressure), array("gap_m", gap)];
    all.extend(film.carries_fill.then(|| array("fill", fill)));
    all
}

/// The largest pressure and the smallest gap at every node.
struct Extremes {
    pressure: Vec<f64>,
    gap: Vec<f64>,
}

impl Extremes {
    fn of(film: &FilmPlace) -> Self {
        let all = |value: f64| vec![value; film.grid.nodes()];
        Extremes { pressure: all(f64::NEG_INFINITY), gap: all(f64::INFINITY) }
    }

    fn add(&mut self, maps: &[f64]) {
        let (pressure, rest) = maps.split_at(self.pressure.len());
        self.pressure.iter_mut().zip(pressure).for_each(|(most, own)| *most = most.max(*own));
        self.gap.iter_mut().zip(rest).for_each(|(least, own)| *least = least.min(*own));
    }

    fn arrays(&self, film: &FilmPlace) -> Vec<Array> {
        let values = [("largest_pressure_Pa", &self.pressure), ("smallest_gap_m", &self.gap)];
        let values = values.map(|(name, own)| array(name, own));
        std::iter::once(points(film)).chain(values).collect()
    }
}
