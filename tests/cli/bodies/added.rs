//! Masses on the rim of a flexible rotor, which turn, tilt and gyrate with its section.

use whirl_tests::History;

use super::{march, run};

/// A meshed rotor at 6000 rpm that a pulse of 2 ms hits at its end, with these tables on it.
fn hit(carried: &str) -> History {
    let case = format!(
        "title = \"a rotor with a wheel\"
[material.steel]
youngs_modulus = \"200 GPa\"
poissons_ratio = 0.3
density = \"7860 kg/m^3\"

[body.rotor]
turns = \"prescribed\"
speed = \"6000 rpm\"
material = \"steel\"
modes = 12
damping = \"1e-6 s\"
axial_restraint = \"JOURNAL1_MIDDLE\"

[body.rotor.dimensions]
length = \"500 mm\"
diameter = \"25 mm\"
supports = [\"50 mm\", \"450 mm\"]
support_length = \"20 mm\"
layers_in_support = 2
layers_between = 8

[joint.left]
kind = \"bushing\"
first = {{ body = \"rotor\", sets = \"JOURNAL1_MIDDLE\" }}
stiffness = {{ xx = \"2e6 N/m\", yy = \"2e6 N/m\" }}

[joint.right]
kind = \"bushing\"
first = {{ body = \"rotor\", sets = \"JOURNAL2_MIDDLE\" }}
stiffness = {{ xx = \"3e6 N/m\", yy = \"3e6 N/m\" }}

[loads.pulse]
body = \"rotor\"
sets = [\"DRIVE_TOP\", \"DRIVE_BOTTOM\"]
force = \"100 N\"
table = \"pulse.csv\"

[output.right]
quantity = \"displacement\"
body = \"rotor\"
set = \"JOURNAL2_MIDDLE\"

{}{carried}",
        march("1e-5 s", 1500)
    );
    run(&case, &[("pulse.csv", "time [s], factor [1]\n0,0\n0.001,1\n0.002,0\n")]).history
}

/// The largest displacement of the right journal, and by how much another run departs from it (µm).
fn departure(a: &History, b: &History) -> [f64; 2] {
    let [mut most, mut apart] = [0.0_f64; 2];
    for column in ["x_right_um", "y_right_um"] {
        for (a, b) in a.column(column).iter().zip(b.column(column)) {
            most = most.max(a.abs());
            apart = apart.max((a - b).abs());
        }
    }
    [most, apart]
}

/// Four masses around the axis are a disc with I_p = Σ m r², I_d = ½ I_p, whether they are heavy beside the body or light: tilts
/// of the section feel their gyroscopic couples, and nothing softens by them.
#[test]
fn masses_on_a_rim_are_the_disc_that_they_make() {
    // The body has 1.9 kg.
    for (mass, radius) in [(0.5, 0.1), (0.01, 0.1)] {
        let rim: String = (0..4)
            .map(|k| {
                format!(
                    "[body.rotor.added.m{k}]\nmass = \"{mass} kg\"\nradius = \"{radius} m\"\nangle = \"{} deg\"\n\
                     z = \"300 mm\"\n",
                    90 * k
                )
            })
            .collect();
        let polar = 4.0 * mass * radius * radius;
        let disc = format!(
            "[body.rotor.disc.wheel]\nmass = \"{} kg\"\npolar_inertia = \"{polar} kg*m^2\"\n\
             transverse_inertia = \"{} kg*m^2\"\nz = \"300 mm\"\n",
            4.0 * mass,
            0.5 * polar
        );
        let (rim, disc) = (hit(&rim), hit(&disc));
        let [most, apart] = departure(&disc, &rim);
        assert!(most > 10.0, "{most}");
        // Light ones leave the tilts of their section to the modes.
        let bound = if mass > 0.1 { 1e-6 } else { 2e-3 };
        assert!(apart < bound * most, "{mass} kg: {apart} of {most}");
        // Without gyroscopic couples it is another motion.
        let still = hit(&format!(
            "[body.rotor.disc.wheel]\nmass = \"{} kg\"\npolar_inertia = \"1e-9 kg*m^2\"\n\
             transverse_inertia = \"{} kg*m^2\"\nz = \"300 mm\"\n",
            4.0 * mass,
            0.5 * polar
        ));
        let [most, apart] = departure(&still, &rim);
        assert!(mass < 0.1 || apart > 0.05 * most, "{apart} of {most}");
    }
}
