//! The regression's sums against sums in f64.

mod shares;
mod squares;
mod triangle;
