//! Figures of runs: which there are, and how they are drawn.

use std::fs;

use crate::workbench::Workbench;

/// Sharp turns of dense lines have round joins: pointed ones stand out beyond the points of the line.
#[test]
fn lines_of_figures_have_round_joins() {
    let bench = Workbench::new();
    assert_eq!(bench.whirl(&["run", "sdnd101"]).status, 0);
    for name in ["reactions", "displacement"] {
        let svg = fs::read_to_string(bench.path("results/sdnd101").join(format!("{name}.svg")));
        let svg = svg.expect("a figure");
        let (head, rest) = svg.split_once('>').expect("an element");
        assert!(head.starts_with("<svg ") && head.contains("stroke-linejoin=\"round\""), "{head}");
        // Lines inherit it.
        assert!(!rest.contains("stroke-linejoin"));
    }
}

/// Figures of reactions and journals are those of supports: without one there is the spectrum of the displacement alone.
#[test]
fn a_mass_without_stops_has_its_displacement_and_the_spectrum_of_it() {
    let case = "title = \"free\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\nvelocity = \"1 m/s\"\n\
                [march]\ntime_step = \"1e-4 s\"\nsteps = 90\n";
    let bench = Workbench::new().file("case.toml", case);
    let outcome = bench.whirl(&["run", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let expected = [
        "about.json",
        "history.csv",
        "report.html",
        "spectrum.png",
        "spectrum.svg",
        "state.bin",
        "summary.json",
    ];
    assert_eq!(bench.listing_of("results/case"), expected);
    assert_eq!(bench.history("results/case").rows(), 90);
    // Laws that the case names are drawn all the same.
    let laws = format!("{case}[figures]\nlaws = [\"gap-linear-1e6\"]\n");
    let bench = bench.file("laws.toml", &laws);
    let outcome = bench.whirl(&["run", "laws.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let expected = [
        "about.json",
        "history.csv",
        "laws.png",
        "laws.svg",
        "report.html",
        "spectrum.png",
        "spectrum.svg",
        "state.bin",
        "summary.json",
    ];
    assert_eq!(bench.listing_of("results/laws"), expected);
}
