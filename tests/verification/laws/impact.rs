//! Laws of impact: the speed after it, against the solution of the equation of motion and against the
//! coefficient of restitution that the law was given.

use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::law::LawSpec;
use whirl_codegen::tape::Tape;
use whirl_tests::validation::Section;

use super::kernel::Kernel;
use super::laws;

/// A free body on its way into a wall.
#[derive(Clone, Copy)]
pub(super) struct Body {
    pub(super) mass: f64,
    pub(super) speed: f64,
}

/// What an impact did.
#[derive(Debug)]
pub(super) struct Impact {
    pub(super) duration: f64,
    pub(super) rebound: f64,
    pub(super) deepest: f64,
    pub(super) peak: f64,
}

/// m ḧ = Q(h, ḣ) from h = 0 until h = 0 again, by the classical Runge–Kutta method.
pub(super) fn strike(body: Body, force: impl Fn(f64, f64) -> f64, step: f64) -> Impact {
    let rate = |[h, v]: [f64; 2]| [v, force(h, v) / body.mass];
    let moved = |x: [f64; 2], k: [f64; 2], t: f64| [x[0] + t * k[0], x[1] + t * k[1]];
    let stepped = |x: [f64; 2], t: f64| {
        let k1 = rate(x);
        let k2 = rate(moved(x, k1, t / 2.0));
        let k3 = rate(moved(x, k2, t / 2.0));
        let k4 = rate(moved(x, k3, t));
        let mean = |i: usize| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0;
        moved(x, [mean(0), mean(1)], t)
    };
    let (mut x, mut time, mut deepest, mut peak) = ([0.0, -body.speed], 0.0, 0.0_f64, 0.0_f64);
    for _ in 0..1_000_000 {
        let next = stepped(x, step);
        if next[0] > 0.0 {
            // The last step, shortened until it ends at h = 0.
            let mut rest = step * -x[0] / (next[0] - x[0]);
            for _ in 0..20 {
                let end = stepped(x, rest);
                rest -= end[0] / end[1];
            }
            let rebound = stepped(x, rest)[1];
            return Impact { duration: time + rest, rebound, deepest, peak };
        }
        (x, time) = (next, time + step);
        deepest = deepest.max(-x[0]);
        peak = peak.max(force(x[0], x[1]));
    }
    panic!("the body never leaves the wall");
}

/// A steel ball of 20 mm: Hertz's time of impact is about 0.1 ms at these speeds.
const MASS: f64 = 0.0329;
const STEP: f64 = 1e-8;

#[test]
fn without_damping_the_impact_is_hertzs() {
    let (modulus, radius, speed) = (109.89e9, 0.01, 0.5);
    let mut section = Section::new(
        "An elastic impact of two spheres",
        "Hertz; Johnson, Contact Mechanics, eqs. (11.22) to (11.24), their numbers with three digits",
        "cargo test -p whirl-tests --test verification -- without_damping_the_impact_is_hertzs",
    );
    for name in ["hunt-crossley", "lankarani-nikravesh"] {
        let law = Kernel::named(name);
        let found = strike(Body { mass: MASS, speed }, |h, _| law.value("Q", &[("h", h)]), STEP);
        // Johnson, Contact Mechanics, eqs. (11.22) to (11.24): largest approach and time of contact.
        let ratio: f64 = 15.0 * MASS * speed * speed / (16.0 * f64::sqrt(radius) * modulus);
        let deepest = ratio.powf(0.4);
        // Between steps the largest approach is missed by at most v²/(2 a) of half a step.
        let mut compare = |what: &str, theirs: f64, ours: f64, tolerance: f64| {
            section.compare(&format!("`{name}`: {what}"), theirs, ours, tolerance);
        };
        compare("largest approach (m)", deepest, found.deepest, 1e-6);
        compare("time of contact × speed/approach", 2.94, found.duration * speed / deepest, 1.7e-3);
        let time = 2.87 * (MASS * MASS / (radius * modulus * modulus * speed)).powf(0.2);
        compare("time of contact (s)", time, found.duration, 5e-3);
        compare("speed after (m/s)", speed, found.rebound, 1e-8);
    }
    section.finish();
}

/// The restitution of Q = f(d) (1 + μ ḋ), whatever f: v dv/(1 + μ v) integrates to the same on both ways.
fn exact_restitution(u: f64) -> f64 {
    // u − ln(1 + u) = −w − ln(1 − w), w = μ times the speed after.
    let target = u - u.ln_1p();
    let mut w = u / (1.0 + 2.0 * u / 3.0);
    for _ in 0..50 {
        w -= (-w - (-w).ln_1p() - target) * (1.0 - w) / w;
    }
    w / u
}

#[test]
fn hunt_and_crossleys_restitution_falls_with_the_speed() {
    let law = Kernel::named("hunt-crossley");
    // e = 1 − a v with e = 0.9 at 0.5 m/s.
    let a = 0.2;
    let mut errors = Vec::new();
    let mut section = Section::new(
        "Restitution of Hunt and Crossley's law",
        "Exact integral of v dv/(1 + μ v)",
        "cargo test -p whirl-tests --test verification -- hunt_and_crossleys_restitution_falls_with_the_speed",
    );
    for speed in [0.5, 0.25, 0.125, 0.0625] {
        let force = |h: f64, v: f64| law.value("Q", &[("h", h), ("h_dot", v)]);
        let found = strike(Body { mass: MASS, speed }, force, STEP).rebound / speed;
        let exact = exact_restitution(1.5 * a * speed);
        // d^1.5 has no bounded second derivative at first touch: (step/duration)^2.5 remain.
        section.compare(&format!("speed after over {speed} m/s before"), exact, found, 1e-7);
        // The authors' first-order theory: what is left is of the order of (a v)².
        errors.push(found - (1.0 - a * speed));
        assert!(errors[errors.len() - 1].abs() <= (a * speed).powi(2), "{errors:?}");
    }
    for pair in errors.windows(2) {
        // Of second order in v, with a term of third order that is a v of it.
        assert!((pair[0] / pair[1] - 4.0).abs() < 4.0 * a * 0.5, "{errors:?}");
    }
    section.finish();
}

#[test]
fn lankarani_and_nikravesh_lose_the_energy_of_the_coefficient_given() {
    let law = laws().into_iter().find(|law| law.name == "lankarani-nikravesh").expect("the law");
    let mut errors = Vec::new();
    for loss in [0.1, 0.05, 0.025] {
        let wanted = 1.0 - loss;
        let text = law.file.text.replace("value = 0.9\n", &format!("value = {wanted}\n"));
        assert!(text.contains(&wanted.to_string()));
        let law = LawSpec::read(&Source::new("law.toml", text)).expect("the law, changed");
        let tape = Tape::new(&law.program().expect("a program"));
        let force = |h: f64, v: f64| {
            let mut rows = [0.0; 3];
            tape.evaluate(1, &[h, v], &mut rows, &mut vec![0.0; tape.workspace()]);
            rows[0]
        };
        let speed = 0.5;
        let found = strike(Body { mass: MASS, speed }, force, 4.0 * STEP).rebound / speed;
        let exact = exact_restitution(0.75 * (1.0 - wanted * wanted));
        assert!((found - exact).abs() < 1e-6, "{found} {exact}");
        // Energy lost, as a fraction of what the coefficient means: right to first order in 1 − e, the
        // authors' assumption of a coefficient near 1.
        errors.push((1.0 - found * found) / (1.0 - wanted * wanted) - 1.0);
        assert!(errors[errors.len() - 1].abs() < 2.0 * loss, "{errors:?}");
    }
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1] - 2.0).abs() < 0.2, "{errors:?}");
    }
}
