//! Which ties count, and what is said of those that do not.

use super::{clean, free, halves, pairs, tried};

fn mpc(set: usize, bricks: &super::Bricks, take: usize) -> String {
    let own = pairs(bricks).into_iter().take(take);
    own.flat_map(|(a, b)| (1..4).map(move |k| format!("MPC,{set},{a},{k},1.,{b},{k},-1.\n")))
        .collect()
}

#[test]
fn case_control_chooses_the_equations() {
    let bricks = halves();
    let cards = mpc(5, &bricks, 9) + &mpc(6, &bricks, 4) + "MPCADD,50,5,6\n";
    let own = |control: &str| tried(&bricks.bdf(control, &cards), "bar.bdf", None);
    let rows = |control: &str| own(control).unwrap().mesh.tie_rows().len();
    assert_eq!(rows("SOL 103\nCEND\nMPC = 6\nBEGIN BULK\n"), 12);
    // What stands in both is in there twice, which changes nothing.
    assert_eq!(rows("SOL 103\nCEND\nMPC = 50\nBEGIN BULK\n"), 39);
    let none = own("SOL 103\nCEND\nBEGIN BULK\n").unwrap();
    assert!(none.mesh.ties().is_empty());
    assert!(none.warnings.iter().any(|own| {
        own.to_string().contains("39 equations left out: the case control chooses no set")
    }));
    let several = own("SOL 103\nCEND\nSUBCASE 1\nMPC = 5\nSUBCASE 2\nMPC = 6\nBEGIN BULK\n");
    assert!(several.unwrap_err().to_string().contains("several sets of MPC: 5, 6"));
    assert!(
        own("").unwrap_err().to_string().contains("several sets of MPC, 5, 6, and no case control")
    );
    let joined = clean(&bricks.bdf("CEND\nMPC=50\nBEGIN BULK\n", &cards), "bar.bdf");
    let once = clean(&bricks.bdf("", &mpc(5, &bricks, 9)), "bar.bdf");
    super::alike(&free(&joined, 12), &free(&once, 12));
}

#[test]
fn ties_that_hold_the_body_are_said() {
    let bricks = halves();
    let all = pairs(&bricks);
    let (a, b) = all[0];
    for (cards, wanted) in [
        (format!("*EQUATION\n1\n{a}, 2, 1.\n"), "*EQUATION of line"),
        (format!("*EQUATION\n2\n{a}, 1, 1., {b}, 1, 1.\n"), "shifts along x"),
        (format!("*EQUATION\n2\n{a}, 1, 1., {}, 1, -1.\n", all[8].1), "turns about"),
    ] {
        let read = tried(&bricks.inp(["", ""], &cards), "bar.inp", None).unwrap();
        let said: Vec<String> = read.warnings.iter().map(ToString::to_string).collect();
        let about = said.iter().find(|own| own.contains("of the body as a whole"));
        assert!(about.is_some_and(|own| own.contains(wanted)), "{said:?}");
    }
}

#[test]
fn what_is_not_read_is_named() {
    let bricks = halves();
    let (a, b) = pairs(&bricks)[0];
    let (c, d) = pairs(&bricks)[1];
    for (cards, wanted) in [
        (format!("*MPC\nSLIDER, {a}, {b}, {c}\n"), "*MPC of type SLIDER ties nodes of cells"),
        ("*EMBEDDED ELEMENT\nALL\n".to_owned(), "*EMBEDDED ELEMENT ties nodes of cells"),
        (format!("*EQUATION\n2\n{a}, 8, 1., {b}, 8, -1.\n"), "a component must be 1 to 6"),
        (format!("*EQUATION\n3\n{a}, 1, 1., {b}, 1, -1.\n"), "the equation has 2 of 3 terms"),
        (
            format!("*EQUATION\n2\n{a}, 1, 1., 7777, 1, -1.\n"),
            "no node and no set of nodes is called 7777",
        ),
        (
            format!(
                "*NSET, NSET=T\n{a}\n*TRANSFORM, NSET=T\n1., 1., 0., -1., 1., 0.\n*EQUATION\n2\n{a}, 1, 1., {b}, 1, -1.\n"
            ),
            "*TRANSFORM turns the axes of nodes that *EQUATION",
        ),
        (
            format!("*EQUATION, REMOVE\n2\n{a}, 1, 1., {b}, 1, -1.\n"),
            "REMOVE of *EQUATION is not read",
        ),
        (format!("*MPC, USER\nBEAM, {a}, {b}\n"), "USER of *MPC is not read"),
        (
            format!(
                "*COUPLING, CONSTRAINT NAME=C, REF NODE={a}, SURFACE=ALL\n*KINEMATIC, SCALE=2\n1, 3\n"
            ),
            "SCALE of *KINEMATIC is not read",
        ),
        (
            format!("*RIGID BODY, REF NODE={a}, REF NODE={b}, NSET=ALL\n"),
            "REF NODE of *RIGID BODY is given twice",
        ),
        (
            "*RIGID BODY, REF NODE=1, NSET=ALL, POSITION=CENTER OF MASS\n".to_owned(),
            "POSITION of *RIGID BODY is not read",
        ),
        (
            "*COUPLING, CONSTRAINT NAME=C, REF NODE=1, SURFACE=ALL\n".to_owned(),
            "has no *KINEMATIC or *DISTRIBUTING",
        ),
    ] {
        let found = tried(&bricks.inp(["", ""], &cards), "bar.inp", None).unwrap_err().to_string();
        assert!(found.contains(wanted), "{found}");
        assert!(found.contains("help:"), "{found}");
    }
    for (cards, wanted) in [
        (format!("RSPLINE,9,.1,{a},{b},123,{c}\n"), "RSPLINE 9 ties nodes of elements"),
        (format!("RBAR,9,{a},{b},1234\n"), "RBAR 9 has 4 independent components"),
        (format!("RROD,9,{a},{b},1\n"), "the nodes of RROD 9 are at one place"),
        (format!("MPC,9,{a},12,1.,{b},1,-1.\n"), "component (field 4 of MPC)"),
        (format!("RBAR,9,{a},7777,123456\n"), "RBAR 9 names node 7777, which is not defined"),
        (format!("RBE1,9,{a},123,{c},12\n,UM,{b},1\n"), "RBE1 9 has 5 independent components"),
    ] {
        let found = tried(&bricks.bdf("", &cards), "bar.bdf", None).unwrap_err().to_string();
        assert!(found.contains(wanted), "{found}");
    }
    // What joins nothing is left out.
    let read = tried(
        &bricks.bdf("", &format!("GRID,900,,1.,1.,1.\nRBAR,9,{d},900,123456\n")),
        "b.bdf",
        None,
    );
    let said = read.unwrap().warnings;
    assert!(
        said.iter().any(|own| own.to_string().contains("no two nodes of solid elements: 1 RBAR")),
        "{said:?}"
    );
}
