//! From a table of diameters to a Campbell diagram, as docs/rotors.md says it.

use std::fs;

use crate::workbench::Workbench;

const PAGE: &str = include_str!("../../docs/rotors.md");

/// The first block of this kind.
fn block(kind: &str) -> &'static str {
    let rest = PAGE.split_once(&format!("```{kind}\n")).expect("a block").1;
    rest.split("```").next().expect("its end")
}

#[test]
fn the_rotor_of_the_page_is_drawn_and_analysed() {
    let bench = Workbench::new().file("rotor.csv", block("csv")).file("rotor.toml", block("toml"));
    let said = bench.whirl(&["check", "rotor.toml", "--picture", "rotor.svg"]);
    assert_eq!(said.status, 0, "{}", said.stderr);
    let drawn = fs::read_to_string(bench.path("rotor.svg")).expect("a picture");
    let shown = ["1: joint front, z = 130 mm", "2: joint rear, z = 475 mm", "bronze"];
    let wheel = ["3: disc wheel, unbalance wheel, output wheel, z = 540 mm"];
    for text in shown.into_iter().chain(wheel) {
        assert!(drawn.contains(text), "{text}");
    }
    let said = bench.whirl(&["analyse", "rotor.toml", "--out", "results"]);
    assert_eq!(said.status, 0, "{}", said.stderr);
    let table: Vec<&str> =
        PAGE.lines().skip_while(|line| !line.starts_with("critical speed")).take(7).collect();
    assert!(said.stdout.contains(&table.join("\n")), "{}", said.stdout);
    let response = fs::read_to_string(bench.path("results/unbalance.peaks.csv")).expect("peaks");
    assert!(response.contains("output.wheel"), "{response}");
}

/// The same file is marched, from equilibrium, resumed, and swept; results do not depend on the form of the table.
#[test]
fn the_rotor_of_the_page_is_marched_and_swept() {
    let march =
        "[march]\ntime_step = \"0.1 ms\"\nduration = \"20 ms\"\n[start]\nkind = \"equilibrium\"\n";
    let case = format!("{}{march}", block("toml"));
    let rows = block("csv").lines().skip(2).map(|line| {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        let length = |key: &str, cell: &str| format!("{key} = \"{cell} mm\", ");
        let z = if cells[0].is_empty() { String::new() } else { length("z", cells[0]) };
        let keys = ["length", "outer_left", "outer_right", "inner"];
        let lengths: String =
            keys.iter().zip(&cells[1..]).map(|(key, cell)| length(key, cell)).collect();
        let texts: String = ["material", "name"]
            .iter()
            .zip(&cells[5..])
            .filter(|own| !own.1.is_empty())
            .map(|(key, cell)| format!("{key} = \"{cell}\", "))
            .collect();
        format!("{{ {z}{lengths}{texts} }}").replace(",  }", " }")
    });
    let rows = format!("sections = [{}]", rows.collect::<Vec<_>>().join(", "));
    let inline = case.replace("sections = \"rotor.csv\"", &rows);
    assert_ne!(inline, case);
    let bench = Workbench::new()
        .file("rotor.csv", block("csv"))
        .file("rotor.toml", &case)
        .file("inline.toml", &inline);
    let history = |name: &str| {
        let said = bench.whirl(&["run", &format!("{name}.toml"), "--out", name]);
        assert_eq!(said.status, 0, "{}", said.stderr);
        fs::read_to_string(bench.path(&format!("{name}/history.csv"))).expect("a history")
    };
    let [file, list] = ["rotor", "inline"].map(history);
    assert!(file.lines().count() > 200 && file.contains("x_wheel_um"));
    assert_eq!(file, list);
    let vary = "joint.front.stiffness.xx = 3e7 N/m .. 5e7 N/m, 3";
    let said = bench.whirl(&["sweep", "rotor.toml", "--vary", vary, "--out", "swept"]);
    assert_eq!(said.status, 0, "{}", said.stderr);
}
