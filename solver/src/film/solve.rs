//! The iteration to the next state of a film: Newton's method on min(p, r) by an active set.

use super::balance::Balance;
use super::oil::Oil;
use super::openings::OilFilm;

/// Most changes of a steady film: a front of reformation moves by about a cell each time.
const MOST: usize = 400;
/// What may be lacking at a node, of what flows there, where rounding lets it get no smaller.
const ROUNDED: f64 = 1e-9;
/// Flows at a node count as this part of the largest at least: where the gap is a tenth as wide, a thousandth flows.
const LEAST: f64 = 1e-6;
/// What may be lacking where nothing was changed yet: a film that is left as it was does not answer small motions.
const NOTHING: f64 = 1e-16;
/// Change of an unknown, of the largest of its kind, that is rounding.
const RESTS: f64 = 1e-13;

/// Why a film has no solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unsolved {
    /// The balance grew beyond numbers.
    Unbounded,
    /// What is lacking, of the largest sum of flows, after so many changes.
    Lacking(f64, usize),
}

impl Balance {
    /// Solves the film for the motion of the surfaces, from the state given on. The number of changes.
    ///
    /// # Errors
    /// A balance that is not reached.
    pub fn solve(&mut self, film: &OilFilm, oil: &mut Oil) -> Result<usize, Unsolved> {
        oil.supply(film);
        self.evaluate(film, oil);
        let mut best = f64::INFINITY;
        let mut change = f64::INFINITY;
        for changes in 0..MOST {
            let lacking = self.lacking(film, oil);
            if !lacking.is_finite() {
                return Err(Unsolved::Unbounded);
            }
            // Where it has stopped to fall, rounding rules.
            let rounded = lacking <= ROUNDED && lacking >= 0.5 * best;
            best = best.min(lacking);
            let balanced = lacking <= self.tolerance && (change.is_finite() || lacking <= NOTHING);
            if balanced || rounded {
                return Ok(changes);
            }
            self.factor(film, oil);
            change = self.advance(film, oil);
            self.evaluate(film, oil);
            if change <= RESTS {
                return Ok(changes + 1);
            }
        }
        Err(Unsolved::Lacking(self.lacking(film, oil), MOST))
    }

    /// The largest R of a node as it was evaluated last, of what flows there; what may leave does not count.
    fn lacking(&self, film: &OilFilm, oil: &Oil) -> f64 {
        let mut worst: f64 = 0.0;
        let least = LEAST * self.scale;
        for (a, r) in self.residual.iter().enumerate() {
            let lacks = match film.opening_of[a].map(|own| film.openings[own].edge) {
                Some(edge) if !edge.out => continue,
                // R = −out.
                Some(_) if !oil.second[a] => r.max(0.0),
                _ => r.abs(),
            };
            let lacks = if self.scale > 0.0 { lacks / (self.change[a] + least) } else { lacks };
            // Not by `max`, which drops what is no number.
            if !(lacks <= worst) {
                worst = lacks;
            }
        }
        worst
    }

    /// One linear solution; unknowns that fell below zero change places with their partners. The largest change, of the largest
    /// unknown of its kind, without bound where some changed places: where a film stands under one pressure nothing flows by which
    /// a lack could be measured.
    fn advance(&mut self, film: &OilFilm, oil: &mut Oil) -> f64 {
        let sizes = oil.unknowns.each_ref().map(|own| own.iter().copied().fold(0.0, f64::max));
        let mut most: f64 = 0.0;
        for (a, r) in self.residual.iter().enumerate() {
            self.change[self.order[a]] = -r;
        }
        self.matrix.solve(&mut self.change);
        for a in 0..oil.second.len() {
            let change = self.change[self.order[a]];
            let edge = film.opening_of[a].map(|own| film.openings[own].edge);
            match (edge, oil.active(film, a)) {
                (Some(edge), _) if !edge.out => {}
                // What leaves.
                (_, None) => {
                    oil.second[a] = change < 0.0;
                    if oil.second[a] {
                        most = f64::INFINITY;
                    }
                }
                (_, Some(unknown)) => {
                    let value = oil.unknowns[unknown][a] + change;
                    let stays = value >= 0.0;
                    most = match (stays, change == 0.0) {
                        (true, true) => most,
                        (true, false) => most.max(change.abs() / sizes[unknown]),
                        (false, _) => f64::INFINITY,
                    };
                    oil.unknowns[unknown][a] = if stays { value } else { 0.0 };
                    oil.second[a] = (unknown == 1) == stays;
                }
            }
        }
        most
    }

    /// What enters at an opening (m³/s); negative where oil leaves. Of a film that carries no fill, the oil with which its cavity
    /// fills up again comes from nowhere, and does not enter where there is no pressure; at an edge of an arc that is in oil the
    /// journal draws it in.
    pub fn inflow(&self, film: &OilFilm, opening: usize) -> f64 {
        let own = &film.openings[opening];
        let feeds = own.pressure > 0.0 || film.carries_fill() || film.is_edge_in_oil(opening);
        let flows = own.nodes.iter().map(|node| self.residual[*node]);
        flows.map(|flow| if feeds { flow } else { flow.min(0.0) }).sum()
    }

    /// What enters at all openings (m³/s), and what leaves, node by node: at a flooded end oil comes and goes.
    pub fn exchanged(&self, film: &OilFilm) -> [f64; 2] {
        let nodes = film.openings.iter().flat_map(|own| &own.nodes);
        nodes.fold([0.0; 2], |[enters, leaves], node| {
            let own = self.residual[*node];
            [enters + own.max(0.0), leaves + (-own).max(0.0)]
        })
    }

    /// Oil between the surfaces, by the gap that holds it (m³).
    pub fn volume(&self, film: &OilFilm) -> f64 {
        self.held().iter().zip(&film.areas).map(|(held, area)| held * area).sum()
    }
}
