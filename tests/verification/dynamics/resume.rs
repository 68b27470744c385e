//! A march resumed from a checkpoint is the march that was never interrupted, bit for bit.

use whirl_solver::bearing::Bearing;
use whirl_solver::dynamics::{
    AutomaticStep, BodyStart, Checkpoint, Integrator, March, MarchOptions,
};
use whirl_solver::loads::{Frame, Release, Target, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};

use super::validity::MEASURED;
use super::{bearing, bores, boxed, discs, force, options, parts};

pub(super) const STEPS: usize = 2300;
/// Steps after which a march is resumed: the first, some in which factors are kept, one after the drive has stopped.
pub(super) const CUTS: [usize; 4] = [1, 777, 1003, 2001];

/// A driven shaft in films that switch off at 2 mm, in bores that vibrate: loads that are released, factors that
/// are kept over steps, a cycle of the steady-state test that reaches back over a checkpoint.
pub(super) fn machine(target: f64, release: Release) -> Machine {
    let mut parts = parts(discs(1e6), bores(), Rotation::Free);
    // Its measures are kept, too.
    parts.laws = vec![boxed(&MEASURED)];
    parts.bearings = vec![Bearing { clearance: 5e-4, ..bearing(0) }];
    let node = |place: usize| parts.bodies[0].nodes()[place].clone();
    let sine = TimeFunction::Sine { frequency: 80.0, phase: 0.3 };
    let drive = TimeFunction::UntilSpeed(Target { speed: target, from_above: false, release });
    parts.loads = vec![
        force(&node(2), [60.0, 20.0, 0.0], TimeFunction::Constant, Frame::Space),
        force(&node(1), [0.0, 30.0, 0.0], sine, Frame::Space),
    ];
    let mut arm = node(0);
    arm.position[0] = 0.1;
    parts.loads.push(force(&arm, [0.0, 20.0, 0.0], drive, Frame::Body));
    Machine::new(parts).expect("a machine")
}

/// A speed that is reached between the last cuts.
pub(super) fn target() -> f64 {
    let machine = machine(f64::INFINITY, Release::AtStep);
    let mut march = March::new(&machine, &march_options()).expect("starts");
    let mut fastest = f64::NEG_INFINITY;
    for _ in 1..=1500 {
        march.advance().expect("converges");
        fastest = fastest.max(march.row()[2]);
    }
    fastest
}

pub(super) fn march_options() -> MarchOptions {
    MarchOptions {
        cycle: Some(1.0 / 80.0),
        initial: vec![BodyStart { speed: 30.0, ..BodyStart::default() }],
        ..options(1e-4, STEPS)
    }
}

/// Goes on to the end; the bits of all rows, and the checkpoints on the way as a file has them.
fn finish(march: &mut March) -> (Vec<Vec<u64>>, Vec<Vec<u8>>) {
    let (mut rows, mut kept) = (Vec::new(), Vec::new());
    while !march.is_done() {
        march.advance().expect("converges");
        rows.push(march.row().iter().map(|value| value.to_bits()).collect());
        if CUTS.contains(&rows.len()) {
            kept.push(postcard::to_allocvec(&march.checkpoint()).expect("plain data"));
        }
    }
    (rows, kept)
}

/// The same in steps of which the march chooses the parts: more of them, and fewer.
pub(super) fn chosen() -> impl Iterator<Item = Option<AutomaticStep>> {
    let tolerances = [1e-3, 1e-6].into_iter();
    tolerances.map(|tolerance| Some(AutomaticStep { tolerance, ..AutomaticStep::default() }))
}

#[test]
fn a_resumed_march_has_the_bits_of_one_never_interrupted() {
    for release in [Release::AtStep, Release::Located] {
        let bits = resumes_with_the_same_bits(release, None, Integrator::default());
        for automatic in chosen() {
            let chosen = resumes_with_the_same_bits(release, automatic, Integrator::default());
            assert!(chosen != bits, "{automatic:?}");
        }
    }
    let damped = Integrator::generalized_alpha(0.8);
    for automatic in [None].into_iter().chain(chosen()) {
        resumes_with_the_same_bits(Release::Located, automatic, damped);
    }
}

fn resumes_with_the_same_bits(
    release: Release,
    automatic: Option<AutomaticStep>,
    integrator: Integrator,
) -> Vec<Vec<u64>> {
    let options = MarchOptions { automatic, integrator, ..march_options() };
    let machine = machine(target(), release);
    let mut whole = March::new(&machine, &options).expect("starts");
    let (rows, checkpoints) = finish(&mut whole);
    let whole = whole.outcome();
    assert_eq!((rows.len(), checkpoints.len()), (STEPS, CUTS.len()));
    assert!(whole.factorisations < STEPS / 2, "factors are kept: {}", whole.factorisations);
    for (bytes, cut) in checkpoints.iter().zip(CUTS) {
        let checkpoint: Checkpoint = postcard::from_bytes(bytes).expect("what was written");
        let step = checkpoint.step();
        assert_eq!(step, cut);
        let mut resumed = March::resume(&machine, &options, checkpoint).expect("resumes");
        let (rest, _) = finish(&mut resumed);
        assert!(rest == rows[step..], "other bits after step {step}");
        assert_eq!(resumed.outcome(), whole);
    }
    println!("{automatic:?}: {:?}, {} factorisations", whole.parts, whole.factorisations);
    rows
}

#[test]
fn a_drive_is_released_and_films_act_in_the_march_that_is_resumed() {
    let free = machine(f64::INFINITY, Release::Located);
    let mut free = March::new(&free, &march_options()).expect("starts");
    let machine = machine(target(), Release::Located);
    let mut march = March::new(&machine, &march_options()).expect("starts");
    let (mut same, mut last) = (0, [0.0; 2]);
    while !march.is_done() {
        march.advance().expect("converges");
        free.advance().expect("converges");
        last = [march.row()[2], free.row()[2]];
        same += usize::from(last[0].to_bits() == last[1].to_bits());
    }
    assert!((CUTS[2]..CUTS[3]).contains(&same), "released in step {same}");
    assert!(last[0] < last[1], "{last:?}");
    assert!(march.energy().spring_stored.abs() > 1e-6, "{:?}", march.energy());
}
