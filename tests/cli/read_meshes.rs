//! Cases with meshes of their own: what is read of them, what must fit together, what they are made of.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::bad_input::{case, refused};
use crate::workbench::Workbench;

/// A reference mesh as text.
pub(crate) fn reference(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../tests/data/{name}.inp.gz"));
    let packed =
        fs::File::open(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut text = String::new();
    std::io::Read::read_to_string(&mut flate2::read::GzDecoder::new(packed), &mut text)
        .expect("gzip");
    text
}

/// The machine file on both reference meshes, with more lines.
fn on_meshes(lines: &str) -> String {
    case(&format!("[shaft]\nmesh = \"shaft.inp\"\n[support]\nmesh = \"support.inp\"\n{lines}"))
}

fn bench(shaft: &str, support: &str, lines: &str) -> Workbench {
    Workbench::new()
        .file("case.toml", &on_meshes(lines))
        .file("shaft.inp", shaft)
        .file("support.inp", support)
}

fn examined(bench: &Workbench) -> Result<(), String> {
    let path = bench.path("case.toml");
    whirl_cli::examine(path.to_str().expect("a path")).map(drop).map_err(|failure| failure.report())
}

/// Moves all nodes by some metres along x and y.
fn moved(mesh: &str, [dx, dy]: [f64; 2]) -> String {
    let mut text = String::new();
    let mut among_nodes = false;
    for line in mesh.lines() {
        if line.starts_with('*') && !line.starts_with("**") {
            among_nodes = line.starts_with("*NODE");
        } else if among_nodes && !line.starts_with('*') {
            let values: Vec<&str> = line.split(',').map(str::trim).collect();
            let [x, y] = [1, 2].map(|i| values[i].parse::<f64>().expect("a number"));
            writeln!(text, "{}, {:e}, {:e}, {}", values[0], x + dx, y + dy, values[3])
                .expect("text");
            continue;
        }
        writeln!(text, "{line}").expect("text");
    }
    text
}

/// The mesh replaces the included dimensions; unevenly spaced bore nodes have their axis where they should.
#[test]
fn reference_meshes_fit_together() {
    let bench = bench(&reference("shaft"), &reference("support"), "");
    assert_eq!(examined(&bench), Ok(()));
    // Single precision moves no axis.
    let rounded = |mesh: &str| moved(mesh, [3e-8, -2e-8]);
    let (shaft, support) = (rounded(&reference("shaft")), rounded(&reference("support")));
    assert_eq!(examined(&bench_of(&shaft, &support)), Ok(()));
}

fn bench_of(shaft: &str, support: &str) -> Workbench {
    bench(shaft, support, "")
}

#[test]
fn axes_that_are_apart_are_reported() {
    let (shaft, support) = (reference("shaft"), reference("support"));
    refused(
        &bench_of(&moved(&shaft, [0.0, 4e-6]), &support),
        &[
            "hu2003.machine.toml:",
            "the journal's node `JOURNAL4_LEFT` is at x = 0 mm, y = 0.004 mm: 0.004 mm off the axis",
            "x = y = 0",
        ],
    );
    refused(
        &bench_of(&shaft, &moved(&support, [3e-3, -4e-3])),
        &[
            "hu2003.machine.toml:",
            "the nodes of `BORE1_LEFT` are on a circle about x = 3 mm, y = -4 mm: 5 mm off the axis",
            "`BORE4_RIGHT`",
        ],
    );
}

#[test]
fn sets_without_nodes_are_reported() {
    let shaft = reference("shaft") + "*NSET, NSET=NOTHING\n";
    let support = reference("support") + "*NSET, NSET=NOWHERE\n";
    let lines = "mounts = \"NOWHERE\"\n[[support.ground_spring]]\nset = \"NOWHERE\"\n\
                 stiffness = \"1 N/m\"\n[drive]\ntop = \"NOTHING\"\n[[load]]\nsets = [\"NOTHING\"]\nforce = \"1 N\"\n\
                 [[bearing]]\njournal = [\"JOURNAL1_LEFT\", \"JOURNAL1_MIDDLE\", \"JOURNAL1_RIGHT\"]\n\
                 bore = [\"BORE1_LEFT\", \"NOWHERE\", \"BORE1_RIGHT\"]";
    refused(
        &bench(&shaft, &support, lines),
        &[
            "case.toml:7:11",
            "the node set `NOWHERE` of support.inp has no nodes",
            "case.toml:9:8",
            "case.toml:12:8",
            "the node set `NOTHING` of shaft.inp must have one node, but has 0",
            "case.toml:14:10",
            "the node set `NOTHING` of shaft.inp has no nodes",
            "case.toml:18:24",
        ],
    );
}

/// Materials of a body as `check` lists them.
fn materials(bench: &Workbench, body: &str) -> String {
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let start = format!("materials of {body}: ");
    let line = outcome.stdout.lines().find_map(|line| line.strip_prefix(&start));
    line.expect("the materials are listed").to_string()
}

/// The mesh's sections hold, the case's material fills what they leave out, regions replace them.
#[test]
fn materials_come_from_the_mesh_and_the_case() {
    let shaft = reference("shaft");
    let light = "[material.light]\nyoungs_modulus = \"70 GPa\"\npoissons_ratio = 0.33\ndensity = \"2700 kg/m^3\"\n";
    let with = |shaft: &str, lines: &str| {
        // The support stays made from its dimensions.
        let text = case(&format!("[shaft]\nmesh = \"shaft.inp\"\n{lines}{light}"));
        Workbench::new().file("case.toml", &text).file("shaft.inp", shaft)
    };
    let bench = with(&shaft, "material = \"light\"\n");
    assert_eq!(materials(&bench, "shaft"), "STEEL (1824 cells)");
    let partly = shaft.replace("*SOLID SECTION, ELSET=Ewedge6, MATERIAL=STEEL\n", "");
    assert_eq!(
        materials(&with(&partly, "material = \"light\"\n"), "shaft"),
        "light (608 cells), STEEL (1216 cells)"
    );
    let regions = with(&shaft, "[shaft.regions]\newedge6 = \"light\"\n");
    assert_eq!(materials(&regions, "shaft"), "light (608 cells), STEEL (1216 cells)");
    let (start, _) = shaft.split_once("*MATERIAL").expect("a material");
    assert_eq!(materials(&with(start, ""), "shaft"), "steel (1824 cells)");

    let bare = Workbench::new()
        .file("case.toml", &on_meshes("[shaft.regions]\nEwedg = \"steel\"\nEhex8 = \"setel\"\n"))
        .file("shaft.inp", start)
        .file("support.inp", "*NODE\n");
    refused(
        &bare,
        &[
            "case.toml:8:1",
            "shaft.inp has no element set `Ewedg`",
            "did you mean `Ewedge6`?",
            "case.toml:9:10",
            "did you mean `steel`?",
        ],
    );
}

/// A mesh from an older program: umlauts in Latin-1, and a heading.
#[test]
fn latin_1_and_headings_are_read_without_a_word() {
    let mut bytes = b"*HEADING\nWelle f\xfcr den Pr\xfcfstand\n** \xa9 1998, 68 mm \xd8\n".to_vec();
    bytes.extend(reference("shaft").into_bytes());
    let text = case("[shaft]\nmesh = \"shaft.inp\"\n");
    let bench = Workbench::new().file("case.toml", &text);
    fs::write(bench.path("shaft.inp"), bytes).expect("written");
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!((outcome.status, outcome.stderr.as_str()), (0, ""));
}

/// Warnings stand once, in a check and in a run, and a check takes the cache that it is given.
#[test]
fn a_check_warns_once_and_takes_its_cache() {
    let text = case("[shaft]\nmesh = \"shaft.inp\"\n");
    let bench = Workbench::new()
        .file("case.toml", &text)
        .file("shaft.inp", &format!("*BOUNDARY\n1, 1\n{}", reference("shaft")));
    let outcome = bench.whirl(&["check", "case.toml", "--cache", "kept"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert_eq!(outcome.stderr.matches("*BOUNDARY is left out").count(), 1, "{}", outcome.stderr);
    let kept = fs::read_dir(bench.path("kept")).expect("a cache").count();
    assert!(kept > 0);
    fs::remove_dir_all(bench.path("kept")).expect("removed");
    let outcome = bench.whirl(&["check", "case.toml", "--no-cache"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert_eq!(bench.listing(), ["case.toml", "shaft.inp"]);
}

/// A cube beside the shaft, joined to nothing.
fn with_a_cube(shaft: &str) -> String {
    let corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
    let mut nodes = String::new();
    for (k, [x, y]) in corners.iter().chain(&corners).enumerate() {
        let (x, y, z) = (f64::from(*x) + 1.0, f64::from(*y), if k < 4 { 0.0 } else { 1.0 });
        writeln!(nodes, "{}, {x}, {y}, {z}", 9001 + k).expect("text");
    }
    let labels: Vec<String> = (9001..9009).map(|label: u32| label.to_string()).collect();
    format!(
        "{shaft}*NODE\n{nodes}*ELEMENT, TYPE=C3D8I, ELSET=FAN\n7001, {}\n\
         *SOLID SECTION, ELSET=FAN, MATERIAL=STEEL\n",
        labels.join(", ")
    )
}

/// Whatever the number of modes, also with none, where no mode is wanted.
#[test]
fn a_loose_part_is_named_for_any_number_of_modes() {
    let shaft = with_a_cube(&reference("shaft"));
    for modes in [0, 1, 6, 50] {
        let text = case(&format!("[shaft]\nmesh = \"shaft.inp\"\nmodes = {modes}\n"));
        let bench = Workbench::new().file("case.toml", &text).file("shaft.inp", &shaft);
        refused(
            &bench,
            &[
                "case.toml:4:9",
                "a part of shaft.inp is loose: 1 cell shares no node with the rest (7001; sets: `FAN`)",
                "let it share nodes",
            ],
        );
    }
}

#[test]
fn what_would_hide_the_body_from_rounding_is_reported_at_once() {
    let lines = "[[support.ground_spring]]\nset = \"GROUND_SPRINGS\"\ndirection = \"y\"\n\
                 stiffness = \"1e20 N/m\"\n";
    refused(
        &Workbench::new().file("case.toml", &case(lines)),
        &[
            "case.toml:4:8",
            "this spring of 1e20 N/m is",
            "times as stiff as the stiffest node of the support",
            "name the set in `mounts`",
        ],
    );
}

/// The comments of a new case lead to one that works: each line that they offer is taken, with a mesh.
#[test]
fn a_new_case_works_by_its_own_comments() {
    let bench = Workbench::new();
    assert_eq!(bench.whirl(&["new", "case", "mine"]).status, 0);
    let text = fs::read_to_string(bench.path("mine.toml")).expect("a case");
    let (before, block) = text.split_once("# [shaft]\n").expect("a table in comments");
    let (block, after) = block.split_once("\n\n").expect("its end");
    assert!(block.contains("# mesh = \"shaft.inp\""), "{block}");
    let block: String = block
        .lines()
        .map(|line| format!("{}\n", line.strip_prefix("# ").expect("a comment")))
        .collect();
    let text = format!("{before}[shaft]\n{block}\n{after}");
    let bench = bench.file("mine.toml", &text).file("shaft.inp", &reference("shaft"));
    let outcome = bench.whirl(&["check", "mine.toml"]);
    assert_eq!((outcome.status, outcome.stderr.as_str()), (0, ""));
    assert!(outcome.stdout.contains("materials of shaft: STEEL"), "{}", outcome.stdout);
}

/// A block of 1 × 1 × 2 on a bushing, as Gmsh wrote it.
fn block(units: &str, name: &str) -> Workbench {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data/gmsh/hex8-22-text.msh.gz");
    let packed = fs::File::open(path).expect("the test data is there");
    let mut mesh = String::new();
    std::io::Read::read_to_string(&mut flate2::read::GzDecoder::new(packed), &mut mesh)
        .expect("text");
    let case = format!(
        "title = \"x\"\n[material.steel]\nyoungs_modulus = \"206 GPa\"\npoissons_ratio = 0.3\n\
         density = \"7850 kg/m^3\"\n[body.block]\nturns = \"no\"\nmesh = \"block.msh\"\n{units}\n\
         {name} \nmodes = 2\ndamping = \"1e-5 s\"\nheld = [\"low end\"]\n[body.tip]\nturns = \"no\"\n\
         mass = \"1 kg\"\n[joint.spring]\nkind = \"bushing\"\n\
         first = {{ body = \"block\", sets = \"SURFACE_7\" }}\nsecond = {{ body = \"tip\" }}\n\
         stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n\
         damping = {{ xx = \"1e3 N*s/m\", yy = \"1e3 N*s/m\" }}\n\
         [march]\ntime_step = \"1e-5 s\"\nsteps = 10\n"
    );
    Workbench::new().file("case.toml", &case).file("block.msh", &mesh)
}

#[test]
fn meshes_of_gmsh_have_units_and_take_materials_by_groups() {
    for (units, mass) in [
        ("units = \"mm, N, t\"", "0.0000157"),
        ("units = \"in, lbf, lbf*s^2/in\"", "0.257277"),
        ("", "15700"),
    ] {
        for material in ["material = \"steel\"", "regions = { body = \"steel\" }"] {
            let outcome = block(units, material).whirl(&["check", "case.toml"]);
            assert_eq!(outcome.status, 0, "{}", outcome.stderr);
            let line =
                outcome.stdout.lines().find(|line| line.starts_with("block")).expect("a line");
            assert!(line.split_whitespace().nth(1).expect("a mass").starts_with(mass), "{line}");
            let left_out = "left out: 1 point, ";
            assert_eq!(outcome.stderr.matches(left_out).count(), 1, "{}", outcome.stderr);
        }
    }
}

#[test]
fn units_of_meshes_that_are_wrong_are_refused() {
    for (units, what) in [
        ("mm, N", "`mm, N` are 2 units, not three"),
        ("mm, N, s", "`s` is no unit of mass"),
        ("mm, Newton, t", "`Newton` is no unit of force"),
        ("N, mm, t", "`N` is no unit of length"),
    ] {
        let bench = block(&format!("units = \"{units}\""), "material = \"steel\"");
        refused(&bench, &[what]);
    }
    refused(&block("", ""), &["files of Gmsh have no materials", "material = "]);
}

/// A part may be far stiffer than any solid or have no mass, with a warning; a body cannot be all without mass.
#[test]
fn materials_that_no_solid_has_are_warned_of() {
    let with = |key: &str, from: &str, to: &str| {
        let bench = block("units = \"mm, N, t\"", "regions = { body = \"steel\" }");
        let case = fs::read_to_string(bench.path("case.toml")).expect("a case");
        bench.file("case.toml", &case.replace(from, to)).whirl(&[key, "case.toml"])
    };
    let stiff = with("check", "206 GPa", "206000 GPa");
    assert_eq!(stiff.status, 0, "{}", stiff.stderr);
    let said = "case.toml: in material steel (E = 206000000000000 Pa, ρ = 7850 kg/m³) sound would travel at 1.620e5 m/s: if";
    assert_eq!(stiff.stderr.matches(said).count(), 1, "{}", stiff.stderr);
    let none = with("check", "7850 kg/m^3", "0 kg/m^3");
    assert_eq!(none.status, 2, "{}", none.stderr);
    assert!(none.stderr.contains("this body has no mass: its density is 0"), "{}", none.stderr);
    assert!(none.stderr.contains("by `regions`"), "{}", none.stderr);
    for (from, to) in [("206 GPa", "0 GPa"), ("7850 kg/m^3", "-1 kg/m^3")] {
        assert_eq!(with("check", from, to).status, 2, "{to}");
    }
}
