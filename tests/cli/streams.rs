//! Standard output and standard error that nobody reads, or that are full.
#![cfg(unix)]

#[cfg(target_os = "linux")]
use std::fs::File;
use std::io;
use std::process::Stdio;

use crate::workbench::Workbench;

/// Every command that writes to standard output, as it ends well.
const COMMANDS: [&[&str]; 6] = [
    &["list"],
    &["schema", "case"],
    &["explain", "hu2003-linear"],
    &["check", "sdnd101"],
    &["new", "law", "mine"],
    &["run", "sdnd101", "--no-figures"],
];

/// The end of a pipe whose other end is closed.
fn closed() -> Stdio {
    let (reader, writer) = io::pipe().expect("a pipe");
    drop(reader);
    writer.into()
}

#[test]
fn a_closed_pipe_ends_no_command_otherwise() {
    for arguments in COMMANDS {
        let bench = Workbench::new();
        let output = bench.command(arguments).stdout(closed()).output().expect("the binary runs");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {errors}");
        assert!(!errors.contains("error"), "{arguments:?}: {errors}");
    }
    // Nor does one behind standard error.
    for (arguments, status) in [(&["check", "absent.toml"][..], 2), (&["run", "sdnd101"], 0)] {
        let bench = Workbench::new();
        let ended = bench.command(arguments).stdout(closed()).stderr(closed()).status();
        assert_eq!(ended.expect("the binary runs").code(), Some(status), "{arguments:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_an_error() {
    for arguments in COMMANDS {
        let bench = Workbench::new();
        let full = File::options().write(true).open("/dev/full").expect("Linux has it");
        let output = bench.command(arguments).stdout(full).output().expect("the binary runs");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {errors}");
        for words in ["error: cannot write to standard output: No space left", "= help:"] {
            assert!(errors.contains(words), "{arguments:?}: `{words}` is not in: {errors}");
        }
        // What goes to files is whole.
        if arguments[0] == "run" {
            let expected =
                ["about.json", "history.csv", "report.html", "state.bin", "summary.json"];
            assert_eq!(bench.listing_of("results/sdnd101"), expected);
        }
    }
}
