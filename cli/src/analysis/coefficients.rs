//! Stiffness and damping of joints over speed.

use std::fmt::Write;

use whirl_solver::linear::{JointCoefficients, LinearMachine, Standstill};
use whirl_text::shown;

use super::found::{Found, nothing};
use super::lost::Lost;
use super::speeds::Wanted;
use super::words;
use crate::case::{Analysis, Case};
use crate::errors::Failure;
use crate::report::table;
use crate::signals::Interruption;

/// Columns that the `table` of a bushing reads.
const OF_BUSHING: &str = "speed [rpm],k_xx [N/m],k_xy [N/m],k_yx [N/m],k_yy [N/m],c_xx [N*s/m],c_xy [N*s/m],c_yx [N*s/m],c_yy [N*s/m]\n";

/// Those of every joint at every speed: all in one file, and for each joint one that a bushing reads.
pub(super) fn found(
    case: &Case,
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    interruption: &Interruption,
) -> Result<Found, Failure> {
    let mut near: Option<Standstill> = None;
    let mut lost = Lost::default();
    let mut all = String::from(
        "speed_rpm,joint,eccentricity_ratio,e_x_um,e_y_um,force_x_N,force_y_N,k_xx_N_m,k_xy_N_m,k_yx_N_m,k_yy_N_m,c_xx_Ns_m,c_xy_Ns_m,c_yx_Ns_m,c_yy_Ns_m\n",
    );
    let mut single: Vec<(String, String)> = Vec::new();
    let head = [
        "joint",
        "speed (rpm)",
        "e/c",
        "F_x (N)",
        "F_y",
        "k_xx (N/m)",
        "k_xy",
        "k_yx",
        "k_yy",
        "c_xx (N s/m)",
        "c_xy",
        "c_yx",
        "c_yy",
    ];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
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
        for own in linear.coefficients(&at) {
            let label = own.label.trim_start_matches('_').to_owned();
            let values = values(&own);
            let numbers = values.map(|value| value.to_string()).join(",");
            let ratio = own.eccentricity.map_or(String::new(), |own| own.to_string());
            let [x, y] = own.displacement.map(|own| 1e6 * own);
            let rpm = words::rpm(speed);
            let [f_x, f_y] = own.force;
            writeln!(all, "{rpm},{label},{ratio},{x},{y},{f_x},{f_y},{numbers}")
                .expect("text can be written");
            let mut cells = vec![
                label.clone(),
                words::speed(speed),
                own.eccentricity.map_or("-".to_owned(), |own| format!("{own:.4}")),
            ];
            cells.extend(own.force.map(|value| shown(value, 5, 1e-3..1e6)));
            cells.extend(values.map(|value| format!("{value:.4e}")));
            rows.push(cells);
            if !single.iter().any(|(name, _)| *name == label) {
                single.push((label.clone(), OF_BUSHING.to_owned()));
            }
            let file = single.iter_mut().find(|(name, _)| *name == label);
            let (_, file) = file.expect("it was added");
            writeln!(file, "{rpm},{numbers}").expect("text can be written");
        }
        near = Some(at);
    }
    let lost = lost.words(near.is_some())?;
    if near.is_none() {
        return Err(nothing());
    }
    let name = &analysis.name;
    let mut files = vec![(format!("{name}.csv"), all.into_bytes())];
    let alone =
        |(label, text): (String, String)| (format!("{name}.{label}.csv"), text.into_bytes());
    files.extend(single.into_iter().map(alone));
    let text = format!("{}: {}\n\n{}{lost}", case.name, case.title, table(&rows));
    Ok(Found { text, files, interrupted: done < wanted.speeds.len() })
}

fn values(own: &JointCoefficients) -> [f64; 8] {
    let [k, c] = [own.stiffness, own.damping];
    [k[0][0], k[0][1], k[1][0], k[1][1], c[0][0], c[0][1], c[1][0], c[1][1]]
}
