//! Sweeps of the program beside this one: throughput on all cores against one, what a point takes beside its steps, memory, and
//! the same points from Python on a cluster of processes where `python3` (or $PYTHON) has the package. No time is held against a
//! bound.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread::available_parallelism;
use std::time::Instant;
use std::{env, fs};

/// Rounds, in which what is compared takes turns; the fastest of each counts.
const ROUNDS: usize = 3;
/// Values of each of two keys, and steps of a point.
const CLEARANCES: usize = 20;
const LOADS: usize = 10;
const STEPS: usize = 400;

/// What the script calls points that are run without a sweep.
const ALONE: &str = "two steps a point, one run after the other";

/// What a command took.
#[derive(Clone, Copy)]
struct Taken {
    /// s.
    wall: f64,
    /// Of all cores (s), where a shell tells it.
    processor: Option<f64>,
}

struct Bench {
    whirl: PathBuf,
    folder: PathBuf,
}

fn main() -> Result<(), Box<dyn Error>> {
    let whirl = env::current_exe()?.with_file_name(format!("whirl{}", env::consts::EXE_SUFFIX));
    if !whirl.exists() {
        return Err(format!("{} is not there: `cargo build --release`", whirl.display()).into());
    }
    let folder = env::temp_dir().join(format!("whirl-sweeps-{}", std::process::id()));
    fs::create_dir_all(&folder)?;
    let bench = Bench { whirl, folder };
    let measured = bench.measure();
    fs::remove_dir_all(&bench.folder)?;
    measured
}

impl Bench {
    fn measure(&self) -> Result<(), Box<dyn Error>> {
        let cores = available_parallelism()?.get();
        let points = (CLEARANCES * LOADS) as f64;
        fs::write(self.folder.join("study.toml"), study(CLEARANCES, LOADS, STEPS))?;
        fs::write(self.folder.join("short.toml"), study(CLEARANCES, LOADS, 2))?;
        // Bodies are there before anything is timed.
        self.sweep("short.toml", 1)?;
        let (mut one, mut all, mut short) = (None, None, None);
        for _ in 0..ROUNDS {
            one = Some(faster(one, self.sweep("study.toml", 1)?));
            all = Some(faster(all, self.sweep("study.toml", cores)?));
            short = Some(faster(short, self.sweep("short.toml", 1)?));
        }
        let (Some(one), Some(all), Some(short)) = (one, all, short) else { return Ok(()) };
        println!("{points} points of hu2003-5 with {STEPS} steps, {cores} cores\n");
        println!("| | Wall time (s) | Processor time (s) | A point (ms) |");
        println!("|---|---|---|---|");
        let row = |what: &str, own: Taken| {
            let processor = own.processor.map_or("-".to_owned(), |time| format!("{time:.2}"));
            println!("| {what} | {:.2} | {processor} | {:.1} |", own.wall, 1e3 * own.wall / points);
        };
        row("on one core", one);
        row("on all cores", all);
        row("on one core, two steps a point", short);
        println!(
            "\nefficiency on all cores: {:.0} %",
            100.0 * one.wall / (cores as f64 * all.wall)
        );
        if let (Some(one), Some(all)) = (one.processor, all.processor) {
            println!("processor time on one core ÷ on all cores: {:.0} %", 100.0 * one / all);
        }
        self.memory()?;
        self.python(cores, one, all)
    }

    /// A sweep on so many cores.
    fn sweep(&self, name: &str, jobs: usize) -> Result<Taken, Box<dyn Error>> {
        let jobs = jobs.to_string();
        self.timed(&["sweep", name, "--quiet", "--no-figures", "--out", "swept", "--jobs", &jobs])
    }

    /// A command in the folder.
    fn timed(&self, arguments: &[&str]) -> Result<Taken, Box<dyn Error>> {
        let start = Instant::now();
        // `times` says on its second line what the commands of a shell took.
        let output = Command::new("sh")
            .args(["-c", "\"$@\" && times", "sh"])
            .arg(&self.whirl)
            .args(arguments)
            .current_dir(&self.folder)
            .output()?;
        let wall = start.elapsed().as_secs_f64();
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
        }
        let text = String::from_utf8_lossy(&output.stdout);
        let line = text.lines().last().unwrap_or_default();
        let processor: Option<Vec<f64>> = line.split_whitespace().map(seconds).collect();
        Ok(Taken { wall, processor: processor.map(|all| all.iter().sum()) })
    }

    /// The largest memory of a sweep with a hundred times as many points of few steps, where /usr/bin/time tells it.
    fn memory(&self) -> Result<(), Box<dyn Error>> {
        let time = Path::new("/usr/bin/time");
        if !time.exists() {
            return Ok(());
        }
        let mass = "title = \"mass\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\nvelocity = \"1 m/s\"\n\
                    [[stop]]\nside = \"above\"\ngap = \"1 mm\"\nlaw = \"gap-linear-1e6\"\n\
                    [march]\ntime_step = \"1e-5 s\"\nsteps = 50\n";
        fs::write(self.folder.join("mass.toml"), mass)?;
        for [gaps, speeds] in [[10, 10], [100, 100]] {
            let study = format!(
                "case = \"mass.toml\"\n[vary]\nstop.1.gap = \"1 mm .. 2 mm, {gaps}\"\nmass.velocity = \"1 m/s .. 2 m/s, {speeds}\"\n"
            );
            fs::write(self.folder.join("many.toml"), study)?;
            let output = Command::new(time)
                .args(["-f", "%M"])
                .arg(&self.whirl)
                .args(["sweep", "many.toml", "--quiet", "--no-figures", "--out", "many"])
                .current_dir(&self.folder)
                .output()?;
            let text = String::from_utf8_lossy(&output.stderr);
            let kilobytes: f64 = text.lines().last().unwrap_or_default().trim().parse()?;
            println!("memory with {} points of a mass: {:.0} MB", gaps * speeds, kilobytes / 1e3);
        }
        Ok(())
    }

    /// The same points by the package, on threads and on a cluster of as many processes.
    fn python(&self, cores: usize, one: Taken, all: Taken) -> Result<(), Box<dyn Error>> {
        let python = env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
        let script = concat!(env!("CARGO_MANIFEST_DIR"), "/src/bin/sweeps/from_python.py");
        let numbers = [CLEARANCES, LOADS, STEPS, cores].map(|own| own.to_string());
        let output =
            Command::new(&python).arg(script).args(numbers).current_dir(&self.folder).output();
        let Ok(output) = output else {
            println!("from Python: there is no `{python}`");
            return Ok(());
        };
        if !output.status.success() {
            let text = String::from_utf8_lossy(&output.stderr);
            println!("from Python: {}", text.lines().last().unwrap_or("it failed"));
            return Ok(());
        }
        for line in String::from_utf8_lossy(&output.stdout).lines() {
            let Some((what, wall)) = line.split_once('\t') else { continue };
            let wall: f64 = wall.parse()?;
            if what == ALONE {
                println!("from Python, {what}: {:.1} ms of the processor a point", 1e3 * wall);
                continue;
            }
            let efficiency = 100.0 * one.wall / (cores as f64 * wall);
            println!(
                "from Python, {what}: {wall:.2} s, efficiency {efficiency:.0} %, {:.2} times the command's time",
                wall / all.wall
            );
        }
        Ok(())
    }
}

/// Clearances by loads.
fn study(clearances: usize, loads: usize, steps: usize) -> String {
    format!(
        "case = \"hu2003-5\"\n[vary]\nmarch.steps = [{steps}]\nsprings.radial_clearance = \"20 um .. 60 um, {clearances}\"\n\
         load.1.force = \"500 N .. 1500 N, {loads}\"\n"
    )
}

fn faster(before: Option<Taken>, now: Taken) -> Taken {
    before.filter(|before| before.wall < now.wall).unwrap_or(now)
}

/// Of `1m2.34s`.
fn seconds(text: &str) -> Option<f64> {
    let (minutes, seconds) = text.strip_suffix('s')?.split_once('m')?;
    Some(60.0 * minutes.parse::<f64>().ok()? + seconds.parse::<f64>().ok()?)
}
