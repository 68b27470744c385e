//! Films that do not close, against finite volumes with linear pressures, which share nothing with the films.

use std::f64::consts::TAU;

use super::{Bench, CLEARANCE, OMEGA, RADIUS, VISCOSITY, close, kind};
use crate::film::{JournalMotion, OilFilm, Reach};

/// A pad: where it starts, how far it reaches (rad), how long it is (m), its preload about its middle.
#[derive(Clone, Copy)]
struct Pad {
    start: f64,
    arc: f64,
    length: f64,
    preload: f64,
}

impl Pad {
    /// The gap of a journal in the middle (m).
    fn gap(&self, angle: f64) -> f64 {
        let from_middle = angle - self.start - 0.5 * self.arc;
        CLEARANCE / (1.0 - self.preload) * (1.0 - self.preload * from_middle.cos())
    }

    fn bench(&self, name: &str, nodes: [usize; 2]) -> Bench {
        let reach = Reach { first: self.start, arc: Some(self.arc) };
        let mut film = OilFilm::reaching(kind(name), nodes, [RADIUS, self.length], reach).unwrap();
        film.set("sigma", 1e-12).unwrap();
        film.set("mu_0", VISCOSITY).unwrap();
        let mut bench = Bench::new(film);
        bench.journal.shape(|angle, _| self.gap(angle) - CLEARANCE);
        bench
    }

    /// Force on the journal at a displacement with a velocity, by finite volumes of `cells` around and half as many along, of
    /// which pressures below zero are set to zero.
    fn force_on(&self, cells: usize, [x, y]: [f64; 2], [vx, vy]: [f64; 2]) -> [f64; 2] {
        let (n, m) = (cells, cells / 2);
        let [dx, dz] = [RADIUS * self.arc / n as f64, self.length / m as f64];
        let angle = |i: f64| self.start + self.arc * i / n as f64;
        let gap = |i: f64| self.gap(angle(i)) - x * angle(i).cos() - y * angle(i).sin();
        let through = |i: f64| gap(i).powi(3) / (12.0 * VISCOSITY) * dz / dx;
        let speed = 0.5 * OMEGA * RADIUS;
        // Of every node within the edges: conductances before and behind it, to its sides, what it takes up.
        let nodes: Vec<[f64; 4]> = (1..n)
            .map(|i| {
                let own = i as f64;
                let [before, behind] = [own - 0.5, own + 0.5];
                let sides = gap(own).powi(3) / (12.0 * VISCOSITY) * dx / dz;
                let rate = -vx * angle(own).cos() - vy * angle(own).sin();
                let taken = speed * (gap(behind) - gap(before)) * dz + rate * dx * dz;
                [through(before), through(behind), sides, taken]
            })
            .collect();
        let mut p = vec![vec![0.0_f64; m + 1]; n + 1];
        let over = 2.0 / (1.0 + (TAU / 2.0 / m as f64).sin());
        loop {
            let (mut change, mut most) = (0.0_f64, 0.0_f64);
            for i in 1..n {
                let [before, behind, sides, taken] = nodes[i - 1];
                for j in 1..m {
                    let flows = before * p[i - 1][j]
                        + behind * p[i + 1][j]
                        + sides * (p[i][j - 1] + p[i][j + 1])
                        - taken;
                    let balanced = flows / (before + behind + 2.0 * sides);
                    let value = (p[i][j] + over * (balanced - p[i][j])).max(0.0);
                    change = change.max((value - p[i][j]).abs());
                    most = most.max(value);
                    p[i][j] = value;
                }
            }
            if change <= 1e-12 * most {
                break;
            }
        }
        let mut force = [0.0; 2];
        for (i, row) in p.iter().enumerate() {
            let sum: f64 = row.iter().sum();
            force[0] -= sum * dx * dz * angle(i as f64).cos();
            force[1] -= sum * dx * dz * angle(i as f64).sin();
        }
        force
    }

    /// The same, extrapolated from two distances of nodes: of second order.
    fn force(&self, place: [f64; 2], velocity: [f64; 2]) -> [f64; 2] {
        let [coarse, fine] = [64, 128].map(|cells| self.force_on(cells, place, velocity));
        [0, 1].map(|axis| fine[axis] + (fine[axis] - coarse[axis]) / 3.0)
    }
}

/// Pads about the axis −x, and where the journal is in them, in clearances.
fn pads() -> [(&'static str, Pad, [f64; 2]); 4] {
    let pad = |degrees: f64, ratio: f64, preload: f64| {
        let arc = degrees.to_radians();
        let start = 0.5 * (TAU - arc);
        Pad { start, arc, length: 2.0 * RADIUS * ratio, preload }
    };
    [
        ("180°, L/D 1", pad(180.0, 1.0, 0.0), [-0.45, 0.4]),
        ("120°, L/D 1", pad(120.0, 1.0, 0.0), [-0.5, 0.35]),
        ("120°, L/D 1/2, below the middle", pad(120.0, 0.5, 0.0), [0.2, -0.3]),
        ("60°, L/D 3/4, preload 1/2", pad(60.0, 0.75, 0.5), [-0.3, -0.6]),
    ]
}

#[test]
fn arcs_carry_what_finite_volumes_find() {
    for (what, pad, place) in pads() {
        let displacement = place.map(|own| own * CLEARANCE);
        let exact = pad.force(displacement, [0.0; 2]);
        let size = exact[0].hypot(exact[1]);
        let mut drawn_in = Vec::new();
        for name in ["reynolds", "jfo"] {
            let mut bench = pad.bench(name, [97, 17]);
            let motion = JournalMotion { displacement, omega: OMEGA, ..JournalMotion::default() };
            let forces = bench.react(&motion).forces;
            for axis in 0..2 {
                let error = (forces[axis] - exact[axis]).abs() / size;
                assert!(error < 3e-3, "{what}, {name}: {forces:?} against {exact:?}, {error:.1e}");
            }
            let film = &bench.journal.film;
            let flows: Vec<f64> = (0..4).map(|own| bench.balance.inflow(film, own)).collect();
            if name == "jfo" {
                assert!(flows[0] < 0.0 && flows[1] < 0.0 && flows[2] > 0.0, "{what}: {flows:?}");
                let lost: f64 = flows.iter().sum();
                assert!(lost.abs() < 1e-9 * flows[2], "{what}: {flows:?}");
            }
            drawn_in.push(flows[2]);
        }
        // Both are full where they begin, and differ by where their cavity does.
        let [plain, conserving] = drawn_in[..] else { unreachable!("two films") };
        assert!((plain / conserving - 1.0).abs() < 0.02, "{what}: {plain} {conserving}");
    }
}

#[test]
fn stiffness_and_damping_of_arcs_are_differences_of_finite_volumes() {
    for (what, pad, place) in pads() {
        let displacement = place.map(|own| own * CLEARANCE);
        let mut bench = pad.bench("reynolds", [145, 17]);
        let motion = JournalMotion { displacement, omega: OMEGA, ..JournalMotion::default() };
        let slopes = bench.react(&motion).slopes;
        let by = 1e-4 * CLEARANCE;
        let difference = |moved: &dyn Fn(f64) -> [[f64; 2]; 2]| -> [f64; 2] {
            let [below, above] = [-by, by].map(|by| {
                let [place, velocity] = moved(by);
                pad.force(place, velocity)
            });
            [0, 1].map(|axis| (above[axis] - below[axis]) / (2.0 * by))
        };
        let (mut exact, mut found) = ([[0.0; 4]; 2], [[0.0; 4]; 2]);
        for axis in 0..2 {
            let along = |by: f64| if axis == 0 { [by, 0.0] } else { [0.0, by] };
            let moved = |by: f64| {
                let away = along(by);
                [[displacement[0] + away[0], displacement[1] + away[1]], [0.0; 2]]
            };
            let pushed = |by: f64| [displacement, along(by).map(|own| own * OMEGA)];
            for (kind, slope) in [difference(&moved), difference(&pushed)].iter().enumerate() {
                for force in 0..2 {
                    exact[kind][2 * force + axis] = slope[force];
                    let rate = if kind == 0 { 1.0 } else { OMEGA };
                    found[kind][2 * force + axis] = rate * slopes[force][4 * kind + axis];
                }
            }
        }
        for kind in 0..2 {
            let size = exact[kind].iter().fold(0.0_f64, |most, own| most.max(own.abs()));
            for (found, exact) in found[kind].iter().zip(exact[kind]) {
                // Where the cavity begins within a cell shows in slopes.
                let error = (found - exact).abs() / size;
                assert!(error < 1e-2, "{what}, {kind}: {found} against {exact}, {error:.1e}");
            }
        }
    }
}

/// Between parallel surfaces that one edge feeds oil flows as between plates.
#[test]
fn edges_of_an_arc_have_their_pressures() {
    let pad = Pad { start: 0.3, arc: 1.0, length: 0.02, preload: 0.0 };
    for name in ["reynolds", "jfo"] {
        let mut bench = pad.bench(name, [11, 3]);
        bench.journal.film.flood(2, 3e5).unwrap();
        bench.journal.film.open(3).unwrap();
        (0..2).for_each(|end| bench.journal.film.close(end));
        bench.balance = crate::film::Balance::new(&bench.journal.film);
        bench.react(&JournalMotion::default());
        let film = &bench.journal.film;
        let flow = CLEARANCE.powi(3) / (12.0 * VISCOSITY) * 3e5 / RADIUS * pad.length;
        close(bench.balance.inflow(film, 2), flow, 1e-9, name);
        close(bench.balance.inflow(film, 3), -flow, 1e-9, name);
        let middle = bench.oil.unknowns[0][5];
        close(middle, 1.5e5, 1e-9, name);
    }
}

#[test]
fn arcs_that_cannot_be_are_refused() {
    let kernel = kind("jfo");
    for arc in [0.0, -1.0, TAU, 7.0, f64::NAN] {
        let reach = Reach { first: 0.0, arc: Some(arc) };
        let wrong = OilFilm::reaching(kernel, [20, 5], [RADIUS, 0.02], reach).unwrap_err();
        assert!(wrong.what.contains("more than 0° and less than 360°"), "{wrong:?}");
    }
    let reach = Reach { first: 5.5, arc: Some(1.0) };
    let mut film = OilFilm::reaching(kernel, [20, 5], [RADIUS, 0.02], reach).unwrap();
    let wrong = film.supply("hole", 6.3..6.6, 0.0..0.0, 1e5).unwrap_err();
    assert!(wrong.what.contains("from 315.13° to 12.423°"), "{wrong:?}");
    film.supply("hole", 6.2..6.4, 0.0..0.0, 1e5).unwrap();
    let other = film.supply("other", 0.0..0.1, 0.0..0.0, 1e5).unwrap_err();
    assert!(other.what.contains("share nodes"), "{other:?}");
}
