//! What a body that turns carries beside its mesh: `[body.NAME.disc.NAME]`, `[body.NAME.added.NAME]` and
//! `[body.NAME.unbalance.NAME]`.

use whirl_codegen::diagnostic::Code;
use whirl_codegen::document::Table;
use whirl_solver::model::AttachmentKind;

use super::fit;
use crate::case::named_body::Attached;
use crate::case::names;

/// What a body that turns carries, discs first; those on another one are noted.
pub(super) fn read(table: &Table, turns: bool, meshed: bool, tilts: bool) -> Vec<Attached> {
    let mut all = Vec::new();
    let discs = names::in_order(table, "disc");
    names::plain(table, "disc", discs.iter().map(|(name, _)| name));
    for (name, own) in discs {
        all.push(own.read(|own| {
            own.demand("z");
            let mass = own.quantity_or_one("mass");
            let [polar, transverse] =
                ["polar_inertia", "transverse_inertia"].map(|key| own.quantity(key));
            fit::inertias(own, polar, transverse);
            let what = AttachmentKind::Disc {
                mass,
                polar_inertia: polar.unwrap_or(1.0),
                diametral_inertia: transverse.unwrap_or(1.0),
            };
            Attached { name, z: own.quantity("z").unwrap_or(0.0), what }
        }));
    }
    if let (Some(disc), false) = (all.first(), turns && meshed) {
        let message = "a disc is carried by a mesh that turns".to_owned();
        let help = "a rigid body has its inertia in `mass`, `polar_inertia` and `transverse_inertia`; \
                    on a body that does not turn it is a part of the mesh";
        table.push(disc.name.error_here(Code::BAD_VALUE, message).help(help));
    }
    for (key, called) in [("added", "an added mass"), ("unbalance", "an unbalance")] {
        let own = names::in_order(table, key);
        names::plain(table, key, own.iter().map(|(name, _)| name));
        for (name, own) in own {
            if !turns {
                let message = format!("{called} is of a body that turns");
                let help = "take it out, or let the body turn";
                table.push(name.error_here(Code::BAD_VALUE, message).help(help));
            }
            all.push(own.read(|own| {
                if tilts {
                    own.demand("z");
                }
                let mass = own.quantity_or_one("mass");
                let (sin, cos) = own.quantity("angle").unwrap_or(0.0).sin_cos();
                let what = if key == "added" {
                    let radius = own.quantity("radius").unwrap_or(0.0);
                    AttachmentKind::Mass { mass, offset: [radius * cos, radius * sin] }
                } else {
                    let moment = mass * own.quantity_or_one("radius");
                    AttachmentKind::Unbalance([moment * cos, moment * sin])
                };
                Attached { name, z: own.quantity("z").unwrap_or(0.0), what }
            }));
        }
    }
    all
}
