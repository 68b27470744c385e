//! What a film file may not say, and where it is told.

use super::*;

const JFO: &str = include_str!("../../../../specs/films/jfo.toml");

fn read(text: &str) -> Result<FilmSpec, Vec<String>> {
    let file = Source::new("f.toml", text);
    FilmSpec::read(&file).map_err(|errors| errors.iter().map(ToString::to_string).collect())
}

#[test]
fn the_shipped_film_has_the_slopes_that_its_terms_have() {
    let spec = read(JFO).unwrap();
    let (derived, program) = spec.residual_program().unwrap();
    let fields: Vec<&str> = derived.fields.iter().map(|(_, name, _)| name.as_str()).collect();
    assert_eq!(fields, ["p", "theta", "H"]);
    // p: a node has its neighbour around, and the three of its line along; theta: what is upstream; H: as p.
    let of = |field: usize| {
        let slopes = derived.values.iter().flat_map(|own| &own.slopes);
        slopes.filter(|slope| slope.field == field).count()
    };
    assert_eq!([of(0), of(1), of(2)], [24, 12, 24]);
    assert!(program.instructions.len() < 800, "{}", program.instructions.len());
}

#[test]
fn slips_of_the_pen_are_named() {
    let mut unseen = Vec::new();
    for (from, to, expected) in [
        ("unit = \"Pa\"", "unit = \"MPa\"", "a film is written in SI: a pressure expected"),
        (
            "[gap.h]\nunit = \"m\"",
            "[gap.h]\nunit = \"1\"",
            "a film is written in SI: a length expected",
        ),
        (
            "[unknowns.r]\nunit = \"1\"\ntitle = \"part of the gap that is empty\"\n",
            "",
            "`unknowns` must declare 2 names, not 1",
        ),
        ("around = 2\n", "around = 7\n", "a cell has 2 or 3 nodes `around` the bore, not 7"),
        ("theta = '1 - r'", "theta = '1 - h'", "cannot be added"),
        ("theta = '1 - r'", "theta = '1 - r*dx/dz'", "`dx` is not known at the nodes"),
        ("theta = '1 - r'", "dx = '1 - r'", "the name `dx` has a meaning of its own in films"),
        ("theta = '1 - r'", "H_2 = '1 - r'\ntheta = '1 - r'", "`H_2` is not used by any formula"),
        (
            "value = 'theta*H'",
            "value = 'theta*H^2'",
            "what a node holds per area is in m, this is an area",
        ),
        ("value = 'theta*H'", "value = '(1 - 2*r)*H'", "what a node holds is less than nothing"),
        (
            "value = 'theta*H'",
            "value = '(1 + r)*H'",
            "what a node holds grows with the second unknown",
        ),
        (
            "value = 'theta*H'",
            "value = 'theta*sigma^2/H'",
            "what a node holds shrinks as the gap grows",
        ),
        ("value = '-h*ddx(p)'", "value = 'h*ddx(p)'", "moments on journal and bore do not balance"),
        (
            "T_m = { on = \"s_mean\", value = '-h*ddx(p)' }\n",
            "",
            "moments on journal and bore do not balance",
        ),
        ("T = { on = \"s\"", "T = { on = \"slip\"", "a film's force does not work on `slip`"),
        ("T = { on = \"s\"", "T = { on = \"h\"", "two forces work on `h`"),
        (
            "ddx(p)*ddx(v)'",
            "ddx(p)'",
            "a term of the weak form is in m/s, this is a quantity in m^2/s",
        ),
        ("ddx(p)*ddx(v)'", "ddx(p)*ddx(v)*v'", "is not linear in the test function v"),
        ("ddz(p)*ddz(v)", "ddz(q)*ddz(v)", "`ddz` takes a field of the nodes"),
        ("ddz(p)*ddz(v)", "ddz(p*p)*ddz(v)", "`ddz` takes a field of the nodes"),
        ("upstream(theta, u)", "upstream(theta)", "this is written `upstream(f, u)`"),
        ("upstream(theta, u)", "upstream(theta, p)", "this is written `upstream(f, u)`"),
        ("'-mu*v_t*sheared/H'", "'-mu*v_t*sheared'", "a force per area is in Pa"),
        ("points = \"nodes\"", "points = \"node\"", "`points`"),
        (
            "[\"lobatto(2)\", \"gauss(2)\"]",
            "[\"lobatto(2)\", \"gauss(9)\"]",
            "`points` is \"nodes\", or two rules out of",
        ),
        (
            "complementary = [\"out\", \"r\"]",
            "complementary = [\"out\", \"p\"]",
            "an edge gives the first unknown",
        ),
        ("given = [\"p\", \"r\"]", "given = [\"p\", \"q\"]", "`q` is no unknown"),
        ("unit = \"W\"", "unit = \"N\"", "a term of this integral, per area, is in"),
        ("[stored]\nvalue = 'theta*H'", "[stored]\nvalu = 'theta*H'", "did you mean `value`?"),
        ("name = \"jfo\"", "name = \"j f o\"", "a film's name is made of letters"),
    ] {
        assert!(JFO.contains(from), "{from}");
        let found = read(&JFO.replacen(from, to, 1)).err().unwrap_or_default();
        if !found.iter().any(|error| error.contains(expected)) {
            unseen.push(format!("{from} → {to}: {expected}: {found:?}"));
        }
    }
    assert!(unseen.is_empty(), "{}", unseen.join("\n"));
}

#[test]
fn a_film_is_explained() {
    let spec = read(JFO).unwrap();
    let mut page = crate::kinds::page::Page::new("jfo");
    spec.explain(&mut page);
    let text = page.text();
    for line in [
        "dtheta_dr = -1",
        "shear",
        "on s_mean",
        "out >= 0, r >= 0, out*r = 0",
        "residual of a cell: 6 values over p, theta, H, with 60 slopes",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
}
