//! Every bad input is an error with file, line, what and how to fix it, exit status 2, nothing written.

use crate::workbench::Workbench;

/// A case on the built-in machine; `{}` takes further lines.
const CASE: &str = "include = \"hu2003.machine.toml\"\ntitle = \"a test\"\n";

/// A case that says `march` rightly, followed by `lines`.
pub(crate) fn case(lines: &str) -> String {
    format!("{CASE}{lines}\n[march]\nsteps = 3\n")
}

/// A law with the pieces `pieces`.
fn law(pieces: &str) -> String {
    format!(
        "kind = \"law\"\nname = \"mine\"\ntitle = \"mine\"\nsource = \"a test\"\n\n\
         [inputs.h]\nunit = \"mm\"\nrange = [-0.1, 0.1]\n\n[outputs.Q]\nunit = \"N\"\n\
         pieces = [{pieces}]\n"
    )
}

/// Runs `case.toml` on the bench: it must fail with status 2, say all `words`, and write nothing.
pub(crate) fn refused(bench: &Workbench, words: &[&str]) {
    let before = bench.listing();
    for arguments in [["run", "case.toml"].as_slice(), &["check", "case.toml"]] {
        let outcome = bench.whirl(arguments);
        assert_eq!(outcome.status, 2, "{arguments:?}: {}", outcome.stderr);
        assert_eq!(outcome.stdout, "", "{arguments:?}");
        for word in words {
            assert!(outcome.stderr.contains(word), "`{word}` is not in:\n{}", outcome.stderr);
        }
        assert_eq!(bench.listing(), before, "{arguments:?} wrote something");
    }
}

fn refused_case(text: &str, words: &[&str]) {
    refused(&Workbench::new().file("case.toml", text), words);
}

#[test]
fn an_unknown_key_names_the_nearest() {
    refused_case(
        &case("[springs]\nraidal_clearance = \"3 um\""),
        &["case.toml:4:1", "no key `raidal_clearance`", "did you mean `radial_clearance`?", "^^^"],
    );
}

#[test]
fn a_wrong_unit_names_what_was_expected() {
    refused_case(
        &case("[drive]\ntarget_speed = \"75 Hz\""),
        &["case.toml:4:17", "expected an angular speed", "is a frequency", "\"4500 rpm\""],
    );
}

#[test]
fn a_missing_unit_is_an_error() {
    refused_case(&case("[shaft]\ndamping = 1e-4"), &["case.toml:4:11", "unit", "\"1e-4 s\""]);
}

#[test]
fn a_negative_density_is_an_error() {
    refused_case(
        &case("[material.steel]\ndensity = \"-7860 kg/m^3\""),
        &["case.toml:4:11", "`density` must be zero or greater", "\"7860 kg/m^3\""],
    );
}

#[test]
fn a_time_step_is_one_that_a_machine_may_have() {
    for step in ["1e-300 s", "1e300 s"] {
        let text = format!("{CASE}[march]\nsteps = 3\ntime_step = \"{step}\"\n");
        let words = ["case.toml:5:13", "`time_step` is 1e", "from 1e-15 s to 1e9 s long"];
        refused_case(&text, &words);
        let text = format!(
            "{CASE}[march]\nduration = \"1 s\"\ntime_step = \"auto\"\noutput_step = \"{step}\"\n"
        );
        refused_case(&text, &["case.toml:6:15", "`output_step` is 1e"]);
    }
}

#[test]
fn a_time_step_must_be_positive() {
    for step in ["0 s", "-7.4e-5 s"] {
        let text = format!("{CASE}[march]\nsteps = 3\ntime_step = \"{step}\"\n");
        refused_case(&text, &["case.toml:5:13", "`time_step` must be greater than zero"]);
    }
}

#[test]
fn all_errors_are_reported_at_once() {
    refused_case(
        &case("[shaft]\nmodes = -1\nmdoes = 3\n[springs]\nlaw = \"hu2003-nonlinaer\""),
        &["case.toml:4:9", "case.toml:5:1", "did you mean `modes`?", "`hu2003-nonlinear`?"],
    );
}

#[test]
fn a_file_that_is_not_toml_is_an_error() {
    refused_case("title = \"no end\n", &["case.toml:1:", "error"]);
}

#[test]
fn an_included_file_must_exist() {
    refused_case("include = \"nothing.toml\"\n", &["case.toml:1:1", "nothing.toml", "relative"]);
}

#[test]
fn files_that_include_each_other_are_an_error() {
    let bench = Workbench::new()
        .file("case.toml", "include = \"other.toml\"\n")
        .file("other.toml", "include = \"case.toml\"\n");
    refused(&bench, &["include each other"]);
}

#[test]
fn a_case_that_does_not_exist_names_the_nearest() {
    let bench = Workbench::new();
    let outcome = bench.whirl(&["run", "hu2003-6"]);
    assert_eq!(outcome.status, 2);
    assert!(outcome.stderr.contains("did you mean `hu2003-"), "{}", outcome.stderr);
    assert!(bench.listing().is_empty());
}

fn refused_law(pieces: &str, words: &[&str]) {
    let bench = Workbench::new()
        .file("case.toml", &case("[springs]\nlaw = \"law.toml\""))
        .file("law.toml", &law(pieces));
    refused(&bench, words);
}

#[test]
fn a_law_with_a_jump_names_its_remedies() {
    refused_law(
        "{ when = 'h < 0.01', value = '5 - 100*h' }, { value = '0' }",
        &["law.toml:12:", "jumps by 4 N", "engage = \"root\"", "jump = \"accept\""],
    );
}

#[test]
fn a_syntax_error_in_a_formula_has_its_caret() {
    refused_law(
        "{ when = 'h < 0', value = '3 * * h' }, { value = '0' }",
        &["law.toml:12:", "value = '3 * * h'", "^"],
    );
}

#[test]
fn a_dimension_error_in_a_formula_has_its_caret() {
    refused_law(
        "{ when = 'h < 0', value = 'h + (h < 0)' }, { value = '0' }",
        &["law.toml:12:", "value = 'h + (h < 0)'", "^"],
    );
}

#[test]
fn arguments_are_explained() {
    let bench = Workbench::new();
    let outcome = bench.whirl(&["run"]);
    assert_eq!(outcome.status, 2);
    assert!(outcome.stderr.contains("Usage: whirl run"), "{}", outcome.stderr);
}
