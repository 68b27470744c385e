//! The machine of named.toml, number by number, as a reader of the case would take it.

use std::f64::consts::{PI, TAU};

use whirl_cli::machine_parts;
use whirl_solver::bearing::{Bearing, MotionKind, Sides, SpringLaw};
use whirl_solver::loads::{Action, Frame, Load, Onset, Release, Target, TimeFunction};
use whirl_solver::machine::{Body, MachineParts, Rotation};

use super::{FILES, in_millimetres};
use crate::workbench::Workbench;

/// The bodies in the order of the case, and the ground.
const BODIES: [&str; 10] =
    ["shaft", "frame", "cup", "motor", "ring", "block", "fan", "flywheel", "crank", "ground"];

fn place(body: &str) -> usize {
    BODIES.iter().position(|own| *own == body).expect("a body of the case")
}

fn parts() -> MachineParts {
    let mut bench = Workbench::new();
    for (name, text) in FILES {
        bench = bench.file(name, text);
    }
    bench = bench.file("cup.inp", &in_millimetres(&crate::bodies::meshes::cup([0, 0])));
    let case = bench.path("named.toml");
    machine_parts(case.to_str().expect("a path")).unwrap_or_else(|error| panic!("{error}"))
}

/// Of numbers that were converted from the units of the case.
fn close(found: f64, exact: f64) -> bool {
    (found - exact).abs() <= 1e-12 * exact.abs()
}

fn all_close(found: &[f64], exact: &[f64]) -> bool {
    found.len() == exact.len() && found.iter().zip(exact).all(|(a, b)| close(*a, *b))
}

fn rpm(speed: f64) -> f64 {
    speed * TAU / 60.0
}

#[test]
fn bodies_turn_as_the_case_says() {
    let parts = parts();
    let names: Vec<&str> = parts.bodies.iter().map(Body::name).collect();
    assert_eq!(names, BODIES);
    for (name, body) in BODIES.iter().zip(&parts.bodies) {
        match (*name, body.rotation()) {
            ("shaft" | "cup" | "flywheel" | "crank", Some(Rotation::Free)) => {}
            ("frame" | "ring" | "block" | "ground", None) => {}
            ("motor", Some(Rotation::Prescribed { speed, acceleration })) => {
                assert!(close(*speed, rpm(120.0)) && close(*acceleration, rpm(600.0)), "{speed}");
            }
            ("fan", Some(Rotation::Scheduled(schedule))) => {
                for (t, speed) in [(0.0, 0.0), (5e-3, 300.0), (20e-3, 600.0)] {
                    assert!((schedule.at(t)[1] - rpm(speed)).abs() < 1e-10, "{t}");
                }
            }
            (name, rotation) => panic!("{name}: {rotation:?}"),
        }
    }
    assert_eq!(parts.motion.origin.name, "consistent");
}

#[test]
fn rigid_bodies_have_their_numbers() {
    let parts = parts();
    let body = |name: &str| &parts.bodies[place(name)];
    for (name, mass, z) in
        [("motor", 1.5, -0.1), ("ring", 0.3, 0.0), ("block", 0.5, 0.1), ("fan", 1.0, 0.0)]
    {
        let centre = body(name).centre_of_mass();
        assert!(close(centre.mass, mass) && centre.node.position == [0.0, 0.0, z], "{name}");
    }
    let motor = body("motor").shaft().expect("it turns");
    assert!(close(motor.j0, 2e-3));
    // x, y, two tilts, z.
    let diagonal: Vec<f64> = (0..5).map(|j| motor.mass[(j, j)]).collect();
    assert!(all_close(&diagonal, &[1.5, 1.5, 3e-3, 3e-3, 1.5]), "{diagonal:?}");
    let fan = body("fan").shaft().expect("it turns");
    let diagonal: Vec<f64> = (0..fan.size()).map(|j| fan.mass[(j, j)]).collect();
    assert!(close(fan.j0, 1e-3) && all_close(&diagonal, &[1.0, 1.0, 2e-3, 2e-3]), "{diagonal:?}");
    let block = body("block").support().expect("it stands");
    assert!(all_close(&block.stiffness, &[1e6 / 0.5, 2e6 / 0.5]), "{:?}", block.stiffness);
    assert!(all_close(&block.damping, &[300.0 / 0.5, 200.0 / 0.5]), "{:?}", block.damping);
    let frame = body("frame").support().expect("it stands");
    let damping: Vec<f64> = frame.stiffness.iter().map(|square| 60.0 + 3e-5 * square).collect();
    assert!(all_close(&frame.damping, &damping), "{:?}", frame.damping);
}

/// A disc, an added mass and an unbalance on the shaft, each at its own radius and angle.
#[test]
fn a_shaft_carries_what_the_case_says() {
    let parts = parts();
    let shaft = parts.bodies[place("shaft")].shaft().expect("it turns");
    let ([disc, added, unbalance], [radius, arm]) = ([0.4, 3e-3, 0.2e-3], [9e-3, 15e-3]);
    // The mesh has the area of the circle's octagon with its radius of gyration.
    let corner = 0.01 * f64::sqrt(0.25 / 0.2256);
    let area = 4.0 * corner * corner * (TAU / 8.0).sin();
    let mesh = 7860.0 * area * 0.2;
    let mass = shaft.centre_of_mass.mass;
    assert!((mass / (mesh + disc + added) - 1.0).abs() < 1e-3, "{mass} {mesh}");
    let angle = |degrees: f64| [degrees.to_radians().cos(), degrees.to_radians().sin()];
    let moment =
        [0, 1].map(|axis| added * radius * angle(75.0)[axis] + unbalance * arm * angle(40.0)[axis]);
    // The mesh itself is balanced, to the rounding of its sums.
    for (axis, moment) in moment.into_iter().enumerate() {
        let found = mass * shaft.centre_of_mass.node.position[axis];
        assert!((found - moment).abs() < 1e-10 * radius, "{found} for {moment}");
    }
    // I_p of the disc and m r² beside the mesh's own.
    let own = shaft.j0 - 3e-4 - added * radius * radius;
    assert!((own / (0.5 * mesh * 0.01 * 0.01) - 1.0).abs() < 0.02, "{own}");
}

/// What a law gives at these inputs, in the order of its outputs.
fn values(law: &dyn SpringLaw, at: &[(&str, f64)]) -> Vec<f64> {
    let inputs: Vec<f64> = law
        .inputs()
        .iter()
        .map(|name| at.iter().find(|(own, _)| own == name).map_or(0.0, |(_, value)| *value))
        .collect();
    let rows = 1 + inputs.len();
    let mut outputs = vec![0.0; rows * law.outputs().len()];
    law.evaluate(1, &inputs, &mut outputs, &mut vec![0.0; law.workspace()]);
    outputs.into_iter().step_by(rows).collect()
}

/// F = −K (x, y) − C (ẋ, ẏ) of the four coefficients of each.
fn linear(stiffness: [f64; 4], damping: [f64; 4]) -> [f64; 2] {
    let of = |[xx, xy, yx, yy]: [f64; 4], [x, y]: [f64; 2]| [xx * x + xy * y, yx * x + yy * y];
    let (k, c) = (of(stiffness, MOVED), of(damping, RATE));
    [0, 1].map(|axis| -k[axis] - c[axis])
}

const MOVED: [f64; 2] = [3e-6, -7e-6];
const RATE: [f64; 2] = [2e-3, 5e-3];
const PLANE: [(&str, f64); 4] =
    [("e_x", MOVED[0]), ("e_y", MOVED[1]), ("e_x_dot", RATE[0]), ("e_y_dot", RATE[1])];

#[test]
fn joints_stand_where_the_case_says() {
    let parts = parts();
    let names = [
        "left",
        "right",
        "cup-near",
        "cup-far",
        "seal",
        "near",
        "outer",
        "motor-far",
        "hub",
        "fan-left",
        "fan-right",
        "pad",
        "guard",
        "flywheel-near",
        "flywheel-far",
        "crank-near",
        "crank-far",
    ];
    let labels: Vec<&str> =
        parts.bearings.iter().map(|own| own.label.as_deref().expect("a label")).collect();
    assert_eq!(labels, names.map(|name| format!("_{name}")));
    let joint = |name: &str| -> &Bearing {
        &parts.bearings[names.iter().position(|own| *own == name).expect("a joint")]
    };
    for (name, sides) in [
        ("left", ["shaft", "frame"]),
        ("right", ["shaft", "frame"]),
        ("cup-near", ["cup", "ground"]),
        ("seal", ["shaft", "frame"]),
        ("near", ["motor", "ring"]),
        ("outer", ["ring", "block"]),
        ("motor-far", ["motor", "ground"]),
        ("hub", ["motor", "shaft"]),
        ("fan-right", ["fan", "ground"]),
        ("pad", ["block", "cup"]),
        ("guard", ["block", "ground"]),
        ("flywheel-far", ["flywheel", "ground"]),
        ("crank-near", ["crank", "ground"]),
    ] {
        assert_eq!(joint(name).sides.bodies, sides.map(place), "{name}");
    }
    let Sides { run_out, offset, apart, .. } = &joint("left").sides;
    assert!(all_close(run_out.as_flattened(), &[2e-6, -1e-6, 2e-6, -1e-6, 2e-6, -1e-6]));
    assert!(all_close(offset.as_flattened(), &[1e-6, 0.0, 2e-6, 1e-6, 3e-6, 2e-6]), "{offset:?}");
    assert_eq!(*apart, [0.0; 2]);
    for (name, clearance, radius) in [
        ("left", 50e-6, Some(10e-3)),
        ("seal", 60e-6, None),
        ("near", 80e-6, Some(15e-3)),
        ("pad", 100e-6, Some(9.9e-3)),
        ("guard", 5e-6, None),
    ] {
        let own = joint(name);
        assert!(close(own.clearance, clearance), "{name}: {}", own.clearance);
        if let Some(radius) = radius {
            assert!(own.journal_radius.is_some_and(|own| close(own, radius)), "{name}");
        }
    }
    let counts = |name: &str| (joint(name).stations.len(), joint(name).angles.len());
    assert_eq!((counts("left"), counts("seal")), ((2, 12), (3, 8)));
    // From z = 24 to 36 mm: 28 and 32 mm.
    assert!((joint("left").stations[0] - 1.0 / 3.0).abs() < 1e-9);
    assert!((joint("left").stations[1] - 2.0 / 3.0).abs() < 1e-9);
    assert!(close(joint("guard").angles[0], PI));
    assert!(joint("left").sides.surface.is_some() && joint("seal").sides.surface.is_none());
    let [journal, bore] = joint("hub").sides.sections;
    assert_eq!((journal, bore), (None, None));
}

#[test]
fn laws_have_the_values_of_the_case() {
    let parts = parts();
    let joint = |name: &str| -> &Bearing {
        let label = format!("_{name}");
        let found = parts.bearings.iter().find(|own| own.label.as_ref() == Some(&label));
        found.expect("a joint")
    };
    let law = |place: usize| -> &dyn SpringLaw { parts.laws[place].as_ref() };
    let own = |name: &str| law(joint(name).law);
    let near = |found: &[f64], exact: &[f64], what: &str| {
        assert!(
            found.iter().zip(exact).all(|(a, b)| (a - b).abs() <= 1e-12 * b.abs().max(1e-6)),
            "{what}: {found:?} for {exact:?}"
        );
    };
    for (name, stiffness, damping) in [
        ("right", [1e6, 1e4, -1e4, 2e6], [500.0, 1.0, 2.0, 400.0]),
        ("cup-near", [1e6, 0.0, 0.0, 2e6], [500.0, 0.0, 0.0, 400.0]),
        ("outer", [1e6, 0.0, 0.0, 2e6], [0.0; 4]),
        ("crank-far", [1e7, 0.0, 0.0, 2e7], [0.0; 4]),
    ] {
        near(&values(own(name), &PLANE), &linear(stiffness, damping), name);
    }
    let others = &joint("motor-far").others;
    assert_eq!(
        others.iter().map(|own| own.kind).collect::<Vec<_>>(),
        [MotionKind::Tilts, MotionKind::Along]
    );
    let tilts = linear([300.0, 20.0, -10.0, 400.0], [0.3, 0.02, -0.01, 0.4]);
    near(&values(law(others[0].law), &PLANE), &tilts, "tilts");
    let along = linear([4e6, 0.0, 0.0, 0.0], [250.0, 0.0, 0.0, 0.0]);
    near(&values(law(others[1].law), &PLANE), &along, "along z");
    // Coefficients over the speed, at that of the second row.
    let mut at = PLANE.to_vec();
    at.push(("omega", rpm(1000.0)));
    let row = linear([9e5, 2e4, -3e4, 1.5e6], [250.0, 10.0, 20.0, 180.0]);
    near(&values(own("fan-right"), &at), &row, "fan-right");
    let hub = values(own("hub"), &[("theta", 0.01), ("omega", 3.0)]);
    near(&hub, &[0.0, 0.0, -20.0 * 0.01 - 0.01 * 3.0], "hub");
    // Q = k |h|, T = −μ Q tanh(v/v_0) with 10 mm/s.
    let rub = values(own("left"), &[("h", -2e-6), ("v_t", 1.0)]);
    near(&rub, &[2.0, -0.2 * 2.0], "left");
}

/// The loads on a body that the case names, of which gravity makes none.
fn on<'p>(parts: &'p MachineParts, body: &str) -> Vec<&'p Load> {
    let weight = |load: &&Load| match &load.action {
        Action::Force { force: [x, ..], .. } => {
            let mass = parts.bodies[load.body].centre_of_mass().mass;
            load.time_function == TimeFunction::Constant && close(*x, -9.81 * mass)
        }
        Action::Couple { .. } => false,
    };
    let own = parts.loads.iter().filter(|load| load.body == place(body));
    own.filter(|load| !weight(load)).collect()
}

fn force(load: &Load) -> ([f64; 3], [f64; 3]) {
    match &load.action {
        Action::Force { node, force } => (*force, node.position),
        Action::Couple { .. } => panic!("a couple"),
    }
}

#[test]
fn loads_and_drives_are_those_of_the_case() {
    let parts = parts();
    // Every body but the ground has its weight, along −x.
    let weights = parts.loads.len() - BODIES.iter().map(|own| on(&parts, own).len()).sum::<usize>();
    assert_eq!(weights, BODIES.len() - 1);
    let [push, gas] = on(&parts, "shaft")[..] else { panic!("two loads") };
    let middle = [0.0, 0.0, 0.1];
    assert_eq!(force(push), ([0.0, 40.0, 0.0], middle));
    assert_eq!((push.onset, push.frame), (Onset::Start, Frame::Space));
    match push.time_function {
        TimeFunction::Sine { frequency, phase } => {
            assert!(close(frequency, 50.0) && close(phase, PI / 6.0));
        }
        _ => panic!("{push:?}"),
    }
    let (along, at) = force(gas);
    assert!((at[2] - 0.1).abs() < 1e-9 && at[0].hypot(at[1]) < 1e-9, "{at:?}");
    assert_eq!((along, gas.onset), ([1.0, 0.0, 0.0], Onset::Step(1e-3)));
    match &gas.time_function {
        TimeFunction::OverAngle { body, curve } => {
            assert_eq!(*body, place("fan"));
            assert!((curve.value(TAU) - 194.521).abs() < 1e-9, "{}", curve.value(TAU));
        }
        other => panic!("{other:?}"),
    }
    let [pull] = on(&parts, "block")[..] else { panic!("one load") };
    assert_eq!(force(pull), ([-20.0, 0.0, 0.0], middle));
    let [shake, twist] = on(&parts, "fan")[..] else { panic!("two loads") };
    assert_eq!(force(shake).0, [3.0, -2.0, 0.0]);
    assert_eq!((shake.onset, shake.frame), (Onset::Ramp(0.0, 2e-3), Frame::Body));
    let order = TimeFunction::Order { body: place("fan"), order: 1.5, phase: 0.0 };
    assert_eq!(shake.time_function, order);
    match &twist.action {
        Action::Couple { couple, .. } => assert_eq!(*couple, [0.1, 0.2, 0.0]),
        Action::Force { .. } => panic!("{twist:?}"),
    }
    let [top, bottom] = on(&parts, "cup")[..] else { panic!("two loads") };
    let ((up, at), (down, below)) = (force(top), force(bottom));
    let arm = at[0] - below[0];
    assert!(close(up[1] * arm, 2.0) && up[1] == -down[1] && up[0] == 0.0, "{up:?} {down:?}");
    let target = match top.time_function {
        TimeFunction::UntilSpeed(target) => target,
        _ => panic!("{top:?}"),
    };
    let Target { speed, from_above, release } = target;
    assert!(close(speed, rpm(500.0)) && !from_above && release == Release::Located);
    assert_eq!((top.frame, bottom.frame), (Frame::Body, Frame::Body));
}
