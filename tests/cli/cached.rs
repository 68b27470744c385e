//! Reduced bodies come from the cache, and change nothing.

use std::fs;

use crate::workbench::{SHORT, Workbench};

#[test]
fn a_damaged_cache_is_rebuilt_and_changes_nothing() {
    let bench = Workbench::new().file("case.toml", SHORT);
    let run_case = |case: &str, folder: &str, more: &[&str]| {
        let arguments = [&["run", case, "--no-figures", "--out", folder], more].concat();
        let outcome = bench.whirl(&arguments);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let cached = bench.summary(folder)["time"]["reduction_cached"].as_bool();
        (bench.history_text(folder), cached.expect("a truth value"))
    };
    let run = |folder: &str, more: &[&str]| run_case("case.toml", folder, more);
    let (first, cached) = run("first", &["--cache", "cache"]);
    assert!(!cached);
    let (second, cached) = run("second", &["--cache", "cache"]);
    assert!(cached && second == first);
    let entry = fs::read_dir(bench.path("cache")).expect("a folder").next().expect("a file");
    let path = entry.expect("an entry").path();
    let mut bytes = fs::read(&path).expect("a file");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&path, bytes).expect("it can be written");
    let (third, cached) = run("third", &["--cache", "cache"]);
    assert!(!cached && third == first);

    // What is applied to reduced bodies reduces nothing again, and is applied.
    let kept = || fs::read_dir(bench.path("cache")).expect("a folder").count();
    assert_eq!(kept(), 2, "a file a body");
    let changes = [
        "[shaft]\ndamping = \"3e-4 s\"\n",
        "[support]\ndamping = \"3e-4 s\"\n",
        "[springs]\nlaw = \"hu2003-linear\"\n",
        "[drive]\nacts = false\n",
        "[[load]]\nsets = [\"LOAD2\"]\ndirection = \"y\"\nforce = \"700 N\"\n",
    ];
    for (place, change) in changes.iter().enumerate() {
        let (case, folder) = (format!("{place}.toml"), format!("changed-{place}"));
        fs::write(bench.path(&case), format!("{SHORT}\n{change}")).expect("written");
        let (other, cached) = run_case(&case, &folder, &["--cache", "cache"]);
        assert!(cached && other != first, "{change}");
    }
    assert_eq!(kept(), 2);
    // One body in another way: the other one is still known.
    fs::write(bench.path("modes.toml"), format!("{SHORT}\n[shaft]\nmodes = 40\n"))
        .expect("written");
    let (_, cached) = run_case("modes.toml", "modes", &["--cache", "cache"]);
    assert!(!cached);
    assert_eq!(kept(), 3);
}
