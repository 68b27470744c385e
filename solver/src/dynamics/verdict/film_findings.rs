//! What of films is beyond its limit.

use super::film_meter::FilmQuality;
use super::finding::{Finding, beyond, mended};
use crate::dynamics::lengths::AutomaticStep;
use crate::film::{OIL_LASTS, TIPPED};

/// Steps in which the gap of a film changes too fast, as a fraction of all.
const FILM_STEPS: f64 = 0.01;

/// All of it, in steps of a length (s) or in parts of them that the march chose.
pub(super) fn of_films(
    films: &FilmQuality,
    (time_step, automatic): (f64, Option<AutomaticStep>),
) -> Vec<Finding> {
    let (tipped, touches) = (tipped(films), touches(films));
    // No step follows what is no film any more.
    let is_film = tipped.is_none() && touches.is_none();
    let squeezed = is_film.then(|| squeezed(films, time_step, automatic)).flatten();
    [tipped, touches, squeezed, heated(films), unknown_viscosity(films)]
        .into_iter()
        .flatten()
        .collect()
}

/// Whether gaps of a film change too fast for the steps.
fn squeezed(
    films: &FilmQuality,
    time_step: f64,
    automatic: Option<AutomaticStep>,
) -> Option<Finding> {
    let FilmQuality { share, bearing, .. } = *films;
    (share > FILM_STEPS).then(|| {
        let what =
            "steps in which the gap of a film changes by more than itself, as a fraction of all";
        let own = beyond(what, (share, FILM_STEPS, "1"), mended(0.5 * time_step, automatic));
        Finding { bearing: Some(bearing), ..own }
    })
}

/// Whether the surfaces of a film touch.
fn touches(films: &FilmQuality) -> Option<Finding> {
    let (gap, bearing) = films.thinnest;
    (gap < 0.0).then(|| {
        let remedy = "look for a load that the film cannot carry, a speed of zero, or a start beyond its clearance; put a stop beside the \
                      film if the surfaces are to touch";
        let what = "smallest gap of a film: its surfaces touch, which no film stands for";
        let own = beyond(what, (1e6 * gap, 0.0, "um"), remedy.to_owned());
        Finding { bearing: Some(bearing), ..own }
    })
}

/// Whether the bore of a film, as of a pad, turns farther than a little.
fn tipped(films: &FilmQuality) -> Option<Finding> {
    let (turned, bearing) = films.turned;
    (turned > TIPPED).then(|| {
        let remedy = "the pad has tipped over: look at the side of its pivot, and give a pad that nothing loads a `preload`";
        let what = "turn of a bore of a film about its axis, which is taken as small";
        let own = beyond(what, (turned, TIPPED, "rad"), remedy.to_owned());
        Finding { bearing: Some(bearing), ..own }
    })
}

/// Whether a film is hotter than any oil may be.
fn heated(films: &FilmQuality) -> Option<Finding> {
    let (value, bearing) = films.hottest.filter(|own| own.0 > OIL_LASTS)?;
    let remedy = "cool the film: let more oil pass, through openings with a pressure or ends that are fed, give `housing` in its \
                  [heat], or a lower `share`; or say its `temperature` there";
    let own = beyond("temperature of a film", (value, OIL_LASTS, "K"), remedy.to_owned());
    Some(Finding { bearing: Some(bearing), ..own })
}

/// Whether a film is hotter or colder than its viscosity is known.
fn unknown_viscosity(films: &FilmQuality) -> Option<Finding> {
    let ([value, limit], bearing) = films.unknown?;
    let remedy = "give the table of the viscosity rows as far as the film warms up or cools down: beyond its last row it is taken as there";
    let what = "temperature of a film beyond the rows of its viscosity";
    let own = beyond(what, (value, limit, "K"), remedy.to_owned());
    Some(Finding { bearing: Some(bearing), ..own })
}
