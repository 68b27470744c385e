//! Motions that are accepted, and what is wrong with others.

use super::*;

const EXPLICIT: &str = r#"
kind = "motion"
name = "explicit"
title = "A shaft by its terms"
source = "Lagrange"

[coordinates]
theta = "scalar"
eta = "vector"

[tensors]
J0 = "scalar"
y0 = "vector"
g0 = "vector"
M = "symmetric"
Y = "symmetric"
H = "skew"

[mass]
theta.theta = 'J0 + 2*dot(y0, eta) + dot(eta, Y*eta)'
theta.eta = 'g0 - H*eta'
eta.theta = 'g0 - H*eta'
eta.eta = 'M'

[quadratic_velocity]
theta = '-2*dot(y0 + Y*eta, eta_dot)*theta_dot'
eta = '(y0 + Y*eta)*theta_dot^2 + 2*(H*eta_dot)*theta_dot'

[PF]
theta.eta = '2*(y0 + Y*eta)*theta_ddot + H*eta_ddot'
eta.eta = '-H*theta_ddot'

[B]
theta.eta = '-2*theta_dot*(Y*eta_dot)'
eta.eta = 'Y*theta_dot^2'

[P]
theta.theta = '-2*dot(y0 + Y*eta, eta_dot)'
theta.eta = '-2*(y0 + Y*eta)*theta_dot'
eta.theta = '2*(y0 + Y*eta)*theta_dot + 2*H*eta_dot'
eta.eta = '2*H*theta_dot'
"#;

fn errors(text: &str) -> String {
    match MotionSpec::read(&Source::new("motion/explicit.toml", text)) {
        Ok(_) => String::new(),
        Err(errors) => errors.render(),
    }
}

#[test]
fn declared_derivatives_that_hold_are_accepted() {
    assert_eq!(errors(EXPLICIT), "");
}

#[test]
fn a_wrong_block_is_named_with_both_sides() {
    let text = errors(&EXPLICIT.replace("eta.eta = '-H*theta_ddot'", "eta.eta = 'H*theta_ddot'"));
    assert!(text.contains("`PF.eta.eta` is not the derivative of the declared terms"), "{text}");
    assert!(text.contains("declared theta_ddot*H, derived -theta_ddot*H"), "{text}");
    assert!(text.contains("motion/explicit.toml:31:12"), "{text}");
}

#[test]
fn an_omitted_block_is_zero_and_must_be_so() {
    let text = errors(&EXPLICIT.replace("eta.eta = 'Y*theta_dot^2'", ""));
    assert!(text.contains("`B.eta.eta`"), "{text}");
}

#[test]
fn an_unsymmetric_mass_is_refused() {
    let wrong = EXPLICIT.replace("eta.theta = 'g0 - H*eta'", "eta.theta = 'g0 + H*eta'");
    assert!(errors(&wrong).contains("the mass matrix is not symmetric in theta and eta"));
}

const ENERGY: &str = r#"
kind = "motion"
name = "pendulum"
title = "A rotor with one flexible part"
source = "Lagrange"
kinetic_energy = '1/2*J*theta_dot^2 + 1/2*dot(eta_dot, M*eta_dot)'

[coordinates]
theta = "scalar"
eta = "vector"

[tensors]
J = "scalar"
M = "symmetric"
"#;

#[test]
fn an_energy_must_be_quadratic_in_the_rates() {
    assert_eq!(errors(ENERGY), "");
    let relativistic = errors(&ENERGY.replace("theta_dot^2", "theta_dot^4"));
    assert!(relativistic.contains("`mass.theta.theta` depends on `theta_dot`"), "{relativistic}");
    assert!(relativistic.contains("motion/explicit.toml:6:19"), "{relativistic}");
    let jerk = errors(&ENERGY.replace("J*theta_dot^2", "J*theta_dot*theta_ddot"));
    assert!(jerk.contains("depends on `theta_ddot`"), "{jerk}");
}

#[test]
fn declared_terms_depend_on_what_they_may() {
    let wrong = EXPLICIT
        .replace("eta.eta = 'M'", "eta.eta = 'M*theta_dot'")
        .replace("theta = '-2*dot(y0", "theta = '-2*theta_ddot*dot(y0");
    let text = errors(&wrong);
    assert!(text.contains("`mass.eta.eta` depends on `theta_dot`"), "{text}");
    assert!(text.contains("`quadratic_velocity.theta` depends on `theta_ddot`"), "{text}");
}

#[test]
fn names_of_the_generator_are_refused() {
    for name in ["n_", "out_", "a1_"] {
        let text = errors(&ENERGY.replace("J = ", &format!("{name} = \"scalar\"\nJ = ")));
        assert!(text.contains(&format!("`{name}` ends in `_`")), "{text}");
    }
}

#[test]
fn shapes_and_missing_parts_are_named() {
    for (from, to, expected) in [
        ("theta.eta = 'g0 - H*eta'", "theta.eta = 'J0'", "its place wants a vector"),
        ("H = \"skew\"", "H = \"skow\"", "did you mean `skew`?"),
        ("eta = \"vector\"", "eta = \"scalar\"", "`coordinates.eta` cannot be `scalar`"),
        ("[PF]", "[PQ]", "unknown key `PQ`"),
        ("eta.eta = '2*H*theta_dot'", "eta.eta = '2*H*theta_dto'", "did you mean `theta_dot`?"),
    ] {
        let text = errors(&EXPLICIT.replace(from, to));
        assert!(text.contains(expected), "{to}: {text}");
    }
    let neither = errors(&ENERGY.replace("kinetic_energy", "#"));
    assert!(neither.contains("a motion needs `kinetic_energy`, or the tables"), "{neither}");
}
