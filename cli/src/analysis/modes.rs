//! Modes at one speed or a few.

use std::fmt::Write;

use whirl_solver::linear::{LinearMachine, Mode};

use super::found::Found;
use super::lost::Lost;
use super::speeds::Wanted;
use super::words;
use crate::case::{Analysis, Case};
use crate::errors::Failure;
use crate::report::table;

/// The modes at each speed, as a table and as a file.
pub(super) fn found(
    case: &Case,
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
) -> Result<Found, Failure> {
    let mut text = String::new();
    let mut file = String::from(
        "speed_rpm,mode,frequency_hz,damping_ratio,log_decrement,whirl,sense,real_1_s,imaginary_1_s,beside_hz\n",
    );
    let (mut near, mut lost) = (None, Lost::default());
    for &speed in &wanted.speeds {
        let speeds = match wanted.of {
            Some(of) => linear.speeds(of, speed, &analysis.ratios),
            None => Vec::new(),
        };
        let Some(at) = lost.take(speed, linear.standing(&speeds, near.as_ref()))? else { continue };
        let equations = linear.linearised(&at)?;
        let modes = linear.modes(&equations, analysis.count)?;
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
            rows.push(row(linear, place, mode, whirl));
            let values = [mode.hertz(), mode.damping_ratio(), mode.log_decrement()];
            let values = values.map(|value| value.to_string()).join(",");
            writeln!(
                file,
                "{},{},{values},{},{},{},{},{}",
                words::rpm(speed),
                place + 1,
                whirl,
                mode.sense,
                mode.value.re,
                mode.value.im,
                words::beside(mode)
            )
            .expect("text can be written");
        }
        text.push('\n');
        text.push_str(&table(&rows));
        for rate in &modes.growing {
            line(&mut text, &format!("a motion that does not oscillate grows by {rate:.4e} 1/s"));
        }
        if !modes.is_stable() {
            line(&mut text, "the machine is NOT STABLE in this state: a motion grows");
        }
        text.push_str(&words::doubts(&linear.doubts(&at, &equations, &modes.oscillating)?));
        text.push('\n');
        near = Some(at);
    }
    text.push_str(&lost.words(near.is_some())?);
    let files = vec![(format!("{}.csv", analysis.name), file.into_bytes())];
    Ok(Found { text, files, interrupted: false })
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
