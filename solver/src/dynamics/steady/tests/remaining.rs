//! What is estimated to be left, against motions of which it is known.

use std::f64::consts::TAU;

use super::*;

/// Cycles of a motion with what was left of the amplitude at the end, when it was steady from and when that was known.
struct Told {
    left: f64,
    steady: Option<f64>,
    known: Option<f64>,
}

/// Marches a displacement over so many cycles of 1 s, in steps that are no part of a cycle.
fn told_in_steps(dt: f64, cycles: f64, displacement: impl Fn(f64) -> f64) -> Told {
    let mut test = SteadyTest::new(SteadyRule::Remaining, [1, 1], 1.0, dt);
    let mut known = None;
    for step in 1..(cycles / dt) as usize {
        let t = step as f64 * dt;
        test.add(t, [100.0, displacement(t)].iter());
        known = test.reached.and(known.or(Some(t)));
    }
    let left = test.left().expect("cycles enough");
    Told { left, steady: test.reached.map(|own| own.time), known }
}

fn told(cycles: f64, displacement: impl Fn(f64) -> f64) -> Told {
    told_in_steps(0.013, cycles, displacement)
}

fn wave(t: f64) -> f64 {
    1e-3 * (TAU * t).sin()
}

/// A resonance with a damping ratio ζ: a cycle repeats the one before to 1 % at once where ζ is small.
fn resonance(zeta: f64) -> impl Fn(f64) -> f64 {
    move |t| (1.0 - (-zeta * TAU * t).exp()) * wave(t)
}

#[test]
fn a_resonance_is_steady_where_one_per_cent_of_its_amplitude_is_left() {
    for zeta in [3e-4, 1e-3, 3e-3, 1e-2, 0.05] {
        let one = 100.0_f64.ln() / (TAU * zeta);
        let found = told(4.0 * one + 30.0, resonance(zeta));
        let (steady, known) = (found.steady.expect("steady"), found.known.expect("known"));
        // The estimate is of the cycle before, and ends with a cycle.
        assert!(
            (one - 1.0..one + 3.0 + 0.02 * one).contains(&steady),
            "{zeta}: {steady} for {one}"
        );
        // An eighth of the cycles more, and eight at least.
        assert!(known >= steady && known < 1.2 * steady + 9.0, "{zeta}: {known} after {steady}");
    }
}

#[test]
fn the_estimate_is_what_is_left() {
    for (zeta, cycles) in [(1e-3, 40.0), (1e-3, 200.0), (3e-3, 100.0), (1e-2, 30.0)] {
        for dt in [0.013, 1.0 / 23.7, 1e-3] {
            let found = told_in_steps(dt, cycles, resonance(zeta)).left;
            let gone = 1.0 - (-zeta * TAU * cycles).exp();
            // What is compared ends up to a cycle before the end, its middle half a cycle before that, and a/(1 − r) counts the
            // change itself. So what is left was so much where the cycle began of which it is a fraction.
            // Of 23.7 samples a cycle 24 are summed: a root mean square is off by up to half of 4 %.
            let before = 1.0 - (-zeta * TAU * (cycles - 2.5)).exp();
            let (least, most) = ((1.0 - gone) / gone, (1.0 - before) / before);
            assert!(
                found > 0.96 * least && found < 1.04 * most,
                "{zeta} {cycles}: {found}, {least} to {most}"
            );
        }
    }
}

#[test]
fn what_dies_fast_hides_nothing_that_dies_slowly() {
    // At 20 cycles the fast part has fallen to where the slow one changes more.
    let slow = |t: f64| 0.5 * (-2e-3 * TAU * t).exp();
    let found = told(800.0, |t| wave(t) * (1.0 - slow(t) - 0.4 * (-0.05 * TAU * t).exp()));
    let one = 50.0_f64.ln() / (2e-3 * TAU);
    assert!(found.steady.expect("steady") > one - 2.0, "{:?} for {one}", found.steady);
}

/// Two transients whose beat takes forty cycles: where they cancel nearly nothing changes.
#[test]
fn transients_that_beat_are_steady_when_both_have_died() {
    let transient = |t: f64, shift: f64| (-2e-3 * TAU * t).exp() * (TAU * (1.0 + shift) * t).cos();
    let beat = |t: f64| wave(t) + 5e-4 * (transient(t, 0.3) + transient(t, 0.325));
    let found = told(1200.0, beat);
    let steady = found.steady.expect("steady");
    // The sum of both falls to 1 % of the wave after so many cycles, and swings below that by at most a beat before. A
    // change at 0.3 of the frequency is 1.6 times the amplitude, and is taken to add up to 1/(1 − r) times that.
    let (one, rate) = (100.0_f64.ln() / (2e-3 * TAU), 2e-3 * TAU);
    let summed = (100.0 * 1.7 / rate).ln() / rate;
    assert!((one - 41.0..summed + 60.0).contains(&steady), "{steady} for {one} to {summed}");
}

#[test]
fn what_does_not_settle_is_never_steady() {
    let motions: [(&str, &dyn Fn(f64) -> f64); 5] = [
        ("without damping", &|t| t * wave(t)),
        ("creeping", &|t| wave(t) + 1e-6 * t),
        ("growing", &|t| wave(t) * (1.0 + 1e-3 * (0.02 * t).exp())),
        ("twice the period", &|t| wave(t) + 1e-4 * (0.5 * TAU * t).sin()),
        ("beating for ever", &|t| wave(t) * (1.0 + 0.3 * (0.02 * TAU * t).sin())),
    ];
    for (name, motion) in motions {
        let found = told(400.0, motion);
        assert!(found.steady.is_none() && found.known.is_none(), "{name}: {:?}", found.steady);
        assert!(found.left > 0.01, "{name}: {}", found.left);
    }
}

#[test]
fn what_repeats_from_the_start_is_steady_as_soon_as_that_can_be_known() {
    // At rest; between steps; with a kink that interpolation misses; over an offset.
    let motions: [(&str, &dyn Fn(f64) -> f64); 4] = [
        ("rest", &|_| 0.0),
        ("wave", &wave),
        ("kink", &|t| wave(t).max(2e-4)),
        ("offset", &|t| 5e-3 + wave(t)),
    ];
    for (name, motion) in motions {
        let found = told(40.0, motion);
        let known = found.known.expect(name);
        assert!(known < LEAST as f64 + 2.0, "{name}: {known}");
        assert!(found.left < 1e-3, "{name}: {}", found.left);
    }
}

const LEAST: usize = SteadyRule::Remaining.cycles();

#[test]
fn what_changes_again_was_not_steady() {
    let found = told(60.0, |t| if t < 40.5 { wave(t) } else { 2.0 * wave(t) });
    assert!(found.steady.is_some_and(|steady| steady > 40.0), "{:?}", found.steady);
}

#[test]
fn a_test_that_is_kept_goes_on_as_it_was() {
    let run = |cut: bool| {
        let mut test = SteadyTest::new(SteadyRule::Remaining, [1, 1], 1.0, 0.013);
        for step in 1..3000 {
            if cut && step == 1234 {
                let kept = postcard::to_allocvec(&test).expect("bytes");
                test = postcard::from_bytes(&kept).expect("the test");
            }
            let t = f64::from(step) * 0.013;
            test.add(t, [100.0, resonance(0.02)(t)].iter());
        }
        test
    };
    assert_eq!(run(true), run(false));
}
