//! What the configurations have in common, and the names of their parameters.

use core::ffi::c_char;
use core::hint::black_box;
use core::mem::{MaybeUninit, offset_of};

use fsb_core::error::NAMES;
use fsb_core::estimator::{Configuring, SharedConfig};
use fsb_core::readout::ParameterRule;
use fsb_core::{ConfigError, EstimatorConfig, Tuning};

use crate::axis::fsb_axis_config_t;
use crate::object::Mark;
use crate::rotation::fsb_rotation_config_t;
use crate::status::{fsb_status_t, of_config};
use crate::translation::fsb_translation_config_t;

/// k = sum(z2 z0) / sum(z0^2): keeps the sign of k, close to the best possible. The default.
pub const FSB_READOUT_LEAST_SQUARES: u32 = 0;
/// k = sum|z2| / sum|z0|, the paper's (44): loses the sign, reads too high where the excitation is weak.
pub const FSB_READOUT_ABSOLUTE_RATIO: u32 = 1;

/// In flight: k is identified, and the states are predicted with it. The default.
pub const FSB_LEARNING_ON: u32 = 0;
/// k stays as it is, and the states are predicted with it.
pub const FSB_LEARNING_OFF: u32 = 1;
/// On the ground or held: forces act that nobody knows. k stays as it is, and the states are predicted with
/// constant velocity.
pub const FSB_LEARNING_CONTACT: u32 = 2;

/// The paper's lambda and q [1/s]. Each, times the period it runs at, must be within 1e-6..1; q = lambda/2 is
/// the paper's choice.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_tuning_t {
    /// Cut-off of the filters [1/s].
    pub lambda: f64,
    /// Frequency shift: how fast the window opens [1/s].
    pub q: f64,
}

/// When a parameter counts as valid.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_rule_t {
    /// The smallest k that can be right. 1e-15..1e15.
    pub min: f64,
    /// The largest k that can be right; above the smallest, up to 1e15.
    pub max: f64,
    /// The largest sd(k)/k at which k becomes valid; it stays valid up to twice that. 1e-15..1e6.
    pub max_relative_sd: f64,
}

/// A refused configuration: the code, and the name of the parameter as it is written in C.
pub(crate) type Refusal = (fsb_status_t, *const c_char);

#[inline(never)]
pub(crate) fn refusal(error: ConfigError) -> Refusal {
    (of_config(error), named(error.parameter()))
}

/// The name of a parameter as C text.
fn named(name: &str) -> *const c_char {
    let all = NAMES.as_slice();
    // Where it is not one of these it is out of all bounds.
    let start = name.as_ptr().addr().wrapping_sub(all.as_ptr().addr());
    match all.get(start.wrapping_add(name.len()).wrapping_add(1)..) {
        Some([b'=', other @ ..]) => other.as_ptr().cast(),
        Some(_) => all.as_ptr().wrapping_add(start).cast(),
        None => c"configuration".as_ptr(),
    }
}

/// The defaults of the core, for a control period.
#[inline(never)]
fn defaults(period: f64, shared: &mut MaybeUninit<SharedConfig>, rules: &mut [MaybeUninit<ParameterRule>]) {
    shared.write(EstimatorConfig::<1, 1>::new(period).shared());
    // The compiler is not to write this out three times.
    for rule in black_box(rules) {
        rule.write(ParameterRule::DEFAULT);
    }
}

/// A configuration of an estimator without its shape.
#[derive(Clone, Copy)]
pub(crate) struct Unshaped<'a> {
    shared: &'a SharedConfig,
    drift: &'a [f64],
    nominal: &'a [f64],
    rule: &'a [ParameterRule],
}

impl Unshaped<'_> {
    /// Configures an estimator of the same shape; an object comes of it where nothing is wrong.
    #[inline(never)]
    pub(crate) fn give_to(&self, mut estimator: Configuring<'_>, mark: Mark<'_>) -> Result<(), Refusal> {
        estimator.shared(self.shared);
        for (axis, drift) in self.drift.iter().enumerate() {
            estimator.drift(axis, *drift);
        }
        for (index, (nominal, rule)) in self.nominal.iter().zip(self.rule).enumerate() {
            estimator.parameter(index, *nominal, rule);
        }
        estimator.finish().map_err(refusal)?;
        mark.put();
        Ok(())
    }
}

/// A configuration of an estimator, of the C interface.
pub(crate) trait Configuration {
    fn unshaped(&self) -> Unshaped<'_>;
}

/// Fails to compile where a structure of C is not that of the core.
macro_rules! same {
    ($c:ty, $core:ty, [$($field:ident),+ $(,)?]) => {
        $(assert!(offset_of!($c, $field) == offset_of!($core, $field));)+
        assert!(align_of::<$c>() == align_of::<$core>());
    };
}

const _: () = {
    same!(fsb_tuning_t, Tuning, [lambda, q]);
    same!(fsb_rule_t, ParameterRule, [min, max, max_relative_sd]);
    assert!(size_of::<fsb_rule_t>() == size_of::<ParameterRule>());
    assert!(FSB_READOUT_LEAST_SQUARES == 0 && FSB_READOUT_ABSOLUTE_RATIO == 1);
};

macro_rules! configurations {
    ($($config:ident, $axes:literal, $parameters:literal, $drift:expr, $nominal:expr;)+) => {
        $(
            const _: () = {
                same!($config, SharedConfig, [
                    period, substeps, block, turn, readout, identifier, observer, noise_sd, disturbance_sd, memory_tau,
                    max_misfit, parameter_settle, state_settle, position_limit, input_limit,
                ]);
                assert!(offset_of!($config, drift) == size_of::<SharedConfig>());
                assert!(offset_of!($config, nominal) == offset_of!($config, drift) + $axes * size_of::<f64>());
                assert!(offset_of!($config, rule) == offset_of!($config, nominal) + $parameters * size_of::<f64>());
                assert!(size_of::<$config>() == offset_of!($config, rule) + $parameters * size_of::<fsb_rule_t>());
            };

            impl $config {
                pub(crate) fn new(period: f64) -> Self {
                    let mut config = MaybeUninit::<Self>::uninit();
                    let to = config.as_mut_ptr();
                    // SAFETY: the numbers of the core's structures stand at the same places in these, as is asserted above, a
                    // field is one value or an array of them, and all fields are written.
                    unsafe {
                        let rules = (&raw mut (*to).rule).cast();
                        defaults(period, &mut *to.cast(), core::slice::from_raw_parts_mut(rules, $parameters));
                        (&raw mut (*to).drift).write($drift);
                        (&raw mut (*to).nominal).write($nominal);
                        config.assume_init()
                    }
                }
            }

            impl Configuration for $config {
                fn unshaped(&self) -> Unshaped<'_> {
                    let drift = core::ptr::from_ref(&self.drift).cast();
                    let nominal = core::ptr::from_ref(&self.nominal).cast();
                    let rule = core::ptr::from_ref(&self.rule).cast();
                    // SAFETY: the numbers of the core's structures stand at the same places in these, as is asserted above, and
                    // a field is one value or an array of them.
                    unsafe {
                        Unshaped {
                            shared: &*core::ptr::from_ref(self).cast(),
                            drift: core::slice::from_raw_parts(drift, $axes),
                            nominal: core::slice::from_raw_parts(nominal, $parameters),
                            rule: core::slice::from_raw_parts(rule, $parameters),
                        }
                    }
                }
            }
        )+
    };
}

configurations! {
    fsb_axis_config_t, 1, 1, 0.0, f64::NAN;
    fsb_translation_config_t, 3, 1, [0.0; 3], f64::NAN;
    fsb_rotation_config_t, 3, 3, [0.0; 3], [f64::NAN; 3];
}

/// NaN stands for a value that is not known.
pub(crate) fn known(value: f64) -> Option<f64> {
    if value.is_nan() { None } else { Some(value) }
}

impl From<Tuning> for fsb_tuning_t {
    fn from(Tuning { lambda, q }: Tuning) -> Self {
        Self { lambda, q }
    }
}

impl From<fsb_tuning_t> for Tuning {
    fn from(fsb_tuning_t { lambda, q }: fsb_tuning_t) -> Self {
        Self { lambda, q }
    }
}

#[cfg(test)]
mod tests {
    use core::ffi::{CStr, c_char};

    use crate::axis::{fsb_axis_config_default, fsb_axis_config_t, fsb_axis_init, fsb_axis_t};
    use crate::tracking::{fsb_tracking_config_default, fsb_tracking_init, fsb_tracking_t};

    fn text(name: *const c_char) -> &'static str {
        assert!(!name.is_null());
        // SAFETY: a text of the library's.
        unsafe { CStr::from_ptr(name) }.to_str().unwrap()
    }

    /// In every build, and not only where all of it is linked as one.
    #[test]
    fn the_parameter_at_fault_is_named() {
        type Spoil = fn(&mut fsb_axis_config_t);
        let wrong: [(Spoil, &str); 8] = [
            (|c| c.period = 0.0, "period"),
            (|c| c.identifier.q = 0.0, "identifier.q"),
            (|c| c.observer.lambda = f64::NAN, "observer.lambda"),
            (|c| c.memory_tau = 0.0, "memory_tau"),
            (|c| c.input_limit = -1.0, "input_limit"),
            (|c| c.drift = f64::INFINITY, "drift"),
            (|c| c.rule.max = -0.0, "rule.min"),
            (|c| c.rule.max_relative_sd = 0.0, "rule.max_relative_sd"),
        ];
        for (spoil, expected) in wrong {
            let mut axis = core::mem::MaybeUninit::<fsb_axis_t>::uninit();
            let (mut config, mut name) = (fsb_axis_config_default(0.01), core::ptr::null());
            spoil(&mut config);
            // SAFETY: good pointers.
            assert_ne!(unsafe { fsb_axis_init(axis.as_mut_ptr(), &config, &mut name) }, 0);
            assert_eq!(text(name), expected);
        }
        let mut controller = core::mem::MaybeUninit::<fsb_tracking_t>::uninit();
        let (mut config, mut name) = (fsb_tracking_config_default(4.0, 3.0), core::ptr::null());
        config.k_max = f64::NAN;
        // SAFETY: good pointers.
        assert_ne!(unsafe { fsb_tracking_init(controller.as_mut_ptr(), &config, &mut name) }, 0);
        assert_eq!(text(name), "k_max");
    }
}
