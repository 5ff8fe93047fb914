//! Every public entry point of estimator, controller and control loop, with inputs the compiler knows nothing about, linked
//! with a panic handler that is an undefined symbol. Never run: that it links is the proof.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use fsb_core::control::{
    Motion, Reference, TrackingConfig, TrackingController, VehicleControlConfig, VehicleController, VehicleReference,
    to_body,
};
use fsb_core::estimator::{AxisState, Learning};
use fsb_core::guard::{GuardConfig, Guarded};
use fsb_core::moments::InputMoments;
use fsb_core::readout::{Memory, ParameterRule, Readout};
use fsb_core::regression::{DragConfig, DragEstimator, Identify};
use fsb_core::vehicle::{Attitude, ChangeRule, Expected, Group, Measured, VehicleConfig, VehicleEstimator, Wrench};
use fsb_core::{Estimator, EstimatorConfig, EstimatorDesign, Tuning};
use fsb_firmware::attitude_from_quaternion;
use panic_never as _;
use target_tests::whole_loop::{flight, loop_tick, sample};

#[entry]
fn main() -> ! {
    loop {
        estimator::<1, 1>();
        estimator::<3, 1>();
        estimator::<3, 3>();
        estimator::<6, 6>();
        guarded::<1, 1>();
        guarded::<3, 3>();
        vehicle::<1>();
        vehicle::<16>();
        drag::<1>();
        drag::<3>();
        controller();
        vehicle_controller();
        whole_loop();
        #[cfg(feature = "demonstrate")]
        index_out_of_bounds();
    }
}

/// The demonstration: an index the compiler cannot know.
#[cfg(feature = "demonstrate")]
fn index_out_of_bounds() {
    let values = black_box([1.0_f32, 2.0, 3.0]);
    let index: usize = black_box(1);
    black_box(values[index]);
}

fn estimator<const N: usize, const P: usize>() {
    let Ok(design) = EstimatorDesign::new(&config::<N, P>()) else { return };
    let mut estimator = black_box(Estimator::with_design(black_box(design)));
    loop {
        match black_box(0_u32) {
            0 => drop(black_box(estimator.measure(&black_box([Some(0.0); N])))),
            1 => drop(black_box(estimator.measure_raw(&black_box([0.0; N])))),
            2 => estimator.apply(&black_box([0.0; N])),
            3 => estimator.apply_ramp(&black_box([0.0; N]), &black_box([0.0; N])),
            4 => estimator.reset(),
            5 => estimator.reset_identifier(),
            6 => drop(black_box(estimator.states())),
            7 => drop(black_box(estimator.state_status())),
            8 => drop(black_box(estimator.state_sd())),
            9 => drop(black_box(estimator.parameter_status())),
            10 => drop(black_box(estimator.diagnostics())),
            11 => drop(black_box(estimator.counters())),
            12 => {
                for parameter in estimator.parameters().into_iter().flatten() {
                    black_box((parameter.sd(), parameter.inverse_with_sd()));
                }
            }
            13 => {
                if let Ok(new) = Estimator::new(&config::<N, P>()) {
                    estimator = black_box(new);
                }
            }
            14 => estimator.reinitialise_identifier(),
            15 => estimator.restart(),
            16 => estimator.set_learning(black_box(Learning::Contact)),
            17 => estimator.apply_moments(&black_box([InputMoments::ZERO; N])),
            18 => estimator.translate(&black_box([0.0; N])),
            19 => drop(black_box(estimator.snapshot(black_box(&mut [0; 4096])))),
            20 => drop(black_box(estimator.restore(black_box(&[0; 4096])))),
            21 => drop(black_box((estimator.prediction_parameters(), estimator.is_due()))),
            _ => return,
        }
    }
}

fn guarded<const N: usize, const P: usize>() {
    let Ok(mut guarded) = Guarded::new(&config::<N, P>(), &black_box(GuardConfig::default())) else { return };
    loop {
        match black_box(0_u32) {
            0 => drop(black_box(guarded.measure(&black_box([Some(0.0); N])))),
            1 => guarded.apply(&black_box([0.0; N])),
            2 => guarded.apply_ramp(&black_box([0.0; N]), &black_box([0.0; N])),
            3 => guarded.apply_moments(&black_box([InputMoments::ZERO; N])),
            4 => guarded.missed(black_box(3)),
            5 => guarded.restart(),
            6 => guarded.reset(),
            7 => drop(black_box((guarded.states(), guarded.state_status(), guarded.staleness()))),
            8 => drop(black_box((guarded.verdicts(), guarded.rejections()))),
            _ => return,
        }
    }
}

fn config<const N: usize, const P: usize>() -> EstimatorConfig<N, P> {
    let mut config = EstimatorConfig::<N, P>::new(black_box(1e-3));
    config.substeps = black_box(1);
    config.block = black_box(1);
    config.turn = black_box(0);
    config.identifier = Tuning { lambda: black_box(2.0), q: black_box(1.0) };
    config.observer = black_box(Tuning::from_lambda(10.0));
    config.noise_sd = black_box(None);
    config.readout = if black_box(true) { Readout::LeastSquares } else { Readout::AbsoluteRatio };
    config.memory = if black_box(true) { Memory::Infinite } else { Memory::Fading { tau: black_box(1.0) } };
    config.drift = black_box([0.0; N]);
    config.nominal = black_box([None; P]);
    config.rule = black_box([ParameterRule::default(); P]);
    config.parameter_settle = black_box(0.0);
    config.state_settle = black_box(0.0);
    config.position_limit = black_box(1e5);
    config.input_limit = black_box(1e5);
    config
}

fn vehicle<const D: usize>() {
    let mut config = VehicleConfig::new(black_box(1e-3));
    for group in [&mut config.translation, &mut config.rotation] {
        group.substeps = black_box(1);
        group.latency = black_box(0);
        group.block = black_box(1);
        group.memory = if black_box(true) { Memory::Infinite } else { Memory::Fading { tau: black_box(1.0) } };
    }
    config.gravity = black_box(9.81);
    config.mass = black_box(Expected::about(1.0));
    config.inertia = black_box([Expected::within(0.01, 0.1); 3]);
    config.actuator_lag = black_box(None);
    config.change = black_box(Some(ChangeRule::default()));
    let Ok(vehicle) = VehicleEstimator::<D>::new(&config) else { return };
    let mut vehicle = black_box(vehicle);
    loop {
        match black_box(0_u32) {
            0 => {
                let attitude = match black_box(0_u32) {
                    0 => Some(Attitude::Matrix(black_box([[0.0; 3]; 3]))),
                    1 => Some(Attitude::Quaternion(black_box([1.0, 0.0, 0.0, 0.0]))),
                    _ => None,
                };
                let measured = Measured { position: black_box(Some([0.0; 3])), attitude };
                drop(black_box(vehicle.update(&measured, &black_box(Wrench::default()))));
            }
            1 => drop(black_box(vehicle.state())),
            2 => drop(black_box((vehicle.mass(), vehicle.mass_status(), vehicle.model(), vehicle.counters()))),
            3 => drop(black_box((vehicle.inertia(), vehicle.inertia_status()))),
            4 => vehicle.reinitialise(if black_box(true) { Group::Translation } else { Group::Rotation }),
            5 => vehicle.reset(),
            6 => drop(black_box((vehicle.translation().states(), vehicle.rotation().states()))),
            7 => vehicle.set_learning(black_box(Learning::Contact)),
            8 => vehicle.missed(black_box(3)),
            9 => drop(black_box((vehicle.translation().diagnostics(), vehicle.rotation().staleness()))),
            _ => return,
        }
    }
}

fn drag<const N: usize>() {
    let mut config = DragConfig::<N>::new(black_box(1e-2));
    config.substeps = black_box(1);
    config.identifier = Tuning { lambda: black_box(2.0), q: black_box(1.0) };
    config.observer = black_box(Tuning::from_lambda(10.0));
    config.identify = black_box([Identify::BOTH; N]);
    config.memory = if black_box(true) { Memory::Infinite } else { Memory::Fading { tau: black_box(1.0) } };
    config.drift = black_box([0.0; N]);
    config.nominal = black_box(None);
    config.rule = black_box(ParameterRule::default());
    for limit in [
        &mut config.excitation,
        &mut config.drag_sd_limit,
        &mut config.disturbance_sd_limit,
        &mut config.parameter_settle,
        &mut config.state_settle,
        &mut config.position_limit,
        &mut config.input_limit,
    ] {
        *limit = black_box(*limit);
    }
    let Ok(drag) = DragEstimator::new(&config) else { return };
    let mut drag = black_box(drag);
    loop {
        match black_box(0_u32) {
            0 => drop(black_box(drag.measure(&black_box([Some(0.0); N])))),
            1 => drag.apply(&black_box([0.0; N])),
            2 => drag.apply_ramp(&black_box([0.0; N]), &black_box([0.0; N])),
            3 => drag.reset(),
            4 => drop(black_box((drag.states(), drag.state_status()))),
            5 => drop(black_box((drag.parameter(), drag.parameter_status(), drag.terms()))),
            6 => drop(black_box((drag.diagnostics(), drag.residual_variance(), drag.counters()))),
            _ => return,
        }
    }
}

fn vehicle_controller() {
    let Ok(controller) = VehicleController::new(&black_box(VehicleControlConfig::new())) else { return };
    let (position, velocity, attitude, rates) = black_box(([0.0; 3], [0.0; 3], [[0.0; 3]; 3], [0.0; 3]));
    let motion = Motion { position, velocity, attitude, rates };
    let reference = black_box(VehicleReference::hover([0.0; 3]));
    let _ = black_box(controller.wrench(&reference, &motion, black_box(1.0), black_box([1.0; 3])));
}

fn controller() {
    let config = TrackingConfig {
        kp: black_box(1.0),
        kd: black_box(1.0),
        drift: black_box(0.0),
        parameter_min: black_box(0.1),
        parameter_max: black_box(10.0),
    };
    let Ok(controller) = TrackingController::new(&config) else { return };
    let state = black_box(AxisState { position: 0.0, velocity: 0.0 });
    let _ = black_box(controller.input(&black_box(Reference::default()), &state, black_box(1.0)));
    black_box(to_body(&attitude_from_quaternion(black_box([1.0, 0.0, 0.0, 0.0])), &black_box([0.0; 3])));
}

fn whole_loop() {
    let Some(flight) = flight() else { return };
    let mut flight = black_box(flight);
    let tick = target_tests::scenario::Tick { positions: black_box(None), inputs: black_box([0.0; 6]) };
    let _ = black_box(loop_tick(&mut flight, &black_box(sample(&tick)), &black_box([Reference::default(); 6])));
    black_box((flight.parameters(), flight.parameter_status(), flight.state_status()));
    black_box((flight.counters(), flight.rejections()));
    black_box(flight.events().take());
    flight.reset();
}
