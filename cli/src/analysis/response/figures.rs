//! Bode and polar plots, and orbits at peaks.

use std::f64::consts::TAU;

use whirl_solver::linear::{LinearMachine, Peak, Point, Vibration, Whirl};
use whirl_text::rounded;

use super::probes::Reading;
use super::source::Source;
use crate::analysis::words;
use crate::figures::{Cloud, Dot, Figure, Label, Line, Mark, Panel, Style};

/// Curves of a panel.
const STYLES: [Style; 4] = [Style::First, Style::Second, Style::Third, Style::Fourth];
/// Orders that a figure shows.
const DRAWN: usize = 4;
/// Peaks nearer than this share of their speed have one label and one orbit.
const ALIKE: f64 = 0.01;
/// Peaks at most, the largest ones, that are drawn more finely and have labels.
const PEAKS: usize = 6;
/// Where a curve is drawn more finely: distances from a peak in half widths.
const FINE: [f64; 12] = [0.12, 0.25, 0.4, 0.55, 0.75, 1.0, 1.3, 1.7, 2.3, 3.2, 4.6, 7.0];
/// Half width over speed of a peak whose amplification is not known.
const WIDE: f64 = 0.05;
/// Speeds that a polar plot names, if they are apart by this share of the largest amplitude.
const NAMED: usize = 6;
const APART: f64 = 0.08;
/// Points of an ellipse.
const POINTS: usize = 72;

/// What figures are drawn from.
pub(super) struct Drawing<'a> {
    pub(super) case: &'a str,
    pub(super) linear: &'a LinearMachine,
    pub(super) of: usize,
    pub(super) points: &'a [Point],
    pub(super) readings: Vec<Reading>,
    /// rad/s.
    pub(super) speeds: &'a [f64],
    /// Those that move anything.
    pub(super) sources: Vec<&'a Source>,
}

/// The unit in which amplitudes (m) up to one are read well, and how many make a metre.
fn unit(most: f64) -> (f64, &'static str) {
    match most {
        own if own >= 1e-3 => (1e3, "mm"),
        own if own >= 1e-7 || own == 0.0 => (1e6, "µm"),
        _ => (1e9, "nm"),
    }
}

/// The largest peaks over the points that are apart, by speed.
fn apart(peaks: &[Vec<Peak>]) -> Vec<Peak> {
    apart_of(&peaks.iter().enumerate().collect::<Vec<_>>()).into_iter().map(|own| own.1).collect()
}

/// The same, each with the point that it is of.
fn apart_of(peaks: &[(usize, &Vec<Peak>)]) -> Vec<(usize, Peak)> {
    let of_point = |(point, all): &(usize, &Vec<Peak>)| {
        let point = *point;
        all.iter().map(move |own| (point, *own)).collect::<Vec<_>>()
    };
    let mut all: Vec<(usize, Peak)> = peaks.iter().flat_map(of_point).collect();
    all.sort_by(|(_, a), (_, b)| b.height.total_cmp(&a.height).then(a.speed.total_cmp(&b.speed)));
    let mut kept: Vec<(usize, Peak)> = Vec::new();
    for own in all {
        let alike = |other: &(usize, Peak)| (other.1.speed / own.1.speed - 1.0).abs() < ALIKE;
        if kept.len() < PEAKS && !kept.iter().any(alike) {
            kept.push(own);
        }
    }
    kept.sort_by(|a, b| a.1.speed.total_cmp(&b.1.speed));
    kept
}

/// Speeds beside the peaks at which curves are drawn more finely (rad/s), within a range.
pub(super) fn beside(peaks: &[Vec<Peak>], range: [f64; 2]) -> Vec<f64> {
    let mut all: Vec<f64> = Vec::new();
    for own in apart(peaks).into_iter().filter(|own| !own.is_undamped()) {
        let share = own.amplification().filter(|own| *own > 0.0);
        let half = 0.5 * share.map_or(WIDE, |own| (1.0 / own).min(WIDE)) * own.speed;
        all.push(own.speed);
        all.extend(FINE.iter().flat_map(|part| [-part, *part].map(|part| own.speed + part * half)));
    }
    all.retain(|own| (range[0]..=range[1]).contains(own));
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

impl Drawing<'_> {
    /// All figures with the names of their files.
    pub(super) fn figures(&self, name: &str) -> Vec<(String, Figure)> {
        let sources = || self.sources.iter().copied().take(DRAWN);
        let of = |title: &str, panels: Vec<Panel>| Figure {
            title: format!("{}: {title}", self.case),
            panels,
            columns: 2,
        };
        let orbits: Vec<Panel> = sources().flat_map(|own| self.orbits(own)).collect();
        if self.speeds.len() == 1 {
            return vec![(name.to_owned(), of("orbits", orbits))];
        }
        let bode = sources().flat_map(|own| self.bode(own)).collect();
        let mut all = vec![(name.to_owned(), of("response", bode))];
        let polar: Vec<Panel> =
            sources().filter(|own| own.order != 0.0).flat_map(|own| self.polar(own)).collect();
        if !polar.is_empty() {
            all.push((format!("{name}.polar"), of("response vectors over speed", polar)));
        }
        if !orbits.is_empty() {
            all.push((format!("{name}.orbits"), of("orbits at peaks", orbits)));
        }
        all
    }

    /// The points that move most, as many as there are styles for, in their order.
    fn largest(&self) -> Vec<usize> {
        let size = |place: usize| {
            let all = self.sources.iter().flat_map(|own| &own.motions);
            all.map(|own| own[place].orbit().major).fold(0.0, f64::max)
        };
        let mut places: Vec<usize> = (0..self.points.len()).collect();
        places.sort_by(|a, b| size(*b).total_cmp(&size(*a)).then(a.cmp(b)));
        places.truncate((STYLES.len() / self.readings.len().max(1)).max(1));
        places.sort_unstable();
        places
    }

    /// Says of which points curves are, if not of all.
    fn of_some(&self) -> String {
        let shown = self.largest().len();
        match shown < self.points.len() {
            true => format!(", {shown} largest of {} points", self.points.len()),
            false => String::new(),
        }
    }

    /// Points whose curves are shown: places, each with what is read there and a style.
    fn shown(&self) -> impl Iterator<Item = (usize, Reading, Style)> + '_ {
        let places = self.largest().into_iter();
        let places = places.flat_map(|place| self.readings.iter().map(move |own| (place, *own)));
        places.zip(STYLES).map(|((place, reading), style)| (place, reading, style))
    }

    fn name(&self, place: usize, reading: Reading) -> String {
        format!("{}{}", self.points[place].name, reading.suffix())
    }

    /// Motions of all points over speed (rad/s), also beside the peaks.
    fn over<'a>(&'a self, source: &'a Source) -> Vec<(f64, &'a [Vibration])> {
        let table = self.speeds.iter().copied().zip(source.motions.iter().map(Vec::as_slice));
        let near = source.near.iter().map(|own| (own.0, own.1.as_slice()));
        let mut all: Vec<(f64, &[Vibration])> = table.chain(near).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    }

    fn axis(&self) -> String {
        format!("speed of {} (rpm)", self.linear.machine().bodies[self.of].name())
    }

    /// Order and body.
    fn what(&self, source: &Source) -> String {
        let body = self.linear.machine().bodies[source.body].name();
        match source.order == 0.0 {
            true => format!("mean position by {body}"),
            false => format!("order {} of {body}", source.order),
        }
    }

    /// Amplitudes over phases.
    fn bode(&self, source: &Source) -> [Panel; 2] {
        let all = self.over(source);
        let most = all.iter().flat_map(|(_, own)| {
            self.shown().map(|(place, reading, _)| reading.amplitude(&own[place]))
        });
        let (scale, unit) = unit(most.fold(0.0, f64::max));
        let curve = |value: &dyn Fn(Reading, &Vibration) -> f64| -> Vec<Line> {
            let line = |(place, reading, style): (usize, Reading, Style)| Line {
                points: all
                    .iter()
                    .map(|(speed, own)| (words::rpm(*speed), value(reading, &own[place])))
                    .collect(),
                style,
                name: self.name(place, reading),
            };
            self.shown().map(line).collect()
        };
        let quantity = match self.readings.as_slice() {
            [Reading::Orbit] => "major semi-axis",
            _ => "probe",
        };
        let mut amplitude = Panel {
            title: self.what(source) + &self.of_some(),
            x: self.axis(),
            y: format!("{quantity} ({unit}, zero to peak)"),
            lines: curve(&|reading, own| scale * reading.amplitude(own)),
            ..Panel::default()
        };
        let dots = match self.readings.as_slice() {
            [Reading::Orbit] => "peaks",
            _ => "at peaks of the major semi-axis",
        };
        for (at, own) in self.peaks(source) {
            let at = (at.0, scale * at.1);
            let speed = rounded(at.0, 5);
            let text = match own.amplification().filter(|own| own.is_finite()) {
                Some(factor) if factor < 1e5 => format!("{speed} rpm, AF {}", rounded(factor, 3)),
                _ if own.is_undamped() => format!("{speed} rpm, undamped"),
                _ => format!("{speed} rpm"),
            };
            amplitude.dots.push(Dot { at, name: dots.to_owned() });
            amplitude.labels.push(Label { at, text });
        }
        let mut phases = curve(&|reading, own| reading.phase(own));
        for (own, sizes) in phases.iter_mut().zip(&amplitude.lines) {
            let most = sizes.points.iter().fold(0.0, |most: f64, own| most.max(own.1));
            let mut sizes = sizes.points.iter();
            // What does not move has no phase.
            own.points.retain(|_| sizes.next().is_some_and(|size| size.1 > STILL * most));
            unwrap(&mut own.points);
        }
        let from = match self.readings.as_slice() {
            [Reading::Orbit] => "phase along x",
            _ => "phase at the probe",
        };
        let phase = Panel {
            title: format!("{from}, from θ = 0"),
            x: self.axis(),
            y: "phase (deg)".to_owned(),
            lines: phases,
            ..Panel::default()
        };
        [amplitude, phase]
    }

    /// Peaks that are apart, each on the curve of its point.
    fn peaks<'a>(&'a self, source: &'a Source) -> impl Iterator<Item = ((f64, f64), Peak)> + 'a {
        let drawn = self.largest();
        let of_drawn: Vec<(usize, &Vec<Peak>)> =
            drawn.into_iter().map(|place| (place, &source.peaks[place])).collect();
        apart_of(&of_drawn).into_iter().filter_map(|(place, own)| {
            let (_, motions) = self.nearest(source, own.speed)?;
            let sizes = self.readings.iter().map(|reading| reading.amplitude(&motions[place]));
            Some(((words::rpm(own.speed), sizes.fold(0.0, f64::max)), own))
        })
    }

    /// Motions at the speed nearest to one.
    fn nearest<'a>(&'a self, source: &'a Source, speed: f64) -> Option<(f64, &'a [Vibration])> {
        let away = |own: &(f64, &[Vibration])| (own.0 - speed).abs();
        self.over(source).into_iter().min_by(|a, b| away(a).total_cmp(&away(b)))
    }

    /// Response vectors over speed, some speeds marked on each.
    fn polar(&self, source: &Source) -> Vec<Panel> {
        let all = self.over(source);
        let last = self.speeds.len() - 1;
        let mut named: Vec<f64> = (0..NAMED).map(|k| self.speeds[k * last / (NAMED - 1)]).collect();
        named.dedup();
        let peaks = apart(&source.peaks);
        let mut panels: Vec<Panel> = Vec::new();
        for (place, reading, _) in self.shown() {
            let length = |own: &[Vibration]| {
                let [re, im] = reading.vector(&own[place]);
                re.hypot(im)
            };
            let (scale, unit) = unit(all.iter().map(|(_, own)| length(own)).fold(0.0, f64::max));
            let at = |own: &[Vibration]| {
                let [re, im] = reading.vector(&own[place]);
                (scale * re, scale * im)
            };
            let along = match reading {
                Reading::Orbit => "x",
                Reading::Probe(_) => "the probe",
            };
            let mut panel = Panel {
                title: format!("{}: {}", self.name(place, reading), self.what(source)),
                x: format!("motion along {along} at θ = 0 ({unit}, zero to peak)"),
                y: format!("a quarter of a period before ({unit})"),
                lines: vec![Line {
                    points: all.iter().map(|(_, own)| at(own)).collect(),
                    style: Style::First,
                    name: "response vector over speed".to_owned(),
                }],
                marks: vec![Mark { x: 0.0, name: String::new() }],
                levels: vec![Mark { x: 0.0, name: String::new() }],
                equal_axes: true,
                ..Panel::default()
            };
            let most = all.iter().map(|(_, own)| at(own)).map(|(re, im)| re.hypot(im));
            let apart = APART * most.fold(0.0, f64::max);
            let mut marked = Vec::new();
            for peak in &peaks {
                let Some((_, own)) = self.nearest(source, peak.speed) else { continue };
                panel.dots.push(Dot { at: at(own), name: "peaks (rpm)".to_owned() });
                label(&mut panel, at(own), peak.speed, apart);
            }
            for &speed in &named {
                let Some((_, own)) = self.nearest(source, speed) else { continue };
                marked.push(at(own));
                label(&mut panel, at(own), speed, apart);
            }
            panel.clouds.push(Cloud {
                points: marked,
                style: Style::First,
                radius: 2.5,
                name: "speeds (rpm)".to_owned(),
            });
            panels.push(panel);
        }
        panels
    }

    /// Orbits of each shown point at the peaks, or at the only speed.
    fn orbits(&self, source: &Source) -> Vec<Panel> {
        let mut speeds: Vec<f64> = match self.speeds {
            [only] => vec![*only],
            _ => {
                let mut all = apart(&source.peaks);
                all.sort_by(|a, b| b.height.total_cmp(&a.height));
                all.truncate(STYLES.len());
                all.iter().map(|own| own.speed).collect()
            }
        };
        speeds.sort_by(f64::total_cmp);
        if speeds.is_empty() || source.order == 0.0 {
            return Vec::new();
        }
        let places = (0..self.points.len()).take(STYLES.len());
        let panel = |place: usize| {
            let sizes = speeds.iter().filter_map(|own| self.nearest(source, *own));
            let sizes = sizes.map(|(_, own)| own[place].orbit().major);
            let (scale, unit) = unit(sizes.fold(0.0, f64::max));
            let mut panel = Panel {
                title: format!("{}: {}", self.points[place].name, self.what(source)),
                x: format!("y ({unit})"),
                y: format!("x ({unit})"),
                equal_axes: true,
                ..Panel::default()
            };
            for (speed, style) in speeds.iter().zip(STYLES) {
                let Some((_, own)) = self.nearest(source, *speed) else { continue };
                let own = &own[place];
                let at = |turn: f64| {
                    let [x, y] = own.at(turn);
                    (scale * y, scale * x)
                };
                let sense = match own.orbit().whirl(*speed) {
                    Whirl::Forward => "forward",
                    Whirl::Backward => "backward",
                    Whirl::None => "in a plane",
                };
                let rpm = rounded(words::rpm(*speed), 5);
                panel.lines.push(Line {
                    points: (0..=POINTS).map(|k| at(TAU * k as f64 / POINTS as f64)).collect(),
                    style,
                    name: format!("{rpm} rpm"),
                });
                panel.dots.push(Dot { at: at(0.0), name: "θ = 0".to_owned() });
                panel.labels.push(Label { at: at(0.0), text: sense.to_owned() });
            }
            panel
        };
        places.map(panel).collect()
    }
}

/// Names the speed (rad/s) at a point, unless another one is named so near.
fn label(panel: &mut Panel, at: (f64, f64), speed: f64, apart: f64) {
    let is_near = |own: &Label| (own.at.0 - at.0).hypot(own.at.1 - at.1) < apart;
    if !panel.labels.iter().any(is_near) {
        panel.labels.push(Label { at, text: rounded(words::rpm(speed), 5).to_string() });
    }
}

/// Share of the largest amplitude below which a point stands still.
const STILL: f64 = 1e-9;

/// Takes jumps of whole turns out of phases (degrees).
fn unwrap(points: &mut [(f64, f64)]) {
    for k in 1..points.len() {
        let turns = ((points[k].1 - points[k - 1].1) / 360.0).round();
        points[k].1 -= 360.0 * turns;
    }
}
