//! What a newcomer's shell knows of the command: first steps, completions, manual pages.

use std::fs;

use crate::workbench::Workbench;

/// Commands by their names, as the help lists them.
fn commands(bench: &Workbench) -> Vec<String> {
    let help = bench.whirl(&["--help"]).stdout;
    let (_, listed) = help.split_once("Commands:\n").expect("a list of commands");
    let (listed, _) = listed.split_once("\n\n").expect("its end");
    let names = listed.lines().filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(str::to_owned).collect()
}

#[test]
fn without_a_command_the_first_steps_are_named() {
    let bench = Workbench::new();
    let alone = bench.whirl(&[]);
    assert_eq!((alone.status, alone.stdout.as_str()), (2, ""));
    let (_, steps) = alone.stderr.split_once("First steps:\n").expect("first steps");
    let steps: Vec<&str> = steps.lines().filter(|line| line.starts_with("  whirl ")).collect();
    assert_eq!(steps.len(), 3);
    // What is named can be typed: the last step in full, the others as far as they are read.
    let own = bench.whirl(&["new", "case", "mine", "--like", "turbocharger"]);
    assert!(steps[2].contains("whirl new case mine --like turbocharger") && own.status == 0);
    assert!(steps[0].starts_with("  whirl run hu2003-5 "));
    assert!(steps[1].starts_with("  whirl campbell overhung-disc "));
    let listed = bench.whirl(&["list"]).stdout;
    for name in ["hu2003-5", "overhung-disc", "turbocharger"] {
        assert!(listed.contains(&format!("  {name} ")), "{name}");
    }
}

#[test]
fn shells_complete_every_command() {
    let bench = Workbench::new();
    let commands = commands(&bench);
    assert!(commands.len() > 15, "{commands:?}");
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = bench.whirl(&["completions", shell]);
        assert_eq!((script.status, script.stderr.as_str()), (0, ""), "{shell}");
        for command in &commands {
            assert!(script.stdout.contains(command.as_str()), "{shell}: {command}");
        }
        assert_eq!(script.stdout, bench.whirl(&["completions", shell]).stdout);
    }
    let unknown = bench.whirl(&["completions", "tcsh"]);
    assert_eq!(unknown.status, 2);
    assert!(unknown.stderr.contains("bash"), "{}", unknown.stderr);
}

#[test]
fn every_command_has_a_manual_page() {
    let bench = Workbench::new();
    let written = bench.whirl(&["man", "--out", "share/man1"]);
    assert_eq!((written.status, written.stderr.as_str()), (0, ""));
    assert!(written.stdout.contains("share/man1/whirl.1"), "{}", written.stdout);
    let mut expected: Vec<String> =
        commands(&bench).iter().map(|own| format!("whirl-{own}.1")).collect();
    expected.push("whirl.1".to_owned());
    expected.sort();
    assert_eq!(bench.listing_of("share/man1"), expected);
    let page = fs::read_to_string(bench.path("share/man1/whirl-run.1")).expect("a page");
    for part in [".TH", "SYNOPSIS", "\\-\\-no\\-figures"] {
        assert!(page.contains(part), "{part}");
    }
    // A file in its place is said, with nothing written.
    fs::write(bench.path("taken"), "").expect("written");
    assert_eq!(bench.whirl(&["man", "--out", "taken"]).status, 2);
}
