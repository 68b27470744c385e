//! Response of probes and close clearances to unbalance: peaks, their margins, and the response scaled to the limit of vibration.

use whirl_solver::Error;
use whirl_solver::linear::{Peak, Peaks, Point, Range, Resonance, Standstill, Vibration};

use super::lines::{Line, Pass};
use super::model::Model;
use super::placement::Unbalance;
use super::standard;
use crate::analysis::peaked::{self, Readings, standing};
use crate::analysis::speeds::Wanted;
use crate::analysis::states::{Ended, at_each_speed};
use crate::analysis::words;
use crate::case::{Analysis, Lateral};
use crate::errors::Failure;
use crate::signals::Interruption;

/// Share by which readings may differ that are equal, and of the largest one that is nothing.
const TIE: f64 = 1e-9;
/// How far phases may turn from one speed to the next (degrees), speeds that are added for it at most, and how near they are (as a
/// share).
const FAR: f64 = 45.0;
const MOST_ADDED: usize = 120;
const CLOSE: f64 = 1e-4;

/// A probe: a point and the direction in which it measures.
#[derive(Debug, Clone)]
pub(super) struct Probe {
    pub(super) name: String,
    pub(super) point: Point,
    /// From x (rad).
    pub(super) angle: f64,
}

impl Probe {
    /// Peak to peak of what it measures (µm).
    fn reading(&self, own: &Vibration) -> f64 {
        2e6 * own.along(self.angle)
    }
}

/// A close clearance.
#[derive(Debug, Clone)]
pub(super) struct Close {
    pub(super) point: Point,
    /// The least diametral one (m).
    pub(super) clearance: f64,
}

/// The response to one unbalance.
pub(super) struct Response {
    pub(super) name: String,
    /// By speeds, by probes: peak to peak (µm).
    pub(super) readings: Vec<Vec<f64>>,
    /// Likewise: φ of A cos(θ + φ) (degrees).
    pub(super) phases: Vec<Vec<f64>>,
    /// By speeds, by close clearances: major axis, peak to peak (µm).
    pub(super) orbits: Vec<Vec<f64>>,
    /// At the peaks, and where phases turn fast: speed (rad/s), and readings, phases and axes there.
    pub(super) between: Vec<(f64, [Vec<f64>; 3])>,
    /// By probes: heights in µm peak to peak.
    pub(super) peaks: Vec<Vec<Peak>>,
    /// S_cc.
    pub(super) scale: f64,
}

/// Responses over speeds.
pub(super) struct Responses {
    /// rad/s.
    pub(super) speeds: Vec<f64>,
    pub(super) all: Vec<Response>,
    pub(super) lines: Vec<Line>,
    pub(super) notes: String,
    pub(super) interrupted: bool,
}

/// Finds them.
///
/// # Errors
/// A machine that stands at none of the speeds, or a critical speed without damping.
pub(super) fn found(
    model: &Model,
    (analysis, lateral): (&Analysis, &Lateral),
    (probes, closes): (&[Probe], &[Close]),
    unbalance: &[Unbalance],
    wanted: &Wanted,
    interruption: &Interruption,
) -> Result<Responses, Failure> {
    let (linear, of) = (&model.linear, model.of);
    let points: Vec<Point> = probes
        .iter()
        .map(|own| &own.point)
        .chain(closes.iter().map(|own| &own.point))
        .cloned()
        .collect();
    let (mut speeds, mut singular) = (Vec::new(), Vec::new());
    let mut all: Vec<Response> = unbalance
        .iter()
        .map(|own| Response {
            name: own.name.clone(),
            readings: Vec::new(),
            phases: Vec::new(),
            orbits: Vec::new(),
            between: Vec::new(),
            peaks: vec![Vec::new(); probes.len()],
            scale: 0.0,
        })
        .collect();
    let read = |motions: &[Vibration]| -> [Vec<f64>; 3] {
        let (first, second) = motions.split_at(probes.len());
        let readings = probes.iter().zip(first).map(|(probe, own)| probe.reading(own));
        let phase =
            |(probe, own): (&Probe, &Vibration)| own.reading(probe.angle).arg().to_degrees();
        let phases = probes.iter().zip(first).map(phase);
        let orbits = second.iter().map(|own| 2e6 * own.orbit().major);
        [readings.collect(), phases.collect(), orbits.collect()]
    };
    let mut work = |speed: f64, here: &Standstill| -> Result<(), Failure> {
        let equations = linear.linearised(here)?;
        let motions = |own: &Unbalance| match speed == 0.0 {
            true => Ok(vec![Vibration::default(); points.len()]),
            false => linear.response_to((here, &equations), of, &own.applied(), &points),
        };
        let moved = match unbalance.iter().map(motions).collect::<Result<Vec<_>, Error>>() {
            Err(error) if error.is_singular() => {
                singular.push(words::speed(speed));
                return Ok(());
            }
            moved => moved?,
        };
        for (motions, response) in moved.iter().zip(&mut all) {
            let [readings, phases, orbits] = read(motions);
            response.readings.push(readings);
            response.phases.push(phases);
            response.orbits.push(orbits);
        }
        speeds.push(speed.abs());
        Ok(())
    };
    let Ended { mut notes, mut interrupted } =
        at_each_speed(linear, (analysis, wanted), interruption, &mut work)?;
    notes += &peaked::left_out(&singular);
    let mut lines = Vec::new();
    if !interrupted {
        let ends = [speeds[0], speeds[speeds.len() - 1]];
        let range = Range {
            of,
            speeds: in_sense(model.sense, &ends),
            ratios: analysis.ratios.clone(),
            count: analysis.count,
            orders: vec![1.0],
        };
        let criticals = linear.resonating(&range, &|| !interruption.asked())?.criticals;
        let resonances: Vec<Resonance> = (criticals.iter().map(Resonance::from))
            .map(|own| Resonance { speed: model.sense * own.speed, ..own })
            .collect();
        let kinds = probes.iter().map(|_| 0).chain(closes.iter().map(|_| 1));
        let kinds: Vec<usize> = kinds.collect();
        for (own, response) in unbalance.iter().zip(&mut all) {
            let applied = own.applied();
            let mut near: Option<Standstill> = None;
            let mut whole = |speed: f64| -> Result<Option<[Vec<f64>; 3]>, Error> {
                if interruption.asked() {
                    return Ok(None);
                }
                let speeds = linear.speeds(of, model.sense * speed, &analysis.ratios);
                let Some(here) = standing(linear.standing(&speeds, near.as_ref()))? else {
                    return Ok(None);
                };
                let equations = linear.linearised(&here)?;
                let moved = linear.response_to((&here, &equations), of, &applied, &points);
                near = Some(here);
                Ok(standing(moved)?.map(|own| read(&own)))
            };
            let mut at = |speed: f64| {
                Ok(whole(speed)?.map(|[readings, _, orbits]| [readings, orbits].concat()))
            };
            let mut readings = Readings::new(kinds.clone(), &mut at);
            let found = (0..kinds.len())
                .map(|place| readings.peaks(place, &resonances, ends))
                .collect::<Result<Vec<Peaks>, Error>>()?;
            let names = probes.iter().map(|own| own.name.as_str());
            let told: Vec<(&str, &Peaks)> = names.zip(&found).collect();
            notes += &peaked::notes(&format!("unbalance {}: ", own.name), &told);
            let mut found: Vec<Vec<Peak>> = found.into_iter().map(|own| own.all).collect();
            let orbits = found.split_off(probes.len());
            response.peaks = found;
            let peaks = response.peaks.iter().chain(&orbits).flatten();
            let mut peaks: Vec<f64> = peaks.map(|own| own.speed).collect();
            peaks.sort_by(f64::total_cmp);
            peaks.dedup();
            for speed in peaks {
                response.between.extend(whole(speed)?.map(|own| (speed, own)));
            }
            follow(response, &speeds, &mut whole)?;
            judge(&mut lines, response, lateral, &speeds, (probes, closes), &orbits);
        }
    }
    interrupted |= interruption.asked();
    Ok(Responses { speeds, all, lines, notes, interrupted })
}

/// Adds speeds to a response where the phase of a probe turns far from one to the next.
fn follow(
    response: &mut Response,
    speeds: &[f64],
    at: &mut dyn FnMut(f64) -> Result<Option<[Vec<f64>; 3]>, Error>,
) -> Result<(), Error> {
    let Response { readings, phases, between, .. } = response;
    let listed = speeds.iter().zip(readings.iter().zip(&*phases));
    let mut known: Vec<(f64, [Vec<f64>; 2])> =
        listed.map(|(speed, (size, phase))| (*speed, [size.clone(), phase.clone()])).collect();
    known.extend(
        between.iter().map(|(speed, [size, phase, _])| (*speed, [size.clone(), phase.clone()])),
    );
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    let turns = |[a, b]: [&[Vec<f64>; 2]; 2]| {
        let both = a[0].iter().zip(&b[0]).zip(a[1].iter().zip(&b[1]));
        both.filter(|(sizes, _)| *sizes.0 > 0.0 && *sizes.1 > 0.0).any(|(_, (from, to))| {
            let turn = (to - from).rem_euclid(360.0);
            turn.min(360.0 - turn) > FAR
        })
    };
    let (mut k, mut added) = (0, 0);
    while k + 1 < known.len() && added < MOST_ADDED {
        let [(from, first), (to, second)] = [&known[k], &known[k + 1]];
        let middle = 0.5 * (from + to);
        let found = match to - from > CLOSE * to && turns([first, second]) {
            true => at(middle)?,
            false => None,
        };
        match found {
            Some(own) => {
                known.insert(k + 1, (middle, [own[0].clone(), own[1].clone()]));
                between.push((middle, own));
                added += 1;
            }
            None => k += 1,
        }
    }
    Ok(())
}

/// Speeds that are counted in the sense of the rotation, rising along the axis.
fn in_sense(sense: f64, speeds: &[f64]) -> Vec<f64> {
    let mut all: Vec<f64> = speeds.iter().map(|own| sense * own).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// The largest of a response within speeds, with the speed of it: of those that were looked at, and of peaks.
fn largest(
    [low, high]: [f64; 2],
    speeds: &[f64],
    of: &dyn Fn(usize) -> f64,
    peaks: &[Peak],
) -> (f64, f64) {
    let inside = |speed: f64| (low..=high).contains(&speed);
    let looked = speeds.iter().enumerate().map(|(place, speed)| (*speed, of(place)));
    let peaks = peaks.iter().map(|own| (own.speed, own.height));
    let all = looked.chain(peaks).filter(|own| inside(own.0));
    all.fold((low, 0.0), |most, own| if own.1 > most.1 { own } else { most })
}

/// Lines of one unbalance, and its scale factor.
fn judge(
    lines: &mut Vec<Line>,
    response: &mut Response,
    lateral: &Lateral,
    speeds: &[f64],
    (probes, closes): (&[Probe], &[Close]),
    orbits: &[Vec<Peak>],
) {
    let name = response.name.clone();
    let rpm = words::rpm(lateral.maximum);
    let mut add = |clause, quantity, place: &str, speed: Option<f64>, value, limit, unit, pass| {
        lines.push(Line {
            variant: String::new(),
            unbalance: name.clone(),
            clause,
            quantity,
            place: place.to_owned(),
            speed: speed.map(words::rpm),
            value,
            limit,
            unit,
            pass,
        });
    };
    for (probe, peaks) in probes.iter().zip(&response.peaks) {
        for own in peaks {
            let Some(factor) = own.amplification() else { continue };
            let (at, speed) = (probe.name.as_str(), own.speed);
            let is_inside = (lateral.minimum..=lateral.maximum).contains(&speed);
            let critical = factor >= standard::CRITICAL;
            let (limit, pass) = match is_inside {
                true => (Some(standard::CRITICAL), Pass::of(!critical)),
                false => (None, Pass::None),
            };
            add("6.8.2.1", "amplification factor", at, Some(speed), factor, limit, "1", pass);
            if !critical || is_inside {
                continue;
            }
            let (actual, required) = match speed < lateral.minimum {
                true => (1.0 - speed / lateral.minimum, standard::margin_below(factor)),
                false => (speed / lateral.maximum - 1.0, standard::margin_above(factor)),
            };
            let pass = Pass::of(100.0 * actual >= required);
            add(
                "6.8.2.10",
                "separation margin",
                at,
                Some(speed),
                100.0 * actual,
                Some(required),
                "%",
                pass,
            );
        }
    }
    let range = [lateral.minimum, lateral.maximum];
    let mut most: (f64, f64, &str) = (lateral.minimum, 0.0, "");
    for (place, probe) in probes.iter().enumerate() {
        let own =
            largest(range, speeds, &|at| response.readings[at][place], &response.peaks[place]);
        // Of equal ones, as those of a symmetric rotor, the first.
        if own.1 > most.1 * (1.0 + TIE) {
            most = (own.0, own.1, &probe.name);
        }
    }
    let (speed, reading, at) = most;
    let limit = standard::vibration_limit(rpm);
    let pass = Pass::of(reading <= limit);
    add(
        "6.8.2.10",
        "probe vibration A_max",
        at,
        Some(speed),
        reading,
        Some(limit),
        "um pk-pk",
        pass,
    );
    let scale = (limit / reading).min(lateral.scale_limit);
    response.scale = scale;
    add("6.8.2.11", "scale factor S_cc", "", None, scale, None, "1", Pass::None);
    for (place, (close, peaks)) in closes.iter().zip(orbits).enumerate() {
        let own = largest([0.0, lateral.trip], speeds, &|at| response.orbits[at][place], peaks);
        let moves = own.1 > TIE * reading;
        let allowed = standard::CLEARANCE * 1e6 * close.clearance;
        // No scale makes what grows without limit small.
        let value = if own.1.is_finite() { scale * own.1 } else { own.1 };
        let pass = Pass::of(value < allowed);
        let quantity = "scaled response at clearance";
        add(
            "6.8.2.11",
            quantity,
            &close.point.name,
            moves.then_some(own.0),
            if moves { value } else { 0.0 },
            Some(allowed),
            "um pk-pk",
            pass,
        );
    }
}
