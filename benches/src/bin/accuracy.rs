//! Error over work of steps that the program chooses, beside equal steps: the program beside this one marches some machines both
//! ways. Names as arguments pick machines.
//!
//! The error is the root mean square difference of all displacements from those of far shorter equal steps, over their peak. Of
//! equal steps it is interpolated, in logarithms, to where they do the same work. Work is counted as parts of steps that were
//! solved, those done again included, and as iterations; how long the marches took stands beside it.

use std::error::Error;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

use serde_json::Value;
use whirl_benches::history::displacements;

/// A machine, the interval between its rows (s) and how many there are.
struct Bench {
    name: &'static str,
    /// The head of its case.
    case: &'static str,
    row: f64,
    rows: usize,
    /// Equal steps a row: the longest and the shortest, doubled between them, and those of the reference.
    equal: [usize; 3],
}

const BENCHES: [Bench; 7] = [
    Bench { name: "stop", case: STOP, row: 2e-4, rows: 400, equal: [1, 64, 512] },
    Bench { name: "rub", case: RUB, row: 4e-4, rows: 500, equal: [1, 64, 512] },
    Bench {
        name: "annular-rub",
        case: "include = \"annular-rub.toml\"\n",
        row: 8e-4,
        rows: 600,
        equal: [1, 32, 128],
    },
    Bench {
        name: "overhung-disc",
        case: "include = \"overhung-disc.toml\"\n",
        row: 4e-4,
        rows: 500,
        equal: [1, 32, 128],
    },
    Bench {
        name: "crank",
        case: "include = \"crank.toml\"\n",
        row: 1.6e-4,
        rows: 190,
        equal: [2, 64, 256],
    },
    Bench {
        name: "turbocharger",
        case: "include = \"turbocharger.toml\"\n",
        row: 4e-5,
        rows: 500,
        equal: [1, 16, 64],
    },
    // With the end of the couple within a step: where steps begin is no matter.
    Bench {
        name: "hu2003-5",
        case: "include = \"hu2003-5.toml\"\n[drive]\nrelease = \"located\"\n",
        row: 5.92e-4,
        rows: 100,
        equal: [1, 64, 128],
    },
];

/// A mass that flies between two stops.
const STOP: &str = r#"title = "A mass between two stops"
[mass]
mass = "1 kg"
stiffness = "100 N/m"
velocity = "1.3 m/s"
[[stop]]
side = "above"
gap = "1 mm"
law = "gap-linear-1e6"
[[stop]]
side = "below"
gap = "1.5 mm"
law = "gap-linear-1e6"
"#;

/// A rotor that strikes a wall again and again, with friction.
const RUB: &str = r#"title = "A rotor that rubs on a wall"
[mass]
mass = "1 kg"
stiffness = "1e4 N/m"
damping = "20 N*s/m"
[mass.unbalance]
eccentricity = "0.4 mm"
speed = "120 rad/s"
[[stop]]
side = "above"
gap = "0.6 mm"
law = "rub-coulomb"
journal_radius = "20 mm"
parameters = { k = "1e6 N/m", mu = 0.1 }
"#;

const TOLERANCES: [f64; 4] = [1e-3, 1e-4, 1e-5, 1e-6];

/// Rows that are marched to foresee them before steps are chosen.
const FORESEEN: f64 = 16.0;

/// What a march did.
struct Marched {
    /// Displacements, row after row (µm).
    path: Vec<f64>,
    parts: f64,
    iterations: f64,
    wall: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let whirl = env::current_exe()?.with_file_name(format!("whirl{}", env::consts::EXE_SUFFIX));
    if !whirl.exists() {
        return Err(format!("{} is not there: `cargo build --release`", whirl.display()).into());
    }
    let picked: Vec<String> = env::args().skip(1).collect();
    let folder = env::temp_dir().join(format!("whirl-accuracy-{}", std::process::id()));
    fs::create_dir_all(&folder)?;
    println!(
        "| Machine | Tolerance | Parts | Iterations | Wall (s) | Error | Over that of equal steps with as many parts | as many iterations | as long a time |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for bench in
        BENCHES.iter().filter(|own| picked.is_empty() || picked.iter().any(|p| p == own.name))
    {
        compare(&whirl, bench, &folder).map_err(|why| format!("{}: {why}", bench.name))?;
    }
    fs::remove_dir_all(&folder)?;
    Ok(())
}

/// Prints the rows of a machine.
fn compare(whirl: &Path, bench: &Bench, folder: &Path) -> Result<(), Box<dyn Error>> {
    let [longest, shortest, reference] = bench.equal;
    let equal = |steps: usize| {
        let step = format!("time_step = \"{:e} s\"", bench.row / steps as f64);
        march(whirl, bench, &step, folder)
    };
    let exact = equal(reference)?.path;
    let peak = exact.iter().fold(0.0, |peak: f64, own| peak.max(own.abs()));
    let error = |path: &[f64]| {
        let squares: f64 = path.iter().zip(&exact).map(|(a, b)| (a - b).powi(2)).sum();
        (squares / exact.len() as f64).sqrt() / peak
    };
    let counts = std::iter::successors(Some(longest), |steps| Some(2 * steps));
    let mut known = Vec::new();
    for steps in counts.take_while(|steps| *steps <= shortest) {
        let own = equal(steps)?;
        known.push(([own.parts, own.iterations, own.wall], error(&own.path)));
    }
    for tolerance in TOLERANCES {
        let step = format!("time_step = \"auto\"\nstep_tolerance = {tolerance:e}");
        let own = march(whirl, bench, &step, folder)?;
        let found = error(&own.path);
        let work = [own.parts, own.iterations, own.wall];
        let ratios = [0, 1, 2].map(|kind| {
            let curve: Vec<[f64; 2]> = known.iter().map(|(at, error)| [at[kind], *error]).collect();
            match error_at(&curve, work[kind]) {
                Some(equal) => format!("{:.2}", found / equal),
                None => "none does".to_owned(),
            }
        });
        println!(
            "| {} | {tolerance:e} | {} | {} | {:.3} | {found:.1e} | {} |",
            bench.name,
            own.parts,
            own.iterations,
            own.wall,
            ratios.join(" | ")
        );
    }
    Ok(())
}

/// The error of a curve of work and errors where the work is so much, by the straight line through the logarithms of two
/// neighbours; none where the curve does not reach it. Of marches that are worse for more work only the better ones count.
fn error_at(curve: &[[f64; 2]], work: f64) -> Option<f64> {
    let best = curve
        .iter()
        .filter(|own| !curve.iter().any(|other| other[0] <= own[0] && other[1] < own[1]));
    let logs: Vec<[f64; 2]> = best.map(|own| own.map(f64::ln)).collect();
    let at = work.ln();
    let pair = logs.windows(2).find(|pair| pair[0][0] <= at && at <= pair[1][0])?;
    let share = (at - pair[0][0]) / (pair[1][0] - pair[0][0]);
    Some((pair[0][1] + share * (pair[1][1] - pair[0][1])).exp())
}

/// Marches a machine with some steps.
fn march(
    whirl: &Path,
    bench: &Bench,
    step: &str,
    folder: &Path,
) -> Result<Marched, Box<dyn Error>> {
    let case = folder.join("case.toml");
    let (out, head) = (folder.join("out"), bench.case);
    let duration = bench.row * bench.rows as f64;
    fs::write(
        &case,
        format!(
            "{head}[march]\n{step}\noutput_step = \"{:e} s\"\nduration = \"{duration:e} s\"\n",
            bench.row
        ),
    )?;
    let done = Command::new(whirl)
        .arg("run")
        .arg(&case)
        .args(["--quiet", "--no-figures", "--out"])
        .arg(&out)
        .output()?;
    if !done.status.success() {
        return Err(String::from_utf8_lossy(&done.stderr).into());
    }
    let summary: Value = serde_json::from_str(&fs::read_to_string(out.join("summary.json"))?)?;
    let number = |own: &Value, key: &str| own[key].as_f64().ok_or(format!("no {key}"));
    let facts = &summary["march"];
    let parts = match facts.get("automatic").filter(|own| !own.is_null()) {
        Some(own) => FORESEEN + number(own, "steps")? + number(own, "rejected_steps")?,
        None => number(facts, "steps")?,
    };
    Ok(Marched {
        path: displacements(&fs::read_to_string(out.join("history.csv"))?)?,
        parts,
        iterations: number(facts, "iterations")?,
        wall: number(&summary["time"], "march_wall_s")?,
    })
}
