//! Motions: kernels against the paper's formulas, derivatives three ways, conserved quantities, and
//! specs that must be refused.

mod derivatives;
mod facts;
mod sample;
mod specs;
