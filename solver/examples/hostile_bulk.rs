//! Any number of files of bulk data with one damaged field: `--inputs 1000000 --first 0`. Prints what panics or takes
//! longer than a second, and how many were accepted.

#[path = "../../tests/verification/bulk_data/damage.rs"]
mod damage;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use whirl_solver::mesh::format::{self, ReadOptions};

fn main() -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |name: &str, otherwise: u64| match arguments.iter().position(|a| a == name) {
        Some(place) => arguments.get(place + 1).and_then(|n| n.parse().ok()).ok_or(name.to_owned()),
        None => Ok(otherwise),
    };
    let (first, inputs) = (number("--first", 0)?, number("--inputs", 10_000)?);
    let elements: Vec<_> = whirl_specs::ELEMENTS.iter().collect();
    std::panic::set_hook(Box::new(|_| {}));
    let (mut wrong, mut accepted, mut slowest) = (0, 0, Duration::ZERO);
    for input in first..first + inputs {
        let text = damage::file(input);
        let options = ReadOptions { open: input % 2 == 0, ..ReadOptions::new(&elements) };
        let start = Instant::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| {
            let read = format::read(text.clone().into_bytes(), "mesh.bdf", &options);
            read.map_err(|errors| assert!(!errors.to_string().is_empty())).is_ok()
        }));
        let time = start.elapsed();
        slowest = slowest.max(time);
        accepted += u64::from(matches!(outcome, Ok(true)));
        if outcome.is_err() || time > Duration::from_secs(1) {
            wrong += 1;
            let what = if outcome.is_err() { "panics" } else { "is slow" };
            println!("input {input} {what} ({time:?}):\n{text}");
        }
    }
    println!(
        "inputs {first} to {}, cards {}: {accepted} accepted, {wrong} panic or are slow, slowest {slowest:?}",
        first + inputs - 1,
        damage::cards().join(", ")
    );
    if wrong > 0 { Err(format!("{wrong} inputs")) } else { Ok(()) }
}
