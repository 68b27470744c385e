//! Forces of loads that go by the angle of a body, by orders of its rotation.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use num_complex::Complex64;

use super::linearised::Standstill;
use super::load_orders::{HALVES, Harmonics};
use super::round::LinearMachine;
use crate::equations::{instant, placed};
use crate::loads::{Load, TimeFunction};

/// Samples of a turn for the direction of a force that is constant in its own frame, and the orders that it has at most.
const SAMPLES: usize = 16;
const TURNED: i32 = 4;
/// Share of a direction below which a part of it is rounding.
const ROUNDING: f64 = 1e-12;

impl LinearMachine {
    /// The harmonics of a load by its place, if it goes by the angle of a body.
    pub(super) fn goes_by(
        &self,
        load: usize,
        bodies: &dyn Fn(usize) -> bool,
    ) -> Option<&Harmonics> {
        let followed = self.loaded.loads[load].time_function.follows();
        self.by_angle[load].as_ref().filter(|_| followed.is_some_and(bodies))
    }

    /// The forces of a load in space, over all that is kept, by orders of a body from whose angle it stands off by so much (rad).
    pub(super) fn by_orders_of(
        &self,
        at: &Standstill,
        (load, harmonics): (&Load, &Harmonics),
        (body, stands_at): (usize, f64),
        released: bool,
    ) -> Vec<(i32, Vec<Complex64>)> {
        let kept = self.kept(at);
        let constant = Load { time_function: TimeFunction::Constant, ..load.clone() };
        let turns = |other: usize| self.turns_as_one(at, body, other);
        let turned: Vec<Vec<f64>> = (0..SAMPLES)
            .map(|k| {
                let angle = TAU * k as f64 / SAMPLES as f64;
                let on = |other: usize| if turns(other) { angle - stands_at } else { 0.0 };
                let state = self.turned_on(at, &on);
                let now = instant(&self.loaded, 0.0, &state);
                let (place, position) = placed(&self.loaded, &constant, &state.q);
                let mut all = vec![0.0; self.loaded.size()];
                let strength = (&constant.action.amplitude(), constant.factor(&now, released));
                constant.add_force(strength, &position, &state.q, place, &mut all);
                let mut own: Vec<f64> = kept.iter().map(|&place| all[place]).collect();
                for other in self.turning() {
                    let block = self.block(at.angles.len(), other);
                    self.force_in_space(at, (other, on(other)), &mut own[block]);
                }
                own
            })
            .collect();
        // Two-sided parts of the direction, which turns at most a few times while the body turns once.
        let part = |order: i32| -> Vec<Complex64> {
            let mut sum = vec![Complex64::ZERO; kept.len()];
            for (k, own) in turned.iter().enumerate() {
                let angle = -TAU * f64::from(order) * k as f64 / SAMPLES as f64;
                let factor = Complex64::from_polar(1.0 / SAMPLES as f64, angle);
                sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += factor * own);
            }
            sum
        };
        let parts: Vec<(i32, Vec<Complex64>)> =
            (-TURNED..=TURNED).map(|order| (order, part(order))).collect();
        let size = |own: &[Complex64]| own.iter().map(|own| own.norm()).fold(0.0, f64::max);
        let most = parts.iter().map(|own| size(&own.1)).fold(0.0, f64::max);
        let parts: Vec<_> =
            parts.into_iter().filter(|own| size(&own.1) > ROUNDING * most).collect();
        // What it follows stands off from the angle that counts.
        let followed = load.time_function.follows().expect("it goes by an angle");
        let theta = self.machine.places()[followed].rotation;
        let off = theta.map_or(0.0, |theta| at.found.state.q[theta]) - stands_at;
        let mut found: BTreeMap<i32, Vec<Complex64>> = BTreeMap::new();
        for (k, own) in harmonics {
            let own = own * Complex64::from_polar(1.0, f64::from(*k) * off / HALVES);
            // Of a real factor half goes round one way and half the other; of a mean all stands.
            let both = match k {
                0 => vec![(0, Complex64::from(own.re))],
                k => vec![(*k, 0.5 * own), (-*k, 0.5 * own.conj())],
            };
            for (k, own) in both {
                for (order, part) in &parts {
                    let at = k + order * HALVES as i32;
                    // Those below zero are the conjugates of those above it.
                    if at < 0 {
                        continue;
                    }
                    let weight = if at == 0 { 1.0 } else { 2.0 };
                    let nothing = || vec![Complex64::ZERO; kept.len()];
                    let sum = found.entry(at).or_insert_with(nothing).iter_mut();
                    sum.zip(part).for_each(|(sum, part)| *sum += weight * own * part);
                }
            }
        }
        found.into_iter().collect()
    }
}
