//! Periodic motions over a key of the case, followed from one to the next.

use std::fmt::Write;
use std::ops::ControlFlow;

use serde_json::{Map, Value, json};
use whirl_solver::Error;
use whirl_solver::cache::Cache;
use whirl_solver::error::PeriodicError;
use whirl_solver::machine::Machine;
use whirl_solver::periodic::{
    At, Branch, BranchEnd, BranchEvent, BranchOptions, BranchPoint, Cycle, CycleMap, CycleProgress,
    EventKind, PeriodicOptions, branch, switched,
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

/// Branches of a case over a key: the first, and those that begin at doublings of the period of one before.
struct Followed<'a> {
    case: &'a Case,
    varying: &'a Varying,
    branches: Vec<Own>,
    columns: Vec<String>,
}

/// A branch.
struct Own {
    branch: Branch,
    /// Cycles of the analysis in one of its motions, and the value at which it begins, if that is a doubling.
    periods: usize,
    begun: Option<f64>,
}

/// Branches at most.
const BRANCHES: usize = 32;

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
    let made = branches(&mut at, &options, (&x, analysis.periodic.doublings), &mut observe);
    let branches = match (made, failure) {
        (Ok(made), _) => made,
        (Err(_), Some(failure)) => return Err(failure),
        (Err(error), None) => return Err(place::failed(case, error)),
    };
    let columns = branches[0].branch.points[0].history.names().to_vec();
    let followed = Followed { case, varying, branches, columns };
    let name = &analysis.name;
    let mut written = followed.files(name);
    if figures {
        written.extend(drawn(name, &followed.figure()));
    }
    warnings.extend(followed.branches.iter().filter_map(Own::note));
    Ok(Found {
        text: followed.text(),
        files: written,
        interrupted: followed.branches.iter().any(Own::is_interrupted),
        facts: followed.facts(),
    })
}

/// The branch, and those from its doublings on, from theirs, and so on as often as is wanted. One that comes back to the branch it
/// began at is that of the doubling there, too.
fn branches(
    at: At,
    options: &BranchOptions,
    (x, doublings): (&[f64], usize),
    observe: &mut dyn FnMut(&CycleProgress) -> ControlFlow<()>,
) -> Result<Vec<Own>, Error> {
    let first = branch(&mut *at, options, x, observe)?;
    let mut all = vec![Own { branch: first, periods: 1, begun: None }];
    let mut place = 0;
    while place < all.len() && all[place].periods < 1 << doublings {
        let periods = all[place].periods;
        let is_doubling = |own: &&BranchEvent| own.kind == EventKind::Doubling;
        let mut events: Vec<BranchEvent> =
            all[place].branch.events.iter().filter(is_doubling).cloned().collect();
        events.reverse();
        while let Some(event) = events.pop() {
            if all.len() == BRANCHES || all.iter().any(Own::is_interrupted) {
                return Ok(all);
            }
            let Some(found) = switched(&mut *at, options, (&event, periods), observe)? else {
                continue;
            };
            if let (BranchEnd::Meets, Some(last)) = (&found.end, found.points.last()) {
                let apart = |own: &BranchEvent| (own.value - last.value).abs();
                let nearest = (0..events.len())
                    .min_by(|&a, &b| apart(&events[a]).total_cmp(&apart(&events[b])));
                // Unless it has come back to where it began.
                if let Some(nearest) = nearest.filter(|&own| apart(&events[own]) < apart(&event)) {
                    events.remove(nearest);
                }
            }
            let begun = Some(event.value);
            all.push(Own { branch: found, periods: 2 * periods, begun });
        }
        place += 1;
    }
    Ok(all)
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
    fn is_interrupted(&self) -> bool {
        self.branch.end == BranchEnd::Interrupted
    }

    /// The period of the point before an event (s).
    fn period(&self, event: &BranchEvent) -> f64 {
        self.branch.points[event.after].period
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
}

impl Followed<'_> {
    fn shown(&self, value: f64) -> String {
        let number = shown(value, 8, 1e-4..1e7);
        format!("{number} {}", self.varying.unit.as_deref().unwrap_or("")).trim_end().to_owned()
    }

    fn text(&self) -> String {
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

    fn files(&self, name: &str) -> Vec<(String, Vec<u8>)> {
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

    fn facts(&self) -> Facts {
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
            let mut lines: Vec<Line> = Vec::new();
            let (mut dots, mut labels) = (Vec::new(), Vec::new());
            for own in &self.branches {
                lines.extend(pieces(&own.branch, height));
                for event in &own.branch.events {
                    let [a, b] = [0, 1].map(|next| &own.branch.points[event.after + next]);
                    let at = (event.value, 0.5 * (height(a) + height(b)));
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

/// The line of a branch in pieces that are stable or unstable: a piece is unstable if both of its ends are.
fn pieces(branch: &Branch, height: impl Fn(&BranchPoint) -> f64) -> Vec<Line> {
    let points: Vec<(f64, f64, bool)> = (branch.points.iter())
        .map(|own| (own.value, height(own), text::is_stable(own.stability) != Some(false)))
        .collect();
    let mut lines: Vec<Line> = Vec::new();
    for piece in points.windows(2) {
        let [(x, y, first), (u, v, second)] = [piece[0], piece[1]];
        let (style, name) = match first || second {
            true => (Style::First, "stable"),
            false => (Style::Doubted, "unstable"),
        };
        match lines.last_mut() {
            Some(last) if last.style == style => last.points.push((u, v)),
            _ => lines.push(Line { points: vec![(x, y), (u, v)], style, name: name.to_owned() }),
        }
    }
    lines
}
