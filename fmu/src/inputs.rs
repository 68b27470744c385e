//! What a unit was told of its inputs: lines over time, each from one communication point to the next.

use serde::{Deserialize, Serialize};
use whirl_cli::fmu::ToldGroup;
use whirl_solver::dynamics::{Acceleration, Amplitude, March};

/// A load with its three parts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct LoadInput {
    /// At the communication point.
    pub(crate) value: [f64; 3],
    /// Its rate from there on (1/s times that).
    pub(crate) rate: [f64; 3],
    /// Which parts were ever set: they are those of the case until then.
    pub(crate) is_set: [bool; 3],
    /// Value and rate as the march was told them last.
    told: [[f64; 3]; 2],
}

/// A speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct SpeedInput {
    /// rad/s.
    pub(crate) value: f64,
    /// rad/s².
    pub(crate) rate: f64,
    /// Whether it was ever set: the rotation is that of the case until then.
    pub(crate) is_set: bool,
}

impl LoadInput {
    pub(crate) fn new(start: [f64; 3]) -> Self {
        LoadInput { value: start, rate: [0.0; 3], is_set: [false; 3], told: [start, [0.0; 3]] }
    }

    /// Nothing was told of it to a march in which it is at `start`.
    pub(crate) fn untold(&mut self, start: [f64; 3]) {
        for axis in (0..3).filter(|axis| !self.is_set[*axis]) {
            self.value[axis] = start[axis];
        }
        self.told = [start, [0.0; 3]];
    }

    /// What the march is to be told of the loads of its group, where that is anything new.
    pub(crate) fn tell(&mut self, group: &ToldGroup, all: &mut Vec<Amplitude>) {
        let wanted = [self.value, self.rate];
        if wanted == self.told {
            return;
        }
        self.told = wanted;
        for (place, &load) in group.loads.iter().enumerate() {
            let [value, rate] = wanted.map(|own| group.amplitude(place, own));
            all.push(Amplitude { load, value, rate });
        }
    }

    /// Goes on by `length` s: the value is that to which the line has come, and holds from there on.
    pub(crate) fn pass(&mut self, length: f64) {
        for axis in 0..3 {
            if self.rate[axis] != 0.0 {
                self.value[axis] += self.rate[axis] * length;
                self.rate[axis] = 0.0;
            }
        }
    }
}

/// Of a speed: changes below this part of it are rounding.
const ROUNDING: f64 = 1e-14;

impl SpeedInput {
    pub(crate) fn new(start: f64) -> Self {
        SpeedInput { value: start, rate: 0.0, is_set: false }
    }

    /// The acceleration with which the rotation of `body` comes to its speed in `length` s, where that is another one than it has.
    pub(crate) fn tell(&self, march: &March, body: usize, length: f64) -> Option<Acceleration> {
        let now = march.time();
        let [_, speed, rate] = march.given(body, now)?;
        let target = self.value + self.rate * length;
        let comes = march.given(body, now + length)?[1];
        let near = |own: f64| (target - own).abs() <= ROUNDING * target.abs();
        if !self.is_set || near(comes) {
            return None;
        }
        let wanted = if near(speed) { 0.0 } else { (target - speed) / length };
        (wanted != rate).then_some(Acceleration { body, rate: wanted })
    }

    /// As [`LoadInput::pass`].
    pub(crate) fn pass(&mut self, length: f64) {
        self.value += self.rate * length;
        self.rate = 0.0;
    }
}
