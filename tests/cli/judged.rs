//! Steps are judged by the machine as it is while it runs, and every joint by what flows through it and the bodies at it.

use serde_json::Value;

use crate::workbench::Workbench;

/// Runs a case with a table of its own, and gives its summary.
fn run(text: &str, table: &str) -> Value {
    let bench = Workbench::new().file("case.toml", text).file("table.csv", table);
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    bench.summary("out")
}

fn measure(summary: &Value, name: &str) -> f64 {
    summary["verdict"]["measures"][name].as_f64().expect("a number")
}

/// A rigid rotor in two films that begin without stiffness, or in equilibrium.
fn in_films(start: &str, march: &str) -> String {
    let joint = |name: &str, z: &str| {
        format!(
            "[joint.{name}]\nkind = \"bearing\"\njournal = {{ body = \"rotor\", z = \"{z}\" }}\nlaw = \"ocvirk\"\n\
             parameters = {{ mu = \"20 mPa*s\" }}\nradial_clearance = \"150 um\"\njournal_radius = \"30 mm\"\n\
             length = \"30 mm\"\n"
        )
    };
    format!(
        "title = \"a rotor in films\"\ngravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n\
         [body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nacceleration = \"0 rpm/s\"\nmass = \"60 kg\"\n\
         polar_inertia = \"0.3 kg*m^2\"\ntransverse_inertia = \"2.5 kg*m^2\"\nz = \"300 mm\"\n\
         unbalance.disc = {{ mass = \"1 g\", radius = \"50 mm\", z = \"300 mm\" }}\n{}{}\
         [start]\nkind = \"{start}\"\n[march]\n{march}\n",
        joint("left", "0 mm"),
        joint("right", "600 mm")
    )
}

/// The weight of a rotor is constant in space, so that its deflection turns in the frame in which it is integrated: in twelve
/// steps a revolution with a local error of (ΩΔt)³/12 = 1.3 %, however the run begins and whoever chooses the steps.
#[test]
fn films_without_stiffness_at_the_start_are_judged_in_the_run() {
    for start in ["rest", "equilibrium"] {
        let summary = run(&in_films(start, "time_step = \"1.7e-3 s\"\nduration = \"2 s\""), "");
        let error = measure(&summary, "local_error");
        // The sag is the most of what moves; whirl and the fall from the centre add a little, and classes round up by 5 %.
        assert!((0.9..1.3).contains(&(error / (0.534_f64.powi(3) / 12.0))), "{start}: {error}");
        assert_eq!(summary["verdict"]["sound"], false, "{start}");
    }
    let chosen = "time_step = \"auto\"\noutput_step = \"1.7e-3 s\"\nduration = \"0.5 s\"";
    let summary = run(&in_films("rest", chosen), "");
    let error = measure(&summary, "local_error");
    // At most what a part may have by the tolerance, and not far below it.
    assert!((1e-6..1e-4).contains(&error), "{error}");
}

/// What stands where nothing holds it, or flies, is integrated exactly: no error, and nothing to be found.
#[test]
fn a_body_on_which_nothing_acts_is_sound() {
    for load in ["", "[loads.l]\nbody = \"a\"\nforce = \"1 N\"\n"] {
        let summary = run(
            &format!(
                "title = \"a free body\"\n[body.a]\nturns = \"no\"\nmass = \"1 kg\"\n\
                 [joint.c]\nkind = \"bearing\"\njournal = {{ body = \"a\" }}\nlaw = \"gap-linear-1e6\"\nsprings = 24\n\
                 radial_clearance = \"2 mm\"\njournal_radius = \"20 mm\"\n{load}\
                 [march]\ntime_step = \"1e-4 s\"\nduration = \"0.05 s\"\n"
            ),
            "",
        );
        let found = &summary["verdict"];
        assert_eq!(
            (&found["sound"], measure(&summary, "local_error")),
            (&true.into(), 0.0),
            "{found}"
        );
    }
}

/// A ball of 0.1 kg that bounces in a clearance, in too long steps; another body is shaken beside it.
fn bouncing(shaken: &str, bore: &str) -> Value {
    let text = format!(
        "title = \"a ball\"\ngravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n\
         [body.heavy]\nturns = \"no\"\nmass = \"1000 kg\"\nstiffness = {{ x = \"4e7 N/m\", y = \"4e7 N/m\" }}\n\
         damping = {{ x = \"1e5 N*s/m\", y = \"1e5 N*s/m\" }}\n[body.ball]\nturns = \"no\"\nmass = \"0.1 kg\"\n\
         [joint.c]\nkind = \"bearing\"\njournal = {{ body = \"ball\" }}\n{bore}law = \"gap-linear-1e6\"\nsprings = 24\n\
         radial_clearance = \"2 mm\"\njournal_radius = \"20 mm\"\n\
         [loads.s]\nbody = \"heavy\"\nforce = \"{shaken}\"\nfrequency = \"30 Hz\"\n\
         [march]\ntime_step = \"4e-4 s\"\nduration = \"2 s\"\n"
    );
    run(&text, "")
}

#[test]
fn what_is_loaded_elsewhere_hides_no_bad_contact() {
    let judged = |shaken: &str, bore: &str| {
        let summary = bouncing(shaken, bore);
        let found = summary["verdict"]["findings"].to_string();
        assert_eq!(summary["verdict"]["sound"], false, "{shaken}");
        assert!(found.contains("energy created") && found.contains("(at joint c)"), "{found}");
        // Ten bounces make so much that the ball rises above where it was let go.
        assert!(measure(&summary, "energy_made_share") > 0.2, "{shaken}: {found}");
    };
    for shaken in ["0.001 N", "1e5 N", "1e7 N"] {
        judged(shaken, "");
    }
    // Nor does what the other body at the contact has of its own.
    judged("1e5 N", "bore = { body = \"heavy\" }\n");
}

/// A rotor on a stiff table of couple over speed, at the speed where it is none: the speed is known to rounding, and the couple no
/// better than that. No step is cut for it.
#[test]
fn a_balanced_motor_is_solved_in_whole_steps() {
    let text = "title = \"a motor with slip\"\n[body.r]\nturns = \"free\"\ninitial_speed = \"3000 rpm\"\nmass = \"1 kg\"\n\
        polar_inertia = \"0.001 kg*m^2\"\n[joint.b]\nkind = \"bushing\"\nfirst = { body = \"r\" }\n\
        stiffness = { xx = \"1e6 N/m\", yy = \"1e6 N/m\" }\ndamping = { xx = \"1e2 N*s/m\", yy = \"1e2 N*s/m\" }\n\
        [drives.d]\nbody = \"r\"\ntable = \"table.csv\"\n[march]\ntime_step = \"1e-3 s\"\nduration = \"1 s\"\n";
    for slope in [10.0, 1e3, 1e6] {
        let table = format!("speed [rpm], couple [N*m]\n2900,{slope}\n3100,-{slope}\n");
        let summary = run(text, &table);
        let march = &summary["march"];
        assert_eq!(march["halved_steps"], 0, "{slope}: {march}");
        assert!(march["iterations"].as_u64().expect("a count") < 4000, "{slope}: {march}");
    }
}

/// Two shafts that turn with one speed in a coupling that holds nothing, one of them widened by its spin: what is left of the
/// angle between them is rounding of both angles, and no couple can come closer to balance than that.
fn idly_coupled(held: &str) -> String {
    let body = |name: &str, own: &str| {
        format!("[body.{name}]\nturns = \"free\"\ninitial_speed = \"1000 rpm\"\n{own}")
    };
    let bushing = |name: &str, first: &str| {
        format!(
            "[joint.{name}]\nkind = \"bushing\"\nfirst = {first}\n\
             {held}damping = {{ xx = \"1e3 N*s/m\", yy = \"1e3 N*s/m\" }}\n"
        )
    };
    [
        "title = \"an idle coupling\"\n[material.steel]\nyoungs_modulus = \"200 GPa\"\npoissons_ratio = 0.3\n\
         density = \"7860 kg/m^3\"\n"
            .to_owned(),
        body(
            "a",
            "material = \"steel\"\nmodes = 12\naxial_restraint = \"JOURNAL1_MIDDLE\"\n[body.a.dimensions]\n\
             length = \"400 mm\"\ndiameter = \"20 mm\"\nsupports = [\"50 mm\", \"200 mm\", \"350 mm\"]\n\
             support_length = \"20 mm\"\n[body.a.sets.END]\nplane = \"400 mm\"\n",
        ),
        body("w", "mass = \"1 kg\"\npolar_inertia = \"2e-4 kg*m^2\"\n"),
        "[joint.c]\nkind = \"coupling\"\nfirst = { body = \"a\", sets = \"END\" }\n\
         second = { body = \"w\" }\nstiffness = \"500 N*m/rad\"\n"
            .to_owned(),
        bushing("b1", "{ body = \"a\", sets = \"JOURNAL1_MIDDLE\" }"),
        bushing("b2", "{ body = \"a\", sets = \"JOURNAL3_MIDDLE\" }"),
        bushing("b3", "{ body = \"w\" }"),
    ]
    .concat()
}

/// Steps of every length.
#[test]
fn an_idle_coupling_is_solved_to_the_rounding_of_its_angles() {
    let machine = idly_coupled("");
    for step in [
        "time_step = \"auto\"\noutput_step = \"1e-4 s\"",
        "time_step = \"1e-6 s\"",
        "time_step = \"1e-4 s\"",
    ] {
        let text = format!("{machine}[march]\n{step}\nduration = \"2e-3 s\"\n");
        let summary = run(&text, "");
        assert_eq!(summary["march"]["halved_steps"], 0, "{step}: {}", summary["march"]);
    }
}

/// The equilibrium from which steps start is found to no more than that; a body that only dampers hold has none.
#[test]
fn an_idle_coupling_starts_in_equilibrium_to_the_rounding_of_its_angles() {
    const START: &str = "[start]\nkind = \"equilibrium\"\n[march]\nduration = \"2e-3 s\"\n";
    let held = "stiffness = { xx = \"1e7 N/m\", yy = \"1e7 N/m\" }\n";
    for step in ["time_step = \"auto\"\noutput_step = \"1e-4 s\"\n", "time_step = \"2e-6 s\"\n"] {
        let summary = run(&format!("{}{START}{step}", idly_coupled(held)), "");
        assert_eq!(summary["march"]["halved_steps"], 0, "{step}: {}", summary["march"]);
    }
    let text = format!("{}{START}time_step = \"2e-6 s\"\n", idly_coupled(""));
    let bench = Workbench::new().file("case.toml", &text);
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(
        outcome.stderr.contains("is not determined: nothing holds the w"),
        "{}",
        outcome.stderr
    );
}

/// A disc on a soft tilting spring at 60 000 rpm, under a couple that is fixed in space: -1 N·m in its spring. In long steps it
/// starts at another tilt, at which the discrete motion stands still.
fn tilted(march: &str) -> String {
    format!(
        "title = \"a couple on a fast disc\"\n[body.p]\nturns = \"prescribed\"\nspeed = \"60000 rpm\"\nmass = \"1 kg\"\n\
         polar_inertia = \"0.038 kg*m^2\"\ntransverse_inertia = \"0.02 kg*m^2\"\nz = \"0 mm\"\n[joint.k]\n\
         kind = \"bushing\"\nfirst = {{ body = \"p\", z = \"0 mm\" }}\nstiffness = {{ xx = \"4e5 N/m\", yy = \"4e5 N/m\" }}\n\
         tilting_stiffness = {{ xx = \"7888 N*m/rad\", yy = \"7888 N*m/rad\" }}\n[loads.m]\nbody = \"p\"\n\
         couple = [\"0 N*m\", \"1 N*m\", \"0 N*m\"]\n[start]\nkind = \"equilibrium\"\n[march]\n{march}\n"
    )
}

/// A rotor that turns ten times as fast as it whirls: on a round spring, under a force along x, it must stay on x.
fn whirling(march: &str) -> String {
    format!(
        "title = \"slow whirl of a fast rotor\"\n[body.p]\nturns = \"prescribed\"\nspeed = \"60000 rpm\"\nmass = \"1 kg\"\n\
         polar_inertia = \"1e-3 kg*m^2\"\n[joint.k]\nkind = \"bushing\"\nfirst = {{ body = \"p\" }}\n\
         stiffness = {{ xx = \"394784 N/m\", yy = \"394784 N/m\" }}\n[loads.f]\nbody = \"p\"\nforce = \"1 N\"\n\
         [march]\n{march}\nduration = \"0.03 s\"\n"
    )
}

#[test]
fn false_inertia_of_fast_rotors_is_not_sound() {
    // Steps a revolution, and whether the result is right to a few percent.
    for (steps, sound) in [(24, false), (72, false), (720, true)] {
        let step = format!("time_step = \"{:e} s\"\nsteps = 500", 1e-3 / f64::from(steps));
        let summary = run(&tilted(&step), "");
        assert_eq!(summary["verdict"]["sound"], sound, "{steps}: {summary:#}");
    }
    for (steps, sound) in [(36, false), (144, true)] {
        let step = format!("time_step = \"{:e} s\"", 1e-3 / f64::from(steps));
        let summary = run(&whirling(&step), "");
        assert_eq!(summary["verdict"]["sound"], sound, "{steps}");
        // 2 Ω (ΩΔt)²/12 over ω, of the largest force.
        let exact = 2.0 * 10.0 * (std::f64::consts::TAU / f64::from(steps)).powi(2) / 12.0;
        let error = measure(&summary, "inertia_error");
        assert!((0.4..1.1).contains(&(error / exact)), "{steps}: {error} for {exact}");
    }
}

/// A ring floats in equilibrium between two films, whose forces on it cancel: its inertia is held against what flows through it, or
/// against what is not there.
#[test]
fn a_ring_between_two_films_is_judged_by_what_flows_through_it() {
    let film = |name: &str, bodies: &str, clearance: f64, radius: f64| {
        format!(
            "[joint.{name}]\nkind = \"bearing\"\n{bodies}\nlaw = \"ocvirk\"\nradial_clearance = \"{clearance} um\"\n\
             journal_radius = \"{radius} mm\"\nlength = \"20 mm\"\n"
        )
    };
    let case = format!(
        "title = \"a floating ring\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"7500 rpm\"\nmass = \"10 kg\"\n\
         polar_inertia = \"0.02 kg*m^2\"\n[body.ring]\nturns = \"free\"\nmass = \"0.4 kg\"\npolar_inertia = \"3e-4 kg*m^2\"\n{}{}\
         [loads.w]\nbody = \"rotor\"\nforce = [\"-98.1 N\", \"30 N\", \"0 N\"]\n[start]\nkind = \"equilibrium\"\n\
         [march]\ntime_step = \"2e-5 s\"\nduration = \"0.05 s\"\n",
        film("inner", "journal = { body = \"rotor\" }\nbore = { body = \"ring\" }", 50.0, 25.0),
        film("outer", "journal = { body = \"ring\" }", 80.0, 32.0),
    );
    let summary = run(&case, "");
    assert_eq!(summary["verdict"]["sound"], true, "{summary:#}");
    let error = measure(&summary, "inertia_error");
    assert!(error > 0.0 && error < 1e-3, "{error}");
}

/// 300 of 1000 steps are far too long for what begins there.
#[test]
fn what_begins_late_is_judged() {
    for (start, sound) in [("6.3 s", false), ("8.9 s", true)] {
        let case = format!(
            "title = \"late\"\n[body.p]\nturns = \"no\"\nmass = \"1 kg\"\nstiffness = {{ x = \"1e4 N/m\", y = \"1e4 N/m\" }}\n\
             [loads.f]\nbody = \"p\"\nforce = \"1 N\"\nstart = \"{start}\"\n[march]\ntime_step = \"9 ms\"\nduration = \"9 s\"\n"
        );
        assert_eq!(run(&case, "")["verdict"]["sound"], sound, "{start}");
    }
}

/// A rotor that its brake stops in proportion to its speed never stands still, and its speed leaves the range of numbers; so does
/// the acceleration that generalized-α damps after a pulse.
#[test]
fn what_dies_out_for_ever_is_marched_to_the_end() {
    let brake = "title = \"coast down\"\n[body.p]\nturns = \"free\"\ninitial_speed = \"300 rad/s\"\nmass = \"1 kg\"\n\
                 polar_inertia = \"1e-2 kg*m^2\"\n[joint.k]\nkind = \"bushing\"\nfirst = { body = \"p\" }\n\
                 stiffness = { xx = \"1e4 N/m\", yy = \"1e4 N/m\" }\n[drives.f]\nbody = \"p\"\ntable = \"table.csv\"\n\
                 [march]\ntime_step = \"1 ms\"\nduration = \"80 s\"\n";
    run(brake, "speed [rpm], couple [N*m]\n0, 0\n1000, -10\n3000, -90\n");
    let pulse = "title = \"free flight\"\n[body.a]\nturns = \"no\"\nmass = \"1 kg\"\n[joint.c]\nkind = \"bearing\"\n\
                 journal = { body = \"a\" }\nlaw = \"gap-linear\"\nsprings = 12\nradial_clearance = \"3 m\"\n\
                 journal_radius = \"20 mm\"\nlength = \"20 mm\"\n[loads.f]\nbody = \"a\"\ntable = \"table.csv\"\n\
                 [march]\ntime_step = \"1e-5 s\"\nduration = \"0.04 s\"\nintegrator = \"generalized-alpha\"\n";
    run(pulse, "time [s], force [N]\n0, 0\n0.0010, 0\n0.00101, 1000\n0.00102, 0\n");
}

/// A pendulum on a coupling so soft that the shaft turns away under it: it swings as one by itself does.
#[test]
fn a_swing_on_a_soft_coupling_is_judged_as_one_without() {
    let body = |name: &str, turns: &str, inertia: f64| {
        format!(
            "[body.{name}]\n{turns}\nmass = \"1 kg\"\npolar_inertia = \"{inertia} kg*m^2\"\n[joint.of_{name}]\n\
             kind = \"bushing\"\nfirst = {{ body = \"{name}\" }}\nstiffness = {{ xx = \"1e2 N/m\", yy = \"1e2 N/m\" }}\n"
        )
    };
    let pendulum = body("p", "turns = \"free\"\ninitial_speed = \"1 rad/s\"", 0.05);
    let shaft = body("a", "turns = \"prescribed\"\nspeed = \"5 rad/s\"", 1.0);
    let coupling = "[joint.soft]\nkind = \"coupling\"\nfirst = { body = \"a\" }\nsecond = { body = \"p\" }\n\
                    stiffness = \"0.05 N*m/rad\"\n";
    let load = "[loads.g]\nbody = \"p\"\ncouple = \"-9.81 N*m\"\norder = 1\n[march]\ntime_step = \"0.04 s\"\n\
                duration = \"6 s\"\n";
    let error = |more: &str| {
        let case = format!("title = \"a pendulum\"\n{pendulum}{more}{load}");
        let summary = run(&case, "");
        assert_eq!(summary["verdict"]["sound"], false);
        measure(&summary, "local_error")
    };
    let (alone, coupled) = (error(""), error(&(shaft + coupling)));
    assert!((coupled / alone - 1.0).abs() < 0.1, "{coupled} {alone}");
}

/// A constant couple turns it, and nothing else moves: that is integrated exactly, however fast its modes are.
#[test]
fn a_turn_alone_is_enough_to_be_judged() {
    let case = "title = \"a constant couple\"\n[body.p]\nturns = \"free\"\nmass = \"1 kg\"\npolar_inertia = \"1 kg*m^2\"\n\
                [joint.b]\nkind = \"bushing\"\nfirst = { body = \"p\" }\nstiffness = { xx = \"1e8 N/m\", yy = \"1e8 N/m\" }\n\
                [loads.c]\nbody = \"p\"\ncouple = \"1 N*m\"\n[march]\ntime_step = \"1e-2 s\"\nduration = \"1 s\"\n";
    assert_eq!(run(case, "")["verdict"]["sound"], true);
}

/// A mass that is pushed with half of the force with which a plate yields, which it reaches over a nanometre: Newton's method
/// jumps from one side to the other. Where it yields over a tenth of a millimetre, no step is halved.
#[test]
fn steps_that_are_halved_again_and_again_are_found_with_their_place() {
    let judged = |width: &str| {
        let law = format!(
            "kind = \"law\"\nname = \"plate\"\ntitle = \"a spring that yields\"\nsource = \"none\"\n[inputs.h]\nunit = \"mm\"\n\
             title = \"clearance\"\nrange = [-3, 3]\n[parameters.F]\nvalue = 100\nunit = \"N\"\ntitle = \"largest force\"\n\
             [parameters.w]\nvalue = {width}\nunit = \"mm\"\ntitle = \"way to it\"\n[outputs.Q]\nunit = \"N\"\n\
             title = \"normal force\"\npieces = [\n  {{ when = 'h < -w', value = 'F' }},\n\
             {{ when = 'h < 0', value = '-F*h/w' }},\n  {{ value = '0' }},\n]\n"
        );
        let case = "title = \"a mass on a plate\"\n[mass]\nmass = \"1 kg\"\nforce = \"50 N\"\n[[stop]]\nside = \"above\"\n\
            gap = \"1 um\"\nlaw = \"plate.law.toml\"\n[march]\ntime_step = \"1e-3 s\"\nduration = \"0.1 s\"\n";
        let bench = Workbench::new().file("plate.law.toml", &law).file("case.toml", case);
        let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        (bench.summary("out"), outcome.stdout)
    };
    let found = |summary: &Value| {
        let all = summary["verdict"]["findings"].as_array().cloned().unwrap_or_default();
        all.into_iter().find(|own| own["what"].to_string().contains("could not be solved whole"))
    };
    let (summary, said) = judged("1e-6");
    assert_eq!(summary["verdict"]["sound"], false, "{said}");
    let (own, halved) = (found(&summary).expect("a finding"), &summary["march"]["halved_steps"]);
    assert_eq!((own["value"].as_f64(), &own["limit"]), (halved.as_f64(), &10.0.into()), "{own}");
    assert!(own["value"].as_f64() > Some(10.0), "{own}");
    for words in ["most often for", "mass", "a law, or a table of a load, that jumps"] {
        assert!(own.to_string().contains(words), "`{words}`: {own}");
    }
    assert!(said.contains("steps that could not be solved whole"), "{said}");
    let (summary, said) = judged("0.1");
    assert_eq!((found(&summary), &summary["march"]["halved_steps"]), (None, &0.into()), "{said}");
}
