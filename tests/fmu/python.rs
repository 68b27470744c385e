//! FMPy, where Python has it: its validation, and a run of it against one of the command.

use std::process::Command;

use crate::bench::{Bench, PORT, library, rotor};

/// Validates the unit, runs it with two communication steps, and prints a line of the bits of all outputs for every point.
const SCRIPT: &str = r#"
import struct, sys
import fmpy
from fmpy.validation import validate_fmu

problems = validate_fmu(sys.argv[1])
assert not problems, problems
description = fmpy.read_model_description(sys.argv[1], validate=True)
assert description.coSimulation.canGetAndSetFMUstate and description.coSimulation.canSerializeFMUstate
outputs = [own.name for own in description.modelVariables if own.causality == "output"]
step = float(sys.argv[2])
result = fmpy.simulate_fmu(sys.argv[1], stop_time=0.04, step_size=step, output_interval=step, output=outputs)
print(" ".join(outputs))
for row in result:
    print(" ".join(struct.pack(">d", row[name]).hex() for name in outputs))
"#;

#[test]
fn fmpy_validates_and_runs_a_unit_with_the_bits_of_a_run() {
    let there = Command::new("python3").args(["-c", "import fmpy"]).output();
    if !there.is_ok_and(|own| own.status.success()) {
        eprintln!("skipped: there is no python3 with FMPy");
        return;
    }
    let load = "[loads.beat]\nbody = \"r\"\nforce = \"40 N\"\nfrequency = \"30 Hz\"\n";
    let bench = Bench::new(&rotor(&format!("{PORT}{load}")));
    let library = library();
    bench.unit(&["--parameter", "joint.b.stiffness.xx", "--library", library.to_str().unwrap()]);
    bench.file("run.py", SCRIPT);
    let history = bench.history("case.toml");
    for every in [1, 10] {
        let step = format!("{:?}", f64::from(every) * 1e-4);
        let run = Command::new("python3")
            .args([bench.path("run.py"), bench.path("unit.fmu")])
            .arg(&step)
            .output()
            .unwrap();
        let (said, out) =
            (String::from_utf8_lossy(&run.stderr), String::from_utf8_lossy(&run.stdout));
        assert!(run.status.success(), "{said}");
        let mut lines = out.lines();
        assert_eq!(lines.next().unwrap(), history.names().join(" "));
        // The first is that of the start.
        let rows: Vec<&str> = lines.skip(1).collect();
        assert_eq!(rows.len(), history.rows() / every as usize);
        for (place, found) in rows.iter().enumerate() {
            let own = history.row((place + 1) * every as usize - 1);
            let own: Vec<String> =
                own.iter().map(|own| format!("{:016x}", own.to_bits())).collect();
            assert_eq!(*found, own.join(" "), "row {place}");
        }
    }
}
