//! Matrices of small motions for other programs: M, C and K, what acts and what is seen, and the same in states.

mod content;
mod market;
mod mat;
mod npz;

use std::fmt::Write;

use content::Content;
use whirl_solver::linear::{LinearMachine, Standstill};

use super::found::{Found, nothing};
use super::lost::Lost;
use super::speeds::Wanted;
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
    let (mut near, mut lost): (Option<Standstill>, _) = (None, Lost::default());
    let mut text = format!("{}: {}\n", case.name, case.title);
    let (mut files, mut index) = (Vec::new(), String::from("speed_rpm,name\n"));
    let mut done = 0;
    for &speed in &wanted.speeds {
        if interruption.asked() {
            break;
        }
        let speeds = match wanted.of {
            Some(of) => linear.speeds(of, speed, &analysis.ratios),
            None => Vec::new(),
        };
        done += 1;
        let Some(at) = lost.take(speed, linear.standing(&speeds, near.as_ref()))? else { continue };
        let equations = linear.linearised(&at)?;
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
        let size = equations.mass.rows;
        if size > MOST {
            return Err(Failure::Argument {
                message: format!(
                    "matrices over the states of {size} coordinates are too large for a file"
                ),
                help: format!("keep fewer `modes` of the bodies: up to {MOST} coordinates in all"),
            });
        }
        let space = linear.state_space(&at, &equations)?;
        let name =
            if several { format!("{}.{done}", analysis.name) } else { analysis.name.clone() };
        let rpm = words::speed(speed);
        let counts = [size, space.inputs.len(), space.outputs.len()];
        writeln!(
            text,
            "{name} at {rpm} rpm: {} coordinates, {} inputs, {} outputs",
            counts[0], counts[1], counts[2]
        )
        .expect("text can be written");
        writeln!(index, "{},{name}", words::rpm(speed)).expect("text can be written");
        let content = Content::new(linear, &at, &equations, &space);
        files.extend(match analysis.format {
            MatrixFormat::Npz => npz::files(&name, &content),
            MatrixFormat::Market => market::files(&name, &content),
            MatrixFormat::Mat => mat::files(&name, &content),
        });
        near = Some(at);
    }
    let lost = lost.words(near.is_some())?;
    if near.is_none() {
        return Err(nothing());
    }
    if several {
        files.push((format!("{}.csv", analysis.name), index.into_bytes()));
    }
    text.push_str(&lost);
    Ok(Found { text, files, interrupted: done < wanted.speeds.len() })
}
