//! What a point comes to: its row in the table.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::trace::Trace;
use crate::case::Case;
use crate::errors::Failure;

/// A point that is done, well or not.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Row {
    pub(super) verdict: Verdict,
    /// What the verdict found, or why there are no numbers, or why the run ended early; in one line.
    pub(super) words: String,
    /// By the names of the row; NaN where the summary has none.
    pub(super) values: Vec<f64>,
    /// For figures that need it.
    pub(super) trace: Option<Trace>,
}

/// Whether the numbers of a point can be believed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Verdict {
    /// By its own judgement, or analysed.
    #[default]
    Sound,
    /// By its own judgement not.
    NotSound,
    /// It has none, or has not come to its end.
    Failed,
}

impl Verdict {
    /// As the table has it.
    pub(super) fn word(self) -> &'static str {
        match self {
            Verdict::Sound => "sound",
            Verdict::NotSound => "not sound",
            Verdict::Failed => "failed",
        }
    }
}

impl Row {
    /// Of a point that could not be begun.
    pub(super) fn failed(failure: &Failure) -> Self {
        let words = match failure {
            Failure::Input(all) => {
                let messages: Vec<&str> = all.iter().map(|own| own.message.as_str()).collect();
                messages.join("; ")
            }
            other => other.to_string(),
        };
        Row { verdict: Verdict::Failed, words: one_line(&words), values: Vec::new(), trace: None }
    }

    /// Of a run, by its summary; `reason`: why it ended early, if it did.
    pub(super) fn of(case: &Case, summary: &Value, reason: Option<&str>) -> (Vec<String>, Self) {
        let sound = summary["verdict"]["sound"] == Value::Bool(true);
        let verdict = match (reason, sound) {
            (Some(_), _) => Verdict::Failed,
            (None, true) => Verdict::Sound,
            (None, false) => Verdict::NotSound,
        };
        let found = summary["verdict"]["findings"].as_array().into_iter().flatten();
        let found: Vec<&str> = found.filter_map(|own| own["what"].as_str()).collect();
        let words = reason.map_or_else(|| found.join("; "), str::to_owned);
        let (names, values) = numbers(case, summary).into_iter().unzip();
        (names, Row { verdict, words: one_line(&words), values, trace: None })
    }
}

impl Row {
    /// Adds to what is said of the point.
    pub(super) fn remark(&mut self, words: &str) {
        let apart = if self.words.is_empty() { "" } else { "; " };
        self.words = format!("{}{apart}{}", self.words, one_line(words));
    }
}

fn one_line(words: &str) -> String {
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The numbers of a summary that depend on nothing but the case, each with its name: those of supports and signals by their
/// columns of history.csv.
fn numbers(case: &Case, summary: &Value) -> Vec<(String, f64)> {
    let mut all = Vec::new();
    let mut take = |head: &str, value: &Value| flatten(head, value, &mut all);
    take("", &summary["march"]);
    take("", &summary["verdict"]["measures"]);
    take("energy_balance_j", &summary["energy_balance_j"]);
    take("cycle_s", &summary["cycle_s"]);
    take("steady_state", &summary["steady_state"]);
    let supports = summary["supports"].as_array().into_iter().flatten();
    for (own, name) in supports.zip(case.supports()) {
        for (key, value) in own.as_object().into_iter().flatten() {
            match key.rsplit_once('_') {
                Some((quantity, unit)) if value.is_object() => {
                    take(&name.column(quantity, unit), value);
                }
                Some((quantity, unit)) if value.is_f64() => {
                    take(&name.column(quantity, unit), value);
                }
                _ => {}
            }
        }
    }
    for own in summary["orders"]["signals"].as_array().into_iter().flatten() {
        let Some(signal) = own["signal"].as_str() else { continue };
        for order in ["1X", "2X"] {
            take(&format!("{signal}.{order}"), &own[order]);
        }
    }
    for (body, own) in summary["stresses"].as_object().into_iter().flatten() {
        take(&format!("stress.{body}"), &own["von_mises_MPa"]);
    }
    all
}

/// Numbers and truth values within a value; texts and lists are none.
fn flatten(head: &str, value: &Value, all: &mut Vec<(String, f64)>) {
    match value {
        Value::Number(number) => all.extend(number.as_f64().map(|own| (head.to_owned(), own))),
        Value::Bool(flag) => all.push((head.to_owned(), f64::from(u8::from(*flag)))),
        Value::Null if !head.is_empty() => all.push((head.to_owned(), f64::NAN)),
        Value::Object(entries) => {
            for (key, inner) in entries {
                let name = if head.is_empty() { key.clone() } else { format!("{head}.{key}") };
                flatten(&name, inner, all);
            }
        }
        _ => {}
    }
}
