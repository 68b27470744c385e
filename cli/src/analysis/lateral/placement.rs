//! Where unbalance stands: at the antinodes of forward modes at N_mc, or where the case says.

use whirl_solver::linear::{AppliedUnbalance, Mode, Point, Vibration, Whirl};

use super::model::Model;
use super::standard;
use crate::analysis::words;
use crate::case::{Analysis, Lateral};
use crate::errors::Failure;

/// Shares of the largest amplitude: below the first a station has no sign, from the second on a lobe between the journals
/// counts, from the third on one beyond them. As ROSS has them (`Rotor.api617_unbalance`).
const SIGNED: f64 = 0.02;
const INBOARD: f64 = 0.1;
const OUTBOARD: f64 = 0.5;
/// Share of its largest amplitude within which a lobe is flat.
const FLAT: f64 = 0.01;
/// Modes by which unbalance is placed where the case names none.
const USUAL: [usize; 2] = [1, 2];
/// Cosine from which on two shapes along the axis are one.
const ALIKE: f64 = 0.9;
/// Modes that are looked at for forward ones.
const MODES: usize = 24;

/// A plane of unbalance.
#[derive(Debug, Clone)]
pub(super) struct Plane {
    /// m.
    pub(super) z: f64,
    /// W (kg).
    pub(super) load: f64,
    /// U_a (kg·m).
    pub(super) moment: f64,
    /// rad.
    pub(super) phase: f64,
    pub(super) point: Point,
}

/// Unbalance that acts at a time.
#[derive(Debug, Clone)]
pub(super) struct Unbalance {
    pub(super) name: String,
    pub(super) planes: Vec<Plane>,
}

impl Unbalance {
    pub(super) fn applied(&self) -> Vec<AppliedUnbalance<'_>> {
        let applied = self.planes.iter().map(|own| AppliedUnbalance {
            point: &own.point,
            moment: own.moment,
            angle: own.phase,
        });
        applied.collect()
    }
}

/// All that is applied, one after the other, and what is said of modes that there are not.
///
/// # Errors
/// No mode by which it could be placed, and none that the case places.
pub(super) fn placed(
    model: &Model,
    analysis: &Analysis,
    lateral: &Lateral,
) -> Result<(Vec<Unbalance>, String), Failure> {
    let rpm = words::rpm(lateral.maximum);
    let plane = |z: f64, load: f64, phase: f64| {
        let amount = standard::factor(lateral.edition) * standard::residual_unbalance(load, rpm);
        Plane { z, load, moment: 1e-6 * amount, phase, point: model.station(z).clone() }
    };
    let mut all: Vec<Unbalance> = Vec::new();
    for own in &lateral.unbalance {
        let planes = own.planes.iter().map(|own| plane(own.z, own.load, own.phase));
        all.push(Unbalance { name: own.name.clone(), planes: planes.collect() });
    }
    let wanted: &[usize] = match (lateral.modes.as_slice(), all.is_empty()) {
        ([], true) => &USUAL,
        (own, _) => own,
    };
    if wanted.is_empty() {
        return Ok((all, String::new()));
    }
    let modes = model.linear.modes(&model.equations, analysis.count.max(MODES))?.oscillating;
    let mut shapes: Vec<Vec<Vibration>> = Vec::new();
    let counts = |own: &&Mode| own.whirl(model.sense) != Whirl::Backward && model.moves_across(own);
    for mode in modes.iter().filter(counts) {
        let motion = |own: &(f64, Point)| model.linear.motion_in(&model.at, &own.1, mode);
        let shape: Vec<Vibration> = model.stations.iter().map(motion).collect();
        // Where bearings are softer in one direction both motions of a pair are nearly in a plane: one of them counts. And so
        // does one of those by which the same unbalance stands at the same places, as modes of what the body stands on.
        let places = signless(antinodes(model, &shape));
        let is_second = mode.whirl(model.sense) == Whirl::None
            && shapes.iter().any(|own| likeness(own, &shape) > ALIKE)
            || shapes.iter().any(|own| signless(antinodes(model, own)) == places);
        if !is_second {
            shapes.push(shape);
        }
    }
    let mut notes = String::new();
    for &number in wanted {
        let Some(shape) = shapes.get(number - 1) else {
            if !lateral.modes.is_empty() {
                notes += &format!(
                    "note: there are {} forward modes at N_mc, no mode {number} by which unbalance could be placed\n",
                    shapes.len()
                );
            }
            continue;
        };
        let found = antinodes(model, shape);
        let [first, last] = model.span();
        let inboard = found.iter().filter(|own| (first..=last).contains(&own.0)).count();
        let load = |z: f64| match z {
            z if z < first => model.overhung[0],
            z if z > last => model.overhung[1],
            _ if inboard == 1 => model.journals.iter().map(|own| own.load).sum(),
            _ => {
                let away = |own: f64| (own - z).abs();
                let nearest = model.journals.iter().min_by(|a, b| away(a.z).total_cmp(&away(b.z)));
                nearest.map_or(0.0, |own| own.load)
            }
        };
        let planes = found.iter().map(|(z, sign)| {
            plane(*z, load(*z), if *sign < 0.0 { std::f64::consts::PI } else { 0.0 })
        });
        all.push(Unbalance { name: format!("mode {number}"), planes: planes.collect() });
    }
    if all.is_empty() {
        return Err(Failure::Argument {
            message: "no forward mode was found at the maximum speed by which unbalance could be placed".to_owned(),
            help: "place it: `unbalance.NAME = { z = [\"500 mm\"], load = [\"40 kg\"] }` in the analysis".to_owned(),
        });
    }
    Ok((all, notes))
}

/// Places with their signs against that of the first.
fn signless(all: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let first = all.first().map_or(1.0, |own| own.1);
    all.into_iter().map(|(z, sign)| (z, first * sign)).collect()
}

/// Cosine between two shapes along the axis, whatever their directions across.
fn likeness(a: &[Vibration], b: &[Vibration]) -> f64 {
    let [a, b] = [a, b].map(|all| {
        let major = |own: &Vibration| own.orbit().major;
        let most = all.iter().max_by(|a, b| major(a).total_cmp(&major(b))).expect("a station");
        let signed = |own: &Vibration| if own.is_opposite(most) { -major(own) } else { major(own) };
        all.iter().map(signed).collect::<Vec<f64>>()
    });
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    product(&a, &b).abs() / (product(&a, &a) * product(&b, &b)).sqrt()
}

/// z of the largest amplitude of each lobe of a shape that counts (m), and its sign against the largest of all.
fn antinodes(model: &Model, shape: &[Vibration]) -> Vec<(f64, f64)> {
    let sizes: Vec<f64> = shape.iter().map(|own| own.orbit().major).collect();
    let mut most = 0;
    for (place, own) in sizes.iter().enumerate() {
        // Of equal ones the first, whatever rounding says.
        if *own > sizes[most] * (1.0 + 1e-9) {
            most = place;
        }
    }
    let sign = |own: &Vibration| if own.is_opposite(&shape[most]) { -1.0 } else { 1.0 };
    let [first, last] = model.span();
    let from_middle = |place: usize| (model.stations[place].0 - 0.5 * (first + last)).abs();
    // Places of each lobe.
    let mut lobes: Vec<(Vec<usize>, f64)> = Vec::new();
    for (place, own) in shape.iter().enumerate() {
        if sizes[place] < SIGNED * sizes[most] {
            continue;
        }
        let own = sign(own);
        match lobes.last_mut() {
            Some((places, side)) if *side == own => places.push(place),
            _ => lobes.push((vec![place], own)),
        }
    }
    // Of a lobe that is flat there the place nearest to the middle, which is no end that carries nothing.
    let top = |places: Vec<usize>| {
        let most = places.iter().map(|own| sizes[*own]).fold(0.0, f64::max);
        let flat = places.into_iter().filter(|own| sizes[*own] >= (1.0 - FLAT) * most);
        flat.min_by(|a, b| from_middle(*a).total_cmp(&from_middle(*b))).expect("the largest")
    };
    let lobes = lobes.into_iter().map(|(places, side)| (top(places), side));
    let counts = |(place, _): &(usize, f64)| {
        let inside = (first..=last).contains(&model.stations[*place].0);
        let least = if inside { INBOARD } else { OUTBOARD };
        sizes[*place] >= least * sizes[most]
    };
    lobes.filter(counts).map(|(place, own)| (model.stations[place].0, own)).collect()
}
