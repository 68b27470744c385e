//! What a page shows of a run: its rows, read once.

use std::f64::consts::TAU;
use std::io;

use serde::Serialize;

use super::about::{About, Journal, Signal};
use super::contacts::{Contact, Contacts};
use super::groups::Group;
use super::kept::{Histories, Kept};
use super::orbits::{Orbit, Ways};
use super::over_speed::{PackedEnvelope, PackedOrders};
use super::spectra::{self, Slices, Spectrum, Waterfall};
use super::teeth::{Teeth, TeethRun};
use super::turned::Turned;
use crate::history::ReadHistory;
use crate::report::{Enveloper, Tracker, begun, varying};

/// Rows of the end of a run that are kept whole, for orbits and spectra.
const MOST_TAIL: usize = 1 << 17;
/// Signals of which spectra, and maps of them, are made.
const MOST_SPECTRA: usize = 24;
const MOST_MAPS: usize = 6;
/// Charts over the angle, at most.
const MOST_TURNED: usize = 16;

/// Places in a row of columns that belong together, and of their angle.
type Placed = (Vec<usize>, Option<usize>);

/// All of it.
#[derive(Debug, Serialize)]
pub(super) struct RunData {
    /// Names of the columns kept: those of the history but the time. Behind them come the ratios, and the normal forces of teeth.
    names: Vec<String>,
    histories: Histories,
    /// Titles of the ratios of eccentricity and clearance.
    ratios: Vec<String>,
    /// s, both of the rows.
    begins: f64,
    ends: f64,
    orbits: Vec<Orbit>,
    contacts: Vec<Contact>,
    teeth: Vec<TeethRun>,
    turned: Vec<Turned>,
    /// Over how long (s), and one a signal.
    spectrum_s: f64,
    spectra: Vec<Spectrum>,
    waterfalls: Vec<Waterfall>,
    /// One an angle, of those whose speed varies.
    tracked: Vec<PackedOrders>,
    envelopes: Vec<PackedEnvelope>,
}

impl RunData {
    /// Of the rows of a history; none where there are none.
    ///
    /// # Errors
    /// They cannot be read, or are not those that the record tells of.
    pub(super) fn of(about: &About, history: &dyn ReadHistory) -> io::Result<Option<Self>> {
        let names: Vec<&str> = history.names().iter().map(String::as_str).collect();
        if !about.columns.iter().map(|own| own.name.as_str()).eq(names.iter().copied()) {
            let other = "it has other columns than about.json says";
            return Err(io::Error::new(io::ErrorKind::InvalidData, other));
        }
        let Some(ends) = history.last_time()? else { return Ok(None) };
        let dt = about.row_s;
        let begins = begun(history, dt)?;
        let rows = ((ends - begins) / dt).round().max(1.0) as usize;
        let place = |name: &str| {
            let other = || io::Error::new(io::ErrorKind::InvalidData, format!("no column {name}"));
            names.iter().position(|own| *own == name).ok_or_else(other)
        };
        let placed = |columns: &mut dyn Iterator<Item = &str>, angle: Option<&str>| {
            let columns = columns.map(place).collect::<io::Result<Vec<usize>>>()?;
            Ok::<Placed, io::Error>((columns, angle.map(place).transpose()?))
        };
        let of_signal = |own: &Signal| {
            placed(&mut own.columns.iter().map(|own| own.0.as_str()), own.angle.as_deref())
        };
        let of_journal = |own: &Journal| {
            let columns = own.columns.iter().chain(&own.forces);
            placed(&mut columns.map(String::as_str), own.angle.as_deref())
        };
        let signals = about.signals.iter().map(of_signal).collect::<io::Result<Vec<Placed>>>()?;
        let journals =
            about.journals.iter().map(of_journal).collect::<io::Result<Vec<Placed>>>()?;
        let of_teeth = |own: &Teeth| {
            let [x, y] = own.forces.each_ref().map(|own| place(own));
            io::Result::Ok([x?, y?])
        };
        let teeth = about.teeth.iter().map(of_teeth).collect::<io::Result<Vec<[usize; 2]>>>()?;
        let ratios: Vec<(usize, f64)> = (0..journals.len())
            .map(|k| (k, about.journals[k].clearance_um))
            .filter(|own| own.1 > 0.0)
            .collect();
        let mut kept = Kept::new(names.len() - 1 + ratios.len() + teeth.len(), rows);
        let mut angles: Vec<usize> = signals.iter().filter_map(|own| own.1).collect();
        angles.sort_unstable();
        angles.dedup();
        let called: Vec<&str> = angles.iter().map(|own| names[*own]).collect();
        let varying = varying(history, &called, [begins, ends])?;
        let varying: Vec<(usize, [f64; 2])> =
            varying.into_iter().map(|(own, span)| (angles[own], span)).collect();
        let mut trackers: Vec<Tracker> = varying
            .iter()
            .filter_map(|&(angle, span)| {
                let own = signals.iter().filter(|own| own.1 == Some(angle));
                let columns = own.flat_map(|own| own.0.iter().copied()).collect();
                let others = angles.iter().copied().filter(|own| *own != angle).collect();
                Tracker::new((angle, others, columns), span)
            })
            .collect();
        let of_envelope = |&(angle, span): &(usize, [f64; 2])| {
            let own = signals.iter().take(MOST_SPECTRA).filter(|own| own.1 == Some(angle));
            Enveloper::new((angle, own.flat_map(|own| own.0.iter().copied()).collect()), span)
        };
        let mut envelopes: Vec<Enveloper> = varying.iter().map(of_envelope).collect();
        let turns = |angle: usize| varying.iter().any(|own| own.0 == angle);
        let mapped: Vec<usize> = (0..signals.len())
            .filter(|k| signals[*k].1.is_some_and(turns))
            .take(MOST_MAPS)
            .collect();
        let of_maps = mapped.iter().filter_map(|k| {
            let both = if spectra::is_plane(&about.signals[*k]) { 2 } else { 1 };
            Some((signals[*k].0[..both].to_vec(), signals[*k].1?))
        });
        let mut slices = Slices::new(of_maps.collect(), rows, dt);
        let of_group = |own: &Group| {
            placed(&mut own.lines.iter().map(|own| own.0.as_str()), own.angle.as_deref())
        };
        let of_angle = about.groups.iter().enumerate().filter(|own| own.1.angle.is_some());
        let of_angle = of_angle.take(MOST_TURNED);
        let of_angle = of_angle
            .map(|(k, own)| Ok((k, of_group(own)?)))
            .collect::<io::Result<Vec<(usize, Placed)>>>()?;
        let tail_rows = tail(about, (&signals, &journals), history, rows)?;
        let from = ends - (tail_rows as f64 - 0.5) * dt;
        let mut end: Vec<Vec<f64>> = vec![Vec::new(); names.len()];
        let mut ways = Ways::new(journals.len(), rows);
        let wanted = wanted(&signals, &journals, &of_angle);
        let mut contacts: Vec<Contacts> = ratios.iter().map(|_| Contacts::default()).collect();
        let mut apart: Vec<Contacts> = teeth.iter().map(|_| Contacts::default()).collect();
        history.scan(history.start(), &names, &mut |row| {
            let time = row[0];
            let ratio = |&(k, clearance): &(usize, f64)| {
                row[journals[k].0[0]].hypot(row[journals[k].0[1]]) / clearance
            };
            let force = |(own, place): (&Teeth, &[usize; 2])| own.normal(place.map(|k| row[k]));
            let normal = about.teeth.iter().zip(&teeth).map(force);
            let beside = ratios.iter().map(ratio).chain(normal.clone());
            kept.add(time, row[1..].iter().copied().chain(beside));
            contacts.iter_mut().zip(&ratios).for_each(|(own, k)| own.add(time, ratio(k) > 1.0));
            apart.iter_mut().zip(normal).for_each(|(own, force)| own.add(time, force == 0.0));
            trackers.iter_mut().for_each(|own| own.add(time, row));
            envelopes.iter_mut().for_each(|own| own.add(time, row));
            slices.iter_mut().for_each(|own| own.add(time, row));
            ways.add(journals.iter().map(|own| [row[own.0[0]], row[own.0[1]]]));
            if time >= from {
                wanted.iter().for_each(|&own| end[own].push(row[own]));
            }
        })?;
        let (span, spectra) = spectra_of(about, &signals, &end, [begins, ends]);
        let orbits = journals.iter().zip(&about.journals).zip(ways.finish());
        let orbits = orbits.filter_map(|(((both, angle), own), way)| {
            let [x, y, fx, fy] = [0, 1, 2, 3].map(|k| end[both[k]].as_slice());
            let cycle = (about.cycle_s / dt).round() as usize + 1;
            let angle = angle.map(|own| end[own].as_slice());
            (!x.is_empty()).then(|| Orbit::of(own, [x, y, fx, fy], angle, cycle).with(&way))
        });
        let turned = of_angle.iter().filter_map(|(group, (columns, angle))| {
            let columns: Vec<&[f64]> = columns.iter().map(|own| end[*own].as_slice()).collect();
            let angle = end[(*angle)?].as_slice();
            Turned::of(*group, &columns, angle, revolutions(about, angle))
        });
        let owned = history.names();
        let title = |(k, _): &(usize, f64)| about.journals[*k].title.clone();
        Ok(Some(RunData {
            names: owned[1..].to_vec(),
            histories: kept.finish(),
            ratios: ratios.iter().map(title).collect(),
            begins,
            ends,
            orbits: orbits.collect(),
            contacts: contacts
                .into_iter()
                .zip(&ratios)
                .filter_map(|(own, k)| own.finish(&title(k)))
                .collect(),
            teeth: apart
                .into_iter()
                .zip(&about.teeth)
                .map(|(own, of)| TeethRun {
                    title: of.title.clone(),
                    backlash: of.backlash,
                    apart: own.finish(&of.title),
                })
                .collect(),
            turned: turned.collect(),
            spectrum_s: span,
            spectra,
            waterfalls: slices.map_or_else(Vec::new, |own| own.finish(&mapped)),
            tracked: trackers
                .into_iter()
                .filter_map(|own| Some(own.finish(owned)?.into()))
                .collect(),
            envelopes: envelopes
                .into_iter()
                .filter_map(|own| Some(own.finish(owned)?.into()))
                .collect(),
        }))
    }
}

/// Revolutions of a cycle that has two of them, as of a four-stroke engine, and else one: what goes by the angle repeats after them.
fn revolutions(about: &About, angle: &[f64]) -> f64 {
    let rows = (about.cycle_s / about.row_s).round() as usize;
    let turned = match (angle.last(), angle.len().checked_sub(rows + 1)) {
        (Some(last), Some(from)) => (last - angle[from]).abs() / TAU,
        _ => 1.0,
    };
    if (turned - 2.0).abs() < 0.01 { 2.0 } else { 1.0 }
}

/// Columns of which the end is kept.
fn wanted(signals: &[Placed], journals: &[Placed], of_angle: &[(usize, Placed)]) -> Vec<usize> {
    let columns =
        |(columns, angle): &Placed| columns.iter().copied().chain(*angle).collect::<Vec<usize>>();
    let of_angle = of_angle.iter().map(|own| &own.1);
    let others = signals.iter().take(MOST_SPECTRA).chain(journals);
    let mut all: Vec<usize> = others.chain(of_angle).flat_map(columns).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Rows of the end that are kept whole: those of spectra, and those of the last revolutions of the slowest body.
fn tail(
    about: &About,
    (signals, journals): (&[Placed], &[Placed]),
    history: &dyn ReadHistory,
    rows: usize,
) -> io::Result<usize> {
    let most = rows.min(MOST_TAIL);
    let mut wanted = (spectra::CYCLES * about.cycle_s / about.row_s).round() as usize + 1;
    let angles: Vec<usize> = signals.iter().chain(journals).filter_map(|own| own.1).collect();
    for angle in angles {
        let name = history.names()[angle].as_str();
        let end = history.last_time()?.unwrap_or(0.0);
        let at = |time: f64| -> io::Result<f64> {
            let mut found = 0.0;
            let place = history.place_of_time(time)?;
            history.first_row(place, &[name], &mut |row| found = row[0])?;
            Ok(found)
        };
        let last = at(end)?;
        while wanted < most
            && (last - at(end - wanted as f64 * about.row_s)?).abs()
                < super::orbits::REVOLUTIONS * TAU
        {
            wanted *= 2;
        }
    }
    Ok(wanted.min(most).max(1))
}

/// Spectra over the last cycles, at most over the last half of the run, and how long that is (s).
fn spectra_of(
    about: &About,
    signals: &[Placed],
    end: &[Vec<f64>],
    [begins, ends]: [f64; 2],
) -> (f64, Vec<Spectrum>) {
    let (dt, cycle) = (about.row_s, about.cycle_s);
    let cycles = (0.5 * (ends - begins) / cycle).floor().clamp(1.0, spectra::CYCLES);
    let rows = ((cycles * cycle).min(ends - begins) / dt).round() as usize;
    let there = |own: &Placed| end[own.0[0]].len();
    let shown = &signals[..signals.len().min(MOST_SPECTRA)];
    let rows = shown.iter().map(there).fold(rows.min(MOST_TAIL), usize::min);
    if rows < spectra::LEAST_ROWS || shown.is_empty() {
        return (0.0, Vec::new());
    }
    let last = |place: usize| &end[place][end[place].len() - rows..];
    let of = |(own, (columns, angle)): (&Signal, &Placed)| {
        let columns: Vec<&[f64]> = columns.iter().map(|own| last(*own)).collect();
        Spectrum::of(own, &columns, angle.map(last), dt)
    };
    let mut all: Vec<Spectrum> = about.signals.iter().zip(shown).map(of).collect();
    spectra::shown(&about.signals, &mut all, dt);
    (dt * rows as f64, all)
}
