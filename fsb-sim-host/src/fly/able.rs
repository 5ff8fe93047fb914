//! What the vehicle can do: the allocation's condition, and the wrenches that six rotors with limits give.

use serde::Serialize;

use super::scenario::Scenario;
use crate::hexarotor::{Attainable, Hexarotor};
use crate::report::table::{Cell, Column, Table};

/// The vehicle of a flight at its start, payload included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Ability {
    /// Condition number of the allocation, torques by the length of an arm.
    pub condition: f64,
    /// What it can do at its weight; `None` where the rotors cannot carry it.
    pub attainable: Option<Attainable>,
}

/// Of the flight of `seed`; `None` where its vehicle cannot be made.
pub fn of(scenario: &Scenario, seed: u64) -> Option<Ability> {
    let vehicle = Hexarotor::new(&scenario.drawn(seed).plant).ok()?;
    Some(Ability { condition: vehicle.allocator().frame().condition(), attainable: vehicle.attainable() })
}

/// As a table.
pub fn table(ability: &Ability) -> Table {
    let columns = vec![Column::left(""), Column::right("least"), Column::right("most")];
    let mut table = Table::new("What the vehicle can do", columns);
    let mut push = |name: &str, [least, most]: [f64; 2]| {
        let cell = |value: f64| if value.is_finite() { Cell::significant(value, 3) } else { Cell::Missing };
        table.push(vec![Cell::text(name), cell(least), cell(most)]);
    };
    let alone = |value| [f64::NAN, value];
    push("condition number of the allocation", alone(ability.condition));
    match &ability.attainable {
        Some(of) => {
            push("thrust to weight", alone(of.thrust_to_weight));
            push("F_z [N]", of.vertical_force);
            push("F_x in hover [N]", of.lateral_force[0]);
            push("F_y in hover [N]", of.lateral_force[1]);
            push("lateral force in hover, any direction [N]", alone(of.lateral_force_any_direction));
            for (name, torque) in
                ["τ_x in hover [N m]", "τ_y in hover [N m]", "τ_z in hover [N m]"].iter().zip(of.torque)
            {
                push(name, torque);
            }
            table.with_note("Body frame, each alone; in hover: while F_z carries the weight at the start.")
        }
        None => table.with_note("Its rotors cannot carry its weight, or cannot be so weak."),
    }
}
