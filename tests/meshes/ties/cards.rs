//! Equations between pairs of nodes at one place are as merging them, whatever card says so.

use std::fmt::Write;

use super::{Bricks, alike, clean, free, halves, pairs, six_of, tried};

/// ω² of the bar of which coincident nodes are merged.
fn merged(bricks: &Bricks) -> Vec<f64> {
    let text = bricks.inp(["", ""], "");
    let read = tried(&text, "bar.inp", Some(1e-6)).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(read.mesh.nodes().len(), 7 * 9);
    free(&read.mesh, 12)
}

fn equations(bricks: &Bricks) -> String {
    let mut text = "*EQUATION\n".to_owned();
    for (a, b) in pairs(bricks) {
        for k in 1..4 {
            writeln!(text, "2\n{a}, {k}, 3.0, {b}, {k}, -3.0").unwrap();
        }
    }
    text
}

#[test]
fn what_is_tied_node_by_node_is_as_merged() {
    let bricks = halves();
    let known = merged(&bricks);
    six_of(&known);
    let labels =
        |own: Vec<usize>| -> String { own.iter().map(|label| format!("{label},\n")).collect() };
    let (first, second): (Vec<usize>, Vec<usize>) = pairs(&bricks).into_iter().unzip();
    // Sets keep the order of their lines.
    let sets = format!(
        "*NSET, NSET=FIRST, UNSORTED\n{}*NSET, NSET=SECOND, UNSORTED\n{}",
        labels(first),
        labels(second)
    );
    let by_sets: String =
        (1..4).map(|k| format!("*EQUATION\n2\nFIRST, {k}, 1., SECOND, {k}, -1.\n")).collect();
    let of_type = |kind: &str| format!("{sets}*MPC\n{kind}, FIRST, SECOND\n");
    let surfaces = "*SURFACE, NAME=UPPER, TYPE=ELEMENT\nBRICK1, S1\n*SURFACE, NAME=LOWER, TYPE=ELEMENT\nBRICK0, S2\n";
    let tie = format!("{surfaces}*TIE, NAME=SEAM\nUPPER, LOWER\n");
    for cards in
        [equations(&bricks), sets.clone() + &by_sets, of_type("TIE"), of_type("PIN"), tie.clone()]
    {
        let read = tried(&bricks.inp(["", ""], &cards), "bar.inp", None);
        let read = read.unwrap_or_else(|errors| panic!("{cards}: {errors}"));
        let mesh = read.mesh;
        assert_eq!(mesh.nodes().len(), 8 * 9, "nothing is merged");
        // Seams are not accused; all of the surface's other nodes are far from it.
        let warned: Vec<String> = read.warnings.iter().map(ToString::to_string).collect();
        let expected = usize::from(cards == tie);
        assert_eq!(warned.len(), expected, "{warned:?}");
        assert!(
            warned.iter().all(|own| own.contains("18 nodes of UPPER are farther")),
            "{warned:?}"
        );
        assert_eq!(mesh.tie_rows().len(), 27);
        assert_eq!(mesh.parts().iter().max(), Some(&0));
        let own = free(&mesh, 12);
        six_of(&own);
        alike(&own, &known);
    }
    // Without, the halves are two bodies, and the seam is found.
    let loose = tried(&bricks.inp(["", ""], ""), "bar.inp", None).unwrap();
    assert!(loose.warnings[0].to_string().contains("at one place"), "{:?}", loose.warnings);
    assert!(free(&loose.mesh, 12)[11].abs() < 1e-6 * known[6]);
}

#[test]
fn equations_of_bulk_data_are_in_the_systems_of_their_nodes() {
    let bricks = halves();
    let known = merged(&bricks);
    // Components of every second pair are along the axes of a cylinder off the bar.
    let system = "CORD2C,7,,.05,-.02,0.,.05,-.02,1.\n,.1,.3,0.\n";
    let mut cards = system.to_owned();
    for (a, b) in pairs(&bricks) {
        for k in 1..4 {
            writeln!(cards, "MPC,5,{a},{k},2.0,{b},{k},-2.0").unwrap();
        }
    }
    let turned: Vec<usize> = pairs(&bricks).iter().step_by(2).flat_map(|&(a, b)| [a, b]).collect();
    let text = bricks.bdf("", &cards);
    let with_axes: String = text
        .lines()
        .map(|line| {
            let label = line.strip_prefix("GRID,").and_then(|rest| rest.split(',').next());
            let is = label.is_some_and(|own| turned.contains(&own.parse().unwrap()));
            format!("{line}{}\n", if is { ",7" } else { "" })
        })
        .collect();
    for text in [text, with_axes] {
        let own = free(&clean(&text, "bar.bdf"), 12);
        six_of(&own);
        alike(&own, &known);
    }
}

#[test]
fn chains_are_followed_and_what_stands_twice_counts_once() {
    let bricks = halves();
    let known = merged(&bricks);
    // The first pair follows through the second one's nodes and back, in a circle that closes.
    let all = pairs(&bricks);
    let twice = format!("*EQUATION\n2\n{}, 1, 1., {}, 1, -1.\n", all[0].1, all[0].0);
    let mesh = clean(&bricks.inp(["", ""], &(equations(&bricks) + &twice)), "bar.inp");
    alike(&free(&mesh, 12), &known);
}

#[test]
fn part_of_an_equation_turns_with_its_instance() {
    let bricks = halves();
    // The second half may slide along x of the part, but for one node, which is tied askew as well.
    let mut cards = "*EQUATION\n".to_owned();
    for (place, (a, b)) in pairs(&bricks).into_iter().enumerate() {
        for k in if place == 4 { 1..4 } else { 2..4 } {
            writeln!(cards, "2\n{a}, {k}, 1.0, {b}, {k}, -1.0").unwrap();
        }
    }
    let still = free(&clean(&bricks.inp(["", ""], &cards), "bar.inp"), 14);
    six_of(&still);
    let instance = "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n0.3, -0.2, 0.7\n\
                    0., 0., 0., 1., 2., -0.5, 37.\n*END INSTANCE\n*END ASSEMBLY\n";
    let mut text = bricks.inp(["*PART, NAME=P\n", "TIES"], "");
    text = text.replace("TIES", &(cards.clone() + instance));
    let moved = free(&clean(&text, "bar.inp"), 14);
    six_of(&moved);
    alike(&moved, &still);
    // Equations of the assembly do not turn.
    let outside = instance.replace("*END ASSEMBLY", &format!("{cards}*END ASSEMBLY"));
    let text = bricks.inp(["*PART, NAME=P\n", &outside], "");
    let other = free(&clean(&text, "bar.inp"), 14);
    assert!((other[6] / still[6] - 1.0).abs() > 1e-3, "{other:?} {still:?}");
}
