//! Bodies with ties, reduced as machines have them: held and retained dofs and means that follow from others.

use std::fmt::Write;

use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::Constraints;
use whirl_solver::mesh::{MeanComponent, Mesh, NodeSetMean};
use whirl_solver::reduced::{BodyKind, Reduced};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::{Bricks, clean, halves, pairs, tried};

/// Quantities of two reductions that are made from other matrices agree to this part.
const ROUNDING: f64 = 1e-8;

pub(crate) fn spec(retained: Vec<Retained>, held: Vec<usize>) -> BodySpec {
    BodySpec {
        retained,
        held,
        modes: 6,
        constraints: Constraints::default(),
        springs: Vec::new(),
        damping: Rayleigh::default(),
        nodes: Vec::new(),
        stiffening: true,
        means: Vec::new(),
        corrections: Vec::new(),
        sections: Vec::new(),
        memory: usize::MAX,
    }
}

fn tied(bricks: &Bricks) -> Mesh {
    let mut cards = "*EQUATION\n".to_owned();
    for (a, b) in pairs(bricks) {
        (1..4).for_each(|k| writeln!(cards, "2\n{a}, {k}, 1., {b}, {k}, -1.").unwrap());
    }
    clean(&bricks.inp(["", ""], &cards), "bar.inp")
}

fn node(mesh: &Mesh, label: usize) -> usize {
    mesh.labels().iter().position(|own| *own == label as u64).unwrap()
}

/// Mean motions of the seam's nodes, as the first half has them, and a dof of its own, retained.
fn retained(mesh: &Mesh, seam: &[usize], corner: usize) -> Vec<Retained> {
    let nodes: Vec<usize> = seam.iter().map(|&label| node(mesh, label)).collect();
    let mean = NodeSetMean::new(mesh, &nodes).unwrap();
    let corner = node(mesh, corner);
    vec![
        Retained::mean(&mean, MeanComponent::Displacement(0), "seam x"),
        Retained::mean(&mean, MeanComponent::Displacement(1), "seam y"),
        Retained::dof(3 * corner + 2, "corner z"),
    ]
}

/// A turning bar with its seam retained and its end held has the tensors of the merged one.
#[test]
fn a_tied_body_is_reduced_as_the_merged_one() {
    let bricks = halves();
    let merged = tried(&bricks.inp(["", ""], ""), "bar.inp", Some(1e-6)).unwrap().mesh;
    let tied = tied(&bricks);
    let base = bricks.at(0, |at| at[2] < 1e-9);
    let (first, second): (Vec<usize>, Vec<usize>) = pairs(&bricks).into_iter().unzip();
    // Labels that follow from others are those of the first half; a merged mesh has these.
    let shaft = |mesh: &Mesh, seam: &[usize], corner: usize| -> Shaft {
        let held = base.iter().flat_map(|&own| (0..3).map(move |i| (own, i)));
        let held = held.map(|(own, i)| 3 * node(mesh, own) + i).collect();
        Shaft::from_mesh(mesh, &spec(retained(mesh, seam, corner), held)).unwrap()
    };
    let known = shaft(&merged, &first, first[4]);
    for (seam, corner) in [(&first, first[4]), (&second, second[4])] {
        let own = shaft(&tied, seam, corner);
        let near = |own: f64, known: f64, scale: f64| {
            assert!((own - known).abs() < ROUNDING * scale, "{own} {known}");
        };
        own.hertz.iter().zip(&known.hertz).for_each(|(own, known)| near(*own, *known, *known));
        near(own.j0, known.j0, known.j0);
        // Modes have either sign; squares of what they have with others have not.
        for (own, known) in [
            (&own.mass, &known.mass),
            (&own.stiffness, &known.stiffness),
            (&own.spin_inertia, &known.spin_inertia),
            (&own.spin_net, &known.spin_net),
        ] {
            let scale = known.data.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
            own.data
                .iter()
                .zip(&known.data)
                .for_each(|(own, known)| near(own.abs(), known.abs(), scale));
        }
    }
}

/// What is held follows from nothing: of a tied pair, either node may be held, or both.
#[test]
fn either_side_of_a_tie_may_be_held() {
    let bricks = halves();
    let tied = tied(&bricks);
    let merged = tried(&bricks.inp(["", ""], ""), "bar.inp", Some(1e-6)).unwrap().mesh;
    let (first, second): (Vec<usize>, Vec<usize>) = pairs(&bricks).into_iter().unzip();
    let hertz = |mesh: &Mesh, labels: &[usize]| -> Vec<f64> {
        let held = labels.iter().flat_map(|&own| (0..3).map(move |i| (own, i)));
        let held = held.map(|(own, i)| 3 * node(mesh, own) + i).collect();
        Support::from_mesh(mesh, &spec(Vec::new(), held)).unwrap().hertz
    };
    let known = hertz(&merged, &first);
    for labels in [first.clone(), second.clone(), [first, second].concat()] {
        for (own, known) in hertz(&tied, &labels).iter().zip(&known) {
            assert!((own / known - 1.0).abs() < ROUNDING, "{own} {known}");
        }
    }
}

/// A rigid end has six motions: a seventh follows from them, and its name is said.
#[test]
fn a_motion_that_follows_from_ties_is_named() {
    let bricks = halves();
    let (first, _): (Vec<usize>, Vec<usize>) = pairs(&bricks).into_iter().unzip();
    let set: String = first.iter().map(|label| format!("{label},\n")).collect();
    let cards = format!("*NSET, NSET=END\n{set}*RIGID BODY, REF NODE={}, NSET=END\n", first[0]);
    let text = bricks.inp(["", ""], &cards);
    let mesh = tried(&text, "bar.inp", Some(1e-6)).unwrap().mesh;
    let dof = |label: usize, i: usize, name: &str| Retained::dof(3 * node(&mesh, label) + i, name);
    let base = bricks.at(0, |at| at[2] < 1e-9);
    let held: Vec<usize> =
        base.iter().flat_map(|&own| (0..3).map(move |i| 3 * (own - 1) + i)).collect();
    let six: Vec<Retained> = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (3, 2)]
        .map(|(place, i)| dof(first[place], i, "one of six"))
        .into();
    let own = |retained: Vec<Retained>| {
        Reduced::new(BodyKind::Support, &mesh, &spec(retained, held.clone()))
    };
    assert!(own(six.clone()).is_ok());
    let seventh = dof(first[5], 2, "SEVENTH z");
    let refused = own([six, vec![seventh]].concat()).unwrap_err().to_string();
    assert!(refused.contains("SEVENTH z follows from what else is retained or held"), "{refused}");
}

/// Two dofs that ties make one: the name of either is said.
#[test]
fn dofs_that_a_tie_makes_one_are_not_both_retained() {
    let bricks = halves();
    let (a, b) = pairs(&bricks)[4];
    let equation = (1..4).map(|k| format!("2\n{a}, {k}, 1., {b}, {k}, -1.\n"));
    let equation = format!("*EQUATION\n{}", equation.collect::<String>());
    let others: String =
        pairs(&bricks).iter().filter(|own| own.0 != a).fold(String::new(), |text, (a, b)| {
            (1..4).fold(text, |text, k| text + &format!("2\n{a}, {k}, 1., {b}, {k}, -1.\n"))
        });
    let base = bricks.at(0, |at| at[2] < 1e-9);
    for cards in [
        format!("{equation}{others}"),
        format!("*MPC\nTIE, {a}, {b}\n*EQUATION\n{others}"),
        // One of them is what follows.
        format!("*MPC\nTIE, {b}, {a}\n*EQUATION\n{others}"),
    ] {
        let mesh = clean(&bricks.inp(["", ""], &cards), "bar.inp");
        let held: Vec<usize> =
            base.iter().flat_map(|&own| (0..3).map(move |i| 3 * (own - 1) + i)).collect();
        let retained = [(a, "LEFT x"), (b, "RIGHT x")]
            .map(|(label, name)| Retained::dof(3 * node(&mesh, label), name));
        let both = spec(retained.to_vec(), held.clone());
        let refused = Reduced::new(BodyKind::Support, &mesh, &both).unwrap_err().to_string();
        let words = "RIGHT x is LEFT x by the ties of the mesh: take one of them out";
        assert!(refused.contains(words), "{refused}");
        for own in retained {
            let one = spec(vec![own], held.clone());
            assert!(Reduced::new(BodyKind::Support, &mesh, &one).is_ok());
        }
    }
}

/// What retained means carry needs no shape of its own, whether the body has ties or not: its answer is rounding.
#[test]
fn a_load_on_retained_means_has_no_answer_of_its_own() {
    let bricks = halves();
    let merged = tried(&bricks.inp(["", ""], ""), "bar.inp", Some(1e-6)).unwrap().mesh;
    let base = bricks.at(0, |at| at[2] < 1e-9);
    let (first, _): (Vec<usize>, Vec<usize>) = pairs(&bricks).into_iter().unzip();
    for mesh in [&tied(&bricks), &merged] {
        let held = base.iter().flat_map(|&own| (0..3).map(move |i| (own, i)));
        let held = held.map(|(own, i)| 3 * node(mesh, own) + i).collect();
        let mut own = spec(retained(mesh, &first, first[4]), held);
        let known = Support::from_mesh(mesh, &own).unwrap().hertz;
        let load = |by: f64, place: usize| {
            own.retained[place].terms.iter().map(move |&(dof, c)| (dof, by * c))
        };
        let carried = [load(0.3, 0).collect(), load(-7.7, 0).chain(load(1.1, 1)).collect()];
        // Half of one of them is carried.
        let half = load(1.0, 0).take(own.retained[0].terms.len() / 2).collect();
        own.corrections = carried.to_vec();
        assert_eq!(Support::from_mesh(mesh, &own).unwrap().hertz, known);
        own.corrections.push(half);
        assert_eq!(Support::from_mesh(mesh, &own).unwrap().hertz.len(), known.len() + 1);
    }
}
