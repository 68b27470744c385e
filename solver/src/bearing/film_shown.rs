//! What results show of a film.

use super::films::FilmAt;
use super::plane::Plane;
use super::springs::Springs;
use super::state::SpringState;
use crate::film::{Grid, OUTPUTS, Oil, OilFilm};

/// A film as it was solved last.
pub(crate) struct Shown<'s> {
    film: &'s OilFilm,
    at: &'s FilmAt,
    /// F_x, F_y, M_x, M_y, M_z on the journal.
    forces: [f64; OUTPUTS],
}

/// Where maps of a film belong.
#[derive(Debug, Clone, Copy)]
pub struct FilmPlace<'m> {
    /// Its bearing, counted from 0.
    pub bearing: usize,
    /// Its nodes.
    pub grid: &'m Grid,
    /// Whether its gap may be part empty.
    pub carries_fill: bool,
}

impl Springs {
    /// The films, in the order of their maps.
    pub fn films(&self) -> Vec<FilmPlace<'_>> {
        let films = self.planes.iter().filter_map(|plane| {
            let film = &self.laws[plane.law].bound.law.film()?.film;
            let (bearing, carries_fill) = (plane.bearing, film.carries_fill());
            Some(FilmPlace { bearing, grid: &film.grid, carries_fill })
        });
        films.collect()
    }
}

impl SpringState {
    /// Writes pressure (Pa), gap (m) and filled part of the gap at the nodes of all films as they were solved last, in the order of
    /// [`Springs::films`].
    pub(crate) fn write_maps(&self, springs: &Springs, out: &mut Vec<f64>) {
        for plane in &springs.planes {
            if springs.laws[plane.law].bound.law.film().is_none() {
                continue;
            }
            let shown = self.film_at(springs, plane);
            let Oil { unknowns: [pressures, others], .. } = &shown.at.oil;
            out.extend(pressures);
            out.extend(&shown.at.balance.motion.gap);
            match shown.film.carries_fill() {
                true => out.extend(others.iter().map(|own| 1.0 - own)),
                false => out.extend(others.iter().map(|_| 1.0)),
            }
        }
    }

    /// The film of a plane.
    ///
    /// # Panics
    /// If its law is none.
    pub(crate) fn film<'s>(&'s self, springs: &'s Springs, plane: usize) -> Shown<'s> {
        self.film_at(springs, &springs.planes[plane])
    }

    fn film_at<'s>(&'s self, springs: &'s Springs, plane: &Plane) -> Shown<'s> {
        let (law, own) = (&springs.laws[plane.law], &self.laws[plane.law]);
        let journal = law.bound.law.film().expect("a film");
        let spring = plane.springs.start;
        let mut all = self.films.all.iter();
        let at = all.find(|own| own.is_at(plane.law, spring)).expect("a film at its plane");
        let force = |k: usize| own.forces[law.bound.forces[k] * law.springs + spring];
        Shown { film: &journal.film, at, forces: std::array::from_fn(force) }
    }
}

impl Shown<'_> {
    /// Moments on journal and bore, each about its own centre (N·m). What both do to each other has no moment in all.
    pub(crate) fn moments(&self) -> [f64; 2] {
        let ([x, y, ..], [along_x, along_y, .., own]) = (self.at.taken, self.forces);
        [own, -own - (x * along_y - y * along_x)]
    }

    /// Oil between the surfaces (m³).
    pub(crate) fn oil(&self) -> f64 {
        self.at.volume
    }

    /// What nodes hold by the gap of the rule for time (m³), which the balance of a step counts.
    pub(crate) fn stored(&self) -> f64 {
        self.at.balance.volume(self.film)
    }

    /// What enters at its openings (m³/s).
    pub(crate) fn inflows(&self) -> &[f64] {
        &self.at.shown[..self.film.openings.len()]
    }

    /// The values of [`crate::output::Wanted::Film`], in the units of its columns.
    pub(crate) fn write(&self, write: &mut impl FnMut(f64)) {
        let grid = &self.film.grid;
        let pressures = &self.at.oil.unknowns[0];
        let gaps = &self.at.balance.motion.gap;
        let place = |a: usize| {
            let angle = grid.angle(a % grid.around).to_degrees().rem_euclid(360.0);
            [angle, 1e3 * grid.z(a / grid.around)]
        };
        let most = first(grid, |a, b| pressures[a] > pressures[b]);
        let least = first(grid, |a, b| gaps[a] < gaps[b]);
        for (value, at) in [(1e-6 * pressures[most], most), (1e6 * gaps[least], least)] {
            write(value);
            place(at).into_iter().for_each(&mut *write);
        }
        let integrals = &self.at.shown[self.film.openings.len()..];
        integrals.iter().for_each(|own| write(*own));
        self.moments().into_iter().for_each(&mut *write);
        write(1e9 * self.oil());
        self.inflows().iter().for_each(|own| write(1e6 * own));
    }
}

/// The first node that comes before all others.
fn first(grid: &Grid, before: impl Fn(usize, usize) -> bool) -> usize {
    (1..grid.nodes()).fold(0, |best, a| if before(a, best) { a } else { best })
}
