//! Deflection, shear, bending moment, axial force and torque along the bodies of a machine: as it stands, in its response and in
//! its modes.

mod figure;
mod quantities;

use std::collections::BTreeMap;
use std::fmt::Write;

use num_complex::Complex64;
use whirl_solver::cache::Cache;
use whirl_solver::linear::{Along, Excited, LinearMachine, Linearised, Standstill};
use whirl_solver::section::planes;
use whirl_text::{as_given, shown};

use self::quantities::{QUANTITIES, size, values};
use super::facts::Facts;
use super::found::{Found, drawn};
use super::speeds::{self, Wanted};
use super::states::{Ended, at_each_speed};
use super::words;
use crate::case::{Analysis, Case, Form, Mesh, NamedBody};
use crate::errors::Failure;
use crate::machine;
use crate::report::table;
use crate::signals::Interruption;

/// Lines of the table for people: what, of which of the quantities, and its unit.
const SHOWN: [(&str, &[usize], &str); 5] = [
    ("deflection", &[0, 1], "µm"),
    ("shear force", &[3, 4], "N"),
    ("bending moment", &[6, 7], "N·m"),
    ("axial force", &[5], "N"),
    ("torque", &[8], "N·m"),
];
/// The same by the names that programs have for them.
const NUMBERS: [(&str, &[usize]); 5] = [
    ("deflection_um", &[0, 1]),
    ("shear_force_N", &[3, 4]),
    ("bending_moment_Nm", &[6, 7]),
    ("axial_force_N", &[5]),
    ("torque_Nm", &[8]),
];
/// The largest displacement of a mode (m).
const UNIT: f64 = 1e-6;

/// Shares of the largest deflection, and of the largest force, below which an order of a response is none, or is in files only.
const NOTHING: f64 = 1e-6;
const SMALL: f64 = 1e-2;

/// Motions of one kind that are drawn at most.
const DRAWN: usize = 4;

/// Share of the largest force of a body that is rounding of others.
const ROUNDING: f64 = 1e-6;

/// What is seen along bodies, by their names.
type Bodies = Vec<(String, Vec<Along>)>;

/// Motions at a speed by their names, with what is seen along bodies.
type Motions = Vec<(String, Bodies)>;

/// What is drawn of a speed: what stands, responses and modes.
struct Seen {
    speed: f64,
    standing: Bodies,
    responses: Motions,
    modes: Motions,
}

/// The machine with sections along its bodies, and the names of those that have none.
struct Cut {
    linear: LinearMachine,
    whole: Vec<String>,
}

/// What passes the sections at each speed, as a table, files and a figure.
///
/// # Errors
/// As the machine's; none of its bodies can be cut.
pub(super) fn found(
    case: &Case,
    analysis: &Analysis,
    (cache, warnings): (Option<&Cache>, &mut Vec<String>),
    interruption: &Interruption,
    figures: bool,
) -> Result<Found, Failure> {
    let Cut { linear, whole } = cut(case, analysis.stations, (cache, warnings))?;
    let wanted = speeds::wanted(case, &linear, analysis)?;
    let mut files = Files::new();
    let mut text = String::new();
    let gravity = case.machine.field_at_start();
    let mut last: Option<Seen> = None;
    let mut work = |speed: f64, at: &Standstill| -> Result<(), Failure> {
        let equations = linear.linearised(at)?;
        let excited: Vec<Excited> = linear
            .turning()
            .map(|source| linear.excited((at, &equations), source))
            .collect::<Result<_, _>>()?;
        let uneven = excited.iter().find(|own| own.is_of_uneven());
        let standing = bodies(&linear, |body| linear.standing_along(at, body, gravity, uneven));
        text.push_str(&head(case, &linear, at, uneven.is_some()));
        files.stand(speed, &standing);
        let standing = without_rounding(standing);
        text.push_str(&largest(&standing));
        let responses = responses(&linear, (at, &excited), (speed, gravity), &mut files, &mut text);
        let modes =
            modes(&linear, (analysis, &wanted), (speed, at, &equations), &mut files, &mut text)?;
        last = Some(Seen { speed, standing, responses, modes });
        Ok(())
    };
    let Ended { notes, interrupted } =
        at_each_speed(&linear, (analysis, &wanted), interruption, &mut work)?;
    text.push_str(&notes);
    let before = text.len();
    for body in whole {
        let _ = writeln!(text, "note: {body} has no sections, as it is rigid or made of matrices");
    }
    let name = &analysis.name;
    let mut files = files.written(name);
    let mut facts = last.as_ref().map_or(Facts::default(), |own| self::facts(&own.standing));
    if let (true, Some(Seen { speed, standing, responses, modes })) = (figures, last) {
        files.extend(drawn(name, &figure::of(case, speed, &standing)));
        for (word, what, motions) in
            [("response", "what turns with bodies", responses), ("modes", "modes", modes)]
        {
            if !motions.is_empty() {
                let figure = figure::of_motions(case, speed, what, &motions);
                files.extend(drawn(&format!("{name}.{word}"), &figure));
            }
        }
    }
    facts.lines(&text[before..]);
    facts.lines(&notes);
    Ok(Found { text, files, interrupted, facts })
}

/// Plans the machine with planes along every mesh, evenly as far as its cells go, and builds it.
fn cut(
    case: &Case,
    stations: usize,
    (cache, warnings): (Option<&Cache>, &mut Vec<String>),
) -> Result<Cut, Failure> {
    let mut own = case.clone();
    own.fields = None;
    let mut plan = machine::plan(&own, &mut Vec::new())?;
    for body in plan.meshed().filter(|body| !body.rigid) {
        let ends = body.mesh.ends();
        let at = |k: usize| match stations {
            1 => 0.5 * (ends[0] + ends[1]),
            // The last one is the end itself, to the bit.
            _ if k + 1 == stations => ends[1],
            _ => ends[0] + (ends[1] - ends[0]) * k as f64 / (stations - 1) as f64,
        };
        let wanted: Vec<f64> = (0..stations).map(at).collect();
        body.spec.sections = planes(&body.mesh, &wanted);
    }
    let built = machine::build(&own, &plan, cache, warnings)?;
    let bodies = built.machine.bodies.iter();
    let whole: Vec<String> = bodies
        .filter(|own| own.size() > 0 && own.sections().is_empty())
        .map(|own| own.name().to_owned())
        .collect();
    if built.machine.bodies.iter().all(|own| own.sections().is_empty()) {
        return Err(nothing_to_cut(case));
    }
    Ok(Cut { linear: LinearMachine::new(built.machine)?, whole })
}

/// What keeps an analysis from being done, as far as the case shows that.
///
/// # Errors
/// None of the bodies can be cut.
pub(super) fn foreseen(case: &Case) -> Result<(), Failure> {
    let can_be_cut = |own: &NamedBody| match &own.form {
        Form::Meshed(own) => !own.rigid && !matches!(own.body.mesh, Mesh::Matrices(_)),
        Form::Rigid(_) => false,
    };
    match case.machine.bodies.iter().any(can_be_cut) {
        true => Ok(()),
        false => Err(nothing_to_cut(case)),
    }
}

fn nothing_to_cut(case: &Case) -> Failure {
    Failure::Argument {
        message: format!("no body of `{}` can be cut: forces along bodies need a mesh", case.name),
        help: "give a body a mesh, `dimensions` or `sections` in place of its mass or matrices"
            .to_owned(),
    }
}

/// The bodies that have sections, by their places.
fn cut_bodies(linear: &LinearMachine) -> impl Iterator<Item = (usize, &str)> {
    let all = linear.machine().bodies.iter().enumerate();
    all.filter(|(_, own)| !own.sections().is_empty()).map(|(body, own)| (body, own.name()))
}

/// What a function gives of each of these.
fn bodies(linear: &LinearMachine, of: impl Fn(usize) -> Vec<Along>) -> Bodies {
    cut_bodies(linear).map(|(body, name)| (name.to_owned(), of(body))).collect()
}

/// The response to what turns with each body; the largest ones.
fn responses(
    linear: &LinearMachine,
    (at, excited): (&Standstill, &[Excited]),
    (speed, gravity): (f64, [f64; 3]),
    files: &mut Files,
    text: &mut String,
) -> Motions {
    let mut responses: Vec<(&str, f64, Bodies)> = Vec::new();
    for own in excited {
        let name = linear.machine().bodies[own.body()].name();
        let mut orders: BTreeMap<u64, (f64, Bodies)> = BTreeMap::new();
        for (body, other) in cut_bodies(linear) {
            for (order, all) in linear.excited_along(at, own, body, gravity) {
                // Orders are zero or more, and so in the order of their bits.
                let (_, bodies) =
                    orders.entry(order.to_bits()).or_insert_with(|| (order, Vec::new()));
                bodies.push((other.to_owned(), all));
            }
        }
        responses.extend(orders.into_values().map(|(order, all)| (name, order, all)));
    }
    let largest_of = |of: fn(&Along) -> [Complex64; 3]| {
        responses.iter().map(|own| most(&own.2, of)).fold(0.0, f64::max)
    };
    let (moves, passes) = (largest_of(|own| own.displacement), largest_of(|own| own.force));
    let mut largest_ones = Motions::new();
    for (name, order, all) in &responses {
        let moved = most(all, |own| own.displacement) / moves;
        let passed = most(all, |own| own.force) / passes;
        let share = moved.max(passed);
        if share > SMALL {
            let _ = writeln!(text, "amplitudes by what turns with {name}, order {order}");
            let all = without_rounding(all.clone());
            text.push_str(&largest(&all));
            if largest_ones.len() < DRAWN {
                largest_ones.push((format!("{name}, order {order}"), all));
            }
        }
        if share > NOTHING {
            files.response.of(&format!("{},{name},{order}", words::rpm(speed)), all);
        }
    }
    largest_ones
}

/// The modes; the first ones. What cannot be had is noted.
fn modes(
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    (speed, at, equations): (f64, &Standstill, &Linearised),
    files: &mut Files,
    text: &mut String,
) -> Result<Motions, Failure> {
    if !equations.stands_in_space() {
        text.push_str("note: a body that turns is not round: its modes are left out here\n\n");
        return Ok(Motions::new());
    }
    let mut first = Motions::new();
    let modes = linear.modes(equations, analysis.count)?;
    for (place, mode) in modes.oscillating.iter().take(analysis.count).enumerate() {
        let mut all =
            bodies(linear, |body| linear.moving_along(at, body, (mode.value, &mode.shape)));
        let moves = all.iter().flat_map(|(_, own)| own).flat_map(|own| own.displacement);
        let most = moves.fold(
            Complex64::ZERO,
            |most, own| {
                if own.norm() > most.norm() { own } else { most }
            },
        );
        // A mode of rigid bodies alone passes nothing.
        if most == Complex64::ZERO {
            continue;
        }
        for own in all.iter_mut().flat_map(|(_, own)| own) {
            let parts = [&mut own.displacement, &mut own.force, &mut own.moment];
            parts.into_iter().flatten().for_each(|value| *value *= UNIT / most);
        }
        let whirl = wanted.of.map_or("-", |_| words::whirl(mode, speed));
        let (hertz, damping) = (mode.hertz(), mode.damping_ratio());
        let before = format!("{},{},{hertz},{damping},{whirl}", words::rpm(speed), place + 1);
        files.modes.of(&before, &all);
        if first.len() < DRAWN {
            first.push((format!("{} Hz", words::hertz(mode)), all));
        }
    }
    Ok(first)
}

fn head(case: &Case, linear: &LinearMachine, at: &Standstill, is_mean: bool) -> String {
    let mut text = format!("{}: {}\n", case.name, case.title);
    for (body, own) in linear.machine().bodies.iter().enumerate() {
        if at.speeds[body] != 0.0 {
            let _ = writeln!(text, "{} at {} rpm", own.name(), words::speed(at.speeds[body]));
        }
    }
    text.push_str(match is_mean {
        true => "as it stands in the mean over a turn, unbalance left out\n",
        false => "as it stands, unbalance left out\n",
    });
    text
}

/// For people: forces and moments that are rounding of the largest of their body are none.
fn without_rounding(mut all: Bodies) -> Bodies {
    for (_, sections) in &mut all {
        let most = |of: fn(&Along) -> [Complex64; 3]| {
            let every = sections.iter().flat_map(of);
            ROUNDING * every.map(Complex64::norm).fold(0.0, f64::max)
        };
        let bounds = [most(|own| own.displacement), most(|own| own.force), most(|own| own.moment)];
        for own in sections {
            let parts = [&mut own.displacement, &mut own.force, &mut own.moment];
            for (part, bound) in parts.into_iter().zip(bounds) {
                let small = part.iter_mut().filter(|value| value.norm() < bound);
                small.for_each(|value| *value = Complex64::ZERO);
            }
        }
    }
    all
}

/// The largest value of a quantity.
fn most(all: &[(String, Vec<Along>)], of: fn(&Along) -> [Complex64; 3]) -> f64 {
    let every = all.iter().flat_map(|(_, own)| own).flat_map(of);
    every.map(Complex64::norm).fold(0.0, f64::max)
}

/// The largest values along each body, and where they are.
fn largest(all: &[(String, Vec<Along>)]) -> String {
    let mut rows = vec![["body", "largest", "value", "unit", "z (mm)"].map(str::to_owned).to_vec()];
    for (body, sections) in all {
        for (what, which, unit) in SHOWN {
            let sized = sections.iter().map(|own| (size(&values(own), which), own.z));
            let (most, z) =
                sized.fold((0.0, f64::NAN), |most, own| if own.0 > most.0 { own } else { most });
            let z = if most == 0.0 { "-".to_owned() } else { shown(1e3 * z, 6, 1e-3..1e7) };
            let value = shown(most, 5, 1e-4..1e7);
            rows.push(vec![body.clone(), what.to_owned(), value, unit.to_owned(), z]);
        }
    }
    format!("\n{}\n", table(&rows))
}

/// The largest of what stands along each body.
fn facts(all: &[(String, Vec<Along>)]) -> Facts {
    let mut facts = Facts::default();
    for (body, sections) in all {
        for (name, which) in NUMBERS {
            let all = sections.iter().map(|own| size(&values(own), which));
            facts.put(format!("{body}.{name}"), all.reduce(f64::max));
        }
    }
    facts
}

/// Rows of a file, with or without phases.
struct Rows {
    text: String,
}

impl Rows {
    fn new(before: &str, phases: bool) -> Rows {
        let columns = QUANTITIES.map(|(name, unit, _)| match phases {
            true => format!("{name}_{unit},{name}_deg"),
            false => format!("{name}_{unit}"),
        });
        Rows { text: format!("{before},body,z_mm,{}\n", columns.join(",")) }
    }

    /// Amplitudes and phases.
    fn of(&mut self, before: &str, all: &[(String, Vec<Along>)]) {
        let cell = |own: Complex64| format!("{},{}", own.norm(), own.arg().to_degrees());
        self.push(before, all, cell);
    }

    fn push(
        &mut self,
        before: &str,
        all: &[(String, Vec<Along>)],
        cell: impl Fn(Complex64) -> String,
    ) {
        for (body, sections) in all {
            for own in sections {
                let cells = values(own).map(&cell).join(",");
                writeln!(self.text, "{before},{body},{},{cells}", as_given(1e3 * own.z))
                    .expect("text can be written");
            }
        }
    }
}

/// The files of an analysis.
struct Files {
    stands: Rows,
    response: Rows,
    modes: Rows,
}

impl Files {
    fn new() -> Files {
        Files {
            stands: Rows::new("speed_rpm", false),
            response: Rows::new("speed_rpm,of,order", true),
            modes: Rows::new("speed_rpm,mode,frequency_hz,damping_ratio,whirl", true),
        }
    }

    fn stand(&mut self, speed: f64, all: &[(String, Vec<Along>)]) {
        let rpm = words::rpm(speed).to_string();
        self.stands.push(&rpm, all, |own| own.re.to_string());
    }

    fn written(self, name: &str) -> Vec<(String, Vec<u8>)> {
        let more = [("response", self.response), ("modes", self.modes)];
        let more = more.into_iter().filter(|(_, rows)| rows.text.lines().nth(1).is_some());
        let mut files = vec![(format!("{name}.csv"), self.stands.text.into_bytes())];
        files.extend(
            more.map(|(what, rows)| (format!("{name}.{what}.csv"), rows.text.into_bytes())),
        );
        files
    }
}
