//! The regression's sums against sums in f64.

mod gusts;
mod model;
mod pooled;
mod shares;
mod squares;
mod triangle;
