//! The history as files for other programs, where they are wanted. They are made at the end of a run, from its rows with all
//! their digits, which are kept beside history.csv until then.

use std::io;
use std::path::Path;

use clap::Args;

use crate::case::Case;
use crate::checkpoint::{Identity, Point};
use crate::errors::Failure;
use crate::history::{self, Format, HistoryFile, KeptRows};
use crate::machine::Built;
use crate::parquet::Facts;
use crate::results::Results;
use crate::version;

/// Which of them are wanted, an option each.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct OtherFiles {
    /// Also write the history as history.npz, for NumPy, with one array per column
    #[arg(long)]
    npz: bool,
    /// Also write the history as history.parquet, with the units of its columns
    #[arg(long)]
    parquet: bool,
    /// Also write the history as history.mat, for MATLAB, with one variable per column
    #[arg(long)]
    mat: bool,
    /// Also write the history as history.h5, HDF5 with one dataset per column
    #[arg(long)]
    hdf5: bool,
}

/// Writes one of them from the kept rows.
type Write = fn(&KeptRows, &[String], &Facts, &Path) -> io::Result<()>;

impl OtherFiles {
    /// Those that are made of kept rows, with how; history.parquet is what the file of the kept rows becomes.
    fn of_kept(self) -> [(bool, Format, Option<Write>); 3] {
        [
            (self.parquet, history::PARQUET, None),
            (self.mat, history::MAT, Some(history::write_mat)),
            (self.hdf5, history::HDF5, Some(history::write_hdf5)),
        ]
    }

    /// The first of them that is wanted.
    fn first_of_kept(self) -> Option<Format> {
        self.of_kept().into_iter().find(|own| own.0).map(|(_, format, _)| format)
    }

    /// Whether rows are to be kept for them.
    pub(crate) fn any(self) -> bool {
        self.first_of_kept().is_some()
    }

    /// Whether a run left what is needed to go on with those that are wanted.
    pub(crate) fn can_go_on(self, results: &Results) -> bool {
        let kept = || [history::PART, history::REST].iter().all(|own| results.path(own).exists());
        !self.any() || kept()
    }

    /// Rows after which a run goes on from a point, if they are kept in its folder.
    ///
    /// # Errors
    /// They are not, or are not those of its history.
    pub(crate) fn gone_on_with(
        self,
        results: &Results,
        names: &[String],
        point: &Point,
    ) -> Result<u64, Failure> {
        let folder = results.folder();
        if !self.can_go_on(results) {
            let wanted = self.first_of_kept().map_or("", |own| own.option);
            return Err(Failure::Argument {
                message: format!(
                    "`{wanted}` needs all digits of the rows, and the run in `{}` has ten in `{}`: it was begun without \
                     such an option, or `{}` and `{}` were removed",
                    folder.display(),
                    history::NAME,
                    history::PART,
                    history::REST,
                ),
                help: format!(
                    "resume it without `{wanted}`, or start again without `--resume`; `--out DIR` keeps the existing results"
                ),
            });
        }
        let kept = KeptRows::open(folder, names.len());
        let agreed =
            kept.and_then(|own| own.agree(&results.path(history::NAME), point.history.length));
        match agreed {
            Ok(Some(rows)) => Ok(rows),
            Ok(None) | Err(_) => Err(Failure::OtherRun {
                folder: folder.to_path_buf(),
                differs: vec![format!("rows of `{}` and `{}`", history::PART, history::REST)],
            }),
        }
    }

    /// Writes history.npz from the rows as history.csv has them, if it is wanted; why it cannot be written.
    pub(crate) fn write_npz(self, history: &HistoryFile, results: &Results) -> Option<String> {
        let path = results.path(history::NPZ.name);
        self.npz.then(|| failed(history::write_npz(history, &path), &path)).flatten()
    }

    /// Writes those that are made of the kept rows; why they cannot be written.
    pub(crate) fn write_copies(self, about: &About, results: &Results) -> Vec<String> {
        let wanted = self.of_kept().into_iter().filter(|(wanted, ..)| *wanted);
        let problem = |(_, format, write): (bool, Format, Option<Write>)| {
            let write = write?;
            let path = results.path(format.name);
            let written = KeptRows::open(results.folder(), about.names.len())
                .and_then(|rows| write(&rows, &about.names, &about.facts, &path));
            failed(written, &path)
        };
        wanted.filter_map(problem).collect()
    }

    /// Writes what the kept rows become when the run is `over`; why it cannot be written.
    pub(crate) fn write_last(self, about: &About, results: &Results, over: bool) -> Option<String> {
        let path = results.path(history::PARQUET.name);
        let write = || {
            let rows = KeptRows::open(results.folder(), about.names.len())?;
            history::write_parquet(&rows, &about.names, (&about.facts, over), &path)
        };
        self.parquet.then(|| failed(write(), &path)).flatten()
    }
}

fn failed(written: io::Result<()>, path: &Path) -> Option<String> {
    written.err().map(|error| format!("cannot write `{}`: {error}", path.display()))
}

/// What the files say of a run.
pub(crate) struct About {
    names: Vec<String>,
    facts: Facts,
}

impl About {
    /// Of a case, `complete` if it was run to its end.
    pub(crate) fn new((case, built): (&Case, &Built), identity: &Identity, complete: bool) -> Self {
        let march = case.march();
        let step = match march.automatic {
            Some(_) => "auto".to_owned(),
            None => format!("{:e}", march.time_step),
        };
        let whole = vec![
            ("case", case.name.clone()),
            ("title", case.title.clone()),
            ("whirl_version", version::PACKAGE.to_owned()),
            ("time_step_s", step),
            ("output_step_s", format!("{:e}", march.time_step * march.output_every as f64)),
            ("case_hash", identity.case_hash()),
            ("complete", complete.to_string()),
        ];
        let columns = built.columns();
        let units = columns.iter().map(|own| own.unit.to_string()).collect();
        let names = columns.iter().map(|own| own.name.clone()).collect();
        About { names, facts: Facts { units, whole } }
    }
}
