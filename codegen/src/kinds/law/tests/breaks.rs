//! Breaks: engaged, blended, refused, found.

use super::*;

#[test]
fn the_papers_laws_engage_at_their_roots() {
    let law = read(&paper("engage = \"root\"", LINEAR)).unwrap();
    let Some(Condition::Threshold { at, below, moved_from, .. }) = &law.outputs[0].pieces[0].when
    else {
        panic!("a threshold")
    };
    assert_eq!(*at, Rational::new(233, 6_517_000));
    assert!(below);
    assert_eq!(*moved_from, Some(Rational::new(35687, 1_000_000_000)));
    let found = &law.report.outputs[0].breaks[0];
    assert!(!found.jumps());
    assert!((found.at - 0.035_752_646_923_431_03).abs() < 1e-16);
    assert_eq!(law.report.outputs[0].trends, [("h".to_owned(), Trend::Falling)]);
    assert_eq!(
        law.report.to_string(),
        "Q over h from 0 to 0.0715053 mm (exactly):
  0 to 233 N, never negative
  never rises with rising h
  break at h = 0.0357526 mm (moved from 0.035687): no jump, slope -6517 to 0 N/mm
"
    );

    let law = read(&paper("engage = \"root\"", QUADRATIC)).unwrap();
    let found = &law.report.outputs[0].breaks[0];
    assert!((found.at - 0.035_733_282_612_761_35).abs() < 1e-16);
    assert!(!found.jumps(), "{found:?}");
    assert_eq!(value(&law, &[0.0]), 388.0);
    assert_eq!(value(&law, &[0.04e-3]), 0.0);
    assert!(value(&law, &[0.0357e-3]) > 0.0);
}

#[test]
fn a_jump_is_an_error_that_names_the_remedies() {
    let text = read(&paper("", LINEAR)).unwrap_err().render();
    let expected = "\
error[E030]: `Q` jumps by 0.427821 N at h = 0.035687 mm: 0.427821 N with slope -6517 N/mm below, 0 N with slope 0 N/mm above
  --> law.toml:13:13
   |
13 |   { when = 'h < c0', value = '233 - 6517*h' },
   |             ^^^^^^
   |
   = help: `engage = \"root\"` moves the break to h = 0.0357526 mm, where the pieces meet; `smooth = \"0.002 mm\"` blends the pieces over that length of h; `jump = \"accept\"` keeps the jump
";
    assert_eq!(text, expected);
    let accepted = read(&paper("jump = \"accept\"", LINEAR)).unwrap();
    let found = &accepted.report.outputs[0].breaks[0];
    assert!(found.jumps());
    assert!((found.values[0] - 0.427_821).abs() < 1e-12);
    assert_eq!(found.slopes, [-6517.0, 0.0]);
    assert_eq!(
        messages(&paper("", "h_0 - 1")),
        ["law.toml:13:31: unknown name `h_0` (known: `c0`, `h`)"]
    );
    assert_eq!(
        messages(&paper("", "1 + 1*h^2")),
        [
            "law.toml:13:13: `Q` jumps by 1.00127 N at h = 0.035687 mm: 1.00127 N with slope 0.071374 N/mm below, \
          0 N with slope 0 N/mm above (`smooth = \"0.002 mm\"` blends the pieces over that length of h; \
          `jump = \"accept\"` keeps the jump)"
        ]
    );
}

#[test]
fn engage_needs_a_root() {
    assert_eq!(
        messages(&paper("engage = \"root\"", "1 + 1*h^2")),
        [
            "law.toml:13:13: the pieces beside the break never have the same value (change the pieces or the \
          break, or keep the jump by `jump = \"accept\"`)"
        ]
    );
    assert_eq!(
        messages(&paper("engage = \"root\"", "1*exp(-h/c0)")),
        [
            "law.toml:13:13: `engage = \"root\"` needs pieces that are polynomials in the input of the break \
             (change the pieces or the break, or keep the jump by `jump = \"accept\"`)"
        ]
    );
}

#[test]
fn breaks_between_inputs_and_poles_are_found() {
    let law = read(
        "[inputs]\nh = { unit = \"mm\", range = [0.1, 1] }\nh_dot = { unit = \"mm/s\", range = [-1, 1] }\n\
         [outputs.Q]\nunit = \"N\"\njump = \"accept\"\n\
         pieces = [{ when = 'h_dot < 1*h^2 - 1/4', value = '1/(1*h - 3/4)' }, { value = '2' }]\n",
    )
    .unwrap();
    let report = &law.report.outputs[0];
    let across_h = report.breaks.iter().find(|b| b.input == "h").unwrap();
    assert!(across_h.jumps());
    assert!(report.poles.iter().any(|(input, at)| input == "h" && (at - 0.75).abs() < 1e-12));
    // With h_dot = 0 the break lies at h = 1/2, at the limit of accuracy of h² − 1/4.
    assert!((across_h.at - 0.5).abs() < 1e-12, "{}", across_h.at);
}

#[test]
fn a_choice_between_values_with_and_without_a_divisor_is_no_pole() {
    let body = |value: &str| {
        format!(
            "[inputs]\nh = {{ unit = \"mm\", range = [-1, 1] }}\n\
             [parameters]\nt = {{ value = 2, unit = \"mm\" }}\nF = {{ value = 1, unit = \"N\" }}\n\
             [outputs.Q]\nunit = \"N\"\nvalue = 'F*{value}'\n"
        )
    };
    let poles = |value: &str| read(&body(value)).unwrap().report.outputs[0].poles.clone();
    assert_eq!(poles("max(h/t, 0.3)"), []);
    assert_eq!(poles("min(1/(1 + max(h/t, 0)), 0.9)"), []);
}

#[test]
fn a_smooth_break_is_continuous_with_its_slope() {
    let law = |smooth: &str| read(&paper(smooth, LINEAR));
    let smooth = law("smooth = \"1 um\"").unwrap();
    let at = |h: f64| smooth.evaluate(&[Dual::variable(h)]).unwrap()[0];
    // Outside the length the pieces are untouched; at the break their mean.
    let (c0, half) = (35.687e-6, 0.5e-6);
    assert_eq!(at(c0 - 1.001 * half).slope, -6_517_000.0);
    assert_eq!(at(c0 + 1.001 * half).value, 0.0);
    let mean = 0.5 * (233.0 - 6517.0 * c0 * 1e3);
    assert!((at(c0).value - mean).abs() < 1e-10);
    let tape = crate::tape::Tape::new(&smooth.program().unwrap());
    let mut workspace = vec![0.0; tape.workspace()];
    for i in -30..=30 {
        let h = c0 + f64::from(i) * 0.049e-6;
        let dual = at(h);
        let mut rows = [0.0; 2];
        tape.evaluate(1, &[h], &mut rows, &mut workspace);
        // 233 − 6517 h cancels to the rounding of 233; its slope over the length to that of 233/1 µm.
        assert!((rows[0] - dual.value).abs() < 1e-12, "{i}");
        assert!((rows[1] - dual.slope).abs() < 1e-5, "{i}: {} {}", rows[1], dual.slope);
        // Differences in the blend: cubic times linear, the error is a quarter for half the step.
        let central = |step: f64| (at(h + step).value - at(h - step).value) / (2.0 * step);
        let errors = [2e-9, 1e-9].map(|step| (central(step) - dual.slope).abs());
        if ((h - c0).abs() - half).abs() > 2e-9 {
            assert!(errors[1] <= 0.26 * errors[0] + 1e-13 * 233.0 / 1e-9, "{i}: {errors:?}");
        }
    }
    // Across both ends of the length neither value nor slope jumps: by less than curvature times distance.
    for edge in [c0 - half, c0 + half] {
        let (below, above) = (at(edge - 1e-13), at(edge + 1e-13));
        assert!((below.value - above.value).abs() < 2e-6);
        assert!((below.slope - above.slope).abs() < 2e-13 * 3e13);
    }
    let found =
        |keys: &str| law(keys).unwrap_err().iter().map(ToString::to_string).collect::<Vec<_>>();
    assert_eq!(
        found("smooth = \"1 mm/s\""),
        [
            "law.toml:11:11: expected a length, but `1 mm/s` is a speed (the break `h < c0` is blended over a \
          length: write for example `smooth = \"0.1 mm\"`)"
        ]
    );
    assert_eq!(
        found("smooth = \"0 um\""),
        ["law.toml:11:11: `smooth` must be above zero (leave it out to keep the breaks)"]
    );
    assert_eq!(
        found("smooth = \"1 um\"\njump = \"accept\""),
        ["law.toml:11:11: `smooth` removes the jump that `jump` would accept (keep one of them)"]
    );
}

#[test]
fn reports_of_piecewise_polynomials_are_exact() {
    let report = |range: &str, output: &str| {
        let law = read(&format!(
            "[inputs]\nh = {{ unit = \"mm\", range = {range} }}\n[outputs.Q]\nunit = \"N\"\n{output}\n"
        ));
        law.unwrap_or_else(|errors| panic!("{errors}")).report.outputs[0].clone()
    };
    // A dip that is narrower than any step of a scan: least −2⁻²⁰ at h = 1/3, where h − 1/3 = 0.
    let dip = report("[0, 1]", "value = '(h - 1/3)^2*1e6 - 1/1048576'");
    assert_eq!((dip.points, dip.trends[0].1), (0, Trend::Mixed));
    assert!((dip.extent[0] + 1.0 / 1_048_576.0).abs() < 1e-20, "{:?}", dip.extent);
    // A piece narrower than any step.
    let spike = report(
        "[0, 1]",
        "pieces = [{ when = 'h < 0.50001', value = '0' }, { when = 'h < 0.50002', value = '1*h - 0.50001' }, { value = '0.00001' }]",
    );
    assert_eq!(spike.breaks.len(), 2);
    assert_eq!(spike.trends[0].1, Trend::Rising);
    assert!((spike.extent[1] - 1e-5).abs() < 1e-20);
    // min, max and abs are breaks of the slope.
    let folded = report("[-2, 2]", "value = 'max(abs(1*h) - 1, 0)*3 + min(1*h, 1)'");
    let at: Vec<(f64, [f64; 2])> = folded.breaks.iter().map(|b| (b.at, b.slopes)).collect();
    assert_eq!(at, [(-1.0, [-2.0, 1.0]), (1.0, [1.0, 3.0])]);
    assert!(folded.breaks.iter().all(|b| !b.jumps()));
    // Blended: nothing jumps.
    let smooth = report(
        "[-2, 2]",
        "smooth = \"0.1 mm\"\npieces = [{ when = 'h < 0', value = '1 - 1*h' }, { value = '0' }]",
    );
    assert_eq!((smooth.points, smooth.breaks.len()), (0, 1));
    assert_eq!((smooth.breaks[0].values, smooth.breaks[0].blended), ([0.5, 0.5], Some(0.1)));
    assert_eq!(smooth.trends[0].1, Trend::Falling);
}

#[test]
fn friction_is_reported_against_the_motion() {
    let law = |sign: &str| {
        read(&format!(
            "[inputs]\nh = {{ unit = \"mm\", range = [-0.1, 0.1] }}\nv_t = {{ unit = \"mm/s\", range = [-50, 50] }}\n\
             [parameters]\nk = {{ value = 100, unit = \"N/mm\" }}\nv0 = {{ value = 5, unit = \"mm/s\" }}\n\
             [definitions]\nN = 'max(-k*h, 0)'\n[outputs.Q]\nunit = \"N\"\nvalue = 'N'\n\
             [outputs.T]\nunit = \"N\"\nvalue = '{sign}0.2*N*tanh(v_t/v0)'\n"
        ))
        .unwrap_or_else(|errors| panic!("{errors}"))
        .report
    };
    let against = law("-");
    assert_eq!(against.outputs[1].opposes, Some(("v_t".to_owned(), true)));
    assert_eq!(law("").outputs[1].opposes, Some(("v_t".to_owned(), false)));
    let text = against.to_string();
    assert!(text.contains("never drives v_t"), "{text}");
    assert!(text.contains("sampled at"), "{text}");
    // Where contact begins, the slope jumps, and that is not at a point of the scan only.
    let kink = &against.outputs[0].breaks[0];
    assert_eq!((kink.input.as_str(), kink.jumps()), ("h", false));
    assert!(
        kink.at.abs() < 1e-15 && (kink.slopes[0] + 100.0).abs() < 1e-9 && kink.slopes[1] == 0.0
    );
}

#[test]
fn a_jump_of_several_inputs_says_where_it_was_found() {
    let body = "[inputs.h]
unit = \"mm\"
range = [-1, 1]
[inputs.h_dot]
unit = \"mm/s\"
range = [-2, 2]
[parameters]
d = { value = 3, unit = \"N*s/mm\" }
[outputs.Q]
unit = \"N\"
pieces = [
  { when = 'h < 0', value = '-d*h_dot' },
  { value = '0' },
]
";
    // Where it is largest: at an end of the range of h_dot.
    let found = messages(body);
    let says = |end: &str, jump: &str| {
        found[0].starts_with(&format!(
            "law.toml:16:13: `Q` jumps by 6 N at h = 0 mm, h_dot = {end} mm/s: {jump} N with slope 0 N/mm below, 0 N"
        ))
    };
    assert!(found.len() == 1 && (says("-2", "6") || says("2", "-6")), "{found:?}");
}
