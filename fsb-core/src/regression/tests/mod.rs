//! The regression's sums against sums in f64.

mod model;
mod pooled;
mod shares;
mod squares;
mod triangle;
