//! Sets that a mesh has not: wherever a case names one, it does not run.

use crate::workbench::Workbench;

const CASES: [(&str, &str); 4] = [
    ("crank", include_str!("../../../specs/cases/crank.toml")),
    ("overhung-disc", include_str!("../../../specs/cases/overhung-disc.toml")),
    ("two-spool", include_str!("../../../specs/cases/two-spool.toml")),
    ("hu2003.machine", include_str!("../../../specs/cases/hu2003.machine.toml")),
];

const TABLES: [(&str, &str); 4] = [
    ("crank.gas.csv", include_str!("../../../specs/cases/crank.gas.csv")),
    ("crank.gas-side.csv", include_str!("../../../specs/cases/crank.gas-side.csv")),
    ("crank.piston.csv", include_str!("../../../specs/cases/crank.piston.csv")),
    ("crank.piston-side.csv", include_str!("../../../specs/cases/crank.piston-side.csv")),
];

/// Where names of sets, such as `"JOURNAL1_LEFT"`, end in a text.
fn ends_of_names(text: &str) -> Vec<usize> {
    let quoted = text.split('"').scan(0, |place, part| {
        let begin = *place;
        *place += part.len() + 1;
        Some((begin, part))
    });
    let is_name = |part: &str| {
        part.starts_with(|c: char| c.is_ascii_uppercase())
            && part.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_')
    };
    let names = quoted.enumerate().filter(|(number, (_, part))| number % 2 == 1 && is_name(part));
    names.map(|(_, (begin, part))| begin + part.len()).collect()
}

#[test]
fn a_set_that_is_not_there_is_never_passed_over() {
    let mut bench = Workbench::new();
    for (name, text) in TABLES {
        bench = bench.file(name, text);
    }
    for (case, text) in CASES {
        let ends = ends_of_names(text);
        assert!(!ends.is_empty(), "{case}");
        for end in ends {
            let changed = format!("{}_NOWHERE{}", &text[..end], &text[end..]);
            let bench_of = std::fs::write(bench.path("case.toml"), changed);
            bench_of.expect("a file");
            let outcome = bench.whirl(&["check", "case.toml"]);
            let said = outcome.stderr.contains("_NOWHERE`");
            assert!(outcome.status == 2 && said, "{case} at {end}: {}", outcome.stderr);
        }
    }
}
