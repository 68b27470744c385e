//! How a machine moves by what turns with one of its bodies: Σ z_nk e^{i(nφ + kθ)}, φ the angle of that body, θ that by which the
//! body that is not round has turned on from where it stands, if there is one.

use std::collections::BTreeMap;

use num_complex::Complex64;

use super::linearised::{Linearised, Standstill};
use super::load_orders::HALVES;
use super::round::LinearMachine;
use crate::error::Error;

/// Harmonics on both sides, in steps of the equations, of a machine with a body that is not round.
const HARMONICS: i32 = 3;

/// A motion Re(z e^{i(nφ + kθ)}).
#[derive(Debug, Clone)]
pub(super) struct Part {
    /// n in halves, as engines come again after two turns.
    pub(super) order: i32,
    /// k.
    pub(super) beside: i32,
    /// z over the coordinates of [`Linearised`].
    pub(super) shape: Vec<Complex64>,
    /// Whether it is the state itself that stands, and no motion about it.
    pub(super) stands: bool,
}

/// The motion by what turns with a body.
#[derive(Debug, Clone)]
pub struct Excited {
    /// That body.
    pub(super) body: usize,
    /// The body that is not round, if one turns.
    pub(super) uneven: Option<usize>,
    /// φ − θ, if both turn alike (rad).
    before: Option<f64>,
    pub(super) parts: Vec<Part>,
}

impl Excited {
    /// Whether it is by what turns with the body that is not round: with the mean over its turns.
    pub fn is_of_uneven(&self) -> bool {
        self.uneven == Some(self.body) && !self.parts.is_empty()
    }

    /// The body with which what excites turns, by its place.
    pub fn body(&self) -> usize {
        self.body
    }

    /// The order of the body, in halves from zero on, at which a harmonic of the angle θ beside an order is seen, and what Re(z …) of
    /// it is there; none of another frequency, as that of another body makes.
    pub(super) fn seen_at(&self, order: i32, beside: i32) -> Option<(i32, Seen)> {
        let order = match self.before {
            Some(_) => order + beside * HALVES as i32,
            None if beside == 0 => order,
            None => return None,
        };
        let phase = -f64::from(beside) * self.before.unwrap_or(0.0);
        Some((order.abs(), Seen { sign: order.signum(), turn: Complex64::from_polar(1.0, phase) }))
    }

    /// The coordinates of [`Linearised`] by orders of the body, in rising order, those of the order 0 real: where they are in the
    /// mean.
    pub fn by_orders(&self) -> Vec<(f64, Vec<Complex64>)> {
        let mut moved: BTreeMap<i32, Vec<Complex64>> = BTreeMap::new();
        for part in &self.parts {
            let Some((order, seen)) = self.seen_at(part.order, part.beside) else { continue };
            let nothing = || vec![Complex64::ZERO; part.shape.len()];
            let sum = moved.entry(order).or_insert_with(nothing).iter_mut();
            sum.zip(&part.shape).for_each(|(sum, own)| *sum += seen.of(*own));
        }
        moved.into_iter().map(|(order, own)| (f64::from(order) / HALVES, own)).collect()
    }
}

/// How what moves with an order that may be negative is seen at one from zero on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    sign: i32,
    turn: Complex64,
}

impl Seen {
    /// Of Re(z e^{inφ}) what is at |n|: z, its conjugate, or its real part.
    pub(super) fn of(&self, own: Complex64) -> Complex64 {
        let own = own * self.turn;
        match self.sign {
            0 => own.re.into(),
            ..0 => own.conj(),
            _ => own,
        }
    }
}

impl LinearMachine {
    /// Whether two bodies are one in what turns with them: those that are not round and turn alike.
    pub(super) fn turns_as_one(&self, at: &Standstill, body: usize, other: usize) -> bool {
        let is_uneven = |body: usize| self.not_round().any(|own| own == body);
        let alike = at.speeds[other] == at.speeds[body];
        other == body || alike && is_uneven(body) && is_uneven(other)
    }

    /// How the machine moves by what turns with a body; nothing where there is no response.
    ///
    /// # Errors
    /// A matrix that is singular: a critical speed without damping.
    pub fn excited(
        &self,
        (at, equations): (&Standstill, &Linearised),
        body: usize,
    ) -> Result<Excited, Error> {
        let speed = at.speeds[body];
        let uneven = self.uneven_at(at)?.map(|(_, own)| own);
        let is_alike = uneven.is_none_or(|own| at.speeds[own] == speed);
        let before = is_alike.then(|| self.stands_at(at, body));
        let mut own = Excited { body, uneven, before, parts: Vec::new() };
        if !self.responds_at(at, speed) {
            return Ok(own);
        }
        let forces = self.forces(at, body);
        let Some(uneven) = uneven else {
            for (order, force) in &forces {
                let omega = f64::from(*order) / HALVES * speed;
                let shape = equations.moved_by(omega, force)?;
                own.parts.push(Part { order: *order, beside: 0, shape, stands: false });
            }
            return Ok(own);
        };
        let periodic = self.periodic(at)?;
        for (order, force) in &forces {
            let frequency = f64::from(*order) / HALVES * speed;
            let of = |k: i32| (k == 0).then(|| force.clone());
            let parts = periodic.forced(HARMONICS, frequency, &of)?.into_iter();
            let order = *order;
            own.parts.extend(parts.map(|(beside, shape)| Part {
                order,
                beside,
                shape,
                stands: false,
            }));
        }
        if uneven == body {
            let shape = self.standing_at_coordinates(at, equations.angles);
            own.parts.push(Part { order: 0, beside: 0, shape, stands: true });
        }
        Ok(own)
    }

    /// The coordinates of small motions at the state that stands.
    fn standing_at_coordinates(&self, at: &Standstill, angles: usize) -> Vec<Complex64> {
        let first = self.machine.rotations();
        let mut own = at.found.state.q[first..].to_vec();
        for body in self.turning() {
            let block = self.block(0, body);
            let turned = self.in_space(at, body, &own[block.clone()]);
            own[block].copy_from_slice(&turned);
        }
        let own = own.into_iter().map(Complex64::from);
        std::iter::repeat_n(Complex64::ZERO, angles).chain(own).collect()
    }
}
