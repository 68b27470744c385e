//! Ties of mesh files, as users see them.

use crate::lost_work::{begin_and_kill, resumes};
use crate::sweeps::{column, done, text};
use crate::workbench::Workbench;

const SEAM: &str = "*NODE
1, 0, 0, 0
2, 10, 0, 0
3, 10, 10, 0
4, 0, 10, 0
5, 0, 0, 10
6, 10, 0, 10
7, 10, 10, 10
8, 0, 10, 10
11, 0, 0, 10
12, 10, 0, 10
13, 10, 10, 10
14, 0, 10, 10
15, 0, 0, 20
16, 10, 0, 20
17, 10, 10, 20
18, 0, 10, 20
*ELEMENT, TYPE=C3D8I, ELSET=LOWER
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8I, ELSET=UPPER
2, 11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=TOP
15, 16, 17, 18
*SURFACE, NAME=FOLLOWS, TYPE=NODE
11
12
13
14
*SURFACE, NAME=LEADS, TYPE=ELEMENT
LOWER, S2
*TIE, NAME=SEAM
FOLLOWS, LEADS
*RIGID BODY, REF NODE=15, NSET=TOP
";

#[test]
fn the_ties_of_a_file_are_listed() {
    let bench = Workbench::new().file("seam.inp", SEAM);
    let result = bench.whirl(&["mesh", "seam.inp", "--units", "mm, N, t"]);
    assert_eq!(result.status, 0, "{}", result.stderr);
    for line in [
        "joined by 1 *RIGID BODY: 4 nodes (all of TOP), 6 equations",
        "joined by 1 *TIE: 8 nodes (all of FOLLOWS, LEADS), 12 equations",
    ] {
        assert!(result.stdout.lines().any(|own| own == line), "{}", result.stdout);
    }
    assert_eq!(result.stderr, "", "the seam is joined");
    let bad = bench.file("bad.inp", &SEAM.replace("FOLLOWS, LEADS", "FOLLOWS, LEDS"));
    let refused = bad.whirl(&["mesh", "bad.inp", "--units", "mm, N, t"]);
    assert_eq!(refused.status, 2);
    assert!(
        refused.stderr.contains("LEDS has no faces of cells that nodes could follow"),
        "{}",
        refused.stderr
    );
    assert!(refused.stderr.contains("did you mean LEADS?"), "{}", refused.stderr);
}

/// The post with a material, and with its halves tied, or sharing the nodes of the seam.
fn post(tied: bool) -> String {
    let text = format!(
        "{}*NSET, NSET=BASE\n1, 2, 3, 4\n*MATERIAL, NAME=STEEL\n*ELASTIC\n210e3, 0.3\n*DENSITY\n7.8e-9\n\
         *SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL\n*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL\n",
        SEAM
    );
    if tied {
        return text;
    }
    let (before, after) = text.split_once("*TIE, NAME=SEAM\nFOLLOWS, LEADS\n").expect("the tie");
    let text = [before, after].concat();
    let text = text.replace("2, 11, 12, 13, 14, 15", "2, 5, 6, 7, 8, 15");
    let (before, rest) = text.split_once("11, 0, 0, 10\n").expect("a node");
    let (_, after) = rest.split_once("14, 0, 10, 10\n").expect("a node");
    [before, after].concat().replace("\n11\n12\n13\n14\n", "\n5\n6\n7\n8\n")
}

/// A post on its base, its rigid top on a prop, under its weight and a load.
fn propped(mesh: &str, steps: usize, more: &str) -> String {
    format!(
        "title = \"a post of two halves\"\ngravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n\
         [body.post]\nturns = \"no\"\nmesh = \"{mesh}\"\nunits = \"mm, N, t\"\nmodes = 4\ndamping = \"1e-7 s\"\n\
         held = [\"BASE\"]\n[joint.prop]\nkind = \"bushing\"\nfirst = {{ body = \"post\", sets = \"TOP\" }}\n\
         stiffness = {{ xx = \"1e7 N/m\", yy = \"1e7 N/m\" }}\n\
         [loads.side]\nbody = \"post\"\nsets = \"TOP\"\nforce = [\"0 N\", \"20 N\", \"0 N\"]\n\
         [march]\ntime_step = \"5e-7 s\"\nsteps = {steps}\n{more}"
    )
}

/// Nodes that a tie joins at one place are one node.
#[test]
fn a_tied_body_marches_as_one_that_shares_its_nodes() {
    let still = "[start]\nkind = \"equilibrium\"\n";
    let bench = Workbench::new().file("tied.inp", &post(true)).file("shared.inp", &post(false));
    let bench =
        [("tied", "tied.inp"), ("shared", "shared.inp")].iter().fold(bench, |bench, own| {
            bench
                .file(&format!("{}-rest.toml", own.0), &propped(own.1, 600, ""))
                .file(&format!("{}-still.toml", own.0), &propped(own.1, 600, still))
        });
    let history = |case: &str, column: &str| -> Vec<f64> {
        let folder = format!("of-{case}");
        if !bench.path(&folder).exists() {
            let file = format!("{case}.toml");
            let result = bench.whirl(&["run", &file, "--no-figures", "--out", &folder]);
            assert_eq!(result.status, 0, "{}", result.stderr);
            assert!(!result.stderr.contains("warning"), "{}", result.stderr);
        }
        bench.history(&folder).column(column).to_vec()
    };
    for column in ["RX_prop_N", "RY_prop_N"] {
        let all = |case: &str| history(case, column);
        let (rest, still) = (all("tied-rest"), all("tied-still"));
        let most = rest.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        // Histories have ten digits; the modes of two matrices with the same motions agree to 1e-8.
        for (own, known) in [(&rest, all("shared-rest")), (&still, all("shared-still"))] {
            for (own, known) in own.iter().zip(&known) {
                assert!((own - known).abs() < 1e-7 * most, "{column}: {own} {known}");
            }
        }
        // What starts in equilibrium stays there, and what starts at rest swings about it.
        assert!(
            still.iter().all(|own| (own - still[0]).abs() < 1e-6 * most),
            "{column}: {still:?}"
        );
        assert!(rest.iter().any(|own| (own - still[0]).abs() > 0.5 * still[0].abs()), "{column}");
    }
    let checked = bench.whirl(&["check", "tied-still.toml"]);
    assert_eq!(checked.status, 0, "{}", checked.stderr);
    for line in [
        "post is joined by 1 *RIGID BODY: 4 nodes (all of TOP), 6 equations",
        "post is joined by 1 *TIE: 8 nodes (all of FOLLOWS, LEADS), 12 equations",
    ] {
        assert!(checked.stdout.lines().any(|own| own == line), "{}", checked.stdout);
    }
}

#[cfg(unix)]
#[test]
fn a_run_of_a_tied_body_is_resumed_with_the_same_bytes() {
    let bench = Workbench::new()
        .file("tied.inp", &post(true))
        .file("case.toml", &propped("tied.inp", 100_000, ""));
    begin_and_kill(&bench);
    resumes(&bench);
}

/// Forces of a body that is linear, in equilibrium, are those of its loads.
#[test]
fn a_sweep_of_a_tied_body_has_its_points() {
    let still = "[start]\nkind = \"equilibrium\"\n";
    let study = "title = \"loads\"\ncase = \"case.toml\"\n[vary]\nloads.side.force = [[\"0 N\", \"20 N\", \"0 N\"], [\"0 N\", \"40 N\", \"0 N\"]]\n";
    let bench = Workbench::new()
        .file("tied.inp", &post(true))
        .file("case.toml", &propped("tied.inp", 100, still))
        .file("study.toml", study);
    done(&bench.whirl(&["sweep", "study.toml", "--out", "found"]));
    // The force is a text with commas, which `column` does not know.
    let plain = |found: String, force: &str| {
        found.replace(&format!("\"[\"\"0 N\"\", \"\"{force} N\"\", \"\"0 N\"\"]\""), force)
    };
    let found = plain(plain(text(&bench, "found/table.csv"), "20"), "40");
    let forces: Vec<f64> =
        column(&found, "RY_prop_N.mean").iter().map(|own| own.parse().expect("a number")).collect();
    assert_eq!(forces.len(), 2);
    assert!(forces[0] < -1.0, "{forces:?}");
    // Ten digits of either, and what an equilibrium is found to.
    assert!((forces[1] / forces[0] - 2.0).abs() < 1e-7, "{forces:?}");
}
