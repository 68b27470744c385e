//! `whirl explain` and `whirl check` of spec files: every spec has its page, every mistake its message.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::workbench::{Outcome, Workbench};

fn specs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs")
}

/// Path, kind and name of every spec file that is shipped.
fn shipped() -> Vec<(PathBuf, String, String)> {
    let mut found = Vec::new();
    for folder in ["laws", "elements", "forms", "motion"] {
        for entry in fs::read_dir(specs().join(folder)).expect("the folder is there") {
            let path = entry.expect("an entry").path();
            if path.extension().is_none_or(|extension| extension != "toml") {
                continue;
            }
            let text = fs::read_to_string(&path).expect("a text");
            let table: toml::Table = text.parse().expect("TOML");
            let word = |key: &str| table[key].as_str().expect("a word").to_string();
            found.push((path, word("kind"), word("name")));
        }
    }
    assert!(found.len() >= 12, "{found:?}");
    found
}

fn fine(outcome: &Outcome) {
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert_eq!(outcome.stderr, "");
}

fn says(outcome: &Outcome, words: &[&str]) {
    for word in words {
        assert!(outcome.stdout.contains(word), "`{word}` is not in:\n{}", outcome.stdout);
    }
}

#[test]
fn every_spec_is_explained_by_its_name_and_checked_by_its_path() {
    let bench = Workbench::new();
    let mut kinds = BTreeSet::new();
    for (path, kind, name) in shipped() {
        let page = bench.whirl(&["explain", &name]);
        fine(&page);
        says(&page, &[&format!("{kind} {name}: "), "\nsource: ", "\nGenerated Rust\n"]);
        // Of every kind, one by its path too; all would take long.
        if !kinds.insert(kind.clone()) {
            continue;
        }
        let by_path = bench.whirl(&["explain", path.to_str().expect("a path")]);
        let body = |text: &str| text.splitn(4, '\n').nth(3).map(str::to_string);
        // A file with the text of a built-in spec has its kernels too; only its path differs.
        assert_eq!(body(&by_path.stdout), body(&page.stdout), "{name}");
        let checked = bench.whirl(&["check", path.to_str().expect("a path")]);
        fine(&checked);
        says(&checked, &[&format!("{kind} {name}: ")]);
        assert!(!checked.stdout.contains("Generated Rust"), "{}", checked.stdout);
    }
    assert!(bench.listing().is_empty());
}

#[test]
fn the_rust_of_a_spec_is_exactly_its_module() {
    let bench = Workbench::new();
    for (path, kind, name) in &shipped() {
        let outcome = bench.whirl(&["explain", name, "--rust"]);
        fine(&outcome);
        let file = path.file_name().expect("a name").to_string_lossy();
        says(&outcome, &[&format!("/{file}\","), "pub const ENTRY: "]);
        assert_eq!(outcome.stdout.matches("\npub mod ").count(), 1, "{kind} {name}");
        assert!(outcome.stdout.ends_with("\n}\n"));
    }
    let outcome = bench.whirl(&["explain", "elasticity", "--rust"]);
    assert!(outcome.stdout.contains("pub fn stiffness_pairs_<"), "{}", outcome.stdout);
    let page = bench.whirl(&["explain", "inertia"]);
    says(&page, &["and in the module of every element, such as `whirl explain hex8 --rust`"]);
}

#[test]
fn a_law_is_explained_with_equations_report_and_plot() {
    let outcome = Workbench::new().whirl(&["explain", "hu2003-linear"]);
    fine(&outcome);
    says(
        &outcome,
        &[
            "c0 = 0.035687 mm",
            "(in a bearing: its radial_clearance)",
            "Valid where\n  film = h  at least 0 mm  clearance at the spring\n",
            "= 233 - 6517*h  where h <= c0",
            "  dQ_dh (N/mm)\n    = -6517  where h <= 0.0357526 (the root; the file says h <= c0)\n",
            "never rises with rising h",
            "slope -6517 to 0",
            "Plot of Q (N) over h (mm)",
            "233 |*",
            "module whirl_specs::laws::hu2003_linear",
            "out/laws.rs:",
        ],
    );
}

#[test]
fn forms_motions_and_clearances_show_what_was_derived() {
    let bench = Workbench::new();
    for (name, words) in [
        (
            "elasticity",
            &["symmetric, 3n × 3n", "k_xy = lambda*dNa_dx*dNb_dy + mu*dNb_dx*dNa_dy"][..],
        ),
        ("inertia", &["⊗ [[0, 1, 0], [-1, 0, 0], [0, 0, 0]]", "s_ab = rho*Na*Nb"]),
        ("consistent", &["B.eta.eta = theta_dot^2*W", "PF.theta.theta = PF.eta.theta = 0"]),
        (
            "journal",
            &[
                "on delta (N) = Q",
                "delta.delta = dQ_dh + dQ_dh_dot*a1",
                "v_t (m/s) = ",
                "Laws of a ring: generalised forces of F_x (N), F_y (N), M_z (N*m)",
            ],
        ),
        ("hex8i", &["gradients: polynomials of degree 2", "8 points, exact to degree 3", "M1 = 1"]),
    ] {
        let outcome = bench.whirl(&["explain", name]);
        fine(&outcome);
        says(&outcome, words);
    }
}

/// What stands under the heading of the code, but where the code lies.
fn functions(page: &str) -> String {
    let (_, code) = page.split_once("\nGenerated Rust\n").expect("the heading");
    let places = [
        "module whirl_specs::",
        "compiled at the next build",
        "/out/",
        "printed by",
        "none is needed",
    ];
    let function = |line: &&str| !places.iter().any(|place| line.contains(place));
    code.lines().filter(function).map(str::trim).collect::<Vec<_>>().join(" ")
}

/// Of laws and elements some: a table, a ring, modes of an element's own; of the others all.
fn enough() -> Vec<(PathBuf, String, String)> {
    let mut some = shipped();
    let chosen = ["hex8i", "wedge6", "hu2003-linear", "radial-gap", "ball-bearing"];
    some.retain(|(_, kind, name)| {
        !["element", "law"].contains(&kind.as_str()) || chosen.contains(&name.as_str())
    });
    some
}

/// A bench with the files of columns that stand beside a spec.
fn tables_of(path: &Path) -> Workbench {
    let folder = path.parent().expect("a folder");
    let beside = fs::read_dir(folder).expect("the folder is there");
    let beside = beside.map(|entry| entry.expect("an entry").path());
    let tables = beside.filter(|path| path.extension().is_some_and(|ending| ending == "csv"));
    tables.fold(Workbench::new(), |bench, table| {
        let name = table.file_name().expect("a name").to_string_lossy().into_owned();
        bench.file(&name, &fs::read_to_string(&table).expect("a text"))
    })
}

/// The Rust of a file that is not built in is what a build would generate from it: that of the same built-in file, but for the
/// file's text and the hash.
#[test]
fn the_rust_of_ones_own_spec_is_what_a_build_would_generate() {
    let mut seen = BTreeSet::new();
    for (path, kind, name) in &enough() {
        let file = path.file_name().expect("a name").to_string_lossy().into_owned();
        let text = fs::read_to_string(path).expect("a text") + "# Not built in.\n";
        let bench = tables_of(path).file(&file, &text);
        let outcome = bench.whirl(&["explain", &file, "--rust"]);
        fine(&outcome);
        let original = bench.whirl(&["explain", name, "--rust"]);
        if kind == "form" || kind == "element" {
            // Each function as it stands in its own module or in that of an element that has it, too.
            let element = bench.whirl(&["explain", "hex8", "--rust"]).stdout;
            let made = public_functions(&outcome.stdout);
            assert!(!made.is_empty(), "{name}");
            match kind.as_str() {
                // Those of these forms alone.
                "form" => {
                    let of_element = public_functions(&element);
                    assert!(!of_element.iter().all(|own| made.contains(own)), "{name}");
                }
                _ => assert_eq!(made.len(), public_functions(&original.stdout).len(), "{name}"),
            }
            let known = |made: &String| original.stdout.contains(made) || element.contains(made);
            let differ: Vec<&String> = made.iter().filter(|made| !known(made)).collect();
            assert!(differ.is_empty(), "{name}: {differ:?}");
        } else {
            let own = |line: &&str| !["text:", "hash:"].iter().any(|s| line.trim().starts_with(s));
            let body =
                |text: &str| text.lines().filter(own).map(str::to_string).collect::<Vec<_>>();
            assert_ne!(outcome.stdout, original.stdout, "{name}");
            assert_eq!(body(&outcome.stdout), body(&original.stdout), "{name}");
        }
        seen.insert(kind.clone());
    }
    assert_eq!(seen.len(), 5, "{seen:?}");
}

/// The texts of the public functions, from `pub fn` to the brace at their margin.
fn public_functions(module: &str) -> Vec<String> {
    let starts = module.match_indices("\n    pub fn ").map(|(start, _)| &module[start..]);
    starts.filter_map(|text| Some(text[..text.find("\n    }\n")?].to_string())).collect()
}

/// What only a build would refuse is reported at its place by `check` and `explain --rust`.
#[test]
fn what_a_build_would_refuse_is_reported() {
    let path = specs().join("elements/hex8i.toml");
    let text = fs::read_to_string(path).expect("a text");
    let wrong = text.replace("\"stiffness\"", "\"stifness\"");
    assert_ne!(text, wrong);
    let bench = Workbench::new().file("mine.toml", &wrong);
    for arguments in [&["check", "mine.toml"][..], &["explain", "mine.toml", "--rust"]] {
        let outcome = bench.whirl(arguments);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{arguments:?}");
        for word in ["--> mine.toml:", "there is no form `stifness`", "did you mean `stiffness`?"] {
            assert!(outcome.stderr.contains(word), "`{word}` is not in:\n{}", outcome.stderr);
        }
    }
    let page = bench.whirl(&["explain", "mine.toml"]);
    fine(&page);
    says(&page, &["a build would refuse it:", "mine.toml:", "there is no form `stifness`"]);
}

/// A file that is not built in has the functions, with the operations, that the same built-in file has.
#[test]
fn what_a_build_would_generate_is_listed_with_its_operations() {
    for (path, kind, name) in &enough() {
        let text = fs::read_to_string(path).expect("a text");
        let other = text.replacen(&format!("name = \"{name}\""), "name = \"other\"", 1);
        assert_ne!(text, other, "{name}");
        let bench = tables_of(path).file("other.toml", &other);
        let page = bench.whirl(&["explain", "other.toml"]);
        fine(&page);
        let built_in = if kind == "form" { "hex8" } else { name };
        let original = functions(&bench.whirl(&["explain", built_in]).stdout);
        assert!(original.contains("operations") || original.contains(" mul"), "{name}: {original}");
        if kind != "form" {
            assert_eq!(functions(&page.stdout), original, "{name}");
            continue;
        }
        let (_, code) = page.stdout.split_once("\nGenerated Rust\n").expect("the heading");
        let own: Vec<&str> = code.split(", on the element hex8\n").skip(1).collect();
        assert!(!own.is_empty(), "{name}: {code}");
        for about in own {
            // Words are broken into lines elsewhere, since paths differ.
            let words: Vec<&str> = about.split_whitespace().collect();
            let operations = words.windows(3).find(|w| w[0] == "Together").expect("a count");
            assert!(original.contains(&operations.join(" ")), "{name}: {operations:?}");
        }
    }
}

/// The figures of the documents are what the program draws; WHIRL_RENEW_GOLDEN=1 draws them anew.
#[test]
fn figures_of_laws_are_as_committed() {
    let folder = specs().join("../docs/laws");
    let bench = Workbench::new();
    let files = fs::read_dir(&folder).expect("the folder").map(|entry| entry.expect("an entry"));
    let mut drawn = 0;
    for committed in files.map(|file| file.path()) {
        let name = committed.file_stem().expect("a name").to_string_lossy().into_owned();
        let file = format!("{name}.svg");
        fine(&bench.whirl(&["explain", &name, "--plot", &file]));
        let found = fs::read_to_string(bench.path(&file)).expect("a figure");
        whirl_tests::golden::is_as_committed(&committed, &found);
        drawn += 1;
    }
    assert!(drawn > 10, "{drawn} figures");
}

const MINE: &str = "kind = \"law\"\nname = \"mine\"\ntitle = \"Mine\"\nsource = \"a test\"\n\n\
    [inputs.h]\nunit = \"mm\"\n\n[parameters.k]\nvalue = 5\nunit = \"N/mm\"\n\n\
    [outputs.Q]\nunit = \"N\"\npieces = [{ when = 'h < 0', value = '-k*h' }, { value = '0' }]\n";

#[test]
fn a_law_of_ones_own_is_explained_and_drawn() {
    let bench = Workbench::new().file("mine.toml", MINE);
    let outcome = bench.whirl(&["explain", "mine.toml", "--plot", "figures/mine.svg"]);
    fine(&outcome);
    says(
        &outcome,
        &["= -k  where h < 0", "k = 5 N/mm", "none is needed", "`whirl explain mine.toml --rust`"],
    );
    let svg = fs::read_to_string(bench.path("figures/mine.svg")).expect("a figure");
    assert!(svg.contains("Mine") && svg.contains("h (mm)"), "{svg}");
    let png = fs::read(bench.path("figures/mine.png")).expect("a figure");
    assert!(png.starts_with(b"\x89PNG"));

    let outcome = bench.whirl(&["explain", "mine.toml", "--rust"]);
    fine(&outcome);
    says(
        &outcome,
        &["/// Mine.\n", "Spec: `laws/mine.toml`", "pub mod mine {", "pub const ENTRY: "],
    );
}

#[test]
fn what_cannot_be_explained_is_reported() {
    let bench = Workbench::new()
        .file("case.toml", "title = \"a case\"\n")
        .file("broken.toml", &MINE.replace("-k*h", "-k*hh"));
    for (arguments, words) in [
        (&["explain", "hu2003-linaer"][..], &["did you mean `hu2003-linear`?"][..]),
        (&["explain", "case.toml"], &["it has no `kind`", "whirl check"]),
        (&["explain", "."], &["is a folder"]),
        (&["explain", "hex8", "--plot", "x.svg"], &["`--plot` draws laws"]),
        (&["explain", "broken.toml"], &["broken.toml:15:", "unknown name `hh`", "^^"]),
        (&["check", "broken.toml"], &["broken.toml:15:", "unknown name `hh`", "^^"]),
    ] {
        let before = bench.listing();
        let outcome = bench.whirl(arguments);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{arguments:?}");
        for word in words {
            assert!(outcome.stderr.contains(word), "`{word}` is not in:\n{}", outcome.stderr);
        }
        assert_eq!(bench.listing(), before);
    }
}

/// No page of a built-in spec holds an error in place of what it shows.
#[test]
fn pages_of_built_in_specs_have_no_errors_in_them() {
    for (.., name) in shipped() {
        let outcome = Workbench::new().whirl(&["explain", &name]);
        assert_eq!(outcome.status, 0, "{name}: {}", outcome.stderr);
        for words in ["error[", "too large"] {
            assert!(!outcome.stdout.contains(words), "{name}: {}", outcome.stdout);
        }
    }
}

#[test]
fn a_case_is_explained_by_check() {
    let outcome = Workbench::new().whirl(&["explain", "hu2003-5"]);
    assert_eq!(outcome.status, 2);
    assert!(outcome.stderr.contains("`whirl check hu2003-5`"), "{}", outcome.stderr);
}
