//! Damped modes of small motions, and how they whirl.

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::growing::Growing;
use super::linearised::Linearised;
use super::motions::{Motion, growth, is_listed};
use super::round::LinearMachine;
use super::shapes::{apply, inner};
use crate::error::Error;
use crate::linalg::{Matrix, hermitian_eigen};

/// Share of λ by which two are the same.
const EQUAL: f64 = 1e-7;
/// Share of a motion that must be circular for its sense to be named.
const CIRCULAR: f64 = 0.1;

/// The sense in which a motion goes round.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Whirl {
    /// As the body whose speed it is asked for turns.
    Forward,
    /// Against it.
    Backward,
    /// In a plane, along the axis, or about it; or seen by a body at rest, of which nothing is forward.
    None,
}

/// x e^{λt}, seen from space.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// λ (1/s), Im λ ≥ 0.
    pub value: Complex64,
    /// x over the coordinates of [`Linearised`], xᴴM′x = 1.
    pub shape: Vec<Complex64>,
    /// (−1 to 1): 1 of a motion all of whose parts circle about +z as x turns to y, −1 of one the other way round.
    pub sense: f64,
    /// Shares of xᴴM′x by body, in their order.
    pub shares: Vec<f64>,
    /// Frequencies (rad/s) with which it moves besides, where a body that turns is not round, with their shares of the largest
    /// part.
    pub beside: Vec<(f64, f64)>,
}

impl Mode {
    /// Im λ/2π (Hz).
    pub fn hertz(&self) -> f64 {
        self.value.im / TAU
    }

    /// ζ = −Re λ/|λ|.
    pub fn damping_ratio(&self) -> f64 {
        -self.value.re / self.value.norm()
    }

    /// δ = −2π Re λ/Im λ.
    pub fn log_decrement(&self) -> f64 {
        -TAU * self.value.re / self.value.im
    }

    /// Whether it grows, by more than rounding makes.
    pub fn grows(&self) -> bool {
        self.growth() > 0.0
    }

    /// Re λ less what may be rounding of it (1/s).
    pub(super) fn growth(&self) -> f64 {
        growth(self.value)
    }

    /// How it whirls, seen by a body that turns in the sense of `speed`.
    pub fn whirl(&self, speed: f64) -> Whirl {
        let sense = if speed < 0.0 { -self.sense } else { self.sense };
        match sense {
            _ if speed == 0.0 => Whirl::None,
            own if own > CIRCULAR => Whirl::Forward,
            own if own < -CIRCULAR => Whirl::Backward,
            _ => Whirl::None,
        }
    }
}

/// The ellipse of a point that moves as Re(w e^{iωt}).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    /// Major semi-axis.
    pub major: f64,
    /// Minor semi-axis, below zero if it goes round from y to x.
    pub minor: f64,
}

impl Orbit {
    /// Of complex amplitudes along x and y: circles of radius |x − iy|/2 and |x + iy|/2 in both senses.
    pub fn new([x, y]: [Complex64; 2]) -> Orbit {
        let i = Complex64::i();
        // Re((x, y) e^{iωt}) circles from x to y as (1, −i).
        let (forward, backward) = (0.5 * (x + i * y).norm(), 0.5 * (x - i * y).norm());
        Orbit { major: forward + backward, minor: forward - backward }
    }

    /// How it goes round, seen by a body that turns in the sense of `speed`.
    pub fn whirl(&self, speed: f64) -> Whirl {
        // Of circles a and b in both senses the share (a² − b²)/(a² + b²) is circular.
        let share =
            2.0 * self.major * self.minor / (self.major * self.major + self.minor * self.minor);
        match if speed < 0.0 { -share } else { share } {
            _ if speed == 0.0 => Whirl::None,
            own if own > CIRCULAR => Whirl::Forward,
            own if own < -CIRCULAR => Whirl::Backward,
            _ => Whirl::None,
        }
    }
}

/// The modes at a state.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Those that oscillate, by their frequency: the slowest ones, as many as were asked for.
    pub oscillating: Vec<Mode>,
    /// All that grow, fastest first, whether they oscillate and are listed or not.
    pub growing: Vec<Growing>,
}

impl Modes {
    /// Whether every motion dies out, or neither dies out nor grows.
    pub fn is_stable(&self) -> bool {
        self.growing.is_empty()
    }
}

impl LinearMachine {
    /// The modes of the equations of small motions; of those that oscillate the slowest `count`.
    ///
    /// # Errors
    /// A mass that is not positive definite, or values that are not finite.
    pub fn modes(&self, equations: &Linearised, count: usize) -> Result<Modes, Error> {
        self.modes_while(equations, count, &|| true)
    }

    /// The same; `goes_on` is asked on the way where they take long, as of a body that turns and is not round.
    ///
    /// # Errors
    /// As [`LinearMachine::modes`], and [`Error::Interrupted`].
    pub fn modes_while(
        &self,
        equations: &Linearised,
        count: usize,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Modes, Error> {
        self.modes_in(equations, None, count, goes_on)
    }

    /// The same of motions in a basis of slow ones, if there is one.
    pub(super) fn modes_in(
        &self,
        equations: &Linearised,
        basis: Option<&Matrix>,
        count: usize,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Modes, Error> {
        self.modes_of(equations, self.motions(equations, basis, count, goes_on)?, count)
    }

    /// The modes among all motions.
    pub(super) fn modes_of(
        &self,
        equations: &Linearised,
        motions: Vec<Motion>,
        count: usize,
    ) -> Result<Modes, Error> {
        let growing = self.growing(equations, &motions);
        let mut moving: Vec<Motion> =
            motions.into_iter().filter(|own| is_listed(own.value)).collect();
        moving.sort_by(|a, b| a.value.im.total_cmp(&b.value.im));
        let mut oscillating: Vec<Mode> = Vec::with_capacity(moving.len());
        let mut rest = moving.as_slice();
        while let (Some(first), true) = (rest.first(), oscillating.len() < count) {
            let same =
                |own: &Motion| (own.value - first.value).norm() <= EQUAL * first.value.norm();
            let alike = rest.iter().take_while(|own| same(own)).count();
            let (cluster, other) = rest.split_at(alike);
            oscillating.extend(self.separated(equations, cluster)?);
            rest = other;
        }
        oscillating.truncate(count);
        Ok(Modes { oscillating, growing })
    }

    /// Modes of one eigenvalue: those that circle, where there are several.
    fn separated(&self, equations: &Linearised, cluster: &[Motion]) -> Result<Vec<Mode>, Error> {
        let mass = &equations.mass;
        let angles = equations.turning.len();
        let mut shapes: Vec<Vec<Complex64>> = Vec::with_capacity(cluster.len());
        let mut moved: Vec<Vec<Complex64>> = Vec::with_capacity(cluster.len());
        for pair in cluster {
            // Orthonormal in M within the cluster.
            let mut own = pair.shape.clone();
            for (other, moved) in shapes.iter().zip(&moved) {
                let part = inner(moved, &own);
                own.iter_mut().zip(other).for_each(|(own, other)| *own -= part * other);
            }
            let mut own_moved = apply(mass, &own);
            let norm = inner(&own_moved, &own).re.sqrt();
            own.iter_mut().chain(&mut own_moved).for_each(|value| *value /= norm);
            shapes.push(own);
            moved.push(own_moved);
        }
        if shapes.len() > 1 {
            let turned: Vec<Vec<Complex64>> =
                shapes.iter().map(|shape| apply(mass, &self.turned(angles, shape))).collect();
            let n = shapes.len();
            let entries = (0..n * n).map(|k| inner(&shapes[k % n], &turned[k / n]));
            let (_, vectors) = hermitian_eigen(n, &entries.collect::<Vec<_>>())?;
            let mixed = (0..n).map(|k| {
                let mut sum = vec![Complex64::ZERO; mass.rows];
                for (shape, weight) in shapes.iter().zip(&vectors[k * n..(k + 1) * n]) {
                    sum.iter_mut().zip(shape).for_each(|(sum, own)| *sum += weight * own);
                }
                sum
            });
            shapes = mixed.collect();
            moved = shapes.iter().map(|own| apply(mass, own)).collect();
        }
        let value = cluster.iter().map(|own| own.value).sum::<Complex64>() / cluster.len() as f64;
        let single = cluster.len() == 1;
        let modes = shapes.into_iter().zip(&moved).zip(cluster).map(|((shape, moved), pair)| {
            let whole = inner(&shape, moved).re;
            let sense = inner(moved, &self.turned(angles, &shape)).re / whole;
            let shares = self.shares(equations, &shape);
            let value = if single { pair.value } else { value };
            Mode { value, shape, sense, shares, beside: pair.beside.clone() }
        });
        Ok(modes.collect())
    }

    /// −iS x, of all bodies whose S is known.
    pub(super) fn turned(&self, angles: usize, shape: &[Complex64]) -> Vec<Complex64> {
        let mut out = vec![Complex64::ZERO; shape.len()];
        for body in 0..self.machine.bodies.len() {
            let generator = self.generators[body].as_ref().or(self.senses[body].as_ref());
            if let Some([generator, _]) = generator {
                let block = self.block(angles, body);
                let turned = apply(generator, &shape[block.clone()]);
                let own = out[block].iter_mut().zip(turned);
                own.for_each(|(out, value)| *out = -Complex64::i() * value);
            }
        }
        out
    }
}
