//! Files that an input file includes: `*INCLUDE, INPUT=…`, or `INPUT=` of a card whose data are in another file.

use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::super::foreign::{Foreign, foreign};
use super::super::raw::{LinePosition, MeshReport};
use super::super::text::decode;
use super::cards::{Token, parameter, tokens};
use super::piece::Piece;

/// Files that a mesh may be made of, one file counted as often as it is included.
const MOST_FILES: usize = 1000;

/// The lines of the last file of the report, with those of the files that it includes in their places.
pub(super) fn pieces(text: &str, path: &str, report: &mut MeshReport) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut open = vec![PathBuf::from(path)];
    let mut in_step = false;
    let file = report.files.len() - 1;
    add(file, text.into(), &mut open, &mut in_step, &mut pieces, report);
    pieces
}

fn add(
    file: usize,
    text: Rc<str>,
    open: &mut Vec<PathBuf>,
    in_step: &mut bool,
    pieces: &mut Vec<Piece>,
    report: &mut MeshReport,
) {
    let (mut from, mut first_line) = (0, 1);
    let (mut end, mut number) = (0, 0);
    let mut lines = text.split_inclusive('\n');
    while let Some(line) = lines.next() {
        let start = end;
        (end, number) = (end + line.len(), number + 1);
        let Some(keyword) = line.trim_start().strip_prefix('*') else { continue };
        let is = |name: &str| {
            let words = keyword.split(',').next().unwrap_or_default().trim();
            words.eq_ignore_ascii_case(name)
        };
        *in_step = (*in_step || is("STEP")) && !is("END STEP");
        let upper = keyword.to_ascii_uppercase();
        if *in_step || keyword.starts_with('*') || !(is("INCLUDE") || upper.contains("INPUT")) {
            continue;
        }
        let mut words = tokens(line, file, number);
        // A comma at the end: the parameters go on.
        let goes_on = words.last().is_some_and(|token| token.text.is_empty());
        if let Some(next) = goes_on.then(|| lines.next()).flatten() {
            (end, number) = (end + next.len(), number + 1);
            words.extend(tokens(next, file, number));
        }
        let place = words[0];
        let named = words.drain(1..).map(parameter).find(|parameter| parameter.name == "INPUT");
        let name = named.and_then(|named| named.value).filter(|name| !name.text.is_empty());
        let Some(name) = name else {
            if is("INCLUDE") {
                report.error(place, "*INCLUDE names no file", "write *INCLUDE, INPUT=nodes.inp");
            }
            continue;
        };
        let upto = if is("INCLUDE") { start } else { end };
        pieces.push(Piece { file, first_line, text: text.clone(), range: from..upto });
        (from, first_line) = (end, number + 1);
        include(name, open, in_step, pieces, report);
    }
    pieces.push(Piece { file, first_line, text: text.clone(), range: from..text.len() });
}

fn include(
    name: Token,
    open: &mut Vec<PathBuf>,
    in_step: &mut bool,
    pieces: &mut Vec<Piece>,
    report: &mut MeshReport,
) {
    let folder = open.last().and_then(|path| path.parent()).unwrap_or(Path::new(""));
    let path = folder.join(name.text);
    let shown = path.display().to_string();
    let same = |one: &Path| fs::canonicalize(one).ok() == fs::canonicalize(&path).ok();
    if !path.is_file() {
        let help = "paths are relative to the file that names them";
        report.error(name, format!("there is no file `{shown}`"), help);
    } else if open.iter().any(|file| same(file)) {
        let help = "take this line out";
        report.error(name, format!("`{shown}` would include itself"), help);
    } else if report.files.len() == MOST_FILES {
        let help = "do files include one file again and again?";
        report.error(name, format!("more than {MOST_FILES} files are included"), help);
    } else if report.files.len() < MOST_FILES {
        match fs::read(&path) {
            Ok(bytes) if foreign(&bytes, &shown).is_some() => {
                if let Some(Foreign { what, help }) = foreign(&bytes, &shown) {
                    report.error(name, format!("`{shown}` is {what}, which is not read"), help);
                }
            }
            Ok(bytes) => {
                report.files.push(shown);
                let file = report.files.len() - 1;
                open.push(path);
                add(file, decode(bytes).into(), open, in_step, pieces, report);
                open.pop();
            }
            Err(error) => {
                let at: LinePosition = name.into();
                report.error(
                    at,
                    format!("cannot read `{shown}`: {error}"),
                    "see that the file may be read",
                );
            }
        }
    }
}
