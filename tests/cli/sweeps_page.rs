//! docs/sweeps.md is a session: its files are written and its commands run, and what they print stands there.

use std::fs;

use crate::workbench::Workbench;

const PAGE: &str = include_str!("../../docs/sweeps.md");

/// Blocks between fences of a kind.
fn blocks(kind: &str) -> Vec<&'static str> {
    let fence = format!("```{kind}\n");
    PAGE.split(&fence).skip(1).map(|rest| rest.split("```").next().expect("an end")).collect()
}

/// Times and sizes are those of the machine that wrote the page.
fn is_measured(line: &str) -> bool {
    line.contains(" core") || line.ends_with(" on disk")
}

/// What is in the cache depends on what was run before.
fn said(line: &str) -> &str {
    line.split("; ").next().unwrap_or_default()
}

#[test]
fn the_page_on_sweeps_is_a_session_that_runs() {
    let bench = Workbench::new();
    for text in blocks("toml") {
        let name = text.lines().next().and_then(|line| line.strip_prefix("# ")).expect("a name");
        fs::write(bench.path(name), text).unwrap();
    }
    let mut commands = 0;
    for block in blocks("console") {
        let (command, printed) = block.split_once('\n').expect("a command and what it prints");
        let command = command.strip_prefix("$ whirl ").expect("a command");
        // The shell's quotes.
        let quoted: Vec<&str> = command.split('"').collect();
        let words = |part: &&'static str| part.split_whitespace().collect::<Vec<_>>();
        let arguments: Vec<&str> = quoted
            .iter()
            .enumerate()
            .flat_map(|(k, part)| if k % 2 == 1 { vec![*part] } else { words(part) })
            .collect();
        let outcome = bench.whirl(&arguments);
        assert_eq!(outcome.status, 0, "{command}: {}", outcome.stderr);
        let [found, stands] = [outcome.stdout.as_str(), printed].map(|text| {
            text.lines().filter(|line| !is_measured(line)).map(said).collect::<Vec<_>>()
        });
        assert_eq!(found, stands, "{command}");
        commands += 1;
    }
    assert_eq!(commands, 6);
    for name in ["together", "tolerances"] {
        let outcome = bench.whirl(&["check", &format!("{name}.toml")]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        assert!(outcome.stdout.contains("6 points"), "{}", outcome.stdout);
    }
    let found = bench.listing_of("results/hysteresis");
    assert!(found.contains(&"bifurcation.svg".to_owned()), "{found:?}");
    // Every column of the table stands on the page, up to numbers of supports.
    let table = fs::read_to_string(bench.path("results/clearances/table.csv")).unwrap();
    for name in table.lines().next().unwrap().split(',') {
        let one = ["2", "3", "4"].iter().fold(name.to_owned(), |name, number| {
            ["RX", "RY", "EX", "EY", "X", "Y", "clearance"].iter().fold(name, |name, head| {
                name.replacen(&format!("{head}{number}_"), &format!("{head}1_"), 1)
            })
        });
        let head = one.split_once(".").map_or(one.as_str(), |(head, _)| head);
        let stands = PAGE.contains(&one) || PAGE.contains(&format!("`{head}.")) || head == "march";
        assert!(stands, "{name} is not on the page");
    }
}
