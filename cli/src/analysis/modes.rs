//! Modes at one speed or a few.

use std::fmt::Write;

use whirl_solver::linear::{LinearMachine, Mode, Standstill};

use super::facts::Facts;
use super::found::{Found, drawn};
use super::shapes::Seen;
use super::space::{Pictures, Told};
use super::speeds::Wanted;
use super::states::{Ended, at_each_speed};
use super::words;
use crate::case::{Analysis, Case};
use crate::errors::Failure;
use crate::report::table;
use crate::signals::Interruption;

/// Speeds whose shapes are drawn at most.
const DRAWN: usize = 12;

/// The modes at each speed, as a table and as a file.
pub(super) fn found(
    case: &Case,
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    interruption: &Interruption,
    pictures: Pictures,
) -> Result<Found, Failure> {
    let mut text = String::new();
    let mut file = String::from(
        "speed_rpm,mode,frequency_hz,damping_ratio,log_decrement,whirl,sense,real_1_s,imaginary_1_s,beside_hz,motion\n",
    );
    let is_drawn = pictures.figures && wanted.speeds.len() <= DRAWN;
    let seen = is_drawn.then(|| Seen::new(case, linear, pictures.cache)).transpose()?;
    let mut in_space = match pictures.space {
        Some(space) => space.begin()?,
        None => None,
    };
    let mut drawings = Vec::new();
    let mut facts = Facts::default();
    let mut work = |speed: f64, at: &Standstill| -> Result<(), Failure> {
        let equations = linear.linearised(at)?;
        let modes = linear.modes_while(&equations, analysis.count, &|| !interruption.asked())?;
        line(&mut text, &format!("{}: {}", case.name, case.title));
        for (body, own) in linear.machine().bodies.iter().enumerate() {
            if at.speeds[body] != 0.0 {
                let told = words::speed(at.speeds[body]);
                line(&mut text, &format!("{} at {told} rpm", own.name()));
            }
        }
        for (name, ratio) in at.eccentricities() {
            if let Some(ratio) = ratio {
                line(&mut text, &format!("eccentricity over clearance {ratio:.3} in {name}"));
            }
        }
        let head = ["mode", "frequency (Hz)", "damping ratio", "log decrement", "whirl", "moves"];
        let mut rows = vec![head.map(str::to_owned).to_vec()];
        for (place, mode) in modes.oscillating.iter().take(analysis.count).enumerate() {
            // Where nothing turns, nothing is forward.
            let whirl = wanted.of.map_or("-", |_| words::whirl(mode, speed));
            let way = linear.way(&equations.turning, &equations.mass, mode)?;
            rows.push(row(linear, place, mode, words::whirl_or_way(whirl, way)));
            let values = [mode.hertz(), mode.damping_ratio(), mode.log_decrement()];
            let values = values.map(|value| value.to_string()).join(",");
            writeln!(
                file,
                "{},{},{values},{},{},{},{},{},{}",
                words::rpm(speed),
                place + 1,
                whirl,
                mode.sense,
                mode.value.re,
                mode.value.im,
                words::beside(mode),
                words::way(way)
            )
            .expect("text can be written");
        }
        text.push('\n');
        text.push_str(&table(&rows));
        if let Some(words) = words::not_stable(linear, &modes) {
            line(&mut text, &words);
        }
        let doubts = linear.doubts(at, &equations, &modes.oscillating)?;
        text.push_str(&words::doubts(&doubts));
        let of = wanted.of.map(|of| (of, speed));
        let listed = &modes.oscillating[..modes.oscillating.len().min(analysis.count)];
        if let Some(space) = &mut in_space {
            for (place, mode) in listed.iter().enumerate() {
                space.mode((linear, at), mode, of, Told::at_speed(linear, of, (place, mode)));
            }
        }
        facts.modes(&modes, analysis.count);
        facts.doubts(&doubts);
        text.push('\n');
        if let Some(seen) = &seen {
            drawings.push(seen.figure(case, (at, listed), of));
        }
        Ok(())
    };
    let Ended { notes, interrupted } =
        at_each_speed(linear, (analysis, wanted), interruption, &mut work)?;
    text.push_str(&notes);
    let name = &analysis.name;
    let mut files = vec![(format!("{name}.csv"), file.into_bytes())];
    for (place, drawing) in drawings.iter().enumerate() {
        let stem = match drawings.len() {
            1 => name.clone(),
            _ => format!("{name}.{}", place + 1),
        };
        files.extend(drawn(&stem, drawing));
    }
    files.extend(in_space.and_then(|own| own.file(name)));
    facts.lines(&notes);
    Ok(Found { text, files, interrupted, facts })
}

fn row(linear: &LinearMachine, place: usize, mode: &Mode, whirl: &str) -> Vec<String> {
    vec![
        (place + 1).to_string(),
        words::hertz(mode),
        words::damping(mode),
        words::decrement(mode),
        whirl.to_owned(),
        words::movers(linear, mode),
    ]
}

fn line(text: &mut String, words: &str) {
    text.push_str(words);
    text.push('\n');
}
