//! Cards of bulk data over several lines: continuations are found by their marks, wherever they stand.

use crate::open;

const NODES: &str = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n\
                     GRID,5,,0.,0.,1.\nGRID,6,,1.,0.,1.\nGRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\nPSOLID,1,1\nMAT1,1,2e11,,.3,7850.\n";

/// The cells of a deck, with its nodes moved so that they have their own places.
fn volume(text: &str) -> Result<f64, String> {
    let read = open(text.as_bytes(), "a.bdf").map_err(|errors| errors.to_string())?;
    let own = whirl_solver::assembly::mass_properties(&read.mesh);
    Ok(own.map_err(|error| error.to_string())?.volume)
}

/// The card of a cube whose second line has another place, with marks `name` and `mark`.
fn small(mark: &str) -> String {
    format!("CHEXA          1       1       1       2       3       4       5       6{mark:<8}\n")
}

#[test]
fn continuations_are_found_by_their_marks() {
    let rest = |name: &str| format!("{name:<8}       7       8\n");
    let more = "PARAM,POST,-1\n$ a comment\n";
    let wide = "CHEXA*                 1               1               1               2*A1     \n";
    let wide_rest =
        "*A1                    3               4               5               6*A2     \n";
    let last = "*A2                    7               8\n*\n";
    for (name, text) in [
        ("below", format!("{}{}", small("+C1"), rest("+C1"))),
        ("behind others", format!("{}{NODES}{}", small("+C1"), rest("+C1"))),
        ("before its card", format!("{}{}", rest("+C1"), small("+C1"))),
        ("in small letters", format!("{}{more}{}", small("+c1"), rest("+C1"))),
        ("the first column of a field is free", format!("{}{more}{}", small("XC1"), rest("+C1"))),
        ("without a sign", format!("{}{more}{}", small(" C1"), rest("+C1"))),
        ("wide", format!("{wide}{more}{wide_rest}{more}{last}")),
        ("wide, upside down", format!("{last}{more}{wide_rest}{more}{wide}")),
        ("free", format!("CHEXA,1,1,1,2,3,4,5,6,+C1\n{more}+C1,7,8\n")),
        ("free and small", format!("{}{more}+C1,7,8\n", small("+C1"))),
        (
            "by twos",
            format!(
                "CHEXA,1,1,1,2,3,4,5,6,+C1\nCHEXA,2,1,11,12,13,14,15,16,+C2\n+C2,17,18\n+C1,7,8\n{}",
                NODES.replace("GRID,", "GRID,1").replace("PSOLID,1,1\nMAT1,1,2e11,,.3,7850.\n", "")
            ),
        ),
    ] {
        let nodes = if text.contains("GRID,1,") { "" } else { NODES };
        let found = volume(&format!("BEGIN BULK\n{text}{nodes}"));
        let known = if name == "by twos" { 2.0 } else { 1.0 };
        let found = found.unwrap_or_else(|errors| panic!("{name}: {errors}"));
        assert!((found - known).abs() < 1e-12, "{name}: {found}");
    }
}

#[test]
fn marks_that_say_no_order_are_errors() {
    for (text, known) in [
        (
            "CHEXA,1,1,1,2,3,4,5,6,+C1\nPARAM,POST,-1\nCHEXA,2,1,1,2,3,4,5,6,+C1\nPARAM,POST,-1\n+C1,7,8\n",
            "a.bdf:15:1: the mark of this continuation is not the only one: line 11 has it, too\n  help: give each",
        ),
        (
            "CHEXA,1,1,1,2,3,4,5,6,+C1\nPARAM,POST,-1\n+C1,7,8\nPARAM,POST,-1\n+C1,7,8\n",
            "a.bdf:15:1: the mark of this continuation is not the only one: line 13 has it, too",
        ),
        (
            "CHEXA,1,1,1,2,3,4,5,6,+C1\n+C2,7,8\n",
            "a.bdf:12:1: this continuation is marked C2, but the line above asks for C1",
        ),
    ] {
        let found = volume(&format!("{NODES}{text}")).unwrap_err();
        assert!(found.contains(known), "{found}");
    }
    // Lines that ask for one another: nothing is read for ever.
    assert!(
        volume(&format!("{NODES}+A,1,2,3,4,5,6,7,8,+B\nPARAM,A,1\n+B,1,2,3,4,5,6,7,8,+A\n"))
            .is_err()
    );
}

#[test]
fn lines_that_repeat_others_are_refused() {
    let text = "GRID,1,,0.,0.,0.\n=,*1,=,*1.,==\nCTETRA,1,1,1,2,3,4\n";
    let found = volume(text).unwrap_err();
    let known = "a.bdf:2:1: a line that begins with = repeats the card above, which is not read\n  help: write";
    assert!(found.starts_with(known), "{found}");
}
