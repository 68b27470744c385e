//! What a file may not say.

use super::*;

#[test]
fn all_errors_of_a_file_are_reported_at_once() {
    let found = messages(
        "colour = \"red\"
[inputs.h]
unit = \"N\"
[inputs.hdot]
unit = \"mm/s\"
[parameters]
c0 = { value = 1, unit = \"milimeter\" }
and = { value = 1, unit = \"mm\" }
h = { value = 1, unit = \"mm\" }
[outputs.Q]
unit = \"N\"
engage = \"roof\"
value = '1 + (2'
pieces = []
",
    );
    let expected = [
        "law.toml:5:1: unknown key `colour` (known: `definitions`, `inputs`, `kind`, `name`, `outputs`, `parameters`, `rates`, `source`, `states`, `stored`, `tables`, `title`, `valid`)",
        "law.toml:7:9: `h` is a length, but `N` is the unit of a force (write for example `unit = \"m\"`)",
        "law.toml:8:9: `hdot` is not an input of laws (did you mean `h_dot`?)",
        "law.toml:11:27: unknown unit `milimeter` (write `mm`)",
        "law.toml:12:1: `and` is a word of the formula language and cannot be a name (choose another name)",
        "law.toml:13:1: the name `h` is taken since line 6 (choose another name)",
        "law.toml:14:10: `Q` has both a `value` and `pieces` (keep one of them)",
        "law.toml:16:11: `outputs.Q.engage` cannot be `roof` (did you mean `root`?)",
    ];
    assert_eq!(found, expected);
}

#[test]
fn parameters_keep_their_limits() {
    let law = |parameter: &str| {
        messages(&format!(
            "[inputs]\nh = {{ unit = \"mm\" }}\n[parameters]\nk = {{ {parameter} }}\n[outputs.Q]\nunit = \"N\"\nvalue = 'k*h'\n"
        ))
    };
    let cases = [
        ("value = 0, unit = \"N/mm\", above = 0", "law.toml:8:15: `k` has to be above 0 N/mm"),
        ("value = -1, unit = \"N/mm\", min = 0", "law.toml:8:15: `k` has to be at least 0 N/mm"),
        ("value = 5, unit = \"N/mm\", max = 4.5", "law.toml:8:15: `k` has to be at most 4.5 N/mm"),
        (
            "value = 5, unit = \"N/mm\", min = 0, below = 5",
            "law.toml:8:15: `k` has to be below 5 N/mm",
        ),
        (
            "value = 5, unit = \"N/mm\", min = 0, above = 0",
            "law.toml:8:33: `min` and `above` exclude each other (keep one of them)",
        ),
    ];
    for (parameter, expected) in cases {
        assert_eq!(law(parameter), [expected]);
    }
    for fine in ["above = 4, max = 5", "min = 5, below = 6"] {
        let parameter = format!("value = 5, unit = \"N/mm\", {fine}");
        let body = format!(
            "[inputs]\nh = {{ unit = \"mm\" }}\n[parameters]\nk = {{ {parameter} }}\n[outputs.Q]\nunit = \"N\"\nvalue = 'k*h'\n"
        );
        assert!(read(&body).is_ok(), "{fine}");
    }
}

#[test]
fn pieces_units_and_dimensions_are_checked() {
    let law = |inputs: &str, output: &str| {
        messages(&format!(
            "[inputs]\n{inputs}\n[parameters]\nk = {{ value = 1, unit = \"N/mm\" }}\n[outputs.Q]\n{output}\n"
        ))
    };
    let h = "h = { unit = \"mm\" }";
    let cases: &[(&str, &str, &[&str])] = &[
        (
            h,
            "unit = \"N\"\nvalue = 'h*k*h'",
            &[
                "law.toml:11:10: `Q` is a force, but this is a torque (a parameter with a unit is missing as a factor; a number as a factor takes any unit)",
            ],
        ),
        (
            h,
            "unit = \"N\"\nvalue = 'k + h'",
            &[
                "law.toml:11:14: `h` is a length and cannot be added to `k`, which is a stiffness (both must be alike: look for a missing factor or a wrong name)",
            ],
        ),
        (
            h,
            "unit = \"N\"\nvalue = '5*h'",
            &["law.toml:8:1: `k` is not used by any formula (leave it out)"],
        ),
        (
            h,
            "unit = \"N\"\npieces = [{ value = 'k*h' }, { value = '0' }]",
            &[
                "law.toml:11:11: this piece has no `when`, so that none after it ever applies (write its condition, such as `when = 'h < 0'`)",
            ],
        ),
        (
            h,
            "unit = \"N\"\npieces = [{ when = 'h < 0', value = 'k*h' }]",
            &[
                "law.toml:11:21: the last piece must apply everywhere else (leave its `when` out, or add a piece `{ value = '0' }`)",
            ],
        ),
        (
            h,
            "unit = \"N\"\npieces = [{ when = 'h', value = 'k*h' }, { value = 'h < 0' }]",
            &[
                "law.toml:11:21: expected a condition such as `h < c0`, found a number (compare it with another number)",
                "law.toml:11:53: expected a number, found a condition (conditions stand in `when`, numbers in `value`)",
            ],
        ),
        (
            "h = { unit = \"mm\" }\nh_dot = { unit = \"rpm\" }",
            "unit = \"N\"\nvalue = 'k*h*h_dot'",
            &[
                "law.toml:7:19: `h_dot` is a speed, but `rpm` is the unit of an angular speed (write for example `unit = \"m/s\"`)",
            ],
        ),
        (
            "h = { unit = \"mm\", range = [1, 0] }",
            "unit = \"N\"\nvalue = 'k*h'",
            &[
                "law.toml:6:29: `range` must be two numbers, the lower first (write for example `range = [-0.1, 0.1]`)",
            ],
        ),
        (
            h,
            "unit = \"N\"",
            &[
                "law.toml:9:10: `Q` has neither a `value` nor `pieces` (write for example `value = '1000*h'`)",
            ],
        ),
        (
            "h = { unit = \"mm\", range = [-1, 1] }",
            "unit = \"N\"\nvalue = 'k*sqrt(h)*sqrt(h)'",
            &[
                "law.toml:11:10: `Q` has no finite value at h = -1 mm (give this place a piece of its own, or make the `range` of the inputs smaller)",
            ],
        ),
    ];
    for (inputs, output, expected) in cases {
        assert_eq!(law(inputs, output), *expected, "{inputs} {output}");
    }
}

#[test]
fn the_kind_of_a_law_follows_from_its_names() {
    let of = |inputs: &str, outputs: &str| {
        read(&format!(
            "[inputs]\n{inputs}\n[parameters]\nk = {{ value = 1, unit = \"N/m\" }}\n{outputs}"
        ))
    };
    let out =
        |name: &str, value: &str| format!("[outputs.{name}]\nunit = \"N\"\nvalue = '{value}'\n");
    let friction = of(
        "h = { unit = \"m\" }\nv_t = { unit = \"m/s\" }",
        &(out("Q", "-k*h") + &out("T", "k*h*tanh(v_t/0.001)")),
    );
    let friction = friction.unwrap();
    assert_eq!(friction.acts, Acts::Spring);
    assert_eq!(friction.outputs[1].derivatives.len(), 2);
    let ring = "e_x = { unit = \"m\" }\ne_y = { unit = \"m\" }";
    let isotropic = out("F_x", "-k*e_x") + &out("F_y", "-k*e_y");
    assert_eq!(of(ring, &isotropic).unwrap().acts, Acts::Ring);
    // A name of joints makes one of what has else those of rings, before them or behind.
    let joint = of(
        &format!("e_z = {{ unit = \"m\" }}\n{ring}"),
        &isotropic.replace("k*e_y", "k*(e_y + e_z)"),
    );
    assert_eq!(joint.unwrap().acts, Acts::Joint);
    let joint = of(ring, &(isotropic.clone() + &out("F_z", "-k*e_x")));
    assert_eq!(joint.unwrap().acts, Acts::Joint);
    let found = |inputs: &str, outputs: &str| -> Vec<String> {
        of(inputs, outputs).unwrap_err().iter().map(ToString::to_string).collect()
    };
    assert_eq!(
        found("h = { unit = \"m\" }", &(out("F_x", "-k*h") + &out("F_y", "0"))),
        [
            "law.toml:9:10: `F_x` belongs to a law of a ring, but `h` to a law of a spring (a law of a \
             spring takes `h`, `h_dot`, `psi`, `omega`, `v_t`, `theta` and gives `Q`, `T`)",
            "law.toml:12:10: `F_y` belongs to a law of a ring, but `h` to a law of a spring (a law of a \
             spring takes `h`, `h_dot`, `psi`, `omega`, `v_t`, `theta` and gives `Q`, `T`)",
        ]
    );
    assert_eq!(
        found(ring, &out("F_x", "-k*e_x*(1 + e_y/e_x)")),
        ["law.toml:10:10: a law of a ring must give `F_y` too (write a section `[outputs.F_y]`)"]
    );
    assert_eq!(
        found("h = { unit = \"m\" }", &out("T", "k*h")),
        ["law.toml:9:10: a law of a spring must give `Q` too (write a section `[outputs.Q]`)"]
    );
    assert_eq!(
        found("e_z = { unit = \"m\" }", &(out("F_x", "0") + &out("F_z", "-k*e_z"))),
        ["law.toml:9:10: a law of a joint must give `F_y` too (write a section `[outputs.F_y]`)"]
    );
    let mixed = found("h = { unit = \"m\" }", &(out("Q", "-k*h") + &out("F_z", "k*h")));
    assert!(mixed[0].contains("`F_z` belongs to a law of a joint, but `h` to a law of a spring"));
}
