//! The files of a folder of results: what each is, and drawings that a page shows.

use std::io;
use std::path::Path;
use std::{fs, str};

use serde::Serialize;
use serde_json::Value;

use super::about::LAYOUT;
use super::analyses::Analyses;
use super::encode::base64;
use super::moving::MOTIONS;
use crate::history;
use crate::results::{ABOUT, ANALYSES, FILMS, REPORT, SHAPES, STATE, SUMMARY, SWEEP};

/// Figures of runs that a page draws itself.
const DRAWN: [&str; 10] = [
    "orders-over-speed",
    "envelope-over-speed",
    "reactions",
    "eccentricity",
    "eccentricity-stretched",
    "rotation",
    "displacement",
    "film",
    "spectrum",
    "waterfall",
];
/// Bytes of all drawings of a page, at most.
const MOST: usize = 6 << 20;

/// A file.
#[derive(Debug, Serialize)]
pub(super) struct FileFacts {
    name: String,
    bytes: u64,
    what: String,
}

/// A drawing.
#[derive(Debug, Serialize)]
pub(super) struct FigureFacts {
    name: String,
    title: String,
    /// SVG.
    base64: String,
}

/// A table.
#[derive(Debug, Serialize)]
pub(super) struct TableFacts {
    name: String,
    /// As the file has it.
    csv: String,
}

/// Motions of an analysis in space.
#[derive(Debug, Serialize)]
pub(super) struct MotionFacts {
    name: String,
    /// As the file has it.
    content: Value,
}

/// Bytes of motions of all analyses, at most.
const MOTION: u64 = 6 << 20;

/// Motions among some files that are there and have room.
///
/// # Errors
/// A file is none of this version.
pub(super) fn motions<'a>(
    folder: &Path,
    names: impl Iterator<Item = &'a str>,
) -> Result<Vec<MotionFacts>, String> {
    let mut whole = 0;
    let mut all: Vec<MotionFacts> = Vec::new();
    for name in names.filter(|name| name.ends_with(MOTIONS)) {
        let path = folder.join(name);
        let Ok(facts) = fs::metadata(&path) else { continue };
        whole += facts.len();
        if whole > MOTION {
            break;
        }
        let cannot =
            |why: &dyn std::fmt::Display| format!("cannot read `{}`: {why}", path.display());
        let text = fs::read_to_string(&path).map_err(|why| cannot(&why))?;
        let mut content: Value = serde_json::from_str(&text).map_err(|why| cannot(&why))?;
        if content["layout"] != LAYOUT {
            return Err(cannot(&"it is of another version of the program: analyse the case again"));
        }
        // Surfaces that are those of an earlier file stand there.
        let earlier = all.iter().find(|own| own.content["shapes"] == content["shapes"]);
        if let Some(MotionFacts { name, .. }) = earlier {
            content["shapes"] = Value::String(name.clone());
        }
        all.push(MotionFacts { name: name.to_owned(), content });
    }
    Ok(all)
}

/// Bytes of a table, and of all, at most.
const TABLE: usize = 2 << 20;
const TABLES: usize = 4 << 20;

/// The tables among some files that are there and have room.
pub(super) fn tables<'a>(folder: &Path, names: impl Iterator<Item = &'a str>) -> Vec<TableFacts> {
    let mut whole = 0;
    let read = |name: &str| {
        let csv = fs::read_to_string(folder.join(name)).ok()?;
        let csv = if csv.len() > EXACT { rounded(&csv) } else { csv };
        let has_room = csv.len() <= TABLE && whole + csv.len() <= TABLES;
        whole += if has_room { csv.len() } else { 0 };
        has_room.then(|| TableFacts { name: name.to_owned(), csv })
    };
    names.filter(|name| name.ends_with(".csv")).filter_map(read).collect()
}

/// Bytes up to which a table is as it is, and digits of the numbers of larger ones.
const EXACT: usize = 1 << 18;
const DIGITS: usize = 7;

/// A table with its numbers to so many digits, in as few letters as they take.
fn rounded(csv: &str) -> String {
    let shorter = |cell: &str| -> Option<String> {
        let value: f64 = (cell.len() > DIGITS).then(|| cell.parse().ok()).flatten()?;
        let value = whirl_text::rounded(value, DIGITS);
        let [plain, power] = [value.to_string(), format!("{value:e}")];
        Some(if power.len() < plain.len() { power } else { plain })
    };
    let line = |line: &str| -> String {
        // What is quoted may have commas of its own.
        let cells = line.split(',').map(|own| shorter(own).unwrap_or_else(|| own.to_owned()));
        cells.collect::<Vec<_>>().join(",")
    };
    csv.lines().map(|own| line(own) + "\n").collect()
}

/// All of both, by name. Files that the program does not write are not told of.
///
/// # Errors
/// The folder cannot be read.
pub(super) fn all(
    folder: &Path,
    analyses: Option<&Analyses>,
) -> io::Result<(Vec<FileFacts>, Vec<FigureFacts>)> {
    let mut names: Vec<String> = fs::read_dir(folder)?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| !name.starts_with('.') && name != REPORT)
        .collect();
    names.sort_unstable();
    let is_run = names.iter().any(|name| name == ABOUT);
    let (mut files, mut figures, mut drawn) = (Vec::new(), Vec::new(), 0);
    for name in names {
        let path = folder.join(&name);
        let Ok(facts) = fs::metadata(&path) else { continue };
        let Some(what) = what(&name, analyses) else { continue };
        if !facts.is_file() {
            continue;
        }
        let stem = name.strip_suffix(".svg").filter(|stem| !(is_run && DRAWN.contains(stem)));
        if let (Some(_), Ok(svg)) = (stem, fs::read(&path))
            && drawn + svg.len() <= MOST
        {
            drawn += svg.len();
            let base64 = base64(svg.iter().copied());
            figures.push(FigureFacts { title: title(&svg, &name), name: name.clone(), base64 });
        }
        files.push(FileFacts { name, bytes: facts.len(), what });
    }
    Ok((files, figures))
}

/// What a file is, by its name; none of one that is not of the program.
fn what(name: &str, analyses: Option<&Analyses>) -> Option<String> {
    if let Some(copy) = history::FORMATS.iter().find(|own| own.name == name) {
        return Some(copy.meaning.to_owned());
    }
    let own = match name {
        history::NAME => "the history: a row a time, a column a quantity, ten digits",
        SUMMARY => {
            "the summary: verdict, extremes and means of the last cycle, orders, energy, times"
        }
        ABOUT => {
            "the case in words, and what the columns are: from it `whirl report` makes this page again"
        }
        SHAPES => "surfaces of the bodies, and how they move, for this page",
        FILMS => "oil films on their bores in the frames of the run, for this page",
        SWEEP => "what varies in the sweep",
        "table.csv" => "the table: a row a point",
        "table.parquet" => "the same, for programs that read many rows",
        "sweep.journal" => "what is done, from which the sweep can be resumed",
        _ if name.ends_with(MOTIONS) => {
            "surfaces of the bodies with modes or orbits, for this page"
        }
        ANALYSES => "what the analyses came to, in words",
        STATE => "the state at the end, from which another run can start",
        _ => match name.rsplit_once('.')?.1 {
            "svg" => "a figure",
            "png" => "the same figure as an image",
            "csv" => return Some(of_table(name, analyses)),
            "parquet" => "the table for programs that read columns",
            "mat" => "the table for MATLAB",
            _ => return None,
        },
    };
    Some(own.to_owned())
}

/// Tables of coefficients that are of all joints.
const OF_ALL: [&str; 2] = ["through", "5x5"];

/// What tables of analyses have, by what follows the name of the analysis.
const TABLES_OF: [(&str, &str); 15] = [
    ("critical", "critical speeds, and where modes begin or end to grow"),
    (
        "through",
        "stiffness and damping of bearings with bodies of their own, as seen by their shafts",
    ),
    ("thresholds", "speeds at which modes begin or end to grow"),
    ("peaks", "peaks of the response, with their amplification"),
    ("near", "the response beside its peaks"),
    ("probes", "what probes read, over the speed"),
    ("response", "the response to each unbalance, over the speed"),
    ("stability", "the least damped forward mode over cross-coupled stiffness"),
    ("unbalance", "the unbalances that were used"),
    ("modes", "shapes of the modes"),
    ("interference", "where excitations meet modes"),
    ("torques", "what couplings and gears carry"),
    ("multipliers", "multipliers of the motion"),
    ("names", "what rows and columns of the matrices are"),
    ("events", "where something changes on a branch"),
];

fn of_table(name: &str, analyses: Option<&Analyses>) -> String {
    let stem = name.strip_suffix(".csv").unwrap_or(name);
    let kind = |own: &str| analyses.and_then(|all| all.kind_of(own));
    match stem.split_once('.') {
        None => format!("the main table of the analysis `{stem}`"),
        // Joints may have any name.
        Some((of, joint)) if kind(of) == Some("coefficients") && !OF_ALL.contains(&joint) => {
            format!(
                "stiffness and damping of the joint `{joint}` over the speed, as a bushing reads them"
            )
        }
        Some((of, what)) => match TABLES_OF.iter().find(|own| own.0 == what) {
            Some((_, words)) => format!("{words}, of `{of}`"),
            None => format!("the part `{what}` of the analysis `{of}`, as a table"),
        },
    }
}

/// The first words of a drawing, or its name.
fn title(svg: &[u8], name: &str) -> String {
    let text = str::from_utf8(svg).unwrap_or_default();
    let words = text.split_once("<text").and_then(|(_, rest)| rest.split_once('>'));
    let words = words.and_then(|(_, rest)| rest.split_once('<')).map(|own| own.0);
    words.filter(|own| !own.is_empty()).unwrap_or(name).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_large_tables_are_short() {
        let csv = "speed_rpm,what,x_um\n4500,critical speed,0.000013750423\n123456.789012,\"a, b\",-12.5\n";
        let short =
            "speed_rpm,what,x_um\n4500,critical speed,1.375042e-5\n123456.8,\"a, b\",-12.5\n";
        assert_eq!(rounded(csv), short);
    }
}
