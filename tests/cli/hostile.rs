//! Mutants of cases and meshes: whatever they say, their examination ends soon, in order or with diagnostics.
//! `cargo run --release -p whirl-cli --example hostile_cases` does the same with any number of inputs.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

use whirl_cli::errors::Failure;
use whirl_solver::mesh::format::{self, ReadOptions};

use crate::workbench::Workbench;
use crate::{messages, mutants, mutants::Random};

/// Mutants examined.
const MUTANTS: u64 = 3_000;
/// No mutant takes longer, beside other work on the same machine: a mesh of a million cells, the largest that
/// is made, takes seconds.
const LONGEST: Duration = Duration::from_secs(60);

#[test]
fn mutants_of_cases_give_diagnostics_and_nothing_else() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/cases");
    let corpus = [mutants::cases(&cases), mutants::cases(&messages::folder())].concat();
    let bench = Workbench::new();
    let path = bench.path("case.toml");
    let name = path.to_str().expect("a path").to_owned();
    let mut refused = 0;
    for number in 0..MUTANTS {
        let text = mutants::case(&mut Random::new(number), &corpus);
        fs::write(&path, &text).expect("written");
        let start = Instant::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| whirl_cli::examine(&name)));
        let outcome = outcome.unwrap_or_else(|_| panic!("mutant {number} panics:\n{text}"));
        assert!(start.elapsed() < LONGEST, "mutant {number}: {:?}\n{text}", start.elapsed());
        match outcome {
            Ok(_) => {}
            Err(Failure::Input(errors)) => {
                assert!(!errors.is_empty());
                refused += 1;
            }
            Err(other) => panic!("mutant {number} without a place: {other}\n{text}"),
        }
    }
    // Most changes are mistakes, and some are none.
    assert!(refused > MUTANTS / 2 && refused < MUTANTS, "{refused} of {MUTANTS}");
}

#[test]
fn mutants_of_meshes_give_diagnostics_and_nothing_else() {
    let (corpus, gmsh, bulk) = (mutants::meshes(), mutants::gmsh_meshes(), mutants::bulk_data());
    let elements: Vec<_> = whirl_specs::ELEMENTS.iter().collect();
    let options = ReadOptions::new(&elements);
    let mut refused = 0;
    for number in 0..10 * MUTANTS {
        let random = &mut Random::new(number);
        let text = match number % 3 {
            0 => mutants::mesh(random, &corpus),
            1 => mutants::gmsh_mesh(random, &gmsh),
            _ => mutants::bulk(random, &bulk),
        };
        let options = ReadOptions { open: number % 3 == 1, ..options };
        let start = Instant::now();
        let read = || format::read(text.clone().into_bytes(), "mesh.inp", &options);
        let outcome = catch_unwind(AssertUnwindSafe(read));
        let outcome = outcome.unwrap_or_else(|_| panic!("mutant {number} panics:\n{text}"));
        assert!(start.elapsed() < LONGEST, "mutant {number}: {:?}\n{text}", start.elapsed());
        if let Err(errors) = outcome {
            assert!(!errors.to_string().is_empty());
            refused += 1;
        }
    }
    assert!(refused > 3 * MUTANTS && refused < 10 * MUTANTS, "{refused} of {}", 10 * MUTANTS);
}
