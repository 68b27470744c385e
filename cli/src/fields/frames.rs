//! States kept during the march, in a file of records of one length: those of the last cycle, the oldest of which is
//! written over, and those at given times.

use std::fs::{File, OpenOptions};
use std::io::{self, Cursor, Seek, SeekFrom, Write};
use std::path::Path;

use whirl_solver::dynamics::March;
use whirl_solver::machine::Machine;

use crate::case::Case;

/// The file, while a run is at work.
pub(crate) const FRAMES: &str = "frames.bin";

/// Values of a film at each of its nodes: pressure, gap and fill.
pub(super) const MAPS: usize = 3;

/// The coordinates of a machine after a step.
pub(crate) struct Frame {
    step: u64,
    /// s.
    pub(crate) time: f64,
    pub(crate) q: Vec<f64>,
    /// Of films, where these are wanted: see [`March::write_films`].
    pub(crate) films: Vec<f64>,
    /// Whether it is one of the last cycle.
    pub(crate) of_cycle: bool,
}

/// Which steps are kept, and where.
pub(crate) struct Schedule {
    /// Steps from one frame of a cycle to the next; none if no cycle is kept.
    every: Option<u64>,
    /// Records of a cycle.
    slots: u64,
    /// Steps of a cycle.
    cycle: u64,
    /// Given times (s), and from one step to the next.
    times: Vec<f64>,
    step: f64,
    /// Whether films are kept, too.
    films: bool,
}

impl Schedule {
    /// Of a case that wants frames.
    pub(crate) fn new(case: &Case) -> Option<Schedule> {
        let fields = case.fields.as_ref()?;
        let dt = case.march().time_step;
        // Of a run that is shorter than a cycle all of it is kept.
        let cycle = (case.march().cycle / dt).round().clamp(1.0, case.march().steps.max(1) as f64);
        let cycle = cycle as u64;
        let frames = fields.frames as u64;
        let every = (frames > 0).then(|| (cycle / frames.max(1)).max(1));
        let slots = every.map_or(0, |every| cycle.div_ceil(every));
        let (times, films) = (fields.times.clone(), !fields.films.is_empty());
        Some(Schedule { every, slots, cycle, times, step: dt, films })
    }

    /// Records into which a step goes that ends at `time` (s).
    fn records(&self, step: u64, time: f64) -> impl Iterator<Item = u64> {
        let of_cycle = self.every.filter(|every| step.is_multiple_of(*every));
        let of_cycle = of_cycle.map(|every| step / every % self.slots);
        let at_times = self.times.iter().enumerate();
        let at_times = at_times.filter(move |(_, own)| self.is_nearest((step, time), **own));
        of_cycle.into_iter().chain(at_times.map(|(place, _)| self.slots + place as u64))
    }

    /// Whether of all steps the one that ends at `time` ends nearest to a given time: of two as near the later one, and the
    /// first one for what is before it.
    fn is_nearest(&self, (step, time): (u64, f64), given: f64) -> bool {
        // Half a step may be missed by rounding.
        let steps = ((given - time) / self.step + 0.5 + 1e-6).floor();
        steps == 0.0 || step == 1 && steps < 0.0
    }
}

/// Writes frames, to a file or to memory. What a march that is resumed writes again are the same bytes.
pub(crate) struct FrameWriter<W> {
    schedule: Schedule,
    to: W,
}

impl FrameWriter<File> {
    /// Begins the file, or goes on with it.
    ///
    /// # Errors
    /// It cannot be opened.
    pub(crate) fn open(path: &Path, schedule: Schedule, goes_on: bool) -> io::Result<Self> {
        let mut options = OpenOptions::new();
        let to = options.write(true).create(true).truncate(!goes_on).open(path)?;
        Ok(FrameWriter { schedule, to })
    }
}

impl FrameWriter<Cursor<Vec<u8>>> {
    /// In memory.
    pub(crate) fn in_memory(schedule: Schedule) -> Self {
        FrameWriter { schedule, to: Cursor::default() }
    }

    /// What a file would have.
    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.to.into_inner()
    }
}

impl<W: Write + Seek> FrameWriter<W> {
    /// Keeps the state after a step, if it is one of those wanted.
    ///
    /// # Errors
    /// It cannot be written.
    pub(crate) fn record(&mut self, march: &March) -> io::Result<()> {
        let (step, time) = (march.progress().step as u64, march.time());
        for record in self.schedule.records(step, time) {
            let mut values = march.state().q.clone();
            if self.schedule.films {
                march.write_films(&mut values);
            }
            let length = 16 + 8 * values.len() as u64;
            let mut bytes = Vec::with_capacity(length as usize);
            bytes.extend(step.to_le_bytes());
            bytes.extend(time.to_le_bytes());
            values.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
            self.to.seek(SeekFrom::Start(record * length))?;
            self.to.write_all(&bytes)?;
        }
        Ok(())
    }
}

/// The frames of a machine in the last cycle up to `last`, and those at given times, each step once and in order.
pub(crate) fn read(
    bytes: &[u8],
    schedule: &Schedule,
    (machine, last): (&Machine, u64),
) -> Vec<Frame> {
    let films = || machine.springs.films().iter().map(|own| MAPS * own.grid.nodes()).sum::<usize>();
    let size = machine.size() + if schedule.films { films() } else { 0 };
    let number = |bytes: &[u8]| <[u8; 8]>::try_from(bytes).expect("eight bytes");
    let mut frames = Vec::new();
    for (place, record) in bytes.chunks_exact(16 + 8 * size).enumerate() {
        let step = u64::from_le_bytes(number(&record[..8]));
        let of_cycle = (place as u64) < schedule.slots;
        let in_cycle = step + schedule.cycle > last;
        let wanted = in_cycle || !of_cycle;
        // A record that was never written is of step 0.
        if step == 0 || step > last || !wanted {
            continue;
        }
        let values = record[8..].chunks_exact(8).map(|own| f64::from_le_bytes(number(own)));
        let mut values = values.collect::<Vec<f64>>();
        let mut q = values.split_off(1);
        let films = q.split_off(machine.size());
        frames.push(Frame { step, time: values[0], q, films, of_cycle: of_cycle && in_cycle });
    }
    // Of a step that is kept twice, the frame of the cycle.
    frames.sort_by_key(|frame| (frame.step, !frame.of_cycle));
    frames.dedup_by_key(|frame| frame.step);
    frames
}
