//! Two CSV files on one clock: motion (positions and attitudes, irregular) and input (another rate).
//!
//! | file | what |
//! |---|---|
//! | `columns` | which column is what, by default and by choice |
//! | `table` | a CSV file as columns of numbers |
//! | `read` | the two as a flight |

mod columns;
mod read;
mod table;

pub use columns::Columns;
pub use read::read;
