//! The law of a spring: a built-in one by name, or a spec file by path.

use std::path::Path;
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source, suggest};
use whirl_codegen::document::Table;
use whirl_codegen::kinds::law::{Acts, BearingValue, Given, LawSpec, Parameter};
use whirl_solver::bearing::{FilmLaw, FrequencyTable, MotionKind};
use whirl_solver::output::StateOfLaw;
use whirl_specs::{LAWS, Law, TABLES};

use super::film::{self, FilmSource};
use super::library::FileStore;
use super::values::listed;

/// Where a law comes from.
#[derive(Debug, Clone)]
pub(crate) enum LawSource {
    /// Compiled into the program.
    BuiltIn(&'static Law),
    /// A spec file, evaluated at run time.
    File(Arc<LawSpec>),
    /// Either with other values of its parameters than its file has.
    Given(Arc<GivenLaw>),
    /// A film, which is its joint's alone.
    Film(Arc<FilmSource>),
}

/// A law with other values of its parameters than its file has, evaluated at run time.
#[derive(Debug)]
pub(crate) struct GivenLaw {
    /// The law with these values.
    pub(crate) spec: Arc<LawSpec>,
    /// The values.
    pub(crate) given: Vec<Given>,
    /// What results call it: the law, and the values in parentheses.
    pub(crate) name: String,
    /// Coefficients over the frequency of small motions, those of the law being of what stands still.
    pub(crate) over_frequency: Option<FrequencyFile>,
}

/// A file of coefficients over speed and frequency.
#[derive(Debug)]
pub(crate) struct FrequencyFile {
    /// What it says.
    pub(crate) table: FrequencyTable,
    /// The file.
    pub(crate) file: Arc<Source>,
}

/// A law, and where the case names it.
#[derive(Debug, Clone)]
pub(crate) struct NamedLaw {
    /// The law, with the values in its file.
    pub(crate) source: LawSource,
    /// The value of the key `law`.
    pub(crate) name: Located,
}

impl LawSource {
    /// How results call the law: its name, or the path of its file.
    pub(crate) fn name(&self) -> String {
        match self {
            LawSource::BuiltIn(law) => law.origin.name.to_string(),
            LawSource::File(spec) => spec.file.path.display().to_string(),
            LawSource::Given(law) => law.name.clone(),
            LawSource::Film(film) => film.name(),
        }
    }

    /// The film that it is, if it is one.
    pub(crate) fn film(&self) -> Option<&FilmSource> {
        match self {
            LawSource::Film(film) => Some(film),
            LawSource::BuiltIn(_) | LawSource::File(_) | LawSource::Given(_) => None,
        }
    }

    /// The file of its coefficients over the frequency of small motions, if it has one.
    pub(crate) fn over_frequency(&self) -> Option<&FrequencyFile> {
        match self {
            LawSource::Given(law) => law.over_frequency.as_ref(),
            LawSource::BuiltIn(_) | LawSource::File(_) | LawSource::Film(_) => None,
        }
    }

    /// Whether the law is one of springs, of rings or of joints.
    pub(crate) fn acts(&self) -> Acts {
        match self {
            LawSource::BuiltIn(law) => {
                let all = law.inputs.iter().chain(law.outputs);
                let has = |acts: &Acts| {
                    let known = || acts.inputs().iter().chain(acts.outputs());
                    all.clone().all(|own| known().any(|known| known.name == own.name))
                };
                Acts::ALL.into_iter().find(has).unwrap_or(Acts::Spring)
            }
            LawSource::File(spec) => spec.acts,
            LawSource::Given(law) => law.spec.acts,
            LawSource::Film(_) => Acts::Joint,
        }
    }

    /// Names of what the law takes and gives.
    fn names(&self) -> Vec<String> {
        let of = |spec: &LawSpec| {
            let inputs = spec.taken().iter().map(|own| own.name.clone());
            inputs.chain(spec.given().iter().map(|own| own.name.clone())).collect()
        };
        match self {
            LawSource::BuiltIn(law) => {
                let all = law.inputs.iter().chain(law.outputs);
                all.map(|own| own.name.to_string()).collect()
            }
            LawSource::File(spec) => of(spec),
            LawSource::Given(law) => of(&law.spec),
            LawSource::Film(_) => {
                FilmLaw::TAKEN.iter().chain(&FilmLaw::GIVEN).map(|own| (*own).to_owned()).collect()
            }
        }
    }

    /// What it remembers, with SI units.
    pub(crate) fn states(&self) -> Vec<StateOfLaw> {
        let of = |spec: &LawSpec| {
            let own = spec.remembered().iter().map(|own| StateOfLaw {
                name: own.name.clone(),
                unit: own.unit.dimension().si_unit(),
            });
            own.collect()
        };
        match self {
            LawSource::BuiltIn(law) => {
                let own = law.states.iter().map(|own| StateOfLaw {
                    name: own.variable.name.to_owned(),
                    unit: own.variable.unit.to_owned(),
                });
                own.collect()
            }
            LawSource::File(spec) => of(spec),
            LawSource::Given(law) => of(&law.spec),
            LawSource::Film(_) => Vec::new(),
        }
    }

    /// Whether the law turns or brakes the journal: by a moment, or by a force at its surface.
    pub(crate) fn gives_torque(&self) -> bool {
        self.names().iter().any(|name| name == "M_z" || name == "T" || name == "F_n")
    }

    /// An output whose file accepts that it jumps, if there is one.
    pub(crate) fn accepts_jump(&self) -> Option<&str> {
        let spec = match self {
            // None of those has one.
            LawSource::BuiltIn(_) | LawSource::Film(_) => return None,
            LawSource::File(spec) => spec,
            LawSource::Given(law) => &law.spec,
        };
        spec.outputs.iter().find(|own| own.accepts_jumps).map(|own| own.name.as_str())
    }

    /// Whether the law gives a force on a motion beside those in the plane.
    pub(crate) fn acts_on(&self, motion: MotionKind) -> bool {
        let forces: &[&str] = match motion {
            MotionKind::Tilts => &["M_x", "M_y"],
            MotionKind::Along => &["F_z"],
        };
        self.names().iter().any(|name| forces.contains(&name.as_str()))
    }

    /// Whether it gives such a force, or takes such a motion.
    pub(crate) fn needs(&self, motion: MotionKind) -> bool {
        let taken: &[&str] = match motion {
            MotionKind::Tilts => &["alpha_x", "alpha_y", "alpha_x_dot", "alpha_y_dot"],
            MotionKind::Along => &["e_z", "e_z_dot"],
        };
        self.acts_on(motion) || self.names().iter().any(|name| taken.contains(&name.as_str()))
    }

    /// Whether the law takes rates of the journal but no speed: in a bore that turns it damps against the bore.
    pub(crate) fn damps_against_bore(&self) -> bool {
        let names = self.names();
        let takes = |name: &str| names.iter().any(|own| own == name);
        ["h_dot", "e_x_dot", "e_y_dot"].into_iter().any(takes) && !takes("omega")
    }

    /// What of the law needs the radius of the journal, if anything does.
    pub(crate) fn at_surface(&self) -> Option<&'static str> {
        let names = self.names();
        ["v_t", "T"].into_iter().find(|name| names.iter().any(|own| own == name))
    }

    /// The spec, read again for a built-in law; none of a film, which is a spec of another kind.
    ///
    /// # Panics
    /// If a built-in law has errors: it was read without any when its kernel was generated.
    pub(crate) fn spec(&self) -> Option<Arc<LawSpec>> {
        Some(match self {
            LawSource::BuiltIn(law) => {
                let spec = LawSpec::read_with(&source_of(law), &|name| built_in_table(law, name));
                Arc::new(spec.expect("built-in laws have no errors"))
            }
            LawSource::File(spec) => spec.clone(),
            LawSource::Given(law) => law.spec.clone(),
            LawSource::Film(_) => return None,
        })
    }

    /// The parameters as the file has them.
    ///
    /// # Panics
    /// As [`LawSource::spec`].
    pub(crate) fn parameters(&self) -> Vec<Parameter> {
        match self {
            LawSource::BuiltIn(law) => {
                let found =
                    LawSpec::parameters_of(&source_of(law), &|name| built_in_table(law, name));
                found.expect("built-in laws have no errors")
            }
            LawSource::File(spec) => spec.parameters.clone(),
            LawSource::Given(law) => law.spec.parameters.clone(),
            LawSource::Film(film) => film.parameters(),
        }
    }

    /// Its parameters that have the values of its file, as people write them; none if there are none.
    pub(crate) fn told_of_file(&self) -> Option<String> {
        let set: Vec<&str> = match self {
            LawSource::Given(law) => law.given.iter().map(|own| own.name.as_str()).collect(),
            LawSource::Film(film) => film.set(),
            LawSource::BuiltIn(_) | LawSource::File(_) => Vec::new(),
        };
        // Those of the joint of a film have no values of a file, and a clearance is told by itself.
        let told = |of: BearingValue| {
            matches!(of, BearingValue::RadialClearance | BearingValue::DiametralClearance)
        };
        let of_file =
            |own: &Parameter| own.bearing.is_none_or(|of| self.film().is_none() && !told(of));
        let rest = self.parameters().into_iter().filter(|own| of_file(own));
        let rest = rest.filter(|own| !set.contains(&own.name.as_str()));
        let rest: Vec<Given> =
            rest.map(|own| Given { name: own.name, value: own.written, unit: own.unit }).collect();
        (!rest.is_empty()).then(|| listed(&rest))
    }

    /// The law with these values in place of those in its file; itself if there are none.
    ///
    /// # Errors
    /// Whatever is wrong with the law once it has them.
    pub(crate) fn with(&self, given: Vec<Given>) -> Result<LawSource, Diagnostics> {
        if given.is_empty() {
            return Ok(self.clone());
        }
        let spec = match self {
            LawSource::BuiltIn(law) => {
                let beside = |name: &str| built_in_table(law, name);
                LawSpec::read_given(&source_of(law), &beside, &given)
            }
            LawSource::File(spec) => spec.read_again(&given),
            LawSource::Given(law) => law.spec.read_again(&given),
            LawSource::Film(film) => return Ok(LawSource::Film(Arc::new(film.with(given)?))),
        };
        let values = listed(&given);
        let named = |mut error: Diagnostic| {
            error.message = format!("{} (with {values}, as set in the case)", error.message);
            error
        };
        let joined = |mut all: Diagnostics, error| {
            all.push(error);
            all
        };
        let spec =
            spec.map_err(|errors| errors.into_iter().map(named).fold(Diagnostics::new(), joined))?;
        let name = format!("{} ({values})", self.name());
        let spec = Arc::new(spec);
        Ok(LawSource::Given(Arc::new(GivenLaw { spec, given, name, over_frequency: None })))
    }
}

fn source_of(law: &Law) -> Arc<Source> {
    Source::new(format!("specs/{}", law.origin.spec), law.origin.text)
}

/// The file of columns called `name` beside a built-in law.
fn built_in_table(law: &Law, name: &str) -> Result<Arc<Source>, String> {
    let path = Path::new(law.origin.spec).with_file_name(name);
    let found = TABLES.iter().find(|(other, _)| Path::new(other) == path);
    let (_, text) = found.ok_or_else(|| format!("there is no file `{name}`"))?;
    Ok(Source::new(Path::new("specs").join(path), *text))
}

/// The law that `law` of a table names, and where it does, if the key is there.
pub(super) fn read(store: FileStore, table: &Table) -> Option<NamedLaw> {
    let name = table.optional_string("law")?;
    find(store, table, &name).map(|source| NamedLaw { source, name })
}

/// The law or the film that `law` of the table of a joint names, if the key is there; what the table says of a film is read
/// with it.
pub(super) fn read_of_joint(store: FileStore, table: &Table) -> Option<NamedLaw> {
    let name = table.optional_string("law")?;
    let Some(kernel) = film::shipped(name.text()) else {
        if film::pass(store, table, &name) {
            let message = format!("`{}` is no film: it has no use for a table `film`", name.text());
            let help =
                format!("leave the table out, or name a film: `{}`", film::names().join("`, `"));
            table.push(table.written("film").error_here(Code::BAD_VALUE, message).help(help));
        }
        return find(store, table, &name).map(|source| NamedLaw { source, name });
    };
    let source = LawSource::Film(Arc::new(FilmSource::read(store, table, kernel, &name)));
    Some(NamedLaw { source, name })
}

/// Whether a table names a law that gives a force along z; a law that cannot be read does not, and nothing is noted.
pub(super) fn acts_along(store: FileStore, table: &Table) -> bool {
    if !table.gives("law") {
        return false;
    }
    let written = table.written("law");
    let name = written.text().trim_matches(['"', '\'']);
    let source = if name.ends_with(".toml") {
        let file = store.read_beside(written.source(), name).ok();
        let spec = file.and_then(|file| {
            LawSpec::read_with(&file, &|name| store.read_beside(&file, name)).ok()
        });
        spec.map(|spec| LawSource::File(Arc::new(spec)))
    } else {
        LAWS.iter().find(|law| law.origin.name == name).map(LawSource::BuiltIn)
    };
    source.is_some_and(|law| law.acts_on(MotionKind::Along))
}

/// The law called `name`; what is wrong with it is noted in `table`.
pub(super) fn find(store: FileStore, table: &Table, name: &Located) -> Option<LawSource> {
    if name.text().ends_with(".toml") {
        return read_file(store, table, name);
    }
    let law = LAWS.iter().find(|law| law.origin.name == name.text());
    if law.is_none() && film::shipped(name.text()).is_some() {
        let message = format!("`{}` is a film, which is between a journal and a bore", name.text());
        let help =
            "name it in a table `[joint.NAME]` with `kind = \"bearing\"`, or take a law here";
        table.push(name.error_here(Code::BAD_VALUE, message).help(help));
    } else if law.is_none() {
        let known: Vec<&str> = LAWS.iter().map(|law| law.origin.name).collect();
        let message = format!("there is no law `{}`", name.text());
        let error = name.error_here(Code::BAD_VALUE, message);
        table.push(error.maybe_help(suggest(name.text(), &known)));
    }
    law.map(LawSource::BuiltIn)
}

fn read_file(store: FileStore, table: &Table, name: &Located) -> Option<LawSource> {
    let source = store.read_named(table, name)?;
    match LawSpec::read_with(&source, &|name| store.read_beside(&source, name)) {
        Ok(spec) => Some(LawSource::File(Arc::new(spec))),
        Err(errors) => {
            errors.into_iter().for_each(|error| table.push(error));
            None
        }
    }
}
