//! Mutants of cases: whatever a case says, its examination ends soon, in order or with diagnostics.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use whirl_cli::errors::Failure;

use crate::messages;
use crate::workbench::Workbench;

/// Mutants examined.
const MUTANTS: u64 = 3_000;
/// No mutant takes longer, beside other work on the same machine: a mesh of a million cells, the largest that
/// is made, takes seconds.
const LONGEST: Duration = Duration::from_secs(60);

/// Values and lines that a case does not expect.
const WORDS: &[&str] = &[
    "0",
    "-1",
    "1e308",
    "-0.0",
    "nan",
    "inf",
    "2.5",
    "true",
    "99999999999999999999",
    "1000000000",
    "9999",
    "\"\"",
    "\"x\"",
    "\"0 mm\"",
    "\"-1 mm\"",
    "\"1e300 m\"",
    "\"1e-300 m\"",
    "\"1e9 s\"",
    "\"1e-9 s\"",
    "\"nan mm\"",
    "\"4500 rpm\"",
    "\"1 N\"",
    "[]",
    "[[]]",
    "{}",
    "[1, 2]",
    "{ a = 1 }",
    "\"Nall\"",
    "[\"Nall\", \"Nall\", \"Nall\"]",
    "\"case.toml\"",
    "\"/dev/zero\"",
    "\".\"",
    "2026-11-21",
    "'''",
    "\"\\u0000\"",
    "ε",
    "[[load]]",
    "[shaft.dimensions]",
    "[mass]",
    "[[stop]]",
    "a.b.c = 1",
    "include = \"hu2003.machine.toml\"",
    "include = [\"case.toml\", \"case.toml\"]",
    "law = \"ocvirk\"",
    "motion = \"hu2003\"",
    "number = 9999",
    "side = \"around\"",
];

/// Sebastiano Vigna's SplitMix64.
struct Random(u64);

impl Random {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % count as u64) as usize
    }
}

fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    paths.sort();
    let cases = paths.iter().filter(|path| path.extension().is_some_and(|end| end == "toml"));
    cases.map(|path| fs::read_to_string(path).expect("a text")).collect()
}

/// A case with one to four changes.
fn mutant(random: &mut Random, corpus: &[String]) -> String {
    let pick = |random: &mut Random| corpus[random.below(corpus.len())].clone();
    let mut lines: Vec<String> = pick(random).lines().map(str::to_owned).collect();
    for _ in 0..1 + random.below(4) {
        let place = random.below(lines.len().max(1)).min(lines.len());
        let word = WORDS[random.below(WORDS.len())];
        match random.below(8) {
            0 if place < lines.len() => drop(lines.remove(place)),
            1 if place < lines.len() => {
                let line = lines[place].clone();
                lines.insert(random.below(lines.len()), line);
            }
            // Another value behind the same key.
            2..=4 => {
                if let Some((key, _)) = lines.get(place).and_then(|line| line.split_once('=')) {
                    lines[place] = format!("{key}= {word}");
                }
            }
            5 => lines.insert(place, word.to_owned()),
            6 if place < lines.len() => {
                let cut = random.below(lines[place].chars().count() + 1);
                lines[place] = lines[place].chars().take(cut).collect();
            }
            _ => {
                let other = pick(random);
                let other: Vec<&str> = other.lines().collect();
                let start = random.below(other.len().max(1)).min(other.len());
                let some = other[start..].iter().take(1 + random.below(6));
                lines.extend(some.map(|line| (*line).to_owned()));
            }
        }
    }
    lines.join("\n")
}

#[test]
fn mutants_of_cases_give_diagnostics_and_nothing_else() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/cases");
    let corpus = [files(&cases), files(&messages::folder())].concat();
    let bench = Workbench::new();
    let path = bench.path("case.toml");
    let name = path.to_str().expect("a path").to_owned();
    let mut refused = 0;
    for number in 0..MUTANTS {
        let text = mutant(&mut Random(number.wrapping_mul(0xd1b5_4a32_d192_ed03)), &corpus);
        fs::write(&path, &text).expect("written");
        let start = Instant::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| whirl_cli::examine(&name)));
        let outcome = outcome.unwrap_or_else(|_| panic!("mutant {number} panics:\n{text}"));
        assert!(start.elapsed() < LONGEST, "mutant {number}: {:?}\n{text}", start.elapsed());
        match outcome {
            Ok(()) => {}
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
