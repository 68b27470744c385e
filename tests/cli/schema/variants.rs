//! Keys of files that exclude each other.

/// What files of named bodies have not, and keys whose errors would take the place of others.
const SHORT: &str = "include /start/kind /march/duration /march/stop_when_steady /march/step_tolerance /march/spectral_radius \
    /figures/laws /fields/bodies /shaft /support /springs /bearing /drive /load /mass /stop";

/// Keys of lateral analyses, which others refuse.
const LATERAL: &str = "/analysis/chosen/edition /analysis/chosen/minimum_speed /analysis/chosen/maximum_speed \
    /analysis/chosen/trip_speed /analysis/chosen/probes /analysis/chosen/probe_angle \
    /analysis/chosen/clearances /analysis/chosen/scale_limit /analysis/chosen/unbalance_modes \
    /analysis/chosen/unbalance /analysis/chosen/journal_loads /analysis/chosen/stages \
    /analysis/chosen/cross_coupling_z /analysis/chosen/gas_density /analysis/chosen/seals \
    /analysis/chosen/variants";

/// Of a file with such an analysis, what other files show.
const FOR_LATERAL: [&str; 7] = [
    "/analysis/chosen/kind=lateral",
    "/march/step_tolerance",
    "/march/spectral_radius",
    "/march/stop_when_steady",
    "/march/duration",
    "/shaft/sets",
    "/support/sets",
];

/// Keys of periodic analyses, which others refuse.
const PERIODIC: &str = "/analysis/chosen/self_excited /analysis/chosen/near /analysis/chosen/steps /analysis/chosen/method /analysis/chosen/harmonics /analysis/chosen/marched /analysis/chosen/periods \
    /analysis/chosen/begin /analysis/chosen/cycles /analysis/chosen/vary /analysis/chosen/points /analysis/chosen/doublings";

/// Keys of analyses of one kind, which others refuse.
const OF_KINDS: [(&str, &str); 6] = [
    (KINDS[0], "/analysis/chosen/margin"),
    (KINDS[0], "/analysis/chosen/operation"),
    (KINDS[0], "/analysis/chosen/mesh_orders"),
    (KINDS[1], "/analysis/chosen/stiffness"),
    (KINDS[2], "/analysis/chosen/stations"),
    (KINDS[3], "/analysis/chosen/format"),
];
const KINDS: [&str; 4] = [
    "/analysis/chosen/kind=torsion",
    "/analysis/chosen/kind=map",
    "/analysis/chosen/kind=forces",
    "/analysis/chosen/kind=matrices",
];

/// Of files of named bodies: each of the ways in which one turns, with each kind of joint.
const NAMED: [&str; 8] = [
    "/body/chosen/turns=free /body/chosen/mass_damping /output/chosen/joint /fields/bodies matrices rigid moves_along_z static_correction dimensions /body/chosen/mass polar_inertia transverse_inertia /body/chosen/z \
     /body/chosen/stiffness /body/chosen/damping /body/chosen/speed /body/chosen/table acceleration held ground_spring \
     /joint/chosen/film/heat/temperature /joint/chosen/film/heat/viscosity \
     /joint/chosen/kind=bearing first second side gap /joint/chosen/stiffness /joint/chosen/damping \
     /joint/chosen/table tilting_stiffness tilting_damping axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=prescribed /body/chosen/mass_damping /output/chosen/joint /fields/bodies mesh matrices units merge dimensions rigid /body/chosen/material regions /body/chosen/sets modes \
     /body/chosen/stiffness /body/chosen/damping initial_speed held ground_spring axial_restraint section \
     stiffening /joint/chosen/kind=stop film /joint/chosen/sensor first second /joint/chosen/springs radial_clearance stations \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=no /output/chosen/joint /fields/bodies mesh matrices units merge rigid moves_along_z diameter throw pin_diameter pin_length web_width web_thickness supports support_length layers_in_support \
     /body/chosen/dimensions/loads sectors /body/chosen/dimensions/cells/rings tolerance /body/chosen/mass \
     polar_inertia transverse_inertia /body/chosen/z /body/chosen/stiffness /body/chosen/damping \
     /body/chosen/speed /body/chosen/table acceleration initial_speed section stiffening /joint/chosen/kind=bushing film /joint/chosen/sensor journal bore /joint/chosen/table \
     /joint/chosen/law parameters /joint/chosen/springs radial_clearance journal_radius \
     /joint/chosen/length stations run_out offset side gap /march/duration /loads/chosen/couple /loads/chosen/order \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=prescribed /body/chosen/mass_damping /output/chosen/joint /fields/bodies mesh merge dimensions rigid moves_along_z static_correction /body/chosen/material regions /body/chosen/mass polar_inertia transverse_inertia /body/chosen/z \
     dmig calculix nodes drives loads /body/chosen/damping /body/chosen/stiffness initial_speed ground_spring /body/chosen/table /joint/chosen/kind=stop film /joint/chosen/sensor first second /joint/chosen/springs radial_clearance stations \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=prescribed /body/chosen/mass_damping /output/chosen/joint /fields/bodies mesh merge dimensions rigid moves_along_z static_correction /body/chosen/material regions /body/chosen/mass polar_inertia transverse_inertia /body/chosen/z \
     /body/chosen/matrices/dofs calculix drives loads /body/chosen/damping /body/chosen/stiffness initial_speed ground_spring /body/chosen/table /joint/chosen/kind=stop film /joint/chosen/sensor first second /joint/chosen/springs radial_clearance stations \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=prescribed /body/chosen/mass_damping /output/chosen/joint /fields/bodies mesh merge dimensions rigid moves_along_z static_correction /body/chosen/material regions /body/chosen/mass polar_inertia transverse_inertia /body/chosen/z \
     /body/chosen/matrices/dofs /body/chosen/matrices/stiffness /body/chosen/matrices/mass dmig drives loads /body/chosen/damping /body/chosen/stiffness initial_speed ground_spring /body/chosen/table /joint/chosen/kind=stop film /joint/chosen/sensor first second /joint/chosen/springs radial_clearance stations \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=no /body/chosen/mass_damping /output/chosen/joint /fields/bodies mesh matrices units merge dimensions rigid /body/chosen/material regions /body/chosen/sets modes static_correction held ground_spring \
     axial_restraint section stiffening polar_inertia /body/chosen/speed /body/chosen/table acceleration initial_speed \
     /joint/chosen/kind=coupling film /joint/chosen/sensor journal bore /joint/chosen/law parameters /joint/chosen/springs \
     radial_clearance journal_radius /joint/chosen/length stations run_out offset side gap \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=no /body/chosen/mass_damping /output/chosen/joint /fields/bodies mesh matrices units merge dimensions rigid /body/chosen/material regions /body/chosen/sets modes static_correction held ground_spring \
     axial_restraint section stiffening polar_inertia /body/chosen/speed /body/chosen/table acceleration initial_speed \
     /joint/chosen/kind=gear film /joint/chosen/sensor journal bore /joint/chosen/law parameters /joint/chosen/springs \
     radial_clearance journal_radius /joint/chosen/length stations run_out offset side gap \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping",
];

/// Of files of named bodies, too: one that is made from sections.
const SECTIONS: &str = "/body/chosen/turns=prescribed /body/chosen/mass_damping /output/chosen/joint /fields/bodies mesh matrices units merge dimensions rigid moves_along_z static_correction \
     outer_left outer_right inner_left inner_right mass_outer \
     /body/chosen/mass polar_inertia transverse_inertia /body/chosen/z /body/chosen/sets /body/chosen/regions material drives loads disc added \
     /body/chosen/stiffness /body/chosen/damping initial_speed held ground_spring /body/chosen/table \
     /joint/chosen/kind=stop film /joint/chosen/sensor first second /joint/chosen/springs radial_clearance stations \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash";

/// Keys that exclude each other, so that a file with both would leave tables of one unread.
pub(super) fn variants(kind: &str) -> Vec<Vec<&'static str>> {
    let plain: &[&[&str]] = match kind {
        "law" => &[&["value"], &["pieces"]],
        "element" => &[&["points"], &["rule"]],
        "motion" => &[&["kinetic_energy"], &["mass", "quadratic_velocity", "PF", "B", "P"]],
        "case" => &[
            &[
                "include",
                "mass",
                "stop",
                "/fields/bodies",
                "/drive/table",
                "/load/0/table",
                "mesh",
                "units",
                "merge",
                "body",
                "/output/chosen/joint",
                "joint",
                "drives",
                "loads",
            ],
            &[
                "include",
                "mass",
                "stop",
                "/fields/bodies",
                "/drive/table",
                "/load/0/table",
                "dimensions",
                "body",
                "/output/chosen/joint",
                "joint",
                "drives",
                "loads",
            ],
            &[
                "include", "shaft", "support", "springs", "bearing", "drive", "load", "material",
                "body", "joint", "drives", "loads",
            ],
        ],
        _ => &[&[]],
    };
    let named = if kind == "case" { NAMED.as_slice() } else { &[] };
    let words = |text: &'static str| SHORT.split(' ').chain(text.split_whitespace());
    let named = named
        .iter()
        .map(|text| words(text).chain(["/body/chosen/sections", "/body/chosen/cells"]).collect());
    let mut all: Vec<Vec<&'static str>> =
        plain.iter().map(|keys| keys.to_vec()).chain(named).collect();
    if kind == "case" {
        all.push(words(SECTIONS).collect());
        let lateral = all.first().map(|keys| [&keys[..], &FOR_LATERAL].concat());
        all.iter_mut().for_each(|keys| keys.extend(LATERAL.split_whitespace()));
        let periodic = all.first().map(|keys| {
            [&keys[..], &["/analysis/chosen/kind=periodic"], &FOR_LATERAL[1..]].concat()
        });
        all.extend(lateral);
        all.iter_mut().for_each(|keys| keys.extend(PERIODIC.split_whitespace()));
        let first = all.first().cloned().unwrap_or_default();
        all.extend(periodic);
        all.iter_mut().for_each(|keys| keys.extend(OF_KINDS.iter().map(|own| own.1)));
        all.extend(KINDS.map(|kind| {
            let others = OF_KINDS.iter().filter(|own| own.0 != kind).map(|own| own.1);
            let own = [&first[..], &[kind], &FOR_LATERAL[1..]].concat();
            own.into_iter().chain(others).collect()
        }));
    }
    all
}
