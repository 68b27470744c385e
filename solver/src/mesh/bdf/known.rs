//! What becomes of cards that say nothing about solid elements.

/// What a card that is not read means for the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    /// Control of an analysis: the mesh is the same without it.
    Control,
    /// Other elements, loads and constraints: counted, and left out.
    LeftOut,
    /// Without it, the mesh would be another: why it is refused, and what to do.
    Refused(&'static str, &'static str),
    /// It ties nodes: read, or refused where these are nodes of elements that are read.
    Tie,
    Unknown,
}

const CONTROL: &[&str] = &[
    "PARAM", "MDLPRM", "EIGR", "EIGRL", "EIGB", "EIGC", "EIGP", "FREQ", "FREQ1", "FREQ2", "FREQ3",
    "FREQ4", "FREQ5", "TSTEP", "TSTEPNL", "NLPARM", "NLPCI", "NLSTEP", "NXSTRAT", "TABLED1",
    "TABLED2", "TABLED3", "TABLED4", "TABLEM1", "TABLES1", "TABDMP1", "TABRND1", "RANDPS",
    "ECHOON", "ECHOOFF", "DOPTPRM", "DTI", "ITER", "OMIT", "ASET", "ASET1", "QSET", "QSET1",
    "SPOINT", "MATS1", "MATT2", "MATT3", "MATT8", "MATT9", "MAT4", "MAT5", "MATEP", "CREEP",
    "TABLEST",
];

/// Names, or with an asterisk their beginnings.
const LEFT_OUT: &[&str] = &[
    // Points, lines and shells, with their properties.
    "PLOTEL*", "CROD", "PROD", "CONROD", "CTUBE", "PTUBE", "CBAR", "PBAR", "PBARL", "BAROR",
    "CBEAM*", "PBEAM*", "BEAMOR", "CBEND", "PBEND", "CBUSH*", "PBUSH*", "CELAS*", "PELAS*",
    "CDAMP*", "PDAMP*", "CVISC", "PVISC", "CGAP", "PGAP", "CFAST", "PFAST", "CWELD", "PWELD",
    "CSEAM", "PSEAM", "CQUAD*", "CTRIA*", "PSHELL", "PCOMP*", "PLPLANE", "PPLANE", "CSHEAR",
    "PSHEAR", "CRAC2D", "PRAC2D", "MAT8", "NSM*", "CMASS*", "PMASS", "CONM1", "CHBDY*", "PHBDY",
    "SNORM", // Loads and constraints.
    "SPC*", "SUPORT*", "FORCE*", "MOMENT*", "PLOAD*", "GRAV", "RFORCE*", "ACCEL*", "LOAD", "LSEQ",
    "DLOAD", "RLOAD*", "TLOAD*", "DAREA", "DELAY", "DPHASE", "TEMP*", "DEFORM", "BOLT*", "QBDY*",
    "QHBDY", "QVOL", "CONV*", "PCONV*", "RADBC*", "TIC", "BCONP", "BLSEG", "BCTSET", "BCTADD",
    "BCTPARM", "BSURF*", "BCPROP*", "BCBODY*", "BCTABLE*", "BCONT*", "BCRPARA", "BGADD", "BGPARM",
];

/// Cards that tie nodes to one another, and are read.
pub(super) const TIED: &[&str] = &["MPC", "RBAR", "RBAR1", "RBE1", "RROD"];

/// Cards that tie nodes to one another, and are not read.
const TIES: &[&str] = &["RTRPLT", "RTRPLT1", "RSPLINE", "RSSCON", "RJOINT"];

const BY_SPIDERS: &str =
    "let the meshes share nodes; for what carries a load or a bearing use RBE2 or RBE3";
const SUPERELEMENTS: &str = "belongs to superelements, which are not read";
const NO_SUPERELEMENTS: &str = "write the model without superelements";
const MATRICES: &str = "adds matrices to the model, which are not read";
const NO_MATRICES: &str = "write the part as a mesh";

const REFUSED: &[(&str, &str, &str)] = &[
    ("BGSET", "glues surfaces, which is not read", BY_SPIDERS),
    ("CSUPER", SUPERELEMENTS, NO_SUPERELEMENTS),
    ("CSUPEXT", SUPERELEMENTS, NO_SUPERELEMENTS),
    ("SEELT", SUPERELEMENTS, NO_SUPERELEMENTS),
    ("SESET", SUPERELEMENTS, NO_SUPERELEMENTS),
    ("SECONCT", SUPERELEMENTS, NO_SUPERELEMENTS),
    ("SEBULK", SUPERELEMENTS, NO_SUPERELEMENTS),
    ("SELOC", SUPERELEMENTS, NO_SUPERELEMENTS),
    ("RELEASE", SUPERELEMENTS, NO_SUPERELEMENTS),
    ("GENEL", MATRICES, NO_MATRICES),
    ("DMIG", MATRICES, NO_MATRICES),
    ("CORD3G", "is a coordinate system that is not read", "use CORD2R, CORD2C or CORD2S"),
    ("GMCORD", "is a coordinate system that is not read", "use CORD2R, CORD2C or CORD2S"),
    ("GRIDG", "gives nodes on geometry, which are not read", "write them as GRID"),
    ("CPYRA", "is a solid element that is not read", "write CPYRAM"),
    ("CHEX20", "is a solid element that is not read", "write CHEXA"),
];

pub(super) fn meaning(name: &str) -> Meaning {
    let is = |known: &str| match known.strip_suffix('*') {
        Some(start) => name.starts_with(start),
        None => known == name,
    };
    if CONTROL.contains(&name) {
        Meaning::Control
    } else if TIED.contains(&name) || TIES.contains(&name) {
        Meaning::Tie
    } else if let Some((_, what, help)) = REFUSED.iter().find(|(refused, ..)| *refused == name) {
        Meaning::Refused(what, help)
    } else if LEFT_OUT.iter().any(|known| is(known)) {
        Meaning::LeftOut
    } else {
        Meaning::Unknown
    }
}
