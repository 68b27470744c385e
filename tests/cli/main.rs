//! The `whirl` command as a user meets it: exit statuses, messages, files.

mod bad_input;
mod workbench;
