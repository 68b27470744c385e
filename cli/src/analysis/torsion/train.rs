//! All that is known of a train, and how far its modes are from what excites them.

use std::f64::consts::TAU;

use whirl_solver::linear::{Campbell, Critical, LinearMachine, Mode, Torque, Torsion};

use super::excitation::Excitation;
use crate::analysis::facts::Facts;
use crate::case::{Case, Gears};

/// A mode of the train at the speed of operation.
pub(super) struct Own {
    pub(super) mode: Mode,
    pub(super) torsion: Torsion,
}

/// All that is known of a train.
pub(super) struct Train<'a> {
    pub(super) case: &'a Case,
    pub(super) linear: &'a LinearMachine,
    pub(super) of: usize,
    /// Least and largest speed of operation (rad/s).
    pub(super) operation: [f64; 2],
    pub(super) modes: &'a [Own],
    pub(super) excitations: &'a [Excitation],
    pub(super) campbell: &'a Campbell,
    /// Those of torsion.
    pub(super) branches: &'a [usize],
    /// Share by which modes keep off in operation.
    pub(super) margin: f64,
}

impl Train<'_> {
    pub(super) fn joint(&self, own: &Torque) -> &str {
        self.case.machine.joints[own.joint].name.text()
    }

    /// The gears of a joint, if it has some.
    pub(super) fn gears(&self, own: &Torque) -> Option<&Gears> {
        self.case.machine.joints[own.joint].gears.as_ref()
    }

    pub(super) fn body(&self) -> &str {
        self.linear.machine().bodies[self.of].name()
    }

    /// Least distance of a frequency from that of an excitation in operation, over the latter, with its sign.
    pub(super) fn separation(&self, mode: &Mode, excitation: &Excitation) -> Option<f64> {
        let [first, last] = self.operation.map(|speed| excitation.order * speed.abs() / TAU);
        let (least, most) = (first.min(last), first.max(last));
        let own = mode.hertz();
        if most == 0.0 {
            return None;
        }
        Some(match () {
            () if own > most => own / most - 1.0,
            () if own < least => own / least - 1.0,
            () => 0.0,
        })
    }

    /// All pairs of a mode and an excitation that come too close in operation.
    pub(super) fn close(&self) -> Vec<(usize, &Excitation, f64)> {
        let pairs = self.modes.iter().enumerate().flat_map(|(number, own)| {
            self.excitations.iter().filter_map(move |excitation| {
                let separation = self.separation(&own.mode, excitation)?;
                (separation.abs() < self.margin).then_some((number, excitation, separation))
            })
        });
        pairs.collect()
    }

    /// Frequencies in operation, how near one comes to what excites it, and how many come too close.
    pub(super) fn facts(&self) -> Facts {
        let mut facts = Facts::default();
        facts.each("frequency_hz.", self.modes.iter().map(|own| own.mode.hertz()));
        let pairs = self.modes.iter().flat_map(|own| {
            self.excitations.iter().filter_map(|other| self.separation(&own.mode, other))
        });
        facts.put("least_separation", pairs.map(f64::abs).reduce(f64::min));
        facts.put("close", self.close().len() as f64);
        facts
    }

    /// Critical speeds, each with its mode of torsion and its excitation.
    pub(super) fn criticals(&self) -> Vec<(usize, &Excitation, &Critical)> {
        let mut all = Vec::new();
        for own in &self.campbell.criticals {
            let Some(mode) = self.branches.iter().position(|branch| *branch == own.branch) else {
                continue;
            };
            let excitation = self.excitations.iter().filter(|other| other.order == own.order);
            all.extend(excitation.map(|excitation| (mode, excitation, own)));
        }
        all.sort_by(|a, b| a.2.speed.abs().total_cmp(&b.2.speed.abs()).then(a.0.cmp(&b.0)));
        all
    }

    /// How far a speed is from those of operation: nearest of them over it, less one; 0 within.
    pub(super) fn margin_of(&self, speed: f64) -> f64 {
        let [least, most] = self.operation;
        match () {
            () if speed > most => speed / most - 1.0,
            () if speed < least => speed / least - 1.0,
            () => 0.0,
        }
    }
}
