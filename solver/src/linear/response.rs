//! Response to what turns with a body: unbalance, loads fixed to it or going by its angle.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use num_complex::Complex64;

use super::first_order;
use super::linearised::{Linearised, Standstill};
use super::load_orders::HALVES;
use super::modes::Orbit;
use super::round::LinearMachine;
use super::standing_loads::mean;
use crate::bearing::LawStates;
use crate::equations::{Equations, State, instant, placed};
use crate::error::Error;
use crate::linalg::dot;
use crate::loads::Load;
use crate::machine::Machine;
use crate::output::{Motion, Wanted};
use crate::plane_rows::PlaneRows;

/// Samples of them.
const SAMPLES: usize = 96;
/// What is smaller than this share of the largest is nothing.
const NOTHING: f64 = 1e-6;
/// Amplitudes up to which a motion is rounding (m), but for those of loads that turn with the body.
const LEAST: f64 = 1e-10;
/// Share of the forces that act that is rounding of them.
const ROUNDING: f64 = 1e-9;

/// The rates of the states of laws where the springs were evaluated last; empty without states.
fn state_rates(equations: &Equations, laws: &LawStates) -> Vec<f64> {
    if equations.machine.springs.states() == 0 {
        return Vec::new();
    }
    let mut laws = laws.clone();
    equations.springs.keep_states(&mut laws);
    laws.rates
}

/// A point whose motion is wanted.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Its name, as the tables of a case have it: `joint.NAME` or `output.NAME`.
    pub name: String,
    rows: PlaneRows,
}

/// How a point moves: Re(w e^{iωt}).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vibration {
    /// Complex amplitudes along x and y (m).
    pub amplitudes: [Complex64; 2],
}

impl Vibration {
    /// Its ellipse (m).
    pub fn orbit(&self) -> Orbit {
        Orbit::new(self.amplitudes)
    }

    /// Amplitude along a direction at an angle (rad) from x (m): of a probe that stands there.
    pub fn along(&self, angle: f64) -> f64 {
        self.reading(angle).norm()
    }

    /// Complex amplitude of the same (m).
    pub fn reading(&self, angle: f64) -> Complex64 {
        let (sin, cos) = angle.sin_cos();
        cos * self.amplitudes[0] + sin * self.amplitudes[1]
    }

    /// Displacement along x and y when ωt has a value (rad), in m.
    pub fn at(&self, turn: f64) -> [f64; 2] {
        self.amplitudes.map(|own| (own * Complex64::from_polar(1.0, turn)).re)
    }

    /// Whether it is on the other side of the axis than another one, by the mean over the motion.
    pub fn is_opposite(&self, other: &Vibration) -> bool {
        let parts = self.amplitudes.iter().zip(&other.amplitudes);
        parts.map(|(own, other)| (own.conj() * other).re).sum::<f64>() < 0.0
    }
}

/// Takes loads of equations at a state away, of those that `by` chooses by their places, and adds what stands in their place, if
/// there is such.
fn add_loads(
    (state, released): (&State, &[bool]),
    equations: &mut Equations,
    by: &dyn Fn(usize, &Load) -> Option<Option<Load>>,
) {
    let machine = equations.machine;
    let now = instant(machine, 0.0, state);
    for (number, (load, released)) in machine.loads.iter().zip(released).enumerate() {
        let Some(other) = by(number, load) else { continue };
        let (place, position) = placed(machine, load, &state.q);
        for (sign, own) in [(-1.0, Some(load)), (1.0, other.as_ref())] {
            let Some(own) = own else { continue };
            let strength = (&own.action.amplitude(), sign * own.factor(&now, *released));
            own.add_force(strength, &position, &state.q, place, &mut equations.load);
        }
    }
}

impl LinearMachine {
    /// The points that can be watched: journals in their bores, then the displacements that the machine puts out.
    pub fn points(&self) -> Vec<Point> {
        let joints = (0..self.machine.monitors.len()).map(|joint| self.journal(joint));
        let outputs = self.machine.outputs.iter().filter_map(|output| match &output.what {
            Wanted::Motion { body, point, motion: Motion::Displacement, .. } => {
                let rows = PlaneRows(vec![(*body, [0, 1].map(|axis| point.shapes.row(axis)))]);
                Some(Point { name: format!("output.{}", output.name), rows })
            }
            _ => None,
        });
        joints.chain(outputs).collect()
    }

    /// The journal of a joint in its bore.
    pub(super) fn journal(&self, joint: usize) -> Point {
        let joint = &self.machine.monitors[joint];
        let label = joint.label.trim_start_matches('_');
        Point { name: format!("joint.{label}"), rows: joint.rows() }
    }

    /// How points move by what turns with a body: its unbalance, loads that are fixed to it or go by its angle; and, of one
    /// that is not round, by the loads that stand, too. By orders of its rotation, in rising order, each with the points in
    /// theirs; phases count from its angle θ = 0. Of the order 0, which a body that is not round has, the real parts are the
    /// displacement of the mean position.
    ///
    /// # Errors
    /// A matrix that is singular: a critical speed without damping.
    pub fn response(
        &self,
        (at, equations): (&Standstill, &Linearised),
        body: usize,
        points: &[Point],
    ) -> Result<Vec<(f64, Vec<Vibration>)>, Error> {
        let moved = self.excited((at, equations), body)?.by_orders();
        let all: Vec<(f64, Vec<Vibration>)> = moved
            .iter()
            .map(|(order, own)| {
                let motions = points.iter().map(|point| self.vibration(at, point, own));
                (*order, motions.collect())
            })
            .collect();
        let size = |own: &[Vibration]| own.iter().map(|own| own.orbit().major).fold(0.0, f64::max);
        let most = all.iter().map(|own| size(&own.1)).fold(0.0, f64::max);
        // What turns with the body excites it once a turn, however little: the response is as small as an unbalance.
        let mut loads = self.loaded.loads.iter();
        let is_told = loads.any(|own| own.body == body && own.turns_with_its_body());
        let least = |order: f64| if is_told && order == 1.0 { 0.0 } else { LEAST };
        let bound = |order: f64| (NOTHING * most).max(least(order));
        Ok(all.into_iter().filter(|own| size(&own.1) > bound(own.0)).collect())
    }

    /// The run-out of the journal of a joint that turns (m, in the frame of its body).
    pub fn run_out(&self, joint: usize) -> [f64; 2] {
        self.loaded.monitors[joint].run_out()
    }

    /// How journals move in their bores as the laws see it: at the order 1 of their bodies with their run-outs. `motions`: by the points of
    /// [`LinearMachine::points`], at an order of a body.
    pub fn seen_by_laws(
        &self,
        (body, order): (usize, f64),
        motions: &[Vibration],
    ) -> Vec<Vibration> {
        let mut seen = motions.to_vec();
        for (place, (own, joint)) in seen.iter_mut().zip(&self.machine.monitors).enumerate() {
            if order == 1.0 && joint.bodies[0] == body {
                // (ε_x, ε_y) turned by θ is Re((1, −i) (ε_x + iε_y) e^{iθ}).
                let [x, y] = self.run_out(place);
                let along = Complex64::new(x, y);
                own.amplitudes[0] += along;
                own.amplitudes[1] -= Complex64::i() * along;
            }
        }
        seen
    }

    /// Whether there is a response at a speed of a body: at rest there is none of what turns freely, nor of what is not round.
    pub fn responds_at(&self, at: &Standstill, speed: f64) -> bool {
        speed != 0.0 || at.angles.is_empty() && self.not_round().next().is_none()
    }

    /// What acts by harmonics of half the angle of a body beside what stands: (2/N) Σ e^{−inθ/2} R⁻ᵀ r, r sampled over two
    /// turns.
    pub(super) fn forces(&self, at: &Standstill, body: usize) -> Vec<(i32, Vec<Complex64>)> {
        let (angles, kept) = (at.angles.len(), self.kept(at));
        let loads = self.loaded.loads.iter().zip(&at.found.released).zip(&at.found.ended);
        let released: Vec<bool> = loads
            .map(|((load, released), ended)| if load.body == body { *ended } else { *released })
            .collect();
        let mut equations = Equations::new(&self.loaded);
        equations.release(&released);
        let turns = |other: usize| self.turns_as_one(at, body, other);
        let in_space = |own: &mut Vec<f64>, on: &dyn Fn(usize) -> f64| {
            for other in self.turning() {
                let block = self.block(angles, other);
                self.force_in_space(at, (other, on(other)), &mut own[block]);
            }
        };
        let stands_at = self.stands_at(at, body);
        let laws = &at.found.state.laws;
        let goes_by = |load: usize| self.goes_by(load, &turns);
        let mut sample = |angle: f64| -> [Vec<f64>; 2] {
            let on = |other: usize| if turns(other) { angle - stands_at } else { 0.0 };
            let state = self.turned_on(at, &on);
            equations.evaluate(0.0, &state);
            // Loads that go by the angle come by their own orders.
            let by = |load: usize, _: &Load| goes_by(load).is_some().then_some(None);
            add_loads((&state, &released), &mut equations, &by);
            let mut own = self.residual(&equations, &kept);
            in_space(&mut own, &on);
            [own, state_rates(&equations, laws)]
        };
        let turned: Vec<[Vec<f64>; 2]> =
            (0..SAMPLES).map(|k| sample(HALVES * TAU * k as f64 / SAMPLES as f64)).collect();
        // The run-out of this body is a part of the samples alone.
        let without = |machine: &Machine| -> Option<Machine> {
            machine.springs.have_run_out().then(|| {
                let mut own = machine.clone();
                own.run_true(|body| turns(body) || self.loaded.spins(body));
                own
            })
        };
        let [own_standing, own_others] = [without(&self.machine), without(&self.loaded)];
        let mut standing = Equations::new(own_standing.as_ref().unwrap_or(&self.machine));
        standing.release(&at.found.released);
        standing.evaluate(0.0, &at.found.state);
        let state = &at.found.state;
        add_loads((state, &released), &mut standing, &|place, load| {
            (load.turns_with_its_body() || goes_by(place).is_some()).then_some(None)
        });
        // What turns with other bodies stands in the samples, and is theirs.
        let mut others = Equations::new(own_others.as_ref().unwrap_or(&self.loaded));
        others.release(&at.found.released);
        others.evaluate(0.0, &at.found.state);
        // Of loads in space that go by the angle the mean stands, and is no part of the response.
        add_loads((state, &released), &mut others, &|place, load| {
            let follows = load.time_function.follows().is_some_and(turns);
            follows.then(|| goes_by(place).is_none().then(|| mean(load)))
        });
        let mut still = self.residual(&others, &kept);
        let alone = self.residual(&standing, &kept);
        for own in self.turning().filter(|own| turns(*own)) {
            let theta = self.machine.places()[own].rotation;
            let angle = at.angles.iter().position(|own| Some(*own) == theta);
            for place in self.block(angles, own).chain(angle) {
                still[place] = alone[place];
            }
        }
        in_space(&mut still, &|_| 0.0);
        let still = [still, state_rates(&others, laws)];
        let harmonic = |of: usize, order: usize| -> Vec<Complex64> {
            let weight = if order == 0 { 1.0 } else { 2.0 } / SAMPLES as f64;
            let mut sum = vec![Complex64::ZERO; still[of].len()];
            for (k, own) in turned.iter().enumerate() {
                // Whole turns are taken off first, so that even angles have even factors.
                let angle = -TAU * ((k * order) % SAMPLES) as f64 / SAMPLES as f64;
                let factor = weight * Complex64::from_polar(1.0, angle);
                sum.iter_mut()
                    .zip(own[of].iter().zip(&still[of]))
                    .for_each(|(sum, (own, still))| *sum += factor * (own - still));
            }
            sum
        };
        // The samples have the states of laws as they stand: what the states do by this motion comes beside.
        let states = self.remembered(at);
        let part = |order: usize| -> Vec<Complex64> {
            let mut own = harmonic(0, order);
            if let Some(states) = &states {
                let frequency = order as f64 / HALVES * at.speeds[body];
                let driven = first_order::driven(states, frequency, &harmonic(1, order));
                own.iter_mut().zip(driven).for_each(|(sum, own)| *sum += own);
            }
            own
        };
        // Beside the forces of the springs at rest, which rounding is a share of.
        let scale = standing
            .spring
            .iter()
            .chain(&equations.load)
            .fold(0.0, |most: f64, own| most.max(own.abs()));
        let mut all: BTreeMap<i32, Vec<Complex64>> =
            (0..SAMPLES / 2).map(|order| (order as i32, part(order))).collect();
        for (place, load) in self.loaded.loads.iter().enumerate() {
            let Some(harmonics) = goes_by(place) else { continue };
            let own = (load, harmonics);
            // The mean of what stands in space stands, and is no part of the response.
            let stands = !load.turns_with_its_body();
            let orders = self.by_orders_of(at, own, (body, stands_at), released[place]);
            for (order, force) in orders.into_iter().filter(|own| own.0 != 0 || !stands) {
                let nothing = || vec![Complex64::ZERO; force.len()];
                let sum = all.entry(order).or_insert_with(nothing).iter_mut();
                sum.zip(&force).for_each(|(sum, own)| *sum += own);
            }
        }
        // What turns with a round body has no mean in space.
        if !self.not_round().any(turns) {
            all.remove(&0);
        }
        let size = |own: &[Complex64]| own.iter().map(|own| own.norm()).fold(0.0, f64::max);
        let most = all.values().map(|own| size(own)).fold(0.0, f64::max);
        let bound = (NOTHING * most).max(ROUNDING * scale);
        all.into_iter().filter(|own| size(&own.1) > bound).collect()
    }

    /// The residual at places of q, without what ties rotations to each other: a body that is turned alone would wind it up, and in
    /// truth all of its train turns.
    fn residual(&self, equations: &Equations, kept: &[usize]) -> Vec<f64> {
        let (machine, own) = (equations.machine, equations);
        let mut spring = vec![0.0; machine.size()];
        own.springs.add_forces_but_ties(&machine.springs, machine.rotations(), &mut spring);
        let residual = |&k: &usize| {
            (own.inertia[k] - own.elastic[k]) + (own.load[k] + spring[k] - own.damper[k])
        };
        kept.iter().map(residual).collect()
    }

    /// Bodies that have unbalance, by their places.
    pub(super) fn unbalanced(&self) -> impl Iterator<Item = usize> {
        self.turning().filter(|&body| self.unbalance(body)[0].iter().any(|own| *own != 0.0))
    }

    /// f of the unbalance of a body, Ω² (y + iSᵀy), over the coordinates of [`Linearised`]; on its angle the couple of that force
    /// about the axis beside which the body stands.
    pub(super) fn unbalance_force(&self, at: &Standstill, body: usize) -> Vec<Complex64> {
        let mut force = vec![Complex64::ZERO; self.kept(at).len()];
        let [load, twisting] = self.unbalance(body);
        let Some([once, twice]) = &self.generators[body] else { return force };
        let square = at.speeds[body] * at.speeds[body];
        let across = once.apply_transpose(&load);
        let own = self.block(at.angles.len(), body);
        for (own, (along, across)) in force[own].iter_mut().zip(load.iter().zip(&across)) {
            *own = square * Complex64::new(*along, *across);
        }
        let place = &self.machine.places()[body];
        if let Some(angle) = at.angles.iter().position(|own| Some(*own) == place.rotation) {
            // −d/dt (2 y0ᵀq θ̇ + g0ᵀq̇) of q that stands in space.
            let stands = self.in_space(at, body, &at.found.state.q[place.flexible.clone()]);
            let [once, twice] = [once, twice].map(|own| own.apply(&stands));
            let along = 2.0 * dot(&load, &once) - dot(&twisting, &twice);
            let across = 2.0 * dot(&load, &twice) + dot(&twisting, &once);
            force[angle] = square * Complex64::new(along, across);
        }
        force
    }

    /// Motion of a point along x and y of space by a unit of each coordinate of [`Linearised`]. An angle turns the displacement
    /// in which its body stands.
    pub(super) fn rows(&self, at: &Standstill, point: &Point) -> [Vec<f64>; 2] {
        let angles = &at.angles;
        let turned = |body: usize| {
            let place = &self.machine.places()[body];
            let angle = angles.iter().position(|own| Some(*own) == place.rotation)?;
            Some((angle, self.in_space(at, body, &at.found.state.q[place.flexible.clone()])))
        };
        point.rows.over(self.kept(at).len(), |body| self.block(angles.len(), body), turned)
    }
}
