//! Periodic motions over a key of the case, followed from one to the next.

use std::fmt::Write;
use std::ops::ControlFlow;

use serde_json::{Map, Value, json};
use whirl_solver::Error;
use whirl_solver::cache::Cache;
use whirl_solver::error::PeriodicError;
use whirl_solver::machine::Machine;
use whirl_solver::periodic::{
    Branch, BranchEnd, BranchEvent, BranchOptions, BranchPoint, Cycle, CycleMap, CycleProgress,
    EventKind, PeriodicOptions, branch,
};
use whirl_text::shown;

use super::motions::{is_summed_up, range};
use super::sought::Sought;
use super::{place, text};
use crate::analysis::facts::Facts;
use crate::analysis::found::{Found, drawn};
use crate::case::{Analysis, Case, CaseText, Varying};
use crate::errors::Failure;
use crate::figures::{Dot, Figure, Label, Line, Panel, Style};
use crate::machine;
use crate::report::table;
use crate::signals::Interruption;

/// First step, of the range.
const STEP: f64 = 0.01;

/// A branch of a case over a key.
struct Followed<'a> {
    case: &'a Case,
    varying: &'a Varying,
    branch: Branch,
    columns: Vec<String>,
}

/// The case with a value of the key, and its machine.
fn read(
    text: &CaseText,
    (analysis, varying): (&Analysis, &Varying),
    value: f64,
    cache: Option<&Cache>,
) -> Result<(Case, machine::Built), Failure> {
    let values = [(varying.key.as_str(), varying.literal(value))].into_iter();
    let place = format!("`vary` of [analysis.{}]", analysis.name);
    let own = text.with_more_values(values).with_values_of(&place);
    let mut own = machine::read_text_to_analyse(&own, &mut Vec::new())?;
    own.fields = None;
    let built = machine::build_planned(&own, cache, &mut Vec::new())?;
    Ok((own, built))
}

/// What keeps a branch from being followed, as far as its ends show that.
///
/// # Errors
/// The key, or what it leads to, is wrong; what does not repeat there.
pub(super) fn foreseen(
    (case, text): (&Case, &CaseText),
    (analysis, varying): (&Analysis, &Varying),
    cache: Option<&Cache>,
) -> Result<(), Failure> {
    for value in varying.ends {
        let (own, built) = read(text, (analysis, varying), value, cache)?;
        let sought = Sought { case: &own, analysis, built: &built, speed: None };
        sought.foreseen().map_err(|error| place::of(case, error))?;
    }
    Ok(())
}

/// The branch from the motion at the first value on.
///
/// # Errors
/// The key, or what it leads to, is wrong; no motion there; an interruption before the second.
pub(super) fn found(
    (case, text): (&Case, &CaseText),
    (analysis, varying): (&Analysis, &Varying),
    (cache, warnings): (Option<&Cache>, &mut Vec<String>),
    interruption: &Interruption,
    figures: bool,
) -> Result<Found, Failure> {
    let read = |value: f64| read(text, (analysis, varying), value, cache);
    let [from, to] = varying.ends;
    let (first, built) = read(from)?;
    let of = |case: &Case, error: Error| place::of(case, error);
    let sought = Sought { case: &first, analysis, built: &built, speed: None };
    let (_, cycle) = sought.cycle(None).map_err(|error| of(&first, error))?;
    let options = sought.options(cycle);
    let map = CycleMap::new(&built.machine, cycle, options.newton);
    let map = map.map_err(|error| of(&first, error))?;
    let (bodies, laws_at_rest) = sought.beginning(cycle).map_err(|error| of(&first, error))?;
    let x = map.beginning(&bodies, laws_at_rest);
    drop(map);
    // An error that is not one of the solver is kept beside it.
    let mut failure: Option<Failure> = None;
    let mut at = |value: f64| -> Result<(Machine, Cycle), Error> {
        let made = read(value).and_then(|(own, built)| {
            let sought = Sought { case: &own, analysis, built: &built, speed: None };
            let (_, found) = sought.cycle(Some(cycle.steps)).map_err(|error| of(&own, error))?;
            Ok((built.machine, found))
        });
        made.map_err(|error| {
            // Beyond its range a key may have no values.
            if value < from.min(to) || value > from.max(to) {
                return PeriodicError::NoMachine { value }.into();
            }
            let words = error.to_string();
            failure.get_or_insert(error);
            Error::Machine(words)
        })
    };
    let mut observe = |_: &CycleProgress| match interruption.asked() {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    let options = BranchOptions {
        range: varying.ends,
        points: analysis.periodic.points,
        step: STEP,
        first: PeriodicOptions { judged: false, ..options },
    };
    let made = branch(&mut at, &options, &x, &mut observe);
    let branch = match (made, failure) {
        (Ok(made), _) => made,
        (Err(_), Some(failure)) => return Err(failure),
        (Err(error), None) => return Err(place::failed(case, error)),
    };
    let columns = branch.points[0].history.names().to_vec();
    let followed = Followed { case, varying, branch, columns };
    let name = &analysis.name;
    let mut written = followed.files(name);
    if figures {
        written.extend(drawn(name, &followed.figure()));
    }
    warnings.extend(followed.note());
    Ok(Found {
        text: followed.text(),
        files: written,
        interrupted: followed.branch.end == BranchEnd::Interrupted,
        facts: followed.facts(),
    })
}

/// As files and texts call an event.
fn called(kind: EventKind) -> &'static str {
    match kind {
        EventKind::Fold => "fold",
        EventKind::Crossing => "branch point",
        EventKind::Doubling => "period doubling",
        EventKind::Torus => "second frequency",
        EventKind::Corner => "corner",
    }
}

fn ended(end: &BranchEnd) -> &'static str {
    match end {
        BranchEnd::Range => "the end of the range",
        BranchEnd::Points => "as many `points` as were asked for",
        BranchEnd::Closed => "the first motion again",
        BranchEnd::Step => "a place from which no step leads on",
        BranchEnd::Wild => "multipliers so large that nothing is known any more",
        BranchEnd::Interrupted => "an interruption",
    }
}

impl Followed<'_> {
    fn shown(&self, value: f64) -> String {
        let number = shown(value, 8, 1e-4..1e7);
        format!("{number} {}", self.varying.unit.as_deref().unwrap_or("")).trim_end().to_owned()
    }

    fn period(&self, event: &BranchEvent) -> f64 {
        self.branch.points[event.after].period
    }

    fn text(&self) -> String {
        let Branch { points, events, end, cycles } = &self.branch;
        let mut text = format!("{}: {}\n", self.case.name, self.case.title);
        let [from, to] = self.varying.ends;
        let _ = writeln!(
            text,
            "{} points over `{}` from {} towards {}, to {}; {cycles} cycles marched\n",
            points.len(),
            self.varying.key,
            self.shown(from),
            self.shown(to),
            ended(end)
        );
        let head = [self.varying.key.as_str(), "", "largest multiplier"];
        let mut lines = vec![head.map(str::to_owned).to_vec()];
        let mut before: Option<&str> = None;
        for (place, point) in points.iter().enumerate() {
            let said = match text::is_stable(point.stability) {
                Some(true) => "stable",
                Some(false) => "UNSTABLE",
                None => "undecided",
            };
            let own = events.iter().filter(|own| own.after + 1 == place);
            for own in own {
                let beside = match own.kind {
                    EventKind::Torus => {
                        let hertz = shown(own.beside(self.period(own)), 6, 1e-3..1e7);
                        format!("{}, {hertz} Hz", called(own.kind))
                    }
                    kind => called(kind).to_owned(),
                };
                lines.push(vec![self.shown(own.value), beside, String::new()]);
            }
            if before != Some(said) || place + 1 == points.len() {
                let size = point.multipliers.first().map_or(0.0, |own| own.norm());
                lines.push(vec![
                    self.shown(point.value),
                    said.to_owned(),
                    shown(size, 6, 1e-3..1e6),
                ]);
            }
            before = Some(said);
        }
        text.push_str(&table(&lines));
        text.push('\n');
        if let Some(own) = self.note() {
            let _ = writeln!(text, "note: {own}");
        }
        text
    }

    fn note(&self) -> Option<String> {
        match self.branch.end {
            BranchEnd::Step | BranchEnd::Wild => Some(format!(
                "the branch has ended before its range, at {}",
                ended(&self.branch.end)
            )),
            BranchEnd::Points => {
                Some("the branch goes on beyond the last point: ask for more `points`".to_owned())
            }
            _ => None,
        }
    }

    fn summed_up(&self) -> impl Iterator<Item = (usize, &String)> {
        self.columns.iter().enumerate().filter(|own| is_summed_up(own.1))
    }

    fn files(&self, name: &str) -> Vec<(String, Vec<u8>)> {
        let mut rows = String::from("point,value,period_s,stability,largest_multiplier,corner");
        for (_, column) in self.summed_up() {
            let _ = write!(rows, ",{column}.min,{column}.max");
        }
        rows.push('\n');
        let mut multipliers = String::from("point,value,number,real,imaginary,modulus\n");
        for (place, point) in self.branch.points.iter().enumerate() {
            let BranchPoint { value, period, stability, corner, .. } = point;
            let size = point.multipliers.first().map_or(f64::NAN, |own| own.norm());
            let said = text::stability(*stability);
            let _ = write!(rows, "{},{value},{period},{said},{size},{corner}", place + 1);
            for (column, _) in self.summed_up() {
                let [least, most] = range(&point.history, column);
                let _ = write!(rows, ",{least},{most}");
            }
            rows.push('\n');
            for (number, own) in point.multipliers.iter().enumerate() {
                let (place, number) = (place + 1, number + 1);
                let (re, im, size) = (own.re, own.im, own.norm());
                let _ = writeln!(multipliers, "{place},{value},{number},{re},{im},{size}");
            }
        }
        let mut events = String::from("event,value,real,imaginary,beside_hz,after_point\n");
        for own in &self.branch.events {
            let (kind, re, im) = (called(own.kind), own.multiplier.re, own.multiplier.im);
            let beside = match own.kind {
                EventKind::Torus => own.beside(self.period(own)).to_string(),
                _ => String::new(),
            };
            let _ = writeln!(events, "{kind},{},{re},{im},{beside},{}", own.value, own.after + 1);
        }
        vec![
            (format!("{name}.csv"), rows.into_bytes()),
            (format!("{name}.events.csv"), events.into_bytes()),
            (format!("{name}.multipliers.csv"), multipliers.into_bytes()),
            (format!("{name}.json"), self.summary(name).into_bytes()),
        ]
    }

    fn summary(&self, name: &str) -> String {
        let events = self.branch.events.iter().map(|own| {
            json!({ "event": called(own.kind), "value": own.value, "after_point": own.after + 1 })
        });
        let mut whole = Map::new();
        let mut put = |key: &str, value: Value| whole.insert(key.to_owned(), value);
        put("case", json!(self.case.name));
        put("analysis", json!(name));
        put("key", json!(self.varying.key));
        put("unit", json!(self.varying.unit));
        put("points", json!(self.branch.points.len()));
        put("cycles", json!(self.branch.cycles));
        put("end", json!(ended(&self.branch.end)));
        put("events", events.collect());
        let mut text =
            serde_json::to_string_pretty(&Value::Object(whole)).expect("keys are strings");
        text.push('\n');
        text
    }

    fn facts(&self) -> Facts {
        let mut facts = Facts::default();
        for (kind, name) in [
            (EventKind::Fold, "fold."),
            (EventKind::Doubling, "doubling."),
            (EventKind::Torus, "second_frequency."),
        ] {
            let own = self.branch.events.iter().filter(|own| own.kind == kind);
            facts.each(name, own.map(|own| own.value));
        }
        facts.put("points", self.branch.points.len() as f64);
        self.note().iter().for_each(|own| facts.note(own));
        facts
    }

    /// Half of the range of X of every joint over the key: what is stable, and what is not.
    fn figure(&self) -> Figure {
        let x = match &self.varying.unit {
            Some(unit) => format!("{} ({unit})", self.varying.key),
            None => self.varying.key.clone(),
        };
        let supports = self.case.supports();
        let panels = supports.iter().filter_map(|own| {
            let column = self.columns.iter().position(|name| *name == own.column("X", "um"))?;
            let height = |point: &BranchPoint| {
                let [least, most] = range(&point.history, column);
                0.5 * (most - least)
            };
            let points: Vec<(f64, f64, bool)> = (self.branch.points.iter())
                .map(|own| (own.value, height(own), text::is_stable(own.stability) != Some(false)))
                .collect();
            let mut lines: Vec<Line> = Vec::new();
            // A piece is unstable if both of its ends are.
            for piece in points.windows(2) {
                let [(x, y, first), (u, v, second)] = [piece[0], piece[1]];
                let (style, name) = match first || second {
                    true => (Style::First, "stable"),
                    false => (Style::Doubted, "unstable"),
                };
                match lines.last_mut() {
                    Some(last) if last.style == style => last.points.push((u, v)),
                    _ => lines.push(Line {
                        points: vec![(x, y), (u, v)],
                        style,
                        name: name.to_owned(),
                    }),
                }
            }
            let at = |event: &BranchEvent| {
                let [a, b] = [0, 1].map(|next| &self.branch.points[event.after + next]);
                (event.value, 0.5 * (height(a) + height(b)))
            };
            let dots =
                self.branch.events.iter().map(|own| Dot { at: at(own), name: "events".to_owned() });
            let labels = self.branch.events.iter().map(|own| Label {
                at: at(own),
                text: format!("{} {}", called(own.kind), shown(own.value, 6, 1e-3..1e7)),
            });
            Some(Panel {
                title: own.title.clone(),
                x: x.clone(),
                y: "half of the range of X (µm)".to_owned(),
                dots: dots.collect(),
                labels: labels.collect(),
                lines,
                ..Panel::default()
            })
        });
        Figure {
            title: format!("{}: periodic motions", self.case.name),
            panels: panels.collect(),
            columns: 1,
        }
    }
}
