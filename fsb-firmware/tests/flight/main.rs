//! The loop on the host: what it asks of its peripherals, and a flight against the exact plant.

mod closed_loop;
#[path = "../../src/course.rs"]
mod course;
mod peripherals;
#[path = "../../src/plant.rs"]
mod plant;
