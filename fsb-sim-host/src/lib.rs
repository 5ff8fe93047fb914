//! The std side of the FSB estimator: the paper's algorithms literally in f64 (`paper_form`), the exact sampled-data form in
//! f64 (`twin`), plants, the paper's Section V in closed loop, log replay and reports.

pub mod exactness;
pub mod faults;
pub mod fly;
pub mod hexarotor;
pub mod paper_form;
pub mod plant;
pub mod progress;
pub mod replay;
pub mod report;
pub mod section_v;
pub mod sensors;
pub mod soak;
pub mod statistics;
pub mod tune;
pub mod twin;
