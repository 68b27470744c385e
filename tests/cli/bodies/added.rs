//! Masses on the rim of a flexible rotor, which turn, tilt and gyrate with its section.

use whirl_tests::History;

use super::{march, run};

/// A meshed rotor with so many modes at 6000 rpm that a pulse of 2 ms hits at its end, with these tables on it.
fn hit(modes: usize, carried: &str) -> History {
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
modes = {modes}
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

/// Four masses around the axis at z = 300 mm, and the disc that they are: I_p = Σ m r², I_d = ½ I_p.
fn rim_and_disc(mass: f64, polar_share: f64) -> [String; 2] {
    let radius = 0.1;
    let rim = (0..4).map(|k| {
        format!(
            "[body.rotor.added.m{k}]\nmass = \"{mass} kg\"\nradius = \"{radius} m\"\nangle = \"{} deg\"\nz = \"300 mm\"\n",
            90 * k
        )
    });
    let polar = 4.0 * mass * radius * radius;
    let disc = format!(
        "[body.rotor.disc.wheel]\nmass = \"{} kg\"\npolar_inertia = \"{} kg*m^2\"\ntransverse_inertia = \"{} kg*m^2\"\n\
         z = \"300 mm\"\n",
        4.0 * mass,
        polar_share * polar,
        0.5 * polar
    );
    [rim.collect(), disc]
}

/// The body has 1.9 kg. Heavy masses have the tilts of their section as coordinates: they feel gyroscopic couples, and nothing
/// softens by them.
#[test]
fn heavy_masses_on_a_rim_are_the_disc_that_they_make() {
    let [rim, disc] = rim_and_disc(0.5, 1.0).map(|carried| hit(12, &carried));
    let [most, apart] = departure(&disc, &rim);
    assert!(most > 10.0, "{most}");
    assert!(apart < 1e-6 * most, "{apart} of {most}");
    // Without gyroscopic couples it is another motion.
    let still = hit(12, &rim_and_disc(0.5, 1e-6)[1]);
    let [most, apart] = departure(&still, &rim);
    assert!(apart > 0.05 * most, "{apart} of {most}");
}

/// Masses of 2 % leave the tilts of their section to the modes: what these lack is little, and less with more of them.
#[test]
fn light_masses_on_a_rim_are_the_disc_as_far_as_the_modes_tilt() {
    let off = |modes: usize| {
        let [rim, disc] = rim_and_disc(0.01, 1.0).map(|carried| hit(modes, &carried));
        let [most, apart] = departure(&disc, &rim);
        apart / most
    };
    let [few, many] = [12, 36].map(off);
    assert!(few < 5e-3 && many < 0.5 * few, "{few} {many}");
}
