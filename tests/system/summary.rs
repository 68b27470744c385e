//! What summary.json says of the reference analyses.

use serde_json::Value;

use crate::run::{root, run, shipped};

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("no number {key} in {value}"))
}

#[test]
fn counts_are_those_of_table_1() {
    let summary = &shipped("hu2003-1").summary;
    let counts = &summary["counts"];
    let keys = [
        "elements",
        "nodes",
        "physical_dofs",
        "internal_dofs",
        "retained_dofs",
        "modes",
        "craig_bampton_dofs",
    ];
    let of = |body: &str| keys.map(|key| number(&counts[body], key));
    assert_eq!(of("shaft"), [1824.0, 1925.0, 5775.0, 5748.0, 27.0, 50.0, 77.0]);
    assert_eq!(of("support"), [2752.0, 4269.0, 12807.0, 12798.0, 9.0, 150.0, 159.0]);
    assert_eq!([number(counts, "coordinates"), number(counts, "active")], [237.0, 226.0]);
}

#[test]
fn every_analysis_reaches_its_steady_state() {
    for number in 1..=5 {
        let summary = &shipped(&format!("hu2003-{number}")).summary;
        assert_eq!(summary["steady_state"]["reached"], true, "analysis {number}");
    }
}

/// What the loads and the drive did, by the history; where it went, by what can take it.
#[test]
fn energy_is_where_the_loads_and_the_drive_put_it() {
    let balance = |case: &str| shipped(case).summary["energy_balance_j"].clone();
    let still = balance("hu2003-1");
    for case in ["hu2003-1", "hu2003-2", "hu2003-3", "hu2003-4", "hu2003-5"] {
        let balance = balance(case);
        assert_eq!(number(&balance, "spring_dissipated"), 0.0, "{case}: laws Q(h) lose nothing");
        assert!(number(&balance, "dissipated") > 0.0, "{case}");
        // Of what flexible motion takes part in, not of the far larger energy of rotation. Springs that switch
        // within a step make some: of second order, as halved steps show.
        let parts = ["strain", "spring_stored", "dissipated"];
        let flexible: f64 = parts.iter().map(|part| number(&balance, part).abs()).sum();
        let error = number(&balance, "error").abs();
        assert!(error <= 1e-3 * flexible, "{case}: {error} J are missing, {flexible} J flow");
    }
    // At rest under 3000 N nothing moves any more: rounding of rates.
    assert!(number(&still, "kinetic") <= 1e-9 * number(&still, "work_in"), "{still}");

    let history = &shipped("hu2003-2").history;
    let (theta, speed) = (history.column("theta_rad"), history.column("omega_rad_s"));
    let target = 4500.0 * std::f64::consts::TAU / 60.0;
    let reached = speed.iter().position(|omega| *omega >= target).expect("the target speed");
    // 109 N·m up to the row that reaches the target; the trapezium has half of it in the step after.
    let drive = 109.0 * 0.5 * (theta[reached] + theta[reached + 1]);
    let balance = balance("hu2003-2");
    // The loads are constant and fixed in space, so that they do what they do at rest, but for what the
    // turning shaft still vibrates and leans: lateral forces are 0.5 % of the loads.
    let (loads, at_rest) = (number(&balance, "work_in") - drive, number(&still, "work_in"));
    assert!((loads / at_rest - 1.0).abs() <= 5e-3, "loads did {loads} J, {at_rest} J at rest");
    // What turns: J ω²/2 on both sides of the release, J from the work that was done before it.
    let inertia = 2.0 * drive / speed[reached].powi(2);
    let last = speed[speed.len() - 1];
    let turning = 0.5 * inertia * last * last;
    // Both within the step in which the drive stops, 0.46 rad/s at most, and the twist that swings on.
    let kinetic = number(&balance, "kinetic");
    assert!((kinetic / turning - 1.0).abs() <= 2e-3, "{kinetic} J turn, expected {turning} J");
}

/// The error of the balance is what varying matrices and switching springs leave: of second order in the step.
#[test]
fn halving_the_step_quarters_the_error_of_the_balance() {
    let [coarse, fine] = ["a-step.toml", "half-a-step.toml"].map(|name| {
        let case = root().join("tests/system/cases").join(name);
        let summary = run(case.to_str().expect("a UTF-8 path")).summary;
        number(&summary["energy_balance_j"], "error").abs()
    });
    let ratio = coarse / fine;
    assert!((3.0..5.0).contains(&ratio), "{coarse:e} J, {fine:e} J: a ratio of {ratio}");
}

#[test]
fn the_reference_analyses_are_sound() {
    for case in ["hu2003-1", "hu2003-2", "hu2003-3", "hu2003-4", "hu2003-5"] {
        let verdict = &shipped(case).summary["verdict"];
        assert_eq!(verdict["sound"], true, "{case}: {verdict}");
    }
}
