//! Shapes of modes with their orbits, in an oblique view of the axis.

use std::f64::consts::TAU;

use whirl_solver::cache::Cache;
use whirl_solver::linear::{LinearMachine, Mode, Standstill, Vibration, Whirl};

use super::stations::{Along, stations_along};
use super::words;
use crate::case::Case;
use crate::errors::Failure;
use crate::figures::{Cloud, Figure, Line, Panel, Stroke, Style};

/// Stations along a body with a mesh.
const STATIONS: usize = 25;
/// Every so many of them shows its orbit, the first and the last one among them.
const EVERY: usize = 3;
/// Points of an ellipse.
const POINTS: usize = 48;
/// The largest semi-axis over what is seen of the axis.
const LARGEST: f64 = 0.16;
/// What y, which points to the viewer, is seen as: to the left and down, each by this share.
const OBLIQUE: f64 = 0.35;
/// Width over height of the axes of a panel.
const ASPECT: f64 = 1.75;
/// What is seen of an axis on which all stands in one place (m).
const POINT: f64 = 0.1;
/// Share of the motion below which it is along the axis or about it.
const LATERAL: f64 = 0.01;
/// Orbits below this share of the largest are points.
const STILL: f64 = 2e-3;
/// mm.
const MM: f64 = 1e3;

/// A machine seen at stations along its bodies.
pub(super) struct Seen<'a> {
    linear: &'a LinearMachine,
    along: Vec<Along>,
}

/// A place on the paper (mm, along z and up).
type Place = (f64, f64);

impl Seen<'_> {
    /// The machine of a case with its stations.
    ///
    /// # Errors
    /// As the machine's.
    pub(super) fn new<'a>(
        case: &Case,
        linear: &'a LinearMachine,
        cache: Option<&Cache>,
    ) -> Result<Seen<'a>, Failure> {
        Ok(Seen { linear, along: stations_along(case, STATIONS, cache)? })
    }

    /// The shapes of modes in a state, `of` the body whose speed (rad/s) is told.
    pub(super) fn figure(
        &self,
        case: &Case,
        (at, modes): (&Standstill, &[Mode]),
        of: Option<(usize, f64)>,
    ) -> Figure {
        let modes = modes.iter().enumerate();
        let panels = modes.map(|(number, mode)| self.panel(at, number, mode, of));
        let named = of.map_or(String::new(), |(body, speed)| {
            let name = self.linear.machine().bodies[body].name();
            format!(" at {} rpm of {name}", words::speed(speed))
        });
        Figure {
            title: format!("{}: modes{named}", case.name),
            panels: panels.collect(),
            columns: 2,
        }
    }

    fn panel(
        &self,
        at: &Standstill,
        number: usize,
        mode: &Mode,
        of: Option<(usize, f64)>,
    ) -> Panel {
        let motions: Vec<Vec<Vibration>> = self
            .along
            .iter()
            .map(|own| {
                let moved = self.linear.moved(at, (own.body, &own.stations), &mode.shape);
                moved.into_iter().map(|[x, y, _]| Vibration { amplitudes: [x, y] }).collect()
            })
            .collect();
        let sizes = motions.iter().flatten().map(|own| own.orbit().major);
        let most = sizes.fold(0.0, f64::max);
        let bodies = self.linear.machine().bodies.iter();
        let mass: f64 = bodies.map(|own| own.centre_of_mass().mass).sum();
        // Shapes are of unit modal mass: one that moves sideways does so by 1/√m at least.
        let is_lateral = most * most * mass > LATERAL;
        let start =
            motions.iter().flatten().find(|own| own.orbit().major == most).map_or(0.0, start);
        let of_body =
            |own: &Along| own.stations.iter().map(|own| own.position[2]).collect::<Vec<f64>>();
        let levels = || self.along.iter().flat_map(of_body);
        let first = levels().fold(f64::INFINITY, f64::min);
        let last = levels().fold(f64::NEG_INFINITY, f64::max);
        let length = if last - first > 0.0 { last - first } else { POINT };
        let scale = if is_lateral { LARGEST * length / most } else { 0.0 };
        let seen = |z: f64, [x, y]: [f64; 2]| -> Place {
            (MM * (z - OBLIQUE * y), MM * (x - OBLIQUE * y))
        };
        let mut panel = Panel {
            title: title(number, mode, of) + if is_lateral { "" } else { ", along or about z" },
            x: "z (mm); x up, y to the viewer".to_owned(),
            ..Panel::default()
        };
        let speed = of.map_or(1.0, |own| own.1);
        for (place, (along, motions)) in self.along.iter().zip(&motions).enumerate() {
            let name = self.linear.machine().bodies[along.body].name();
            let moved = |z: f64, own: &Vibration, turn: f64| {
                let [x, y] = own.at(start + turn);
                seen(z, [along.axis[0] + scale * x, along.axis[1] + scale * y])
            };
            let stations = || along.stations.iter().map(|own| own.position[2]).zip(motions);
            let axis: Vec<Place> = stations().map(|(z, _)| seen(z, along.axis)).collect();
            panel.lines.push(Line { points: axis, style: Style::Limit, name: "axis".to_owned() });
            let last = motions.len() - 1;
            for (station, (z, own)) in stations().enumerate() {
                let orbit = own.orbit();
                let shown =
                    motions.len() <= STATIONS / 2 || station % EVERY == 0 || station == last;
                if !shown || !is_lateral || orbit.major < STILL * most {
                    continue;
                }
                let (style, name) = match orbit.whirl(speed) {
                    Whirl::Forward => (Style::First, "orbit, forward"),
                    Whirl::Backward => (Style::Second, "orbit, backward"),
                    Whirl::None if speed == 0.0 => (Style::Third, "orbit"),
                    Whirl::None => (Style::Third, "orbit, in a plane"),
                };
                let points = (0..=POINTS).map(|k| moved(z, own, TAU * k as f64 / POINTS as f64));
                panel.strokes.push(Stroke {
                    line: Line { points: points.collect(), style, name: name.to_owned() },
                    width: 1.0,
                });
                panel.clouds.push(Cloud {
                    points: vec![moved(z, own, 0.0)],
                    style: Style::Doubted,
                    radius: 2.2,
                    name: "start of the orbit".to_owned(),
                });
            }
            let style = Style::Body(place as u8);
            // One station is no line.
            if let [own] = motions.as_slice() {
                panel.clouds.push(Cloud {
                    points: vec![moved(along.stations[0].position[2], own, 0.0)],
                    style,
                    radius: 4.0,
                    name: name.to_owned(),
                });
                continue;
            }
            panel.strokes.push(Stroke {
                line: Line {
                    points: stations().map(|(z, own)| moved(z, own, 0.0)).collect(),
                    style,
                    name: name.to_owned(),
                },
                width: 2.0,
            });
        }
        panel.view = Some(view(&panel));
        panel
    }
}

/// The turn at which a motion is largest along x or y, whichever is larger: where the drawn orbits begin.
fn start(own: &Vibration) -> f64 {
    let [x, y] = own.amplitudes;
    if x.norm() >= y.norm() { -x.arg() } else { -y.arg() }
}

/// What stands above a panel.
fn title(number: usize, mode: &Mode, of: Option<(usize, f64)>) -> String {
    let whirl = match of.map(|own| mode.whirl(own.1)) {
        Some(Whirl::Forward) => ", forward",
        Some(Whirl::Backward) => ", backward",
        _ => "",
    };
    let grows = if mode.grows() { ", UNSTABLE" } else { "" };
    format!(
        "{}: {} Hz, δ = {}{whirl}{grows}",
        number + 1,
        words::hertz(mode),
        words::decrement(mode)
    )
}

/// Ends of both axes around all that a panel shows, so that a millimetre has one length on both.
fn view(panel: &Panel) -> [(f64, f64); 2] {
    let lines = panel.lines.iter().chain(panel.strokes.iter().map(|own| &own.line));
    let points = lines.flat_map(|own| &own.points);
    let mut ends = [(f64::INFINITY, f64::NEG_INFINITY); 2];
    for &(u, v) in points {
        for (ends, value) in ends.iter_mut().zip([u, v]) {
            *ends = (ends.0.min(value), ends.1.max(value));
        }
    }
    let [mut half, mut tall] = ends.map(|(least, most)| 0.53 * (most - least));
    (half, tall) = (half.max(ASPECT * tall), tall.max(half / ASPECT));
    let about = |(least, most): (f64, f64), half: f64| {
        let middle = 0.5 * (least + most);
        (middle - half, middle + half)
    };
    [about(ends[0], half), about(ends[1], tall)]
}
