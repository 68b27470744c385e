//! The mass: its equations stepped here, by Newmark's method with (½, ¼).

use super::Results;

const MASS: f64 = 3.0;
const STIFFNESS: f64 = 2e4;
const DAMPING: f64 = 35.0;
const FORCE: f64 = 17.0;
const ECCENTRICITY: f64 = 0.4e-3;
const SPEED: f64 = 95.0;
const STEP: f64 = 2e-4;
const STEPS: usize = 900;
/// Of the stops above and below (m).
const GAPS: [f64; 2] = [0.9e-3, 0.7e-3];

/// Q of buffer.toml.
fn buffer(h: f64, h_dot: f64) -> f64 {
    40.0 * (-h / 0.5e-3).exp() * (1.0 - 0.3 * h_dot)
}

/// Steps from one row of the history to the next.
const EVERY: usize = 3;

/// Radius with which the mass skids on the stop below (m).
const RADIUS: f64 = 30e-3;

/// Q and T of skid.toml with the values of its stop.
fn skid(h: f64, v_t: f64) -> [f64; 2] {
    let q = 30.0 * (-h / 0.6e-3).exp();
    [q, -0.2 * q * (v_t / 4.0).tanh()]
}

/// Forces along x, y of the stops above, below and around a mass that moves.
fn stops([x, y]: [f64; 2], [vx, vy]: [f64; 2]) -> [[f64; 2]; 3] {
    // Below, the tangent that positive rotation follows points along −y.
    let [push, friction] = skid(GAPS[1] + x, RADIUS * SPEED - vy);
    [[-buffer(GAPS[0] - x, -vx), 0.0], [push, -friction], [-3e3 * x - 1.5e3 * y, 2e3 * x - 4e3 * y]]
}

/// Acceleration of the ground along x and y (m/s²), by the rows of quake.csv, one and a half times as large.
fn ground(t: f64) -> [f64; 2] {
    const G: f64 = 9.80665;
    let rows = [
        [0.0, 0.0, 0.4],
        [0.02, 0.2 * G, -1.5],
        [0.05, -0.15 * G, 2.0],
        [0.12, 0.1 * G, 0.3],
        [0.15, 0.05 * G, 0.0],
    ];
    let after = rows.iter().position(|row| row[0] > t);
    [1, 2].map(|axis| match after {
        Some(k) => {
            let ([from, a, b], [to, c, d]) = (rows[k - 1], rows[k]);
            let [first, last] = [[a, c], [b, d]][axis - 1];
            1.5 * (first + (last - first) * (t - from) / (to - from))
        }
        None => 1.5 * rows[4][axis],
    })
}

/// m ẍ of a mass that moves, seen from the ground.
fn push(t: f64, q: [f64; 2], v: [f64; 2]) -> [f64; 2] {
    let turning = MASS * ECCENTRICITY * SPEED * SPEED;
    let (sin, cos) = (SPEED * t).sin_cos();
    let mut sum = [FORCE + turning * cos, turning * sin];
    for axis in 0..2 {
        sum[axis] -= MASS * ground(t)[axis];
        sum[axis] -= STIFFNESS * q[axis] + DAMPING * v[axis];
        stops(q, v).iter().for_each(|stop| sum[axis] += stop[axis]);
    }
    sum
}

#[test]
fn a_mass_is_what_its_case_says() {
    let results = Results::of("mass", &[]);
    let history = &results.history;
    assert_eq!(history.column("t_s").len(), STEPS / EVERY);
    let (mut q, mut v) = ([0.3e-3, 0.0], [-0.12, 0.0]);
    let mut a = push(0.0, q, v).map(|force| force / MASS);
    let mut rows = Vec::new();
    for step in 1..=STEPS {
        let t = step as f64 * STEP;
        // q = q_n + Δt v_n + ¼ Δt² (a_n + a), v = v_n + ½ Δt (a_n + a): a fixed point of a, which a step
        // contracts by ¼ Δt² (k + k_stops)/m + ½ Δt d/m < 0.01.
        let mut next = a;
        let mut at = (q, v);
        for _ in 0..12 {
            for axis in 0..2 {
                let both = a[axis] + next[axis];
                at.0[axis] = q[axis] + STEP * v[axis] + 0.25 * STEP * STEP * both;
                at.1[axis] = v[axis] + 0.5 * STEP * both;
            }
            next = push(t, at.0, at.1).map(|force| force / MASS);
        }
        (q, v) = at;
        a = next;
        if step % EVERY == 0 {
            rows.push((t, q, stops(q, v)));
        }
    }
    let largest = |of: &dyn Fn(&(f64, [f64; 2], [[f64; 2]; 3])) -> f64| {
        rows.iter().map(of).fold(0.0, |m: f64, v| m.max(v.abs()))
    };
    let close = |name: String, of: &dyn Fn(&(f64, [f64; 2], [[f64; 2]; 3])) -> f64| {
        let peak = largest(of);
        for (row, (found, expected)) in
            history.column(&name).iter().zip(rows.iter().map(of)).enumerate()
        {
            // Steps are solved to 1e-7 of the largest force, and errors of oscillations add up as the root
            // of the number of steps.
            let wrong = (found - expected).abs();
            assert!(wrong <= 3e-6 * peak, "{name} in row {row}: {found}, by hand {expected}");
        }
    };
    close("t_s".to_owned(), &|row| row.0);
    for k in 1..=3 {
        for (axis, letter) in ["X", "Y"].into_iter().enumerate() {
            close(format!("{letter}{k}_um"), &|row| 1e6 * row.1[axis]);
            close(format!("E{letter}{k}_um"), &|row| 1e6 * row.1[axis]);
            if (k, letter) != (1, "Y") {
                close(format!("R{letter}{k}_N"), &|row| row.2[k - 1][axis]);
            }
        }
    }
    // Friction turns the mass back, at its radius.
    close("MZ2_Nm".to_owned(), &|row| -RADIUS * row.2[1][1]);
    close("theta_rad".to_owned(), &|row| SPEED * row.0);
    // The stop above pushes along x alone.
    assert!(history.column("RY1_N").iter().all(|force| force.abs() < 1e-12));
    results.sums_up(1.0 / 12.0);
}

/// A mass on its spring in steps that are chosen: cos ωt but for its phase, at all rows.
#[test]
fn a_mass_moves_in_chosen_steps() {
    let results = Results::of("chosen", &[]);
    let (omega, tolerance) = (200.0, 1e-5);
    let (times, places) = (results.history.column("t_s"), results.history.column("x_place_um"));
    assert_eq!(times.len(), 100);
    // A step of r = ωΔt has the local error r³/12 at most, and is late by r³/12: r² /12 of the phase.
    let r = f64::cbrt(12.0 * tolerance);
    let late = omega * 0.3 * r * r / 12.0;
    for (step, (time, place)) in times.iter().zip(places).enumerate() {
        assert!((time - 3e-3 * (step + 1) as f64).abs() < 1e-12, "{time}");
        let exact = 1e3 * (omega * time).cos();
        // r³/12 is the error but for the next term, r⁵.
        assert!((place - exact).abs() <= 1e3 * 1.01 * late, "{time} s: {place} for {exact}");
    }
    let facts = &results.summary["march"]["automatic"];
    // The first stands where the acceleration hardly changes, and may be twice as long.
    let longest = facts["longest_step_s"].as_f64().expect("a number");
    assert!(omega * longest <= 2.0 * r, "{facts}");
    assert!(facts["steps"].as_u64().expect("a count") > 1000, "{facts}");
    assert_eq!(results.summary["march"]["time_step_s"], serde_json::Value::Null);
    let said = results.bench.whirl(&["check", "chosen.toml"]).stdout;
    assert!(
        said.contains("the program chooses the steps, at most 3e-3 s, for a local error of 1e-5"),
        "{said}"
    );
}
