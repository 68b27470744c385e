//! How good the steps of a march are: the energy that they make, their local error, what is left in their rows.

use serde::{Deserialize, Serialize};

use super::newmark::{Coefficients, Newmark, State};
use super::system::System;
use super::windows::Windows;
use crate::error::Error;
use crate::linalg::{Cholesky, Matrix, generalised_symmetric_eigen};

/// What the steps of a march were worth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Quality {
    /// Energy made at the springs of a bearing as a fraction of what flowed there, at the bearing and in the part of
    /// the march where it is largest; see `Windows::fraction`.
    pub energy_made_share: f64,
    /// The bearing where it is largest, counted from 0; none where no energy was made.
    pub bearing: Option<usize>,
    /// Energy that steps made or destroyed at that bearing, summed without sign (J).
    pub energy_made: f64,
    /// Energy that flowed into that bearing and out of it, summed without sign (J).
    pub energy_flowed: f64,
    /// Local error of a step that 95 % of the steps stay below, as a fraction of the largest displacement, in
    /// the modes that the step resolves (ωΔt < 1), all in the norm of the mass matrix.
    pub local_error: f64,
    /// The largest local error: of the first 128 steps and of one in 32 after.
    pub largest_local_error: f64,
    /// Motion in a step, in modes that the step does not resolve (ωΔt ≥ 1), that 95 % of the steps stay below, as
    /// a fraction of the largest displacement.
    pub unresolved_motion: f64,
    /// Largest residual of a row over what it may have; see `System::row_error`.
    pub row_error: f64,
    /// A step that resolves the machine with the springs as they were when most energy was made (s):
    /// 0.3/√λ, λ the largest eigenvalue of M⁻¹K; none if no energy was made.
    pub resolving_step: Option<f64>,
    /// A step that resolves all modes of the machine at the start: 0.3/ω of the fastest (s); none where all are
    /// resolved.
    pub(crate) mode_step: Option<f64>,
}

/// √λ Δt that counts as resolved, for [`Quality::resolving_step`].
const RESOLVED: f64 = 0.3;

/// Displacements, errors and motions in modes are taken from the first steps and one in so many of those
/// after, in no order that a motion could keep to.
const SAMPLED: u64 = 32;
const ALL_SAMPLED: u64 = 128;

/// What is carried from step to step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct QualitySums {
    steps: u64,
    errors: Histogram,
    largest_error: f64,
    /// Largest displacement in resolved modes, and in the others.
    amplitude: f64,
    unresolved_amplitude: f64,
    /// Motion in a step in modes that are not resolved.
    motions: Histogram,
    row_error: f64,
    /// Most energy made by a step, and the ends of that step.
    most_made: f64,
    worst: [(f64, State); 2],
}

/// Measures steps.
pub(crate) struct QualityMeter {
    pub(crate) sums: QualitySums,
    beta: f64,
    modes: MachineModes,
}

impl QualityMeter {
    /// For steps of `dt` s from `state`, which was just evaluated.
    ///
    /// # Errors
    /// A mass matrix that is not positive definite.
    pub(crate) fn new(
        system: &mut System,
        method: Newmark,
        dt: f64,
        state: &State,
    ) -> Result<Self, Error> {
        let mut modes = MachineModes::new(system, dt, state)?;
        let sums = QualitySums {
            steps: 0,
            errors: Histogram::new(),
            largest_error: 0.0,
            amplitude: modes.resolved.norm(&state.q),
            unresolved_amplitude: modes.unresolved.norm(&state.q),
            motions: Histogram::new(),
            row_error: 0.0,
            most_made: 0.0,
            worst: [(0.0, state.clone()), (0.0, state.clone())],
        };
        Ok(QualityMeter { sums, beta: method.beta, modes })
    }

    /// Adds a step of `dt` s from `start` at time `t` (s) to `end`.
    pub(crate) fn add(
        &mut self,
        (t, dt): (f64, f64),
        start: &State,
        end: &State,
        made: f64,
        row_error: f64,
    ) {
        let (sums, modes) = (&mut self.sums, &mut self.modes);
        if sums.steps < ALL_SAMPLED || scattered(sums.steps).is_multiple_of(SAMPLED) {
            // Zienkiewicz and Xie (1991): (β − 1/6) Δt² (q̈_{n+1} − q̈_n).
            let factor = (self.beta - 1.0 / 6.0).abs() * dt * dt;
            let error = factor * modes.resolved.norm_of_change(&start.a, &end.a);
            sums.errors.add(error);
            sums.largest_error = sums.largest_error.max(error);
            sums.amplitude = sums.amplitude.max(modes.resolved.norm(&end.q));
            let unresolved = &mut modes.unresolved;
            sums.motions.add(unresolved.norm_of_motion(&start.q, &end.q));
            sums.unresolved_amplitude = sums.unresolved_amplitude.max(unresolved.norm(&end.q));
        }
        sums.steps += 1;
        sums.row_error = sums.row_error.max(row_error);
        if made > sums.most_made {
            sums.most_made = made;
            for (kept, (t, state)) in sums.worst.iter_mut().zip([(t, start), (t + dt, end)]) {
                kept.0 = t;
                kept.1.copy_from(state);
            }
        }
    }

    /// What the steps so far were worth; an energy below `negligible` (J) counts as that.
    pub(crate) fn quality(&self, system: &mut System, flows: &Windows, negligible: f64) -> Quality {
        let sums = &self.sums;
        let fraction =
            |error: f64, amplitude: f64| if error == 0.0 { 0.0 } else { error / amplitude };
        let worst = sums.worst.iter().filter(|_| sums.most_made > 0.0);
        let eigenvalues = worst.filter_map(|(t, state)| {
            let value = largest_eigenvalue(system, *t, state);
            (value > 0.0).then_some(value)
        });
        let largest = eigenvalues.reduce(f64::max);
        let bearings = 0..system.machine.springs.bearings;
        let fractions =
            bearings.map(|bearing| (bearing, flows.fraction(bearing, negligible).abs()));
        // No number is larger than any.
        let worst =
            fractions.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, fraction)| *fraction != 0.0);
        let flow = worst.map(|(bearing, _)| flows.whole(bearing)).unwrap_or_default();
        let all = sums.amplitude.hypot(sums.unresolved_amplitude);
        Quality {
            energy_made_share: worst.map_or(0.0, |(_, fraction)| fraction),
            bearing: worst.map(|(bearing, _)| bearing),
            energy_made: flow.made,
            energy_flowed: flow.flowed,
            // Classes round up.
            local_error: fraction(sums.errors.below(0.95).min(sums.largest_error), sums.amplitude),
            largest_local_error: fraction(sums.largest_error, sums.amplitude),
            unresolved_motion: fraction(sums.motions.below(0.95), all),
            row_error: sums.row_error,
            resolving_step: largest.map(|value| RESOLVED / value.sqrt()),
            mode_step: self.modes.fastest.map(|omega| RESOLVED / omega),
        }
    }
}

/// A number for each step in which no order is to be seen (the finish of splitmix64).
fn scattered(step: u64) -> u64 {
    let mut hash = step.wrapping_add(0x9e37_79b9_7f4a_7c15);
    hash = (hash ^ (hash >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    hash = (hash ^ (hash >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    hash ^ (hash >> 31)
}

/// The modes of the machine at rest, springs as they are at the start. Every θ takes part: it and its flexible body
/// accelerate against each other. Motions of more than 6000 steps a period are left out, so that a body that
/// turns is not measured by its angle.
struct MachineModes {
    /// ωΔt < 1.
    resolved: Projection,
    unresolved: Projection,
    /// ω of the fastest, if the step does not resolve it (rad/s).
    fastest: Option<f64>,
}

impl MachineModes {
    /// At a state that was just evaluated.
    fn new(system: &mut System, dt: f64, state: &State) -> Result<Self, Error> {
        let machine = system.machine;
        let (size, first) = (machine.size(), machine.first_unknown());
        let mut tangent = vec![0.0; size * size];
        system.tangent(system.time, state, &Coefficients::at_rest(), &mut tangent);
        let unknowns: Vec<usize> = (first..size).collect();
        let whole = Matrix { rows: size, cols: size, data: tangent };
        let stiffness = whole.select(&unknowns, &unknowns).symmetric_part();
        let mass = system.mass(state).select(&unknowns, &unknowns);
        let eigen = generalised_symmetric_eigen(&stiffness, &mass)?;
        let all: Vec<usize> = (0..size - first).collect();
        let project = |within: &dyn Fn(f64) -> bool| {
            let modes = all.iter().filter(|&&i| within(eigen.values[i] * dt * dt));
            let modes: Vec<usize> = modes.copied().collect();
            let vectors = eigen.vectors.select(&all, &modes);
            let rows = crate::linalg::multiply(mass.view(), vectors.view());
            let angles = machine.rotations() - first;
            Projection { first, angles, rows, change: vec![0.0; size - first] }
        };
        let fastest = eigen.values.iter().copied().fold(0.0, f64::max);
        Ok(MachineModes {
            resolved: project(&|square| (1e-6..1.0).contains(&square)),
            unresolved: project(&|square| square >= 1.0),
            fastest: (fastest * dt * dt >= 1.0).then(|| fastest.sqrt()),
        })
    }
}

/// The part of a motion in some modes, in the norm of M.
struct Projection {
    /// Place of the first unknown, and how many angles are unknown; they are the first.
    first: usize,
    angles: usize,
    /// Unknowns × modes.
    rows: Matrix,
    change: Vec<f64>,
}

impl Projection {
    /// The norm of a displacement. An angle alone is none: it is orthogonal to all modes.
    fn norm(&mut self, x: &[f64]) -> f64 {
        self.change.copy_from_slice(&x[self.first..]);
        self.norm_without_angle()
    }

    /// The norm of the difference of two displacements.
    fn norm_of_motion(&mut self, before: &[f64], after: &[f64]) -> f64 {
        self.subtract(before, after);
        self.norm_without_angle()
    }

    fn norm_of_change(&mut self, before: &[f64], after: &[f64]) -> f64 {
        self.subtract(before, after);
        norm(&self.rows, &self.change)
    }

    fn subtract(&mut self, before: &[f64], after: &[f64]) {
        let pairs = before[self.first..].iter().zip(&after[self.first..]);
        self.change.iter_mut().zip(pairs).for_each(|(out, (a, b))| *out = b - a);
    }

    fn norm_without_angle(&mut self) -> f64 {
        self.change[..self.angles].fill(0.0);
        norm(&self.rows, &self.change)
    }
}

fn norm(rows: &Matrix, x: &[f64]) -> f64 {
    let square = |k| {
        let part = whirl_specs::vector::dot(rows.col(k), x);
        part * part
    };
    (0..rows.cols).map(square).sum::<f64>().sqrt()
}

/// The largest eigenvalue of M⁻¹K of the unknowns at a state, K = −∂r/∂q with all its springs, by the power
/// method; NaN where M cannot be inverted.
fn largest_eigenvalue(system: &mut System, t: f64, state: &State) -> f64 {
    /// The method's error falls at least as 1/iterations.
    const ITERATIONS: usize = 100;
    let machine = system.machine;
    let (size, first) = (machine.size(), machine.first_unknown());
    system.evaluate(t, state);
    let mut stiffness = vec![0.0; size * size];
    system.tangent(t, state, &Coefficients::at_rest(), &mut stiffness);
    let unknowns: Vec<usize> = (first..size).collect();
    let mass = system.mass(state).select(&unknowns, &unknowns);
    let mut cholesky = Cholesky::new(mass.rows);
    if cholesky.factor(&mass.data).is_err() {
        return f64::NAN;
    }
    // A start with a part along every mode, the same every time.
    let mut x: Vec<f64> =
        (0..size).map(|i| if i < first { 0.0 } else { (1.0 + i as f64).sin() }).collect();
    let mut value = 0.0;
    for _ in 0..ITERATIONS {
        let length = x.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length == 0.0 || !length.is_finite() {
            return value;
        }
        x.iter_mut().for_each(|x| *x /= length);
        let mut next = vec![0.0; size];
        for (column, x) in stiffness.chunks_exact(size).zip(&x) {
            next.iter_mut().zip(column).for_each(|(sum, k)| *sum += k * x);
        }
        next[..first].fill(0.0);
        cholesky.solve_in_place(&mut next[first..]);
        value = crate::linalg::dot(&next, &x);
        x = next;
    }
    value
}

/// Counts of values by their size, fifty classes a decade from 1e-320 to 1e320.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Histogram {
    zeros: u64,
    counts: Vec<u64>,
}

impl Histogram {
    const CLASSES: f64 = 50.0;
    const DECADES: f64 = 320.0;

    fn new() -> Self {
        let classes = (2.0 * Self::DECADES * Self::CLASSES) as usize;
        Histogram { zeros: 0, counts: vec![0; classes] }
    }

    /// What is no number counts as the largest.
    fn add(&mut self, value: f64) {
        let class = (value.log10() + Self::DECADES) * Self::CLASSES;
        let last = self.counts.len() - 1;
        match class {
            _ if class.is_nan() || class >= last as f64 => self.counts[last] += 1,
            _ if class < 0.0 => self.zeros += 1,
            _ => self.counts[class as usize] += 1,
        }
    }

    /// What a fraction of the values stays below, to 1/50 decade.
    fn below(&self, fraction: f64) -> f64 {
        let total = self.zeros + self.counts.iter().sum::<u64>();
        let mut left = (fraction * total as f64).ceil() as u64;
        if left <= self.zeros {
            return 0.0;
        }
        left -= self.zeros;
        for (class, count) in self.counts.iter().enumerate() {
            if left <= *count {
                return 10.0_f64.powf((class + 1) as f64 / Self::CLASSES - Self::DECADES);
            }
            left -= count;
        }
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::super::small::machine;
    use super::*;
    use crate::machine::{Body, Machine, MachineParts, Rotation};

    #[test]
    fn a_fraction_of_the_values_is_found_to_a_fiftieth_of_a_decade() {
        let mut histogram = Histogram::new();
        // In an order that makes classes at both ends, and with zeros.
        for i in 0..1000_u32 {
            let place = (i * 617) % 1000;
            histogram.add(if place < 100 { 0.0 } else { 1e-12 * f64::from(place) });
        }
        for fraction in [0.05, 0.5, 0.95, 1.0] {
            let exact: f64 = 1e-12 * (1000.0 * fraction - 1.0);
            let exact = if fraction < 0.1 { 0.0 } else { exact };
            let found = histogram.below(fraction);
            let wide = 10.0_f64.powf(1.0 / Histogram::CLASSES);
            assert!(found >= exact && found <= exact * wide * wide, "{found} for {exact}");
        }
    }

    #[test]
    fn values_of_any_size_are_counted() {
        for value in [1e-300, 1.0, 1e300_f64] {
            let mut histogram = Histogram::new();
            histogram.add(value);
            let found = histogram.below(1.0);
            assert!(found >= value && found <= value * 1.1, "{found} for {value}");
        }
    }

    /// The small machine without springs and loads.
    fn without_springs(rotation: Rotation) -> Machine {
        let mut machine = machine(rotation);
        assert!(machine.springs.count() > 0);
        let motion = machine.motion;
        let bodies = machine.bodies;
        machine = Machine::new(MachineParts {
            bodies,
            motion,
            clearance: &whirl_specs::CLEARANCES[0],
            laws: Vec::new(),
            bearings: Vec::new(),
            loads: Vec::new(),
        })
        .expect("no springs");
        assert!(machine.springs.count() == 0);
        machine
    }

    #[test]
    fn the_step_that_makes_most_energy_is_kept_with_its_ends() {
        let mut machine = without_springs(Rotation::Held);
        let [Body::Turning { shaft, .. }, Body::Standing { support, .. }] =
            machine.bodies.as_mut_slice()
        else {
            panic!("a shaft on a support")
        };
        (shaft.stiffness, support.stiffness) = (Matrix::zeros(2, 2), vec![0.0; 2]);
        let mut system = System::new(&machine);
        let states: Vec<State> =
            [1.0, 2.0, 4.0, 8.0].map(|q| State { q: vec![q; 5], ..State::new(5) }).into();
        let mut meter =
            QualityMeter::new(&mut system, Newmark::default(), 0.5, &states[0]).unwrap();
        for (place, made) in [(0, 3.0), (1, 7.0), (2, 5.0)] {
            let t = 10.0 + place as f64;
            meter.add((t, 0.5), &states[place], &states[place + 1], made, 0.0);
        }
        assert_eq!(meter.sums.worst, [(11.0, states[1].clone()), (11.5, states[2].clone())]);
        // Nothing holds the machine, so that no step resolves it.
        let flows = Windows::new(0);
        assert_eq!(meter.quality(&mut system, &flows, 1.0).resolving_step, None);
    }

    /// Whichever coordinate of a shaft or of its support is the stiff one: they move apart from each other.
    #[test]
    fn the_largest_eigenvalue_is_found_wherever_it_is() {
        for rotation in [Rotation::Free, Rotation::Held] {
            for stiff in 0..4 {
                let mut machine = without_springs(rotation.clone());
                let [Body::Turning { shaft, .. }, Body::Standing { support, .. }] =
                    machine.bodies.as_mut_slice()
                else {
                    panic!("a shaft on a support")
                };
                let value = |place: usize| if place == stiff { 3e4 } else { 2e3 };
                shaft.mass = Matrix::from_diagonal(&[2.0, 3.0]);
                shaft.stiffness = Matrix::from_diagonal(&[2.0 * value(0), 3.0 * value(1)]);
                (shaft.g0, shaft.y0) = (vec![0.0; 2], vec![0.0; 2]);
                support.stiffness = vec![value(2), value(3)];
                let state = State::new(machine.size());
                let found = largest_eigenvalue(&mut System::new(&machine), 0.0, &state);
                assert!((found / 3e4 - 1.0).abs() < 1e-9, "{rotation:?} {stiff}: {found}");
            }
        }
    }
}
