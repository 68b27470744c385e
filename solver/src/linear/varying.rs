//! Equations of small motions of a machine with a body that is not round.
//!
//! They vary with its angle, seen from space. In its own frame they do not if all that stands beside it is round and no load
//! stands in space: that frame is tried first, at angles that no symmetry knows. Otherwise they are sampled over a turn.

use std::f64::consts::TAU;

use super::frame::Seen;
use super::linearised::{Linearised, Standstill};
use super::round::LinearMachine;
use crate::equations::{Equations, State, Tangents};
use crate::error::Error;
use crate::linalg::{Harmonic, Matrix, Periodic};
use crate::machine::Machine;

/// Angles (rad) at which matrices are compared; no even part of a turn.
pub(super) const ANGLES: [f64; 3] = [0.7297, 2.1131, 4.4569];
/// What other bodies are turned by beside, so that nothing is taken for constant as angles happen to agree.
const OTHERS: f64 = 1.9371;
/// Entries that differ by less, measured by those on the diagonal, are the same.
const SAME: f64 = 1e-9;
/// Harmonics smaller than this are rounding.
const NOTHING: f64 = 1e-11;
/// Samples over a turn; the first count with which the highest harmonics are nothing.
const SAMPLES: [usize; 3] = [12, 24, 96];

impl LinearMachine {
    /// The machine with its bodies that are not round, and one of those that turn at a state.
    ///
    /// # Errors
    /// Two that turn at different speeds.
    pub(super) fn uneven_at(&self, at: &Standstill) -> Result<Option<(&Machine, usize)>, Error> {
        let Some(machine) = &self.uneven else { return Ok(None) };
        let mut turning = self.not_round().filter(|&body| at.speeds[body] != 0.0);
        let Some(body) = turning.next() else { return Ok(None) };
        if let Some(other) = turning.find(|&other| at.speeds[other] != at.speeds[body]) {
            let names = [body, other].map(|own| machine.bodies[own].name().to_owned());
            return Err(Error::TwoNotRound { bodies: names });
        }
        Ok(Some((machine, body)))
    }

    /// The tangents about a state with its bodies turned on by `angle` of a body (rad).
    pub(super) fn tangents(
        &self,
        machine: &Machine,
        at: &Standstill,
        angle: &dyn Fn(usize) -> f64,
    ) -> Tangents {
        let state = self.turned_on(at, angle);
        let mut equations = Equations::new(machine);
        equations.release(&at.found.released);
        equations.evaluate(0.0, &state);
        equations.tangents(&state)
    }

    /// A state that stands with its bodies turned on.
    pub(super) fn turned_on(&self, at: &Standstill, angle: &dyn Fn(usize) -> f64) -> State {
        let mut state: State = at.found.state.clone();
        for body in self.turning() {
            let own = &self.machine.places()[body];
            let Some(theta) = own.rotation else { continue };
            let angle = angle(body);
            if angle == 0.0 {
                continue;
            }
            state.q[theta] += angle;
            let back = self.own(body, angle, 0.0).expect("a body that turns").back();
            for values in [&mut state.q, &mut state.v, &mut state.a] {
                let turned = back.apply(&values[own.flexible.clone()]);
                values[own.flexible.clone()].copy_from_slice(&turned);
            }
        }
        state
    }

    /// How a body is seen.
    pub(super) fn own(&self, body: usize, angle: f64, rate: f64) -> Option<Seen<'_>> {
        let [once, twice] = self.generators[body].as_ref()?;
        Some(Seen { generators: [once, twice], angle, rate })
    }

    /// The angle at which a body stands in a state (rad): that of a train is twisted by the couples that it carries.
    pub(super) fn stands_at(&self, at: &Standstill, body: usize) -> f64 {
        self.machine.places()[body].rotation.map_or(0.0, |theta| at.found.state.q[theta])
    }

    /// Coordinates of a body in the frame in which it stands, as space sees them.
    pub(super) fn in_space(&self, at: &Standstill, body: usize, own: &[f64]) -> Vec<f64> {
        let angle = self.stands_at(at, body);
        match self.own(body, -angle, 0.0).filter(|_| angle != 0.0) {
            Some(seen) => seen.back().apply(own),
            None => own.to_vec(),
        }
    }

    /// Generalised forces on the coordinates of a body that has turned on by an angle (rad) from where it stands, as those on the
    /// coordinates that space sees.
    pub(super) fn force_in_space(
        &self,
        at: &Standstill,
        (body, on): (usize, f64),
        own: &mut [f64],
    ) {
        let angle = self.stands_at(at, body) + on;
        if let Some(seen) = self.own(body, angle, 0.0).filter(|_| angle != 0.0) {
            let turned = seen.back().apply_transpose(own);
            own.copy_from_slice(&turned);
        }
    }

    /// How bodies that turn on by `angle` are seen from a frame at an angle (rad) that turns with a speed (rad/s).
    pub(super) fn seen(
        &self,
        at: &Standstill,
        angle: &dyn Fn(usize) -> f64,
        (frame, speed): (f64, f64),
    ) -> Vec<Option<Seen<'_>>> {
        let mut all: Vec<Option<Seen>> = (0..self.machine.bodies.len()).map(|_| None).collect();
        for body in self.turning() {
            let angle = self.stands_at(at, body) + angle(body) - frame;
            all[body] = self.own(body, angle, at.speeds[body] - speed);
        }
        if speed != 0.0 {
            for (own, sense) in all.iter_mut().zip(&self.senses) {
                if let (None, Some([once, twice])) = (&own, sense) {
                    *own = Some(Seen { generators: [once, twice], angle: -frame, rate: -speed });
                }
            }
        }
        all
    }

    /// The equations about a state at which a body turns that is not round.
    pub(super) fn varying(&self, at: &Standstill, machine: &Machine, body: usize) -> Linearised {
        let speed = at.speeds[body];
        let first = self.sample((at, machine, body), [0.0, 0.0], true);
        let is_constant = ANGLES.iter().all(|angle| {
            let own = self.sample((at, machine, body), [*angle, OTHERS * angle], true);
            apart(&first, &own, speed) <= SAME
        });
        if is_constant {
            return Linearised { frame: speed, ..self.constant(at, first) };
        }
        let periodic = self.over_a_turn(at, machine, body);
        let means = periodic.means.clone();
        Linearised { varying: Some(periodic), ..self.constant(at, means) }
    }
}

impl LinearMachine {
    /// The equations at a state over the angle of its body that is not round.
    ///
    /// # Errors
    /// Two of them at different speeds.
    pub(super) fn periodic(&self, at: &Standstill) -> Result<Periodic, Error> {
        let (machine, body) = self.uneven_at(at)?.expect("a body that is not round");
        Ok(self.over_a_turn(at, machine, body))
    }

    /// M′, C′ and K′ with a body at an angle, bodies at its speed at the same, and others turned by another one beside what
    /// their speeds make of it; seen from space or in the frame of the body.
    pub(super) fn sample(
        &self,
        (at, machine, body): (&Standstill, &Machine, usize),
        [angle, others]: [f64; 2],
        in_its_frame: bool,
    ) -> [Matrix; 3] {
        let speed = at.speeds[body];
        let of = |other: usize| {
            let apart = if at.speeds[other] == speed { 0.0 } else { others };
            angle * at.speeds[other] / speed + apart
        };
        let tangents = self.tangents(machine, at, &of);
        let frame = if in_its_frame { (angle, speed) } else { (0.0, 0.0) };
        self.in_frame((&at.angles, &tangents), &self.seen(at, &of, frame))
    }

    /// The largest share by which an entry of the equations of round bodies differs at other angles: 0 but for joints that are
    /// not alike all round.
    pub(super) fn varies(&self, at: &Standstill) -> f64 {
        let fastest = at.speeds.iter().map(|own| own.abs()).fold(0.0, f64::max);
        if fastest == 0.0 {
            return 0.0;
        }
        let sample = |time: f64| {
            let of = |body: usize| at.speeds[body] / fastest * time;
            let tangents = self.tangents(&self.machine, at, &of);
            self.in_frame((&at.angles, &tangents), &self.seen(at, &of, (0.0, 0.0)))
        };
        let first = sample(0.0);
        ANGLES.iter().map(|time| apart(&first, &sample(*time), fastest)).fold(0.0, f64::max)
    }

    fn over_a_turn(&self, at: &Standstill, machine: &Machine, body: usize) -> Periodic {
        let sample = |angle: f64| self.sample((at, machine, body), [angle, 0.0], false);
        let speed = at.speeds[body];
        let mut periodic = None;
        for count in SAMPLES {
            let samples: Vec<[Matrix; 3]> =
                (0..count).map(|k| sample(TAU * k as f64 / count as f64)).collect();
            let found = harmonics(&samples, speed);
            let is_resolved =
                found.harmonics.last().is_none_or(|own| 3 * own.order as usize <= count);
            periodic = Some(found);
            if is_resolved {
                break;
            }
        }
        periodic.expect("it was sampled")
    }
}

/// The largest difference of entries of M, C and K, measured by √(s_i s_j), s = |K_ii| + Ω² M_ii.
fn apart(a: &[Matrix; 3], b: &[Matrix; 3], speed: f64) -> f64 {
    let difference = |k: usize| {
        let (a, b) = (&a[k], &b[k]);
        Matrix::from_fn(a.rows, a.cols, |i, j| a[(i, j)] - b[(i, j)])
    };
    size(&[0, 1, 2].map(difference), a, speed)
}

/// The largest entry of M, C and K, measured by those on the diagonals of others.
fn size(own: &[Matrix; 3], by: &[Matrix; 3], speed: f64) -> f64 {
    let n = own[0].rows;
    let scales: Vec<f64> = (0..n)
        .map(|i| (by[2][(i, i)].abs() + speed * speed * by[0][(i, i)].abs()).sqrt())
        .map(|own| if own > 0.0 { own } else { 1.0 })
        .collect();
    let weights = [speed * speed, speed.abs(), 1.0];
    let entry = |i: usize, j: usize| {
        let most = own.iter().zip(weights).map(|(own, weight)| weight * own[(i, j)].abs());
        most.fold(0.0, f64::max) / (scales[i] * scales[j])
    };
    (0..n * n).map(|place| entry(place % n, place / n)).fold(0.0, f64::max)
}

/// M, C and K by harmonics of the angle, of even samples over a turn.
fn harmonics(samples: &[[Matrix; 3]], speed: f64) -> Periodic {
    let count = samples.len();
    let (rows, cols) = (samples[0][0].rows, samples[0][0].cols);
    let part = |order: usize, weight: fn(f64) -> f64| -> [Matrix; 3] {
        [0, 1, 2].map(|matrix| {
            let mut sum = Matrix::zeros(rows, cols);
            for (k, sample) in samples.iter().enumerate() {
                // Whole turns are taken off first, so that even angles have even factors.
                let angle = TAU * ((k * order) % count) as f64 / count as f64;
                let weight = weight(angle) / count as f64;
                let own = sum.data.iter_mut().zip(&sample[matrix].data);
                own.for_each(|(sum, own)| *sum += weight * own);
            }
            sum
        })
    };
    let means = part(0, |_| 1.0);
    let all = (1..count.div_ceil(2)).filter_map(|order| {
        let [re, im] = [part(order, f64::cos), part(order, |angle| -angle.sin())];
        let most = size(&re, &means, speed).max(size(&im, &means, speed));
        let ([a, b, c], [d, e, f]) = (re, im);
        (most > NOTHING)
            .then_some(Harmonic { order: order as i32, parts: [[a, d], [b, e], [c, f]] })
    });
    let harmonics = all.collect();
    let [mass, damping, stiffness] = means;
    Periodic { means: [mass.symmetric_part(), damping, stiffness], harmonics, speed }
}
