//! What the program itself believes of a run.

use super::quality::Quality;

/// Something that was measured and is beyond its limit.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// What was measured.
    pub what: String,
    /// How much it is, in `unit`.
    pub value: f64,
    /// How much it may be.
    pub limit: f64,
    /// Unit of value and limit; `1` for a share.
    pub unit: String,
    /// What to do about it.
    pub remedy: String,
}

/// Energy made by steps, as a share of what flowed. A linear contact of frequency ω that is met in the middle
/// of a step makes (ωΔt)²/6 of the energy that it takes: at 5 % it lasts six steps.
pub const ENERGY_MADE: f64 = 0.05;
/// Local error of a step as a share of the largest displacement. In motion at ω it is (ωΔt)³/12, and the period
/// is wrong by (ωΔt)²/12: 1 % at this limit.
pub const LOCAL_ERROR: f64 = 3.5e-3;
/// Residual of a row over what it may have.
pub const ROW_ERROR: f64 = 1.0;

/// What is beyond its limit in steps of `time_step` s; nothing where the run is sound.
pub fn findings(quality: &Quality, time_step: f64) -> Vec<Finding> {
    let mut findings = Vec::new();
    let made = quality.energy_made_share();
    // A measure that is no number is beyond every limit.
    let beyond = |value: f64, limit: f64| !value.is_finite() || value > limit;
    if beyond(made, ENERGY_MADE) {
        let step = quality.resolving_step.map_or(0.1 * time_step, |step| step.min(0.5 * time_step));
        findings.push(Finding {
            what:
                "energy made or lost by the steps at bearings and stops, as a share of what flowed"
                    .to_owned(),
            value: made,
            limit: ENERGY_MADE,
            unit: "1".to_owned(),
            remedy: shorter(step),
        });
    }
    if beyond(quality.local_error, LOCAL_ERROR) {
        // The error grows with Δt³, and in motion that a step cannot follow less: half of it at most.
        let step = time_step * (LOCAL_ERROR / quality.local_error).cbrt().clamp(0.1, 0.5);
        findings.push(Finding {
            what: "local error that one step in twenty exceeds, as a share of the largest displacement"
                .to_owned(),
            value: quality.local_error,
            limit: LOCAL_ERROR,
            unit: "1".to_owned(),
            remedy: shorter(step),
        });
    }
    if beyond(quality.row_error, ROW_ERROR) {
        findings.push(Finding {
            what: "residual left in an equation of motion, over what rounding explains".to_owned(),
            value: quality.row_error,
            limit: ROW_ERROR,
            unit: "1".to_owned(),
            remedy: "lower `residual_tolerance`".to_owned(),
        });
    }
    findings
}

/// The remedy of a shorter step, in two digits rounded down.
fn shorter(step: f64) -> String {
    let unit = 10.0_f64.powf(step.log10().floor() - 1.0);
    let text = format!("{:.1e}", (step / unit).floor() * unit);
    format!("set `time_step = \"{text} s\"` in [march], and as many more steps")
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOUND: Quality = Quality {
        energy_made: 0.05,
        energy_flowed: 1.0,
        local_error: LOCAL_ERROR,
        largest_local_error: 1.0,
        row_error: ROW_ERROR,
        resolving_step: Some(1e-9),
    };

    fn remedy(quality: Quality) -> String {
        let found = findings(&quality, 2.36e-3);
        assert_eq!(found.len(), 1, "{found:?}");
        found[0].remedy.clone()
    }

    #[test]
    fn what_is_at_its_limit_is_sound() {
        assert_eq!(findings(&SOUND, 1e-3), []);
        assert_eq!(findings(&Quality::default(), 1e-3), []);
    }

    #[test]
    fn the_step_of_a_remedy_has_two_digits_and_is_not_longer_than_half() {
        let set = |step: &str| {
            format!("set `time_step = \"{step} s\"` in [march], and as many more steps")
        };
        // That which resolves the springs; half of the step where it is longer; a tenth where it is unknown.
        for (resolving_step, step) in
            [(Some(1.27e-4), "1.2e-4"), (Some(2e-3), "1.1e-3"), (None, "2.3e-4")]
        {
            assert_eq!(remedy(Quality { energy_made: 0.2, resolving_step, ..SOUND }), set(step));
        }
        // The third root of the error; from a tenth to half of the step.
        for (times, step) in [(27.0, "7.8e-4"), (1.01, "1.1e-3"), (1e9, "2.3e-4")] {
            let local_error = times * LOCAL_ERROR;
            assert_eq!(remedy(Quality { local_error, ..SOUND }), set(step));
        }
        let rows = remedy(Quality { row_error: 1.01, ..SOUND });
        assert_eq!(rows, "lower `residual_tolerance`");
    }

    #[test]
    fn what_is_no_number_is_not_sound() {
        let bad = f64::NAN;
        let found = findings(
            &Quality { energy_made: bad, local_error: bad, row_error: bad, ..SOUND },
            1e-3,
        );
        assert_eq!(found.len(), 3);
        assert!(found.iter().all(|own| own.value.is_nan()));
    }
}
