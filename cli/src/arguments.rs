//! The command line.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use whirl_solver::cache::Cache;

use crate::case::{MODES, MatrixFormat};
use crate::other_files::OtherFiles;
use crate::schema;
use crate::sweep::Order;

/// Dynamics of rotating flexible shafts in flexible supports, with bearing clearances and oil films.
#[derive(Debug, Parser)]
#[command(name = "whirl", version = crate::version::LONG, propagate_version = true, after_help = FIRST)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// What to type first.
const FIRST: &str = "\
First steps:
  whirl run hu2003-5                          run a built-in case; `whirl list` names the others
  whirl campbell overhung-disc                its Campbell diagram, critical speeds and stability
  whirl new case mine --like turbocharger     write a case of your own, then: whirl check mine.toml";

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Integrate a case in time and write its history, summary and figures
    Run(RunArguments),
    /// Run a case at many points, on all cores, and write a table and figures of the results
    Sweep(SweepArguments),
    /// Run the analyses that a case defines in its tables [analysis.NAME]: all, or one of them
    Analyse(AnalyseArguments),
    /// Natural frequencies, damping and whirl direction at constant speed
    Modes(ModesArguments),
    /// Campbell diagram with critical speeds and stability thresholds, as tables and a figure
    Campbell(ModesArguments),
    /// Response over speed to unbalance and to loads over the angle: orbits, peaks and amplification factors
    Response(ModesArguments),
    /// Stiffness and damping coefficients of the joints, linearised at speed
    Coefficients(ModesArguments),
    /// The least stable mode over speed, with stability thresholds
    Stability(ModesArguments),
    /// Torsional modes of a train with couplings and gears, its interference diagram and static torques
    Torsion(ModesArguments),
    /// Deflection, shear, bending moment, axial force and torque along the bodies: at rest in the loads, in response and modes
    Forces(ModesArguments),
    /// Undamped critical speed map: critical speeds over the stiffness of the joints
    Map(MapArguments),
    /// Hold unbalance response and stability against API 617: the tables `kind = "lateral"` of a case
    Lateral(LateralArguments),
    /// Mass, damping and stiffness matrices, inputs, outputs and state space, in files for other programs
    Matrices(MatricesArguments),
    /// Make the page report.html of a folder of results again
    Report(ReportArguments),
    /// Write a case as a unit for co-simulation (FMI 2.0), which other programs run
    Export(ExportArguments),
    /// Check a case, sweep or spec file: describe it, and report every error
    Check(CheckArguments),
    /// Show what a spec defines and what is derived from it: equations, shapes, costs, report, plot, code
    Explain(ExplainArguments),
    /// Write a commented file to start from: a law, an element or a case
    New(NewArguments),
    /// Print what a kind of file may say: as JSON schema for editors, or as a page
    Schema(SchemaArguments),
    /// Show what is in a mesh file, and the lines that use it in a case
    Mesh(MeshArguments),
    /// List the built-in cases, laws, elements, forms, motions and clearances
    List,
    /// Print what completes commands and options in a shell
    Completions(CompletionsArguments),
    /// Write the manual pages: whirl.1, and one for each command
    Man(ManArguments),
}

/// Arguments of `whirl completions`.
#[derive(Debug, Args)]
pub(crate) struct CompletionsArguments {
    /// The shell
    pub(crate) shell: clap_complete::Shell,
}

/// Arguments of `whirl man`.
#[derive(Debug, Args)]
pub(crate) struct ManArguments {
    /// Folder for the pages, such as ~/.local/share/man/man1; it is made if it is not there
    #[arg(long, value_name = "DIR", default_value = "man")]
    pub(crate) out: PathBuf,
}

/// Arguments of `whirl mesh`.
#[derive(Debug, Args)]
pub(crate) struct MeshArguments {
    /// A mesh of Gmsh, Abaqus, CalculiX or Nastran, or a universal file (UNV)
    pub(crate) file: PathBuf,
    /// Units of length, force and mass in the file, such as "mm, N, t"
    #[arg(long, value_name = "UNITS")]
    pub(crate) units: Option<String>,
    /// Merge nodes that are at most this far apart, such as "1e-6 m"
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
    /// Folder for the results [default: results/NAME, with the name of the case]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write no figures
    #[arg(long)]
    pub(crate) no_figures: bool,
    /// Write no report.html
    #[arg(long)]
    pub(crate) no_report: bool,
    /// The history as files for other programs
    #[command(flatten)]
    pub(crate) other_files: OtherFiles,
    /// Resume an interrupted run in the same folder
    #[arg(long)]
    pub(crate) resume: bool,
    /// Print only warnings and errors
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Where reduced bodies are kept
    #[command(flatten)]
    pub(crate) cache: CacheArguments,
}

/// Arguments of `whirl sweep`.
#[derive(Debug, Args)]
pub(crate) struct SweepArguments {
    /// Path of a sweep file; or, with `--vary`, of a case file, or the name of a built-in case
    pub(crate) file: String,
    /// A key of the case and its values, such as "springs.radial_clearance=20 um .. 60 um, 9"; may be repeated
    #[arg(long, value_name = "KEY=RANGE")]
    pub(crate) vary: Vec<String>,
    /// An analysis to do at every point in place of a run, by its name or kind; may be repeated
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub(crate) analyse: Vec<String>,
    /// Folder for the results [default: results/NAME, with the name of the sweep]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write no figures
    #[arg(long)]
    pub(crate) no_figures: bool,
    /// Write no report.html
    #[arg(long)]
    pub(crate) no_report: bool,
    /// Number of points to run at a time [default: one per core]
    #[arg(long, value_name = "N", value_parser = jobs, allow_negative_numbers = true)]
    pub(crate) jobs: Option<NonZeroUsize>,
    /// Resume an unfinished sweep in the same folder
    #[arg(long)]
    pub(crate) resume: bool,
    /// Print only warnings and errors
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Where reduced bodies are kept
    #[command(flatten)]
    pub(crate) cache: CacheArguments,
}

impl SweepArguments {
    /// What they ask for.
    pub(crate) fn order(&self) -> Order<'_> {
        Order {
            file: &self.file,
            vary: &self.vary,
            analyses: &self.analyse,
            out: self.out.as_deref(),
            figures: !self.no_figures,
            report: !self.no_report,
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
    /// Name of one analysis [default: all]
    pub(crate) name: Option<String>,
    /// Where results go
    #[command(flatten)]
    pub(crate) results: AnalysisOutput,
}

/// Arguments of `whirl lateral`.
#[derive(Debug, Args)]
pub(crate) struct LateralArguments {
    /// Path of a case file with an [analysis.NAME] of the kind "lateral"
    pub(crate) case: String,
    /// Where results go
    #[command(flatten)]
    pub(crate) results: AnalysisOutput,
}

/// Arguments of `whirl map`.
#[derive(Debug, Args)]
pub(crate) struct MapArguments {
    /// Path of a case file, or the name of a built-in case (see `whirl list`)
    pub(crate) case: String,
    /// Stiffness of every joint along x and y, a range such as "1e5 N/m .. 1e10 N/m, 41, log"
    #[arg(long, value_name = "RANGE")]
    pub(crate) stiffness: Option<String>,
    /// The body whose speed it is; the fastest, if left out
    #[arg(long, value_name = "BODY")]
    pub(crate) of: Option<String>,
    /// How many critical speeds, the slowest ones
    #[arg(long, value_name = "N", default_value_t = MODES, value_parser = modes, allow_negative_numbers = true)]
    pub(crate) count: usize,
    /// Where results go
    #[command(flatten)]
    pub(crate) results: AnalysisOutput,
}

/// Arguments of `whirl modes`, `campbell`, `response`, `coefficients`, `stability`, `torsion` and `forces`.
#[derive(Debug, Args)]
pub(crate) struct ModesArguments {
    /// Path of a case file, or the name of a built-in case (see `whirl list`)
    pub(crate) case: String,
    /// One speed, such as "3000 rpm", or a range, such as "0 rpm .. 30000 rpm, 61" [default: from the speeds of the case]
    #[arg(long, value_name = "SPEEDS", alias = "speed", allow_hyphen_values = true)]
    pub(crate) speeds: Option<String>,
    /// The body whose speed it is [default: the fastest]
    #[arg(long, value_name = "BODY")]
    pub(crate) of: Option<String>,
    /// Number of modes, lowest first
    #[arg(long, value_name = "N", default_value_t = MODES, value_parser = modes, allow_negative_numbers = true)]
    pub(crate) count: usize,
    /// Orders for critical speeds, such as 1,2
    #[arg(long, value_name = "ORDERS", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) orders: Vec<f64>,
    /// Where results go
    #[command(flatten)]
    pub(crate) results: AnalysisOutput,
}

/// Arguments of `whirl matrices`.
#[derive(Debug, Args)]
pub(crate) struct MatricesArguments {
    /// Path of a case file, or the name of a built-in case (see `whirl list`)
    pub(crate) case: String,
    /// One speed such as "3000 rpm", or a range such as "0 rpm .. 30000 rpm, 61"; that of the case, if left out
    #[arg(long, value_name = "SPEEDS", alias = "speed", allow_hyphen_values = true)]
    pub(crate) speeds: Option<String>,
    /// The body whose speed it is; the fastest, if left out
    #[arg(long, value_name = "BODY")]
    pub(crate) of: Option<String>,
    /// What the files are
    #[arg(long, value_name = "FORMAT", value_enum, default_value_t)]
    pub(crate) format: MatrixFormat,
    /// Folder for the files (`results` and the name of the case, if left out)
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print only warnings and errors
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Where reduced machines are kept
    #[command(flatten)]
    pub(crate) cache: CacheArguments,
}

/// Arguments of `whirl export`.
#[derive(Debug, Args)]
pub(crate) struct ExportArguments {
    /// Path of a case file, or the name of a built-in case (see `whirl list`)
    pub(crate) case: String,
    /// The unit
    #[arg(long, value_name = "FILE")]
    pub(crate) fmu: PathBuf,
    /// A key of the case whose value may be set, such as springs.radial_clearance; may be repeated
    #[arg(long = "parameter", value_name = "KEY")]
    pub(crate) parameters: Vec<String>,
    /// The library of units [default: the one beside the program]
    #[arg(long, value_name = "FILE")]
    pub(crate) library: Option<PathBuf>,
    /// Print only warnings and errors
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Where reduced bodies are kept
    #[command(flatten)]
    pub(crate) cache: CacheArguments,
}

/// Where the results of analyses go.
#[derive(Debug, Args)]
pub(crate) struct AnalysisOutput {
    /// Folder for tables and figures [default: results/NAME; modes and coefficients write nothing by default]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Also write every table as Parquet
    #[arg(long)]
    pub(crate) parquet: bool,
    /// Also write every table for MATLAB, with one variable per column
    #[arg(long)]
    pub(crate) mat: bool,
    /// Write no figures
    #[arg(long)]
    pub(crate) no_figures: bool,
    /// Write no report.html
    #[arg(long)]
    pub(crate) no_report: bool,
    /// Print only warnings and errors
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Where reduced bodies are kept
    #[command(flatten)]
    pub(crate) cache: CacheArguments,
}

/// Arguments of `whirl report`.
#[derive(Debug, Args)]
pub(crate) struct ReportArguments {
    /// A folder of results, such as results/weight
    pub(crate) folder: PathBuf,
}

/// Arguments of `whirl check`.
#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// Path of a case or spec file, or the name of a built-in case (see `whirl list`)
    pub(crate) case: String,
    /// Print how much of the static compliance of its mesh each reduced body lacks, at bores and under loads
    #[arg(long)]
    pub(crate) contacts: bool,
    /// Print the full report on every law: range, trends and breaks
    #[arg(long)]
    pub(crate) laws: bool,
    /// Draw bodies made from `sections`, with what stands on them: FILE.svg or FILE.png
    #[arg(long, value_name = "FILE")]
    pub(crate) picture: Option<PathBuf>,
    /// Where reduced bodies are kept
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
    /// What to create
    pub(crate) kind: NewKind,
    /// Name of the file, without .toml [default for a case from other files: case]
    #[arg(value_name = "NAME", required_unless_present_any = ["shaft", "from", "like"])]
    pub(crate) name: Option<String>,
    /// A built-in case to begin with, such as `turbocharger`: `whirl list` names them
    #[arg(long, value_name = "CASE", conflicts_with_all = ["from", "shaft", "support", "units"])]
    pub(crate) like: Option<String>,
    /// A rotor that ROSS saved (.toml or .json): write a case with it, solid, on its bearings and supports
    #[arg(long, value_name = "FILE", conflicts_with_all = ["shaft", "support", "units"])]
    pub(crate) from: Option<PathBuf>,
    /// Mesh of a shaft: write a case with it and the mesh of its support, with bearings where both meet
    #[arg(long, value_name = "FILE", requires = "support")]
    pub(crate) shaft: Option<PathBuf>,
    /// Mesh of the support
    #[arg(long, value_name = "FILE", requires = "shaft")]
    pub(crate) support: Option<PathBuf>,
    /// Units of length, force and mass in both meshes, such as "mm, N, t" [default: guessed from their size]
    #[arg(long, value_name = "UNITS", requires = "shaft")]
    pub(crate) units: Option<String>,
    /// Folder for the file
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
    /// Kind of file; without it, the kinds are listed
    #[arg(value_parser = schema_kinds())]
    pub(crate) kind: Option<String>,
    /// Print the keys as a page in Markdown
    #[arg(long, requires = "kind")]
    pub(crate) page: bool,
}

/// A number of modes; 0 is told where it is used.
fn modes(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| "write a whole number of modes, such as 10".to_owned())
}

/// A number of points that run at a time.
fn jobs(text: &str) -> Result<NonZeroUsize, String> {
    text.parse().map_err(|_| "write a whole number from 1 on, such as 4".to_owned())
}

fn schema_kinds() -> PossibleValuesParser {
    schema::kinds().map(|(name, title, _)| PossibleValue::new(name).help(title)).into()
}

/// Where reduced bodies are kept between runs.
#[derive(Debug, Clone, Args)]
pub(crate) struct CacheArguments {
    /// Folder in which reduced bodies are cached [default: the platform's cache folder]
    #[arg(long, value_name = "DIR", conflicts_with = "no_cache")]
    pub(crate) cache: Option<PathBuf>,
    /// Neither read nor write the cache of reduced bodies
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
