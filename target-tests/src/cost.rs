//! Mean and worst of a count.

use semihosting::println;

/// Mean and worst of a count.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    name: &'static str,
    sum: u64,
    ticks: u32,
    worst: u32,
    worst_at: u32,
}

impl Cost {
    /// Nothing yet.
    pub const fn new(name: &'static str) -> Self {
        Self { name, sum: 0, ticks: 0, worst: 0, worst_at: 0 }
    }

    /// A tick that took so many.
    pub fn add(&mut self, tick: u32, count: u32) {
        self.sum += u64::from(count);
        self.ticks += 1;
        if count > self.worst {
            (self.worst, self.worst_at) = (count, tick);
        }
    }

    /// As a line of the program.
    pub fn print(&self) {
        let mean = self.sum as f64 / f64::from(self.ticks);
        println!("{} mean {mean:.2} worst {} tick {}", self.name, self.worst, self.worst_at);
    }
}
