//! Journals where their films carry the load, and starts that there are not.

use whirl_solver::Error;
use whirl_solver::attached::Unbalance;
use whirl_solver::dynamics::equilibrium;
use whirl_solver::machine::{Body, Rotation};

use super::short_film::{attitude, load};
use super::{C, JOURNALS, SPEED, rigid_rotor};

/// Attitude angles and load numbers of the short film: Ocvirk (1952).
#[test]
fn journals_stand_where_short_films_carry_them() {
    for (eps, degrees, number) in [(0.1, 82.71, 0.0804), (0.5, 53.68, 0.7504), (0.9, 20.83, 24.006)]
    {
        assert!((attitude(eps).to_degrees() - degrees).abs() < 5e-3);
        assert!((super::short_film::load_number(eps) / number - 1.0).abs() < 1e-3);
        for rotation in [Rotation::Free, Rotation::Prescribed { speed: SPEED, acceleration: 0.0 }] {
            let machine = rigid_rotor(10.0, 2.0 * load(eps, SPEED), 0.0, rotation);
            let found = equilibrium(&machine, &[Some(SPEED)], None).expect("is there");
            let [x, y] = [0, 1].map(|axis| found.bodies[0].position[axis] / C);
            // The load points along −x, and the rotor turns from x to y.
            let angle = (-y).atan2(-x).to_degrees();
            println!("{eps}: {:.6} at {angle:.4}, {} iterations", x.hypot(y), found.iterations);
            assert!((x.hypot(y) - eps).abs() < 1e-4, "{x} {y}");
            assert!((angle.abs() - degrees).abs() < 2e-2, "{angle} for {degrees}");
            for (_, ratio) in &found.eccentricities {
                assert!((ratio.expect("a clearance") - eps).abs() < 1e-4);
            }
            // Standing in space it moves against the frame.
            let [x_dot, y_dot] = [0, 1].map(|axis| found.bodies[0].velocity[axis] / C);
            assert!((x_dot - SPEED * y).abs() + (y_dot + SPEED * x).abs() < 1e-9 * SPEED);
        }
    }
}

/// Reactions of a load off the middle follow from moments, and each film is that of its own load.
#[test]
fn a_load_off_the_middle_is_shared_by_moments() {
    let (total, z) = (2.0 * load(0.6, SPEED), 0.06);
    let machine = rigid_rotor(10.0, total, z, Rotation::Free);
    let found = equilibrium(&machine, &[Some(SPEED)], None).expect("is there");
    for (journal, (_, ratio)) in found.eccentricities.iter().enumerate() {
        let share = 0.5 + z * JOURNALS[journal].signum() / (JOURNALS[1] - JOURNALS[0]);
        let carried = load(ratio.expect("a clearance"), SPEED);
        assert!((carried / (share * total) - 1.0).abs() < 1e-3, "{carried} of {total}");
    }
}

#[test]
fn more_than_films_carry_is_an_error_with_facts() {
    // Beyond ε = 0.99 the film of this law grows no stiffer.
    let machine = rigid_rotor(10.0, 2.5 * load(0.99, SPEED), 0.0, Rotation::Free);
    match equilibrium(&machine, &[Some(SPEED)], None) {
        Err(Error::NoEquilibrium { rows, journals, share }) => {
            println!(
                "{}",
                Error::NoEquilibrium { rows: rows.clone(), journals: journals.clone(), share }
            );
            assert!(rows[0].0.contains("rotor, centre x"), "{rows:?}");
            assert!(journals.len() == 2 && journals[0].1 > 0.9, "{journals:?}");
            assert!((0.7..0.85).contains(&share), "{share}");
        }
        other => panic!("{other:?}"),
    }
}

/// At rest a film carries nothing.
#[test]
fn a_film_at_rest_carries_nothing() {
    let loaded = rigid_rotor(10.0, 100.0, 0.0, Rotation::Free);
    assert!(matches!(equilibrium(&loaded, &[Some(0.0)], None), Err(Error::NoEquilibrium { .. })));
    let unloaded = rigid_rotor(10.0, 0.0, 0.0, Rotation::Free);
    assert!(matches!(equilibrium(&unloaded, &[Some(0.0)], None), Err(Error::Floating { .. })));
}

/// Unbalance turns with the rotor: where it would be in a balance of forces is not where it is at t = 0.
#[test]
fn unbalance_is_left_out() {
    let machine = rigid_rotor(10.0, 2.0 * load(0.5, SPEED), 0.0, Rotation::Free);
    let found = equilibrium(&machine, &[Some(SPEED)], None).expect("is there");
    let mut machine = machine;
    let Body::Turning { shaft, .. } = &mut machine.bodies[0] else { panic!("it turns") };
    let node = shaft.nodes[1].clone();
    *shaft = shaft.clone().with_unbalance(&Unbalance { moment: [2e-4, -1e-4], node: &node });
    assert!(shaft.y0.iter().any(|own| own.abs() > 1e-5));
    let unbalanced = equilibrium(&machine, &[Some(SPEED)], None).expect("is there");
    let both = found.bodies[0].position.iter().zip(&unbalanced.bodies[0].position);
    both.for_each(|(a, b)| assert!((a - b).abs() < 1e-12 * C, "{a} {b}"));
}
