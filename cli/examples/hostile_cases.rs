//! Any number of mutants of cases and meshes: `--inputs 1000000 --first 0`. Prints what panics or takes longer than
//! two seconds of work, the slowest input, and the most memory in use.

#[path = "../../tests/cli/mutants.rs"]
mod mutants;

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

use mutants::Random;
use whirl_solver::mesh::format::{self, ReadOptions};

/// An input that takes longer hangs.
const HANG: Duration = Duration::from_secs(2);

/// What this thread has worked, so that other work on the machine does not count, where the system tells.
fn worked(wall: Instant) -> Duration {
    let text = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let worked = text.split_whitespace().next().and_then(|nanoseconds| nanoseconds.parse().ok());
    worked.map_or_else(|| wall.elapsed(), Duration::from_nanos)
}

/// Most memory in use so far, where the system tells.
fn peak() -> String {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.map_or("unknown".to_owned(), |line| line.trim().to_owned())
}

fn main() -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |name: &str, otherwise: u64| match arguments.iter().position(|a| a == name) {
        Some(place) => arguments.get(place + 1).and_then(|n| n.parse().ok()).ok_or(name.to_owned()),
        None => Ok(otherwise),
    };
    let (first, inputs) = (number("--first", 0)?, number("--inputs", 10_000)?);
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folders = ["specs/cases", "tests/cli/messages"].map(|folder| root.join(folder));
    let cases = folders.iter().flat_map(|folder| mutants::cases(folder)).collect::<Vec<_>>();
    let (meshes, gmsh, bulk) = (mutants::meshes(), mutants::gmsh_meshes(), mutants::bulk_data());
    let elements: Vec<_> = whirl_specs::ELEMENTS.iter().collect();
    let folder = std::env::temp_dir().join(format!("whirl-hostile-{}", std::process::id()));
    fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
    let path = folder.join("case.toml");
    let name = path.to_string_lossy().into_owned();
    std::panic::set_hook(Box::new(|_| {}));
    let (mut wrong, mut accepted, mut slowest) = (0, [0_u64; 2], (Duration::ZERO, 0));
    for input in first..first + inputs {
        let random = &mut Random::new(input);
        // A case is a file, a mesh only its text: one in four is a case.
        let is_case = input % 4 == 0;
        let text = match is_case {
            true => mutants::case(random, &cases),
            false if input % 4 == 1 => mutants::gmsh_mesh(random, &gmsh),
            false if input % 4 == 2 => mutants::bulk(random, &bulk),
            false => mutants::mesh(random, &meshes),
        };
        let wall = Instant::now();
        let start = worked(wall);
        let outcome = catch_unwind(AssertUnwindSafe(|| match is_case {
            true => {
                fs::write(&path, &text).expect("the folder can be written");
                whirl_cli::examine(&name).is_ok()
            }
            false => {
                let options = ReadOptions::new(&elements);
                let read = format::read(text.clone().into_bytes(), "mesh.inp", &options);
                read.map_err(|errors| assert!(!errors.to_string().is_empty())).is_ok()
            }
        }));
        let time = worked(wall).saturating_sub(start);
        slowest = slowest.max((time, input));
        accepted[usize::from(is_case)] += u64::from(matches!(outcome, Ok(true)));
        if outcome.is_err() || time > HANG {
            wrong += 1;
            let what = if outcome.is_err() { "panics" } else { "is slow" };
            println!("input {input} {what} ({time:?}):\n{text}\n");
        }
    }
    let _ = fs::remove_dir_all(&folder);
    println!(
        "inputs {first} to {}: {} meshes and {} cases accepted, {wrong} panic or take longer than {HANG:?}, slowest \
         {:?} (input {}), peak memory {}",
        first + inputs - 1,
        accepted[0],
        accepted[1],
        slowest.0,
        slowest.1,
        peak()
    );
    if wrong > 0 { Err(format!("{wrong} inputs")) } else { Ok(()) }
}
