//! The configuration as text, and what it refuses.

use fsb_sim_host::hexarotor::{Hexarotor, HexarotorConfig, LagOn, Payload, PayloadStep};

/// A refusal and the parameter it has to name.
type Case = (fn(&mut HexarotorConfig), &'static str);

#[test]
fn refusals_name_the_parameter() {
    let cases: [Case; 24] = [
        (|c| c.mass = 0.0, "mass"),
        (|c| c.mass = f64::NAN, "mass"),
        (|c| c.inertia[1] = -0.1, "inertia"),
        (|c| c.gravity = f64::INFINITY, "gravity"),
        (|c| c.max_step = 0.0, "max_step"),
        (|c| c.frame.arm = -0.3, "frame.arm"),
        (|c| c.frame.arm = 0.005, "frame.arm"),
        (|c| c.frame.tilt = 0.0, "frame.tilt"),
        (|c| c.frame.tilt = 1.6, "frame.tilt"),
        (|c| c.rotor.thrust_min = -1.0, "rotor.thrust_min"),
        (|c| c.rotor.thrust_max = 0.0, "rotor.thrust_max"),
        (|c| c.rotor.thrust_max = f64::NAN, "rotor.thrust_max"),
        (|c| c.rotor.thrust_coefficient = 0.0, "rotor.thrust_coefficient"),
        (|c| c.rotor.drag_ratio = -0.1, "rotor.drag_ratio"),
        (|c| c.rotor.time_constant = -0.1, "rotor.time_constant"),
        (|c| c.rotor.inertia = 1e-5, "rotor.inertia"),
        (|c| c.drag.linear[0] = -1.0, "drag.linear"),
        (|c| c.drag.quadratic[2] = f64::NAN, "drag.quadratic"),
        (|c| c.wind.gust_sd[0] = -1.0, "wind.gust_sd"),
        (|c| c.wind.gust_time = 0.0, "wind.gust_time"),
        (|c| c.payload = vec![PayloadStep { at: f64::NAN, payload: Payload::default() }], "payload.at"),
        (|c| c.payload = [2.0, 1.0].map(|at| PayloadStep { at, payload: Payload::default() }).to_vec(), "payload.at"),
        (|c| c.start.velocity[0] = f64::NAN, "start.velocity"),
        (|c| c.start.attitude[2] = 100.0, "start.attitude"),
    ];
    for (spoil, name) in cases {
        let mut config = HexarotorConfig::default();
        spoil(&mut config);
        let error = Hexarotor::new(&config).unwrap_err();
        assert_eq!(error.name, name, "{error}");
        assert!(error.to_string().starts_with(name), "{error}");
    }
}

/// What a file names is set, all else is the default; a name it misspells is refused, at any depth.
#[test]
fn text_sets_what_it_names() {
    let text = r#"{ "mass": 3.1, "rotor": { "time_constant": 0.03, "lag_on": "thrust" },
        "payload": [{ "at": 2.0, "payload": { "mass": 0.5 } }] }"#;
    let config: HexarotorConfig = serde_json::from_str(text).unwrap();
    let mut expected = HexarotorConfig { mass: 3.1, ..Default::default() };
    (expected.rotor.time_constant, expected.rotor.lag_on) = (0.03, LagOn::Thrust);
    expected.payload = vec![PayloadStep { at: 2.0, payload: Payload { mass: 0.5, inertia: [0.0; 3] } }];
    assert_eq!(config, expected);
    for (wrong, name) in [(r#"{ "mas": 3.1 }"#, "mas"), (r#"{ "rotor": { "thrust": 3.1 } }"#, "thrust")] {
        let error = serde_json::from_str::<HexarotorConfig>(wrong).unwrap_err().to_string();
        assert!(error.contains(&format!("unknown field `{name}`")), "{error}");
    }
}
