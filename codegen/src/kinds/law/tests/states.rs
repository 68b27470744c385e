//! Laws that remember.

use super::*;
use crate::tape::Tape;

/// A spring beside a spring and a damper in series, the states' units not SI.
const ZENER: &str = "stored = 'k*h^2/2 + k_m*(h - z)^2/2'
[inputs.h]
unit = \"mm\"
range = [-1, 1]
[states.z]
unit = \"mm\"
start = 0.25
range = [-1, 1]
[parameters]
k = { value = 2, unit = \"kN/mm\" }
k_m = { value = 1, unit = \"kN/mm\" }
tau = { value = 2, unit = \"ms\" }
[rates]
z = '(h - z)/tau'
[outputs.Q]
unit = \"N\"
value = '-k*h - k_m*(h - z)'
";

#[test]
fn a_state_is_one_more_input_and_its_rate_one_more_output() {
    let law = read(ZENER).unwrap_or_else(|errors| panic!("{errors}"));
    let names = |inputs: &[LawInput]| inputs.iter().map(|own| own.name.clone()).collect::<Vec<_>>();
    assert_eq!((names(law.taken()), names(law.remembered())), (vec!["h".into()], vec!["z".into()]));
    assert_eq!(law.states, [LawState { start: Some(0.25e-3) }]);
    let given: Vec<&str> = law.given().iter().map(|own| own.name.as_str()).collect();
    assert_eq!(given, ["Q"]);
    assert_eq!(law.outputs[1].name, "z_dot");
    assert_eq!(law.outputs[1].unit.text(), "mm/s");
    let tape = Tape::new(&law.program().unwrap());
    let mut rows = vec![f64::NAN; 6];
    tape.evaluate(1, &[3e-4, -1e-4], &mut rows, &mut vec![0.0; tape.workspace()]);
    // Q with its slopes by h and z, then ż with its.
    let exact = [-2e6 * 3e-4 - 1e6 * 4e-4, -3e6, 1e6, 4e-4 / 2e-3, 500.0, -500.0];
    for (found, exact) in rows.iter().zip(exact) {
        assert!((found - exact).abs() <= 1e-12 * exact.abs(), "{found} for {exact}");
    }
    let stored = Tape::new(&law.stored_program().unwrap().unwrap());
    let mut energy = [f64::NAN];
    stored.evaluate(1, &[3e-4, -1e-4], &mut energy, &mut vec![0.0; stored.workspace()]);
    assert!((energy[0] - (0.09 + 0.08)).abs() < 1e-15, "{energy:?}");
    assert!(law.stores());
}

#[test]
fn a_report_says_how_fast_states_come_to_rest() {
    let law = read(ZENER).unwrap();
    assert_eq!(law.report.states[0].rates, [500.0; 2]);
    assert!(law.report.to_string().contains("z relaxes at 500 1/s"), "{}", law.report);
    let of = |rate: &str| {
        let body = ZENER.replace("(h - z)/tau", rate);
        read(&body).unwrap_or_else(|errors| panic!("{errors}")).report.states[0].to_string()
    };
    // A number as a factor takes any unit.
    assert_eq!(of("(h - 1*z^3)/tau"), "z relaxes at 0 to 1500 1/s");
    assert_eq!(of("(h + z)/tau"), "z grows at 500 to 500 1/s");
    assert_eq!(of("h/tau"), "z does not come to rest by itself");
    assert_eq!(
        of("(h - 1*z^2)/tau"),
        "z relaxes at up to 1000 1/s, and grows at up to 1000 1/s in places"
    );
}

#[test]
fn the_rest_of_a_state_is_no_value() {
    let law = read(&ZENER.replace("start = 0.25", "start = \"rest\"")).unwrap();
    assert_eq!(law.states, [LawState { start: None }]);
}

#[test]
fn what_is_wrong_with_states_is_said() {
    let cases: &[(&str, &str, &str)] = &[
        (
            "start = 0.25\n",
            "",
            "law.toml:9:9: `z` does not say how it begins (write `start = 0`, in its unit, or `start = \"rest\"`, where its rate is zero)",
        ),
        (
            "start = 0.25",
            "start = \"zero\"",
            "law.toml:11:9: `start` must be a number, or \"rest\" (\"rest\" begins where the rate of the state is zero)",
        ),
        (
            "z = '(h - z)/tau'\n",
            "",
            "law.toml:9:9: `z` has no rate (write `z = '…'` in a section `[rates]`, its change per second)",
        ),
        (
            "z = '(h - z)/tau'",
            "z = 'h - z'",
            "law.toml:18:6: `z_dot` is a speed, but this is a length (a parameter with a unit is missing as a factor; a number as a factor takes any unit)",
        ),
        (
            "z = '(h - z)/tau'",
            "z = '(h - z)/tau'\ny = 'h/tau'",
            "law.toml:19:1: `y` is not a state of this law (known: `z`)",
        ),
        (
            "'k*h^2/2 + k_m*(h - z)^2/2'",
            "'k*h'",
            "law.toml:5:11: what is stored is an energy, but this is a force (a force times a length is one, such as 'k*x^2/2')",
        ),
        (
            "tau = { value = 2, unit = \"ms\" }",
            "tau = { value = 2, unit = \"ms\" }\nz_dot = { value = 1, unit = \"1\" }",
            "law.toml:9:9: `z_dot` is the name of the rate of `z` (choose another name for the state)",
        ),
    ];
    for (from, to, expected) in cases {
        let body = ZENER.replacen(from, to, 1);
        let found = messages(&body);
        assert!(found.iter().any(|own| own == expected), "{expected}\n{found:#?}");
    }
}

/// A rate that jumps has no derivative there, and no `jump` or `smooth` of outputs.
#[test]
fn rates_do_not_jump() {
    let body = ZENER.replace("(h - z)/tau", "(h - z)/tau*(h - z)/abs(h - z)");
    let found = messages(&body).join("\n");
    assert!(found.contains("`z_dot` "), "{found}");
    assert!(found.contains("must be continuous") || found.contains("no finite value"), "{found}");
}
