//! report.html: one page that tells of what is in a folder of results. It needs no network and no other file.
//!
//! The page is a function of that folder: about.json tells what the case is, summary.json what the run came to, history.csv
//! has the rows; analyses.json tells of analyses and sweep.json of a sweep, whose tables and
//! figures are beside them. The numbers are embedded in it, and a script of its own draws them as SVG, so that they can be zoomed,
//! printed, and read back by tests.

mod about;
mod along;
mod analyses;
mod bodies;
mod contacts;
mod encode;
mod files;
mod film_maps;
mod groups;
mod kept;
mod marks;
mod moving;
mod orbits;
mod over_speed;
mod run;
mod shapes;
mod spectra;
mod sweeps;
mod teeth;
mod turned;

use std::path::Path;
use std::{fs, io};

use serde::Serialize;
use serde_json::Value;

pub(crate) use self::about::{About, Section};
pub(crate) use self::analyses::{Analyses, AnalysisFacts};
use self::files::{FigureFacts, FileFacts, MotionFacts, TableFacts};
pub(crate) use self::film_maps::FilmMaps;
pub(crate) use self::moving::{MOTIONS, Moving};
use self::run::RunData;
pub(crate) use self::shapes::Shapes;
pub(crate) use self::sweeps::SweepFacts;
use crate::history::{self, HistoryFile};
use crate::results::{ABOUT, ANALYSES, FILMS, SHAPES, SUMMARY, SWEEP};

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// In the order in which they are run.
const SCRIPTS: [&str; 14] = [
    include_str!("data.js"),
    include_str!("units.js"),
    include_str!("map.js"),
    include_str!("chart.js"),
    include_str!("marks.js"),
    include_str!("scene.js"),
    include_str!("stage.js"),
    include_str!("lateral.js"),
    include_str!("facts.js"),
    include_str!("run.js"),
    include_str!("films.js"),
    include_str!("analyses.js"),
    include_str!("response.js"),
    include_str!("page.js"),
];

/// What is embedded.
#[derive(Serialize)]
struct Data {
    /// Of a run.
    about: Option<About>,
    /// summary.json, as it is.
    summary: Option<Value>,
    run: Option<RunData>,
    /// shapes.json, as it is.
    shapes: Option<Value>,
    /// films.json, as it is.
    films: Option<Value>,
    analyses: Option<Analyses>,
    sweep: Option<SweepFacts>,
    tables: Vec<TableFacts>,
    motions: Vec<MotionFacts>,
    figures: Vec<FigureFacts>,
    files: Vec<FileFacts>,
}

/// The page of a folder of results; why there is none.
pub(crate) fn made(folder: &Path) -> Result<String, String> {
    page(folder, true)
}

/// The same without its files, which are not kept beside it.
pub(crate) fn made_alone(folder: &Path) -> Result<String, String> {
    page(folder, false)
}

fn page(folder: &Path, is_kept: bool) -> Result<String, String> {
    let cannot = |name: &str, why: &dyn std::fmt::Display| {
        format!("cannot read `{}`: {why}", folder.join(name).display())
    };
    let read = |name: &str| match fs::read_to_string(folder.join(name)) {
        Ok(text) => Ok(Some(text)),
        Err(why) if why.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(why) => Err(cannot(name, &why)),
    };
    let about = read(ABOUT)?.map(|text| About::read(&text)).transpose();
    let about = about.map_err(|why| cannot(ABOUT, &why))?;
    let analyses = read(ANALYSES)?.map(|text| Analyses::read(&text)).transpose();
    let analyses = analyses.map_err(|why| cannot(ANALYSES, &why))?;
    let sweep = read(SWEEP)?.map(|text| SweepFacts::read(&text)).transpose();
    let sweep = sweep.map_err(|why| cannot(SWEEP, &why))?;
    let json = |name: &str| -> Result<Option<Value>, String> {
        let text = read(name)?.filter(|_| about.is_some());
        let own = text.map(|text| serde_json::from_str(&text)).transpose();
        own.map_err(|why| cannot(name, &why))
    };
    let (summary, shapes, films) = (json(SUMMARY)?, json(SHAPES)?, json(FILMS)?);
    let path = folder.join(history::NAME);
    let run = match &about {
        Some(about) if path.exists() => HistoryFile::open(&path)
            .and_then(|rows| RunData::of(about, &rows))
            .map_err(|why| cannot(history::NAME, &why))?,
        _ => None,
    };
    let of_run = about.as_ref().map(|own| (&own.name, &own.title));
    let of_analyses = analyses.as_ref().map(|own| (&own.name, &own.title));
    let of_sweep = sweep.as_ref().map(|own| (&own.name, &own.title));
    let (name, title) = of_run.or(of_analyses).or(of_sweep).ok_or_else(|| {
        format!(
            "`{}` has neither `{ABOUT}` nor `{ANALYSES}` nor `{SWEEP}`, of which a report is made",
            folder.display()
        )
    })?;
    let title = if title.is_empty() { name.clone() } else { format!("{name}: {title}") };
    let (mut files, figures) =
        files::all(folder, analyses.as_ref()).map_err(|why| cannot("", &why))?;
    files.retain(|_| is_kept);
    let of_analyses = analyses.iter().flat_map(Analyses::files);
    let tables = files::tables(folder, of_analyses.chain(sweep.as_ref().map(|_| "table.csv")));
    let of_analyses = analyses.iter().flat_map(Analyses::files);
    let motions = files::motions(folder, of_analyses)?;
    let data = Data {
        about,
        summary,
        run,
        shapes,
        films,
        analyses,
        sweep,
        tables,
        motions,
        figures,
        files,
    };
    let data = serde_json::to_string(&data).expect("the keys are strings");
    // No text of a case ends the element, or is markup.
    Ok(filled(&title, &data.replace('<', "\\u003c")))
}

fn filled(title: &str, data: &str) -> String {
    let title = title.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    let script = format!("(() => {{\n'use strict';\n{}}})();", SCRIPTS.concat());
    let parts = [("style", STYLE), ("title", &title), ("data", data), ("script", &script)];
    let mut page = String::with_capacity(PAGE.len() + data.len() + STYLE.len() + script.len());
    for piece in PAGE.split("{{") {
        let part = parts
            .iter()
            .find_map(|(name, text)| Some((*text, piece.strip_prefix(name)?.strip_prefix("}}")?)));
        let (text, rest) = part.unwrap_or(("", piece));
        page.push_str(text);
        page.push_str(rest);
    }
    page
}
