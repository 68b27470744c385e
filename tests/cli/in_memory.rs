//! Runs in memory: the numbers of a run in a folder, to the bit, and nothing on disk.

use std::cell::Cell;
use std::fs;
use std::path::Path;
use std::thread;

use serde_json::Value;
use whirl_cli::simulate::{InMemory, Quiet, Watch, in_memory};
use whirl_cli::{Case, CaseText, HistoryTable, build, read_text};
use whirl_solver::cache::Cache;

use crate::workbench::Workbench;

/// A mass that strikes a stop and is over in no time; `law` of the stop.
fn mass(law: &str) -> String {
    format!(
        "title = \"a mass at a stop\"\n[mass]\nmass = \"100 kg\"\nstiffness = \"1e4 N/m\"\nvelocity = \"1 m/s\"\n\
         [[stop]]\nside = \"above\"\ngap = \"0 mm\"\nlaw = \"{law}\"\n\
         [march]\ntime_step = \"2e-5 s\"\nsteps = 900\nforce_tolerance = \"1e-6 N\"\n"
    )
}

/// The start of a run-up of a flexible rotor, with stresses over the last cycle.
const ROTOR: &str = "include = \"unbalance.toml\"\n[march]\nsteps = 60\n[fields]\ntimes = [\"1 ms\"]\nstresses = true\n";

fn read(name: &str, text: &str) -> Case {
    let text = CaseText::new(name, Path::new(""), text);
    read_text(&text, &mut Vec::new()).unwrap_or_else(|failure| panic!("{}", failure.report()))
}

fn run(case: &Case, cache: &Cache) -> InMemory {
    let built = build(case, Some(cache), &mut Vec::new()).unwrap();
    in_memory(case, &built, &Quiet).unwrap()
}

/// What `whirl run` writes of a case, to the bit.
fn same_as_command(name: &str, text: &str) {
    let bench = Workbench::new().file(&format!("{name}.toml"), text);
    let outcome = bench.whirl(&["run", &format!("{name}.toml"), "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let found = run(&read(name, text), &Cache::shared(None));
    assert_same(&bench.history_text("out"), &found.history);
    assert_eq!(found.state, Some(fs::read(bench.path("out/state.bin")).unwrap()));
    let facts = |mut summary: Value| {
        // Wall times, and what the command says of the path.
        summary["time"] = Value::Null;
        summary
    };
    let own: Value = serde_json::from_str(&found.summary).unwrap();
    assert_eq!(facts(own), facts(bench.summary("out")));
    assert_eq!((found.reason, found.interrupted), (None, false));
    for words in found.notes {
        assert!(outcome.stderr.contains(&words), "{words}: {}", outcome.stderr);
    }
}

fn assert_same(text: &str, table: &HistoryTable) {
    let mut lines = text.lines();
    assert_eq!(lines.next().unwrap(), table.names().join(","));
    let of_text = lines.flat_map(|line| line.split(',')).map(|cell| cell.parse::<f64>().unwrap());
    let of_text: Vec<u64> = of_text.map(f64::to_bits).collect();
    let own: Vec<u64> = table.values().iter().map(|value| value.to_bits()).collect();
    assert!(own.len() > 10 * table.names().len());
    assert_eq!(of_text, own);
}

#[test]
fn a_run_in_memory_has_the_numbers_of_the_one_in_a_folder() {
    same_as_command("mass", &mass("gap-linear-1e6"));
    same_as_command("rotor", ROTOR);
}

#[test]
fn a_law_beside_a_text_is_the_one_in_a_file() {
    let law = include_str!("../../specs/laws/gap-linear-1e6.toml");
    let text = || CaseText::new("mass", Path::new("no/such/folder"), mass("own.toml"));
    let given = text().with_file("own.toml", law);
    let given = read_text(&given, &mut Vec::new()).unwrap();
    let cache = Cache::shared(None);
    let built_in = read("mass", &mass("gap-linear-1e6"));
    assert_eq!(run(&given, &cache).history, run(&built_in, &cache).history);
    let missing = read_text(&text(), &mut Vec::new()).unwrap_err().report();
    assert!(missing.contains("own.toml") && missing.contains("mass.toml"), "{missing}");
    let torn = text().with_file("own.toml", law.replace("[outputs", "[outbuts"));
    let torn = read_text(&torn, &mut Vec::new()).unwrap_err().report();
    assert!(torn.contains("no/such/folder/own.toml") && torn.contains("outbuts"), "{torn}");
}

#[test]
fn a_text_may_be_called_as_what_it_includes() {
    let case = read("sdnd101", "include = \"sdnd101.toml\"\n[march]\nsteps = 3\n");
    assert_eq!((case.name(), case.steps()), ("sdnd101", 3));
}

#[test]
fn values_hold_in_place_of_those_of_a_text() {
    let cache = Cache::shared(None);
    let with = |lines: &str| {
        let text = CaseText::new("mass", Path::new(""), mass("gap-linear-1e6"));
        read_text(&text.with_values(lines), &mut Vec::new())
    };
    let varied = with("stop.1.law = \"gap-linear-1e5\"\nmarch.steps = 900\n").unwrap();
    let other = read("mass", &mass("gap-linear-1e5"));
    assert_eq!(run(&varied, &cache).history, run(&other, &cache).history);
    for (lines, said) in [
        ("stop.2.gap = \"1 mm\"\n", "there is no `stop.2`"),
        ("stop.0.gap = \"1 mm\"\n", "write `stop.1` for its first entry, up to `stop.1`"),
        ("march.stepz = 4\n", "did you mean `steps`"),
        ("mass.mass = \"3 m\"\n", "varied keys:1:"),
        ("mass.mass = \"3 kg\"\nmass.mass = \"4 kg\"\n", "varied keys:2:"),
    ] {
        let report = with(lines).unwrap_err().report();
        assert!(report.contains(said), "{said}: {report}");
    }
}

/// Ends a run after some steps.
struct Until(Cell<usize>);

impl Watch for Until {
    fn progressed(&self, step: usize, time: f64) {
        assert!(step > 0 && time > 0.0);
        self.0.set(self.0.get() - 1);
    }

    fn asked(&self) -> bool {
        self.0.get() == 0
    }
}

#[test]
fn who_watches_a_run_may_end_it() {
    let case = read("mass", &mass("gap-linear-1e6"));
    let built = build(&case, None, &mut Vec::new()).unwrap();
    let whole = in_memory(&case, &built, &Quiet).unwrap();
    let part = in_memory(&case, &built, &Until(Cell::new(100))).unwrap();
    assert!(part.interrupted && part.history.rows() == 100, "{:?}", part.reason);
    assert_eq!(part.history.values(), &whole.history.values()[..part.history.values().len()]);
    let none = in_memory(&case, &built, &Until(Cell::new(0))).unwrap_err().to_string();
    assert!(none.contains("before the first step"), "{none}");
}

#[test]
fn runs_at_the_same_time_reduce_a_body_once_and_do_not_disturb_each_other() {
    let cache = Cache::shared(None);
    let runs: Vec<InMemory> = thread::scope(|scope| {
        let run = || scope.spawn(|| run(&read("rotor", ROTOR), &cache));
        let runs = [run(), run(), run()];
        runs.into_iter().map(|own| own.join().unwrap()).collect()
    });
    let cached = |run: &InMemory| {
        let summary: Value = serde_json::from_str(&run.summary).unwrap();
        summary["time"]["reduction_cached"] == Value::Bool(true)
    };
    assert_eq!(runs.iter().filter(|run| !cached(run)).count(), 1);
    assert!(runs.windows(2).all(|pair| pair[0].history == pair[1].history));
}
