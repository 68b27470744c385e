//! Response to unbalance over speed: orbits of points, peaks and how sharp they are.

mod figures;
mod large;
mod numbers;
mod probes;
mod source;

use std::fmt::Write;

use whirl_solver::Error;
use whirl_solver::linear::{
    Critical, LinearMachine, Peak, Point, Range, Standstill, Vibration, peak,
};
use whirl_text::{rounded, shown};

use self::figures::{Drawing, beside};
use self::large::Large;
use self::probes::Reading;
use self::source::Source;
use super::found::{Found, drawn};
use super::speeds::Wanted;
use super::states::{Ended, at_each_speed};
use super::words;
use crate::case::{Analysis, Case};
use crate::errors::Failure;
use crate::report::table;
use crate::signals::Interruption;

/// Share of the largest amplitude from which on an order is shown to people.
const MAIN: f64 = 0.01;
/// Peaks nearer than this share of their speed are one.
const SAME: f64 = 1e-5;

/// Share of the largest motion of all points below which one is rounding, and has no peaks.
const STILL: f64 = 1e-9;

/// The response over the speeds.
pub(super) fn found(
    case: &Case,
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    interruption: &Interruption,
    figures: bool,
) -> Result<Found, Failure> {
    let of = wanted.of.expect("a body that turns");
    let points = linear.points();
    if points.is_empty() {
        return Err(Failure::Argument {
            message: format!("`{}` has no point whose response could be given", case.name),
            help: "add an `[output.NAME]` with `quantity = \"displacement\"`".to_owned(),
        });
    }
    let at = |speed: f64, near: Option<&Standstill>| {
        linear.standing(&linear.speeds(of, speed, &analysis.ratios), near)
    };
    let mut speeds: Vec<f64> = Vec::new();
    let mut sources: Vec<Source> = Vec::new();
    let mut ratios = vec![0.0; linear.machine().bodies.len()];
    let (mut large, mut at_rest) = (Large::default(), false);
    let mut work = |speed: f64, here: &Standstill| -> Result<(), Failure> {
        if linear.turning().any(|body| !linear.responds_at(here, here.speeds[body])) {
            at_rest = true;
            return Ok(());
        }
        let equations = linear.linearised(here)?;
        let mut sums = vec![0.0; points.len()];
        for body in linear.turning() {
            for (order, motions) in linear.response((here, &equations), body, &points)? {
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
    if sources.is_empty() {
        return Err(Failure::Argument {
            message: format!("no body of `{}` has an unbalance, nor a load that turns with it", case.name),
            help: "add `unbalance.NAME = { mass = \"1 g\", radius = \"50 mm\", z = \"300 mm\" }` to a body that turns"
                .to_owned(),
        });
    }
    if let ([speed], false) = (speeds.as_slice(), interrupted) {
        let here = at(*speed, None)?;
        if !linear.modes(&linear.linearised(&here)?, 1)?.is_stable() {
            notes += "the machine is NOT STABLE in this state: a motion grows, and this response is not reached\n";
        }
    }
    sources.iter_mut().for_each(|own| own.motions.resize(speeds.len(), still(points.len())));
    sources.sort_by(|a, b| a.body.cmp(&b.body).then(a.order.total_cmp(&b.order)));
    if let ([first, .., last], false) = (speeds.as_slice(), interrupted) {
        let mut is_told = false;
        for source in &mut sources {
            let order = source.order * ratios[source.body];
            if order == 0.0 {
                continue;
            }
            let range = Range {
                of,
                speeds: coarse(&speeds),
                ratios: analysis.ratios.clone(),
                count: analysis.count,
                orders: vec![order],
            };
            let campbell = linear.campbell(&range, &|| !interruption.asked())?;
            if !is_told && campbell.stable.contains(&false) {
                notes += &words::thresholds(&campbell, false);
                notes += "where the machine is not stable this response is not reached: something grows\n";
                is_told = true;
            }
            let seeds = campbell.criticals;
            let own = |place: usize| {
                let mut near: Option<Standstill> = None;
                let mut response = |speed: f64| -> Result<f64, Error> {
                    let here = at(speed, near.as_ref())?;
                    let equations = linear.linearised(&here)?;
                    let point = &points[place..=place];
                    let all = linear.response((&here, &equations), source.body, point)?;
                    near = Some(here);
                    let own = all.iter().find(|own| own.0 == source.order);
                    Ok(own.map_or(0.0, |own| own.1[0].orbit().major))
                };
                peaks(&seeds, [*first, *last], interruption, &mut response)
            };
            let size = |place: usize| {
                let all = source.motions.iter().map(|own| own[place].orbit().major);
                all.fold(0.0, f64::max)
            };
            let most = (0..points.len()).map(size).fold(0.0, f64::max);
            let moved: Vec<bool> = (0..points.len()).map(|own| size(own) > STILL * most).collect();
            let peaks_of = |place: usize| if moved[place] { own(place) } else { Ok(Vec::new()) };
            source.peaks = (0..points.len()).map(peaks_of).collect::<Result<_, Error>>()?;
            let wanted = if figures { beside(&source.peaks, [*first, *last]) } else { Vec::new() };
            for speed in wanted.into_iter().take_while(|_| !interruption.asked()) {
                let here = at(speed, None)?;
                let equations = linear.linearised(&here)?;
                let all = linear.response((&here, &equations), source.body, &points)?;
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
    let notes = notes + &words::doubts(&large.told());
    let text = text(case, linear, &points, (&speeds, &sources)) + &notes;
    let mut facts = numbers::facts(linear, &points, (&speeds, &sources));
    facts.lines(&notes);
    Ok(Found { text, files, interrupted, facts })
}

/// Points that do not move.
fn still(points: usize) -> Vec<Vibration> {
    vec![Vibration::default(); points]
}

/// Some of many speeds, both ends among them.
pub(super) fn coarse(speeds: &[f64]) -> Vec<f64> {
    const MOST: usize = 31;
    let last = speeds.len() - 1;
    let count = speeds.len().min(MOST);
    (0..count).map(|k| speeds[k * last / (count - 1).max(1)]).collect()
}

/// The peaks beside critical speeds.
pub(super) fn peaks(
    seeds: &[Critical],
    range: [f64; 2],
    interruption: &Interruption,
    response: &mut dyn FnMut(f64) -> Result<f64, Error>,
) -> Result<Vec<Peak>, Error> {
    let mut found: Vec<Peak> = Vec::new();
    for seed in seeds.iter().take_while(|_| !interruption.asked()) {
        let width = seed.speed.abs() * seed.mode.damping_ratio().abs().max(1e-6);
        let begin = if range[1] > 0.0 { seed.speed.abs() } else { seed.speed };
        let Some(own) = peak(response, (begin, width), range)? else { continue };
        if found.iter().all(|other| (other.speed / own.speed - 1.0).abs() > SAME) {
            found.push(own);
        }
    }
    found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    Ok(found)
}

fn rows(linear: &LinearMachine, points: &[Point], speeds: &[f64], sources: &[Source]) -> String {
    let mut text = String::from(
        "speed_rpm,body,order,point,major_um,minor_um,x_um,x_phase_deg,y_um,y_phase_deg\n",
    );
    for source in sources {
        let body = linear.machine().bodies[source.body].name();
        for (speed, motions) in speeds.iter().zip(&source.motions) {
            for (point, own) in points.iter().zip(motions) {
                let (orbit, [x, y]) = (own.orbit(), own.amplitudes);
                let [major, minor] = [orbit.major, orbit.minor].map(|own| 1e6 * own);
                writeln!(
                    text,
                    "{},{body},{},{},{major},{minor},{},{},{},{}",
                    words::rpm(*speed),
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
    text
}

fn peak_rows(linear: &LinearMachine, points: &[Point], sources: &[Source]) -> String {
    let mut text = String::from(
        "body,order,point,speed_rpm,major_um,amplification_factor,half_power_below_rpm,half_power_above_rpm\n",
    );
    for source in sources {
        let body = linear.machine().bodies[source.body].name();
        for (point, peaks) in points.iter().zip(&source.peaks) {
            for own in peaks {
                let given = |value: Option<f64>| value.map_or(String::new(), |own| own.to_string());
                let [below, above] = own.half_power.map(|speed| given(speed.map(words::rpm)));
                writeln!(
                    text,
                    "{body},{},{},{},{},{},{below},{above}",
                    source.order,
                    point.name,
                    words::rpm(own.speed),
                    1e6 * own.height,
                    given(own.amplification())
                )
                .expect("text can be written");
            }
        }
    }
    text
}

fn text(
    case: &Case,
    linear: &LinearMachine,
    points: &[Point],
    (speeds, sources): (&[f64], &[Source]),
) -> String {
    let mut text = format!("{}: {}\n", case.name, case.title);
    let main: Vec<&Source> = main(sources);
    for source in &main {
        let body = linear.machine().bodies[source.body].name();
        let order = source.order;
        let _ = match order == 0.0 {
            true => writeln!(text, "mean position of {body} and what it moves\n"),
            false => writeln!(text, "order {order} of {body}, zero to peak\n"),
        };
        text.push_str(&match speeds.len() {
            1 => orbits(points, source),
            _ if order == 0.0 => String::new(),
            _ => peak_table(points, source),
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
    let size = |own: &Source| {
        let all = own.motions.iter().flatten().map(|own| own.orbit().major);
        all.fold(0.0, f64::max)
    };
    let most = sources.iter().map(size).fold(0.0, f64::max);
    sources.iter().filter(|own| size(own) >= MAIN * most).collect()
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
fn peak_table(points: &[Point], source: &Source) -> String {
    let head = ["point", "peak (rpm)", "major semi-axis (um)", "amplification factor"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for (point, peaks) in points.iter().zip(&source.peaks) {
        for own in peaks {
            rows.push(vec![
                point.name.clone(),
                words::speed(own.speed),
                shown(1e6 * own.height, 5, 1e-4..1e7),
                own.amplification().map_or("-".to_owned(), |own| rounded(own, 4).to_string()),
            ]);
        }
    }
    if rows.len() == 1 { "no peak in this range\n".to_owned() } else { table(&rows) }
}
