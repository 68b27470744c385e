//! What laws and films remember from one step to the next, as plain values: states of laws, then of every film one value a node
//! and its temperature, where it has one.
//!
//! Of the two unknowns of a node one is zero: the value is the first where that is the one which is not, less the second otherwise.

use std::ops::Range;

use super::films::Known;
use super::hold::{Hold, LawStates};
use super::springs::Springs;
use crate::film::{Journal, Oil};

/// Part of its range that a state may have and be nothing; without a range, so much of its SI unit.
const RANGE: f64 = 1e-6;
const NOTHING: f64 = 1e-12;
/// Of a film: pressure (Pa), and the empty part of its gap; its temperature (K).
const LEAST_OIL: [f64; 2] = [1.0, 1e-3];
const LEAST_HEAT: f64 = 1e-3;

/// Values that are alike.
pub(crate) struct Alike {
    pub(crate) place: Range<usize>,
    /// Unit of states; none of films.
    unit: Option<String>,
    /// Sizes above zero and below it that are nothing.
    pub(crate) least: [f64; 2],
}

impl Alike {
    /// Whether values above zero and below it are of one quantity.
    pub(crate) fn is_one_quantity(&self) -> bool {
        self.unit.is_some()
    }
}

impl Springs {
    /// The films, with the places of what is known of them.
    fn known_films(&self) -> impl Iterator<Item = (&Journal, Known)> {
        let films = self.laws.iter().filter_map(|own| Some((own, own.bound.law.film()?)));
        let films = films.flat_map(|(own, journal)| (0..own.springs).map(move |_| (own, journal)));
        films.scan(0, |first, (own, journal)| {
            let known = Known::of(journal, own.shapes.as_ref(), *first);
            *first += known.count();
            Some((journal, known))
        })
    }

    /// The values that are alike, side by side: states of one unit of a law, and those of a film.
    pub(crate) fn remembered(&self) -> Vec<Alike> {
        let mut all: Vec<Alike> = Vec::new();
        let mut end = 0;
        for law in &self.laws {
            let begin = end;
            for own in &law.bound.states {
                end += law.springs;
                let least = own.range.map_or(NOTHING, |[least, most]| RANGE * (most - least).abs());
                let alike = all.last_mut().filter(|last| {
                    last.place.start >= begin && last.unit.as_deref() == Some(own.unit.as_str())
                });
                match alike {
                    Some(last) => {
                        last.place.end = end;
                        last.least = last.least.map(|own| own.max(least));
                    }
                    None => all.push(Alike {
                        place: end - law.springs..end,
                        unit: Some(own.unit.clone()),
                        least: [least; 2],
                    }),
                }
            }
        }
        for (journal, _) in self.known_films() {
            let begin = end;
            end += journal.film.grid.nodes();
            all.push(Alike { place: begin..end, unit: None, least: LEAST_OIL });
            if journal.heat().is_some() {
                end += 1;
                let unit = Some("K".to_owned());
                all.push(Alike { place: end - 1..end, unit, least: [LEAST_HEAT; 2] });
            }
        }
        all
    }

    /// Writes the values at the end of a step.
    pub(crate) fn read_memory(&self, laws: &LawStates, out: &mut [f64]) {
        let (states, films) = out.split_at_mut(self.states());
        states.copy_from_slice(&laws.known[..states.len()]);
        let mut films = films.iter_mut();
        for (journal, known) in self.known_films() {
            let (first, second) = known.oil(&laws.films).split_at(known.nodes());
            for ((first, second), out) in first.iter().zip(second).zip(films.by_ref()) {
                *out = if second.is_sign_positive() { -second } else { *first };
            }
            if let Some(out) = journal.heat().and_then(|_| films.next()) {
                *out = known.temperature(&laws.films);
            }
        }
    }

    /// What is known of laws that remember these values.
    pub(crate) fn with_memory(&self, values: &[f64]) -> LawStates {
        let mut laws = self.beginning();
        let (states, mut films) = values.split_at(self.states());
        laws.known.copy_from_slice(states);
        for (journal, known) in self.known_films() {
            let (own, rest) = films.split_at(known.nodes());
            films = rest;
            let mut oil = Oil::full(&journal.film);
            oil.take_values(&journal.film, own);
            oil.write(known.parts(&mut laws.films)[0]);
            if journal.heat().is_some() {
                let (temperature, rest) = films.split_first().expect("its temperature");
                films = rest;
                *known.temperature_mut(&mut laws.films) = *temperature;
            }
        }
        if !values.is_empty() {
            laws.hold = Hold::Implicit(0.0);
        }
        laws
    }
}
