//! Kinds of laws, at springs and on whole rings: what their kernels take, give and linearise, against hyper-dual evaluation of the measures and against central differences.

mod bench;

use whirl_specs::{BoreMotion, ContactPlace, ContactState, ContactTangent};

use self::bench::{A1, Bench, R, SIZES, State, measure_of, psi, size};
use crate::random::Random;

/// Rounding in sums over springs and inputs of terms that cancel by up to a factor of 1000: the slip by
/// R θ̇ is that much larger than the rates of the lengths.
const ROUNDING: f64 = 50.0 * 1000.0 * f64::EPSILON;

#[test]
fn inputs_follow_from_the_measures() {
    let mut random = Random::new(11);
    for bench in Bench::all() {
        for _ in 0..20 {
            let state = bench.random(&mut random);
            let inputs = bench.inputs(&state);
            for j in 0..bench.count {
                let exact = bench.exact_inputs(&state, j, &vec![0.0; bench.coordinates()]);
                for (i, ([value, _], own)) in exact.iter().zip(bench.kind.inputs).enumerate() {
                    let error = (inputs[i * bench.count + j] - value).abs();
                    // Slip is R θ̇ with the rest lost in it; a rate of a length is θ̇ times one.
                    let size =
                        size(own.unit).max(R * SIZES[2] * f64::from(u8::from(own.unit == "m/s")));
                    assert!(
                        error <= 32.0 * f64::EPSILON * size.max(6.0),
                        "{}: {error:e}",
                        own.name
                    );
                }
            }
        }
    }
}

#[test]
fn forces_and_tangent_follow_from_the_measures() {
    let mut random = Random::new(12);
    for bench in Bench::all() {
        for _ in 0..20 {
            let state = bench.random(&mut random);
            let d = bench.direction(&mut random);
            let [force, tangent] = bench.exact(&state, &d);
            let error = bench.difference(&bench.force(&state), &force);
            assert!(error <= ROUNDING, "{}: force {error:e}", bench.kind.name);
            let error = bench.difference(&bench.tangent(&state, &d), &tangent);
            assert!(error <= ROUNDING, "{}: tangent {error:e}", bench.kind.name);
        }
    }
}

#[test]
fn central_differences_of_the_forces_approach_the_tangent_as_the_step_squared() {
    let mut random = Random::new(13);
    for bench in Bench::all() {
        for _ in 0..20 {
            let state = bench.random(&mut random);
            let d = bench.direction(&mut random);
            let tangent = bench.tangent(&state, &d);
            let moved = |step: f64| {
                let shift = |values: &[f64], by: f64| -> Vec<f64> {
                    values.iter().zip(&d).map(|(value, d)| value + by * d).collect()
                };
                State { q: shift(&state.q, step), rate: shift(&state.rate, step * A1) }
            };
            let error = |step: f64| {
                let (ahead, behind) = (bench.force(&moved(step)), bench.force(&moved(-step)));
                let slope: Vec<f64> =
                    ahead.iter().zip(&behind).map(|(a, b)| (a - b) / (2.0 * step)).collect();
                bench.difference(&slope, &tangent)
            };
            let (coarse, fine) = (error(0.1), error(0.01));
            let ratio = coarse / fine;
            assert!(
                (ratio / 100.0 - 1.0).abs() < 0.05,
                "{}: coarse {coarse:e}, fine {fine:e}",
                bench.kind.name
            );
        }
    }
}

/// A motion of shaft and bore together does no work: forces on the two are equal and opposite.
#[test]
fn reactions_on_shaft_and_bore_are_equal_and_opposite() {
    let mut random = Random::new(14);
    for bench in Bench::all() {
        for _ in 0..20 {
            let mut state = bench.random(&mut random);
            let (sin, cos) = state.q[0].sin_cos();
            let force = bench.force(&state);
            let scale = force.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
            for [x, y] in [[1.0, 0.0], [0.0, 1.0]] {
                // ε in the turning frame; the bore's motion as its own coordinates see it.
                let mut motion = vec![0.0, cos * x + sin * y, cos * y - sin * x];
                // That of the second gear is in a frame of its own.
                let frame = BoreMotion::SecondFrame;
                let frame = bench.kind.bore.iter().position(|own| *own == frame);
                let (turned, upright) =
                    frame.map_or((0.0, 1.0), |own| state.q[bench.place(own, 0)].sin_cos());
                for own in bench.kind.bore {
                    motion.extend((0..bench.count).map(|j| match own {
                        BoreMotion::Radial => psi(j).cos() * x + psi(j).sin() * y,
                        BoreMotion::Tangential => psi(j).cos() * y - psi(j).sin() * x,
                        BoreMotion::MeanX => upright * x + turned * y,
                        BoreMotion::MeanY => upright * y - turned * x,
                        _ => 0.0,
                    }));
                }
                let work: f64 = force.iter().zip(&motion).map(|(f, m)| f * m).sum();
                assert!(work.abs() <= 64.0 * f64::EPSILON * scale, "{}: {work}", bench.kind.name);
            }
            // Along z, and tilts of both sections alike.
            let [a_x, a_y] = [[cos, -sin], [sin, cos]];
            for together in [
                [(BoreMotion::SectionZ, 1.0), (BoreMotion::MeanZ, 1.0)].to_vec(),
                [
                    (BoreMotion::SectionTiltX, a_x[0]),
                    (BoreMotion::SectionTiltY, a_x[1]),
                    (BoreMotion::MeanTiltX, 1.0),
                ]
                .to_vec(),
                [
                    (BoreMotion::SectionTiltX, a_y[0]),
                    (BoreMotion::SectionTiltY, a_y[1]),
                    (BoreMotion::MeanTiltY, 1.0),
                ]
                .to_vec(),
            ] {
                let at = |wanted: BoreMotion| bench.kind.bore.iter().position(|own| *own == wanted);
                let terms = together
                    .iter()
                    .filter_map(|&(motion, part)| Some(part * force[bench.place(at(motion)?, 0)]));
                let work: f64 = terms.sum();
                assert!(work.abs() <= 64.0 * f64::EPSILON * scale, "{}: {work}", bench.kind.name);
            }
            // A turn about the axis, wherever both stand: the moment e × F that the forces leave is a couple on the bore.
            let place = |wanted: BoreMotion| {
                bench.kind.bore.iter().position(|own| *own == wanted).map(|a| bench.place(a, 0))
            };
            if let [Some(x), Some(y), Some(turn)] =
                [BoreMotion::MeanX, BoreMotion::MeanY, BoreMotion::MeanTurn].map(place)
            {
                let mut motion = vec![0.0; bench.coordinates()];
                (motion[0], motion[turn]) = (1.0, 1.0);
                (motion[x], motion[y]) = (-state.q[y], state.q[x]);
                // The tilts of a bore that turns are about axes that turn with it.
                if let [Some(x), Some(y)] =
                    [BoreMotion::MeanTiltX, BoreMotion::MeanTiltY].map(place)
                {
                    (motion[x], motion[y]) = (-state.q[y], state.q[x]);
                }
                let terms = force.iter().zip(&motion).map(|(f, m)| f * m);
                let (work, size) =
                    terms.fold((0.0, 0.0), |(sum, size), own| (sum + own, size + f64::abs(own)));
                let sizes = scale * state.q[1].hypot(state.q[2]).max(state.q[x].hypot(state.q[y]));
                let allowed = 64.0 * f64::EPSILON * (size + sizes);
                assert!(f64::abs(work) <= allowed, "{}: {work}", bench.kind.name);
            }
            // A turn about the centre of a journal that stands there, in a bore as close as touching.
            (state.q[1], state.q[2]) = (0.0, 0.0);
            use BoreMotion::{MeanTiltX, MeanTiltY, MeanX, MeanY};
            let means = [MeanX, MeanY, MeanTiltX, MeanTiltY].map(place);
            means.into_iter().flatten().for_each(|place| state.q[place] = 0.0);
            let force = bench.force(&state);
            let mut motion = vec![1.0, 0.0, 0.0];
            for own in bench.kind.bore {
                let turn = match own {
                    BoreMotion::Tangential => R,
                    BoreMotion::MeanTurn => 1.0,
                    // Teeth roll off.
                    BoreMotion::SecondTurn => -1.0,
                    _ => 0.0,
                };
                motion.extend(vec![turn; bench.count]);
            }
            let work: f64 = force.iter().zip(&motion).map(|(f, m)| f * m).sum();
            let scale = force.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
            assert!(work.abs() <= 64.0 * f64::EPSILON * scale, "{}: {work}", bench.kind.name);
            // Normal forces meet in the centre.
            let turns = bench.kind.forces.iter().any(|force| force.radius || force.unit != "N");
            assert!(!turns || force[0].abs() > 1e-3, "{}: there is a torque", bench.kind.name);
        }
    }
}

/// Forces work on what their measures say, whether laws may take them or not.
#[test]
fn every_force_has_the_row_of_its_measure() {
    let mut random = Random::new(16);
    for bench in Bench::all() {
        let state = bench.random(&mut random);
        let rows = bench.inputs(&state);
        let still = vec![0.0; bench.coordinates()];
        assert_eq!(bench.kind.measures.len(), bench.kind.forces.len());
        for (force, row) in bench.kind.forces.iter().zip(bench.kind.measures) {
            for j in 0..bench.count {
                let exact = bench.hyper(&state, j, &still, &still)[measure_of(force.name)].0.re;
                let error = (rows[row * bench.count + j] - exact).abs();
                assert!(error <= 1e-15 * exact.abs().max(1e-3), "{}: {error:e}", force.name);
            }
        }
    }
}

/// What the springs of a plane give does not depend on which others lie beside them in the rows.
#[test]
fn planes_of_a_law_lie_side_by_side() {
    let mut random = Random::new(15);
    for bench in Bench::all().into_iter().filter(|bench| bench.kind.place == ContactPlace::Spring) {
        let state = bench.random(&mut random);
        let (n, whole) = (bench.count, bench.force(&state));
        let (inputs, (forces, slopes)) = (bench.inputs(&state), bench.laws(&state));
        let mut found = vec![f64::NAN; inputs.len()];
        let mut bore = vec![f64::NAN; bench.motions() * n];
        let (mut ring, mut t) = ([0.0; 3], ContactTangent::new(n, bench.motions()));
        bench.with(&state, |state| {
            (bench.kind.tangent)(n, state, &forces, &slopes, A1, &mut t);
        });
        for part in [0..3, 3..n] {
            let (first, count) = (part.start, part.len());
            let (mut own, mut tangent) = ([0.0; 3], ContactTangent::new(count, bench.motions()));
            bench.with(&state, |state| {
                let state = ContactState {
                    table: &state.table[first..],
                    bore: &state.bore[first..],
                    bore_dot: &state.bore_dot[first..],
                    ..*state
                };
                (bench.kind.evaluate)(count, &state, &mut found[first..]);
                (bench.kind.force)(count, &state, &forces[first..], &mut own, &mut bore[first..]);
                let (forces, slopes) = (&forces[first..], &slopes[first..]);
                (bench.kind.tangent)(count, &state, forces, slopes, A1, &mut tangent);
            });
            ring.iter_mut().zip(own).for_each(|(sum, force)| *sum += force);
            let rows = tangent.ring_bore.chunks(count).zip(t.ring_bore.chunks(n));
            rows.for_each(|(own, whole)| assert_eq!(own, &whole[part.clone()]));
        }
        assert_eq!(found, inputs, "{}", bench.kind.name);
        assert_eq!(bore, whole[3..], "{}", bench.kind.name);
        let scale = whole[..3].iter().fold(0.0, |m: f64, f| m.max(f.abs()));
        for (own, whole) in ring.iter().zip(&whole) {
            assert!((own - whole).abs() <= 64.0 * f64::EPSILON * scale, "{}", bench.kind.name);
        }
    }
}
