//! Response to unbalance over speed: orbits of points, peaks and how sharp they are.

mod figures;
mod large;
mod numbers;
mod peaks;
mod played;
mod probes;
mod source;

use std::fmt::Write;

use whirl_solver::Error;
use whirl_solver::linear::{LinearMachine, Peak, Point, Standstill, Vibration};
use whirl_text::{rounded, shown};

use self::figures::{Drawing, beside};
use self::large::Large;
use self::peaks::Over;
use self::probes::Reading;
use self::source::Source;
use super::found::{Found, drawn};
use super::peaked::{left_out, sides};
use super::space::{Pictures, Space};
use super::speeds::Wanted;
use super::states::{Ended, at_each_speed};
use super::words;
use crate::case::{Analysis, Case};
use crate::errors::Failure;
use crate::report::table;
use crate::signals::Interruption;

/// Share of the largest amplitude from which on an order is shown to people.
const MAIN: f64 = 0.01;
/// Share of it below which an order is left out altogether: balls that turn with their cage leave traces at many.
const TRACE: f64 = 1e-4;
/// Share of it from which on peaks of an order are sought between the speeds.
const SOUGHT: f64 = 1e-3;
/// Columns of orbits.
const COLUMNS: &str =
    "speed_rpm,body,order,point,major_um,minor_um,x_um,x_phase_deg,y_um,y_phase_deg\n";

/// The response over the speeds.
pub(super) fn found(
    case: &Case,
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    interruption: &Interruption,
    pictures: Pictures,
) -> Result<Found, Failure> {
    let figures = pictures.figures;
    let of = wanted.of.expect("a body that turns");
    let points = linear.points();
    if points.is_empty() {
        return Err(no_points(case));
    }
    let at = |speed: f64, near: Option<&Standstill>| {
        linear.standing(&linear.speeds(of, speed, &analysis.ratios), near)
    };
    let mut speeds: Vec<f64> = Vec::new();
    let mut sources: Vec<Source> = Vec::new();
    let mut ratios = vec![0.0; linear.machine().bodies.len()];
    let (mut large, mut at_rest, mut singular) = (Large::default(), false, Vec::new());
    let mut work = |speed: f64, here: &Standstill| -> Result<(), Failure> {
        // Another body that stands has no response of its own.
        if !linear.responds_at(here, here.speeds[of]) {
            at_rest = true;
            return Ok(());
        }
        let equations = linear.linearised(here)?;
        let mut sums = vec![0.0; points.len()];
        for body in linear.turning() {
            let all = match linear.response((here, &equations), body, &points) {
                Err(error) if error.is_singular() => {
                    singular.push(words::speed(speed));
                    return Ok(());
                }
                all => all?,
            };
            for (order, motions) in all {
                let place = sources.iter().position(|own| own.body == body && own.order == order);
                let place = place.unwrap_or_else(|| {
                    let (motions, peaks) = (Vec::new(), vec![Vec::new(); points.len()]);
                    sources.push(Source { body, order, motions, peaks, near: Vec::new() });
                    sources.len() - 1
                });
                let seen = linear.seen_by_laws((body, order), &motions);
                let all = sums.iter_mut().zip(&seen);
                all.filter(|_| order != 0.0).for_each(|(sum, own)| *sum += own.orbit().major);
                let own = &mut sources[place];
                own.motions.resize(speeds.len(), still(points.len()));
                own.motions.push(motions);
            }
            if speed != 0.0 {
                ratios[body] = (here.speeds[body] / speed).abs();
            }
        }
        speeds.push(speed);
        large.take(linear, (speed, here), &sums);
        Ok(())
    };
    let Ended { mut notes, mut interrupted } =
        at_each_speed(linear, (analysis, wanted), interruption, &mut work)?;
    if at_rest {
        notes += "note: 0 rpm is left out: a body that turns freely, or is not round, has no response at rest\n";
    }
    if let (true, [speed, ..]) = (speeds.is_empty(), singular.as_slice()) {
        return Err(Failure::Argument {
            message: format!(
                "{speed} rpm is a critical speed without damping: nothing limits the response there"
            ),
            help: "give joints or bodies their damping, or ask for other speeds".to_owned(),
        });
    }
    notes += &left_out(&singular);
    if sources.is_empty() {
        return Err(match wanted.speeds.iter().all(|speed| *speed == 0.0) {
            true => at_rest_only(),
            false => no_sources(case),
        });
    }
    if let ([speed], false) = (speeds.as_slice(), interrupted) {
        let here = at(*speed, None)?;
        let goes_on = || !interruption.asked();
        match linear.modes_while(&linear.linearised(&here)?, 1, &goes_on) {
            Ok(modes) if modes.is_stable() => {}
            Ok(modes) => {
                let words = words::not_stable(linear, &modes).unwrap_or_default();
                notes += &format!("{words}; this response is not reached\n");
            }
            Err(Error::Interrupted) => {
                notes += "note: whether the machine is stable in this state was not looked at\n";
            }
            Err(error) => return Err(error.into()),
        }
    }
    sources.iter_mut().for_each(|own| own.motions.resize(speeds.len(), still(points.len())));
    sources.sort_by(|a, b| a.body.cmp(&b.body).then(a.order.total_cmp(&b.order)));
    let moving = sources.iter().filter(|own| own.order != 0.0).map(Source::size);
    let most = moving.fold(0.0, f64::max);
    sources.retain(|own| own.size() >= TRACE * most);
    if let ([first, .., last], false, [_, _, ..]) =
        (wanted.speeds.as_slice(), interrupted, speeds.as_slice())
    {
        let (of_main, ends) = (largest(&sources), [*first, *last]);
        let over = Over { of, ends, analysis, ratios: &ratios };
        let told = |own: &Source| own.size() >= MAIN * of_main;
        let sought = |own: &Source| own.order != 0.0 && own.size() >= SOUGHT * most;
        let asked = (&sought as &dyn Fn(&Source) -> bool, &told as &dyn Fn(&Source) -> bool);
        notes += &peaks::find(linear, &points, &mut sources, &over, asked, interruption)?;
        let drawn = figures || pictures.space.is_some();
        let shown = |own: &&mut Source| own.order != 0.0 && own.size() >= MAIN * most;
        for source in sources.iter_mut().filter(|own| drawn && shown(own)) {
            let wanted = beside(&source.peaks, ends);
            for speed in wanted.into_iter().take_while(|_| !interruption.asked()) {
                let here = at(speed, None)?;
                let equations = linear.linearised(&here)?;
                let all = linear.response((&here, &equations), source.body, &points)?;
                let mut sums = vec![0.0; points.len()];
                for (order, motions) in all.iter().filter(|own| own.0 != 0.0) {
                    let seen = linear.seen_by_laws((source.body, *order), motions);
                    sums.iter_mut().zip(&seen).for_each(|(sum, own)| *sum += own.orbit().major);
                }
                large.take(linear, (speed, &here), &sums);
                let own = all.into_iter().find(|own| own.0 == source.order);
                source.near.extend(own.map(|own| (speed, own.1)));
            }
        }
    }
    interrupted |= interruption.asked();
    let name = &analysis.name;
    let mut files = vec![
        (format!("{name}.csv"), rows(linear, &points, &speeds, &sources).into_bytes()),
        (format!("{name}.peaks.csv"), peak_rows(linear, &points, &sources).into_bytes()),
    ];
    let near = near_rows(linear, &points, &sources);
    files.extend(near.map(|rows| (format!("{name}.near.csv"), rows.into_bytes())));
    if let Some(angle) = analysis.probe_angle {
        let rows = probes::rows(linear, (&points, angle), &speeds, &sources);
        files.push((format!("{name}.probes.csv"), rows.into_bytes()));
    }
    if figures {
        let drawing = Drawing {
            case: &case.name,
            linear,
            of,
            points: &points,
            readings: Reading::all(analysis.probe_angle),
            speeds: &speeds,
            sources: main(&sources),
        };
        for (stem, figure) in drawing.figures(name) {
            files.extend(drawn(&stem, &figure));
        }
    }
    if let Some(mut space) = pictures.space.map(Space::begin).transpose()?.flatten() {
        played::add((linear, &at), (&speeds, &main(&sources)), interruption, &mut space)?;
        files.extend(space.file(name));
    }
    let notes = notes + &words::doubts(&large.told());
    let text = text((case, linear), &points, (&speeds, &sources), interrupted) + &notes;
    let mut facts = numbers::facts(linear, &points, (&speeds, &sources));
    facts.lines(&notes);
    Ok(Found { text, files, interrupted, facts })
}

/// What keeps a response from being found, as far as a state at one speed shows it.
///
/// # Errors
/// There is nothing that moves, or no point to see it.
pub(super) fn foreseen(
    case: &Case,
    linear: &LinearMachine,
    at: &Standstill,
) -> Result<(), Failure> {
    let points = linear.points();
    if points.is_empty() {
        return Err(no_points(case));
    }
    let equations = linear.linearised(at)?;
    for body in linear.turning() {
        match linear.response((at, &equations), body, &points) {
            Ok(all) if all.is_empty() => {}
            Err(error) if !error.is_singular() => return Err(error.into()),
            _ => return Ok(()),
        }
    }
    Err(no_sources(case))
}

fn no_points(case: &Case) -> Failure {
    Failure::Argument {
        message: format!("`{}` has no point whose response could be given", case.name),
        help: "add an `[output.NAME]` with `quantity = \"displacement\"`".to_owned(),
    }
}

fn at_rest_only() -> Failure {
    Failure::Argument {
        message: "nothing turns at 0 rpm, so that there is no response to unbalance".to_owned(),
        help: "ask for other speeds".to_owned(),
    }
}

fn no_sources(case: &Case) -> Failure {
    Failure::Argument {
        message: format!("no body of `{}` has an unbalance, nor a load that turns with it or goes by halves of its angle", case.name),
        help: "add `unbalance.NAME = { mass = \"1 g\", radius = \"50 mm\", z = \"300 mm\" }` to a body that turns".to_owned(),
    }
}

/// Points that do not move.
fn still(points: usize) -> Vec<Vibration> {
    vec![Vibration::default(); points]
}

fn rows(linear: &LinearMachine, points: &[Point], speeds: &[f64], sources: &[Source]) -> String {
    let mut text = String::from(COLUMNS);
    for source in sources {
        write_rows(
            &mut text,
            (linear, points),
            source,
            speeds.iter().copied().zip(&source.motions),
        );
    }
    text
}

/// The same at speeds beside peaks, if there are some.
fn near_rows(linear: &LinearMachine, points: &[Point], sources: &[Source]) -> Option<String> {
    let mut text = String::from(COLUMNS);
    for source in sources {
        let near = source.near.iter().map(|(speed, motions)| (*speed, motions));
        write_rows(&mut text, (linear, points), source, near);
    }
    (text.len() > COLUMNS.len()).then_some(text)
}

fn write_rows<'a>(
    text: &mut String,
    (linear, points): (&LinearMachine, &[Point]),
    source: &Source,
    all: impl Iterator<Item = (f64, &'a Vec<Vibration>)>,
) {
    let body = linear.machine().bodies[source.body].name();
    for (speed, motions) in all {
        for (point, own) in points.iter().zip(motions) {
            let (orbit, [x, y]) = (own.orbit(), own.amplitudes);
            let [major, minor] = [orbit.major, orbit.minor].map(|own| 1e6 * own);
            writeln!(
                text,
                "{},{body},{},{},{major},{minor},{},{},{},{}",
                words::rpm(speed),
                source.order,
                point.name,
                1e6 * x.norm(),
                x.arg().to_degrees(),
                1e6 * y.norm(),
                y.arg().to_degrees()
            )
            .expect("text can be written");
        }
    }
}

fn peak_rows(linear: &LinearMachine, points: &[Point], sources: &[Source]) -> String {
    let mut text = String::from(
        "body,order,point,speed_rpm,major_um,amplification_factor,half_power_below_rpm,half_power_above_rpm,half_power\n",
    );
    for source in sources {
        let body = linear.machine().bodies[source.body].name();
        for (point, peaks) in points.iter().zip(&source.peaks) {
            for own in peaks {
                let given = |value: Option<f64>| value.map_or(String::new(), |own| own.to_string());
                let [below, above] = own.half_power.map(|speed| given(speed.map(words::rpm)));
                writeln!(
                    text,
                    "{body},{},{},{},{},{},{below},{above},{}",
                    source.order,
                    point.name,
                    words::rpm(own.speed),
                    1e6 * own.height,
                    given(own.amplification()),
                    sides(own)
                )
                .expect("text can be written");
            }
        }
    }
    text
}

fn text(
    (case, linear): (&Case, &LinearMachine),
    points: &[Point],
    (speeds, sources): (&[f64], &[Source]),
    interrupted: bool,
) -> String {
    let mut text = format!("{}: {}\n", case.name, case.title);
    let main: Vec<&Source> = main(sources);
    for source in &main {
        let body = linear.machine().bodies[source.body].name();
        let order = source.order;
        // Over several speeds the mean position is in files and figures.
        if order == 0.0 && speeds.len() > 1 {
            continue;
        }
        let _ = match order == 0.0 {
            true => writeln!(text, "mean position of {body} and what it moves\n"),
            false => writeln!(text, "order {order} of {body}, zero to peak\n"),
        };
        text.push_str(&match speeds.len() {
            1 => orbits(points, source),
            _ => peak_table(points, source, interrupted),
        });
        text.push('\n');
    }
    if main.len() < sources.len() {
        let _ = writeln!(
            text,
            "orders with less than {} % of the largest amplitude are in the files only",
            100.0 * MAIN
        );
    }
    text
}

/// The orders that move anything by a share of what the largest does.
fn main(sources: &[Source]) -> Vec<&Source> {
    let most = largest(sources);
    sources.iter().filter(|own| own.size() >= MAIN * most).collect()
}

/// The largest amplitude of all sources (m).
fn largest(sources: &[Source]) -> f64 {
    sources.iter().map(Source::size).fold(0.0, f64::max)
}

/// What the points do at the only speed.
fn orbits(points: &[Point], source: &Source) -> String {
    let head = ["point", "major semi-axis (um)", "minor", "phase along x (deg)"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for (point, own) in points.iter().zip(source.motions.iter().flatten()) {
        let orbit = own.orbit();
        let axis = |value: f64| shown(1e6 * value, 5, 1e-4..1e7);
        let phase = rounded(own.amplitudes[0].arg().to_degrees(), 4).to_string();
        rows.push(vec![point.name.clone(), axis(orbit.major), axis(orbit.minor), phase]);
    }
    table(&rows)
}

/// Where the points have peaks.
fn peak_table(points: &[Point], source: &Source, interrupted: bool) -> String {
    let head = ["point", "peak (rpm)", "major semi-axis (um)", "amplification factor"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for (point, peaks) in points.iter().zip(&source.peaks) {
        for own in peaks {
            rows.push(vec![point.name.clone(), words::speed(own.speed), height(own), factor(own)]);
        }
    }
    match (rows.len(), interrupted) {
        (1, true) => "no peak was found before the interruption\n".to_owned(),
        (1, false) => "no peak in this range\n".to_owned(),
        _ => table(&rows),
    }
}

/// The height of a peak (µm).
fn height(own: &Peak) -> String {
    match own.is_undamped() {
        true => "undamped".to_owned(),
        false => shown(1e6 * own.height, 5, 1e-4..1e7),
    }
}

/// Its amplification factor, and by which side it is if not by both.
fn factor(own: &Peak) -> String {
    let number = own.amplification().filter(|own| own.is_finite());
    let number = number.map_or("-".to_owned(), |own| rounded(own, 4).to_string());
    match sides(own) {
        side @ ("below" | "above") => format!("{number} (by the side {side})"),
        _ => number,
    }
}
