//! Runs cases with the binary, each once, and reads what it wrote.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Arc, Mutex, OnceLock};

/// A history as columns by name, in the units of their names.
pub(crate) struct History {
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
}

impl History {
    fn parse(text: &str) -> Self {
        let mut lines = text.lines();
        let names: Vec<String> =
            lines.next().expect("a header").split(',').map(str::to_string).collect();
        let mut columns = vec![Vec::new(); names.len()];
        for line in lines {
            let values: Vec<f64> =
                line.split(',').map(|value| value.parse().expect("a number")).collect();
            assert_eq!(values.len(), names.len(), "{line}");
            columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
        }
        History { names, columns }
    }

    /// Column names, in order.
    pub(crate) fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.columns[0].len()
    }

    /// The column called `name`.
    pub(crate) fn column(&self, name: &str) -> &[f64] {
        let place = self.names.iter().position(|column| column == name);
        &self.columns[place.unwrap_or_else(|| panic!("no column {name}"))]
    }

    /// The last `rows` values of a column.
    pub(crate) fn tail(&self, name: &str, rows: usize) -> &[f64] {
        let column = self.column(name);
        &column[column.len() - rows..]
    }

    /// The value of a column at time `t`, linear between rows.
    pub(crate) fn at(&self, name: &str, t: f64) -> f64 {
        let (times, values) = (self.column("t_s"), self.column(name));
        let next = times.partition_point(|time| *time < t).clamp(1, times.len() - 1);
        let share = (t - times[next - 1]) / (times[next] - times[next - 1]);
        values[next - 1] + share * (values[next] - values[next - 1])
    }
}

/// What one run left behind.
pub(crate) struct Run {
    pub(crate) history: History,
    pub(crate) summary: serde_json::Value,
}

/// The reference history of analysis `number`, made by an independent program.
pub(crate) fn reference(number: usize) -> History {
    let path = root().join(format!("tests/data/hu2003-{number}.csv.gz"));
    let packed = std::fs::File::open(&path).expect("reference data");
    let mut text = String::new();
    flate2::read::GzDecoder::new(packed).read_to_string(&mut text).expect("gzip");
    History::parse(&text)
}

/// The run of a shipped case, by name; every case is run once, whoever asks first.
pub(crate) fn shipped(case: &str) -> Arc<Run> {
    type Slot = Arc<OnceLock<Arc<Run>>>;
    static RUNS: OnceLock<Mutex<BTreeMap<String, Slot>>> = OnceLock::new();
    let runs = RUNS.get_or_init(Mutex::default);
    let slot = runs.lock().expect("no panic inside").entry(case.to_string()).or_default().clone();
    slot.get_or_init(|| Arc::new(run(case))).clone()
}

/// Runs a case, by name or path, into a folder of its own.
pub(crate) fn run(case: &str) -> Run {
    let out = tempfile::tempdir().expect("a temporary folder");
    // One cache for all: the cases share the machine, and tests of the cache have their own.
    let cache = root().join("target/tmp/system-cache");
    let output = Command::new(env!("CARGO_BIN_EXE_whirl"))
        .args(["run", case, "--out"])
        .arg(out.path())
        .arg("--cache")
        .arg(cache)
        .output()
        .expect("the binary runs");
    assert!(
        output.status.success(),
        "{case}: {}\n{}",
        output.status,
        String::from_utf8_lossy(&output.stderr)
    );
    let read = |name: &str| std::fs::read_to_string(out.path().join(name)).expect(name);
    Run {
        history: History::parse(&read("history.csv")),
        summary: serde_json::from_str(&read("summary.json")).expect("valid JSON"),
    }
}

/// The folder of the workspace.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace").to_path_buf()
}
