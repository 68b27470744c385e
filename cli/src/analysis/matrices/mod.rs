//! Matrices of small motions for other programs: M, C and K, what acts and what is seen, and the same in states.

mod content;
mod market;
mod mat;
mod npz;

use std::fmt::Write;

use content::Content;
use whirl_solver::linear::{LinearMachine, Standstill};

use super::facts::Facts;
use super::found::Found;
use super::speeds::Wanted;
use super::states::{Ended, at_each_speed};
use super::words;
use crate::case::{Analysis, Case, MatrixFormat};
use crate::errors::Failure;
use crate::signals::Interruption;

/// Coordinates beyond which a matrix over the states has more bytes than a file of MATLAB 5 holds of one.
const MOST: usize = 8191;

/// Those at every speed, in files of a format.
pub(super) fn found(
    case: &Case,
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    interruption: &Interruption,
) -> Result<Found, Failure> {
    let several = wanted.speeds.len() > 1;
    let mut text = format!("{}: {}\n", case.name, case.title);
    let (mut files, mut index) = (Vec::new(), String::from("speed_rpm,name\n"));
    let mut work = |speed: f64, at: &Standstill| -> Result<(), Failure> {
        let number = 1 + wanted.speeds.iter().position(|own| *own == speed).unwrap_or(0);
        let equations = linear.linearised(at)?;
        if !equations.stands_in_space() {
            let names = linear.not_round().map(|body| linear.machine().bodies[body].name());
            return Err(Failure::Argument {
                message: format!(
                    "seen from space, the matrices of `{}` vary with the angle of {}, which is not round",
                    case.name,
                    names.collect::<Vec<_>>().join(" and ")
                ),
                help: "make it round, or ask for them at rest, `--speeds \"0 rpm\"`".to_owned(),
            });
        }
        let equations = equations.at_frequency(speed);
        let size = equations.mass.rows;
        if size > MOST {
            return Err(Failure::Argument {
                message: format!(
                    "matrices over the states of {size} coordinates are too large for a file"
                ),
                help: format!("keep fewer `modes` of the bodies: up to {MOST} coordinates in all"),
            });
        }
        let space = linear.state_space(at, &equations)?;
        let name =
            if several { format!("{}.{number}", analysis.name) } else { analysis.name.clone() };
        let rpm = words::speed(speed);
        let counts = [size, space.inputs.len(), space.outputs.len()];
        writeln!(
            text,
            "{name} at {rpm} rpm: {} coordinates, {} inputs, {} outputs",
            counts[0], counts[1], counts[2]
        )
        .expect("text can be written");
        writeln!(index, "{},{name}", words::rpm(speed)).expect("text can be written");
        let content = Content::new(linear, at, &equations, &space);
        files.extend(match analysis.format {
            MatrixFormat::Npz => npz::files(&name, &content),
            MatrixFormat::Market => market::files(&name, &content),
            MatrixFormat::Mat => mat::files(&name, &content),
        });
        Ok(())
    };
    let Ended { notes, interrupted } =
        at_each_speed(linear, (analysis, wanted), interruption, &mut work)?;
    if several {
        files.push((format!("{}.csv", analysis.name), index.into_bytes()));
    }
    text.push_str(&words::at_the_speed(linear));
    text.push_str(&notes);
    let mut facts = Facts::default();
    facts.lines(&(words::at_the_speed(linear) + &notes));
    Ok(Found { text, files, interrupted, facts })
}
