//! On what the numbers of a sweep depend beside the values of its points.

use std::collections::BTreeMap;
use std::fs;

use whirl_solver::cache::{Key, instruction_set};

use super::definition::{Keep, Sweep};
use crate::case::Case;
use crate::checkpoint::Identity;
use crate::results::STATE;
use crate::{machine, version};

/// Hashes of files and of what is made of them, by what messages call them.
#[derive(Debug, Default)]
pub(super) struct Inputs(BTreeMap<String, String>);

impl Inputs {
    /// Takes in what a case names beside its texts: meshes, and the state in which another run ended.
    pub(super) fn add(&mut self, case: &Case) {
        let state = case.goes_on_from().map(|folder| folder.join(STATE));
        for path in case.other_files().into_iter().chain(state) {
            let what = format!("the file `{}`", path.display());
            if !self.0.contains_key(&what)
                && let Ok(bytes) = fs::read(&path)
            {
                self.0.insert(what, Key::of(&bytes).hex());
            }
        }
    }

    /// Takes in what is made of the meshes of a case that can be built.
    pub(super) fn add_bodies(&mut self, case: &Case) {
        for (place, key) in machine::keys(case).into_iter().flatten().enumerate() {
            let what = format!("body {} of the case, or what is made of its mesh", place + 1);
            self.0.insert(what, key.hex());
        }
    }

    /// With the texts that were read for the sweep, for this program on this processor.
    pub(super) fn identity(mut self, sweep: &Sweep) -> Identity {
        let Sweep {
            // By which its results are called.
            name: _,
            title: _,
            base,
            // Points are known by their values and by those from which they go on: a sweep may get further ones.
            source: _,
            keys: _,
            axes: _,
            along: _,
            samples: _,
            keep,
            marches,
            analyses,
        } = sweep;
        for source in base.noted() {
            let what = format!("the file `{}`", source.path.display());
            self.0.insert(what, Key::of(&source.text).hex());
        }
        let own = base.path().display().to_string();
        self.0.insert(format!("the case `{own}`"), Key::of(&base.text()).hex());
        let keep = match keep {
            Keep::Nothing => "nothing",
            Keep::Histories => "histories",
        };
        let analyses: Vec<&str> = analyses.iter().map(|own| own.text()).collect();
        let fixed = [
            ("the program", version::SOURCES.to_owned()),
            ("the kind of processor", instruction_set()),
            ("`keep`", keep.to_owned()),
            ("`analyse`", analyses.join(", ")),
            ("`march`", marches.to_string()),
        ];
        let fixed = fixed.map(|(what, value)| (what.to_owned(), value));
        Identity::new(fixed.into_iter().chain(self.0).collect())
    }
}
