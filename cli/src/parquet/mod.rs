//! Parquet, as far as tables and histories need it: plain values without compression, every one of them there, in groups of
//! rows. (The `parquet` crate would take longer to compile than the rest of the command.)
//!
//! Source: Apache Parquet format 2.10, parquet.thrift; the compact protocol of Apache Thrift.

mod arrow;
mod compact;
mod foot;
mod numbers;
mod table;

pub(crate) use foot::{Facts, GROUP, MAGIC};
pub(crate) use numbers::Numbers;
pub(crate) use table::{Parquet, Values};
