//! The state of a film.

use super::openings::OilFilm;

/// Pressure and its partner at the nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Oil {
    /// Both unknowns of the film's spec, SI; a value a node.
    pub unknowns: [Vec<f64>; 2],
    /// Whether the second is the one that is not zero.
    pub(super) second: Vec<bool>,
}

impl Oil {
    /// Full of oil without pressure but at openings.
    pub fn full(film: &OilFilm) -> Self {
        let nodes = film.grid.nodes();
        let mut oil =
            Oil { unknowns: [vec![0.0; nodes], vec![0.0; nodes]], second: vec![false; nodes] };
        oil.supply(film);
        oil
    }

    /// Puts the pressures of openings to their nodes.
    pub fn supply(&mut self, film: &OilFilm) {
        for opening in &film.openings {
            for node in &opening.nodes {
                for (unknown, value) in [opening.pressure, 0.0].into_iter().enumerate() {
                    if opening.edge.given[unknown] {
                        self.unknowns[unknown][*node] = value;
                    }
                }
                self.second[*node] &= opening.edge.out;
            }
        }
    }

    /// Which unknown of a node is not zero; none where both are given or what leaves takes its place.
    pub(super) fn active(&self, film: &OilFilm, node: usize) -> Option<usize> {
        let second = self.second[node];
        match film.opening_of[node].map(|own| film.openings[own].edge) {
            None => Some(usize::from(second)),
            Some(edge) => (edge.out && second).then_some(1),
        }
    }

    /// Takes a value a node: the first unknown, or the second with the sign changed. What openings give is left as they give it.
    pub fn take_values(&mut self, film: &OilFilm, values: &[f64]) {
        for (a, value) in values.iter().enumerate() {
            self.second[a] = value.is_sign_negative();
            self.unknowns[0][a] = value.max(0.0);
            self.unknowns[1][a] = (-value).max(0.0);
        }
        self.supply(film);
    }

    /// Both unknowns, for checkpoints: the second is kept where it is not zero.
    pub fn write(&self, out: &mut [f64]) {
        let nodes = self.second.len();
        for a in 0..nodes {
            out[a] = self.unknowns[0][a];
            // A second unknown of zero that takes part is told from one that does not by its sign.
            let other = self.unknowns[1][a];
            out[nodes + a] = if self.second[a] { other } else { -0.0 };
        }
    }

    /// What [`Oil::write`] wrote.
    pub fn read(&mut self, from: &[f64]) {
        let nodes = self.second.len();
        for a in 0..nodes {
            self.unknowns[0][a] = from[a];
            self.second[a] = from[nodes + a].is_sign_positive();
            self.unknowns[1][a] = from[nodes + a].abs();
        }
    }
}
