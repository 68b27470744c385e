//! The ball bearing, against Stribeck's load distribution and the frequency of its balls; the bore with a gap
//! by angle.

use std::f64::consts::PI;

use super::kernel::Kernel;

/// Half the radial internal clearance of the shipped bearing.
const GAP: f64 = 10e-6;
const BALLS: f64 = 8.0;
const STIFFNESS: f64 = 13.34e9;
/// Revolutions of the cage to one of the shaft.
const CAGE: f64 = 40.0094 / (40.0094 + 71.9466);

#[test]
fn balls_share_the_load_as_stribeck_found() {
    let law = Kernel::named("ball-bearing");
    // Load distribution integral J_r of point contact by the extent ε of the load zone (Harris, Rolling Bearing
    // Analysis): F = Z Q_max J_r, Q_max = K δ^1.5, ε = (1 − G/2e)/2.
    for (extent, integral) in [(0.1, 0.1156), (0.2, 0.1590), (0.3, 0.1892), (0.4, 0.2117)] {
        let e = GAP / (1.0 - 2.0 * extent);
        // The mean over turns of the cage is the integral: the balls pass every angle. 400 turns of a
        // function with a continuous derivative and period 2π/Z leave 1e-5 of it;
        // at ε = 1/2 there is no clearance.
        let turns = 400;
        let force: f64 = (0..turns)
            .map(|i| {
                let theta = 2.0 * PI / BALLS / CAGE * f64::from(i) / f64::from(turns);
                -law.value("F_x", &[("e_x", e), ("theta", theta)]) / f64::from(turns)
            })
            .sum();
        let peak = STIFFNESS * (e - GAP).powf(1.5);
        let found = force / (BALLS * peak);
        // Half a unit of the last printed digit.
        assert!((found - integral).abs() <= 5.5e-5, "{extent}: {found}");
    }
}

#[test]
fn the_bearing_turns_with_its_cage() {
    let law = Kernel::named("ball-bearing");
    let force = |theta: f64| {
        let inputs = [("e_x", 12e-6), ("e_y", 8e-6), ("theta", theta)];
        [law.value("F_x", &inputs), law.value("F_y", &inputs)]
    };
    // Varying compliance at 2.86 times the speed of the shaft (Fukata et al.): by then the next ball is
    // where the last one was.
    let period = 2.0 * PI / (BALLS * CAGE);
    assert!((2.0 * PI / period - 2.86).abs() < 0.005);
    for theta in [0.0, 0.3, 1.0, 4.0] {
        let (now, then, between) =
            (force(theta), force(theta + period), force(theta + period / 2.0));
        for i in 0..2 {
            // Rounding of angles of a few rad, magnified by the slope of the 1.5th power.
            assert!((now[i] - then[i]).abs() < 1e-10 * now[0].abs(), "{now:?} {then:?}");
        }
        assert!(f64::hypot(now[0] - between[0], now[1] - between[1]) > 1e-3 * now[0].abs());
    }
    // Within the clearance nothing carries; damping is there always.
    assert_eq!(law.value("F_x", &[("e_x", 0.99 * GAP), ("theta", 1.0)]), 0.0);
    let damped = law.value("F_y", &[("e_y_dot", 0.01)]);
    assert!((damped + 2.0).abs() < 1e-14, "{damped}");
    // Turning the displacement and the cage by one ball's angle turns the force by as much.
    let (turn, theta) = (2.0 * PI / BALLS, 0.7);
    let e = [20e-6, -5e-6];
    let turned = [e[0] * turn.cos() - e[1] * turn.sin(), e[0] * turn.sin() + e[1] * turn.cos()];
    let at = |e: [f64; 2]| {
        let inputs = [("e_x", e[0]), ("e_y", e[1]), ("theta", theta)];
        [law.value("F_x", &inputs), law.value("F_y", &inputs)]
    };
    let (before, after) = (at(e), at(turned));
    let expected = before[0] * turn.cos() - before[1] * turn.sin();
    assert!((after[0] - expected).abs() < 1e-9 * before[0].abs(), "{after:?} {expected}");
}

#[test]
fn the_stiffness_of_a_ball_is_about_that_of_palmgrens_formula() {
    // d = 4.36e-4 Q^(2/3)/D^(1/3), mm and N, for both contacts of a deep groove bearing; ball of 11.9062 mm.
    let palmgren = f64::sqrt(11.9062) / 4.36e-4_f64.powf(1.5) * 1e3_f64.powf(1.5);
    // An approximation for usual curvatures of the races; Hertz's constant for this bearing's is 11 % higher,
    // 7 % in deflection.
    assert!((STIFFNESS / palmgren - 1.0).abs() < 0.15, "{palmgren}");
}

#[test]
fn the_gap_of_the_bore_is_that_of_the_table() {
    let law = Kernel::named("radial-gap");
    // Indented by 20 µm all around: k (20 µm − gap).
    let gap = |degrees: f64| {
        let q = law.value("Q", &[("h", -20e-6), ("psi", degrees.to_radians())]);
        20e-6 - q / 1e7
    };
    for row in 0..48 {
        let degrees = 15.0 * f64::from(row) - 360.0;
        let expected = 1e-5 * (2.0 * degrees.to_radians()).cos();
        // Rows have three digits of a µm.
        assert!((gap(degrees) - expected).abs() <= 0.6e-9, "{degrees}: {}", gap(degrees));
        for share in [3.0, 7.5, 11.0] {
            let between = gap(degrees + share);
            let (low, high) = (gap(degrees), gap(degrees + 15.0));
            // Monotone between rows; and no farther from the oval than chords are, (15°)²/8 times its
            // largest second derivative.
            assert!(between >= low.min(high) - 1e-15 && between <= low.max(high) + 1e-15);
            let oval = 1e-5 * (2.0 * (degrees + share).to_radians()).cos();
            let chord = 15.0_f64.to_radians().powi(2) / 8.0 * 4e-5;
            assert!((between - oval).abs() <= chord, "{}: {between} {oval}", degrees + share);
        }
        let turned = gap(degrees + 360.0);
        assert!((turned - gap(degrees)).abs() < 1e-15, "periodic");
    }
}
