//! Statistics of repeated runs, and what no unbiased estimator can beat.
//!
//! | file | what |
//! |---|---|
//! | `summary` | mean and standard deviation of a set, and the rms of a sum of squares |
//! | `coverage` | how often an interval holds the truth, with its own confidence interval |
//! | `cramer_rao` | the Cramér-Rao bound of k from raw positions |

// Units stand in brackets; they are no links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod coverage;
pub mod cramer_rao;
pub mod summary;

pub use coverage::Coverage;
pub use cramer_rao::AxisInformation;
pub use summary::{Squares, Summary};
