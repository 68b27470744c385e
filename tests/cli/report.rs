//! report.html: what is embedded in it, read back and compared with the files beside it.

use std::f64::consts::TAU;
use std::fs;

use serde_json::Value;

use crate::workbench::{SHORT, Workbench};

/// A run-up of a rotor in film bearings, through the onset of oil whirl.
const RUN_UP: &str = "include = \"weight.toml\"\ntitle = \"</script><b>a run-up & more\"\n\
                      [body.rotor]\nspeed = \"7000 rpm\"\n[march]\nduration = \"0.8 s\"\n";

/// Bytes of a page, at most.
const MOST: usize = 3_000_000;

pub(super) fn ran(bench: &Workbench, arguments: &[&str]) -> String {
    let outcome = bench.whirl(arguments);
    assert_eq!(outcome.status, 0, "{arguments:?}: {}", outcome.stderr);
    outcome.stdout
}

/// The page in a folder, and what is embedded in it.
pub(super) fn page(bench: &Workbench, folder: &str) -> (String, Value) {
    let text = fs::read_to_string(bench.path(folder).join("report.html")).expect("a page");
    let (_, rest) =
        text.split_once("<script id=\"data\" type=\"application/json\">").expect("data");
    let (data, _) = rest.split_once("</script>").expect("an end");
    let data = serde_json::from_str(data).expect("JSON");
    (text, data)
}

/// Packed numbers.
pub(super) fn numbers(packed: &Value) -> Vec<f64> {
    let letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let text = packed["base64"].as_str().expect("base64").trim_end_matches('=');
    let (mut bytes, mut bits, mut held) = (Vec::new(), 0_u32, 0);
    for letter in text.chars() {
        bits = bits << 6 | letters.find(letter).expect("a letter") as u32;
        held += 6;
        if held >= 8 {
            held -= 8;
            bytes.push((bits >> held) as u8);
            bits &= (1 << held) - 1;
        }
    }
    match packed["type"].as_str() {
        Some("f32") => {
            let all = bytes.chunks_exact(4).map(|own| own.try_into().expect("four bytes"));
            all.map(|own| f64::from(f32::from_le_bytes(own))).collect()
        }
        Some("f64") => {
            let all = bytes.chunks_exact(8).map(|own| own.try_into().expect("eight bytes"));
            all.map(f64::from_le_bytes).collect()
        }
        _ => {
            let all = bytes.chunks_exact(2).map(|own| own.try_into().expect("two bytes"));
            all.map(|own| f64::from(u16::from_le_bytes(own))).collect()
        }
    }
}

/// Every column of the history is in the page: its rows, or of every few the extremes. How many rows a point is.
fn hold_histories(bench: &Workbench, folder: &str, data: &Value) -> usize {
    let (history, kept) = (bench.history(folder), &data["run"]["histories"]);
    let every = kept["every"].as_u64().expect("a number") as usize;
    assert_eq!(kept["rows"], history.rows());
    let names = data["run"]["names"].as_array().expect("names");
    let single = |own: &f64| f64::from(*own as f32);
    for (place, name) in names.iter().enumerate() {
        let name = name.as_str().expect("a name");
        let known: Vec<f64> = history.column(name).iter().map(single).collect();
        let own = &kept["columns"][place];
        if every == 1 {
            assert_eq!(numbers(&own["values"]), known, "{name}");
            continue;
        }
        let of = |pick: fn(f64, f64) -> f64| -> Vec<f64> {
            known.chunks(every).map(|own| own.iter().copied().reduce(pick).expect("one")).collect()
        };
        assert_eq!(numbers(&own["least"]), of(f64::min), "{name}");
        assert_eq!(numbers(&own["most"]), of(f64::max), "{name}");
    }
    // All columns are in charts, each in one.
    let groups = data["about"]["groups"].as_array().expect("groups");
    let lines = groups.iter().flat_map(|own| own["lines"].as_array().expect("lines"));
    let mut drawn: Vec<&str> = lines.map(|own| own[0].as_str().expect("a name")).collect();
    let mut all: Vec<&str> = names.iter().map(|own| own.as_str().expect("a name")).collect();
    drawn.sort_unstable();
    all.sort_unstable();
    assert_eq!(drawn, all);
    every
}

#[test]
fn a_page_has_the_numbers_of_the_run() {
    let bench = Workbench::new().file("case.toml", RUN_UP);
    ran(&bench, &["run", "case.toml", "--out", "out", "--no-figures", "--parquet"]);
    let (text, data) = page(&bench, "out");
    assert!(text.len() < MOST, "{} bytes", text.len());
    // Nothing is fetched, and no text of the case is markup.
    for word in
        ["src=\"http", "href=\"http", "url(http", "@import", "fetch(", "<b>a run-up", "<link"]
    {
        assert!(!text.contains(word), "{word}");
    }
    assert!(text.contains("<title>case: &lt;/script&gt;&lt;b&gt;a run-up &amp; more</title>"));
    assert_eq!(data["about"]["title"], "</script><b>a run-up & more");
    assert_eq!(data["summary"], bench.summary("out"));
    let every = hold_histories(&bench, "out", &data);
    assert!(every == 1, "{every}");
    let words = data["about"]["words"].to_string();
    for word in ["Bodies", "\"60\"", "bearing left", "law ocvirk", "c = 150 µm", "unbalance disc"]
    {
        assert!(words.contains(word), "`{word}` is not in {words}");
    }
    let files: Vec<&str> = data["files"]
        .as_array()
        .expect("files")
        .iter()
        .filter_map(|own| own["name"].as_str())
        .collect();
    let names = [
        "about.json",
        "history.csv",
        "history.parquet",
        "shapes.json",
        "state.bin",
        "summary.json",
    ];
    assert_eq!(files, names);
    orbits(&bench, &data);
    whirl(&bench, &data);
}

/// The orbit of the last revolutions, and where the keyphasor sees it.
fn orbits(bench: &Workbench, data: &Value) {
    let history = bench.history("out");
    let [theta, x, y] = ["theta_rad", "EX_left_um", "EY_left_um"].map(|name| history.column(name));
    let own = &data["run"]["orbits"][0];
    assert_eq!((&own["title"], &own["clearance_um"]), (&"left".into(), &150.0.into()));
    assert_eq!(own["sense"], 1.0);
    let last = theta[theta.len() - 1];
    let from = theta.iter().position(|own| last - own <= 8.0 * TAU).expect("revolutions");
    let single =
        |all: &[f64]| -> Vec<f64> { all.iter().map(|own| f64::from(*own as f32)).collect() };
    assert_eq!(numbers(&own["x_um"]), single(&x[from..]));
    assert_eq!(numbers(&own["y_um"]), single(&y[from..]));
    let forces = ["RX_left_N", "RY_left_N"].map(|name| single(&history.column(name)[from..]));
    assert_eq!(["fx_n", "fy_n"].map(|name| numbers(&own[name])), forces);
    let seen = own["keyphasors"].as_array().expect("points");
    assert_eq!(seen.len(), 8);
    for point in seen {
        let [px, py, before] = [0, 1, 2].map(|k| point[k].as_f64().expect("a number"));
        let at = last - TAU * before;
        assert!((at / TAU - (at / TAU).round()).abs() < 1e-5, "{at}");
        let k = theta.iter().position(|own| *own >= at).expect("a row");
        // Between two rows, on a line.
        let (step_x, step_y) = ((x[k] - x[k - 1]).abs(), (y[k] - y[k - 1]).abs());
        assert!((px - x[k]).abs() <= step_x + 1e-4 && (py - y[k]).abs() <= step_y + 1e-4);
    }
}

/// The oil whirl: nearly half of the speed, forward, as large as the orbit.
fn whirl(bench: &Workbench, data: &Value) {
    let own = &data["run"]["spectra"][0];
    assert_eq!(own["two_sided"], true);
    let turning = own["turning_hz"].as_f64().expect("a number");
    let line = &own["lines"][0];
    let (frequency, amplitude) = (numbers(&line["frequency_hz"]), numbers(&line["amplitude"]));
    let most = amplitude.iter().copied().fold(0.0, f64::max);
    let at = frequency[amplitude.iter().position(|own| *own == most).expect("a peak")] / turning;
    let clearance = 150.0;
    assert!((0.4..0.52).contains(&at), "at {at} of the speed");
    assert!(most > 0.2 * clearance && most < clearance, "{most}");
    let rows = bench.history("out");
    let ratio =
        rows.column("EX_left_um").iter().zip(rows.column("EY_left_um")).map(|(x, y)| x.hypot(*y));
    let largest = ratio.fold(0.0, f64::max) / clearance;
    let columns = data["run"]["histories"]["columns"].as_array().expect("columns");
    let place = data["run"]["names"].as_array().expect("names").len();
    let kept = numbers(&columns[place]["values"]).into_iter().fold(0.0, f64::max);
    assert!((kept / largest - 1.0).abs() < 1e-6, "{kept} {largest}");
}

/// A page is what the folder makes it, whoever asks.
#[test]
fn a_page_is_made_again_from_what_is_on_disk() {
    let bench = Workbench::new().file("case.toml", SHORT);
    ran(&bench, &["run", "case.toml", "--out", "out"]);
    let (text, data) = page(&bench, "out");
    hold_histories(&bench, "out", &data);
    // Laws are drawn by figures alone.
    let figures = data["figures"].as_array().expect("figures");
    let names: Vec<&str> = figures.iter().filter_map(|own| own["name"].as_str()).collect();
    assert_eq!(names, ["laws.svg"]);
    fs::remove_file(bench.path("out/report.html")).expect("it is there");
    let said = ran(&bench, &["report", "out"]);
    assert_eq!(said.trim_end(), "out/report.html");
    assert!(page(&bench, "out").0 == text);
    // Without one nothing else changes.
    ran(&bench, &["run", "case.toml", "--out", "none", "--no-report", "--no-figures"]);
    let names = ["about.json", "history.csv", "shapes.json", "state.bin", "summary.json"];
    assert_eq!(bench.listing_of("none"), names);
    assert!(bench.history_text("none") == bench.history_text("out"));
    ran(&bench, &["report", "none"]);
    hold_histories(&bench, "none", &page(&bench, "none").1);
}

#[test]
fn a_mass_between_stops_has_a_page() {
    let bench = Workbench::new();
    ran(&bench, &["run", "sdnd101", "--out", "out", "--no-figures"]);
    let (text, data) = page(&bench, "out");
    assert!(text.len() < MOST, "{} bytes", text.len());
    hold_histories(&bench, "out", &data);
    assert!(data["run"]["orbits"].as_array().is_some_and(Vec::is_empty));
    assert!(data["about"]["words"].to_string().contains("natural frequency"));
}

#[test]
fn folders_without_results_have_no_page() {
    let bench = Workbench::new().file("about.json", "{\"layout\": 0}").file("a.txt", "");
    fs::create_dir(bench.path("empty")).expect("a folder");
    for (folder, words) in [
        ("nowhere", "there is no folder `nowhere`"),
        ("empty", "`empty` has neither `about.json` nor"),
        (".", "of another version of the program"),
        ("a.txt", "there is no folder `a.txt`"),
    ] {
        let outcome = bench.whirl(&["report", folder]);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
        for words in [words, "= help:"] {
            assert!(outcome.stderr.contains(words), "`{words}` is not in: {}", outcome.stderr);
        }
    }
    assert_eq!(bench.listing(), ["a.txt", "about.json", "empty"]);
    // Rows of another case.
    let bench = Workbench::new();
    ran(&bench, &["run", "sdnd101", "--out", "out", "--no-figures", "--no-report"]);
    fs::write(bench.path("out/history.csv"), "t_s,x_um\n1,2\n").expect("written");
    let outcome = bench.whirl(&["report", "out"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(
        outcome.stderr.contains("it has other columns than about.json says"),
        "{}",
        outcome.stderr
    );
}

/// What docs/report.md shows of the terminal is what is there.
#[test]
fn the_commands_of_the_page_on_reports_work() {
    let text = include_str!("../../docs/report.md");
    let (_, rest) = text.split_once("```console\n").expect("commands");
    let (block, _) = rest.split_once("```").expect("an end");
    let bench = Workbench::new();
    let mut said = String::new();
    for line in block.lines() {
        match line.strip_prefix("$ whirl ") {
            Some(arguments) => {
                assert_eq!(said, "", "what is not shown");
                said = ran(&bench, &arguments.split(' ').collect::<Vec<&str>>());
            }
            None => {
                let (first, rest) = said.split_once('\n').expect("a line");
                assert_eq!(first, line);
                said = rest.to_owned();
            }
        }
    }
    assert_eq!(said, "", "what is not shown");
}

/// Analyses share a folder and a page with the run of their case.
#[test]
fn analyses_are_on_the_page_of_their_case() {
    let bench = Workbench::new().file("case.toml", RUN_UP);
    let speeds = ["--speeds", "1000 rpm .. 9000 rpm, 9", "--out", "out"];
    ran(&bench, &[&["campbell", "case.toml"], &speeds[..]].concat());
    let (text, data) = page(&bench, "out");
    assert!(data["about"].is_null() && data["run"].is_null());
    let done = |data: &Value| -> Vec<String> {
        let all = data["analyses"]["analyses"].as_array().expect("analyses").clone();
        all.iter().map(|own| own["name"].as_str().expect("a name").to_owned()).collect()
    };
    assert_eq!(done(&data), ["campbell"]);
    assert!(data["analyses"]["words"].to_string().contains("law ocvirk"));
    let own = &data["analyses"]["analyses"][0];
    assert!(own["text"].as_str().expect("words").contains("UNSTABLE above"), "{own}");
    let tables = data["tables"].as_array().expect("tables");
    let csv = tables.iter().find(|own| own["name"] == "campbell.csv").expect("a table");
    let file = fs::read_to_string(bench.path("out/campbell.csv")).expect("a file");
    assert_eq!(csv["csv"], file);
    let figures = data["figures"].as_array().expect("figures");
    assert!(figures.iter().any(|own| own["name"] == "campbell.svg"));
    ran(&bench, &["report", "out"]);
    assert!(page(&bench, "out").0 == text);
    // What is done later is added, and a run stands before all.
    ran(&bench, &[&["response", "case.toml", "--no-figures"], &speeds[..]].concat());
    ran(&bench, &[&["campbell", "case.toml", "--no-figures"], &speeds[..]].concat());
    ran(&bench, &["run", "case.toml", "--out", "out", "--no-figures"]);
    let (_, data) = page(&bench, "out");
    assert_eq!(done(&data), ["campbell", "response"]);
    hold_histories(&bench, "out", &data);
    assert!(data["run"]["tracked"].as_array().is_some_and(|own| !own.is_empty()));
    // Of another state of the case nothing stays.
    let other = RUN_UP.replace("7000 rpm", "7100 rpm");
    fs::write(bench.path("case.toml"), other).expect("written");
    ran(&bench, &[&["response", "case.toml", "--no-figures", "--no-report"], &speeds[..]].concat());
    ran(&bench, &["report", "out"]);
    assert_eq!(done(&page(&bench, "out").1), ["response"]);
}

#[test]
fn a_sweep_has_a_page() {
    let bench = Workbench::new().file("case.toml", SHORT);
    let vary = "springs.radial_clearance=20 um .. 60 um, 3";
    let sweep = ["sweep", "case.toml", "--vary", vary, "--out", "out", "--no-figures"];
    ran(&bench, &sweep);
    let (text, data) = page(&bench, "out");
    assert_eq!(data["sweep"]["varied"], serde_json::json!(["springs.radial_clearance [um]"]));
    assert_eq!(data["sweep"]["lines"][0], "3 points:");
    let table = fs::read_to_string(bench.path("out/table.csv")).expect("a table");
    assert_eq!(data["tables"][0]["csv"], table);
    ran(&bench, &["report", "out"]);
    assert!(page(&bench, "out").0 == text);
    ran(&bench, &[&sweep[..], &["--no-report"]].concat());
    assert!(!bench.path("out/report.html").exists() && bench.path("out/sweep.json").exists());
}

/// Surfaces of the bodies, and the last cycle where the case wants fields.
#[test]
fn bodies_with_meshes_are_shown_and_played() {
    let case = include_str!("fields-weight.toml");
    let bench = Workbench::new().file("case.toml", case);
    ran(&bench, &["run", "case.toml", "--out", "out", "--no-figures"]);
    let (_, data) = page(&bench, "out");
    let body = &data["shapes"]["bodies"][0];
    assert_eq!((&body["name"], &body["turns"]), (&"rotor".into(), &true.into()));
    let points = numbers(&body["points"]);
    // Of fewer than 65,536 nodes places are short.
    assert_eq!(body["triangles"]["type"], "u16");
    let triangles = numbers(&body["triangles"]);
    let triangles: Vec<usize> = triangles.into_iter().map(|own| own as usize).collect();
    assert_eq!((points.len() % 3, triangles.len() % 3), (0, 0));
    assert!(triangles.iter().all(|own| 3 * own < points.len()));
    // The triangles close it: their volume is that of the polygons that the cells make of a cylinder, and they face outwards.
    let at = |node: usize| [points[3 * node], points[3 * node + 1], points[3 * node + 2]];
    let volume: f64 = triangles
        .chunks_exact(3)
        .map(|own| {
            let [a, b, c] = [at(own[0]), at(own[1]), at(own[2])];
            let across =
                [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
            (a[0] * across[0] + a[1] * across[1] + a[2] * across[2]) / 6.0
        })
        .sum();
    let cylinder = 0.25 * std::f64::consts::PI * 0.04_f64.powi(2) * 0.4;
    assert!(volume > 0.8 * cylinder && volume < 1.25 * cylinder, "{volume} {cylinder}");
    let motion = &body["motion"];
    let frames = motion["time"].as_array().expect("times").len();
    assert!(frames >= 8, "{frames}");
    let largest = motion["largest"].as_f64().expect("a number");
    let moved: Vec<f64> = numbers(&motion["displacement"]);
    assert_eq!(moved.len(), frames * points.len());
    let most = moved.iter().map(|own| (own - 32768.0).abs() / 32767.0).fold(0.0, f64::max);
    assert!((most - 1.0).abs() < 1e-9 && largest > 0.0);
    let known = bench.summary("out")["stresses"]["rotor"]["von_mises_MPa"].as_f64().expect("one");
    let shown = motion["largest_mpa"].as_f64().expect("a number");
    // The largest of all nodes is on the surface of a shaft that is bent.
    assert!((shown / known - 1.0).abs() < 1e-5, "{shown} {known}");
}

/// What is in films over the angle of the last revolutions, as a figure and on the page.
#[test]
fn films_are_shown_over_the_angle() {
    let case = include_str!("../../.ci/cases/films.toml");
    let bench = Workbench::new().file("case.toml", case);
    ran(&bench, &["run", "case.toml", "--out", "out"]);
    let svg = fs::read_to_string(bench.path("out/film.svg")).expect("a figure");
    for own in ["largest pressure", "gap (µm)", "flow (mL/s)", "power (W)", "in the last cycle (°)"]
    {
        assert!(svg.contains(own), "{own}");
    }
    let (_, data) = page(&bench, "out");
    let groups = data["about"]["groups"].as_array().expect("groups");
    let turned = data["run"]["turned"].as_array().expect("charts over the angle");
    let titles: Vec<&str> = turned
        .iter()
        .map(|own| groups[own["group"].as_u64().expect("a place") as usize]["title"].as_str())
        .map(|own| own.expect("a title"))
        .collect();
    for what in ["largest pressure", "smallest gap", "what enters at its openings"] {
        assert!(titles.contains(&format!("left, film: {what}").as_str()), "{titles:?}");
    }
    // 3000 rpm in rows of 0.1 ms: 200 a revolution, and the last one is where they end.
    for own in turned {
        let degrees = numbers(&own["degrees"]);
        assert!((own["revolutions"].as_f64().expect("a number") - 2.0).abs() < 1e-6);
        assert_eq!(degrees.len(), 401);
        assert!(degrees[0].abs() < 1e-3 && (degrees[400] - 720.0).abs() < 1e-3, "{degrees:?}");
    }
    // No figure of the file is shown beside the charts that the page draws.
    let figures = data["figures"].as_array().expect("figures");
    assert!(!figures.iter().any(|own| own["name"] == "film.svg"));
}
