//! Cases, their units, and their runs.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use clap::Parser;
use whirl_cli::arguments::Arguments;
use whirl_cli::simulate::begin;
use whirl_cli::{build, read};

/// A rotor of 4 kg on a bushing and under an unbalance, that turns as it is told and is loaded; with `more`.
pub(crate) fn rotor(more: &str) -> String {
    format!(
        "title = \"a rotor\"\n[body.r]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"4 kg\"\n\
         polar_inertia = \"0.02 kg*m^2\"\nunbalance.u = {{ mass = \"2 g\", radius = \"50 mm\" }}\n\
         [joint.b]\nkind = \"bushing\"\nfirst = {{ body = \"r\" }}\n\
         stiffness = {{ xx = \"1e6 N/m\", yy = \"2e6 N/m\" }}\ndamping = {{ xx = \"200 N*s/m\", yy = \"200 N*s/m\" }}\n\
         [output.a]\nquantity = \"acceleration\"\nbody = \"r\"\n{more}\
         [march]\ntime_step = \"1e-4 s\"\nsteps = 400\n"
    )
}

/// A load along x that is there for the sake of its input.
pub(crate) const PORT: &str = "[loads.port]\nbody = \"r\"\nforce = \"0 N\"\n";

/// A folder with a case, its unit and the unit unpacked.
pub(crate) struct Bench {
    pub(crate) folder: tempfile::TempDir,
}

/// The library, which cargo has built beside this test.
pub(crate) fn library() -> PathBuf {
    use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
    let test = std::env::current_exe().unwrap();
    test.with_file_name(format!("{DLL_PREFIX}whirl_fmu{DLL_SUFFIX}"))
}

impl Bench {
    pub(crate) fn new(case: &str) -> Bench {
        let bench = Bench { folder: tempfile::tempdir().unwrap() };
        bench.file("case.toml", case);
        bench
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn file(&self, name: &str, text: &str) {
        fs::create_dir_all(self.path(name).parent().unwrap()).unwrap();
        fs::write(self.path(name), text).unwrap();
    }

    /// Whether `whirl export` writes the unit of the case as `unit.fmu`.
    pub(crate) fn exports(&self, case: &str, more: &[&str]) -> bool {
        let (fmu, library) = (self.path("unit.fmu"), self.path("library"));
        let at = |path: &Path| path.to_str().unwrap().to_owned();
        let mut line =
            ["whirl", "export", case, "--quiet", "--no-cache"].map(str::to_owned).to_vec();
        line.extend(["--fmu".to_owned(), at(&fmu)]);
        if !more.contains(&"--library") {
            // These tests call the functions of the library themselves: what stands for it is soon packed.
            fs::write(&library, whirl_cli::sources()).unwrap();
            line.extend(["--library".to_owned(), at(&library)]);
        }
        line.extend(more.iter().map(|own| (*own).to_owned()));
        let arguments = Arguments::try_parse_from(line).unwrap();
        // An exit status says nothing of itself but by its words.
        format!("{:?}", whirl_cli::execute(&arguments))
            == format!("{:?}", std::process::ExitCode::SUCCESS)
    }

    /// The unit of the case, unpacked into the folder `unit`.
    pub(crate) fn unit(&self, more: &[&str]) -> PathBuf {
        let case = self.path("case.toml");
        assert!(self.exports(case.to_str().unwrap(), more));
        self.unpack()
    }

    /// Unpacks `unit.fmu`.
    pub(crate) fn unpack(&self) -> PathBuf {
        let folder = self.path("unit");
        for (name, content) in files(&fs::read(self.path("unit.fmu")).unwrap()) {
            let path = folder.join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, content).unwrap();
        }
        folder
    }

    /// The history of a run of a case of the folder, with all digits.
    pub(crate) fn history(&self, name: &str) -> History {
        let mut warnings = Vec::new();
        let case = read(self.path(name).to_str().unwrap(), &mut warnings).unwrap();
        let built = build(&case, None, &mut warnings).unwrap();
        let (mut march, _) = begin(&case, &built).unwrap();
        let names = built.columns().into_iter().map(|own| own.name).collect();
        let mut rows = Vec::new();
        while !march.is_done() {
            march.advance().unwrap();
            rows.push(march.row().to_vec());
        }
        History { names, rows }
    }
}

/// Rows of a run.
pub(crate) struct History {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl History {
    pub(crate) fn rows(&self) -> usize {
        self.rows.len()
    }

    fn outputs(&self) -> impl Iterator<Item = (usize, &String)> {
        let names = self.names.iter().enumerate();
        names.filter(|(_, name)| *name != "t_s" && *name != "iterations")
    }

    /// The columns that are outputs of a unit: all but time and iterations.
    pub(crate) fn names(&self) -> Vec<String> {
        self.outputs().map(|(_, name)| name.clone()).collect()
    }

    /// A row, as far as its columns are outputs.
    pub(crate) fn row(&self, row: usize) -> Vec<f64> {
        self.outputs().map(|(place, _)| self.rows[row][place]).collect()
    }

    pub(crate) fn column(&self, name: &str) -> Vec<f64> {
        let place = self.names.iter().position(|own| own == name);
        let place = place.unwrap_or_else(|| panic!("no `{name}` among {:?}", self.names));
        self.rows.iter().map(|row| row[place]).collect()
    }
}

/// The files of an archive.
pub(crate) fn files(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let number = |at: usize, count: usize| {
        bytes[at..at + count].iter().rev().fold(0, |sum, byte| 256 * sum + usize::from(*byte))
    };
    let last = bytes.len() - 22;
    let mut at = number(last + 16, 4);
    let mut all = Vec::new();
    for _ in 0..number(last + 10, 2) {
        let [packed, length, named, local] =
            [(20, 4), (24, 4), (28, 2), (42, 4)].map(|(own, count)| number(at + own, count));
        let name = String::from_utf8(bytes[at + 46..at + 46 + named].to_vec()).unwrap();
        let own = local + 30 + named;
        let mut content = Vec::new();
        let mut reader = flate2::read::DeflateDecoder::new(&bytes[own..own + packed]);
        reader.read_to_end(&mut content).unwrap();
        assert_eq!(content.len(), length, "{name}");
        all.push((name, content));
        at += 46 + named;
    }
    all
}
