//! Instructions that a time step takes, by phase and by function, counted by callgrind: the same on a busy machine as on a quiet
//! one. The program beside this one marches the first steps of the fifth analysis, or of the built-in cases that are named.

use std::collections::HashMap;
use std::error::Error;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

/// Steps that are counted.
const STEPS: usize = 600;
/// Functions that are named.
const NAMED: usize = 14;

/// What a step consists of: what it is called, and the function that does it. Within whole evaluations what these call is shown.
const PHASES: [(&str, &str); 7] = [
    ("whole evaluations", EVALUATION),
    ("directions", "KeptFactors::solve"),
    ("new factors", "KeptFactors::factor"),
    ("whether rows are solved", "::row_error"),
    ("energies and errors of the step", "Meters::add"),
    ("the row of the step", "row::write_row"),
    ("the steady state", "SteadyTest::add"),
];
const EVALUATION: &str = "Equations::evaluate";
/// What it calls for the springs, where the compiler leaves that a function of its own.
const SPRINGS: &str = "SpringState::update";
/// What an evaluation consists of.
const PARTS: [(&str, &str); 5] = [
    ("bodies that turn", "TurningBody::evaluate"),
    ("motions of bores", "Bores::add_motion"),
    ("forces on bores", "Bores::add_force"),
    ("laws", "SpringState::respond"),
    ("loads", "Load::add_force"),
];

fn main() -> Result<(), Box<dyn Error>> {
    let whirl = env::current_exe()?.with_file_name(format!("whirl{}", env::consts::EXE_SUFFIX));
    if !whirl.exists() {
        return Err(format!("{} is not there: `cargo build --release`", whirl.display()).into());
    }
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("nothing was counted: there is no valgrind");
        return Ok(());
    }
    let mut names: Vec<String> = env::args().skip(1).collect();
    if names.is_empty() {
        names.push("hu2003-5".to_owned());
    }
    let folder = env::temp_dir().join(format!("whirl-instructions-{}", std::process::id()));
    fs::create_dir_all(&folder)?;
    for name in &names {
        count(&whirl, name, &folder)?;
    }
    fs::remove_dir_all(&folder)?;
    Ok(())
}

fn count(whirl: &Path, name: &str, folder: &Path) -> Result<(), Box<dyn Error>> {
    let case = folder.join("case.toml");
    fs::write(&case, format!("include = \"{name}.toml\"\n[march]\nsteps = {STEPS}\n"))?;
    let run = |command: &mut Command| -> Result<(), Box<dyn Error>> {
        let status = command
            .arg("run")
            .arg(&case)
            .args(["--quiet", "--no-figures", "--out"])
            .arg(folder.join("out"))
            .status()?;
        if status.success() { Ok(()) } else { Err(format!("{name} ended with {status}").into()) }
    };
    // So that the bodies are reduced.
    run(&mut Command::new(whirl))?;
    let counts = folder.join("counts");
    run(Command::new("valgrind")
        .args(["-q", "--tool=callgrind", "--toggle-collect=*March*advance*"])
        .arg(format!("--callgrind-out-file={}", counts.display()))
        .arg(whirl))?;
    let annotated = Command::new("callgrind_annotate")
        .args(["--threshold=100", "--show-percs=no"])
        .arg(&counts)
        .output()?;
    let annotated = String::from_utf8(annotated.stdout)?;
    let total = total(&annotated)?;
    println!(
        "{name}: {:.0} thousand instructions a step, {STEPS} steps",
        1e-3 * total / STEPS as f64
    );
    print_phases(&fs::read_to_string(&counts)?, total);
    print_functions(&annotated, total);
    Ok(())
}

/// Instructions of all steps.
fn total(annotated: &str) -> Result<f64, Box<dyn Error>> {
    let total =
        annotated.lines().find(|line| line.contains("PROGRAM TOTALS")).and_then(first_number);
    Ok(total.ok_or("callgrind_annotate gives no total")?)
}

fn first_number(line: &str) -> Option<f64> {
    line.split_whitespace().next()?.replace(',', "").parse().ok()
}

/// A table of the phases and of what is beside them: 100 % together.
fn print_phases(counts: &str, total: f64) {
    let calls = calls(counts);
    let spent = |from: &str, function: &str| -> f64 {
        let own = calls.iter().filter(|((caller, called), _)| {
            caller.contains(from) && called.contains(function) && !caller.contains(function)
        });
        own.map(|(_, cost)| cost).fold(0.0, |sum, cost| sum + cost)
    };
    let row = |count: f64, what: &str| {
        println!("{:7.1} %  {:9.1}  {what}", 100.0 * count / total, 1e-3 * count / STEPS as f64);
    };
    let mut rest = total;
    for (what, function) in PHASES {
        let count = spent("", function);
        row(count, what);
        rest -= count;
        if function == EVALUATION {
            let parts = PARTS.map(|(what, called)| {
                (what, [EVALUATION, SPRINGS].map(|from| spent(from, called)).iter().sum::<f64>())
            });
            parts.iter().for_each(|(what, count)| row(*count, &format!("    {what}")));
            let others = count - parts.iter().map(|(_, count)| count).sum::<f64>();
            row(others, "    sums of terms, bodies that stand");
        }
    }
    row(rest, "predictions, corrections, norms");
    println!();
}

/// Instructions between a call and its return, by the names of caller and called.
fn calls(counts: &str) -> HashMap<(String, String), f64> {
    let mut names = HashMap::new();
    let mut name = |text: &str| -> String {
        let (id, name) = text.split_once(' ').unwrap_or((text, ""));
        let known = names.entry(id.to_owned()).or_insert_with(|| name.to_owned());
        known.clone()
    };
    let (mut caller, mut called, mut returns) = (String::new(), String::new(), false);
    let mut calls = HashMap::new();
    for line in counts.lines() {
        if let Some(text) = line.strip_prefix("fn=") {
            caller = name(text);
        } else if let Some(text) = line.strip_prefix("cfn=") {
            called = name(text);
        } else if line.starts_with("calls=") {
            returns = true;
        } else if returns {
            returns = false;
            let cost = line.split_whitespace().nth(1).and_then(|cost| cost.parse::<f64>().ok());
            *calls.entry((caller.clone(), called.clone())).or_default() += cost.unwrap_or(0.0);
        }
    }
    calls
}

/// A table of the functions with most instructions, and of all others together.
fn print_functions(annotated: &str, total: f64) {
    let functions = annotated.lines().filter_map(|line| {
        // "number  file:function [object]".
        let (_, rest) = line.trim().split_once("  ")?;
        let function = rest.rsplit_once(" [").map_or(rest, |(function, _)| function);
        let (_, function) = function.split_once(':')?;
        Some((first_number(line)?, function.trim()))
    });
    let mut functions: Vec<(f64, &str)> = functions.collect();
    functions.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut rest = total;
    for (count, function) in functions.iter().take(NAMED) {
        println!(
            "{:7.1} %  {:9.1}  {function}",
            100.0 * count / total,
            1e-3 * count / STEPS as f64
        );
        rest -= count;
    }
    println!("{:7.1} %  {:9.1}  all others", 100.0 * rest / total, 1e-3 * rest / STEPS as f64);
}
