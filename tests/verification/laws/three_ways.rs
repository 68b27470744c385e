//! The derivatives of every output of every law by every input: symbolic, by dual numbers on the file's
//! formulas, and by central differences whose order is measured.

use whirl_codegen::kinds::law::LawSpec;
use whirl_codegen::operation::Rounded;
use whirl_codegen::tape::Tape;

use super::slope::Slope;
use super::straddle::{Breaks, along};

/// Points in the ranges of a law.
const POINTS: usize = 24;
/// Steps of a difference: shares of the range, each a quarter of the one before.
const STEPS: usize = 14;
const LARGEST: f64 = 1.0 / 64.0;

/// Points that fill the ranges evenly: multiples of the roots of x^(d+1) = x + 1 (Roberts' sequence).
fn points(ranges: &[[f64; 2]]) -> Vec<Vec<f64>> {
    let dimensions = ranges.len() as i32;
    let root = (0..60).fold(2.0_f64, |x, _| (1.0 + x).powf(1.0 / f64::from(dimensions + 1)));
    (0..POINTS)
        .map(|n| {
            let share = |i: i32| (0.37 + (n + 1) as f64 * root.powi(-1 - i)).fract();
            ranges.iter().zip(0..).map(|([low, high], i)| low + (high - low) * share(i)).collect()
        })
        .collect()
}

/// Values and derivatives by the tape: [output][value, derivatives…] at one point.
struct Symbolic {
    tape: Tape,
    rows: usize,
}

impl Symbolic {
    fn of(law: &LawSpec) -> Self {
        let tape = Tape::new(&law.program().expect("a program"));
        Symbolic { tape, rows: 1 + law.inputs.len() }
    }

    fn at(&self, inputs: &[f64]) -> Vec<Vec<f64>> {
        let mut outputs = vec![0.0; self.tape.outputs()];
        self.tape.evaluate(1, inputs, &mut outputs, &mut vec![0.0; self.tape.workspace()]);
        outputs.chunks(self.rows).map(<[f64]>::to_vec).collect()
    }
}

/// Value, with its bound of rounding, of every output.
fn values(law: &LawSpec, point: &[f64]) -> Vec<Rounded> {
    let inputs: Vec<Rounded> = point.iter().map(|x| Rounded { value: *x, error: 0.0 }).collect();
    law.evaluate(&inputs).expect("a value")
}

#[test]
fn symbolic_derivatives_are_those_of_dual_numbers() {
    for law in super::laws() {
        let symbolic = Symbolic::of(&law);
        for point in points(&super::ranges(&law)) {
            let rows = symbolic.at(&point);
            for input in 0..law.inputs.len() {
                let slopes: Vec<Slope> = (point.iter().enumerate())
                    .map(|(place, x)| Slope::input(*x, place == input))
                    .collect();
                let duals = law.evaluate(&slopes).expect("a value");
                for (output, dual) in duals.iter().enumerate() {
                    let place = format!(
                        "{}: d{}/d{} at {point:?}",
                        law.name, law.outputs[output].name, law.inputs[input].name
                    );
                    let [value, slope] = [rows[output][0], rows[output][1 + input]];
                    // Both sides round every operation once, the symbolic one in other places: products
                    // are expanded and common factors taken out.
                    let close = |x: f64, y: Rounded| (x - y.value).abs() <= 8.0 * y.error;
                    assert!(close(value, dual.value), "value of {place}: {value} {:?}", dual.value);
                    assert!(close(slope, dual.slope), "{place}: {slope} {:?}", dual.slope);
                }
            }
        }
    }
}

/// Errors of central differences at one point, by output, from the largest step that straddles no break
/// down: (error, bound of its rounding).
fn errors(
    law: &LawSpec,
    (symbolic, breaks): (&Symbolic, &Breaks),
    point: &[f64],
    input: usize,
) -> Vec<Vec<(f64, f64)>> {
    let [low, high] = super::ranges(law)[input];
    let x = point[input];
    let steps: Vec<f64> =
        (0..STEPS).map(|k| (high - low) * LARGEST * 0.25_f64.powi(k as i32)).collect();
    let clear = breaks.clear(point, input, &steps);
    let steps: Vec<f64> =
        steps.into_iter().zip(clear).filter(|(_, c)| *c).map(|(s, _)| s).collect();
    let Some(largest) = steps.first() else { return vec![Vec::new(); law.outputs.len()] };
    let slopes: Vec<Slope> =
        point.iter().enumerate().map(|(i, x)| Slope::input(*x, i == input)).collect();
    let duals = law.evaluate(&slopes).expect("a value");
    // The rounding of values within the largest step is taken from its ends and its middle.
    let ends = [x - largest, x + largest].map(|x| {
        let mut moved = point.to_vec();
        moved[input] = x;
        values(law, &moved)
    });
    let moved: Vec<f64> = steps.iter().flat_map(|step| [x - step, x + step]).collect();
    let rows = along(&symbolic.tape, point, input, &moved);
    (duals.iter().enumerate())
        .map(|(output, dual)| {
            let values = &rows[output * symbolic.rows];
            let error = (ends.iter()).map(|end| end[output].error).fold(dual.value.error, f64::max);
            (moved.chunks(2).zip(values.chunks(2)))
                .map(|(at, value)| {
                    // The points are where rounding puts them.
                    let width = at[1] - at[0];
                    let central = (value[1] - value[0]) / width;
                    let off_centre = (at[0] + at[1] - 2.0 * x).abs() / width;
                    // A value of the tape and the bound of direct evaluation: twice, once for each.
                    let rounding = 4.0 * error / width
                        + dual.slope.error
                        + f64::EPSILON * central.abs()
                        + off_centre * dual.slope.value.abs();
                    ((central - dual.slope.value).abs(), rounding)
                })
                .collect()
        })
        .collect()
}

#[test]
fn central_differences_close_in_on_dual_numbers_with_order_two() {
    for law in super::laws() {
        let (symbolic, breaks) = (Symbolic::of(&law), Breaks::of(&law));
        for input in 0..law.inputs.len() {
            let mut orders = vec![Vec::new(); law.outputs.len()];
            let mut seen = 0;
            for point in points(&super::ranges(&law)) {
                let found = errors(&law, (&symbolic, &breaks), &point, input);
                for (output, errors) in found.iter().enumerate() {
                    seen += usize::from(!errors.is_empty());
                    // The finest pair of steps whose errors rounding cannot have made.
                    let clear = |(error, rounding): (f64, f64)| error > 30.0 * rounding;
                    let pair =
                        errors.windows(2).rev().find(|pair| clear(pair[0]) && clear(pair[1]));
                    if let Some(pair) = pair {
                        orders[output].push((pair[0].0 / pair[1].0).log2() / 2.0);
                    }
                    // Until then each quarter of a step takes away 15/16 of the error; below, nothing but
                    // rounding is left.
                    let reached = errors.iter().any(|(error, rounding)| *error <= 30.0 * rounding);
                    let name = &law.name;
                    assert!(errors.len() < 4 || reached, "{name} at {point:?}: {errors:?}");
                }
            }
            assert!(seen > 0, "{}: every point straddles a break", law.name);
            for (orders, output) in orders.iter_mut().zip(&law.outputs) {
                orders.sort_by(f64::total_cmp);
                let place = format!("d{}/d{}", output.name, law.inputs[input].name);
                let Some(middle) = orders.get(orders.len() / 2) else { continue };
                println!("{}: {place}: order {middle:.3} ({} points)", law.name, orders.len());
                // Pairs with few terms of the series left; the next one is four times smaller a step.
                assert!((middle - 2.0).abs() < 0.02, "{}: {place}: {orders:?}", law.name);
            }
        }
    }
}
