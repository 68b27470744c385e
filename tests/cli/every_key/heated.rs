//! Films with temperatures against films of the viscosity that follows, and what heats them against what cools them.

use whirl_solver::film::{Balance, Journal, JournalMotion, Oil, OilFilm};
use whirl_specs::{CLEARANCES, FILMS};

use crate::workbench::Workbench;

/// Forces on a journal (N) in a film of this viscosity (Pa·s), and what enters the film (m³/s).
fn forces(name: &str, mu: f64, sizes: [f64; 3], ends: Option<[f64; 2]>, at: [f64; 3]) -> [f64; 3] {
    let kernel = FILMS.iter().find(|film| film.origin.name == name).expect("a shipped film");
    let [radius, length, clearance] = sizes;
    let mut film = OilFilm::new(kernel, [72, 7], [radius, length], 0.0).expect("a film");
    film.set("mu_0", mu).expect("a parameter");
    for (side, pressure) in ends.into_iter().flatten().enumerate() {
        film.flood(side, pressure).expect("an end");
    }
    let journal = Journal::new(film, &CLEARANCES[0], clearance).expect("a journal");
    let (mut oil, mut balance) = (Oil::full(&journal.film), Balance::new(&journal.film));
    let [x, y, omega] = at;
    let motion = JournalMotion { displacement: [x, y], omega, ..JournalMotion::default() };
    let mut outputs = vec![0.0; journal.film.outputs()];
    let found = journal.react(&motion, &mut oil, &mut balance, &mut outputs).expect("a film");
    let [enters, _] = balance.exchanged(&journal.film);
    [found.forces[0], found.forces[1], enters]
}

#[test]
fn films_have_the_viscosity_of_their_temperature() {
    let bench = Workbench::new()
        .file("heated.toml", include_str!("heated.toml"))
        .file("oil.csv", include_str!("oil.csv"));
    let outcome = bench.whirl(&["run", "heated.toml", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}{}", outcome.stdout, outcome.stderr);
    let history = bench.history("out");
    let last = |name: &str| history.last(name);
    let rpm = std::f64::consts::PI / 30.0;
    // The film of the viscosity at its temperature carries the load, and what heats it is what cools it.
    let temperature = last("temperature_f_K");
    let mu = 0.031 * (810.0 / (temperature - 175.0) - 810.0 / (318.0 - 175.0)).exp();
    let at = [1e-6 * last("EX_b_um"), 1e-6 * last("EY_b_um"), 5800.0 * rpm];
    let found = forces("jfo", mu, [0.021, 0.023, 35e-6], Some([14e5, 0.5e5]), at);
    assert!((found[0] - 900.0).abs() + (found[1] + 150.0).abs() < 0.05, "{found:?}");
    let heats = 0.85 * last("loss_f_W");
    let carried = 865.0 * 2010.0 * found[2] * (temperature - 318.0);
    let cools = carried + 7.0 * (temperature - 305.0);
    assert!((heats / cools - 1.0).abs() < 1e-5, "{heats} W for {cools} at {temperature} K");
    assert!(
        temperature > 325.0 && carried > 0.05 * heats,
        "{temperature} K, {carried} W of {heats}"
    );
    // The given temperature is between two rows.
    let mu = 0.0125 * (4.4_f64 / 12.5).powf((351.0 - 333.0) / 40.0);
    let at = [1e-6 * last("EX_given_um"), 1e-6 * last("EY_given_um"), 2900.0 * rpm];
    let found = forces("reynolds", mu, [0.017, 0.013, 31e-6], None, at);
    assert!(found[0].abs() + (found[1] - 200.0).abs() < 0.01, "{found:?}");
    assert!(!history.names().iter().any(|name| name == "temperature_g_K"));
}
