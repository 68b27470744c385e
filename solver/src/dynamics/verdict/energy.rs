//! Where the work of the loads goes.

use serde::{Deserialize, Serialize};

use super::windows::Windows;
use crate::bearing::work::{Flow, MOTIONS, SpringWork, WorkAlong};
use crate::equations::{Equations, State};
use crate::linalg::sum_over;

/// The energy balance of a march, in J: work in = kinetic + strain + stored + lost + dissipated + error, each
/// counted from the start.
///
/// Work of loads and dampers are sums of ½ (F_n + F_{n+1})·(q_{n+1} − q_n): with (γ, β) = (½, ¼) this is exact
/// for constant matrices. The work on the springs is that along the way; so the error is what varying matrices
/// leave and what steps made of the springs' energy.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct EnergyBalance {
    /// Work of the external loads, and of the couples that rotations take which are prescribed.
    pub work_in: f64,
    /// Kinetic energy gained.
    pub kinetic: f64,
    /// Strain energy of the bodies gained.
    pub strain: f64,
    /// Work done against the forces that the springs of bearings and stops would have at rest.
    pub spring_stored: f64,
    /// Work done against the rest of their forces: friction, films, dampers.
    pub spring_dissipated: f64,
    /// Work done on the dampers of the bodies.
    pub dissipated: f64,
    /// Energy in play: strain energy, half of what the forces of joints do along the displacements, and kinetic energy without
    /// rotations at the start, and the most that loads, dampers and springs have moved since, each on balance. What goes to and fro
    /// counts once, however long a run is: an error that grows with it is not hidden.
    #[serde(skip)]
    pub(crate) in_play: f64,
    /// Work of the forces that act on the rounding of what they hold, and that of the kinetic energy: a machine that stands still, or
    /// only turns, has no other.
    #[serde(skip)]
    pub(crate) rounding: f64,
}

/// Roundings of a position that may add up where nothing moves.
const ROUNDINGS: f64 = 16.0;

impl EnergyBalance {
    /// Of a march without a step: no numbers.
    pub fn none() -> Self {
        let no = f64::NAN;
        EnergyBalance {
            work_in: no,
            kinetic: no,
            strain: no,
            spring_stored: no,
            spring_dissipated: no,
            dissipated: no,
            ..EnergyBalance::default()
        }
    }

    /// What does not balance.
    pub fn error(&self) -> f64 {
        let springs = self.spring_stored + self.spring_dissipated;
        self.work_in - self.kinetic - self.strain - springs - self.dissipated
    }

    /// The error as a fraction of the energy in play; 0 where it is no more than rounding.
    pub fn error_fraction(&self) -> f64 {
        let error = self.error().abs();
        if error <= self.rounding && self.rounding.is_finite() { 0.0 } else { error / self.in_play }
    }
}

/// The sums of an energy balance, as they are carried from step to step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct EnergySums {
    work_in: f64,
    dissipated: f64,
    springs: SpringWork,
    /// The largest size so far of these two, and of what springs have stored and dissipated.
    largest: [f64; 4],
    /// Strain energy, energy of the joints and kinetic energy without rotations at the start.
    moving: f64,
    pub(crate) flows: Windows,
    start: (f64, f64),
}

/// Sums the balance over steps.
pub(crate) struct EnergyMeter {
    pub(crate) sums: EnergySums,
    along: WorkAlong,
    /// Of the step that is to be added, if it was measured.
    measured: Option<SpringWork>,
    load: Vec<f64>,
    damper: Vec<f64>,
    /// Residuals of the rows of rotations that are given: their drives' couples with the sign changed.
    drive: Vec<f64>,
}

/// Work of the forces at a state that was just evaluated on the rounding of what they hold (J).
pub(super) fn rounding(equations: &Equations, state: &State) -> f64 {
    let forces = equations.load.iter().zip(&equations.spring).zip(&equations.elastic).zip(&state.q);
    let held = forces.map(|(((load, spring), elastic), q)| {
        (load.abs() + spring.abs() + elastic.abs()) * q.abs()
    });
    ROUNDINGS * f64::EPSILON * held.sum::<f64>()
}

/// Half of what the forces of joints at a state that was just evaluated do along the displacements (J): their energy, if they are
/// springs.
fn held_by_joints(equations: &Equations, state: &State) -> f64 {
    let first = equations.machine.rotations();
    let along = equations.spring[first..].iter().zip(&state.q[first..]);
    0.5 * along.map(|(force, q)| force * q).sum::<f64>().abs()
}

/// The kinetic energy of rotations alone, bodies as they are deformed (J).
fn turning_alone(equations: &mut Equations, state: &State) -> f64 {
    let mut turning = state.clone();
    let first = equations.machine.rotations();
    turning.v[first..].fill(0.0);
    equations.kinetic_energy(&turning)
}

/// Residuals of the rows of rotations that are given.
fn drives<'s>(equations: &'s Equations) -> &'s [f64] {
    &equations.residual[..equations.machine.first_unknown()]
}

impl EnergyMeter {
    /// Starts at a state that was just evaluated.
    pub(crate) fn new(equations: &mut Equations, state: &State) -> Self {
        let start = (equations.kinetic_energy(state), equations.strain_energy(state));
        EnergyMeter {
            sums: EnergySums {
                work_in: 0.0,
                dissipated: 0.0,
                springs: SpringWork::default(),
                flows: Windows::new(MOTIONS * equations.machine.springs.bearings),
                largest: [0.0; 4],
                moving: start.1 + start.0 - turning_alone(equations, state)
                    + held_by_joints(equations, state),
                start,
            },
            along: WorkAlong::new(&equations.machine.springs, &equations.springs),
            measured: None,
            load: equations.load.clone(),
            damper: equations.damper.clone(),
            drive: drives(equations).to_vec(),
        }
    }

    /// Energy made and flowed at every bearing, in each of its [`MOTIONS`], by a step that ends at a state just evaluated and may
    /// be added then, or may not.
    pub(crate) fn measure(&mut self, equations: &Equations) -> &[Flow] {
        self.measured = Some(self.along.measure(&equations.machine.springs, &equations.springs));
        self.along.flows()
    }

    /// Leaves out the step that was measured last.
    pub(crate) fn reject(&mut self) {
        self.measured = None;
    }

    /// Measures the next step from a state that was just evaluated, with nothing added of how it came there.
    pub(crate) fn turn_to(&mut self, equations: &Equations) {
        self.measured = None;
        self.along.start(&equations.springs);
        self.jump(equations);
    }

    /// Adds a step that ends at a state just evaluated.
    pub(crate) fn add(&mut self, equations: &Equations, start: &State, end: &State) {
        let moved = |before: &[f64], after: &[f64]| -> f64 {
            sum_over([before, after, &start.q, &end.q], |[f, g, a, b]| 0.5 * (f + g) * (b - a))
        };
        let driven = moved(&self.drive, drives(equations));
        let work_in = moved(&self.load, &equations.load) - driven;
        let dissipated = moved(&self.damper, &equations.damper);
        self.sums.work_in += work_in;
        self.sums.dissipated += dissipated;
        self.jump(equations);
        let springs = &equations.machine.springs;
        let known = self.measured.take();
        let work = known.unwrap_or_else(|| self.along.measure(springs, &equations.springs));
        self.along.start(&equations.springs);
        self.sums.springs.add_step(&work);
        let flows = self.along.flows();
        self.sums.flows.add(flows);
        let EnergySums { work_in, dissipated, springs, largest, .. } = &mut self.sums;
        let all = [*work_in, *dissipated, springs.stored, springs.dissipated];
        largest.iter_mut().zip(all).for_each(|(most, own)| *most = most.max(own.abs()));
    }

    /// Takes the forces of the state that was just evaluated for those of the start of the next step: loads have changed at
    /// once.
    pub(crate) fn jump(&mut self, equations: &Equations) {
        self.load.copy_from_slice(&equations.load);
        self.damper.copy_from_slice(&equations.damper);
        self.drive.copy_from_slice(drives(equations));
    }

    /// The balance at a state.
    pub(crate) fn balance(&self, equations: &mut Equations, state: &State) -> EnergyBalance {
        let EnergySums { work_in, dissipated, springs, start, .. } = &self.sums;
        let kinetic = equations.kinetic_energy(state);
        let of_kinetic = ROUNDINGS * f64::EPSILON * kinetic.max(start.0);
        EnergyBalance {
            work_in: *work_in,
            kinetic: kinetic - start.0,
            strain: equations.strain_energy(state) - start.1,
            spring_stored: springs.stored,
            spring_dissipated: springs.dissipated,
            dissipated: *dissipated,
            in_play: self.sums.moving + self.sums.largest.iter().sum::<f64>(),
            rounding: rounding(equations, state) + of_kinetic,
        }
    }

    /// Energy made and flowed by the step that was added last, by bearings and their [`MOTIONS`].
    pub(crate) fn flows(&self) -> &[Flow] {
        self.along.flows()
    }

    /// Goes on from sums of an earlier march at a state that was just evaluated.
    pub(crate) fn resume_from(&mut self, equations: &Equations, sums: EnergySums) {
        self.sums = sums;
        self.turn_to(equations);
    }
}
