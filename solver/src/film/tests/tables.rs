//! Steady bearings: published tables and closed forms.

use std::f64::consts::PI;

use super::{Bench, CLEARANCE, OMEGA, RADIUS, VISCOSITY, close, film, sommerfeld, turning};
use crate::film::{JournalMotion, OilFilm};

/// Raimondi and Boyd, ASLE Trans. 1 (1958) 159-209, recomputed with their own conditions on 96 × 16 and 192 × 32 and
/// extrapolated: L/D, ε, S, attitude angle (deg), P/p_max.
const RAIMONDI_BOYD: [[f64; 5]; 18] = [
    [1.0, 0.1, 1.3297514673225934, 79.41123124493157, 0.5400172794199952],
    [1.0, 0.2, 0.6317699971643594, 73.85558261485416, 0.5281819192596123],
    [1.0, 0.4, 0.2603884188652401, 62.56622095867963, 0.48247547699965626],
    [1.0, 0.6, 0.12094077283759264, 50.529934366147806, 0.414289071087341],
    [1.0, 0.8, 0.04455307010715715, 36.223074112100726, 0.3199074177180972],
    [1.0, 0.9, 0.018825543989106897, 26.48029557989781, 0.24739968676407456],
    [0.5, 0.1, 4.326135901682857, 81.75544847842632, 0.5228692954919213],
    [0.5, 0.2, 2.0317878796220823, 75.13111262654915, 0.5036962588460548],
    [0.5, 0.4, 0.7853979240635097, 61.771055170865345, 0.4423683096174467],
    [0.5, 0.6, 0.31930519865348933, 48.04902339607997, 0.366626072479763],
    [0.5, 0.8, 0.09168690358296187, 32.9208985813303, 0.2738316710594379],
    [0.5, 0.9, 0.031249341925823886, 23.567987550277035, 0.20857523386079505],
    [0.25, 0.1, 16.223268211804875, 82.46546530984642, 0.5153727872013348],
    [0.25, 0.2, 7.5780323718984945, 75.37379098304892, 0.49011737331340677],
    [0.25, 0.4, 2.8409834077430616, 61.18982925827023, 0.4169883510823087],
    [0.25, 0.6, 1.07786789363327, 46.8156215349531, 0.3344399458771235],
    [0.25, 0.8, 0.26337181148126376, 31.25807283490617, 0.24081637661869115],
    [0.25, 0.9, 0.07366880436132806, 21.79128401248158, 0.17934041044343205],
];

/// Fed along a line at the widest gap, as the tables have it.
fn fed(name: &str, nodes: [usize; 2], length: f64) -> OilFilm {
    let mut film = film(name, nodes, length, 0.0);
    let half = PI / nodes[0] as f64;
    let line = PI - half..PI + half;
    film.supply("groove", line, -length / 2.0..length / 2.0, 0.0).unwrap();
    film
}

#[test]
fn full_bearings_are_those_of_raimondi_and_boyd() {
    for (nodes, number, most_eccentric) in [([96, 9], 0.01, 0.01), ([72, 7], 0.01, 0.015)] {
        for [ratio, eps, s, attitude, peak] in RAIMONDI_BOYD {
            let length = 2.0 * RADIUS * ratio;
            let mut bench = Bench::new(fed("jfo", nodes, length));
            let forces = bench.react(&turning(eps)).forces;
            let [found, angle] = sommerfeld([forces[0], forces[1]], length);
            let what = format!("L/D {ratio}, ε {eps}, {nodes:?}");
            let tolerance = if eps > 0.85 { most_eccentric } else { number };
            close(found, s, tolerance, &format!("{what}: S"));
            assert!((angle - attitude).abs() < 0.5, "{what}: {angle}° against {attitude}°");
            let load = forces[0].hypot(forces[1]);
            let share = load / (2.0 * RADIUS * length) / bench.p_max();
            close(share, peak, 0.02, &format!("{what}: P/p_max"));
            // What tilts and turns: nothing tilts, and the turn is braked.
            assert!(forces[2].abs().max(forces[3].abs()) < 1e-9 * load * length);
            assert!(forces[4] < 0.0);
        }
    }
}

/// Butenschön, as below: what leaves at both ends, in R³ ψ ω, over ε for B/D = 1, ½, ¼.
const SIDE_FLOW: [[f64; 4]; 7] = [
    [0.1, 0.1603, 0.0939, 0.0492],
    [0.3, 0.4765, 0.2816, 0.1476],
    [0.5, 0.7852, 0.4694, 0.2460],
    [0.7, 1.0888, 0.6578, 0.3446],
    [0.8, 1.2392, 0.7529, 0.3940],
    [0.9, 1.3898, 0.8453, 0.4436],
    [0.95, 1.4655, 0.8984, 0.4687],
];

#[test]
fn side_flow_is_what_enters_and_that_of_butenschoen() {
    for [eps, flows @ ..] in SIDE_FLOW {
        for (ratio, flow) in [1.0, 0.5, 0.25].into_iter().zip(flows) {
            let length = 2.0 * RADIUS * ratio;
            let mut bench = Bench::new(fed("jfo", [96, 9], length));
            bench.react(&turning(eps));
            let film = &bench.journal.film;
            let [left, right, groove] =
                [0, 1, 2].map(|opening| bench.balance.inflow(film, opening));
            let unit = RADIUS.powi(2) * CLEARANCE * OMEGA;
            let what = format!("B/D {ratio}, ε {eps}");
            close(-(left + right) / unit, flow, 0.01, &what);
            assert!((left + right + groove).abs() < 1e-9 * groove.abs(), "{what}");
            assert!(left <= 0.0 && right <= 0.0 && groove > 0.0, "{what}");
        }
    }
}

#[test]
fn friction_of_a_full_film_is_that_of_the_tables() {
    // (R/c) f of Raimondi and Boyd, whose oil is sheared all around.
    for (ratio, eps, friction) in
        [(1.0, 0.4, 5.79), (1.0, 0.6, 3.22), (1.0, 0.8, 1.7), (0.5, 0.6, 8.10), (0.25, 0.8, 8.80)]
    {
        let length = 2.0 * RADIUS * ratio;
        let mut film = fed("jfo", [96, 9], length);
        film.set("streamers", 0.0).unwrap();
        let mut bench = Bench::new(film);
        let forces = bench.react(&turning(eps)).forces;
        let load = forces[0].hypot(forces[1]);
        let found = -forces[4] / RADIUS / load * RADIUS / CLEARANCE;
        close(found, friction, 0.01, &format!("L/D {ratio}, ε {eps}: friction"));
        // What is lost is the work of the couple on the journal less that of the force that does not move.
        close(bench.outputs[0], -forces[4] * OMEGA, 0.01, "loss");
    }
}

/// Butenschön, dissertation, Karlsruhe 1976, as quoted in inst/mbdyn_post_ehd_load_output_02.tst of mboct-mbdyn-pkg
/// (75d5ae6): So = F ψ²/(B D η ω) over ε for B/D = 1, ½, ¼.
const BUTENSCHOEN: [[f64; 4]; 7] = [
    [0.1, 0.1196, 0.0368, 0.0098],
    [0.2, 0.2518, 0.0783, 0.0210],
    [0.5, 0.8903, 0.3124, 0.0888],
    [0.7, 2.0432, 0.8595, 0.2708],
    [0.8, 3.5663, 1.7339, 0.6043],
    [0.9, 8.4352, 5.0881, 2.1595],
    [0.95, 18.7895, 13.3083, 6.9248],
];

#[test]
fn turning_journals_are_those_of_butenschoen() {
    for [eps, rows @ ..] in BUTENSCHOEN {
        for (ratio, expected) in [1.0, 0.5, 0.25].into_iter().zip(rows) {
            let length = 2.0 * RADIUS * ratio;
            let mut bench = Bench::new(fed("reynolds", [96, 9], length));
            let forces = bench.react(&turning(eps)).forces;
            let [s, _] = sommerfeld([forces[0], forces[1]], length);
            // His numbers have four digits or two.
            let digits = 0.5e-4 / expected;
            close(1.0 / (2.0 * PI * s), expected, 0.012 + digits, &format!("B/D {ratio}, ε {eps}"));
        }
    }
}

/// The same of journals that move along their eccentricity: So = F ψ²/(B D η ε̇). (B/D 1/2, ε 0.1 is misprinted there.)
const SQUEEZE: [[f64; 4]; 7] = [
    [-0.9, 0.5518, 0.1466, 0.0376],
    [-0.5, 0.9710, 0.2664, 0.0688],
    [0.0, 2.4076, 0.7224, 0.1919],
    [0.3, 5.0479, 1.6904, 0.4675],
    [0.5, 9.7319, 3.6750, 1.0715],
    [0.8, 50.349, 26.676, 9.6161],
    [0.9, 160.25, 104.75, 46.559],
];

#[test]
fn squeezed_journals_are_those_of_butenschoen() {
    for [eps, rows @ ..] in SQUEEZE {
        for (ratio, expected) in [1.0, 0.5, 0.25].into_iter().zip(rows) {
            let length = 2.0 * RADIUS * ratio;
            let mut bench = Bench::new(film("reynolds", [96, 9], length, 0.0));
            let rate = 40.0;
            let motion = JournalMotion {
                displacement: [eps * CLEARANCE, 0.0],
                velocity: [rate * CLEARANCE, 0.0],
                ..JournalMotion::default()
            };
            let forces = bench.react(&motion).forces;
            assert!(forces[1].abs() < 1e-9 * forces[0].abs());
            let psi = CLEARANCE / RADIUS;
            let found = -forces[0] * psi * psi / (2.0 * RADIUS * length * VISCOSITY * rate);
            close(found, expected, 0.005, &format!("B/D {ratio}, ε {eps}"));
        }
    }
}

/// A film so long that nothing flows along it, fed at the widest gap with a pressure.
fn long(nodes: usize, pressure: f64) -> OilFilm {
    let mut film = film("jfo", [nodes, 3], RADIUS, 0.0);
    (0..2).for_each(|end| film.close(end));
    let half = PI / nodes as f64;
    film.supply("line", PI - half..PI + half, -RADIUS..RADIUS, pressure).unwrap_err();
    film.supply("line", PI - half..PI + half, -RADIUS / 2.0..RADIUS / 2.0, pressure).unwrap();
    film
}

#[test]
fn a_long_film_without_a_cavity_is_that_of_sommerfeld() {
    // W = 12 π μ ω R L (R/c)² ε/((2 + ε²)√(1 − ε²)), across the eccentricity; second order in the distance of nodes.
    let error = |nodes: usize, eps: f64| {
        let mut bench = Bench::new(long(nodes, 1e13));
        let forces = bench.react(&turning(eps)).forces;
        assert!(bench.oil.second.iter().all(|second| !second));
        let scale = VISCOSITY * OMEGA * RADIUS * RADIUS * (RADIUS / CLEARANCE).powi(2);
        let exact = 12.0 * PI * scale * eps / ((2.0 + eps * eps) * (1.0 - eps * eps).sqrt());
        assert!(forces[0].abs() < 0.02 * exact);
        (forces[1].abs() / exact - 1.0).abs()
    };
    for (eps, most) in [(0.2, 1.2e-3), (0.6, 1e-3), (0.9, 2e-3)] {
        let errors = [72, 144].map(|nodes| error(nodes, eps));
        assert!(errors[0] < most, "ε {eps}: {errors:?}");
        let order = (errors[0] / errors[1]).log2();
        assert!((order - 2.0).abs() < 0.15, "ε {eps}: order {order} of {errors:?}");
    }
}

#[test]
fn long_films_rupture_where_the_closed_form_says() {
    // By quadrature of Reynolds' condition: ε, S, attitude angle, P/p_max.
    for [eps, s, attitude, peak] in [
        [0.2, 0.12373275758502215, 66.89943670000142, 0.8132372070257395],
        [0.4, 0.06289103403126567, 61.63844275173867, 0.7622738175276894],
        [0.6, 0.03894934628618707, 54.23389959752418, 0.6669765787500554],
        [0.8, 0.02110349076771723, 42.180955760855944, 0.49831376783701986],
        [0.9, 0.011510681904783994, 31.66653589994185, 0.3585177183574106],
    ] {
        let mut bench = Bench::new(long(144, 0.0));
        let forces = bench.react(&turning(eps)).forces;
        let [found, angle] = sommerfeld([forces[0], forces[1]], RADIUS);
        close(found, s, 2e-3, &format!("ε {eps}: S"));
        assert!((angle - attitude).abs() < 0.1, "ε {eps}: {angle}° against {attitude}°");
        let load = forces[0].hypot(forces[1]);
        close(
            load / (2.0 * RADIUS * RADIUS) / bench.p_max(),
            peak,
            2e-3,
            &format!("ε {eps}: P/p_max"),
        );
    }
}

#[test]
fn a_starved_film_forms_where_oil_suffices() {
    // By quadrature: ε 0.8, fed without pressure by a line whose edge downstream lies 10° behind the narrowest gap: load 0.650666
    // and peak 2.046606 in μ ω R L (R/c)² and μ ω (R/c)². The edge of what is fed lies half a distance beyond its last node.
    let mut errors = Vec::new();
    for nodes in [180, 360] {
        let spacing = 2.0 * PI / nodes as f64;
        let first = 10f64.to_radians() - 0.5 * spacing;
        let mut film = film("jfo", [nodes, 3], RADIUS, first);
        (0..2).for_each(|end| film.close(end));
        let edge = first + 0.5 * spacing;
        let z = -RADIUS / 2.0..RADIUS / 2.0;
        film.supply("line", edge - 1.01 * spacing..edge, z, 0.0).unwrap();
        let mut bench = Bench::new(film);
        let forces = bench.react(&turning(0.8)).forces;
        let unit = VISCOSITY * OMEGA * RADIUS * RADIUS * (RADIUS / CLEARANCE).powi(2);
        let load = forces[0].hypot(forces[1]) / unit;
        errors.push((load / 0.650666 - 1.0).abs());
        let peak = bench.p_max() / (VISCOSITY * OMEGA * (RADIUS / CLEARANCE).powi(2));
        close(peak, 2.046606, 2e-2, "peak");
    }
    // The flow is that of the gap at the edge, which is a tenth of the widest: of second order.
    assert!(errors[0] < 1e-2 && errors[1] < 2.5e-3, "{errors:?}");
    let order = (errors[0] / errors[1]).log2();
    assert!((order - 2.0).abs() < 0.3, "order {order}");
}

#[test]
fn a_short_film_is_that_of_ocvirk() {
    // W c²/(μ ω R L³) and the attitude angle of the short bearing (Ocvirk, NACA TN 2808, 1952) at L/D 1/40. Its pressure is so
    // small that shear does not count beside it only where the clearance is smaller still.
    let (length, clearance) = (2.0 * RADIUS / 40.0, 1e-3 * CLEARANCE);
    for (eps, load, attitude) in [(0.1, 0.0804, 82.71), (0.5, 0.7504, 53.68), (0.9, 24.006, 20.83)]
    {
        let mut film = film("reynolds", [288, 7], length, 0.0);
        film.set("sigma", 1e-15).unwrap();
        let mut bench = Bench::with(film, clearance);
        let motion = JournalMotion { displacement: [eps * clearance, 0.0], ..turning(0.0) };
        let forces = bench.react(&motion).forces;
        let unit = VISCOSITY * OMEGA * RADIUS * length.powi(3) / clearance.powi(2);
        close(forces[0].hypot(forces[1]) / unit, load, 0.01, &format!("ε {eps}"));
        let [_, angle] = sommerfeld([forces[0], forces[1]], length);
        assert!((angle - attitude).abs() < 0.2, "ε {eps}: {angle}°");
    }
}
