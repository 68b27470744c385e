//! Instructions that a time step takes, by function, counted by callgrind: the same on a busy machine as on a quiet one. The
//! program beside this one marches the first steps of the fifth analysis, or of the built-in cases that are named.

use std::error::Error;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

/// Steps that are counted.
const STEPS: usize = 600;
/// Functions that are named.
const NAMED: usize = 14;

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
    print(name, &String::from_utf8(annotated.stdout)?)
}

/// A table of the functions with most instructions, and of all others together.
fn print(name: &str, annotated: &str) -> Result<(), Box<dyn Error>> {
    let number = |line: &str| line.split_whitespace().next()?.replace(',', "").parse::<f64>().ok();
    let total = annotated.lines().find(|line| line.contains("PROGRAM TOTALS")).and_then(number);
    let total = total.ok_or("callgrind_annotate gives no total")?;
    let functions = annotated.lines().filter_map(|line| {
        // "number  file:function [object]".
        let (_, rest) = line.trim().split_once("  ")?;
        let function = rest.rsplit_once(" [").map_or(rest, |(function, _)| function);
        let (_, function) = function.split_once(':')?;
        Some((number(line)?, function.trim()))
    });
    let mut functions: Vec<(f64, &str)> = functions.collect();
    functions.sort_by(|a, b| b.0.total_cmp(&a.0));
    println!(
        "{name}: {:.0} thousand instructions a step, {STEPS} steps",
        1e-3 * total / STEPS as f64
    );
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
    Ok(())
}
