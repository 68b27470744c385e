//! What a sweep was, for a page: sweep.json, beside its table.

use serde::{Deserialize, Serialize};

use super::about::LAYOUT;
use crate::version;

/// A sweep whose table is there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct SweepFacts {
    layout: u32,
    version: String,
    pub(super) name: String,
    pub(super) title: String,
    /// What varies, a line each; points that failed, or are not sound.
    lines: Vec<String>,
    remarks: Vec<String>,
    /// Columns of the table that vary.
    varied: Vec<String>,
}

impl SweepFacts {
    /// Of a sweep: its name and title, lines of what varies and of what is remarked, and names of the columns that vary.
    pub(crate) fn new(
        (name, title): (&str, &str),
        (lines, remarks): (Vec<String>, Vec<String>),
        varied: Vec<String>,
    ) -> Self {
        let (name, title) = (name.to_owned(), title.to_owned());
        let version = version::PACKAGE.to_owned();
        SweepFacts { layout: LAYOUT, version, name, title, lines, remarks, varied }
    }

    /// The text of the file.
    pub(crate) fn json(&self) -> String {
        serde_json::to_string_pretty(self).expect("the keys are strings") + "\n"
    }

    /// Of the text of a file; why it is none.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let own: serde_json::Value = serde_json::from_str(text).map_err(|why| why.to_string())?;
        if own["layout"] != LAYOUT {
            return Err("it is of another version of the program: run the sweep again".to_owned());
        }
        serde_json::from_value(own).map_err(|why| why.to_string())
    }
}
