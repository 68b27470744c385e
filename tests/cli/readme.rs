//! What the README shows works as it stands there.

use crate::workbench::Workbench;

const README: &str = include_str!("../../README.md");

/// Files shown in the README: TOML between fences whose first line is `# name.toml` and perhaps more.
fn files() -> Vec<(&'static str, &'static str)> {
    let blocks = README.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next());
    blocks
        .filter_map(|text| {
            let name = text.lines().next()?.strip_prefix("# ")?.split(':').next()?;
            name.ends_with(".toml").then_some((name, text))
        })
        .collect()
}

#[test]
fn the_files_of_the_readme_are_a_case_that_runs() {
    let files = files();
    assert!(files.len() >= 2, "a case and a law: {files:?}");
    let bench = files.iter().fold(Workbench::new(), |bench, (name, text)| bench.file(name, text));
    let outcome = bench.whirl(&["check", "my-case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("law my-law.toml"), "{}", outcome.stdout);
}
