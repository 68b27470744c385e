//! The `whirl` command as a user meets it: exit statuses, messages, files.

mod bad_input;
mod bad_machine;
mod explain;
mod good_runs;
mod new;
mod readme;
mod workbench;
