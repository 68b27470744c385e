//! A case: what a case file says, in SI, checked as far as it can be without building the machine.

mod analyses;
mod columns;
mod cycle;
mod dimensions;
mod embedded;
mod fields;
mod files;
mod film;
mod film_arc;
mod film_bore;
mod film_heat;
mod film_march;
mod film_table;
mod gears;
mod gravity;
mod ground;
mod joined;
mod joined_machine;
mod joint;
mod lateral;
mod law;
mod library;
mod loads;
mod machine;
mod march;
mod mass;
mod named_body;
mod names;
mod outputs;
mod parameters;
mod periodic;
mod read;
mod reduction;
mod rotor;
mod run;
mod schema;
pub(crate) mod sections;
mod selections;
mod shapes;
mod start;
mod stop;
mod supports;
mod text;
mod units;
mod values;

use std::path::Path;
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Source};

use crate::errors::Failure;

pub(crate) use analyses::{
    Analysis, AnalysisKind, MODES, MatrixFormat, each_once, speeds, stiffness, turning,
};
pub(crate) use columns::Columns;
pub(crate) use cycle::TWO_REVOLUTIONS;
pub(crate) use dimensions::Dimensions;
pub(crate) use embedded::{embedded_case, embedded_cases};
pub(crate) use fields::Fields;
pub(crate) use gears::Gears;
pub(crate) use gravity::Gravity;
pub(crate) use ground::GroundMotion;
pub(crate) use joined::axes_apart;
pub(crate) use joined_machine::{
    Drive as JoinedDrive, InputForm, JoinedMachine, Load as JoinedLoad,
};
pub(crate) use joint::{Joint, JointKind, Side as JointSide};
pub(crate) use lateral::{Lateral, Stage, StageSource, Variant};
pub(crate) use law::{LawSource, NamedLaw};
pub(crate) use library::{FileStore, refused};
pub(crate) use loads::{Load, Spread};
pub(crate) use march::MarchSettings;
pub(crate) use named_body::{Attached, Form, MeshedBody, NamedBody};
pub(crate) use outputs::{Output, OutputPoint};
pub(crate) use parameters::{BearingFacts, SetParameter, rounded};
pub(crate) use periodic::{Beginning, PeriodicKeys, Varying};
pub(crate) use read::read;
pub(crate) use read::{Draft, Purpose, draft, draft_of, draft_with};
pub(crate) use rotor::{
    Bearing, Body, Drive, GeneratedMesh, MatrixFiles, Mesh, MeshFile, Region, StaticCorrection,
};
pub(crate) use run::Run;
pub(crate) use selections::NamedSelection;
pub(crate) use start::Start;
pub(crate) use supports::SupportName;
pub use text::CaseText;
pub(crate) use units::mesh_units;

/// One case, ready to be built.
#[derive(Debug, Clone)]
pub struct Case {
    /// Name under which results are kept: that of the file without its ending.
    pub(crate) name: String,
    /// One-line description.
    pub(crate) title: String,
    /// Paper, standard or book; empty if the case does not say.
    pub(crate) origin: String,
    /// The files read, the case itself first.
    pub(crate) sources: Vec<Arc<Source>>,
    /// What is marched.
    pub(crate) machine: Box<JoinedMachine>,
    /// Time step, duration and tolerances; none of a case that is only analysed.
    pub(crate) march: Option<MarchSettings>,
    /// How it begins.
    pub(crate) start: Start,
    /// Bytes that reductions may take, if it says so.
    pub(crate) memory_limit: Option<usize>,
    /// What the history has beside its usual columns.
    pub(crate) outputs: Vec<Output>,
    /// What is written of whole bodies.
    pub(crate) fields: Option<Fields>,
    /// Small motions about steady states.
    pub(crate) analyses: Vec<Analysis>,
    /// What figures show beyond the results.
    pub(crate) figures: Figures,
}

impl Case {
    /// How long it runs.
    pub(crate) fn run(&self) -> Run {
        let goes_on = matches!(self.start, Start::State(_) | Start::After(_));
        Run { duration: self.march.as_ref().map_or(0.0, MarchSettings::duration), goes_on }
    }

    /// How it is marched.
    ///
    /// # Errors
    /// It is only analysed, or a joint has coefficients that no march knows.
    pub(crate) fn marched(&self) -> Result<&MarchSettings, Failure> {
        self.without_frequencies()?;
        self.march.as_ref().ok_or_else(|| Failure::Argument {
            message: format!("`{}` has no `[march]`: it can be analysed, not run", self.name),
            help: "add `[march]` with `time_step` and `duration`, or try `whirl analyse`"
                .to_owned(),
        })
    }

    /// That a motion in time knows the coefficients of all joints.
    ///
    /// # Errors
    /// Some depend on the frequency.
    pub(crate) fn without_frequencies(&self) -> Result<(), Failure> {
        let over_frequency = |own: &&Joint| own.bearing.law.source.over_frequency().is_some();
        if let Some(joint) = self.machine.joints.iter().find(over_frequency) {
            let place = joint.table.as_ref().unwrap_or(&joint.name);
            let message = format!(
                "the coefficients of `{}` depend on the frequency, which a motion in time does not have",
                joint.name.text()
            );
            let help = "use it in linear analyses; for a run give the coefficients over the speed alone: `whirl coefficients` writes those at the frequency of the rotation; `whirl.fit_law` in Python makes a law with states of such a table";
            let error = place.error_here(Code::BAD_VALUE, message).help(help);
            return Err(Failure::Input(error.into()));
        }
        Ok(())
    }

    /// How it is marched, once that is known to be.
    pub(crate) fn march(&self) -> &MarchSettings {
        self.march.as_ref().expect("a case that is marched")
    }

    /// Name under which results are kept.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// One-line description.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The files read, the case itself first: paths and texts.
    pub fn files(&self) -> impl Iterator<Item = (&Path, &str)> {
        self.sources.iter().map(|source| (source.path.as_path(), source.text.as_str()))
    }

    /// Whether it says how it is marched.
    pub fn is_marched(&self) -> bool {
        self.march.is_some()
    }

    /// Steps that are asked for; rows where the program chooses the steps.
    pub fn steps(&self) -> usize {
        self.march.as_ref().map_or(0, |own| own.steps)
    }

    /// Rows of a history with all steps.
    pub fn rows(&self) -> usize {
        self.march.as_ref().map_or(0, |own| own.steps / own.output_every)
    }
    /// Numbers of its supports or stops, or names of its joints.
    pub fn support_names(&self) -> Vec<String> {
        let short = |own: SupportName| own.label.strip_prefix('_').unwrap_or(&own.label).to_owned();
        self.supports().into_iter().map(short).collect()
    }

    /// What results call the supports, in order.
    pub(crate) fn supports(&self) -> Vec<SupportName> {
        self.machine.joints.iter().map(|own| own.called.clone()).collect()
    }

    /// What is done to its bodies, for a progress bar.
    pub(crate) fn reducing(&self) -> &'static str {
        match self.machine.form {
            InputForm::Shaft => "reducing shaft and support",
            InputForm::Named | InputForm::Mass => "reducing bodies",
        }
    }

    /// Names of the bodies that turn, of a case that names bodies.
    pub(crate) fn turning(&self) -> Vec<String> {
        let turning = self.machine.bodies.iter().filter(|body| body.turns());
        let turning = turning.filter(|_| self.machine.is_named());
        turning.map(|body| body.name.text().to_string()).collect()
    }
}

/// Numbers of the figures in the paper, for titles; a figure without number is drawn all the same.
#[derive(Debug, Clone, Default)]
pub(crate) struct Figures {
    /// Laws drawn beside each other; those of the case if it names none.
    pub(crate) laws: Vec<LawSource>,
    /// Q–h of the laws.
    pub(crate) law: Option<usize>,
    /// Reactions RX, RY.
    pub(crate) reactions: Option<usize>,
    /// Eccentricity orbits.
    pub(crate) eccentricity: Option<usize>,
    /// Angle and speed of rotation.
    pub(crate) rotation: Option<usize>,
}
