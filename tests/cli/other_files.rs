//! Histories as files for other programs: their numbers, units and facts, and that they stay whole however a run goes.

use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

use crate::lost_work::{MANY, Running, begin, case, read, wait_until};
use crate::parquet_file::{Column, Table};
use crate::workbench::Workbench;

const ALL: [&str; 3] = ["history.parquet", "history.mat", "history.h5"];

/// A run of `case.toml` with all of them.
fn ran(bench: &Workbench, folder: &str, more: &[&str]) -> String {
    let usual =
        ["run", "case.toml", "--out", folder, "--no-figures", "--parquet", "--mat", "--hdf5"];
    let outcome = bench.whirl(&[&usual, more].concat());
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    outcome.stderr
}

/// Names and rows of history.csv.
fn lines(bench: &Workbench, folder: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = read(bench.path(folder).join("history.csv"));
    let (head, rows) = text.split_once('\n').expect("names");
    let row = |line: &str| line.split(',').map(|own| own.parse().expect("a number")).collect();
    (head.split(',').map(str::to_owned).collect(), rows.lines().map(row).collect())
}

/// Columns of doubles of a file of MATLAB by their names.
fn variables(bytes: &[u8]) -> BTreeMap<String, Vec<f64>> {
    assert!(bytes.starts_with(b"MATLAB 5.0") && bytes[124..128] == [0, 1, b'I', b'M']);
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four"));
    let mut all = BTreeMap::new();
    let mut at = 128;
    while at < bytes.len() {
        let end = at + 8 + word(at + 4) as usize;
        assert_eq!(word(at), 14);
        if word(at + 16) == 6 {
            let (rows, letters) = (word(at + 32) as usize, word(at + 44) as usize);
            assert_eq!(word(at + 36), 1);
            let name = String::from_utf8_lossy(&bytes[at + 48..at + 48 + letters]).into_owned();
            let values = at + 48 + letters.next_multiple_of(8);
            assert_eq!([word(values), word(values + 4)], [9, 8 * rows as u32], "{name}");
            let values = bytes[values + 8..end].chunks_exact(8);
            let values: Vec<f64> =
                values.map(|own| f64::from_le_bytes(own.try_into().expect("eight"))).collect();
            assert_eq!(values.len(), rows);
            all.insert(name, values);
        }
        at = end;
    }
    all
}

/// What is read where ten digits of a number are written.
fn ten(value: f64) -> f64 {
    format!("{value:.9e}").parse().expect("a number")
}

/// That the files have the rows of history.csv, with more digits.
fn hold(bench: &Workbench, folder: &str) -> BTreeMap<String, String> {
    let (names, rows) = lines(bench, folder);
    let table = Table::read(&bench.path(folder).join(ALL[0]));
    assert_eq!(table.names, names);
    let mut more = 0;
    for (place, column) in table.columns.iter().enumerate() {
        assert_eq!(column.numbers().len(), rows.len());
        for (own, row) in column.numbers().iter().zip(&rows) {
            assert_eq!(ten(*own), row[place]);
            more += usize::from(*own != row[place]);
        }
    }
    // Most numbers have more than ten digits.
    assert!(rows.len() < 10 || more > rows.len(), "{more} of {}", rows.len());
    let columns = variables(&fs::read(bench.path(folder).join(ALL[1])).expect("a file"));
    let datasets = hdf5_pure::File::open(bench.path(folder).join(ALL[2])).expect("HDF5");
    assert_eq!(columns.len(), names.len());
    for (place, name) in names.iter().enumerate() {
        let own = table.columns[place].numbers().iter();
        let own: Vec<u64> = own.map(|own| own.to_bits()).collect();
        let there: Vec<u64> = columns[name].iter().map(|own| own.to_bits()).collect();
        assert_eq!(own, there, "{name}");
        let there = datasets.dataset(name).and_then(|own| own.read_f64()).expect("doubles");
        assert_eq!(own, there.iter().map(|own| own.to_bits()).collect::<Vec<u64>>(), "{name}");
    }
    table.facts
}

#[test]
fn the_files_have_the_rows_the_units_and_the_facts() {
    for (steps, more) in [(1, ""), (20_000, ""), (20_000, "output_step = \"1e-4 s\"\n")] {
        let bench = Workbench::new().file("case.toml", &case(steps, more));
        ran(&bench, "out", &[]);
        assert_eq!(
            bench.listing_of("out"),
            [
                "about.json",
                "history.csv",
                "history.h5",
                "history.mat",
                "history.parquet",
                "report.html",
                "state.bin",
                "summary.json"
            ]
        );
        let facts = hold(&bench, "out");
        let known = [
            ("case", "case"),
            ("title", "a mass between stops"),
            ("whirl_version", env!("CARGO_PKG_VERSION")),
            ("time_step_s", "1e-5"),
            ("output_step_s", if more.is_empty() { "1e-5" } else { "1e-4" }),
            ("complete", "true"),
        ];
        for (name, value) in known {
            assert_eq!(facts[name], value, "{name}");
        }
        assert_eq!(facts["case_hash"].len(), 64);
        let units: BTreeMap<String, String> =
            serde_json::from_str(&facts["units"]).expect("texts by texts");
        let (names, _) = lines(&bench, "out");
        assert_eq!(units.len(), names.len());
        for (name, unit) in [("t_s", "s"), ("vx_speed_mm_s", "mm/s"), ("power_loss_W", "W")] {
            assert_eq!(units.get(name).map(String::as_str), Some(unit), "{units:?}");
        }
        in_python(&bench);
        // They go with the next run that does not want them.
        let plain = ["run", "case.toml", "--out", "out", "--no-figures", "--no-report"];
        let outcome = bench.whirl(&plain);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let names = ["about.json", "history.csv", "state.bin", "summary.json"];
        assert_eq!(bench.listing_of("out"), names);
    }
}

/// As other programs read them, where these are.
fn in_python(bench: &Workbench) {
    let python = |script: &str| {
        let mut command = Command::new("python3");
        command.current_dir(bench.path("")).args(["-c", script]).output()
    };
    let packages = "import h5py, numpy, pandas, pyarrow.parquet, scipy.io";
    if !python(packages).is_ok_and(|own| own.status.success()) {
        return;
    }
    let script = r#"
import h5py, numpy, pandas, pyarrow.parquet, scipy.io
csv = numpy.genfromtxt("out/history.csv", delimiter=",", names=True, deletechars="", ndmin=1)
own = pyarrow.parquet.read_table("out/history.parquet")
assert tuple(own.column_names) == csv.dtype.names and len(own) == len(csv)
units = {name: own.schema.field(name).metadata[b"unit"].decode() for name in own.column_names}
assert units["t_s"] == "s" and units["vx_speed_mm_s"] == "mm/s" and units["power_loss_W"] == "W", units
assert own.schema.metadata[b"case"] == b"case"
frame = pandas.read_parquet("out/history.parquet")
assert frame.attrs["units"] == units and frame.attrs["time_step_s"] == "1e-5", frame.attrs
h5 = h5py.File("out/history.h5")
assert h5.attrs["case"] == "case" and {name: own.attrs["units"] for name, own in h5.items()} == units
mat = scipy.io.loadmat("out/history.mat", simplify_cells=True)
assert [str(name) for name in numpy.atleast_1d(mat["columns"])] == own.column_names
assert mat["units"] == units and mat["run"]["case_name"] == "case", mat["run"]
for name in own.column_names:
    values = own[name].to_numpy()
    assert (values == frame[name].to_numpy()).all() and (values == mat[name]).all(), name
    assert (values == h5[name][:]).all(), name
    assert numpy.allclose(values, csv[name], rtol=1e-9, atol=0), name
"#;
    let said = python(script).expect("it was there");
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
}

/// That a run that goes on in `cut` leaves what one leaves that was never interrupted.
fn resumes(bench: &Workbench) {
    assert!(ran(bench, "cut", &["--resume"]).contains("resuming after step "));
    ran(bench, "whole", &[]);
    for name in ALL.into_iter().chain(["history.csv"]) {
        let [cut, whole] =
            ["cut", "whole"].map(|folder| fs::read(bench.path(folder).join(name)).expect(name));
        assert!(cut == whole, "{name}: other bytes: {} and {}", cut.len(), whole.len());
    }
    assert_eq!(bench.listing_of("cut"), bench.listing_of("whole"));
}

#[cfg(unix)]
#[test]
fn interrupted_runs_have_the_files_and_are_resumed_with_the_same_bytes() {
    for signal in ["TERM", "KILL"] {
        let bench = Workbench::new().file("case.toml", &case(MANY, ""));
        let usual =
            ["run", "case.toml", "--out", "cut", "--no-figures", "--parquet", "--mat", "--hdf5"];
        let running = begin(&bench, &usual);
        running.signal(signal);
        let (status, said) = running.end();
        let there = ALL.map(|name| bench.path("cut").join(name).exists());
        if signal == "KILL" {
            // No file that nothing could read.
            assert_eq!((status, there), (None, [false; 3]));
        } else {
            assert_eq!((status, there), (Some(1), [true; 3]), "{said}");
            assert_eq!(hold(&bench, "cut")["complete"], "false");
        }
        resumes(&bench);
    }
}

/// Rows that were not kept with all their digits are not made up.
#[cfg(unix)]
#[test]
fn a_run_that_was_begun_without_them_is_resumed_without_them() {
    let bench = Workbench::new().file("case.toml", &case(MANY, ""));
    let running = begin(&bench, &["run", "case.toml", "--out", "cut", "--no-figures"]);
    running.signal("TERM");
    assert_eq!(running.end().0, Some(1));
    let before = bench.listing_of("cut");
    for wanted in ["--parquet", "--mat", "--hdf5"] {
        let outcome = bench.whirl(&["run", "case.toml", "--out", "cut", "--resume", wanted]);
        assert_eq!(outcome.status, 2, "{}", outcome.stderr);
        for words in [wanted, "needs all digits", "has ten", "without `--resume`"] {
            assert!(outcome.stderr.contains(words), "`{words}` is not in: {}", outcome.stderr);
        }
        assert_eq!(bench.listing_of("cut"), before);
    }
    let plain = ["run", "case.toml", "--out", "cut", "--no-figures", "--resume"];
    assert_eq!(bench.whirl(&plain).status, 0);
}

#[cfg(unix)]
#[test]
fn rows_that_were_changed_are_not_resumed() {
    let bench = Workbench::new().file("case.toml", &case(MANY, ""));
    let usual = ["run", "case.toml", "--out", "cut", "--no-figures", "--parquet"];
    let running = begin(&bench, &usual);
    let path = bench.path("cut/history.part");
    wait_until("groups", || path.metadata().is_ok_and(|own| own.len() > 4));
    running.signal("TERM");
    assert_eq!(running.end().0, Some(1));
    let before = fs::read(&path).expect("rows");
    let mut changed = before.clone();
    // Of the second group.
    let place = changed.len() * 3 / 4;
    changed[place..place + 16].fill(0x3f);
    for content in [&changed[..], &before[..before.len() / 2], b""] {
        fs::write(&path, content).expect("written");
        let outcome = bench.whirl(&[&usual[..], &["--resume"]].concat());
        assert_eq!(outcome.status, 2, "{}", outcome.stderr);
        assert!(outcome.stderr.contains("rows of `history.part`"), "{}", outcome.stderr);
    }
    fs::write(&path, before).expect("written");
    resumes(&bench);
}

#[cfg(unix)]
#[test]
fn rows_that_others_take_away_end_the_run() {
    let bench = Workbench::new().file("case.toml", &case(MANY * 20, ""));
    let usual = ["run", "case.toml", "--out", "cut", "--no-figures", "--parquet"];
    let running = Running::start(&bench, &usual);
    wait_until("rows", || bench.path("cut/history.part").metadata().is_ok_and(|own| own.len() > 4));
    fs::remove_file(bench.path("cut/history.part")).expect("removed");
    let (status, said) = running.end();
    assert_eq!(status, Some(1), "{said}");
    for words in ["cannot write the history", "`history.part`: it was removed", "are in cut"] {
        assert!(said.contains(words), "`{words}` is not in: {said}");
    }
    assert!(!said.contains("--resume"), "not true: {said}");
    assert!(!bench.path("cut/history.parquet").exists());
}

/// A limit on the size of files stands for a disk that is full.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_no_file_in_part_and_is_resumed() {
    let bench = Workbench::new().file("case.toml", &case(40_000, ""));
    let line =
        "ulimit -f 1500; exec \"$0\" run case.toml --out cut --no-figures --parquet --mat --hdf5";
    let mut shell = bench.shell();
    let output = shell.args(["-c", line, env!("CARGO_BIN_EXE_whirl")]).output().expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for words in ["cannot write the history after step", "--resume"] {
        assert!(said.contains(words), "`{words}` is not in: {said}");
    }
    assert!(ALL.iter().all(|name| !bench.path("cut").join(name).exists()));
    resumes(&bench);
}

/// A rigid rotor in a bushing.
const ROTOR: &str = r#"
title = "a rotor"

[body.rotor]
turns = "prescribed"
speed = "3000 rpm"
mass = "2 kg"
polar_inertia = "2e-3 kg*m^2"

[joint.front]
kind = "bushing"
first = { body = "rotor" }
stiffness = { xx = "1e6 N/m", yy = "1.2e6 N/m" }
damping = { xx = "400 N*s/m", yy = "400 N*s/m" }
"#;

#[test]
fn tables_of_analyses_are_written_for_other_programs() {
    let bench = Workbench::new().file("case.toml", ROTOR);
    let more = ["--speeds", "0 rpm .. 3000 rpm, 4", "--parquet", "--mat"];
    let outcome = bench.whirl(&[&["modes", "case.toml"], &more[..]].concat());
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("add `--out DIR`"), "{}", outcome.stderr);
    let out = ["campbell", "case.toml", "--out", "out", "--no-figures"];
    let outcome = bench.whirl(&[&out, &more[..]].concat());
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let known = ["campbell.critical", "campbell"]
        .map(|name| ["csv", "mat", "parquet"].map(|kind| format!("{name}.{kind}")));
    let mut known: Vec<String> = known.into_iter().flatten().collect();
    known.extend(["analyses.json", "campbell.motions.json", "report.html"].map(str::to_owned));
    known.sort();
    assert_eq!(bench.listing_of("out"), known);
    let text = read(bench.path("out/campbell.csv"));
    let head: Vec<&str> = text.lines().next().expect("names").split(',').collect();
    let table = Table::read(&bench.path("out/campbell.parquet"));
    assert_eq!(table.names, head);
    let columns = variables(&fs::read(bench.path("out/campbell.mat")).expect("a file"));
    let mut compared = 0;
    for (place, name) in head.iter().enumerate() {
        let cells = text.lines().skip(1).map(|line| line.split(',').nth(place).expect("a cell"));
        match &table.columns[place] {
            Column::Numbers(own) => {
                let known = cells.map(|cell| cell.parse().unwrap_or(f64::NAN).to_bits());
                let known: Vec<u64> = known.collect();
                let bits = |all: &[f64]| all.iter().map(|own| own.to_bits()).collect::<Vec<u64>>();
                assert_eq!((bits(own), bits(&columns[*name])), (known.clone(), known), "{name}");
                compared += own.len();
            }
            Column::Texts(own) => assert_eq!(*own, cells.collect::<Vec<&str>>(), "{name}"),
        }
    }
    assert!(compared >= 4 * 3, "{compared}");
}
