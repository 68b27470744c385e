//! What limits the worth of states that stand, gathered over the speeds of an analysis.

use super::doubts::Doubt;
use super::linearised::Standstill;
use super::round::LinearMachine;
use crate::bearing::Measure;

/// What is found of the states of an analysis as they come.
#[derive(Default)]
pub struct StateDoubts {
    beyond: Vec<Beyond>,
    states: usize,
}

/// A measure of a law beyond its limit, at some of the speeds.
struct Beyond {
    joint: String,
    measure: Measure,
    worst: f64,
    speeds: [f64; 2],
    states: usize,
}

impl StateDoubts {
    /// Takes a state at a speed (rad/s).
    pub fn take(&mut self, linear: &LinearMachine, speed: f64, at: &Standstill) {
        self.states += 1;
        for (joint, measure, value) in linear.unbelieved(at) {
            let is_own = |own: &&mut Beyond| own.joint == joint && own.measure == measure;
            let Some(own) = self.beyond.iter_mut().find(is_own) else {
                let (worst, speeds) = (value, [speed; 2]);
                self.beyond.push(Beyond { joint, measure, worst, speeds, states: 1 });
                continue;
            };
            if measure.excess(value) > measure.excess(own.worst) {
                own.worst = value;
            }
            own.speeds = [own.speeds[0].min(speed), own.speeds[1].max(speed)];
            own.states += 1;
        }
    }

    /// All that is to be said, with how far small motions may go about the last state and its speed (rad/s).
    pub fn told(self, linear: &LinearMachine, last: Option<(f64, &Standstill)>) -> Vec<Doubt> {
        let loads = linear.counted.iter().cloned();
        let mut all: Vec<Doubt> =
            loads.map(|(load, counted)| Doubt::Load { load, counted }).collect();
        for own in self.beyond {
            let validity = own.measure.validity;
            let [least, most] = validity.limits;
            let limit = if own.worst < least { least } else { most };
            let [value, limit] = [own.worst, limit].map(|own| own / validity.per_unit);
            all.push(Doubt::NotValid {
                joint: own.joint,
                law: own.measure.law,
                title: if validity.title.is_empty() { validity.name } else { validity.title },
                value,
                limit,
                unit: validity.unit,
                speeds: own.speeds,
                of_some: own.states < self.states,
                help: validity.help,
            });
        }
        if let Some((speed, at)) = last {
            let limits = linear.limits(at);
            let joints = linear.open(at, &limits);
            if !joints.is_empty() {
                all.push(Doubt::Open { joints, speed });
            }
            let joints: Vec<(String, f64)> =
                limits.into_iter().filter_map(|own| Some((own.joint, own.within?))).collect();
            if !joints.is_empty() {
                all.push(Doubt::LinearWithin { joints, speed });
            }
        }
        all
    }
}
