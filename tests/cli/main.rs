//! The `whirl` command as a user meets it: exit statuses, messages, files.

mod bad_input;
mod bad_machine;
mod bodies;
mod cached;
mod eccentricity;
mod every_key;
mod explain;
mod figures;
mod first_law;
mod good_runs;
mod hostile;
mod law_values;
mod lost_work;
mod machines;
mod messages;
mod mutants;
mod new;
mod outputs;
mod read_meshes;
mod readme;
mod schema;
mod starts;
mod streams;
mod unsound;
mod verdicts;
mod workbench;
