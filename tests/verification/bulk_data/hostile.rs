//! Files that are nearly right: damage is read or refused, never a panic, and not slowly.

use std::time::{Duration, Instant};

use proptest::prelude::*;

use whirl_solver::mesh::format::{self, ReadOptions};
use whirl_specs::{ELEMENTS, Element};

use super::{GOOD, damage, read};

/// What a file does not expect.
const PIECES: &[&str] = &[
    "",
    " ",
    "\t",
    ",",
    "*",
    "+",
    "$",
    "0",
    "-1",
    "1",
    "8",
    "99999999999999999999",
    "18446744073709551615",
    "1.+999",
    "nan",
    "1.5-3",
    "THRU",
    "EXCEPT",
    "BY",
    "GRID",
    "GRID*",
    "GRDSET,,7",
    "CORD2C,7,8,0.,0.,0.,0.,0.,1.,1.,0.,0.",
    "CORD1R,7,1,2,3,8,4,5,6",
    "CHEXA",
    "CTETRA,9,1,1,2,3,5",
    "RBE2,17,1,123,1,THRU,18446744073709551615",
    "RBE3,1,,2,123,1.,123,1,UM",
    "CONM2,3,1,-1,1.",
    "MAT1,1,1.,1.,.3",
    "PSOLID,1,1",
    "SET 5 = 1 THRU 9 BY 0",
    "INCLUDE 'x",
    "INCLUDE cube.bdf",
    "BEGIN BULK",
    "BEGIN SUPER=1",
    "ENDDATA",
    "$HMNAME PROP 1\"",
    "$HMMOVE 1",
    "$ 1THRU9",
    "é",
    "\0",
    "\u{feff}",
    "\r",
    "\n",
];

proptest! {
    #[test]
    fn damaged_files_never_panic(
        cuts in prop::collection::vec((0..GOOD.len(), 0..12usize, 0..PIECES.len(), any::<bool>()), 1..6),
    ) {
        let mut text = GOOD.to_owned();
        for (at, length, piece, whole_line) in cuts {
            let floor = |i: usize| (0..=i.min(text.len())).rev().find(|&i| text.is_char_boundary(i));
            let (mut from, mut to) = (floor(at).unwrap_or(0), floor(at + length).unwrap_or(0));
            let mut by = PIECES[piece].to_owned();
            if whole_line {
                from = text[..from].rfind('\n').map_or(0, |end| end + 1);
                to = from;
                by.push('\n');
            }
            text.replace_range(from..to, &by);
        }
        if let Err(errors) = read(&text) {
            prop_assert!(!errors.0.is_empty());
            prop_assert!(errors.0.iter().all(|error| !error.what.is_empty()));
        }
    }

    /// Cut anywhere, a file is read as far as it goes or refused.
    #[test]
    fn truncated_files_never_panic(end in 0..GOOD.len()) {
        drop(read(&GOOD[..end]));
    }
}

/// One field of any card damaged: every file is read, or refused with words. The example `hostile_bulk` of the solver
/// goes over a million.
#[test]
fn single_damaged_fields_never_panic() {
    let elements: Vec<&'static Element> = ELEMENTS.iter().collect();
    let mut accepted = 0;
    for seed in 0..20_000 {
        let options = ReadOptions { open: seed % 2 == 0, ..ReadOptions::new(&elements) };
        match format::read(damage::file(seed).into_bytes(), "mesh.bdf", &options) {
            Ok(_) => accepted += 1,
            Err(errors) => assert!(!errors.to_string().is_empty(), "{seed}"),
        }
    }
    assert_eq!(damage::cards().len(), 34);
    // Many fields do not matter to a mesh; were all files refused, nothing would be tried behind the cards.
    assert!((2_000..15_000).contains(&accepted), "{accepted}");
}

/// What would take the square of its length is read in time.
#[test]
fn long_files_of_one_kind_are_read_in_time() {
    let many = 20_000;
    let lines = |line: &dyn Fn(u64) -> String| (1..=many).map(line).collect::<String>();
    let chain = lines(&|k| format!("CORD2R,{k},{},0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n", (k + 1) % many));
    let circle = lines(&|k| format!("CORD2R,{k},{},0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n", k % many + 1));
    let wide = format!("RBE2,9999999,1,123{}", ",1,THRU,9\n,1,THRU,8,2,THRU,3".repeat(20_000));
    let spiders = lines(&|k| format!("RBE2,{},20,123,1,2,3\n", 1000 + k));
    let unknown = lines(&|k| format!("GRIX{k},1\n"));
    let doubled = lines(&|_| "GRID,1,,0.,0.,0.\n".to_owned());
    let sets = format!("SET 9 = {}\n", "1 THRU 9 EXCEPT 2 THRU 7,".repeat(20_000));
    let removed = lines(&|k| format!("$HMMOVE {k}\n$ {k}THRU {}\n", k + 1));
    for own in [chain, circle, wide, spiders, unknown, doubled, removed] {
        let start = Instant::now();
        drop(read(&GOOD.replace("ENDDATA", &own)));
        assert!(start.elapsed() < Duration::from_secs(20), "{}", &own[..60]);
    }
    drop(read(&GOOD.replace("BEGIN", &format!("{sets}BEGIN"))));
}
