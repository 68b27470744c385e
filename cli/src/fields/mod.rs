//! Motions of whole bodies, and films, for other programs: frames kept during the march, written as VTU files when it is over.

mod films;
mod frames;
mod motion;
mod stresses;
mod vtu;

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;

use whirl_solver::bearing::FilmPlace;
use whirl_solver::mesh::Mesh;
use whirl_solver::stress::von_mises;

pub(crate) use self::films::PlayedFilm;
pub(crate) use self::frames::{FRAMES, FrameWriter, Schedule};
use self::frames::{Frame, MAPS, read};
use self::motion::motion;
use self::stresses::Envelope;
pub(crate) use self::stresses::LargestStress;
use self::vtu::Cells;
use crate::case::Case;
use crate::machine::Built;

/// The folder of the files among the results.
pub(crate) const FOLDER: &str = "fields";

/// Takes away the files that an earlier run left in the folder.
///
/// # Errors
/// A file cannot be removed.
pub(crate) fn clear(results: &Path) -> io::Result<()> {
    let Ok(entries) = fs::read_dir(results.join(FOLDER)) else { return Ok(()) };
    for entry in entries {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "vtu" || ending == "pvd") {
            fs::remove_file(path)?;
        }
    }
    Ok(())
}

/// A body as it moves: in the frames of the last cycle, or in all where none is of it.
pub(crate) struct Played<'a> {
    pub(crate) name: &'a str,
    pub(crate) mesh: &'a Mesh,
    /// In the order of time.
    pub(crate) frames: Vec<PlayedFrame>,
}

/// A body at an instant, by the nodes of its mesh.
pub(crate) struct PlayedFrame {
    /// s.
    pub(crate) time: f64,
    /// How far its frame has turned (rad).
    pub(crate) angle: f64,
    /// In its frame (m).
    pub(crate) displacement: Vec<[f64; 3]>,
    /// By von Mises (Pa), where the case wants stresses.
    pub(crate) stress: Option<Vec<f64>>,
}

/// The motions of whole bodies that a run has left.
pub(crate) struct Motions<'a> {
    built: &'a Built,
    /// Joints whose films are written, by their places and names.
    films: Vec<(usize, String)>,
    frames: Vec<Frame>,
    /// The largest stresses of each body, where the case wants them.
    stresses: Vec<Option<Envelope>>,
}

impl<'a> Motions<'a> {
    /// Of a run up to a step, from the bytes of its frames; none if the case wants none.
    ///
    /// # Errors
    /// The frames cannot be read, or a mesh has no stresses, in words.
    pub(crate) fn read(
        (case, built): (&Case, &'a Built),
        frames: impl FnOnce() -> Result<Vec<u8>, String>,
        step: usize,
    ) -> Option<Result<Self, String>> {
        let (schedule, fields) = (Schedule::new(case)?, case.fields.as_ref()?);
        let motions = frames().and_then(|bytes| {
            let frames = read(&bytes, &schedule, (&built.machine, step as u64));
            let all = built.machine.fields.iter().zip(&built.fields);
            let stresses = all.map(|(field, own)| {
                (fields.stresses && own.flexible)
                    .then(|| Envelope::new(&own.mesh, &built.machine, field, &frames))
                    .transpose()
            });
            let stresses = stresses.collect::<Result<_, _>>();
            let stresses = stresses.map_err(|error| format!("no stresses: {error}"))?;
            let name = |&joint: &usize| (joint, case.machine.joints[joint].name.text().to_owned());
            let films = fields.films.iter().map(name).collect();
            Ok(Motions { built, films, frames, stresses })
        });
        Some(motions)
    }

    /// What is to be said of a run that was too short for any frame.
    pub(crate) fn without_frames(&self) -> Option<&'static str> {
        let none = self.frames.is_empty();
        none.then_some("no frame of `[fields]` was reached: give `times` within the run, or more `frames` of the cycle")
    }

    /// The largest stress of each body.
    pub(crate) fn largest(&self) -> BTreeMap<String, LargestStress> {
        let all = self.built.machine.fields.iter().zip(&self.built.fields).zip(&self.stresses);
        let largest = all.filter_map(|((field, own), stresses)| {
            let name = self.built.machine.bodies[field.body].name();
            Some((name.to_owned(), stresses.as_ref()?.largest(&own.mesh)?))
        });
        largest.collect()
    }

    /// The bodies as they move.
    pub(crate) fn played(&self) -> impl Iterator<Item = Played<'_>> {
        let machine = &self.built.machine;
        let all = machine.fields.iter().zip(&self.built.fields).zip(&self.stresses);
        all.map(move |((field, own), stresses)| {
            let of_frame = |frame: &Frame| {
                let motion = motion(machine, field, frame);
                let stress = stresses.as_ref().and_then(|_| motion.in_body(&own.mesh).ok());
                PlayedFrame {
                    time: frame.time,
                    angle: motion.turned_by(),
                    displacement: motion.displacements().to_vec(),
                    stress: stress.map(|all| all.iter().map(von_mises).collect()),
                }
            };
            let cycle = self.frames.iter().any(|frame| frame.of_cycle);
            let frames = self.frames.iter().filter(|frame| !cycle || frame.of_cycle);
            let name = machine.bodies[field.body].name();
            Played { name, mesh: &own.mesh, frames: frames.map(of_frame).collect() }
        })
    }

    /// The films whose maps are wanted.
    pub(crate) fn films(&self) -> Vec<PlayedFilm<'_>> {
        let mut first = 0;
        let mut played = |place: FilmPlace<'_>| {
            let begin = first;
            first += MAPS * place.grid.nodes();
            let end = first;
            let (_, name) = self.films.iter().find(|own| own.0 == place.bearing)?;
            let maps = self.frames.iter().map(|own| (own.time, &own.films[begin..end]));
            Some((name.clone(), maps.collect::<Vec<_>>()))
        };
        let all = self.built.machine.springs.films().into_iter();
        let all = all.filter_map(|place| {
            let (name, frames) = played(place)?;
            Some(PlayedFilm { name, place, frames })
        });
        all.collect()
    }

    /// Writes the files of all bodies: one a frame, one of the largest stresses, and one a body that lists those of frames
    /// with their times.
    ///
    /// # Errors
    /// What cannot be written.
    pub(crate) fn write(&self, results: &Path) -> io::Result<()> {
        let (machine, folder) = (&self.built.machine, results.join(FOLDER));
        fs::create_dir_all(&folder)?;
        let all = machine.fields.iter().zip(&self.built.fields).zip(&self.stresses);
        for ((field, own), stresses) in all {
            let name = machine.bodies[field.body].name();
            let cells = Cells::of(&own.mesh);
            let mut listed = Vec::with_capacity(self.frames.len());
            for (number, frame) in self.frames.iter().enumerate() {
                let file = format!("{name}_{number:04}.vtu");
                let motion = motion(machine, field, frame);
                let mut arrays = motion.moved(own.axis);
                if stresses.is_some() {
                    arrays.extend(motion.stresses(&own.mesh).map_err(io::Error::other)?);
                }
                vtu::write(&folder.join(&file), &cells, &arrays)?;
                listed.push((frame.time, file));
            }
            vtu::collection(&folder.join(format!("{name}.pvd")), &listed)?;
            if let Some(stresses) = stresses {
                let arrays = stresses.arrays(&own.mesh, own.axis);
                vtu::write(&folder.join(format!("{name}_largest.vtu")), &cells, &arrays)?;
            }
        }
        self.films().iter().try_for_each(|film| films::write(&folder, film))
    }
}
