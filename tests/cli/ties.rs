//! Ties of mesh files, as users see them.

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
