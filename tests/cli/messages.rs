//! The text of every error of a case: bad files in `messages`, each with what `whirl check` says of it.
//! WHIRL_RENEW_GOLDEN=1 writes the texts anew.

use std::fs;
use std::path::{Path, PathBuf};

use crate::workbench::Workbench;

pub(crate) fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/cli/messages")
}

/// Names of the files with an ending, sorted.
fn names(ending: &str) -> Vec<String> {
    let entries = fs::read_dir(folder()).expect("the folder of messages");
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<String> = names
        .filter_map(|name| name.to_string_lossy().strip_suffix(ending).map(str::to_owned))
        .filter(|name| !name.ends_with(".law"))
        .collect();
    names.sort();
    names
}

/// A bench with all files of the folder.
fn bench() -> Workbench {
    let files = fs::read_dir(folder()).expect("the folder").map(|entry| entry.expect("an entry"));
    let read = |file: &fs::DirEntry| {
        file.path().extension().is_some_and(|end| end == "toml" || end == "csv")
    };
    files.filter(read).fold(Workbench::new(), |bench, file| {
        let text = fs::read_to_string(file.path()).expect("a text");
        bench.file(&file.file_name().to_string_lossy(), &text)
    })
}

#[test]
fn every_message_of_a_case_reads_as_committed() {
    let (bench, mut wrong) = (bench(), Vec::new());
    let before = bench.listing();
    for name in names(".toml") {
        let outcome = bench.whirl(&["check", &format!("{name}.toml")]);
        assert_eq!(
            (outcome.status, outcome.stdout.as_str()),
            (2, ""),
            "{name}: {}",
            outcome.stderr
        );
        let code = name.split('-').next().expect("a code");
        assert!(outcome.stderr.contains(&format!("error[{code}]")), "{name}: {}", outcome.stderr);
        let path = folder().join(format!("{name}.txt"));
        let expected = whirl_tests::golden::committed(&path, &outcome.stderr);
        if outcome.stderr != expected {
            wrong.push(format!("{name}: expected\n{expected}\nfound\n{}", outcome.stderr));
        }
    }
    assert!(wrong.is_empty(), "{}\nWHIRL_RENEW_GOLDEN=1 renews them", wrong.join("\n"));
    assert_eq!(bench.listing(), before, "nothing is written");
}

#[test]
fn every_text_belongs_to_a_case() {
    assert_eq!(names(".txt"), names(".toml"));
}

/// A case is checked and run alike: both say the same of what is wrong.
#[test]
fn a_run_says_what_the_check_says() {
    let bench = bench();
    for name in ["E003-machine", "E004-sets", "E004-stops", "E021-units"] {
        let file = format!("{name}.toml");
        let [checked, run] = ["check", "run"].map(|command| bench.whirl(&[command, &file]).stderr);
        assert_eq!(checked, run, "{name}");
    }
}
