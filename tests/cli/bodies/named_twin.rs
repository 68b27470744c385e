//! The reference machine in both forms of a case.

use std::fs;

use crate::workbench::Workbench;

/// Short form and named bodies become one machine: the same rows to the byte, under other names of joints.
#[test]
fn the_reference_machine_has_the_same_rows_in_named_bodies() {
    let bench = Workbench::new().file("named.toml", include_str!("hu2003-5-named.toml"));
    let rows = |case: &str| {
        let said = bench.whirl(&["run", case, "--no-figures", "--no-report", "--out", "out"]);
        assert_eq!(said.status, 0, "{}", said.stderr);
        let text = fs::read_to_string(bench.path("out/history.csv")).expect("a history");
        fs::remove_dir_all(bench.path("out")).expect("a folder");
        text.split_once('\n').expect("a line of names").1.to_owned()
    };
    let (short, named) = (rows("hu2003-5"), rows("named.toml"));
    assert_eq!(short.lines().count(), 5405);
    assert!(short == named, "rows differ");
}
