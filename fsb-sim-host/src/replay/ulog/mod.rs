//! PX4's ULog files: the topics that a replay needs, chosen by themselves, and the part of the log that flies.
//!
//! | file | what |
//! |---|---|
//! | `store` | the wanted topics as columns of numbers |
//! | `topics` | which of them are used |
//! | `frames` | north-east-down to east-north-up |
//! | `phases` | take-off and landing |
//! | `resets` | positions that the on-board estimator has reset |
//! | `read` | all of it as a flight |

mod frames;
mod phases;
mod read;
mod resets;
mod store;
mod topics;

pub use read::read;
