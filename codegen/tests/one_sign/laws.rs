//! Laws: differences of the file's formulas, evaluated directly, and their slopes by dual numbers.

use std::fs;
use std::path::Path;

use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::law::LawSpec;
use whirl_codegen::operation::{Dual, Rounded};
use whirl_codegen::units::Unit;

use crate::flip::{Difference, flips, run};
use crate::random::Random;

/// Random points of a law, besides those at its breaks, and more for each row of its tables.
const POINTS: usize = 24;
const POINTS_A_ROW: usize = 8;

/// Central differences with steps h and h/2, extrapolated; the error is below their distance while the
/// third derivative rules. Rounding is bounded by the running error of the formula. A kink between the
/// points shows in the slopes at them, by dual numbers, whose second difference it is.
fn difference(
    law: &LawSpec,
    output: usize,
    input: usize,
    at: &[f64],
    h: f64,
) -> Option<Difference> {
    let moved = |step: f64| {
        let mut at = at.to_vec();
        at[input] += step;
        at
    };
    let value = |step: f64| -> Option<Rounded> {
        let inputs: Vec<Rounded> = moved(step).into_iter().map(Rounded::new).collect();
        law.evaluate(&inputs).ok()?.into_iter().nth(output)
    };
    let slope = |step: f64| -> Option<f64> {
        let inputs: Vec<Dual> = (moved(step).into_iter().enumerate())
            .map(|(place, value)| Dual { value, slope: f64::from(u8::from(place == input)) })
            .collect();
        Some(law.evaluate(&inputs).ok()?[output].slope)
    };
    let (mut by, mut rounding) = ([0.0; 2], 0.0);
    for (place, h) in [h, h / 2.0].into_iter().enumerate() {
        let (below, above) = (value(-h)?, value(h)?);
        // The step as it was rounded when it was added.
        let width = moved(h)[input] - moved(-h)[input];
        by[place] = (above.value - below.value) / width;
        rounding += 2.0 * (above.error + below.error) / width;
    }
    let value = (4.0 * by[1] - by[0]) / 3.0;
    let kink = [0.0, h / 2.0, -h / 2.0, h, -h].map(slope);
    let kink: Option<Vec<f64>> = kink.into_iter().collect();
    let kink = kink?;
    let spread = kink.iter().map(|slope| (slope - kink[0]).abs()).fold(0.0, f64::max);
    Some(Difference { value, bound: (by[1] - by[0]).abs() + rounding + spread })
}

/// Points over the law's ranges and on both sides of its breaks, SI.
fn points(law: &LawSpec) -> Vec<Vec<f64>> {
    let unit = |text: &str| Unit::parse(text).expect("a unit of the law").factor().to_f64();
    let ranges: Vec<[f64; 2]> = (law.report.ranges.iter())
        .map(|(_, name, range)| range.map(|end| end * unit(name)))
        .collect();
    let mut random = Random::new(3, law.name.len() as u64);
    let mut uniform = |[low, high]: [f64; 2]| {
        low + (high - low) * (random.next() >> 11) as f64 / (1_u64 << 53) as f64
    };
    let rows: usize = law.tables.iter().map(|table| table.knots.len()).sum();
    let count = POINTS + POINTS_A_ROW * rows;
    let mut points: Vec<Vec<f64>> =
        (0..count).map(|_| ranges.iter().map(|range| uniform(*range)).collect()).collect();
    for found in law.report.outputs.iter().flat_map(|output| &output.breaks) {
        let input = law.inputs.iter().position(|input| input.name == found.input);
        let input = input.expect("an input of the law");
        for fraction in [-0.1, -0.01, 0.01, 0.1] {
            let mut point: Vec<f64> = ranges.iter().map(|range| uniform(*range)).collect();
            let width = ranges[input][1] - ranges[input][0];
            point[input] = found.at * unit(&found.unit) + fraction * width;
            points.push(point);
        }
    }
    points
}

/// What the derivative is compared with at one point.
struct Yardstick {
    differences: Vec<Difference>,
    /// The slope by dual numbers.
    slope: f64,
}

/// Shares of the slope at a point, and of the largest, that rounding may make: the same number computed in
/// two orders, of which cancellation may take seven digits.
const ROUNDING: [f64; 2] = [1e-7, 1e-11];

/// What becomes of the flips of a law.
#[derive(Default)]
struct Tally {
    /// By differences.
    caught: usize,
    /// By dual numbers only: where differences are blunt, as near a kink.
    by_duals: usize,
    /// Flips that change no value at any point beyond rounding: of what is even, of branches not taken, of
    /// π in an angle.
    without_effect: Vec<String>,
    missed: Vec<String>,
}

fn mutate(law: &LawSpec) -> Tally {
    let program = law.program().expect("a program");
    let points = points(law);
    let plain: Vec<Vec<f64>> = points.iter().map(|point| run(&program, point, None)).collect();
    let width = |input: usize| {
        let (_, name, [low, high]) = &law.report.ranges[input];
        (high - low) * Unit::parse(name).expect("a unit").factor().to_f64()
    };
    let mut tally = Tally::default();
    let inputs = law.inputs.len();
    for (o, output) in law.outputs.iter().enumerate() {
        for input in 0..inputs {
            let place = o * (1 + inputs) + 1 + input;
            let name = format!("{}: {}", law.name, program.outputs[place].name);
            let steps = [1e-5].map(|fraction| fraction * width(input));
            let yardsticks: Vec<Yardstick> = (points.iter())
                .map(|at| {
                    let by = steps.iter().filter_map(|h| difference(law, o, input, at, *h));
                    let duals: Vec<Dual> = (at.iter().enumerate())
                        .map(|(i, x)| Dual { value: *x, slope: f64::from(u8::from(i == input)) })
                        .collect();
                    let slope = law.evaluate(&duals).expect("a value")[o].slope;
                    Yardstick { differences: by.collect(), slope }
                })
                .collect();
            let sizes = yardsticks.iter().map(|by| by.slope.abs()).filter(|size| size.is_finite());
            let largest = sizes.fold(0.0, f64::max);
            let near = |a: f64, b: f64| {
                a == b
                    || !(a.is_finite() || b.is_finite())
                    || (a - b).abs() <= ROUNDING[0] * b.abs() + ROUNDING[1] * largest
            };
            let by_differences = |values: &[Vec<f64>]| {
                values.iter().zip(&yardsticks).all(|(values, by)| {
                    by.differences.iter().all(|difference| difference.agrees(values[place]))
                })
            };
            let by_duals = |values: &[Vec<f64>]| {
                values.iter().zip(&yardsticks).all(|(values, by)| near(values[place], by.slope))
            };
            assert!(by_differences(&plain), "{name} is not the slope by differences");
            assert!(by_duals(&plain), "{name} of {} is not the slope by duals", output.name);
            for flip in flips(&program, place) {
                let flipped: Vec<Vec<f64>> =
                    points.iter().map(|point| run(&program, point, Some(flip))).collect();
                let instruction = &program.instructions[flip.place];
                let report = || {
                    let operation = instruction.operation;
                    format!(
                        "{name}, operand {} of {} = {operation:?}",
                        flip.operand, instruction.name
                    )
                };
                if flipped.iter().zip(&plain).all(|(a, b)| near(a[place], b[place])) {
                    tally.without_effect.push(report());
                } else if !by_differences(&flipped) {
                    tally.caught += 1;
                } else if !by_duals(&flipped) {
                    tally.by_duals += 1;
                } else {
                    tally.missed.push(report());
                }
            }
        }
    }
    tally
}

#[test]
fn one_sign_in_any_derivative_of_a_law_fails_its_check() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/laws");
    let mut paths: Vec<_> =
        fs::read_dir(&folder).expect("laws").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    let mut missed = Vec::new();
    let (mut laws, mut caught) = (0, 0);
    for path in paths.iter().filter(|path| path.extension().is_some_and(|end| end == "toml")) {
        let text = fs::read_to_string(path).expect("a readable file");
        let beside = |name: &str| {
            let path = folder.join(name);
            fs::read_to_string(&path)
                .map(|text| Source::new(&path, text))
                .map_err(|e| e.to_string())
        };
        let law = LawSpec::read_with(&Source::new(path, text), &beside);
        let law = law.unwrap_or_else(|errors| panic!("{errors}"));
        let tally = mutate(&law);
        println!(
            "{}: {} caught by differences, {} by dual numbers only, {} without effect, {} missed",
            law.name,
            tally.caught,
            tally.by_duals,
            tally.without_effect.len(),
            tally.missed.len()
        );
        tally.without_effect.iter().for_each(|flip| println!("  without effect: {flip}"));
        tally.missed.iter().for_each(|flip| println!("  missed: {flip}"));
        missed.extend(tally.missed);
        laws += 1;
        caught += tally.caught;
    }
    assert!(laws > 0 && caught > 10 * laws, "{caught} flips of {laws} laws were caught");
    assert!(missed.is_empty(), "{missed:#?}");
}
