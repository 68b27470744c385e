//! Stability of level I, the least logarithmic decrement of forward modes over cross-coupled stiffness, and of level II.

use whirl_solver::linear::{Mode, Point, Whirl};

use super::lines::{Line, Pass};
use super::model::Model;
use super::standard;
use crate::analysis::words;
use crate::case::{Analysis, Lateral, Stage, StageSource};
use crate::errors::Failure;

/// Values of Q from 0 to 10 Q_A.
const STEPS: usize = 41;
/// Modes that are looked at for forward ones.
const MODES: usize = 24;
/// Halvings of an interval of Q.
const HALVINGS: usize = 60;
/// What a rigid support is (N/m).
const RIGID: f64 = 1e12;

/// What both levels come to.
pub(super) struct Stability {
    /// Q (N/m) and δ; nothing without stages.
    pub(super) curve: Vec<(f64, f64)>,
    /// Q_A (N/m).
    pub(super) expected: f64,
    pub(super) lines: Vec<Line>,
    pub(super) notes: String,
}

/// Where cross-coupled stiffness acts: points, and what share of all each has.
type Across = Vec<(Point, f64)>;

/// Finds both.
///
/// # Errors
/// A stage beyond the bearings without its place; eigenvalues that are not found.
pub(super) fn found(
    model: &Model,
    bare: &Model,
    (analysis, lateral): (&Analysis, &Lateral),
) -> Result<Stability, Failure> {
    let mut all =
        Stability { curve: Vec::new(), expected: 0.0, lines: Vec::new(), notes: String::new() };
    let rpm = words::rpm(lateral.maximum);
    let mut add = |quantity, place: &str, speed, value, limit, unit, pass| {
        all.lines.push(Line {
            variant: String::new(),
            unbalance: String::new(),
            clause: "6.8.5",
            quantity,
            place: place.to_owned(),
            speed,
            value,
            limit,
            unit,
            pass,
        });
    };
    let total: f64 = lateral.stages.iter().map(|own| across(own, lateral.maximum)).sum();
    if lateral.stages.is_empty() {
        all.notes += "note: no `stages`: stability of level I is left out\n";
    } else if !(total > 0.0) {
        all.notes += "note: the stages together have no cross-coupled stiffness that drives a forward whirl: stability of level I is left out\n";
    } else {
        let shares = shares(bare, lateral);
        let decrement = |q: f64| decrement(bare, analysis, (&shares, q));
        let curve: Vec<(f64, Option<f64>)> = (0..STEPS)
            .map(|k| 10.0 * total * k as f64 / (STEPS - 1) as f64)
            .map(|q| Ok((q, decrement(q)?)))
            .collect::<Result<_, Failure>>()?;
        let curve: Vec<(f64, f64)> =
            curve.into_iter().filter_map(|(q, own)| Some((q, own?))).collect();
        for own in &lateral.stages {
            let q = across(own, lateral.maximum);
            add("cross-coupled stiffness q_A", &own.name, Some(rpm), q, None, "N/m", Pass::None);
        }
        add("cross-coupled stiffness Q_A", "", Some(rpm), total, None, "N/m", Pass::None);
        if let Some(expected) = decrement(total)? {
            let pass = if expected >= standard::DECREMENT { Pass::Yes } else { Pass::LevelTwo };
            let limit = Some(standard::DECREMENT);
            add("level I log decrement at Q_A", "", Some(rpm), expected, limit, "1", pass);
        }
        let zero = zero(&curve, &|q| decrement(q))?;
        let ratio = zero.map_or(f64::INFINITY, |own| own / total);
        let shown = ratio.min(standard::RATIOS[1]);
        let pass = if ratio >= standard::RATIOS[0] { Pass::Yes } else { Pass::LevelTwo };
        add(
            "level I Q_0/Q_A (10 for all above)",
            "",
            Some(rpm),
            shown,
            Some(standard::RATIOS[0]),
            "1",
            pass,
        );
        if let Some(density) = lateral.gas_density {
            let machine =
                bare.linear.unsupported(&bare.linear.speeds(bare.of, bare.sense, &analysis.ratios));
            let rigid = bare.linear.undamped(&machine, &[RIGID], analysis.count, &|| true)?;
            let first = rigid.iter().flatten().find(|own| own.mode.sense * bare.sense > 0.1);
            if let Some(first) = first {
                let csr = lateral.maximum / first.speed();
                let boundary = standard::region_boundary(density);
                let is_safe = csr <= boundary || ratio >= standard::RATIOS[1];
                let pass = if is_safe { Pass::Yes } else { Pass::LevelTwo };
                let quantity = "level I critical speed ratio (limit: end of region A)";
                add(quantity, "", Some(words::rpm(first.speed())), csr, Some(boundary), "1", pass);
            }
        } else {
            all.notes += "note: no `gas_density`: regions A and B of the critical speed ratio are left out\n";
        }
        all.curve = curve;
        all.expected = total;
    }
    // What no law of the case stands for goes on to level II.
    let with_stages = lateral.seals.is_empty() && total > 0.0;
    let shares = if with_stages { shares(model, lateral) } else { Vec::new() };
    let q = if with_stages { all.expected } else { 0.0 };
    let mut add = |value: f64| {
        let pass = Pass::of(value >= standard::DECREMENT);
        all.lines.push(Line {
            variant: String::new(),
            unbalance: String::new(),
            clause: "6.8.6",
            quantity: "level II log decrement",
            place: String::new(),
            speed: Some(rpm),
            value,
            limit: Some(standard::DECREMENT),
            unit: "1",
            pass,
        });
    };
    match decrement(model, analysis, (&shares, q))? {
        Some(value) => add(value),
        None => all.notes += "note: no forward mode was found at N_mc: no level II\n",
    }
    Ok(all)
}

/// q of a stage (N/m) at N_mc (rad/s).
fn across(stage: &Stage, speed: f64) -> f64 {
    match stage.source {
        StageSource::Given(own) => own,
        StageSource::Impeller { power, diameter, width, density_ratio } => {
            standard::of_impeller(power, speed, [diameter, width], density_ratio)
        }
        StageSource::Blades { power, diameter, height } => {
            standard::of_blades(power, speed, [diameter, height])
        }
    }
}

/// Stages between the bearings act together, at their middle; those beyond each where it is.
fn shares(model: &Model, lateral: &Lateral) -> Across {
    let [first, last] = model.span();
    let middle = lateral.cross_coupling_z.unwrap_or(0.5 * (first + last));
    let total: f64 = lateral.stages.iter().map(|own| across(own, lateral.maximum)).sum();
    let mut all: Across = Vec::new();
    let mut inside = 0.0;
    for stage in &lateral.stages {
        let share = across(stage, lateral.maximum) / total;
        match stage.z.filter(|z| *z < first || *z > last) {
            Some(z) => all.push((model.station(z).clone(), share)),
            None => inside += share,
        }
    }
    if inside != 0.0 {
        all.push((model.station(middle).clone(), inside));
    }
    all
}

/// The least δ at N_mc with Q of the modes slower than the rotation that do not whirl backward, of the first one where none are; none
/// without any. A slower one that films damp well would hide the one that begins to grow. Where bearings are softer in one direction
/// modes move nearly in a plane, and count.
fn decrement(
    model: &Model,
    analysis: &Analysis,
    (shares, q): (&Across, f64),
) -> Result<Option<f64>, Failure> {
    let across: Vec<(&Point, f64)> = shares.iter().map(|(point, own)| (point, q * own)).collect();
    let at = (&model.at, &model.equations);
    let equations = model.linear.with_stiffness_across(at, model.of, &across);
    let modes = model.linear.modes(&equations, analysis.count.max(MODES))?;
    let speed = model.at.speeds[model.of];
    let forward = || {
        let modes = modes.oscillating.iter();
        modes.filter(|own| own.whirl(speed) != Whirl::Backward && model.moves_across(own))
    };
    let slower = forward().filter(|own| own.value.im < speed.abs());
    let least = slower.map(Mode::log_decrement).min_by(f64::total_cmp);
    Ok(least.or_else(|| forward().next().map(Mode::log_decrement)))
}

/// Q at which δ is zero, within the curve.
fn zero(
    curve: &[(f64, f64)],
    decrement: &dyn Fn(f64) -> Result<Option<f64>, Failure>,
) -> Result<Option<f64>, Failure> {
    if curve.first().is_some_and(|own| own.1 <= 0.0) {
        return Ok(Some(0.0));
    }
    let Some(pair) = curve.windows(2).find(|pair| pair[1].1 <= 0.0) else { return Ok(None) };
    let (mut low, mut high) = (pair[0].0, pair[1].0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match decrement(middle)? {
            Some(own) if own > 0.0 => low = middle,
            _ => high = middle,
        }
    }
    Ok(Some(0.5 * (low + high)))
}
