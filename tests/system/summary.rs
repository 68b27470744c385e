//! What summary.json says of the reference analyses.

use serde_json::Value;

use crate::run::shipped;

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

#[test]
fn energy_balances() {
    for case in ["hu2003-1", "hu2003-2", "hu2003-3", "hu2003-4", "hu2003-5"] {
        let balance = &shipped(case).summary["energy_balance_j"];
        let parts = ["kinetic", "strain", "spring", "dissipated", "error"];
        let sum: f64 = parts.iter().map(|part| number(balance, part)).sum();
        let work = number(balance, "work_in");
        assert!((sum - work).abs() <= 1e-12 * work.abs(), "{case}: {balance}");
        // Of what flexible motion takes part in, not of the far larger energy of rotation.
        let flexible = number(balance, "strain") + number(balance, "dissipated");
        let error = number(balance, "error").abs();
        assert!(error <= 1e-4 * flexible, "{case}: {error} J are missing, {flexible} J flow");
    }
}
