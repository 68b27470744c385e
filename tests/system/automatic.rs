//! Steps that the program chooses, on analysis 5.

use crate::run::{Run, run};

/// Analysis 5 with rows eight of its steps apart. The drive ends within a step, so that where a step begins is no matter.
fn analysis(march: &str) -> Run {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("case.toml");
    let case = format!(
        "include = \"hu2003.machine.toml\"\ntitle = \"analysis 5\"\n\
         [springs]\nlaw = \"hu2003-nonlinear\"\n[drive]\nacts = true\nrelease = \"located\"\n\
         [[load]]\nsets = [\"LOAD1\", \"LOAD2\", \"LOAD3\"]\ndirection = \"x\"\nforce = \"1000 N\"\nfrequency = \"37.5 Hz\"\n\
         [march]\nduration = \"399.6 ms\"\noutput_step = \"0.592 ms\"\n{march}\n"
    );
    std::fs::write(&path, case).expect("written");
    run(path.to_str().expect("UTF-8"))
}

/// Largest differences by kind of column, as fractions of the largest value of the kind.
fn differences(ours: &Run, theirs: &Run) -> Vec<(&'static str, f64)> {
    let kinds = ["RX", "RY", "X", "Y", "EX", "EY", "omega"];
    let differences = kinds.map(|kind| {
        let (mut worst, mut peak) = (0.0_f64, 0.0_f64);
        let digit = |rest: &str| rest.starts_with(|c: char| c.is_ascii_digit());
        let is_own = |name: &&String| {
            name.strip_prefix(kind).is_some_and(|rest| kind == "omega" || digit(rest))
        };
        for name in theirs.history.names().iter().filter(is_own) {
            let (a, b) = (ours.history.column(name), theirs.history.column(name));
            assert_eq!(a.len(), b.len());
            peak = b.iter().fold(peak, |peak, b| peak.max(b.abs()));
            worst = a.iter().zip(b).fold(worst, |worst, (a, b)| worst.max((a - b).abs()));
        }
        (kind, worst / peak)
    });
    differences.to_vec()
}

/// Against a step four times finer than that of the case, whose own errors are sixteen times those of it.
#[test]
fn analysis_5_is_as_good_as_with_its_own_step() {
    let fine = analysis("time_step = \"18.5 us\"");
    let own = differences(&analysis("time_step = \"74 us\""), &fine);
    let mut last = vec![f64::INFINITY; own.len()];
    for (tolerance, is_as_good) in [("1e-4", false), ("1e-5", true)] {
        let chosen = analysis(&format!("time_step = \"auto\"\nstep_tolerance = {tolerance}"));
        let facts = &chosen.summary["march"]["automatic"];
        assert_eq!(chosen.summary["verdict"]["sound"], true);
        let found = differences(&chosen, &fine);
        println!("{tolerance}: {found:?} in {facts}, by its own step {own:?}");
        for ((found, own), last) in found.iter().zip(&own).zip(&mut last) {
            assert!(found.1 <= own.1 || !is_as_good, "{found:?} beside {own:?}");
            // The first rows of the speed ring as the couple begins, where the fine step is no better than the chosen ones.
            assert!(found.1 <= *last || found.0 == "omega", "{found:?} after {last}");
            *last = found.1;
        }
        let steps = facts["steps"].as_u64().expect("a count")
            + facts["rejected_steps"].as_u64().expect("a count");
        // The case has 5400. For half of the error every step may take half as many again, as Δt² does.
        let most = if is_as_good { 8100 } else { 5400 };
        assert!(steps < most, "{facts}");
    }
}
