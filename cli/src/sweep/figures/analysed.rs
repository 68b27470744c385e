//! Which numbers of analyses are drawn, by the ends of their names.

use std::collections::BTreeSet;

/// Numbers of one kind that have figures of their own: the name of a file, and what stands above it.
pub(super) struct Kind {
    pub(super) stem: &'static str,
    pub(super) title: &'static str,
    rules: &'static [Rule],
}

/// Numbers that share a panel.
struct Rule {
    quantity: &'static str,
    unit: &'static str,
    /// The last parts of their names, and what legends call them.
    tails: &'static [(&'static str, &'static str)],
}

/// A panel with numbers by their names in rows.
pub(super) struct Panelled {
    pub(super) title: String,
    pub(super) quantity: &'static str,
    pub(super) unit: &'static str,
    /// What each is called, and its name.
    pub(super) series: Vec<(String, String)>,
}

/// Of numbers that are counted, so many are drawn.
const COUNTED: usize = 4;

/// All that have figures. `N` stands for 1, 2, …
pub(super) const KINDS: [Kind; 10] = [
    Kind {
        stem: "thresholds",
        title: "Thresholds of stability",
        rules: &[Rule {
            quantity: "threshold",
            unit: "rpm",
            tails: &[("threshold_rpm", "unstable above")],
        }],
    },
    Kind {
        stem: "decrements",
        title: "Least logarithmic decrements",
        rules: &[Rule {
            quantity: "logarithmic decrement",
            unit: "1",
            tails: &[("least_log_decrement", "least")],
        }],
    },
    Kind {
        stem: "critical-speeds",
        title: "Critical speeds",
        rules: &[
            Rule {
                quantity: "critical speed",
                unit: "rpm",
                tails: &[("critical_rpm.N", "critical speed")],
            },
            Rule {
                quantity: "forward critical speed",
                unit: "rpm",
                tails: &[("forward_critical_rpm.N", "forward critical speed")],
            },
        ],
    },
    Kind {
        stem: "frequencies",
        title: "Natural frequencies",
        rules: &[Rule { quantity: "frequency", unit: "Hz", tails: &[("frequency_hz.N", "mode")] }],
    },
    Kind {
        stem: "amplitudes",
        title: "Largest amplitudes, zero to peak",
        rules: &[Rule {
            quantity: "amplitude",
            unit: "µm",
            tails: &[("amplitude_um", "major semi-axis")],
        }],
    },
    Kind {
        stem: "amplification",
        title: "Amplification factors of peaks",
        rules: &[Rule {
            quantity: "amplification factor",
            unit: "1",
            tails: &[("amplification_factor.N", "peak")],
        }],
    },
    Kind {
        stem: "coefficients",
        title: "Stiffness and damping of joints",
        rules: &[
            Rule {
                quantity: "stiffness",
                unit: "N/m",
                tails: &[
                    ("k_xx_N_m", "k_xx"),
                    ("k_xy_N_m", "k_xy"),
                    ("k_yx_N_m", "k_yx"),
                    ("k_yy_N_m", "k_yy"),
                ],
            },
            Rule {
                quantity: "damping",
                unit: "N·s/m",
                tails: &[
                    ("c_xx_Ns_m", "c_xx"),
                    ("c_xy_Ns_m", "c_xy"),
                    ("c_yx_Ns_m", "c_yx"),
                    ("c_yy_Ns_m", "c_yy"),
                ],
            },
        ],
    },
    Kind {
        stem: "margins",
        title: "Lateral analysis",
        rules: &[
            Rule { quantity: "passes", unit: "1", tails: &[("pass", "1: passes")] },
            Rule {
                quantity: "separation margin",
                unit: "%",
                tails: &[
                    ("separation_margin_percent", "separation margin"),
                    ("separation_margin_required_percent", "required"),
                ],
            },
            Rule {
                quantity: "scaled response at clearance",
                unit: "µm pk-pk",
                tails: &[
                    ("scaled_response_um_pkpk", "scaled response"),
                    ("scaled_response_limit_um_pkpk", "limit"),
                ],
            },
            Rule {
                quantity: "level II logarithmic decrement",
                unit: "1",
                tails: &[("level_2_log_decrement", "level II")],
            },
        ],
    },
    Kind {
        stem: "separations",
        title: "Least torsional separations",
        rules: &[Rule {
            quantity: "separation",
            unit: "1",
            tails: &[("least_separation", "separation")],
        }],
    },
    Kind {
        stem: "moments",
        title: "Largest bending moments",
        rules: &[Rule {
            quantity: "bending moment",
            unit: "N·m",
            tails: &[("bending_moment_Nm", "bending moment")],
        }],
    },
];

/// The panels of a kind: of every analysis, and of whatever it tells apart.
pub(super) fn panels(kind: &Kind, analyses: &[&str], known: &BTreeSet<&String>) -> Vec<Panelled> {
    let mut all = Vec::new();
    for analysis in analyses {
        for Rule { quantity, unit, tails } in kind.rules {
            for head in heads(analysis, tails, known) {
                let mut series = Vec::new();
                for (tail, called) in *tails {
                    let named: Vec<(String, String)> = match tail.strip_suffix(".N") {
                        Some(own) => (1..=COUNTED)
                            .map(|k| (format!("{called} {k}"), format!("{head}{own}.{k}")))
                            .collect(),
                        None => vec![((*called).to_owned(), format!("{head}{tail}"))],
                    };
                    series.extend(named.into_iter().filter(|(_, name)| known.contains(name)));
                }
                let title = head.trim_end_matches('.').to_owned();
                all.push(Panelled { title, quantity, unit, series });
            }
        }
    }
    all
}

/// What stands before these ends in names of an analysis, each once.
fn heads(analysis: &str, tails: &[(&str, &str)], known: &BTreeSet<&String>) -> BTreeSet<String> {
    let own = format!("{analysis}.");
    let head = |name: &&String| {
        let (tail, _) = tails.first()?;
        let first = tail.strip_suffix(".N").map(|own| format!("{own}.1"));
        let before = name.strip_suffix(first.as_deref().unwrap_or(tail))?;
        let is_whole = before.starts_with(&own) && before.ends_with('.');
        is_whole.then(|| before.to_owned())
    };
    known.iter().filter_map(head).collect()
}
