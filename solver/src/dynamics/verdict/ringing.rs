//! What changes its sign from step to step, which no machine does.
//!
//! Newmark's method with (½, ¼) turns what dies far faster than a step, such as the motion of a light mass on a stiff damper,
//! into an alternation that hardly dies. Neither the energy that steps make nor the errors in modes see it. So the second
//! differences x_n − 2 x_{n−1} + x_{n−2} of forces, couples, speeds and velocities are looked at: where those of many steps in
//! a row alternate, a quarter of the smaller of the last two is the amplitude of what rings. What dies before is a rise or a fall
//! that the step does not follow. Velocities have a part in modes that a step is not meant to follow, which rings after every
//! sudden load: of them the amplitude counts that one step in twenty exceeds.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::histogram::Histogram;
use super::rings::{LASTS, RINGING, Ringing, RingingPart};
use crate::dynamics::motion::{Parts, SMALLEST, larger, ratio};
use crate::equations::{Equations, State};
use crate::linalg::widely;

/// How much more velocities have to ring than what is named before them.
const NAMED_BEFORE: f64 = 1.1;
/// Second differences of velocities in a window.
const WINDOW: usize = 8;
/// From one window in which velocities are looked at to the next, with the two steps before the first difference.
const EVERY: usize = 4 * WINDOW;

/// Quantities of one kind side by side, which are one vector.
struct Group {
    what: RingingPart,
    signals: Range<usize>,
}

impl Group {
    /// 0: N, 1: N·m, 2: rad/s.
    fn kind(&self) -> usize {
        match self.what {
            RingingPart::Force(_) => 0,
            RingingPart::Moment(_) | RingingPart::Couple(_) => 1,
            RingingPart::Speed(_) | RingingPart::Velocity(_) => 2,
        }
    }
}

/// The alternation of signals over the steps of a window.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Alternation {
    /// The signals after the last two steps, the later ones second.
    before: [Vec<f64>; 2],
    /// A quarter of the smallest second difference in the window, with the sign of the first; 0 where they do not alternate.
    least: Vec<f64>,
    /// Steps taken in, up to the window's end.
    steps: usize,
}

impl Alternation {
    fn new(signals: usize) -> Self {
        let values = || vec![0.0; signals];
        Alternation { before: [values(), values()], least: values(), steps: 0 }
    }

    /// Takes in the signals after a step; whether a window ends with it. The next one may follow at once.
    fn add(&mut self, now: &[f64]) -> bool {
        let [older, old] = &mut self.before;
        let begins = self.steps == 2;
        let sign = if self.steps.is_multiple_of(2) { 0.25 } else { -0.25 };
        if self.steps >= 2 {
            let n = now.len();
            let (older, old, least) = (&older[..n], &old[..n], &mut self.least[..n]);
            widely(|| {
                for i in 0..n {
                    let second = sign * (now[i] - 2.0 * old[i] + older[i]);
                    let smaller = if second.abs() < least[i].abs() { second } else { least[i] };
                    let own = if second * least[i] > 0.0 { smaller } else { 0.0 };
                    least[i] = if begins { second } else { own };
                }
            });
        }
        older.copy_from_slice(old);
        old.copy_from_slice(now);
        self.steps += 1;
        let ends = self.steps == 2 + WINDOW;
        if ends {
            self.steps = 2;
        }
        ends
    }
}

/// Signals side by side, with how long each has alternated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Signals {
    /// After the last two steps, the later one second.
    before: [Vec<f64>; 2],
    /// A quarter of the last second difference, and the smaller of the last two without sign.
    second: Vec<f64>,
    amplitude: Vec<f64>,
    /// How many second differences alternate up to the last.
    alternate: Vec<f64>,
    /// Smallest and largest value.
    ends: [Vec<f64>; 2],
    /// Steps taken in, up to those of the first second difference.
    steps: usize,
}

impl Signals {
    fn new(signals: usize) -> Self {
        let values = |value: f64| vec![value; signals];
        Signals {
            before: [values(0.0), values(0.0)],
            second: values(0.0),
            amplitude: values(0.0),
            alternate: values(0.0),
            ends: [values(f64::INFINITY), values(f64::NEG_INFINITY)],
            steps: 0,
        }
    }

    /// Takes in the signals after a step; whether any has alternated for so long that it counts.
    fn add(&mut self, now: &[f64]) -> bool {
        let n = now.len();
        let [older, old] = &mut self.before;
        let [least, most] = &mut self.ends;
        let (older, old) = (&mut older[..n], &mut old[..n]);
        let (least, most) = (&mut least[..n], &mut most[..n]);
        let (last, alternate) = (&mut self.second[..n], &mut self.alternate[..n]);
        let amplitude = &mut self.amplitude[..n];
        let mut longest = 0.0;
        self.steps = (self.steps + 1).min(3);
        let differs = if self.steps == 3 { 0.25 } else { 0.0 };
        widely(|| {
            for i in 0..n {
                let x = now[i];
                least[i] = if x < least[i] { x } else { least[i] };
                most[i] = if x > most[i] { x } else { most[i] };
                let second = differs * (x - 2.0 * old[i] + older[i]);
                let (new, before) = (second.abs(), last[i].abs());
                amplitude[i] = if new < before { new } else { before };
                alternate[i] = if second * last[i] < 0.0 { alternate[i] + 1.0 } else { 0.0 };
                longest = if alternate[i] > longest { alternate[i] } else { longest };
                (older[i], old[i], last[i]) = (old[i], x, second);
            }
        });
        longest >= LASTS
    }

    /// The amplitude of an alternation that lasts.
    fn lasting(&self, signal: usize) -> f64 {
        if self.alternate[signal] < LASTS { 0.0 } else { self.amplitude[signal] }
    }
}

/// What is carried from step to step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct RingingSums {
    signals: Signals,
    velocities: Alternation,
    /// Steps since the last window of velocities began.
    since: usize,
    /// Largest amplitude of every group.
    largest: Vec<f64>,
    /// Amplitudes of the velocities of every part of the machine (m/s).
    amplitudes: Vec<Histogram>,
    /// Largest velocity of every part (m/s).
    fastest: Vec<f64>,
}

/// Measures what rings.
pub(super) struct RingingMeter {
    pub(super) sums: RingingSums,
    groups: Vec<Group>,
    damped: bool,
    now: Vec<f64>,
    /// The first coordinate that is unknown.
    first: usize,
    /// Whether each body deforms.
    deform: Vec<bool>,
}

impl RingingMeter {
    /// Of a machine with parts that are judged by themselves; `damped`: by the integrator.
    pub(super) fn new(equations: &Equations, parts: &Parts, damped: bool) -> Self {
        let machine = equations.machine;
        let mut groups: Vec<Group> = Vec::new();
        let mut place = |what: RingingPart, signals: usize| {
            let start = groups.last().map_or(0, |last| last.signals.end);
            groups.push(Group { what, signals: start..start + signals });
        };
        for (bearing, monitor) in machine.monitors.iter().enumerate() {
            place(RingingPart::Force(bearing), 2);
            if monitor.torque {
                place(RingingPart::Moment(bearing), 1);
            }
            if monitor.tilts.is_some() {
                place(RingingPart::Moment(bearing), 2);
            }
            if monitor.along.is_some() {
                place(RingingPart::Force(bearing), 1);
            }
        }
        for body in machine.turning() {
            place(RingingPart::Couple(body), 1);
            place(RingingPart::Speed(body), 1);
        }
        let signals = groups.last().map_or(0, |last| last.signals.end);
        let values = || vec![0.0; parts.all.len()];
        RingingMeter {
            sums: RingingSums {
                signals: Signals::new(signals),
                velocities: Alternation::new(machine.active()),
                // What dies within some steps of the start is left out here, too.
                since: 2 + WINDOW,
                largest: vec![0.0; groups.len()],
                amplitudes: parts.all.iter().map(|_| Histogram::new()).collect(),
                fastest: values(),
            },
            groups,
            damped,
            now: vec![0.0; signals],
            first: machine.first_unknown(),
            deform: machine.bodies.iter().map(|body| !body.hertz().is_empty()).collect(),
        }
    }

    /// Adds the end of a step or of a part of one, just evaluated.
    pub(super) fn add(&mut self, equations: &Equations, end: &State, parts: &Parts) {
        self.take(equations, end);
        let RingingMeter { sums, groups, now, first, deform, .. } = self;
        if sums.signals.add(now) {
            for (group, largest) in groups.iter().zip(&mut sums.largest) {
                let amplitudes = group.signals.clone().map(|own| sums.signals.lasting(own));
                *largest = larger(*largest, length(amplitudes));
            }
        }
        let steps = sums.since;
        sums.since = if steps + 1 == EVERY { 0 } else { steps + 1 };
        let rates = &end.v[*first..];
        if steps < 2 + WINDOW && sums.velocities.add(rates) {
            sums.velocities.steps = 0;
            let measured = sums.fastest.iter_mut().zip(&mut sums.amplitudes);
            let measured = parts.all.iter().zip(measured);
            for (part, (fastest, amplitudes)) in measured.filter(|(part, _)| !deform[part.body]) {
                amplitudes.add(part.measure(&sums.velocities.least));
                *fastest = larger(*fastest, part.measure(rates));
            }
        }
    }

    /// Takes the signals of a state just evaluated, in the order of the groups.
    fn take(&mut self, equations: &Equations, end: &State) {
        let machine = equations.machine;
        let mut signals = self.now.iter_mut();
        let mut put = |value: f64| {
            if let Some(signal) = signals.next() {
                *signal = value;
            }
        };
        for monitor in &machine.monitors {
            equations.joint_force(monitor).into_iter().for_each(&mut put);
            if monitor.torque {
                put(equations.joint_torque(monitor));
            }
            equations.joint_moment(monitor).into_iter().flatten().for_each(&mut put);
            equations.axial_force(monitor).into_iter().for_each(&mut put);
        }
        for body in machine.turning() {
            let theta = machine.places()[body].rotation.expect("it turns");
            // What a drive has to bring, where the rotation is given.
            let couple =
                if theta < self.first { equations.residual[theta] } else { equations.load[theta] };
            put(couple);
            put(end.v[theta]);
        }
    }

    /// What rings so far.
    pub(super) fn ringing(&self, parts: &Parts) -> Ringing {
        let sums = &self.sums;
        let [least, most] = &sums.signals.ends;
        let over = |group: &Group, of: &dyn Fn(usize) -> f64| length(group.signals.clone().map(of));
        let peak = |group: &Group| over(group, &|i| f64::max(least[i].abs(), most[i].abs()));
        let mut largest = [0.0; 3];
        for group in &self.groups {
            let largest = &mut largest[group.kind()];
            *largest = larger(*largest, peak(group));
        }
        let signals = self.groups.iter().zip(&sums.largest).map(|(group, amplitude)| {
            let range = over(group, &|i| most[i] - least[i]);
            (group.what, *amplitude, larger(range, SMALLEST * largest[group.kind()]))
        });
        let fastest = sums.fastest.iter().copied().fold(0.0, larger);
        let velocities = parts.all.iter().zip(&sums.fastest).zip(&sums.amplitudes);
        let bodies = velocities.map(|((part, own), amplitudes)| {
            // From one side to the other.
            let range = 2.0 * larger(*own, SMALLEST * fastest);
            let what = match part.turns() {
                true => RingingPart::Speed(part.body),
                false => RingingPart::Velocity(part.body),
            };
            (what, amplitudes.below(0.95), range)
        });
        let mut found = Ringing { damped: self.damped, ..Ringing::default() };
        for (what, amplitude, range) in signals.chain(bodies) {
            let share = ratio(amplitude, range);
            // Classes of amplitudes round up, by less than what lets a joint or a rotation be named before its body.
            let beside = if matches!(what, RingingPart::Velocity(_)) { NAMED_BEFORE } else { 1.0 };
            let share = if share > 0.5 { 0.5 } else { share };
            // Bodies that deform ring after every sudden load in modes that no step resolves, of which the motion is judged by
            // itself; velocities of others hide nothing.
            if let RingingPart::Velocity(body) = what
                && (self.deform[body] || found.share > RINGING)
            {
                continue;
            }
            if !(share <= beside * found.share) && !found.share.is_nan() {
                (found.share, found.of) = (share, Some(what));
            }
        }
        found
    }
}

fn length(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|value| value * value).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Amplitudes over the windows of a signal.
    fn windows(signal: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut own = Alternation::new(1);
        let window = |step: usize| own.add(&[signal(step)]).then(|| own.least[0].abs());
        (0..100).filter_map(window).collect()
    }

    #[test]
    fn what_alternates_counts_by_its_amplitude_whatever_it_is_added_to() {
        let sign = |step: usize| if step.is_multiple_of(2) { 1.0 } else { -1.0 };
        let slow = |step: usize| 10.0 * (std::f64::consts::TAU * step as f64 / 200.0).sin();
        let found = windows(|step| 7.0 + slow(step) + 0.5 * sign(step));
        assert_eq!(found.len(), 12);
        // A quarter of the second difference of 10 sin is 10 sin²(π/200).
        let missed = 10.0 * (std::f64::consts::PI / 200.0).sin().powi(2);
        assert!(found.iter().all(|own| *own > 0.5 - missed && *own <= 0.5), "{found:?}");
        let dying = windows(|step| sign(step) * 0.97_f64.powi(step as i32));
        assert!(dying.iter().all(|own| *own > 0.0));
    }

    #[test]
    fn an_alternation_has_to_last() {
        let largest = |factor: f64| {
            let mut own = Signals::new(1);
            let steps = (0..400).map(|step| {
                own.add(&[7.0 + (-factor).powi(step)]);
                own.lasting(0)
            });
            steps.fold(0.0, f64::max)
        };
        // Forty differences after the first one end with step 42.
        for factor in [1.0, 0.96, 0.9_f64] {
            let second = 0.25 * (1.0 + factor).powi(2) * factor.powi(40);
            let found = largest(factor);
            assert!((found / second - 1.0).abs() < 1e-9, "{factor}: {found} for {second}");
        }
    }

    #[test]
    fn what_moves_or_is_struck_does_not_ring() {
        let waves = [4.0, 6.5, 23.0].map(|period| {
            windows(move |step| (std::f64::consts::TAU * step as f64 / period).sin())
        });
        let struck = windows(|step| if step.is_multiple_of(11) { 100.0 } else { 0.0 });
        let jump = windows(|step| if step < 50 { 0.0 } else { 3.0 });
        let all = waves.iter().chain([&struck, &jump]);
        assert!(all.flatten().all(|own| *own == 0.0));
    }
}
