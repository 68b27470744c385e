//! docs/first-law.md is a session: its files are written, its changes made and its commands run, and what
//! they print must stand there. WHIRL_RENEW_GOLDEN=1 writes the outputs anew: read the difference.

use std::fs;
use std::path::Path;

use crate::workbench::Workbench;

const FENCE: &str = "```";

/// Runs a block and gives the text that belongs into it.
fn play(bench: &Workbench, kind: &str, body: &str) -> String {
    match kind {
        "toml" => {
            fs::write(bench.path(&name(body)), body).expect("the file can be written");
            body.to_string()
        }
        "diff" => {
            let path = bench.path(&name(body));
            let text = fs::read_to_string(&path).expect("a file to change");
            fs::write(path, changed(&text, body)).expect("the file can be written");
            body.to_string()
        }
        "console" => {
            let commands = body.lines().filter_map(|line| line.strip_prefix("$ "));
            commands.map(|command| format!("$ {command}\n{}", output(bench, command))).collect()
        }
        _ => body.to_string(),
    }
}

/// The file that a block's first line names: `# name.toml`.
fn name(body: &str) -> String {
    let first = body.lines().next().expect("a first line");
    first.strip_prefix("# ").unwrap_or_else(|| panic!("`{first}` names no file")).to_string()
}

/// Lines with `-` become those with `+` behind them.
fn changed(text: &str, difference: &str) -> String {
    let mut text = text.to_string();
    let (mut old, mut new) = (String::new(), String::new());
    for line in difference.lines().skip(1).chain(["-"]) {
        if let Some(line) = line.strip_prefix('-') {
            if !new.is_empty() {
                assert_eq!(text.matches(&old).count(), 1, "`{old}` stands once in:\n{text}");
                text = text.replace(&old, &new);
                (old, new) = (String::new(), String::new());
            }
            old += &format!("{line}\n");
        } else {
            let line = line.strip_prefix('+').expect("lines begin with - or +");
            new += &format!("{line}\n");
        }
    }
    text
}

/// What a command prints; 2 is the status if that is an error, else 0.
fn output(bench: &Workbench, command: &str) -> String {
    let mut words = command.split_whitespace();
    assert_eq!(words.next(), Some("whirl"), "{command}");
    let outcome = bench.whirl(&words.collect::<Vec<_>>());
    let errors = outcome.stderr.starts_with("error");
    assert_eq!(outcome.status, if errors { 2 } else { 0 }, "{command}: {}", outcome.stderr);
    // Progress goes to stderr too and has no place in a document.
    if errors { outcome.stderr } else { outcome.stdout }
}

#[test]
fn the_first_law_of_the_documents_is_a_session_that_runs() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/first-law.md");
    let document = fs::read_to_string(&path).expect("the document");
    let bench = Workbench::new();
    let mut played = String::new();
    let mut lines = document.lines();
    let (mut commands, mut errors) = (0, 0);
    while let Some(line) = lines.next() {
        played += &format!("{line}\n");
        let Some(kind) = line.strip_prefix(FENCE) else { continue };
        let body: Vec<&str> = lines.by_ref().take_while(|line| *line != FENCE).collect();
        let body: String = body.iter().map(|line| format!("{line}\n")).collect();
        let found = play(&bench, kind, &body);
        commands += found.matches("$ whirl").count();
        errors += found.lines().filter(|line| line.starts_with("error[")).count();
        played += &format!("{found}{FENCE}\n");
    }
    whirl_tests::golden::is_as_committed(&path, &played);
    assert!(commands >= 6 && errors >= 3, "{commands} commands with {errors} errors");
}
