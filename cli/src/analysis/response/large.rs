//! Responses that are too large for small motions.

use whirl_solver::linear::{Doubt, LinearMachine, Standstill};

/// By joint where its motion is largest beside that for which it is linear.
#[derive(Default)]
pub(super) struct Large(Vec<Option<Worst>>);

struct Worst {
    joint: String,
    speed: f64,
    amplitude: f64,
    within: f64,
    runs_out: bool,
}

impl Large {
    /// Takes the amplitudes (m) of all points at a speed (rad/s): those of joints come first.
    pub(super) fn take(
        &mut self,
        linear: &LinearMachine,
        (speed, at): (f64, &Standstill),
        amplitudes: &[f64],
    ) {
        // Only what is farther beyond its limit than any before is looked for.
        let bound = |(place, amplitude): (usize, &f64)| match self.0.get(place) {
            Some(Some(worst)) => amplitude * worst.within / worst.amplitude,
            _ => *amplitude,
        };
        let bounds: Vec<f64> = amplitudes.iter().enumerate().map(bound).collect();
        let limits = linear.limits_below(at, &bounds);
        self.0.resize_with(limits.len(), || None);
        for (place, (worst, (limit, &amplitude))) in
            self.0.iter_mut().zip(limits.into_iter().zip(amplitudes)).enumerate()
        {
            let Some(within) = limit.within.filter(|own| amplitude > *own) else { continue };
            let is_worse = |own: &Worst| amplitude / within > own.amplitude / own.within;
            if worst.as_ref().is_none_or(is_worse) {
                let runs_out = linear.run_out(place) != [0.0; 2];
                *worst = Some(Worst { joint: limit.joint, speed, amplitude, within, runs_out });
            }
        }
    }

    /// The joints that move too far.
    pub(super) fn told(self) -> Vec<Doubt> {
        let all = self.0.into_iter().flatten();
        all.map(|Worst { joint, speed, amplitude, within, runs_out }| Doubt::NotSmall {
            joint,
            speed,
            amplitude,
            within,
            runs_out,
        })
        .collect()
    }
}
