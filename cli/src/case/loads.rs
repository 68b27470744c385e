//! Forces and couples on a body.

use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::rational::nearest;
use whirl_codegen::units::{Dimension, Quantity};
use whirl_solver::curve::Curve;
use whirl_solver::loads::{Frame, Onset, TimeFunction};
use whirl_solver::model::LoadAction;

use super::columns::{self, Columns};
use super::library::FileStore;

/// A force or a couple on node sets of a body: its amplitude times a factor.
#[derive(Debug, Clone)]
pub(crate) struct Load {
    /// Sets of the body's mesh.
    pub(crate) sets: Vec<Located>,
    /// What acts; its directions where a table has its size.
    pub(crate) acting: LoadAction,
    /// Where the case says it.
    pub(crate) place: Located,
    /// In which frame its direction is constant.
    pub(crate) frame: Frame,
    /// How the nodes of the sets carry it.
    pub(crate) spread: Spread,
    /// How it varies.
    pub(crate) time_function: TimeFunction,
    /// The table over time or an angle that says so, if one does, and whether it is periodic.
    pub(crate) table: Option<(Arc<Columns>, bool)>,
    /// From when on it acts.
    pub(crate) onset: Onset,
}

/// How the nodes of sets carry a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Spread {
    /// Each of them the whole force.
    Each,
    /// Their mean motion the whole force.
    Mean,
}

impl Load {
    /// f in Hz, of a load that varies as a sine in time.
    pub(crate) fn frequency(&self) -> Option<f64> {
        match self.time_function {
            TimeFunction::Sine { frequency, .. } => Some(frequency),
            _ => None,
        }
    }

    /// Whether it is a couple about the axis of its body.
    pub(crate) fn turns(&self) -> bool {
        matches!(self.acting, LoadAction::Couple([.., z]) if z != 0.0)
    }

    /// The body whose angle it follows, by its place, if it does.
    pub(crate) fn followed(&self) -> Option<usize> {
        match self.time_function {
            TimeFunction::Order { body, .. } | TimeFunction::OverAngle { body, .. } => Some(body),
            _ => None,
        }
    }

    /// Lets it follow the angle of a body, by its place, if it follows one.
    pub(super) fn follow(&mut self, followed: usize) {
        if let TimeFunction::Order { body, .. } | TimeFunction::OverAngle { body, .. } =
            &mut self.time_function
        {
            *body = followed;
        }
    }

    /// What it is, for people; `at`: where it acts, behind its amplitude; `of`: the body whose angle it follows, where the
    /// case names bodies.
    pub(crate) fn described(&self, at: &str, of: Option<&str>) -> String {
        let (parts, unit, word) = match self.acting {
            LoadAction::Force(parts) => (parts, "N", "along"),
            LoadAction::Couple(parts) => (parts, "N m", "about"),
        };
        let axes = || ["x", "y", "z"].into_iter().zip(parts).filter(|(_, part)| *part != 0.0);
        let scaled =
            self.table.as_ref().is_none_or(|(own, _)| own.measures[1] == Dimension::NUMBER);
        let along: Vec<String> = axes()
            .map(|(axis, part)| match scaled {
                true => format!("{part} {unit} {word} {axis}"),
                false if part == 1.0 => format!("{word} {axis}"),
                false => format!("{part} {word} {axis}"),
            })
            .collect();
        let of = of.map_or(String::new(), |body| format!(" of {body}"));
        let variation = match (&self.table, &self.time_function) {
            (Some((columns, periodic)), _) => {
                let angle = format!("the angle{of}");
                let over = if self.followed().is_some() { angle.as_str() } else { "time" };
                let periodic = if *periodic { ", periodic" } else { "" };
                format!("table `{}` over {over}{periodic}", columns.name.text())
            }
            (_, TimeFunction::Sine { frequency, phase }) => {
                format!("sine of {frequency} Hz{}", shifted(*phase))
            }
            (_, TimeFunction::Order { order, phase, .. }) => {
                format!("order {order}{of}{}", shifted(*phase))
            }
            _ => "constant".to_string(),
        };
        let from = match self.onset {
            Onset::Start => String::new(),
            Onset::Step(from) => format!(", from {from} s on"),
            Onset::Ramp(from, to) => format!(", rising from {from} s to {to} s"),
        };
        let frame = if self.frame == Frame::Body { ", turning with it" } else { "" };
        let nothing = if along.is_empty() { format!("0 {unit}") } else { along.join(", ") };
        format!("{nothing}{at}{frame}, {variation}{from}")
    }
}

/// A phase (rad) behind what it shifts.
fn shifted(phase: f64) -> String {
    match phase {
        0.0 => String::new(),
        phase => format!(", phase {}°", whirl_text::rounded(phase.to_degrees(), 10)),
    }
}

pub(super) fn read(store: FileStore, file: &Table) -> Vec<Load> {
    let one = |table: Table| table.read(|table| read_one(store, table));
    file.tables("load").into_iter().map(one).collect()
}

/// The load that a table describes.
pub(super) fn read_one(store: FileStore, load: &Table) -> Load {
    let sets = load.texts("sets");
    let columns = columns::read(
        store,
        load,
        "table",
        [
            &[Dimension::TIME, Dimension::ANGLE],
            &[Dimension::NUMBER, Dimension::FORCE, Dimension::TORQUE],
        ],
    );
    let (acting, key) = acting(load, columns.as_deref());
    let (time_function, table) = variation(load, columns);
    Load {
        sets,
        acting,
        place: load.written(key),
        frame: match load.optional_word("frame") {
            Some("body") => Frame::Body,
            _ => Frame::Space,
        },
        spread: match load.optional_word("spread") {
            Some("mean") => Spread::Mean,
            _ => Spread::Each,
        },
        time_function,
        table,
        onset: onset(load),
    }
}

/// What acts, and the key that says it.
fn acting(load: &Table, columns: Option<&Columns>) -> (LoadAction, &'static str) {
    let axis = load.optional_word("direction");
    let unit = |default: usize| {
        let place = axis.and_then(|axis| ["x", "y", "z"].iter().position(|own| *own == axis));
        let mut parts = [0.0; 3];
        parts[place.unwrap_or(default)] = 1.0;
        parts
    };
    let (has_force, has_couple) = (load.has("force"), load.has("couple"));
    if has_force && has_couple {
        load.conflict("couple", "force");
    }
    // A table in newtons or newton metres says how large it is.
    let by_table = columns.map(|own| own.measures[1]).filter(|own| *own != Dimension::NUMBER);
    if let Some(dimension) = by_table {
        for key in ["force", "couple"].into_iter().filter(|key| load.gives(key)) {
            let message = format!("the table says how large the load is: `{key}` has no effect");
            let help =
                "leave it out, or write the second column as a pure number, with the unit `[1]`";
            load.push(load.written(key).error_here(Code::BAD_VALUE, message).help(help));
        }
        return match dimension == Dimension::TORQUE {
            true => (LoadAction::Couple(unit(2)), "table"),
            false => (LoadAction::Force(unit(0)), "table"),
        };
    }
    let parts = |key: &str, default: usize| {
        if !load.gives_list(key) {
            let amplitude = load.quantity(key).unwrap_or(1.0);
            return unit(default).map(|part| if part == 0.0 { 0.0 } else { amplitude });
        }
        if axis.is_some() {
            let message = format!("`{key}` is a list along x, y and z: `direction` has no effect");
            let help = format!("leave `direction` out, or write `{key}` as one quantity");
            let place = load.written("direction");
            load.push(place.error_here(Code::BAD_VALUE, message).help(help));
        }
        load.quantity_triple(key).unwrap_or([1.0; 3])
    };
    if has_couple {
        return (LoadAction::Couple(parts("couple", 2)), "couple");
    }
    if !has_force && !load.gives("table") {
        load.absent("force", "add for example `force = \"1000 N\"`, or a `couple` or a `table`");
    } else if !has_force && columns.is_some() {
        let message =
            "a table of pure numbers needs the `force` or the `couple` that it multiplies";
        let help =
            "add `force = \"1000 N\"`, or write the unit of the second column, as in `force [N]`";
        load.push(load.written("table").error_here(Code::BAD_VALUE, message).help(help));
    }
    (LoadAction::Force(parts("force", 0)), "force")
}

fn variation(
    load: &Table,
    columns: Option<Arc<Columns>>,
) -> (TimeFunction, Option<(Arc<Columns>, bool)>) {
    let frequency = load.quantity("frequency");
    let order = load.optional_number("order").map(|(order, _)| nearest(&order));
    if load.has("phase") && !load.has("frequency") && !load.has("order") {
        let (message, help) = match load.has("table") {
            true => (
                "a `table` says at which times or angles a load has its values: `phase` has no effect",
                "leave `phase` out, and shift the first column of the table",
            ),
            false => (
                "a load without `frequency` or `order` is constant: its `phase` has no effect",
                "add `frequency = \"37.5 Hz\"` or `order = 2`, or leave `phase` out",
            ),
        };
        load.push(load.written("phase").error_here(Code::BAD_VALUE, message).help(help));
    }
    let phase = load.quantity("phase").unwrap_or(0.0);
    for (key, still) in [("frequency", frequency == Some(0.0)), ("order", order == Some(0.0))] {
        if still && phase == 0.0 {
            let message = format!("a load with `{key} = 0` and no `phase` is zero at all times");
            let help = format!("leave `{key}` out for a constant load, or give its `phase`");
            load.push(load.written(key).error_here(Code::BAD_VALUE, message).help(help));
        }
    }
    for (key, other) in [("order", "frequency"), ("table", "frequency"), ("table", "order")] {
        if load.has(key) && load.has(other) {
            load.conflict(key, other);
        }
    }
    let period = load.optional_string("period");
    if let (Some(period), false) = (&period, load.has("table")) {
        let message = "a load without `table` has no `period`";
        let help = "leave `period` out, or name a `table`";
        load.push(period.error_here(Code::BAD_VALUE, message).help(help));
    }
    match (frequency, order, columns) {
        (Some(frequency), ..) => (TimeFunction::Sine { frequency, phase }, None),
        (_, Some(order), _) => (TimeFunction::Order { body: SHAFT, order, phase }, None),
        (.., Some(columns)) => {
            let periodic = period.is_some_and(|written| closes(load, &columns, &written));
            let time_function = match columns.measures[0] == Dimension::ANGLE {
                true => {
                    let curve = Curve::smooth(&columns.rows, periodic).expect(CHECKED);
                    TimeFunction::OverAngle { body: SHAFT, curve: Arc::new(curve) }
                }
                false => {
                    let curve = Curve::linear(&columns.rows, periodic).expect(CHECKED);
                    TimeFunction::OverTime(Arc::new(curve))
                }
            };
            (time_function, Some((columns, periodic)))
        }
        _ => (TimeFunction::Constant, None),
    }
}

/// Tables are checked where they are read.
const CHECKED: &str = "rows that rise and close";

/// The body whose angle loads of the short form follow.
const SHAFT: usize = 0;

/// Whether a table closes after its period; what is wrong is noted.
fn closes(load: &Table, columns: &Columns, written: &Located) -> bool {
    let wanted = columns.measures[0];
    let example = if wanted == Dimension::TIME { "0.1 s" } else { "720 deg" };
    let such_as =
        format!("write it as the first column measures it, such as `period = \"{example}\"`");
    let read = Quantity::parse(written.text())
        .and_then(|quantity| quantity.expect(&wanted).map(|_| quantity.si()));
    match read {
        Ok(period) if period > 0.0 => columns.closes(load, period, written),
        Ok(_) => {
            let message = "`period` must be greater than zero";
            load.push(written.error_here(Code::BAD_VALUE, message).help(such_as));
            false
        }
        Err(error) => {
            let message = format!("`period`: {}", error.message);
            load.push(written.error_here(error.code, message).help(such_as));
            false
        }
    }
}

fn onset(load: &Table) -> Onset {
    let (start, ramp) = (load.quantity("start"), load.quantity_pair("ramp"));
    if load.has("start") && load.has("ramp") {
        load.conflict("ramp", "start");
    }
    match (start, ramp) {
        (_, Some([from, to])) if from < to => Onset::Ramp(from, to),
        (_, Some(_)) => {
            let message = "a `ramp` goes from one time to a later one";
            let help = "such as `ramp = [\"0 s\", \"0.1 s\"]`";
            load.push(load.written("ramp").error_here(Code::BAD_VALUE, message).help(help));
            Onset::Start
        }
        (Some(from), None) => Onset::Step(from),
        (None, None) => Onset::Start,
    }
}
