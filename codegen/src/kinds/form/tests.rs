//! Structures are found in the shipped forms; slips are named.

use num_traits::One;

use super::*;
use crate::diagnostic::Source;
use crate::expression::{Rational, normal};
use crate::kinds::form::Place;

const ELASTICITY: &str = include_str!("../../../../specs/forms/elasticity.toml");
const INERTIA: &str = include_str!("../../../../specs/forms/inertia.toml");

/// Without the stress and the form under it.
fn stiffness_alone() -> String {
    let (before, rest) = ELASTICITY.split_once("# The stress that").unwrap();
    let (_, forms) = rest.split_once("\n\n").unwrap();
    let (stiffness, _) = forms.split_once("# sigma_ij").unwrap();
    format!("{before}{stiffness}")
}

fn read(text: &str) -> Result<FormSpec, Vec<String>> {
    let file = Source::new("f.toml", text);
    FormSpec::read(&file).map_err(|errors| errors.iter().map(ToString::to_string).collect())
}

fn pattern(rows: [[i64; 3]; 3]) -> [[Rational; 3]; 3] {
    rows.map(|row| row.map(Rational::from))
}

#[test]
fn the_stiffness_is_symmetric_with_the_coefficients_of_lame() {
    let mut spec = read(ELASTICITY).unwrap();
    let form = spec.forms[0].clone();
    assert_eq!(form.structure, Structure::Symmetric);
    let [lambda, mu] = [0, 1].map(|place| spec.coefficients[place].symbol);
    let two_mu = spec.graph.times(Rational::from(2), mu);
    let stretch = spec.graph.add(lambda, two_mu);
    for (i, j, test, trial, expected) in
        [(0, 0, 1, 1, stretch), (0, 0, 2, 2, mu), (0, 1, 1, 2, lambda), (0, 1, 2, 1, mu)]
    {
        let found = form.bilinear[&Place { i, j, test, trial }];
        assert!(normal::equal(&mut spec.graph, found, expected), "{i} {j} {test} {trial}");
    }
    assert_eq!(form.bilinear.len(), 3 * 3 + 6 * 2);
    let material: Vec<_> = spec.material_of(&form).iter().map(|p| p.name.as_str()).collect();
    assert_eq!(material, ["E", "nu"]);
}

#[test]
fn inertia_is_one_scalar_matrix_times_a_pattern() {
    let spec = read(INERTIA).unwrap();
    let expected = [
        ("mass", [[1, 0, 0], [0, 1, 0], [0, 0, 1]]),
        ("spin_inertia", [[1, 0, 0], [0, 1, 0], [0, 0, 0]]),
        ("spin_coupling", [[0, 1, 0], [-1, 0, 0], [0, 0, 0]]),
    ];
    for (form, (name, rows)) in spec.forms.iter().zip(expected) {
        assert_eq!(form.name, name);
        let Structure::Kronecker { pattern: found, scalar } = &form.structure else {
            panic!("{name}: {:?}", form.structure);
        };
        assert_eq!(**found, pattern(rows), "{name}");
        assert_eq!(scalar.keys().collect::<Vec<_>>(), [&(0, 0)]);
    }
}

#[test]
fn other_structures_are_told_apart() {
    for (text, expected) in [
        ("mu*inner(grad(u), grad(v))", "Kronecker"),
        ("mu*inner(transpose(grad(u)), grad(v))", "Symmetric"),
        ("lambda*dot(u, v)*1 + mu*div(u)*div(v)", "Symmetric"),
        ("mu*dot(u, v) + mu*div(v)", "not linear"),
        ("mu*div(u)^2", "no powers"),
        ("mu*dot(div(u)*v, v)", "only be scaled"),
        ("mu*trace(eps(u))*dot(v, D*v)/1", "not linear"),
        ("mu*div(u)*trace(grad(D*v))", "Full"),
        ("mu*dot(u + D*u, v)", "Full"),
    ] {
        let file =
            stiffness_alone().replace("lambda*div(u)*div(v) + 2*mu*inner(eps(u), eps(v))", text);
        let file =
            file.replace("[forms]", "[matrices]\nD = [[0, -1, 0], [1, 0, 0], [0, 0, 0]]\n[forms]");
        let found = match read(&file) {
            Ok(spec) => format!("{:?}", spec.forms[0].structure),
            Err(errors) => errors.join("; "),
        };
        assert!(found.contains(expected), "{text}: {found}");
    }
}

#[test]
fn slips_of_the_pen_are_named() {
    for (from, to, expected) in [
        (
            "inner(eps(u)",
            "inner(esp(u)",
            "f.toml:20:48: `esp` is not a function of forms (did you mean `eps`?)",
        ),
        ("div(u)*div(v)", "div(u)*div(u)", "the form is not linear in u and in v"),
        ("div(u)*div(v)", "u*v", "a vector times a vector is not defined (write `dot(a, b)`"),
        ("div(u)*div(v)", "div(eps(u))", "`div` does not take a matrix"),
        ("div(u)*div(v)", "div(u)", "the form is not linear"),
        ("lambda*div", "lamda*div", "unknown name `lamda` (did you mean `lambda`?)"),
        ("unit = \"Pa\"", "unit = \"GPa\"", "forms are written in SI units, `GPa` is none"),
        ("mu = 'E/(2*(1 + nu))'", "mu = 'E/(2*(E + nu))'", "cannot be added"),
        ("stiffness =", "Stiffness =", "`Stiffness` cannot be a form's name"),
        ("[material.nu]", "[material.u]", "the name `u` is taken"),
    ] {
        let changed = stiffness_alone().replace(from, to);
        let found = read(&changed).err().unwrap_or_default();
        assert!(found.iter().any(|error| error.contains(expected)), "{expected}: {found:?}");
    }
}

#[test]
fn what_has_no_value_is_refused_as_in_any_formula() {
    const FORM: &str = "lambda*div(u)*div(v) + 2*mu*inner(eps(u), eps(v))";
    for (text, expected) in [
        ("0^(-1)*div(u)*div(v)", "division by zero"),
        ("(-8)^(1/3)*div(u)*div(v)", "a fractional power of a negative number"),
        ("div(u)*div(v)/(lambda*(mu - mu))", "division by zero"),
        // Zero only when it is multiplied out, and by what coefficients stand for.
        ("div(u)*div(v)/((1 + nu)^2 - 1 - 2*nu - nu^2)", "division by zero"),
        ("div(u)*div(v)*(both - mu - twice)^(-1)", "division by zero"),
        ("div(u)*div(v)/none", "division by zero"),
        ("less^(1/2)*div(u)*div(v)", "a fractional power of a negative number"),
    ] {
        let changed = stiffness_alone().replace(FORM, text);
        let more = "none = 'nu - nu'\nless = '-4'\ntwice = '2*mu'\nboth = '3*mu'\n\n[forms]";
        let found = read(&changed.replace("[forms]", more)).err().unwrap_or_default();
        assert!(found.iter().any(|error| error.contains(expected)), "{text}: {found:?}");
    }
    for text in ["0^0*div(u)*div(v)", "(-8)^3*div(u)*div(v)", "(E - nu*E)^(1/2)*div(u)*div(v)/mu"] {
        assert!(read(&stiffness_alone().replace(FORM, text)).is_ok(), "{text}");
    }
}

#[test]
fn the_stress_is_derived_from_the_form() {
    let mut spec = read(ELASTICITY).unwrap();
    let form = spec.forms[1].clone();
    let stress = form.stress.clone().expect("a stress");
    assert_eq!((form.integrated_as(), stress.form.as_str()), ("stiffness", "stiffness"));
    let Structure::Kronecker { pattern: found, .. } = &form.structure else {
        panic!("{:?}", form.structure);
    };
    assert_eq!(**found, pattern([[1, 0, 0], [0, 1, 0], [0, 0, 1]]));
    let [lambda, mu] = [0, 1].map(|place| spec.coefficients[place].symbol);
    let w = stress.slopes;
    let graph = &mut spec.graph;
    // σ = λ tr(ε) 1 + 2 μ ε.
    let one = Rational::one();
    let div = graph.sum(&[0, 1, 2].map(|k| (w[k][k], one.clone())));
    for (i, k) in (0..9).map(|n| (n / 3, n % 3)) {
        let both = graph.add(w[i][k], w[k][i]);
        let mut expected = graph.mul(mu, both);
        if i == k {
            let spread = graph.mul(lambda, div);
            expected = graph.add(expected, spread);
        }
        assert!(normal::equal(graph, stress.components[i][k], expected), "{i} {k}");
        assert!(normal::equal(graph, stress.scalar[&(1 + i, 1 + k)], expected), "{i} {k}");
    }
    let material: Vec<_> = spec.material_of(&form).iter().map(|p| p.name.as_str()).collect();
    assert_eq!(material, ["E", "nu"]);
}

#[test]
fn stresses_that_are_none_are_named() {
    let under = "inner(sigma, transpose(grad(u))*grad(v))";
    for (from, to, expected) in [
        ("sigma = \"stiffness\"", "sigma = \"stifness\"", "there is no form `stifness` here"),
        ("sigma = \"stiffness\"", "sigma = \"stiffening\"", "has a stress in it itself"),
        (under, "dot(sigma*u, v)", "constant over a cell"),
        (under, "trace(sigma)*dot(u, v)", "one scalar matrix of gradients"),
        (under, "trace(sigma)*div(u)*div(v)", "one scalar matrix of gradients"),
        ("2*mu*inner(eps(u), eps(v))", "mu*inner(grad(u), grad(v))", "is not symmetric: no stress"),
        ("2*mu*inner(eps(u), eps(v))", "mu*dot(u, v)", "it is not made of gradients alone"),
    ] {
        let found = read(&ELASTICITY.replace(from, to)).err().unwrap_or_default();
        assert!(found.iter().any(|error| error.contains(expected)), "{expected}: {found:?}");
    }
}
