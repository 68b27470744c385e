//! Branches of periodic motions as a text, tables, a figure and facts.

use std::fmt::Write;

use serde_json::{Map, Value, json};
use whirl_solver::periodic::{Branch, BranchEnd, BranchEvent, BranchPoint, EventKind};
use whirl_text::shown;

use super::motions::{is_summed_up, range};
use super::text;
use crate::analysis::facts::Facts;
use crate::case::{Case, Varying};
use crate::figures::{Dot, Figure, Label, Line, Panel, Style};
use crate::report::table;

/// Branches of a case over a key: the first, and those that begin at doublings of the period of one before.
pub(super) struct Followed<'a> {
    pub(super) case: &'a Case,
    pub(super) varying: &'a Varying,
    pub(super) branches: Vec<Own>,
    pub(super) columns: Vec<String>,
}

/// A branch.
pub(super) struct Own {
    pub(super) branch: Branch,
    /// Cycles of the analysis in one of its motions, and the value at which it begins, if that is a doubling.
    pub(super) periods: usize,
    pub(super) begun: Option<f64>,
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
        BranchEnd::Meets => "motions of half its period",
        BranchEnd::Step => "a place from which no step leads on",
        BranchEnd::Wild => "multipliers so large that nothing is known any more",
        BranchEnd::Interrupted => "an interruption",
    }
}

impl Own {
    pub(super) fn is_interrupted(&self) -> bool {
        self.branch.end == BranchEnd::Interrupted
    }

    /// The period of the point before an event (s).
    fn period(&self, event: &BranchEvent) -> f64 {
        self.branch.points[event.after].period
    }

    pub(super) fn note(&self) -> Option<String> {
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
}

impl Followed<'_> {
    fn shown(&self, value: f64) -> String {
        let number = shown(value, 8, 1e-4..1e7);
        format!("{number} {}", self.varying.unit.as_deref().unwrap_or("")).trim_end().to_owned()
    }

    pub(super) fn text(&self) -> String {
        let mut text = format!("{}: {}\n", self.case.name, self.case.title);
        let [from, to] = self.varying.ends;
        for own in &self.branches {
            let Branch { points, end, cycles, .. } = &own.branch;
            let (count, key, end) = (points.len(), &self.varying.key, ended(end));
            let _ = match own.begun {
                None => writeln!(
                    text,
                    "{count} points over `{key}` from {} towards {}, to {end}; {cycles} cycles marched\n",
                    self.shown(from),
                    self.shown(to),
                ),
                Some(begun) => writeln!(
                    text,
                    "\n{count} points of {} periods from the doubling at {} on, to {end}; {cycles} cycles marched\n",
                    own.periods,
                    self.shown(begun),
                ),
            };
            text.push_str(&self.changes(own));
            text.push('\n');
            if let Some(note) = own.note() {
                let _ = writeln!(text, "note: {note}");
            }
            for event in own.branch.events.iter().filter(|event| event.jumps) {
                let _ = writeln!(
                    text,
                    "note: at {} the multiplier jumps over the unit circle, to {}, as a contact begins or ends in another step: more \
                     `steps` locate this change better",
                    self.shown(event.value),
                    shown(event.multiplier.norm(), 4, 1e-3..1e6)
                );
            }
        }
        text
    }

    /// What happens along a branch.
    fn changes(&self, own: &Own) -> String {
        let Branch { points, events, .. } = &own.branch;
        let head = [self.varying.key.as_str(), "", "largest multiplier"];
        let mut lines = vec![head.map(str::to_owned).to_vec()];
        let mut before: Option<&str> = None;
        for (place, point) in points.iter().enumerate() {
            let said = match text::is_stable(point.stability) {
                Some(true) => "stable",
                Some(false) => "UNSTABLE",
                None => "undecided",
            };
            for event in events.iter().filter(|event| event.after + 1 == place) {
                let beside = match event.kind {
                    EventKind::Torus => {
                        let hertz = shown(event.beside(own.period(event)), 6, 1e-3..1e7);
                        format!("{}, {hertz} Hz", called(event.kind))
                    }
                    kind => called(kind).to_owned(),
                };
                lines.push(vec![self.shown(event.value), beside, String::new()]);
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
        table(&lines)
    }

    fn summed_up(&self) -> impl Iterator<Item = (usize, &String)> {
        self.columns.iter().enumerate().filter(|own| is_summed_up(own.1))
    }

    pub(super) fn files(&self, name: &str) -> Vec<(String, Vec<u8>)> {
        let mut all = Vec::new();
        for (place, own) in self.branches.iter().enumerate() {
            match place {
                0 => all.extend(self.tables(own, name)),
                _ => all.extend(self.tables(own, &format!("{name}.doubled-{place}"))),
            }
        }
        all.push((format!("{name}.json"), self.summary(name).into_bytes()));
        all
    }

    /// The tables of a branch.
    fn tables(&self, own: &Own, name: &str) -> [(String, Vec<u8>); 3] {
        let mut rows = String::from("point,value,period_s,stability,largest_multiplier,corner");
        for (_, column) in self.summed_up() {
            let _ = write!(rows, ",{column}.min,{column}.max");
        }
        rows.push('\n');
        let mut multipliers = String::from("point,value,number,real,imaginary,modulus\n");
        for (place, point) in own.branch.points.iter().enumerate() {
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
        for event in &own.branch.events {
            let (kind, re, im) = (called(event.kind), event.multiplier.re, event.multiplier.im);
            let beside = match event.kind {
                EventKind::Torus => event.beside(own.period(event)).to_string(),
                _ => String::new(),
            };
            let (value, after) = (event.value, event.after + 1);
            let _ = writeln!(events, "{kind},{value},{re},{im},{beside},{after}");
        }
        [
            (format!("{name}.csv"), rows.into_bytes()),
            (format!("{name}.events.csv"), events.into_bytes()),
            (format!("{name}.multipliers.csv"), multipliers.into_bytes()),
        ]
    }

    fn summary(&self, name: &str) -> String {
        let events = |own: &Own| -> Value {
            let events = own.branch.events.iter();
            let event = |own: &BranchEvent| json!({ "event": called(own.kind), "value": own.value, "after_point": own.after + 1 });
            events.map(event).collect()
        };
        let own = &self.branches[0];
        let doubled = self.branches.iter().enumerate().skip(1).map(|(place, own)| {
            json!({
                "table": format!("{name}.doubled-{place}.csv"),
                "begins_at": own.begun,
                "periods": own.periods,
                "points": own.branch.points.len(),
                "cycles": own.branch.cycles,
                "end": ended(&own.branch.end),
                "events": events(own),
            })
        });
        let doubled: Vec<Value> = doubled.collect();
        let mut whole = Map::new();
        let mut put = |key: &str, value: Value| whole.insert(key.to_owned(), value);
        put("case", json!(self.case.name));
        put("analysis", json!(name));
        put("key", json!(self.varying.key));
        put("unit", json!(self.varying.unit));
        put("points", json!(own.branch.points.len()));
        put("cycles", json!(own.branch.cycles));
        put("end", json!(ended(&own.branch.end)));
        put("events", events(own));
        put("doubled", json!(doubled));
        let mut text =
            serde_json::to_string_pretty(&Value::Object(whole)).expect("keys are strings");
        text.push('\n');
        text
    }

    pub(super) fn facts(&self) -> Facts {
        let mut facts = Facts::default();
        for (kind, name) in [
            (EventKind::Fold, "fold."),
            (EventKind::Doubling, "doubling."),
            (EventKind::Torus, "second_frequency."),
        ] {
            let all = self.branches.iter().flat_map(|own| &own.branch.events);
            facts.each(name, all.filter(|own| own.kind == kind).map(|own| own.value));
        }
        let points = self.branches.iter().map(|own| own.branch.points.len()).sum::<usize>();
        facts.put("points", points as f64);
        self.branches.iter().filter_map(Own::note).for_each(|own| facts.note(&own));
        facts
    }

    /// Half of the range of X of every joint over the key: what is stable, and what is not.
    pub(super) fn figure(&self) -> Figure {
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
            let mut lines: Vec<Line> = Vec::new();
            let (mut dots, mut labels) = (Vec::new(), Vec::new());
            for own in &self.branches {
                lines.extend(pieces(&own.branch, height));
                for event in &own.branch.events {
                    let at = (event.value, height_of(&own.branch, event, height));
                    let value = shown(event.value, 6, 1e-3..1e7);
                    dots.push(Dot { at, name: "events".to_owned() });
                    labels.push(Label { at, text: format!("{} {value}", called(event.kind)) });
                }
            }
            Some(Panel {
                title: own.title.clone(),
                x: x.clone(),
                y: "half of the range of X (µm)".to_owned(),
                dots,
                labels,
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

/// The height of an event, between those of the points around it.
fn height_of(branch: &Branch, event: &BranchEvent, height: impl Fn(&BranchPoint) -> f64) -> f64 {
    let [a, b] = [0, 1].map(|next| &branch.points[event.after + next]);
    let share = (event.value - a.value) / (b.value - a.value);
    // A fold lies beyond both.
    let share = if (0.0..=1.0).contains(&share) { share } else { 0.5 };
    height(a) + share * (height(b) - height(a))
}

/// The line of a branch in pieces that are stable or unstable. Where that changes at an event they meet there; otherwise a piece is
/// unstable if both of its ends are.
fn pieces(branch: &Branch, height: impl Fn(&BranchPoint) -> f64 + Copy) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    let mut add = |from: (f64, f64), to: (f64, f64), stable: bool| {
        let (style, name) = match stable {
            true => (Style::First, "stable"),
            false => (Style::Doubted, "unstable"),
        };
        match lines.last_mut() {
            Some(last) if last.style == style => last.points.push(to),
            _ => lines.push(Line { points: vec![from, to], style, name: name.to_owned() }),
        }
    };
    for (place, piece) in branch.points.windows(2).enumerate() {
        let [from, to] = [0, 1].map(|end| (piece[end].value, height(&piece[end])));
        let [first, second] =
            [0, 1].map(|end| text::is_stable(piece[end].stability) != Some(false));
        match branch.events.iter().find(|own| own.after == place && first != second) {
            Some(event) => {
                let middle = (event.value, height_of(branch, event, height));
                add(from, middle, first);
                add(middle, to, second);
            }
            None => add(from, to, first || second),
        }
    }
    lines
}
