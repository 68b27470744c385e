//! Reports of the paper's laws, and damaged files.

use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::law::{LawSpec, Trend};

use super::laws;

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
    for name in ["hu2003-linear", "hu2003-nonlinear"] {
        let output = &named(name).report.outputs[0];
        assert!(output.extent[0] >= 0.0, "{name} only pushes");
        assert_eq!(output.trends[0].1, Trend::Falling);
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
