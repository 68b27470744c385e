//! Masses that a mesh file has beside its cells, as a case writes them.

use whirl_solver::mesh::bdf::AddedMass;
use whirl_text::shown;

/// A warning with the lines by which a case gives a body this mass, SI.
pub(super) fn in_case(path: &str, mass: &AddedMass) -> String {
    let AddedMass { name, mass, at, inertia, sets } = mass;
    let number = |value: f64| shown(value, 6, 1e-4..1e6);
    let [x, y, z] = *at;
    let radius = x.hypot(y);
    let place = match sets.as_slice() {
        [] => String::new(),
        sets => format!(" on {}", sets.join(", ")),
    };
    let what = format!("{path}: {name}, {} kg{place}, is not part of the mesh", number(*mass));
    let polar = inertia[2][2];
    let transverse = (inertia[0][0] + inertia[1][1]) / 2.0;
    let on_axis = radius <= 1e-6 * z.abs().max(1e-3);
    let lines = if on_axis && polar > 0.0 {
        format!(
            "[body.NAME.disc.{name}]\n    mass = \"{} kg\"\n    polar_inertia = \"{} kg*m^2\"\n    \
             transverse_inertia = \"{} kg*m^2\"\n    z = \"{} m\"",
            number(*mass),
            number(polar),
            number(transverse),
            number(z)
        )
    } else {
        let around = match on_axis {
            true => String::new(),
            false => format!(
                "    radius = \"{} m\"\n    angle = \"{} deg\"\n",
                number(radius),
                number(y.atan2(x).to_degrees())
            ),
        };
        format!(
            "[body.NAME.added.{name}]\n    mass = \"{} kg\"\n{around}    z = \"{} m\"",
            number(*mass),
            number(z)
        )
    };
    format!("{what}\n  help: if the body turns about x = y = 0, write into the case\n    {lines}")
}

#[cfg(test)]
mod tests {
    use super::{AddedMass, in_case};

    #[test]
    fn masses_become_lines_of_a_case() {
        let mut inertia = [[0.0; 3]; 3];
        let mass = |at, inertia| AddedMass {
            name: "CONM2_7".into(),
            mass: 2.5,
            at,
            inertia,
            sets: vec!["RBE2_1".into()],
        };
        assert_eq!(
            in_case("a.bdf", &mass([0.0, 0.02, 0.5], inertia)),
            "a.bdf: CONM2_7, 2.5 kg on RBE2_1, is not part of the mesh\n  help: if the body turns about x = y = 0, \
             write into the case\n    [body.NAME.added.CONM2_7]\n    mass = \"2.5 kg\"\n    radius = \"0.02 m\"\n    \
             angle = \"90 deg\"\n    z = \"0.5 m\""
        );
        (inertia[0][0], inertia[1][1], inertia[2][2]) = (1e-3, 1e-3, 2e-3);
        assert_eq!(
            in_case("a.bdf", &mass([0.0, 0.0, 0.5], inertia)).split_once("case\n").unwrap().1,
            "    [body.NAME.disc.CONM2_7]\n    mass = \"2.5 kg\"\n    polar_inertia = \"0.002 kg*m^2\"\n    \
             transverse_inertia = \"0.001 kg*m^2\"\n    z = \"0.5 m\""
        );
    }
}
