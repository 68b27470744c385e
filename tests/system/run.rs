//! Runs cases with the binary, each once, and reads what it wrote.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Arc, Mutex, OnceLock};

use whirl_tests::History;

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
