//! Films in time: squeeze with a cavity, oil that is kept, what fast steps do.

use super::{Bench, OMEGA, WIDE as CLEARANCE, film};
use crate::film::{Balance, JournalMotion, Oil};

/// Optasanu and Bonneau, J. Tribol. 122 (2000) 162; Ausas, Jai and Buscaglia, J. Tribol. 131 (2009) 031702: plates that
/// oscillate, ∂(h³ ∂p/∂x)/∂x = 2 ∂(θh)/∂t, p = 0.025 at both ends, h = 0.125 cos 4πt + 0.375. The ordinary differential
/// equation of the cavity's edge, solved to 1e-10: t, edge, load.
const PLATES: [[f64; 3]; 14] = [
    [0.05, 0.5, 1.4506684604027964],
    [0.1, 0.5, 3.543421941410743],
    [0.15, 0.5, 6.567022718312552],
    [0.2, 0.5, 7.516007743784859],
    [0.3, 0.023584368725728534, 0.0003930728120954759],
    [0.35, 0.023682625761044077, 0.00041827291606814075],
    [0.4, 0.026780612834145113, 0.0005343580390568716],
    [0.45, 0.032010139684274824, 0.0007067320391323979],
    [0.5, 0.03908712710189086, 0.0009771781775472716],
    [0.55, 0.04849384328239097, 0.0015375144951022767],
    [0.6, 0.0627768756708675, 0.0033103346531188674],
    [0.65, 0.0907918006030119, 0.012062032356688011],
    [0.7, 0.17693769799835815, 0.0874145116502069],
    [0.75, 0.5, 0.025],
];

#[test]
fn plates_that_oscillate_have_the_cavity_of_the_closed_form() {
    let cells = 400;
    // A ring of length 1 whose ends meet in what is fed; a viscosity of 1/6 makes the equation that of the papers.
    let radius = 1.0 / std::f64::consts::TAU;
    let mut film =
        crate::film::OilFilm::new(super::kind("jfo"), [cells, 3], [radius, 1.0], 0.0).unwrap();
    film.set("mu_0", 1.0 / 6.0).unwrap();
    film.set("sigma", 1e-6).unwrap();
    (0..2).for_each(|end| film.close(end));
    film.supply("ends", -1e-6..1e-6, -0.5..0.5, 0.025).unwrap();
    let (mut oil, mut balance) = (Oil::full(&film), Balance::new(&film));
    let steps = 150;
    let dt = 0.75 / f64::from(steps);
    let gap = |t: f64| 0.125 * (4.0 * std::f64::consts::PI * t).cos() + 0.375;
    let rate = |t: f64| -0.5 * std::f64::consts::PI * (4.0 * std::f64::consts::PI * t).sin();
    balance.motion.per_step = 1.0 / dt;
    balance.before.fill(gap(0.0) + 0.5 * dt * rate(0.0));
    let mut errors: Vec<f64> = Vec::new();
    let mut volume = 0.0;
    for step in 1..=steps {
        let t = dt * f64::from(step);
        balance.motion.gap.fill(gap(t));
        balance.motion.stored_gap.fill(gap(t) + 0.5 * dt * rate(t));
        let changes = balance.solve(&film, &mut oil).unwrap();
        // A front moves by a cell a change: where the cavity closes, through most of the plates.
        assert!(changes < if t < 0.7 { 40 } else { 200 }, "{changes} changes at {t}");
        let before: f64 =
            balance.before.iter().zip(film.grid.areas()).map(|(held, area)| held * area).sum();
        let lost = balance.volume(&film) - before - dt * balance.inflow(&film, 2);
        assert!(lost.abs() < 1e-10 * before, "{lost} of {before} at {t}");
        balance.before.copy_from_slice(&balance.stored[..film.grid.nodes()]);
        volume = balance.volume(&film);
        let Some([_, edge, load]) = PLATES.iter().find(|row| (row[0] - t).abs() < 1e-9) else {
            continue;
        };
        // Of the middle row: half of the nodes that are full, in cells.
        let row = &oil.second[cells..2 * cells];
        let full = row.iter().filter(|second| !**second).count();
        let found = 0.5 * (full as f64 - 1.0) / cells as f64 + 0.5 / cells as f64;
        if *edge < 0.5 {
            errors.push((found - edge) * cells as f64);
        }
        if t < 0.21 {
            let total: f64 = oil.unknowns[0][cells..2 * cells].iter().sum::<f64>() / cells as f64;
            assert!((total / load - 1.0).abs() < 6e-4, "load {total} against {load} at {t}");
        }
    }
    assert!(volume > 0.0);
    // At last it moves by 20 cells a step.
    let closing = errors.pop().unwrap();
    assert!(closing.abs() < 4.0, "{closing}");
    let rms = (errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64).sqrt();
    assert!(rms < 0.7 && errors.iter().all(|error| error.abs() < 1.0), "{errors:?}");
}

/// A journal on a circle, over a hole.
fn circling(phase: f64) -> JournalMotion {
    let (e, whirl) = (0.7 * CLEARANCE, 0.3 * OMEGA);
    JournalMotion {
        displacement: [e * phase.cos(), e * phase.sin()],
        velocity: [-e * whirl * phase.sin(), e * whirl * phase.cos()],
        omega: OMEGA,
        ..JournalMotion::default()
    }
}

#[test]
fn no_oil_is_lost_or_made_in_a_march() {
    let mut film = film("jfo", [60, 7], 0.03, 0.0);
    film.supply("hole", 2.9..3.3, -0.006..0.006, 2e5).unwrap();
    let mut bench = Bench::with(film, CLEARANCE);
    let dt = 1e-4;
    bench.react(&circling(0.0));
    let mut changes = 0;
    let film = bench.journal.film.clone();
    // What nodes hold by the shifted gap, from the steady fill.
    let start = JournalMotion { step: Some(dt), ..circling(0.0) };
    bench.journal.place(&start, &mut bench.balance);
    bench.balance.evaluate(&film, &bench.oil);
    bench.balance.before = bench.balance.held().to_vec();
    let first = bench.balance.volume(&film);
    let mut entered = 0.0;
    let steps = 400;
    for step in 1..=steps {
        let motion =
            JournalMotion { step: Some(dt), ..circling(0.3 * OMEGA * dt * f64::from(step)) };
        bench.journal.place(&motion, &mut bench.balance);
        changes += bench.balance.solve(&film, &mut bench.oil).unwrap();
        entered += dt * (0..3).map(|opening| bench.balance.inflow(&film, opening)).sum::<f64>();
        bench.balance.before = bench.balance.held().to_vec();
    }
    let last = bench.balance.volume(&film);
    let flowed = dt * f64::from(steps) * bench.balance.inflow(&film, 2).abs();
    assert!((last - first - entered).abs() < 1e-10 * first.max(flowed), "{first} {last} {entered}");
    assert!(changes < 6 * steps as usize, "{changes} changes in {steps} steps");
}

#[test]
fn nodes_that_move_faster_than_their_gap_hold_oil_by_the_gap_itself() {
    let mut bench = Bench::with(film("jfo", [48, 5], 0.03, 0.0), CLEARANCE);
    let motion = JournalMotion {
        displacement: [0.9 * CLEARANCE, 0.0],
        velocity: [2.0, 0.0],
        omega: OMEGA,
        step: Some(1e-4),
        ..JournalMotion::default()
    };
    let fast = bench.journal.place(&motion, &mut bench.balance);
    assert!(fast > 0 && fast < bench.journal.film.grid.nodes());
    let own = &bench.balance.motion;
    assert!(own.stored_gap.iter().all(|gap| *gap > 0.0));
    assert_eq!(own.shifted.iter().filter(|shifted| !**shifted).count(), fast);
}
