//! The joints of films.

use super::films::{DeformedBore, FilmAt, Films};
use super::hold::{Hold, LawStates};
use super::placed_law::PlacedLaw;
use super::springs::Springs;
use super::state::{LawState, SpringState};
use crate::film::{INPUTS, Journal};

impl LawState {
    /// What a film takes at a spring of its law.
    fn taken(&self, law: &PlacedLaw, spring: usize) -> [f64; INPUTS] {
        std::array::from_fn(|k| self.inputs[law.bound.inputs[k] * law.springs + spring])
    }
}

impl SpringState {
    /// Solves the film of a law at all its joints.
    pub(super) fn evaluate_films(&mut self, law: &PlacedLaw, place: usize, journal: &Journal) {
        let own = &mut self.laws[place];
        let Films { given, squeezed, all } = &mut self.films;
        for film in all.iter_mut().filter(|film| film.law == place) {
            film.taken = own.taken(law, film.spring);
            let rigid = law.bound.kind.bore.len();
            if let Some(deformed) = &mut film.deformed {
                let [by, rates] = &mut deformed.taken;
                by.copy_from_slice(&own.bore[rigid..]);
                rates.copy_from_slice(&own.bore_dot[rigid..]);
            }
            let shapes = law.shapes.as_ref();
            let (forces, n) = (film.solve((journal, shapes), given, *squeezed), law.springs);
            if let Some(deformed) = &film.deformed {
                own.bore_force[rigid..].copy_from_slice(&deformed.forces);
            }
            for (&force, value) in law.bound.forces.iter().zip(forces) {
                own.forces[force * n + film.spring] = value;
            }
        }
    }

    /// Finds the slopes of the forces of all films where they were solved last.
    pub(crate) fn slope_films(&mut self, springs: &Springs) {
        for film in self.films.all.iter_mut().filter(|film| !film.sloped && film.solved) {
            film.sloped = true;
            let (law, own) = (&springs.laws[film.law], &mut self.laws[film.law]);
            let journal = springs.film_of(film.law);
            let FilmAt { step, oil, balance, deformed, .. } = film;
            let slopes = journal.slopes(*step, oil, balance);
            if let (Some(shapes), Some(deformed)) = (&law.shapes, deformed) {
                journal.slopes_of_shapes(*step, oil, balance, shapes, &mut deformed.slopes);
            }
            let (bound, n) = (&law.bound, law.springs);
            for (&force, slopes) in bound.forces.iter().zip(&slopes) {
                for (&input, slope) in bound.inputs.iter().zip(slopes) {
                    let row = force * bound.kind.inputs.len() + input;
                    own.slopes[row * n + film.spring] = *slope;
                }
            }
        }
    }

    /// Of all films the nodes whose gap changes too fast for the step.
    pub(crate) fn fast_nodes(&self) -> impl Iterator<Item = usize> {
        self.films.all.iter().map(|film| film.fast)
    }

    /// Of all films the smallest gap (m), as they were solved last.
    pub(crate) fn least_gaps(&self) -> impl Iterator<Item = f64> {
        let gaps = self.films.all.iter().map(|film| film.balance.motion.gap.iter().copied());
        gaps.map(|own| own.fold(f64::INFINITY, f64::min))
    }

    /// The temperatures of all films (K), as they were solved last; 0 of one that has none.
    pub(crate) fn film_temperatures(&self) -> impl Iterator<Item = f64> {
        let of = |film: &FilmAt| film.shown.last().copied().filter(|_| film.heated);
        self.films.all.iter().map(move |film| of(film).unwrap_or(0.0))
    }

    /// Keeps films where they were solved last, as known.
    pub(super) fn keep_films(&self, laws: &mut LawStates) {
        for film in &self.films.all {
            let [oil, motion, shown] = film.known.parts(&mut laws.films);
            film.oil.write(oil);
            let (taken, shapes) = motion.split_at_mut(INPUTS);
            taken.copy_from_slice(&film.taken);
            if let Some(DeformedBore { taken: [by, rates], .. }) = &film.deformed {
                let (kept, kept_rates) = shapes.split_at_mut(by.len());
                kept.copy_from_slice(by);
                kept_rates.copy_from_slice(rates);
            }
            shown.copy_from_slice(&film.shown);
        }
        if !self.films.all.is_empty() {
            laws.hold = Hold::Implicit(0.0);
        }
    }
}
