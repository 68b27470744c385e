//! Units for co-simulation as an importer meets them: archives, descriptions, and the functions of the standard.

mod archives;
mod bench;
mod coupled;
mod driven;
mod importer;
mod python;
mod refused;
mod states;
