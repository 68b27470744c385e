//! How fast every built-in machine is marched: the program beside this one runs each three times, and the fastest march of
//! each counts. A second table has the machines that are slow: their own step, longer ones and steps that the program chooses, each
//! with its error, the root mean square difference of all displacements from those of steps a sixteenth as long, over their peak.
//! Names as arguments pick machines; no time is held against a bound.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use serde_json::Value;
use whirl_benches::history::displacements;

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
    println!("\n| Machine | Step | Steps | Simulated / wall time | Error |\n|---|---|---|---|---|");
    for slow in SLOW.iter().filter(|own| picked.is_empty() || picked.iter().any(|p| p == own.name))
    {
        compare(&whirl, slow, &folder).map_err(|why| format!("{}: {why}", slow.name))?;
    }
    fs::remove_dir_all(&folder)?;
    Ok(())
}

/// A machine whose own step is short: that step, the interval between rows that are compared, and how long it is marched (s).
struct Slow {
    name: &'static str,
    step: f64,
    row: f64,
    duration: f64,
}

const SLOW: [Slow; 3] = [
    Slow { name: "turbocharger", step: 1e-5, row: 4e-5, duration: 0.2 },
    Slow { name: "crank", step: 2e-5, row: 1.6e-4, duration: 0.24 },
    Slow { name: "two-spool", step: 2e-5, row: 1.6e-4, duration: 0.2 },
];

/// Prints the rows of a slow machine.
fn compare(whirl: &Path, own: &Slow, folder: &Path) -> Result<(), Box<dyn Error>> {
    let equal = |step: f64| (format!("{step:e} s"), format!("time_step = \"{step:e} s\""));
    let (exact, _) = march(whirl, own, &equal(own.step / 16.0).1, folder)?;
    let peak = exact.iter().fold(0.0, |peak: f64, own| peak.max(own.abs()));
    let automatic = [1e-3, 1e-4].map(|tolerance: f64| {
        let step = format!("time_step = \"auto\"\nstep_tolerance = {tolerance:e}");
        (format!("auto, {tolerance:e}"), step)
    });
    for (called, step) in
        [1.0, 2.0, 4.0].map(|times| equal(times * own.step)).into_iter().chain(automatic)
    {
        let (path, facts) = march(whirl, own, &step, folder)?;
        let squares: f64 = path.iter().zip(&exact).map(|(a, b)| (a - b).powi(2)).sum();
        let error = (squares / exact.len() as f64).sqrt() / peak;
        println!("| {} | {called} | {facts} | {error:.1e} |", own.name);
    }
    Ok(())
}

/// Displacements of a march, row after row (µm), and how many steps it took and how fast it was.
fn march(
    whirl: &Path,
    own: &Slow,
    step: &str,
    folder: &Path,
) -> Result<(Vec<f64>, String), Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    let (case, out) = (folder.join("case.toml"), folder.join("out"));
    let Slow { name, row, duration, .. } = own;
    let text = format!(
        "include = \"{name}.toml\"\n[march]\n{step}\noutput_step = \"{row:e} s\"\nduration = \"{duration:e} s\"\n"
    );
    fs::write(&case, text)?;
    let done = Command::new(whirl)
        .arg("run")
        .arg(&case)
        .args(["--quiet", "--no-figures", "--no-report", "--out"])
        .arg(&out)
        .output()?;
    if !done.status.success() {
        return Err(String::from_utf8_lossy(&done.stderr).into());
    }
    let summary: Value = serde_json::from_str(&fs::read_to_string(out.join("summary.json"))?)?;
    let number = |own: &Value, key: &str| own[key].as_f64().ok_or(format!("no {key}"));
    let (march, time) = (&summary["march"], &summary["time"]);
    let steps = match march.get("automatic").filter(|own| !own.is_null()) {
        Some(own) => number(own, "steps")? + number(own, "rejected_steps")?,
        None => number(march, "steps")?,
    };
    let pace = number(time, "simulated_s")? / number(time, "march_wall_s")?;
    let path = displacements(&fs::read_to_string(out.join("history.csv"))?)?;
    Ok((path, format!("{steps} | {pace:.2}")))
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
