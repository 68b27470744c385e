//! The command line.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use whirl_solver::cache::Cache;

use crate::case::MODES;
use crate::schema;
use crate::sweep::Order;

/// Transient dynamics of a rotating flexible shaft on a flexible support with clearances.
#[derive(Debug, Parser)]
#[command(name = "whirl", version = crate::version::LONG, propagate_version = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// March a case in time and write its history, summary and figures
    Run(RunArguments),
    /// Run a case at many points, on all cores, and write a table of what they come to
    Sweep(SweepArguments),
    /// Do the analyses of a case: its tables [analysis.NAME], all of them or one
    Analyse(AnalyseArguments),
    /// Natural frequencies, damping and whirl of a case's machine at constant speed
    Modes(ModesArguments),
    /// Modes over speed, with critical speeds and thresholds of stability, as table and figure
    Campbell(ModesArguments),
    /// Response to unbalance over speed: orbits, peaks and amplification factors
    Response(ModesArguments),
    /// Stiffness and damping of joints in their state at speed
    Coefficients(ModesArguments),
    /// Check a case, sweep or spec file: report what it would run, or what is known of it, and every error
    Check(CheckArguments),
    /// Show what a spec defines and what follows from it: equations, shapes, costs, report, plot, code
    Explain(ExplainArguments),
    /// Write a commented file to start from: a law, an element or a case
    New(NewArguments),
    /// Print the JSON schema of a kind of file, for editors
    Schema(SchemaArguments),
    /// Show what is in a mesh file, with the lines by which a case uses it
    Mesh(MeshArguments),
    /// List the built-in cases, laws, elements, forms, motions and clearances
    List,
}

/// Arguments of `whirl mesh`.
#[derive(Debug, Args)]
pub(crate) struct MeshArguments {
    /// A mesh of Gmsh, Abaqus, CalculiX or Nastran
    pub(crate) file: PathBuf,
    /// Units of length, force and mass in the file, such as "mm, N, t"
    #[arg(long, value_name = "UNITS")]
    pub(crate) units: Option<String>,
    /// Merge nodes that are at most so far apart, such as "1e-6 m"
    #[arg(long, value_name = "LENGTH")]
    pub(crate) merge: Option<String>,
    /// Draw the surface of the mesh with its sets: FILE.svg or FILE.png
    #[arg(long, value_name = "FILE")]
    pub(crate) picture: Option<PathBuf>,
}

/// Arguments of `whirl run`.
#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    /// Path of a case file, or the name of a built-in case (see `whirl list`)
    pub(crate) case: String,
    /// Folder for the results (`results` and the name of the case, if left out)
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write no figures
    #[arg(long)]
    pub(crate) no_figures: bool,
    /// Write the history once more as history.npz, for NumPy: an array a column, by its name
    #[arg(long)]
    pub(crate) npz: bool,
    /// Resume an interrupted run in the same folder
    #[arg(long)]
    pub(crate) resume: bool,
    /// Print only warnings and errors
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Where reduced machines are kept
    #[command(flatten)]
    pub(crate) cache: CacheArguments,
}

/// Arguments of `whirl sweep`.
#[derive(Debug, Args)]
pub(crate) struct SweepArguments {
    /// Path of a sweep file; or, with `--vary`, of a case file, or the name of a built-in case
    pub(crate) file: String,
    /// A key of the case with its values, such as "springs.radial_clearance=20 um .. 60 um, 9"; may be given several times
    #[arg(long, value_name = "KEY=RANGE")]
    pub(crate) vary: Vec<String>,
    /// Folder for the results (`results` and the name of the sweep, if left out)
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write no figures
    #[arg(long)]
    pub(crate) no_figures: bool,
    /// Points at a time [default: one a core]
    #[arg(long, value_name = "N")]
    pub(crate) jobs: Option<NonZeroUsize>,
    /// Resume a sweep in the same folder that has not come to its end
    #[arg(long)]
    pub(crate) resume: bool,
    /// Print only warnings and errors
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Where reduced machines are kept
    #[command(flatten)]
    pub(crate) cache: CacheArguments,
}

impl SweepArguments {
    /// What they ask for.
    pub(crate) fn order(&self) -> Order<'_> {
        Order {
            file: &self.file,
            vary: &self.vary,
            out: self.out.as_deref(),
            figures: !self.no_figures,
            jobs: self.jobs,
            resume: self.resume,
            quiet: self.quiet,
            cache: self.cache.open(),
        }
    }
}

/// Arguments of `whirl analyse`.
#[derive(Debug, Args)]
pub(crate) struct AnalyseArguments {
    /// Path of a case file, or the name of a built-in case (see `whirl list`)
    pub(crate) case: String,
    /// Which analysis; all of them, if left out
    pub(crate) name: Option<String>,
    /// Where results go
    #[command(flatten)]
    pub(crate) results: AnalysisOutput,
}

/// Arguments of `whirl modes`, `campbell`, `response` and `coefficients`.
#[derive(Debug, Args)]
pub(crate) struct ModesArguments {
    /// Path of a case file, or the name of a built-in case (see `whirl list`)
    pub(crate) case: String,
    /// One speed such as "3000 rpm", or a range such as "0 rpm .. 30000 rpm, 61"; that of the case, or up to it, if left out
    #[arg(long, value_name = "SPEEDS", alias = "speed", allow_hyphen_values = true)]
    pub(crate) speeds: Option<String>,
    /// The body whose speed it is; the first that turns, if left out
    #[arg(long, value_name = "BODY")]
    pub(crate) of: Option<String>,
    /// How many modes, the slowest ones
    #[arg(long, value_name = "N", default_value_t = MODES)]
    pub(crate) count: usize,
    /// Orders of critical speeds, such as 1,2
    #[arg(long, value_name = "ORDERS", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) orders: Vec<f64>,
    /// Where results go
    #[command(flatten)]
    pub(crate) results: AnalysisOutput,
}

/// Where the results of analyses go.
#[derive(Debug, Args)]
pub(crate) struct AnalysisOutput {
    /// Folder for tables and figures (if left out, `results` and the name of the case; for `modes` and `coefficients`, nothing is written)
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write no figures
    #[arg(long)]
    pub(crate) no_figures: bool,
    /// Print only warnings and errors
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Where reduced machines are kept
    #[command(flatten)]
    pub(crate) cache: CacheArguments,
}

/// Arguments of `whirl check`.
#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// Path of a case or spec file, or the name of a built-in case (see `whirl list`)
    pub(crate) case: String,
    /// Say how far the bores of reduced bodies yield less than those of the meshes
    #[arg(long)]
    pub(crate) contacts: bool,
    /// Print the full report on every law: range, trends, breaks
    #[arg(long)]
    pub(crate) laws: bool,
    /// Where reduced machines are kept
    #[command(flatten)]
    pub(crate) cache: CacheArguments,
}

/// Arguments of `whirl explain`.
#[derive(Debug, Args)]
pub(crate) struct ExplainArguments {
    /// Path of a spec file, or the name of a built-in law, element, form, motion or clearance
    #[arg(value_name = "SPEC")]
    pub(crate) spec: String,
    /// Print the Rust generated from this spec instead
    #[arg(long)]
    pub(crate) rust: bool,
    /// Draw a law as SVG and PNG: FILE with either ending
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
}

/// Arguments of `whirl new`.
#[derive(Debug, Args)]
pub(crate) struct NewArguments {
    /// What to begin
    pub(crate) kind: NewKind,
    /// Its name: the file is NAME.toml (`case`, if it is made from meshes and this is left out)
    #[arg(value_name = "NAME", required_unless_present = "shaft")]
    pub(crate) name: Option<String>,
    /// The mesh of a shaft: writes a case of it and the mesh of its support, with bearings where both meet
    #[arg(long, value_name = "FILE", requires = "support")]
    pub(crate) shaft: Option<PathBuf>,
    /// The mesh of the support
    #[arg(long, value_name = "FILE", requires = "shaft")]
    pub(crate) support: Option<PathBuf>,
    /// Units of length, force and mass in both meshes, such as "mm, N, t" (by their size, if left out)
    #[arg(long, value_name = "UNITS", requires = "shaft")]
    pub(crate) units: Option<String>,
    /// Folder of the file
    #[arg(long, value_name = "DIR", default_value = ".", hide_default_value = true)]
    pub(crate) dir: PathBuf,
}

/// Kinds of files that `whirl new` can write.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum NewKind {
    /// A bearing law
    Law,
    /// A finite element
    Element,
    /// A case on the built-in machine
    Case,
}

/// Arguments of `whirl schema`.
#[derive(Debug, Args)]
pub(crate) struct SchemaArguments {
    /// Kind of file; the kinds are listed if it is left out
    #[arg(value_parser = schema_kinds())]
    pub(crate) kind: Option<String>,
}

fn schema_kinds() -> PossibleValuesParser {
    schema::kinds().map(|(name, title, _)| PossibleValue::new(name).help(title)).into()
}

/// Where reduced machines are kept between runs.
#[derive(Debug, Args)]
pub(crate) struct CacheArguments {
    /// Folder in which reduced machines are kept [default: the platform's cache folder]
    #[arg(long, value_name = "DIR", conflicts_with = "no_cache")]
    pub(crate) cache: Option<PathBuf>,
    /// Neither use nor keep reduced machines
    #[arg(long)]
    pub(crate) no_cache: bool,
}

impl CacheArguments {
    /// The cache that is meant, if any.
    pub(crate) fn open(&self) -> Option<Cache> {
        match (&self.cache, self.no_cache) {
            (_, true) => None,
            (Some(folder), false) => Some(Cache::new(folder)),
            (None, false) => Cache::of_platform(),
        }
    }
}
