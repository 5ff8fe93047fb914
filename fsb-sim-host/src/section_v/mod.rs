//! Section V of the paper in closed loop.
//!
//! Two axes of a multirotor, x'' = k F_x and y'' = k F_y with k = 2/kg unknown, follow a spiral under the
//! certainty-equivalence controller (70)-(71), from positions measured with noise. The force is held over each tick, and
//! the plant moves exactly. The paper gives neither the tick rate nor the initial state: 10 kHz, and at rest on the
//! reference, unless stated otherwise.
//!
//! | file | what |
//! |---|---|
//! | `scenario` | Section V as data, checked |
//! | `trajectory` | the spiral reference |
//! | `noise` | measurement noise from a seed |
//! | `pilot`, `pilot_*` | what flies the loop: the f32 core, the paper's form, and the one that knows everything |
//! | `flight` | one flight |
//! | `monte_carlo` | many flights, and their statistics |
//! | `table1` | Table 1 beside the paper's values |
//! | `figures*` | Figs. 2-9 |
//! | `page` | the report |
//! | `open_loop` | efficiency and coverage on the paper's trajectory with the force given |

// Units stand in brackets; they are no links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod figures;
mod figures_compared;
pub mod flight;
pub mod monte_carlo;
pub mod noise;
pub mod open_loop;
pub mod page;
pub mod pilot;
mod pilot_core;
mod pilot_ideal;
mod pilot_paper;
pub mod scenario;
pub mod table1;
pub mod trajectory;

pub use flight::{Moment, fly, record};
pub use monte_carlo::{LoopStatistics, MonteCarlo, monte_carlo};
pub use pilot::{Belief, Pilot, Sight};
pub use pilot_core::CorePilot;
pub use pilot_ideal::IdealPilot;
pub use pilot_paper::{ComparedPilot, PaperPilot};
use scenario::{K, KD, KP};
pub use scenario::{Scenario, ScenarioError, Start};
