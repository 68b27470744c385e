//! Rings of springs along a bearing: within it, and each at its own place.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};

use super::sets::PLANES;
use crate::case::Bearing;
use crate::machine::wording::mm;

/// Rings stand beyond the ends of a bearing, or beside each other, by at most this part of its length.
const BEYOND: f64 = 1e-3;
/// Places that are nearer to each other than this (m) are one.
const ONE_PLACE: f64 = 1e-6;

/// Where the rings of a bearing may stand.
#[derive(Debug, Clone, Copy)]
pub(in crate::machine) enum Extent {
    /// Between two ends (m).
    Ends([f64; 2]),
    /// In the plane at this z, to this part (m).
    Plane(f64, f64),
    /// Anywhere: the rings say where the bearing is.
    Open,
}

impl Extent {
    /// The plane at `z` of a bearing with this radius, if one is known.
    pub(in crate::machine) fn plane(z: f64, radius: Option<f64>) -> Extent {
        Extent::Plane(z, (PLANES * radius.unwrap_or(0.0)).max(ONE_PLACE))
    }
}

/// Notes stations outside their bearing, and those that another one has taken.
pub(in crate::machine) fn check(bearing: &Bearing, extent: Extent, errors: &mut Diagnostics) {
    let stations = &bearing.stations;
    let from_first = |at: f64| (at - stations[0]).abs();
    let span = match extent {
        Extent::Ends([left, right]) => right - left,
        Extent::Plane(..) => f64::INFINITY,
        Extent::Open => {
            let size = bearing.journal_radius.map_or(0.0, |radius| 2.0 * radius);
            stations.iter().copied().map(from_first).fold(size, f64::max)
        }
    };
    // A plane has room for one ring.
    let apart = (BEYOND * span).max(ONE_PLACE);
    for (place, &z) in stations.iter().enumerate() {
        let at = place_of(bearing, place);
        let mut note = |message: String, help: String| {
            errors.push(at.error_here(Code::BAD_VALUE, message).help(help));
        };
        let taken = stations[..place].iter().find(|other| (*other - z).abs() <= apart);
        match (extent, taken) {
            (Extent::Ends([left, right]), _)
                if (left - z).max(z - right) > BEYOND * (right - left) =>
            {
                let message = format!(
                    "the station at z = {} is {} outside the bearing, which extends from {} to {}",
                    mm(z),
                    mm((left - z).max(z - right)),
                    mm(left),
                    mm(right)
                );
                let help = "write a z between these ends, or correct the position of the bearing";
                note(message, help.to_owned());
            }
            (Extent::Plane(plane, allowed), _) if !((z - plane).abs() <= allowed) => {
                let message = format!(
                    "the station at z = {} is {} off the plane of the bearing at {}",
                    mm(z),
                    mm((z - plane).abs()),
                    mm(plane)
                );
                let help = format!(
                    "write `stations = [\"{}\"]`, or correct the position of the bearing",
                    mm(plane)
                );
                note(message, help);
            }
            (_, Some(other)) => {
                let message = format!(
                    "there is already a ring of springs at z = {}: it would act twice",
                    mm(*other)
                );
                note(message, "take one of them out".to_owned());
            }
            _ => {}
        }
    }
}

/// Where the case says a station, or the bearing.
fn place_of(bearing: &Bearing, station: usize) -> Located {
    let key = format!("stations[{station}]");
    bearing.places.get(&key).unwrap_or(&bearing.table).clone()
}
