//! The laws in specs/: derivatives three ways, report and names.

use std::fs;
use std::path::Path;

use whirl_codegen::diagnostic::Source;
use whirl_codegen::formula::Dual;
use whirl_codegen::schedule::{Request, schedule};
use whirl_codegen::spec::law::{Condition, LawSpec};
use whirl_codegen::tape::Tape;

/// Every law file, read.
fn laws() -> Vec<LawSpec> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/laws");
    let entries = fs::read_dir(&folder).expect("specs/laws is there");
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    assert!(!files.is_empty());
    files
        .iter()
        .map(|file| {
            let text = fs::read_to_string(file).expect("a readable file");
            let law = LawSpec::read(&Source::new(file, text)).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(Some(law.name.as_str()), file.file_stem().and_then(|stem| stem.to_str()));
            law
        })
        .collect()
}

/// Rows of values and derivatives by the tape: [output][value, derivatives…] at one point.
fn by_tape(law: &LawSpec, inputs: &[f64]) -> Vec<Vec<f64>> {
    let mut graph = law.graph.clone();
    let symbols: Vec<_> = law.inputs.iter().map(|i| (i.name.as_str(), i.symbol)).collect();
    let roots =
        law.outputs.iter().flat_map(|o| std::iter::once(o.value).chain(o.derivatives.clone()));
    let names: Vec<String> = (0..).take(roots.clone().count()).map(|i| format!("row{i}")).collect();
    let outputs: Vec<_> = names.iter().map(String::as_str).zip(roots).collect();
    let program = schedule(&mut graph, &Request::flat(&symbols, &outputs)).expect("a schedule");
    let tape = Tape::new(&program);
    let (mut rows, mut workspace) = (vec![0.0; outputs.len()], vec![0.0; tape.workspace()]);
    tape.evaluate(1, inputs, &mut rows, &mut workspace);
    rows.chunks(1 + symbols.len()).map(<[f64]>::to_vec).collect()
}

/// Points of an input, in SI, that stay clear of every break by more than `step`.
fn points(law: &LawSpec, input: usize, step: f64) -> Vec<f64> {
    let [low, high] = law.inputs[input].range.expect("shipped laws declare their ranges");
    let breaks: Vec<f64> = law
        .outputs
        .iter()
        .flat_map(|output| &output.pieces)
        .filter_map(|piece| match &piece.when {
            Some(Condition::Threshold { input: other, at, .. }) if *other == input => Some(
                at.numer().to_string().parse::<f64>().expect("a number")
                    / at.denom().to_string().parse::<f64>().expect("a number"),
            ),
            _ => None,
        })
        .collect();
    let points = (0..41).map(|i| low + (high - low) * (f64::from(i) + 0.37) / 41.0);
    points.filter(|x| breaks.iter().all(|at| (x - at).abs() > 2.0 * step)).collect()
}

#[test]
fn derivatives_agree_three_ways() {
    for law in laws() {
        for input in 0..law.inputs.len() {
            let [low, high] = law.inputs[input].range.expect("a range");
            // The cube root of the rounding unit balances truncation and rounding of a central difference.
            let step = (high - low) * f64::EPSILON.cbrt();
            for x in points(&law, input, step) {
                let at = |x: f64| {
                    let mut inputs: Vec<f64> =
                        law.inputs.iter().map(|i| i.range.map_or(0.0, |[low, _]| low)).collect();
                    inputs[input] = x;
                    inputs
                };
                let duals: Vec<Dual> = (at(x).into_iter().enumerate())
                    .map(|(i, value)| Dual { value, slope: f64::from(i == input) })
                    .collect();
                let direct = law.evaluate(&duals).expect("a value");
                let tape = by_tape(&law, &at(x));
                let above = law.evaluate(&at(x + step)).expect("a value");
                let below = law.evaluate(&at(x - step)).expect("a value");
                for (output, dual) in direct.iter().enumerate() {
                    let (value, slope) = (tape[output][0], tape[output][1 + input]);
                    let steep = dual.slope.abs().max((dual.value / (high - low)).abs());
                    let central = (above[output] - below[output]) / (2.0 * step);
                    // Rounding of a handful of operations; the terms of a polynomial are larger than
                    // its value by at most the range over the distance to its root.
                    assert!((value - dual.value).abs() <= 1e-12 * steep * (high - low), "{x}");
                    assert!((slope - dual.slope).abs() <= 1e-12 * steep, "{}: {x}", law.name);
                    assert!((central - dual.slope).abs() <= 1e-8 * steep, "{}: {x}", law.name);
                }
            }
        }
    }
}

#[test]
fn reports_state_what_the_paper_implies() {
    let laws = laws();
    let named = |name: &str| laws.iter().find(|law| law.name == name).expect(name);
    let first_break = |name: &str| named(name).report.outputs[0].breaks[0].clone();
    let linear = first_break("hu2003-linear");
    assert!((linear.at - 233.0 / 6517.0).abs() < 1e-16 && !linear.jumps());
    let quadratic = first_break("hu2003-nonlinear");
    assert!((quadratic.at - 0.035_733_282_612_761_35).abs() < 1e-16 && !quadratic.jumps());
    assert_eq!(quadratic.moved_from.map(|at| (at * 1e6).round()), Some(35687.0));
    for law in &laws {
        let output = &law.report.outputs[0];
        assert!(output.extent[0] >= 0.0, "{} only pushes", law.name);
        assert_eq!(output.trends[0].1, whirl_codegen::spec::law::Trend::Falling);
    }
}

#[test]
fn no_damaged_file_makes_the_reader_panic() {
    let text = "kind = \"law\"\nname = \"x\"\ntitle = \"t\"\nsource = \"s\"\n\
                [inputs]\nh = { unit = \"mm\", range = [-0.1, 1] }\nh_dot = { unit = \"mm/s\" }\n\
                [parameters]\nc0 = { value = 3.5e1, unit = \"um\", title = \"c\" }\nn = { value = 1.5, unit = \"1\" }\n\
                [definitions]\ns = 'max(1 - h/c0, 0)^n'\n\
                [outputs.Q]\nunit = \"N\"\njump = \"accept\"\npieces = [\n\
                { when = 'h < c0 and not ḣ > 1', value = '38*s/(1 + s) - 0.1*h_dot' },\n{ value = '0' },\n]\n";
    assert!(LawSpec::read(&Source::new("law.toml", text)).is_ok());
    let characters: Vec<char> = text.chars().collect();
    let inserted =
        ["", "'", "\"", "9", "e9", "-", "^", "(", "[", "]", "{", "\n", "=", "h", "θ", "\0", "''"];
    // A small generator with a fixed seed (Knuth's MMIX).
    let mut state = 1_u64;
    let mut below = |bound: usize| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % bound
    };
    for _ in 0..400 {
        let mut damaged: Vec<char> = characters.clone();
        for _ in 0..1 + below(3) {
            let start = below(damaged.len());
            let end = (start + below(4)).min(damaged.len());
            damaged.splice(start..end, inserted[below(inserted.len())].chars());
        }
        let damaged: String = damaged.into_iter().collect();
        if let Err(errors) = LawSpec::read(&Source::new("law.toml", damaged)) {
            assert!(errors.render().starts_with("error["));
        }
    }
}
