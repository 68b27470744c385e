//! How the time of a step grows with the modes, the springs and the bodies of a machine: a table each, of built-in cases with
//! other numbers and of machines made for this. Steps come from the march as the program makes it, on one thread.

use std::env;
use std::fmt::Write as _;
use std::path::Path;
use std::time::{Duration, Instant};

use whirl_cli::CaseText;
use whirl_cli::errors::Failure;
use whirl_cli::simulate::begin;
use whirl_solver::cache::Cache;

/// Steps before the timing, so that shafts turn and springs switch.
const WARM: usize = 300;
/// Steps that are timed, each by itself: another program takes the core from few of them, which leaves the median as it is.
const TIMED: usize = 1000;
/// A machine is not timed for longer, however few steps that gives.
const LIMIT: Duration = Duration::from_secs(8);

fn main() {
    if !env::args().any(|argument| argument == "--bench") {
        return;
    }
    println!(
        "one thread; medians of {TIMED} steps after the first {WARM}, less where they take long"
    );
    let analysis = |springs: usize, [shaft, support]: [usize; 2]| {
        format!(
            "include = \"hu2003-5.toml\"\n[springs]\nnumber = {springs}\n[shaft]\nmodes = {shaft}\n\
             [support]\nmodes = {support}\n"
        )
    };
    // A quarter of the modes are the shaft's, as in the analysis.
    let modes = [25, 50, 100, 200, 400, 800].map(|modes| {
        let text = analysis(24, [modes / 4, modes - modes / 4]);
        (format!("{modes} modes"), text)
    });
    table("Modes: the fifth analysis", &modes);
    // Rings of 9 to 834 springs, of which there are twelve.
    let springs = [9, 27, 84, 267, 834]
        .map(|number| (format!("{} springs", 12 * number), analysis(number, [50, 150])));
    table("Springs: the fifth analysis", &springs);
    let bodies = [2, 4, 8, 14, 20].map(|bodies| (format!("{bodies} bodies"), rotors(bodies / 2)));
    table("Bodies: shafts in oil films, each in a housing, which are joined", &bodies);
}

/// Prints how machines march, each beside the one before it.
fn table(title: &str, machines: &[(String, String)]) {
    println!();
    println!("{title}");
    println!();
    println!(
        "| Machine | Coordinates | A step (µs) | Over the row before | Iterations a step | Factorisations in 1000 steps |"
    );
    println!("|---|---|---|---|---|---|");
    let mut before = None;
    for (name, text) in machines {
        match row(text) {
            Ok(row) => {
                let grown =
                    before.map_or(String::new(), |before| format!("{:.2}", row.step / before));
                before = Some(row.step);
                println!(
                    "| {name} | {} | {:.1} | {grown} | {:.2} | {:.1} |",
                    row.coordinates,
                    1e6 * row.step,
                    row.iterations,
                    row.factorisations
                );
            }
            Err(why) => println!("| {name} | {why} | | | | |"),
        }
    }
}

/// How a machine marches.
struct Row {
    coordinates: usize,
    /// Seconds a step.
    step: f64,
    /// Iterations a step, of those that were timed.
    iterations: f64,
    /// In 1000 steps, of the whole march.
    factorisations: f64,
}

fn row(text: &str) -> Result<Row, String> {
    let said = |failure: Failure| failure.report();
    let mut warnings = Vec::new();
    let text = CaseText::new("growth", Path::new(""), text);
    let case = whirl_cli::read_text(&text, &mut warnings).map_err(said)?;
    let cache = Cache::of_platform();
    let built = whirl_cli::build(&case, cache.as_ref(), &mut warnings).map_err(said)?;
    let (mut march, _) = begin(&case, &built).map_err(said)?;
    for _ in 0..WARM {
        march.advance().map_err(|error| error.to_string())?;
    }
    let (begun, mut iterations, mut times) = (Instant::now(), 0, Vec::new());
    while times.len() < TIMED && begun.elapsed() < LIMIT {
        let start = Instant::now();
        march.advance().map_err(|error| error.to_string())?;
        times.push(start.elapsed().as_secs_f64());
        iterations += march.progress().iterations;
    }
    times.sort_by(f64::total_cmp);
    let made = march.progress().step as f64;
    Ok(Row {
        coordinates: built.machine().size(),
        step: times[times.len() / 2],
        iterations: iterations as f64 / times.len() as f64,
        factorisations: 1e3 * march.outcome().factorisations as f64 / made,
    })
}

/// Flexible shafts out of balance, each in two oil films in a housing of its own. Housings stand on bushings, and
/// others join each to the next, so that no part of the machine moves on its own.
fn rotors(count: usize) -> String {
    let mut text = String::from(
        "title = \"shafts in housings\"\n\
         [material]\n\
         steel = { youngs_modulus = \"200 GPa\", poissons_ratio = 0.3, density = \"7860 kg/m^3\" }\n\
         [march]\n\
         time_step = \"5e-5 s\"\n\
         duration = \"1 s\"\n",
    );
    for own in 1..=count {
        let part = ROTOR.replace('#', &own.to_string());
        text.push_str(&part);
        if own < count {
            let (from, to) = (format!("housing{own}"), format!("housing{}", own + 1));
            writeln!(
                text,
                "[joint.link{own}]\n\
                 kind = \"bushing\"\n\
                 first = {{ body = \"{from}\", z = \"500 mm\" }}\n\
                 second = {{ body = \"{to}\", z = \"500 mm\" }}\n\
                 stiffness = {{ xx = \"1e7 N/m\", yy = \"1e7 N/m\" }}"
            )
            .expect("memory can be written");
        }
    }
    text
}

/// A shaft with its housing, by its number in place of `#`.
const ROTOR: &str = r#"
[body.rotor#]
turns = "prescribed"
speed = "3000 rpm"
material = "steel"
modes = 12
damping = "1e-5 s"
axial_restraint = "JOURNAL1_MIDDLE"
unbalance.disc = { mass = "2 g", radius = "50 mm", z = "350 mm" }

[body.rotor#.dimensions]
length = "1 m"
diameter = "60 mm"
supports = ["50 mm", "350 mm", "650 mm", "950 mm"]
support_length = "20 mm"
layers_in_support = 2
layers_between = 10

[body.housing#]
turns = "no"
mass = "40 kg"
transverse_inertia = "4 kg*m^2"
z = "500 mm"

[joint.left#]
kind = "bearing"
journal = { body = "rotor#", sets = ["JOURNAL1_MIDDLE"] }
bore = { body = "housing#", z = "50 mm" }
law = "ocvirk"
parameters = { mu = "20 mPa*s" }
radial_clearance = "60 um"
journal_radius = "30 mm"
length = "20 mm"

[joint.right#]
kind = "bearing"
journal = { body = "rotor#", sets = ["JOURNAL4_MIDDLE"] }
bore = { body = "housing#", z = "950 mm" }
law = "ocvirk"
parameters = { mu = "20 mPa*s" }
radial_clearance = "60 um"
journal_radius = "30 mm"
length = "20 mm"

[joint.front#]
kind = "bushing"
first = { body = "housing#", z = "0 mm" }
stiffness = { xx = "2e7 N/m", yy = "2e7 N/m" }
damping = { xx = "2e3 N*s/m", yy = "2e3 N*s/m" }

[joint.back#]
kind = "bushing"
first = { body = "housing#", z = "1 m" }
stiffness = { xx = "2e7 N/m", yy = "2e7 N/m" }
damping = { xx = "2e3 N*s/m", yy = "2e3 N*s/m" }

[loads.weight#]
body = "rotor#"
sets = ["JOURNAL2_MIDDLE"]
force = "-150 N"
"#;
