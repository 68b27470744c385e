//! What is measured of a part of a step before it is accepted, by the parts of the machine; it leaves no trace in the sums.

use super::quality_meter::QualityMeter;
use crate::dynamics::motion::{MovingPart, Part, larger};
use crate::equations::State;
use crate::machine::Machine;

impl QualityMeter {
    /// Largest displacements of a state at time `t` (s), by parts, and behind them how far turns departed from uniform ones (m).
    pub(crate) fn displacements(&mut self, (t, state): (f64, &State), out: &mut [f64]) {
        self.parts.displacement(state, &mut self.motion);
        let measured = self.parts.all.iter().map(|part| part.measure(&self.motion));
        let turned = self.turned.iter().zip(&self.parts.turns).map(|(own, turn)| {
            let mut own = *own;
            own.take(turn, (t, state));
            turn.radius * own.reach(self.steps.most())
        });
        let measured = measured.chain(turned);
        out.iter_mut().zip(measured).for_each(|(out, own)| *out = own);
    }

    /// Local errors of a step of `dt` s in all modes, by parts (m), those of a mode over 1 + β(ωΔt)², and of turns; of a
    /// march that chooses its steps.
    pub(crate) fn errors(&mut self, dt: f64, start: &State, end: &State, out: &mut [f64]) {
        let factor = self.method.error_factor(dt);
        let beta = self.method.elastic_weight();
        let QualityMeter { undeformed, parts, motion, within, .. } = self;
        let Some(modes) = undeformed else { return };
        let first = end.a.len() - motion.len();
        end.integrated_since(start, dt, motion);
        let weight = |square: f64| 1.0 / (1.0 + beta * square.max(0.0) * dt * dt);
        modes.weighted(modes.within(f64::NEG_INFINITY..f64::INFINITY), weight, motion, within);
        let places = parts.all.len();
        for (out, turn) in out[places..].iter_mut().zip(&parts.turns) {
            *out = factor * turn.radius * turn.of(|place| within[place - first]).abs();
        }
        parts.refer(within);
        let measured = parts.all.iter().map(|part| factor * part.measure(within));
        out.iter_mut().zip(measured).for_each(|(out, own)| *out = own);
    }

    /// The parts of the machine, and how many turns are behind them.
    pub(crate) fn parts(&self) -> (Vec<MovingPart>, usize) {
        (self.parts.all.iter().map(Part::moving).collect(), self.parts.turns.len())
    }

    /// Adds to every bearing the kinetic energy of its bodies without rotations (J) where it is more than what is there.
    pub(crate) fn raise_kinetic(&self, machine: &Machine, state: &State, out: &mut [f64]) {
        let rates = &state.v[machine.first_unknown()..];
        for (out, monitor) in out.iter_mut().zip(&machine.monitors) {
            let own = self.parts.all.iter().filter(|part| monitor.bodies.contains(&part.body));
            *out = larger(*out, own.map(|part| part.kinetic_energy(rates)).sum());
        }
    }
}
