//! What analyses came to, for a page: analyses.json, written beside their files and added to by each command.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::about::{LAYOUT, Section};
use crate::case::{Analysis, Case};
use crate::results::ANALYSES;
use crate::version;

/// An analysis that was done.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct AnalysisFacts {
    name: String,
    kind: String,
    /// What it is called on a page.
    heading: String,
    /// As on the terminal.
    text: String,
    files: Vec<String>,
    /// Whether it was ended before all was done.
    interrupted: bool,
    /// Whether it came to nothing, the text being why.
    #[serde(default)]
    failed: bool,
    /// The body whose speed it is over.
    #[serde(default)]
    of: Option<String>,
    /// Speeds (rpm) of that body between which the run of the case goes.
    #[serde(default)]
    run_rpm: Vec<f64>,
}

/// All analyses of a folder, of one case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Analyses {
    layout: u32,
    version: String,
    pub(super) name: String,
    pub(super) title: String,
    source: String,
    words: Vec<Section>,
    analyses: Vec<AnalysisFacts>,
}

impl AnalysisFacts {
    /// Of an analysis that came to nothing, and why.
    pub(crate) fn failed(own: &Analysis, why: &str) -> Self {
        let speeds = (None, Vec::new());
        AnalysisFacts { failed: true, ..AnalysisFacts::new(own, why, Vec::new(), false, speeds) }
    }

    /// Of an analysis, what it printed, the names of its files, whether it was interrupted, the body whose speed it is over and the
    /// speeds (rpm) of that in the run of the case.
    pub(crate) fn new(
        own: &Analysis,
        text: &str,
        files: Vec<String>,
        interrupted: bool,
        (of, run_rpm): (Option<String>, Vec<f64>),
    ) -> Self {
        AnalysisFacts {
            name: own.name.clone(),
            kind: own.kind.word().to_owned(),
            heading: own.kind.heading().to_owned(),
            text: text.to_owned(),
            files,
            interrupted,
            failed: false,
            of,
            run_rpm,
        }
    }

    /// Its name.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }
}

impl Analyses {
    /// The kind of an analysis by its name.
    pub(super) fn kind_of(&self, name: &str) -> Option<&str> {
        let own = self.analyses.iter().find(|own| own.name == name);
        own.map(|own| own.kind.as_str())
    }

    /// Those that a folder has; none where nothing was analysed there, or by another version of the program.
    pub(crate) fn of(folder: &Path) -> Option<Self> {
        let text = fs::read_to_string(folder.join(ANALYSES)).ok()?;
        Analyses::read(&text).ok()
    }

    /// Files of one of them.
    pub(crate) fn files_of(&self, name: &str) -> &[String] {
        let own = self.analyses.iter().find(|own| own.name == name);
        own.map_or(&[], |own| &own.files)
    }

    /// Those that were done now, in the place of or behind those of the same case that the folder has.
    pub(crate) fn with(
        folder: &Path,
        case: &Case,
        words: Vec<Section>,
        done: Vec<AnalysisFacts>,
    ) -> Self {
        let mut all = Analyses {
            layout: LAYOUT,
            version: version::PACKAGE.to_owned(),
            name: case.name.clone(),
            title: case.title.clone(),
            source: case.origin.clone(),
            words,
            analyses: Vec::new(),
        };
        let before = Analyses::of(folder);
        // What was found of another state of the case would stand beside what is found now as if it were of the same.
        if let Some(before) =
            before.filter(|own| (&own.name, &own.words) == (&all.name, &all.words))
        {
            all.analyses = before.analyses;
        }
        for own in done {
            match all.analyses.iter_mut().find(|other| other.name == own.name) {
                Some(other) => *other = own,
                None => all.analyses.push(own),
            }
        }
        all
    }

    /// The text of the file.
    pub(crate) fn json(&self) -> String {
        serde_json::to_string_pretty(self).expect("the keys are strings") + "\n"
    }

    /// Of the text of a file; why it is none.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let own: serde_json::Value = serde_json::from_str(text).map_err(|why| why.to_string())?;
        if own["layout"] != LAYOUT {
            return Err(
                "it is of another version of the program: analyse the case again".to_owned()
            );
        }
        serde_json::from_value(own).map_err(|why| why.to_string())
    }

    /// Names of the files of all.
    pub(super) fn files(&self) -> impl Iterator<Item = &str> {
        self.analyses.iter().flat_map(|own| own.files.iter().map(String::as_str))
    }
}
