//! EX and EY of the reference machine are what laws see, on generated and on read meshes: a law F = −k e knows
//! the answer.

use std::fs;
use std::io::Read;
use std::path::Path;

use whirl_tests::History;

use crate::workbench::Workbench;

/// k (N/m), alike along x and along y: the axes of a law turn with its bore, those of EX and EY stand.
const STIFFNESS: [(&str, f64); 2] = [("X", 2e7), ("Y", 2e7)];

const LAW: &str = "kind = \"law\"\nname = \"linear-ring\"\ntitle = \"F = -k e\"\nsource = \"a test\"\n\
    inputs = { e_x = { unit = \"m\", range = [-1e-3, 1e-3] }, e_y = { unit = \"m\", range = [-1e-3, 1e-3] } }\n\
    [outputs.F_x]\nunit = \"N\"\nvalue = '-2e7*e_x'\n\
    [outputs.F_y]\nunit = \"N\"\nvalue = '-2e7*e_y'\n";

/// The reference machine with meshes from files.
const READ: &str = "\
[shaft]
mesh = \"shaft.inp\"
modes = 20
damping = \"1e-4 s\"
axial_restraint = \"JOURNAL3_MIDDLE\"
[support]
mesh = \"support.inp\"
modes = 30
damping = \"1e-4 s\"
mounts = \"MOUNTS\"
[[support.ground_spring]]
set = \"GROUND_SPRINGS\"
direction = \"y\"
stiffness = \"1e8 N/m\"
[drive]
top = \"DRIVE_TOP\"
bottom = \"DRIVE_BOTTOM\"
torque = \"109 N*m\"
target_speed = \"4500 rpm\"
";

/// The same with meshes made from dimensions.
const GENERATED: &str = "include = \"hu2003.machine.toml\"\nshaft.modes = 20\nsupport.modes = 30\n";

/// One ring a bearing, in its middle, where EX and EY are taken.
fn case(machine: &str, direction: &str) -> String {
    let mut text = format!(
        "title = \"loads along {direction}\"\n{machine}\
         [springs]\nnumber = 24\nradial_clearance = \"0.035687 mm\"\nlaw = \"law.toml\"\n\
         [[load]]\nsets = [\"LOAD1\", \"LOAD2\", \"LOAD3\"]\ndirection = \"{direction}\"\nforce = \"1000 N\"\n\
         [march]\ntime_step = \"7.4e-5 s\"\nsteps = 80\ncycle_frequency = \"375 Hz\"\n"
    );
    for (k, z) in [(1, "24 mm"), (2, "476 mm"), (3, "928 mm"), (4, "1380 mm")] {
        let sets = |what: &str| {
            ["LEFT", "MIDDLE", "RIGHT"].map(|place| format!("\"{what}{k}_{place}\"")).join(", ")
        };
        let (journal, bore) = (sets("JOURNAL"), sets("BORE"));
        text +=
            &format!("[[bearing]]\njournal = [{journal}]\nbore = [{bore}]\nstations = [\"{z}\"]\n");
    }
    text
}

fn mesh(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../tests/data/{name}.inp.gz"));
    let mut text = String::new();
    let packed = fs::File::open(&path).expect("the test data is there");
    flate2::read::GzDecoder::new(packed).read_to_string(&mut text).expect("text");
    text
}

#[test]
fn the_eccentricity_is_the_one_that_laws_see() {
    let mut bench = Workbench::new().file("law.toml", LAW);
    for name in ["shaft", "support"] {
        bench = bench.file(&format!("{name}.inp"), &mesh(name));
    }
    for (meshes, machine) in [("generated", GENERATED), ("read", READ)] {
        for direction in ["x", "y"] {
            let name = format!("{meshes}-{direction}");
            bench = bench.file(&format!("{name}.toml"), &case(machine, direction));
            let outcome = bench.whirl(&["run", &format!("{name}.toml"), "--no-figures"]);
            assert_eq!(outcome.status, 0, "{}", outcome.stderr);
            follows_the_law(&name, &bench.history(&format!("results/{name}")));
        }
    }
}

/// R = −k E in every row, along x and y, at every bearing.
fn follows_the_law(name: &str, history: &History) {
    assert_eq!(history.rows(), 80, "{name}");
    let column = |name: &str| history.column(name);
    for k in 1..=4 {
        for (axis, stiffness) in STIFFNESS {
            let (force, e) = (column(&format!("R{axis}{k}_N")), column(&format!("E{axis}{k}_um")));
            let journal = column(&format!("{axis}{k}_um"));
            let peak = journal.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            for (row, (force, e)) in force.iter().zip(e).enumerate() {
                let expected = -1e-6 * stiffness * e;
                // Ten digits of both are written; rounding of X − bore is that of X.
                let rounding = 1e-9 * expected.abs() + 1e-12 * stiffness * 1e-6 * peak;
                assert!(
                    (force - expected).abs() <= rounding,
                    "{name}, R{axis}{k} in row {row}: {force} N, −k E is {expected} N"
                );
            }
        }
    }
}
