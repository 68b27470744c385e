//! Values and derivatives.

use super::*;

#[test]
fn derivatives_on_the_graph_are_those_of_dual_numbers() {
    let law = read(&paper("engage = \"root\"", QUADRATIC)).unwrap();
    let mut graph = law.graph.clone();
    let h = law.inputs[0].symbol;
    let slope = graph.number(Rational::from(-18_632_000));
    let h_term = graph.times(Rational::from(435_100_000_000_i64), h);
    let expected = graph.add(slope, h_term);
    // In SI the polynomial's slope is −18632e3 + 2·217550e6·h, where the first piece applies.
    let crate::expression::Node::Select(_, first, second) =
        *graph.node(law.outputs[0].derivatives[0])
    else {
        panic!("a choice")
    };
    assert!(crate::expression::normal::equal(&mut graph, first, expected));
    assert!(graph.is_zero(second));
    let dual = law.evaluate(&[Dual::variable(0.02e-3)]).unwrap()[0];
    let slope = -18632e3 + 2.0 * 217_550e6 * 0.02e-3;
    assert!((dual.slope - slope).abs() < 1e-9 * slope.abs());
}

#[test]
fn parameters_in_any_unit_give_the_same_law() {
    let law = |value: &str, unit: &str| {
        read(&format!(
            "[inputs.h]\nunit = \"mm\"\n[inputs.h_dot]\nunit = \"m/s\"\n\
             [parameters]\nk = {{ value = {value}, unit = \"{unit}\" }}\n\
             c = {{ value = 2, unit = \"N*s/m\" }}\n\
             [outputs.Q]\nunit = \"N\"\npieces = [{{ when = 'h < 0', value = '-k*h - c*ḣ' }}, {{ value = '-c*ḣ' }}]\n"
        ))
        .unwrap()
    };
    for law in [law("5", "N/mm"), law("5000", "N/m"), law("0.005", "kN/mm")] {
        assert_eq!(value(&law, &[-1e-3, 0.0]), 5.0);
        assert_eq!(value(&law, &[-1e-3, 0.5]), 4.0);
        assert_eq!(value(&law, &[1e-3, 0.5]), -1.0);
    }
}

#[test]
fn powers_definitions_and_exponents_from_parameters() {
    let law = read(
        "[inputs.h]\nunit = \"mm\"\nrange = [-0.1, 0.1]\n\
         [parameters]\nK = { value = 1000, unit = \"N/mm^1.5\" }\nn = { value = 1.5, unit = \"1\" }\n\
         [definitions]\noverlap = 'max(-h, 0)'\n\
         [outputs.Q]\nunit = \"N\"\nvalue = 'K*overlap^n'\n",
    )
    .unwrap();
    assert!((value(&law, &[-0.04e-3]) - 8.0).abs() < 1e-12);
    assert_eq!(value(&law, &[0.01e-3]), 0.0);
    assert_eq!(law.report.outputs[0].trends[0].1, Trend::Falling);
}

#[test]
fn sums_and_angles_agree_three_ways() {
    // Balls of a bearing that turn with the shaft, pressed by (3/2)-th powers.
    let text = "[inputs]
e_x = { unit = \"um\", range = [-20, 20] }
e_y = { unit = \"um\", range = [-20, 20] }
theta = { unit = \"rad\", range = [0, 6.3] }
[parameters]
K = { value = 500, unit = \"N/mm^1.5\" }
Z = { value = 9, unit = \"1\" }
gap = { value = 3, unit = \"um\" }
[definitions]
turned = 'theta/2 + 0.1*sin(atan2(e_y, e_x + 30*gap))'
[outputs.F_x]
unit = \"N\"
value = '-K*sum(j, 0, Z - 1, max(e_x*cos(turned + 2*pi*j/Z) + e_y*sin(turned + 2*pi*j/Z) - gap, 0)^1.5*cos(turned + 2*pi*j/Z))'
[outputs.F_y]
unit = \"N\"
value = '-K*sum(j, 0, Z - 1, max(e_x*cos(turned + 2*pi*j/Z) + e_y*sin(turned + 2*pi*j/Z) - gap, 0)^1.5*sin(turned + 2*pi*j/Z))'
";
    let law = read(text).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(law.acts, Acts::Ring);
    let tape = crate::tape::Tape::new(&law.program().unwrap());
    let mut workspace = vec![0.0; tape.workspace()];
    let scales = [40e-6, 40e-6, 6.3];
    for i in 0..20 {
        let turn = f64::from(i) * 0.618_033_988_75;
        let e = 12e-6 * (1.0 + (turn * 7.0).fract());
        let point = [e * turn.cos(), e * turn.sin(), turn];
        let mut rows = [0.0; 8];
        tape.evaluate(1, &point, &mut rows, &mut workspace);
        for input in 0..3 {
            let at = |shift: f64, slope: f64| {
                let mut duals = point.map(Dual::constant);
                duals[input] = Dual { value: point[input] + shift, slope };
                law.evaluate(&duals).unwrap()
            };
            let dual = at(0.0, 1.0);
            for output in 0..2 {
                let (value, slope) = (rows[4 * output], rows[4 * output + 1 + input]);
                let steep = 2.0 / scales[input];
                assert!((value - dual[output].value).abs() < 1e-13 * 10.0, "{i}");
                assert!((slope - dual[output].slope).abs() < 1e-12 * steep, "{i} {input}");
                let central = |step: f64| {
                    (at(step, 0.0)[output].value - at(-step, 0.0)[output].value) / (2.0 * step)
                };
                // Where a ball loses contact the second derivative is infinite: the error there falls with
                // the root of the step only, so that the order is asked of the others.
                let steps = [4e-5, 2e-5].map(|fraction| fraction * scales[input]);
                let errors = steps.map(|step| (central(step) - dual[output].slope).abs());
                assert!(errors[0] < 0.05 * steep, "{i} {input}: {errors:?}");
                if errors[0] < 1e-4 * steep {
                    assert!(
                        errors[1] <= 0.3 * errors[0] + 1e-14 / steps[1],
                        "{i} {input}: {errors:?}"
                    );
                }
            }
        }
    }
}

/// A value given in place of the file's has the graph, breaks and roots that a file with it has.
#[test]
fn given_values_move_breaks_and_their_roots() {
    let text =
        paper("engage = \"root\"", "233 - k*h") + "[parameters.k]\nvalue = 6517\nunit = \"N/mm\"\n";
    let law = read(&text).unwrap();
    let unit = |text: &str| crate::units::Unit::parse(text).unwrap();
    let given = |name: &str, value: i64, text: &str| Given {
        name: name.to_owned(),
        value: Rational::from(value),
        unit: unit(text),
    };
    let other = law.read_again(&[given("k", 5, "kN/mm"), given("c0", 40, "um")]).unwrap();
    let edited = text.replace("35.687", "40").replace("6517", "5000");
    let file = read(&edited).unwrap();
    assert_eq!(other.report, file.report);
    assert_eq!(other.report.outputs[0].breaks[0].at, 233.0 / 5000.0);
    assert_eq!(other.report.outputs[0].breaks[0].moved_from, Some(0.04));
    for h in [1e-6, 3e-5, 4.65e-5, 4.67e-5] {
        assert_eq!(value(&other, &[h]).to_bits(), value(&file, &[h]).to_bits());
    }
    let message =
        law.read_again(&[given("c1", 1, "mm")]).unwrap_err().iter().next().unwrap().to_string();
    assert!(message.contains("no parameter `c1`"), "{message}");
}

/// Measures are in SI, whatever the units of the file; limits follow parameters.
#[test]
fn measures_are_evaluated_in_si() {
    let law = read(
        "[inputs.h]
unit = \"mm\"
[parameters.k]
value = 2
unit = \"kN/mm\"
[parameters.h_m]
value = 50
unit = \"um\"
[definitions]
half = 'h/2'
[valid.h]
value = 'half'
unit = \"um\"
min = -3
max = 'h_m/2'
title = \"half\"
help = \"less\"
[valid.force]
value = 'k*h'
unit = \"kN\"
max = 4
title = \"force\"
help = \"less\"
[outputs.Q]
unit = \"N\"
value = '-k*half'
",
    )
    .unwrap();
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-15 * b.abs();
    let [h, force] = law.valid.as_slice() else { panic!("{:?}", law.valid) };
    assert!(near(h.limits[0], -3e-6) && near(h.limits[1], 25e-6), "{:?}", h.limits);
    assert_eq!(force.limits, [f64::NEG_INFINITY, 4e3]);
    let found = law.measures(&[30e-6]);
    assert!(near(found[0], 15e-6) && near(found[1], 60.0), "{found:?}");
    let tape = crate::tape::Tape::new(&law.measures_program().unwrap().unwrap());
    let mut measures = [0.0; 2];
    tape.evaluate(1, &[30e-6], &mut measures, &mut vec![0.0; tape.workspace()]);
    assert!(near(measures[0], 15e-6) && near(measures[1], 60.0), "{measures:?}");
}
