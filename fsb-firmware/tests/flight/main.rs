//! The loop on the host: what it asks of its peripherals, a flight against the exact plant, and one whose receiver fails.

mod closed_loop;
#[path = "../../src/course.rs"]
mod course;
mod peripherals;
#[path = "../../src/plant.rs"]
mod plant;
mod receiver;
mod receiver_dead;
mod receiver_wrong;
