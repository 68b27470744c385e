//! Any number of hostile inputs: mutants of formulas and spec files, each measured.
//!
//! `cargo run --release -p whirl-codegen --example hostile -- --inputs 1000000 [--first N] [--seed N]
//! [--keep FOLDER]` prints what became of them and the peak memory; inputs that panic or take more than
//! two seconds are written to FOLDER. An input that runs on for a minute ends the program.

#[path = "../tests/hostile/bombs.rs"]
mod bombs;
#[path = "../tests/hostile/corpus.rs"]
mod corpus;
#[path = "../tests/hostile/injection.rs"]
mod injection;
#[path = "../tests/hostile/mutate.rs"]
mod mutate;
#[path = "../tests/hostile/random.rs"]
mod random;
#[path = "../tests/hostile/run.rs"]
mod run;
#[path = "../tests/hostile/target.rs"]
mod target;

use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use run::Input;

/// An input that takes longer hangs.
const HANG: Duration = Duration::from_secs(2);

/// Number of the input that is run, and for how many quarters of a second it has been.
static NUMBER: AtomicU64 = AtomicU64::new(0);

struct Asked {
    inputs: u64,
    first: u64,
    seed: u64,
    keep: PathBuf,
}

fn asked() -> Result<Asked, String> {
    let mut asked = Asked { inputs: 10_000, first: 0, seed: 1, keep: "hostile-findings".into() };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let value = arguments.next().ok_or_else(|| format!("{argument} needs a value"))?;
        let number =
            || value.parse::<u64>().map_err(|error| format!("{argument} {value}: {error}"));
        match argument.as_str() {
            "--inputs" => asked.inputs = number()?,
            "--first" => asked.first = number()?,
            "--seed" => asked.seed = number()?,
            "--keep" => asked.keep = value.into(),
            other => return Err(format!("unknown argument {other}")),
        }
    }
    Ok(asked)
}

/// Peak memory in MiB, where the system tells.
fn peak() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix(" kB")?.trim().parse().ok()?;
    Some(kib / 1024.0)
}

fn keep(asked: &Asked, input: &Input, why: &str, number: u64) {
    let kind = if input.is_formula { "formula" } else { "spec" };
    let path = asked.keep.join(format!("{kind}-{why}-{}-{number}", asked.seed));
    let written = fs::create_dir_all(&asked.keep).and_then(|()| fs::write(&path, &input.text));
    match written {
        Ok(()) => println!("kept {}", path.display()),
        Err(error) => eprintln!("{}: {error}", path.display()),
    }
}

/// Ends the program when one input runs on.
fn watch(seed: u64) {
    std::thread::spawn(move || {
        let (mut last, mut seconds) = (u64::MAX, 0);
        loop {
            std::thread::sleep(Duration::from_secs(1));
            let number = NUMBER.load(Ordering::Relaxed);
            seconds = if number == last { seconds + 1 } else { 0 };
            last = number;
            if seconds >= 60 {
                eprintln!("input {number} of seed {seed} runs on");
                std::process::exit(1);
            }
        }
    });
}

fn main() -> Result<(), String> {
    let asked = asked()?;
    let corpus = corpus::Corpus::read();
    let vocabulary = injection::Vocabulary::shared();
    std::panic::set_hook(Box::new(|_| {}));
    watch(asked.seed);
    let (mut accepted, mut panics, mut hangs) = ([0_u64; 2], 0_u64, 0_u64);
    let mut slowest = (Duration::ZERO, 0);
    let bombs = if asked.first == 0 { bombs::all() } else { Vec::new() };
    let refused = bombs::refused().into_iter().map(|(text, _)| text);
    for (place, text) in bombs.into_iter().chain(refused).enumerate() {
        let input = Input { is_formula: false, text };
        let outcome = run::run(&input, vocabulary);
        if outcome.panic.is_some() || outcome.time > HANG {
            println!("bomb {place}: {:?} {:?}", outcome.time, outcome.panic);
            keep(&asked, &input, "bomb", place as u64);
        }
    }
    let start = Instant::now();
    for number in asked.first..asked.first + asked.inputs {
        NUMBER.store(number, Ordering::Relaxed);
        let input = run::input(&corpus, asked.seed, number);
        let outcome = run::run(&input, vocabulary);
        accepted[usize::from(input.is_formula)] += u64::from(outcome.accepted);
        slowest = slowest.max((outcome.time, number));
        if let Some(message) = &outcome.panic {
            panics += 1;
            let message: String = message.chars().take(300).collect();
            println!("input {number}: {message}");
            keep(&asked, &input, "panic", number);
        } else if outcome.time > HANG {
            hangs += 1;
            println!("input {number}: {:?}", outcome.time);
            keep(&asked, &input, "slow", number);
        }
    }
    let memory = peak().map_or("unknown".to_owned(), |peak| format!("{peak:.0} MiB"));
    println!(
        "seed {}, inputs {} to {}: {} formulas and {} specs accepted, {panics} panics, {hangs} over {HANG:?}, \
         slowest {:?} (input {}), peak memory {memory}, {:.0} s",
        asked.seed,
        asked.first,
        asked.first + asked.inputs - 1,
        accepted[1],
        accepted[0],
        slowest.0,
        slowest.1,
        start.elapsed().as_secs_f64()
    );
    if panics + hangs > 0 { Err(format!("{panics} panics, {hangs} hangs")) } else { Ok(()) }
}
