//! Clearances: the gradient by differences of h, the rate along the motion, and the tangent by differences of
//! the force that follows from them.

use std::fs;
use std::path::Path;

use whirl_codegen::diagnostic::Source;
use whirl_codegen::expression::Id;
use whirl_codegen::kinds::clearance::{ClearanceSpec, Derived, RING};
use whirl_codegen::schedule::{Program, Request, schedule};

use crate::flip::{Difference, flips, run};
use crate::random::Random;

const POINTS: usize = 20;
/// Coordinates of a spring: those of its ring and its own.
const COORDINATES: usize = RING + 1;
/// Places of inputs: angle and clearance, coordinates, their rates, Q with its derivatives, a1.
const POSITION: usize = 2;
const RATE: usize = POSITION + COORDINATES;
const LAW: usize = RATE + COORDINATES;
const INPUTS: usize = LAW + 4;

/// What is computed of one spring: h, its gradient, its rate, and the tangent of its force row by row.
struct Spring {
    inputs: Vec<(String, Id)>,
    derived: Derived,
    value: Id,
}

impl Spring {
    fn new(spec: &ClearanceSpec) -> Self {
        let normal = spec.derive(&spec.contacts[0]);
        let derived = normal.unwrap_or_else(|errors| panic!("{errors}"));
        let positions =
            [&spec.spring, &spec.constant].into_iter().chain(&spec.ring).chain([&spec.radial]);
        let all = positions.chain(&derived.rates);
        let mut inputs: Vec<(String, Id)> =
            all.map(|coordinate| (coordinate.name.clone(), coordinate.symbol)).collect();
        inputs.extend(derived.forces.iter().chain(derived.slopes.iter().flatten()).cloned());
        inputs.push(("a1_".to_owned(), derived.a1));
        assert_eq!(inputs.len(), INPUTS);
        Spring { inputs, value: spec.value, derived }
    }

    fn program(&self, outputs: &[(String, Id)]) -> Program {
        let borrowed = |list: &[(String, Id)]| -> Vec<(String, Id)> { list.to_vec() };
        let (inputs, outputs) = (borrowed(&self.inputs), borrowed(outputs));
        let inputs: Vec<(&str, Id)> =
            inputs.iter().map(|(name, id)| (name.as_str(), *id)).collect();
        let outputs: Vec<(&str, Id)> =
            outputs.iter().map(|(name, id)| (name.as_str(), *id)).collect();
        schedule(&mut self.derived.graph.clone(), &Request::flat(&inputs, &outputs))
            .expect("a program")
    }

    fn gradient(&self) -> Vec<(String, Id)> {
        let gradient = self.derived.gradients[0].iter().enumerate();
        gradient.map(|(i, id)| (format!("g_{i}"), *id)).collect()
    }

    /// The derivatives that are mutated: gradient, rate, tangent.
    fn derivatives(&self) -> Vec<(String, Id)> {
        let mut all = self.gradient();
        all.push(("h_rate".to_owned(), self.derived.inputs[1]));
        for (i, row) in self.derived.tangent.iter().enumerate() {
            all.extend(row.iter().enumerate().map(|(k, entry)| (format!("t_{i}_{k}"), *entry)));
        }
        all
    }
}

/// Central differences with steps s and s/2, extrapolated; `size`: of the function, for rounding.
fn difference(function: impl Fn(f64) -> f64, step: f64, size: f64) -> Difference {
    let by = [step, step / 2.0].map(|s| (function(s) - function(-s)) / (2.0 * s));
    // Some tens of operations, each rounded to 2^-53, on either side.
    let rounding = 256.0 * f64::EPSILON * size / step;
    Difference { value: (4.0 * by[1] - by[0]) / 3.0, bound: (by[1] - by[0]).abs() + rounding }
}

/// Moved by `step` along a coordinate, whose rate follows as in a time step.
fn moved(at: &[f64], coordinate: usize, step: f64) -> Vec<f64> {
    let mut at = at.to_vec();
    at[POSITION + coordinate] += step;
    at[RATE + coordinate] += at[LAW + 3] * step;
    at
}

/// The derivatives of one spring by differences, in the order of [`Spring::derivatives`].
fn differences(spring: &Spring, at: &[f64]) -> Vec<Difference> {
    let primal = spring.program(&[("clearance".to_owned(), spring.value)]);
    let h = |at: &[f64]| run(&primal, at, None)[0];
    // The angle turns by one, lengths are some tens of micrometres.
    let steps = [1e-3, 1e-8, 1e-8, 1e-8];
    let size = at[1].abs() + at[POSITION + 1..RATE].iter().map(|x| x.abs()).sum::<f64>();
    let mut all = Vec::new();
    for (coordinate, step) in steps.into_iter().enumerate() {
        all.push(difference(|s| h(&moved(at, coordinate, s)), step, size));
    }
    let along = |s: f64| {
        let mut moved = at.to_vec();
        (0..COORDINATES).for_each(|i| moved[POSITION + i] += s * at[RATE + i]);
        h(&moved)
    };
    all.push(difference(along, 1e-6, size));
    let mut known = spring.gradient();
    known.push(("h_rate".to_owned(), spring.derived.inputs[1]));
    let known = spring.program(&known);
    let start = run(&known, at, None);
    let (h_start, rate_start) = (h(at), start[COORDINATES]);
    for i in 0..COORDINATES {
        for (k, step) in steps.into_iter().enumerate() {
            let force = |s: f64| {
                let at = moved(at, k, s);
                let values = run(&known, &at, None);
                let (by_h, by_rate) = (at[LAW + 1], at[LAW + 2]);
                let q = at[LAW]
                    + by_h * (h(&at) - h_start)
                    + by_rate * (values[COORDINATES] - rate_start);
                q * values[i]
            };
            let q = at[LAW].abs()
                + at[LAW + 1].abs() * size
                + at[LAW + 2].abs() * (rate_start.abs() + at[RATE].abs() * size);
            all.push(difference(force, step, q * start[i].abs().max(size)));
        }
    }
    all
}

fn points() -> Vec<Vec<f64>> {
    let mut random = Random::new(5, 7);
    let mut uniform = |low: f64, high: f64| {
        low + (high - low) * (random.next() >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut points = Vec::with_capacity(POINTS);
    for _ in 0..POINTS {
        let mut at = vec![uniform(0.0, 6.3), 3.5e-5, uniform(0.0, 6.3)];
        at.extend((0..RING).map(|_| uniform(-2e-5, 2e-5)));
        at.push(uniform(0.0, 500.0));
        at.extend((0..RING).map(|_| uniform(-0.01, 0.01)));
        at.extend([
            uniform(100.0, 400.0),
            uniform(-2e7, -1e7),
            uniform(-4e3, -1e3),
            uniform(1e4, 4e4),
        ]);
        points.push(at);
    }
    points
}

#[test]
fn one_sign_in_any_derivative_of_a_clearance_fails_its_check() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/motion");
    let mut paths: Vec<_> = fs::read_dir(&folder)
        .expect("motions")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    let (mut specs, mut missed) = (0, Vec::new());
    for path in paths {
        let text = fs::read_to_string(&path).expect("a readable file");
        if !text.contains("kind = \"clearance\"") {
            continue;
        }
        specs += 1;
        let spec = ClearanceSpec::read(&Source::new(&path, text));
        let spring = Spring::new(&spec.unwrap_or_else(|errors| panic!("{errors}")));
        let program = spring.program(&spring.derivatives());
        let points = points();
        let differences: Vec<Vec<Difference>> =
            points.iter().map(|at| differences(&spring, at)).collect();
        let plain: Vec<Vec<f64>> = points.iter().map(|at| run(&program, at, None)).collect();
        let (mut caught, mut without_effect) = (0, 0);
        for place in 0..program.outputs.len() {
            let name = &program.outputs[place].name;
            let check = |values: &[Vec<f64>]| {
                values.iter().zip(&differences).all(|(values, by)| by[place].agrees(values[place]))
            };
            assert!(check(&plain), "{name} is no derivative");
            for flip in flips(&program, place) {
                let flipped: Vec<Vec<f64>> =
                    points.iter().map(|at| run(&program, at, Some(flip))).collect();
                if flipped.iter().zip(&plain).all(|(a, b)| a[place] == b[place]) {
                    without_effect += 1;
                } else if check(&flipped) {
                    missed.push(format!("{name}: {flip:?}"));
                } else {
                    caught += 1;
                }
            }
        }
        println!("{}: {caught} caught, {without_effect} without effect", path.display());
        assert!(caught > 100, "{caught} flips were caught");
    }
    assert!(specs > 0 && missed.is_empty(), "{missed:#?}");
}
