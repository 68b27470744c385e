use super::*;

/// |Ω²/(ω² − Ω² + 2iζωΩ)| of one mass with an unbalance, in eccentricities.
fn one_mass(omega: f64, zeta: f64) -> impl Fn(f64) -> f64 {
    move |speed| {
        let r = speed / omega;
        r * r / (1.0 - r * r).hypot(2.0 * zeta * r)
    }
}

/// The damped critical speed: Im λ = Ω at ω√(1 − ζ²).
fn of_mass(omega: f64, zeta: f64) -> Resonance {
    let speed = omega * (1.0 - zeta * zeta).sqrt();
    Resonance { speed, half_width: zeta * speed }
}

/// The peaks of a function, and how often it was asked for.
fn found(of: impl Fn(f64) -> f64, resonances: &[Resonance], range: [f64; 2]) -> (Peaks, usize) {
    let mut evaluations = 0;
    let mut response = |speed: f64| {
        evaluations += 1;
        assert!((range[0]..=range[1]).contains(&speed), "{speed} is in the range");
        let own = of(speed);
        Ok(Some(Amplitude { own, largest: own }))
    };
    let all = peaks(&mut response, resonances, range).expect("no error");
    (all, evaluations)
}

/// The peak is at ω/√(1 − 2ζ²), with a height of h = 1/(2ζ√(1 − ζ²)) eccentricities; half power where
/// r⁴ (1 − 2/h²) − 2 (1 − 2ζ²) r² + 1 = 0, with no root above if h² < 2. What is left is that near a maximum rounding of 1e-16 hides 1e-8 widths.
#[test]
fn peaks_of_one_mass_are_those_of_the_closed_form() {
    for zeta in [1e-6, 1e-4, 0.002, 0.03, 0.2, 0.5] {
        for (omega, range) in [(100.0, [0.0, 1000.0]), (350.0, [7.3, 1.9 * 350.0])] {
            let (all, evaluations) = found(one_mass(omega, zeta), &[of_mass(omega, zeta)], range);
            let [peak] = all.all.as_slice() else { panic!("{zeta}: {all:?}") };
            let exact = omega / (1.0_f64 - 2.0 * zeta * zeta).sqrt();
            assert!((peak.speed - exact).abs() < 1e-6 * zeta * omega, "{zeta}: {peak:?} {exact}");
            let height = 0.5 / (zeta * (1.0_f64 - zeta * zeta).sqrt());
            assert!((peak.height / height - 1.0).abs() < 1e-9, "{zeta}: {peak:?}");
            assert_eq!(all.end, None);
            // (1 − 2ζ²)² − (1 − 2/h²) = 4ζ² (1 − ζ²).
            let (p, root) = (1.0 - 2.0 * zeta * zeta, 1.0 / height);
            let a = 1.0 - 2.0 / (height * height);
            let below = omega * ((p - root) / a).sqrt();
            let above = Some(omega * ((p + root) / a).sqrt());
            let above = above.filter(|own| *own <= range[1]);
            let near = |own: Option<f64>, exact: Option<f64>| match (own, exact) {
                (Some(own), Some(exact)) => (own - exact).abs() < 1e-6 * zeta * omega,
                (own, exact) => own == exact,
            };
            assert!(near(peak.half_power[0], Some(below)), "{zeta}: {peak:?} {below}");
            assert!(near(peak.half_power[1], above), "{zeta}: {peak:?} {above:?}");
            let width = above.map_or(2.0 * (exact - below), |above| above - below);
            let factor = peak.amplification().expect("a side");
            assert!((factor * width / exact - 1.0).abs() < 1e-5, "{zeta}: {factor}");
            assert!(evaluations < 260, "{zeta}: {evaluations}");
        }
    }
}

/// Two masses of which each is seen with its own sign: the sum has two peaks of these widths, or one where they are nearer than
/// these; none is listed twice.
#[test]
fn near_peaks_are_apart_as_far_as_the_response_has_them() {
    let lorentz = |speed: f64, own: Resonance| {
        num_complex::Complex64::new(own.half_width, speed - own.speed).inv()
    };
    for (apart, count, between) in
        [(0.5, 1, true), (2.2, 2, false), (6.0, 2, true), (30.0, 2, true), (1e4, 2, true)]
    {
        let half_width = 1e-4;
        let pair = [100.0, 100.0 + apart * half_width].map(|speed| Resonance { speed, half_width });
        let of = |speed: f64| (lorentz(speed, pair[0]) + lorentz(speed, pair[1])).norm();
        // Critical speeds may be found twice.
        let (all, _) = found(of, &[pair[0], pair[1], pair[1]], [20.0, 300.0]);
        assert_eq!(all.all.len(), count, "{apart}: {all:?}");
        for (own, seed) in all.all.iter().zip(&pair).filter(|_| count == 2) {
            assert!((own.speed - seed.speed).abs() < 0.5 * half_width, "{apart}: {own:?}");
        }
        // Halfway it is 2/(1 + (apart/2)²), at the peaks about |1 + 1/(1 + i apart)|: for 2.2 the share is 0.74, for 6 it is 0.2.
        let sides: Vec<bool> =
            all.all.iter().flat_map(|own| own.half_power.map(|side| side.is_some())).collect();
        let known = if count == 1 { vec![true; 2] } else { vec![true, between, between, true] };
        assert_eq!(sides, known, "{apart}: {all:?}");
    }
}

/// The response at an end of the range is no peak, and where it is the largest of all that is said.
#[test]
fn ends_of_the_range_are_no_peaks() {
    let (omega, zeta) = (100.0, 0.01);
    let of = one_mass(omega, zeta);
    let cut = |range: [f64; 2]| found(&of, &[of_mass(omega, zeta)], range).0;
    let below = cut([10.0, 99.99]);
    assert!(below.all.is_empty(), "{below:?}");
    assert_eq!(below.end.map(|own| own.0), Some(99.99));
    let above = cut([100.02, 300.0]);
    assert!(above.all.is_empty(), "{above:?}");
    assert_eq!(above.end, Some((100.02, of(100.02))));
    // Just within the range it is one, with the side that is there.
    let within = cut([10.0, 100.03]);
    let [peak] = within.all.as_slice() else { panic!("{within:?}") };
    assert!((peak.speed - omega / (1.0 - 2.0 * zeta * zeta).sqrt()).abs() < 1e-6);
    let [Some(below), None] = peak.half_power else { panic!("{peak:?}") };
    let factor = peak.amplification().expect("one side");
    assert!((factor * 2.0 * (peak.speed - below) / peak.speed - 1.0).abs() < 1e-12);
    for of in [|_: f64| 2.0, |_| 0.0, |speed: f64| 1.0 / (1.0 + speed)] {
        assert!(found(of, &[of_mass(5.0, 1e-5)], [1.0, 10.0]).0.all.is_empty());
    }
}

/// What rounding excites of a mode is no peak, however light its damping, and neither are ripples of rounding.
#[test]
fn rounding_has_no_peaks() {
    for zeta in [0.0, 1e-12, 1e-7, 2e-7, 1e-6, 1e-3] {
        let seed = of_mass(100.0, zeta);
        let of = |speed: f64| {
            let bump = 1e-12 * 100.0 / (speed - seed.speed).hypot(zeta * 100.0);
            speed + bump + 1e-14 * (speed * 12_345.678).sin()
        };
        let (all, _) = found(of, &[seed], [10.0, 200.0]);
        assert!(all.all.is_empty(), "{zeta}: {all:?}");
    }
    // A response that is rounding beside others of its kind, with peaks of its own.
    let (of, largest) = (one_mass(100.0, 0.01), one_mass(100.0, 0.01));
    let mut response =
        |speed: f64| Ok(Some(Amplitude { own: 1e-10 * of(speed), largest: largest(speed) }));
    let all = peaks(&mut response, &[of_mass(100.0, 0.01)], [10.0, 200.0]).expect("no error");
    assert_eq!(all, Peaks::default());
}

/// Without damping a peak is where the critical speed is, and has no height; damped ones beside it stay.
#[test]
fn undamped_peaks_are_named() {
    let damped = one_mass(150.0, 0.01);
    let of = |speed: f64| 1.0 / (1.0 - (speed / 100.0).powi(2)).abs() + damped(speed);
    let seeds = [of_mass(100.0, 0.0), of_mass(100.0, 1e-15), of_mass(150.0, 0.01)];
    let (all, _) = found(of, &seeds, [0.0, 400.0]);
    let [first, second] = all.all.as_slice() else { panic!("{all:?}") };
    assert!(first.is_undamped() && first.speed == 100.0, "{first:?}");
    assert_eq!(first.amplification(), Some(f64::INFINITY));
    assert!(!second.is_undamped() && (second.speed - 150.0).abs() < 0.1, "{second:?}");
}

/// Where the machine does not stand there is no response, and no peak is found across.
#[test]
fn gaps_are_left_out() {
    let of = one_mass(100.0, 0.05);
    let mut response =
        |speed: f64| Ok((speed > 60.0).then(|| Amplitude { own: of(speed), largest: of(speed) }));
    let all = peaks(&mut response, &[of_mass(100.0, 0.05)], [0.0, 300.0]).expect("no error");
    assert_eq!(all.all.len(), 1, "{all:?}");
    let mut response = |speed: f64| {
        Ok(((speed - 100.0).abs() > 20.0).then(|| Amplitude { own: of(speed), largest: of(speed) }))
    };
    let all = peaks(&mut response, &[of_mass(100.0, 0.05)], [0.0, 300.0]).expect("no error");
    assert!(all.all.is_empty(), "{all:?}");
}

/// A response that is below half of the power for a moment between samples, by 2e-6 within 0.1, has its half power there.
#[test]
fn a_short_dip_below_half_power_is_seen() {
    let least = std::f64::consts::FRAC_1_SQRT_2 - 2e-6;
    let of = |speed: f64| {
        let turn = std::f64::consts::PI * (speed - 100.0) / 10.0;
        least + 0.5 * (1.0 - least) * (1.0 + turn.cos())
    };
    let own = Resonance { speed: 100.0, half_width: 10.0 };
    let (all, _) = found(of, &[own], [83.0, 117.0]);
    let peak = all.all.iter().find(|own| (own.speed - 100.0).abs() < 0.1).expect("the peak");
    for (side, from) in peak.half_power.iter().zip([90.0, 109.9]) {
        let at = side.expect("a half power");
        assert!((from..from + 0.1).contains(&at), "{peak:?}");
        assert!((of(at) - std::f64::consts::FRAC_1_SQRT_2).abs() < 1e-9, "{peak:?}");
    }
}
