//! Films against closed forms, tables and differences. Numbers with their sources stand where they are compared.

mod arcs;
mod coefficients;
mod differences;
mod tables;
mod time;

use whirl_specs::{CLEARANCES, FILMS, Film};

use super::{Balance, Journal, JournalMotion, Oil, OilFilm, Reaction};

pub(super) const RADIUS: f64 = 0.025;
/// So small that shear does not count beside pressure, as in tables.
pub(super) const CLEARANCE: f64 = RADIUS * 1e-5;
/// As machines have it.
pub(super) const WIDE: f64 = RADIUS * 1e-3;
pub(super) const VISCOSITY: f64 = 0.02;
pub(super) const OMEGA: f64 = 300.0;

pub(super) fn kind(name: &str) -> &'static Film {
    FILMS.iter().find(|film| film.origin.name == name).expect("a shipped film")
}

/// A smooth film with open ends.
pub(super) fn film(name: &str, nodes: [usize; 2], length: f64, first: f64) -> OilFilm {
    let mut film = OilFilm::new(kind(name), nodes, [RADIUS, length], first).unwrap();
    film.set("sigma", 1e-12).unwrap();
    film.set("mu_0", VISCOSITY).unwrap();
    film
}

/// A bearing with all that one evaluation needs.
pub(super) struct Bench {
    pub(super) journal: Journal,
    pub(super) oil: Oil,
    pub(super) balance: Balance,
    pub(super) outputs: Vec<f64>,
}

impl Bench {
    pub(super) fn new(film: OilFilm) -> Self {
        Self::with(film, CLEARANCE)
    }

    pub(super) fn with(film: OilFilm, clearance: f64) -> Self {
        let journal = Journal::new(film, &CLEARANCES[0], clearance).unwrap();
        let (oil, balance) = (Oil::full(&journal.film), Balance::new(&journal.film));
        let outputs = vec![0.0; journal.film.kernel.outputs.len()];
        Bench { journal, oil, balance, outputs }
    }

    pub(super) fn react(&mut self, motion: &JournalMotion) -> Reaction {
        let Bench { journal, oil, balance, outputs } = self;
        journal.react(motion, oil, balance, outputs).expect("a film in balance")
    }

    pub(super) fn p_max(&self) -> f64 {
        self.oil.unknowns[0].iter().copied().fold(0.0, f64::max)
    }
}

/// Turning about a fixed place, on the axis x.
pub(super) fn turning(eps: f64) -> JournalMotion {
    JournalMotion { displacement: [eps * CLEARANCE, 0.0], omega: OMEGA, ..JournalMotion::default() }
}

/// Sommerfeld's number S = μ N/P (R/c)² and the attitude angle in degrees of a force on a journal on the axis x.
pub(super) fn sommerfeld(force: [f64; 2], length: f64) -> [f64; 2] {
    let load = force[0].hypot(force[1]);
    let pressure = load / (2.0 * RADIUS * length);
    let turns = OMEGA / std::f64::consts::TAU;
    let number = VISCOSITY * turns / pressure * (RADIUS / CLEARANCE).powi(2);
    [number, (force[1].abs() / force[0].abs()).atan().to_degrees()]
}

/// Two numbers agree to so much of the second.
#[track_caller]
pub(super) fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    let error = found / expected - 1.0;
    assert!(error.abs() <= tolerance, "{what}: {found} against {expected}, {error:+.2e}");
}
