//! What happens after the start: a machine in equilibrium stays there.
