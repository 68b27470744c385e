//! A march from the last state of another one.

use whirl_solver::Error;
use whirl_solver::dynamics::{BodyStart, Integrator, LastState, March, MarchOptions, equilibrium};
use whirl_solver::loads::{Frame, Release, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::rigid::RigidBody;

use super::super::resume::{CUTS, STEPS, chosen, machine, march_options, target};
use super::super::{discs, force, options, parts};
use super::short_film::load;
use super::{C, SPEED, rigid_rotor};
use whirl_solver::support::Support;

/// The bits of all rows to the end, and the last state as a file has it.
fn finish(march: &mut March) -> (Vec<Vec<u64>>, LastState) {
    let mut rows = Vec::new();
    while !march.is_done() {
        march.advance().expect("converges");
        rows.push(march.row().iter().map(|value| value.to_bits()).collect());
    }
    let bytes = postcard::to_allocvec(&march.last_state()).expect("plain data");
    (rows, postcard::from_bytes(&bytes).expect("what was written"))
}

/// Cut once and twice, with factors that are kept and a drive that is released in between.
#[test]
fn a_march_cut_in_parts_has_the_bits_of_the_whole_one() {
    let fixed = [Release::Located, Release::AtStep].into_iter().map(|release| (release, None));
    let chosen = chosen().map(|automatic| (Release::Located, automatic));
    let newmark = fixed.chain(chosen).map(|(release, own)| (release, own, Integrator::default()));
    let damped = Integrator::generalized_alpha(0.8);
    for (release, automatic, integrator) in newmark.chain([(Release::Located, None, damped)]) {
        let (machine, options) =
            (machine(target(), release), MarchOptions { automatic, integrator, ..march_options() });
        let (whole, _) = finish(&mut March::new(&machine, &options).expect("starts"));
        for cuts in [vec![CUTS[0]], vec![CUTS[1]], vec![CUTS[2], CUTS[3]]] {
            let part = |steps: usize| MarchOptions { steps, ..options.clone() };
            let (_, mut last) = finish(&mut March::new(&machine, &part(cuts[0])).expect("starts"));
            for (place, cut) in cuts.iter().enumerate() {
                let end = cuts.get(place + 1).copied().unwrap_or(STEPS);
                // What the options say of the start has no effect.
                let options =
                    MarchOptions { initial: vec![BodyStart::default()], ..part(end - cut) };
                let mut next =
                    March::from_last(&machine, &options, &last).expect("the same bodies");
                let (rows, own) = finish(&mut next);
                assert_eq!(rows.len(), end - cut);
                assert!(rows == whole[*cut..end], "other bits after step {cut}");
                let mut begun =
                    March::from_last(&machine, &options, &last).expect("the same bodies");
                (0..(end - cut) / 3).for_each(|_| begun.advance().expect("converges"));
                let kept = begun.checkpoint();
                let step = cut + kept.step();
                let mut resumed = March::resume(&machine, &options, kept).expect("resumes");
                assert!(
                    finish(&mut resumed).0 == whole[step..end],
                    "other bits after {cut} and {step}"
                );
                last = own;
            }
        }
    }
}

/// Where a load changes, accelerations do at once, and nothing else.
#[test]
fn another_load_acts_from_the_last_state_on() {
    let rotation = Rotation::Prescribed { speed: SPEED, acceleration: 0.0 };
    let rotor = |share: f64| rigid_rotor(10.0, share * load(0.5, SPEED), 0.0, rotation.clone());
    let (first, second) = (rotor(2.0), rotor(2.4));
    let initial = equilibrium(&first, &[None], None).expect("is there").bodies;
    let options = MarchOptions { initial, ..options(1e-5, 300) };
    let mut march = March::new(&first, &options).expect("starts");
    let (_, last) = finish(&mut march);
    let before = march.state().clone();
    let next = March::from_last(&second, &options, &last).expect("the same bodies");
    let after = next.state();
    assert_eq!((&after.q, &after.v), (&before.q, &before.v));
    // 0.4 W along −x in space, on 10 kg.
    let (sin, cos) = after.q[0].sin_cos();
    let jump = -0.4 * load(0.5, SPEED) / 10.0;
    for (axis, along) in [(1, cos), (2, -sin)] {
        let found = after.a[axis] - before.a[axis];
        assert!((found - jump * along).abs() < 1e-6 * jump.abs(), "{found} for {}", jump * along);
    }
    // With a step of its own it counts from where the other ended.
    let finer = MarchOptions { time_step: 3e-6, ..options };
    let mut next = March::from_last(&second, &finer, &last).expect("the same bodies");
    next.advance().expect("converges");
    assert_eq!(next.row()[0], last.time() + 3e-6);
    let moved = next.state().q[1..3].iter().zip(&before.q[1..3]).map(|(a, b)| (a - b).abs());
    assert!(moved.fold(0.0, f64::max) < 0.01 * C);
}

fn line(bending: f64, rotation: Rotation) -> Machine {
    let mut parts = parts(discs(bending), Support::rigid(&[]), rotation);
    let push = [3.0, 0.0, 0.0];
    let node = parts.bodies[0].nodes()[1].clone();
    parts.loads = vec![force(&node, push, TimeFunction::Constant, Frame::Space)];
    Machine::new(parts).expect("a machine")
}

/// The coordinates of a rigid body are motions of its centre: of one whose centre is elsewhere they are others.
#[test]
fn a_rigid_body_whose_centre_has_moved_is_another_one() {
    let mut options = options(1e-4, 20);
    options.initial[0].speed = 50.0;
    let rotor = |z: f64| {
        let body = RigidBody {
            mass: 10.0,
            polar_inertia: 0.2,
            transverse_inertia: Some(0.15),
            along: false,
            rocks: false,
            centre: [0.0, 0.0, z],
            stiffness: [0.0; 2],
            damping: [0.0; 2],
        };
        let shaft = body.turning(&[[0.0; 3]]);
        Machine::new(parts(shaft, Support::rigid(&[]), Rotation::Free)).expect("a machine")
    };
    let first = rotor(0.1);
    let (_, last) = finish(&mut March::new(&first, &options).expect("starts"));
    assert!(March::from_last(&rotor(0.1), &options, &last).is_ok());
    match March::from_last(&rotor(0.12), &options, &last).map(|_| ()) {
        Err(Error::OtherBodies(differ)) => assert_eq!(differ, ["`shaft` is another one"]),
        other => panic!("{other:?}"),
    }
}

#[test]
fn other_bodies_and_other_rotations_are_errors_that_name_them() {
    let mut options = options(1e-4, 20);
    options.initial[0].speed = 50.0;
    let first = line(1e6, Rotation::Free);
    let (_, last) = finish(&mut March::new(&first, &options).expect("starts"));
    match March::from_last(&line(1.1e6, Rotation::Free), &options, &last).map(|_| ()) {
        Err(Error::OtherBodies(differ)) => assert_eq!(differ, ["`shaft` is another one"]),
        other => panic!("{other:?}"),
    }
    let given = |speed: f64| Rotation::Prescribed { speed, acceleration: 0.0 };
    match March::from_last(&line(1e6, given(60.0)), &options, &last).map(|_| ()) {
        Err(Error::OtherRotation { body, speed, had_speed, .. }) => {
            assert!(body == "shaft" && speed == 60.0 && (had_speed - 50.0).abs() < 1e-6);
        }
        other => panic!("{other:?}"),
    }
    // A body that turned as prescribed may turn freely from there.
    let driven = line(1e6, given(50.0));
    let (_, last) = finish(&mut March::new(&driven, &options).expect("starts"));
    let free = March::from_last(&first, &options, &last).expect("the same bodies");
    assert_eq!((free.state().q[0], free.state().v[0]), (50.0 * last.time(), 50.0));
}
