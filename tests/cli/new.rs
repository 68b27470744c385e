//! `whirl new`: files to start from that are right as they stand.

use std::fs;

use crate::workbench::Workbench;

#[test]
fn what_is_new_passes_the_check() {
    let bench = Workbench::new();
    for (kind, name, words) in [
        ("law", "my-law", &["law my-law: ", "a law of a spring", "no jump"][..]),
        ("element", "my-hex_8", &["element my-hex_8: ", "for all 64 pairs"]),
        ("case", "my-case", &["my-case: ", "226 active coordinates", "law hu2003-nonlinear"]),
    ] {
        let made = bench.whirl(&["new", kind, name]);
        assert_eq!((made.status, made.stderr.as_str()), (0, ""), "{kind}");
        let file = format!("{name}.toml");
        assert!(made.stdout.starts_with(&format!("{file}\n")), "{}", made.stdout);
        let checked = bench.whirl(&["check", &file]);
        assert_eq!(checked.status, 0, "{}", checked.stderr);
        for word in words {
            assert!(checked.stdout.contains(word), "`{word}` is not in:\n{}", checked.stdout);
        }
    }
    assert_eq!(bench.listing(), ["my-case.toml", "my-hex_8.toml", "my-law.toml"]);
}

#[test]
fn a_new_law_serves_a_new_case() {
    let bench = Workbench::new();
    for (kind, name) in [("law", "mine"), ("case", "run")] {
        assert_eq!(bench.whirl(&["new", kind, name]).status, 0);
    }
    let case = fs::read_to_string(bench.path("run.toml")).expect("a case");
    let case = case.replace("law = \"hu2003-nonlinear\"", "law = \"mine.toml\"");
    fs::write(bench.path("run.toml"), case.replace("\"0.1 s\"", "\"1e-3 s\"")).expect("written");
    let outcome = bench.whirl(&["run", "run.toml", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(bench.path("results/run/history.csv").is_file());
}

/// Every remedy that the comments name is one that the reader knows: each is taken out of its comment and
/// must then be accepted, or refused for another reason than its key.
#[test]
fn the_remedies_in_the_comments_are_keys_of_the_language() {
    let bench = Workbench::new();
    assert_eq!(bench.whirl(&["new", "law", "mine"]).status, 0);
    let text = fs::read_to_string(bench.path("mine.toml")).expect("a law");
    let (_, output) = text.split_once("[outputs.Q]").expect("an output");
    let comments = output.lines().filter_map(|line| line.strip_prefix("# "));
    let remedies: Vec<&str> = comments.filter(|line| line.contains(" = \"")).collect();
    assert!(remedies.len() >= 3, "{remedies:?}");
    for remedy in remedies {
        let end = remedy.rfind('"').expect("a string") + 1;
        fs::write(bench.path("with.toml"), format!("{text}{}\n", &remedy[..end])).expect("written");
        let outcome = bench.whirl(&["check", "with.toml"]);
        assert!(!outcome.stderr.contains("unknown key"), "{remedy}: {}", outcome.stderr);
        assert!(!outcome.stderr.contains("cannot be"), "{remedy}: {}", outcome.stderr);
    }
}

#[test]
fn nothing_is_written_over_and_bad_names_are_refused() {
    let bench = Workbench::new().file("mine.toml", "mine");
    let outcome = bench.whirl(&["new", "law", "mine"]);
    assert_eq!(outcome.status, 2);
    assert!(outcome.stderr.contains("already exists"), "{}", outcome.stderr);
    assert_eq!(fs::read_to_string(bench.path("mine.toml")).expect("a file"), "mine");
    for (name, words) in [
        ("../mine", "`../mine` cannot be the name"),
        ("-x", "unexpected argument"),
        ("other.toml", "leave the ending out: `other`"),
        ("", "cannot be the name"),
    ] {
        let outcome = bench.whirl(&["new", "case", name]);
        assert_eq!(outcome.status, 2, "{name}");
        assert!(outcome.stderr.contains(words), "{}", outcome.stderr);
    }
    let outcome = bench.whirl(&["new", "element", "mine", "--dir", "mine.toml/below"]);
    assert_eq!(outcome.status, 2);
    assert_eq!(bench.listing(), ["mine.toml"]);
    let outcome = bench.whirl(&["new", "element", "mine", "--dir", "a/b"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(bench.path("a/b/mine.toml").is_file());
}

/// Each built-in case can be begun with, is checked where it lies, and is what it was.
#[test]
fn a_case_like_a_built_in_one_is_it() {
    let bench = Workbench::new();
    for (like, file) in [("crank", "mine.toml"), ("annular-rub", "annular-rub.toml")] {
        let name = file.trim_end_matches(".toml");
        let named = ["new", "case", name, "--like", like];
        let arguments =
            if name == like { vec!["new", "case", "--like", like] } else { named.to_vec() };
        let made = bench.whirl(&arguments);
        assert_eq!((made.status, made.stderr.as_str()), (0, ""), "{like}");
        assert!(made.stdout.starts_with(&format!("{file}\n")), "{}", made.stdout);
        let [own, built_in] = [file, like].map(|case| bench.whirl(&["check", case]));
        assert_eq!(own.status, 0, "{}", own.stderr);
        let without_name = |text: &str, name: &str| text.replacen(name, "", 1);
        assert_eq!(without_name(&own.stdout, name), without_name(&built_in.stdout, like));
    }
    let refused = bench.whirl(&["new", "case", "other", "--like", "turbocharge"]);
    assert_eq!(refused.status, 2);
    assert!(
        refused.stderr.contains("there is no built-in case `turbocharge`"),
        "{}",
        refused.stderr
    );
    assert!(refused.stderr.contains("`turbocharger`"), "{}", refused.stderr);
    let law = bench.whirl(&["new", "law", "other", "--like", "crank"]);
    assert_eq!(law.status, 2);
    assert_eq!(bench.listing(), ["annular-rub.toml", "mine.toml"]);
}
