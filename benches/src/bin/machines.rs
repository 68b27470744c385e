//! How fast every built-in machine is marched: the program beside this one runs each three times, and the fastest march of
//! each counts. Names as arguments pick machines; no time is held against a bound.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use serde_json::Value;

/// Runs of a machine.
const ROUNDS: usize = 3;

fn main() -> Result<(), Box<dyn Error>> {
    let whirl = env::current_exe()?.with_file_name(format!("whirl{}", env::consts::EXE_SUFFIX));
    if !whirl.exists() {
        return Err(format!("{} is not there: `cargo build --release`", whirl.display()).into());
    }
    let picked: Vec<String> = env::args().skip(1).collect();
    let folder = env::temp_dir().join(format!("whirl-machines-{}", std::process::id()));
    println!(
        "| Machine | Steps | Simulated / wall time | A step (µs) | Iterations a step | Factorisations in 1000 steps |"
    );
    println!("|---|---|---|---|---|---|");
    for name in machines(&whirl)?.iter().filter(|name| picked.is_empty() || picked.contains(name)) {
        match fastest(&whirl, name, &folder) {
            Ok(row) => println!("| {name} | {row} |"),
            Err(why) => println!("| {name} | {why} | | | | |"),
        }
    }
    fs::remove_dir_all(&folder)?;
    Ok(())
}

/// The names that `whirl list` has under its first heading.
fn machines(whirl: &Path) -> Result<Vec<String>, Box<dyn Error>> {
    let output = Command::new(whirl).arg("list").output()?;
    let text = String::from_utf8(output.stdout)?;
    let lines = text.lines().skip(1).take_while(|line| !line.is_empty());
    Ok(lines.filter_map(|line| Some(line.split_whitespace().next()?.to_owned())).collect())
}

/// The row of the fastest march of a machine; the first run finds its reduced bodies.
fn fastest(whirl: &Path, name: &str, folder: &PathBuf) -> Result<String, Box<dyn Error>> {
    let mut best: Option<(f64, Value)> = None;
    for _ in 0..ROUNDS {
        let status = Command::new(whirl)
            .args(["run", name, "--quiet", "--no-figures", "--out"])
            .arg(folder)
            .status()?;
        if !status.success() {
            return Err(format!("ended with {status}").into());
        }
        let summary: Value =
            serde_json::from_str(&fs::read_to_string(folder.join("summary.json"))?)?;
        let wall = summary["time"]["march_wall_s"].as_f64().ok_or("no time of the march")?;
        if best.as_ref().is_none_or(|(least, _)| wall < *least) {
            best = Some((wall, summary));
        }
    }
    let (wall, summary) = best.ok_or("no run")?;
    let number = |table: &str, key: &str| {
        summary[table][key].as_f64().ok_or_else(|| format!("the summary has no {table}.{key}"))
    };
    let steps = number("march", "steps")?;
    Ok(format!(
        "{steps} | {:.2} | {:.1} | {:.2} | {:.1}",
        number("time", "simulated_s")? / wall,
        1e6 * wall / steps,
        number("march", "iterations")? / steps,
        1e3 * number("march", "factorisations")? / steps,
    ))
}
