// FSB: identification of k (1/mass, 1/inertia) and estimation of position and velocity from sampled positions, and a
// tracking controller on the estimates, for flight controllers. Made from fsb-c by cbindgen: do not edit.
//
// Model of an axis: y'' = k f + drift. y is a position [m] or an angle [rad], f a force [N] or a torque [N m], drift the known
// constant acceleration (gravity on the vertical axis). Any frame will do in which that holds; positions, inputs and drift
// are all in it.
//
// A tick:     measure (where a measurement is due)  ->  states, parameters  ->  control  ->  apply (what the actuators hold)
//
// Or the whole vehicle at any attitude, fsb_vehicle_t: mass, moments of inertia, position, velocity, attitude and rates.
// A tick:     update (what was measured, what the actuators did)  ->  state, model  ->  control
//
// Rules for every function:
// - Storage is the caller's: static, on a stack or in a structure. No heap, no globals, no locks, nothing to destroy.
//   Declare it as `static fsb_axis_t estimator;` or fill it with zeros: before its initialisation an object answers
//   FSB_NOT_INITIALISED. Do not change or overwrite it in between.
// - Every pointer is checked for NULL and alignment before anything is done. A pointer must lead to as much memory as its
//   type (or its array length) says, and what is written to (an object, an output) must not overlap with anything else that the
//   call is given, unless its function says that it may; nobody can check that.
// - Functions are re-entrant. Different objects may be used at the same time by threads and interrupts; one object by one of
//   them at a time.
// - An output that is not valid is NaN and has a status that says why: never a stale value. An output whose pointer is good is
//   always written.
// - No function blocks, allocates or panics. "For the tick": bounded work in single precision, no transcendental function.

#ifndef FSB_H
#define FSB_H


#include <stddef.h>
#include <stdint.h>

#if defined(__cplusplus)
#define FSB_STATIC_ASSERT(condition, name) static_assert(condition, #name)
#define FSB_ALIGNOF(type) alignof(type)
#elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L
#define FSB_STATIC_ASSERT(condition, name) _Static_assert(condition, #name)
#define FSB_ALIGNOF(type) _Alignof(type)
#else
#define FSB_STATIC_ASSERT(condition, name) typedef char fsb_assert_##name[(condition) ? 1 : -1]
#define FSB_ALIGNOF(type) offsetof(struct { char before; type object; }, object)
#endif


// sizeof(fsb_axis_t).
#define FSB_AXIS_SIZE 840

// Alignment of fsb_axis_t.
#define FSB_AXIS_ALIGNMENT 8

// k = sum(z2 z0) / sum(z0^2): keeps the sign of k, close to the best possible. The default.
#define FSB_READOUT_LEAST_SQUARES 0

// k = sum|z2| / sum|z0|, the paper's (44): loses the sign, reads too high where the excitation is weak.
#define FSB_READOUT_ABSOLUTE_RATIO 1

// In flight: k is identified, and the states are predicted with it. The default.
#define FSB_LEARNING_ON 0

// k stays as it is, and the states are predicted with it.
#define FSB_LEARNING_OFF 1

// On the ground or held: forces act that nobody knows. k stays as it is, and the states are predicted with
// constant velocity.
#define FSB_LEARNING_CONTACT 2

// sizeof(fsb_rotation_t).
#define FSB_ROTATION_SIZE 1424

// Alignment of fsb_rotation_t.
#define FSB_ROTATION_ALIGNMENT 8

// Done.
#define FSB_OK 0

// A pointer that must not be NULL is NULL.
#define FSB_NULL_POINTER 1

// A pointer is not aligned for its type.
#define FSB_MISALIGNED 2

// The object was not initialised, its initialisation failed, it was initialised as something else or by another
// version of the library, or its storage was overwritten.
#define FSB_NOT_INITIALISED 3

// A measurement was given before as many inputs as `substeps` were applied since the last one. Nothing has changed.
#define FSB_OUT_OF_STEP 4

// The parameter is outside the range by which the controller may divide, or NaN.
#define FSB_PARAMETER_OUT_OF_RANGE 5

// The reference, the state or the resulting input is not finite.
#define FSB_NOT_FINITE 6

// The value asked for is not valid at present.
#define FSB_NOT_VALID 7

// An argument is none of the constants that it may be. Nothing has changed.
#define FSB_UNKNOWN_VALUE 8

// Configuration: NaN or infinite.
#define FSB_CONFIG_NOT_FINITE 16

// Configuration: zero or negative where a positive value is needed.
#define FSB_CONFIG_NOT_POSITIVE 17

// Configuration: negative where zero or more is needed.
#define FSB_CONFIG_NEGATIVE 18

// Configuration: outside the documented range.
#define FSB_CONFIG_OUT_OF_RANGE 19

// Configuration: a rate [1/s] times the period it runs at exceeds 1. Lower the rate or sample faster.
#define FSB_CONFIG_TOO_FAST 20

// Configuration: a rate [1/s] times the period it runs at is below 1e-6.
#define FSB_CONFIG_TOO_SLOW 21

// Configuration: the lower limit of a pair is not below the upper one.
#define FSB_CONFIG_INVERTED_RANGE 22

// Configuration: a count that must be at least one is zero.
#define FSB_CONFIG_ZERO 23

// Configuration: refused for another reason.
#define FSB_CONFIG_REFUSED 31

// sizeof(fsb_tracking_t).
#define FSB_TRACKING_SIZE 32

// Alignment of fsb_tracking_t.
#define FSB_TRACKING_ALIGNMENT 8

// sizeof(fsb_translation_t).
#define FSB_TRANSLATION_SIZE 1232

// Alignment of fsb_translation_t.
#define FSB_TRANSLATION_ALIGNMENT 8

// Not usable: nothing could be read from the object.
#define FSB_STATE_UNKNOWN 0

// Not usable: this axis has not been measured yet.
#define FSB_STATE_NOT_MEASURED 1

// Not usable: less than the configured time has passed since the first measurement.
#define FSB_STATE_SETTLING 2

// Not usable: no k to predict with, as k is not valid and no nominal k was configured.
#define FSB_STATE_NO_PARAMETER 3

// Not usable: not measured for longer than is bridged by prediction (fsb_vehicle_t).
#define FSB_STATE_STALE 4

// Usable, predicted with the nominal k.
#define FSB_STATE_NOMINAL 8

// Usable, predicted with the identified k.
#define FSB_STATE_IDENTIFIED 9

// Usable, predicted with the k from before the identification began anew.
#define FSB_STATE_HELD 10

// Not usable: nothing could be read from the object.
#define FSB_PARAMETER_UNKNOWN 0

// Not usable: less than the configured time has passed since the last reset.
#define FSB_PARAMETER_SETTLING 1

// Not usable: the input has been zero, nothing can be said.
#define FSB_PARAMETER_UNEXCITED 2

// Not usable: the standard deviation is above the configured share of k.
#define FSB_PARAMETER_UNCERTAIN 3

// Not usable: k is below the configured range.
#define FSB_PARAMETER_BELOW 4

// Not usable: k is above the configured range.
#define FSB_PARAMETER_ABOVE 5

// Not usable: the motion contradicts the model, as on the ground or with a motor that does not obey.
#define FSB_PARAMETER_CONTRADICTED 6

// Not usable: the sums are no numbers, the object's memory has been changed from outside. Reset it.
#define FSB_PARAMETER_FAULTED 7

// Usable.
#define FSB_PARAMETER_VALID 8

// Usable: the k from before the identification began anew, until the new one is valid.
#define FSB_PARAMETER_HELD 9

// sizeof(fsb_vehicle_t).
#define FSB_VEHICLE_SIZE 10816

// Alignment of fsb_vehicle_t.
#define FSB_VEHICLE_ALIGNMENT 8

// The largest latency that can be configured [control periods]: how many of them an fsb_vehicle_t has room for.
#define FSB_VEHICLE_MAX_LATENCY 128

// x, y, z: the mass.
#define FSB_GROUP_TRANSLATION 0

// The angles about the body's axes: the moments of inertia.
#define FSB_GROUP_ROTATION 1

// World with z up (ENU, or any other: x and y as you like), body x forward, y left, z up. The default.
#define FSB_FRAME_Z_UP 0

// World with z down (NED), body x forward, y right, z down (FRD): PX4 and ArduPilot.
#define FSB_FRAME_Z_DOWN 1

// No attitude has come.
#define FSB_ATTITUDE_NONE 0

// Body to world by rows: attitude[3 i + j] is the component of body axis j along world axis i.
#define FSB_ATTITUDE_MATRIX 1

// Body to world as a unit quaternion w, x, y, z in attitude[0..3]; q and -q are the same.
#define FSB_ATTITUDE_QUATERNION 2

// An attitude was none, or cannot be true, and was taken as missing.
#define FSB_EVENT_ATTITUDE_REJECTED 1

// The attitude has turned by more than could be followed: the rotation begins anew, the moments of inertia are held.
#define FSB_EVENT_ATTITUDE_LOST 2

// A position was not finite, beyond its limit or cannot be true, and was taken as missing.
#define FSB_EVENT_POSITION_REJECTED 4

// The origin of the positions has jumped: they were followed, and velocity and mass have not noticed.
#define FSB_EVENT_POSITION_JUMPED 8

// A position came between two measurement instants, and was not taken, but for the last one of jump_after in succession: the
// instants begin anew with it.
#define FSB_EVENT_POSITION_OUT_OF_STEP 16

// A force or a torque was not finite or beyond its limit; the one before was taken in its place.
#define FSB_EVENT_WRENCH_REJECTED 32

// The mass has changed: it is identified anew, the old one held until then, unless it was contradicted.
#define FSB_EVENT_MASS_CHANGED 64

// A moment of inertia has changed: all three are identified anew, the old ones held until then, unless contradicted.
#define FSB_EVENT_INERTIA_CHANGED 128

// The velocity has changed at once by more than any input explains, as in a collision: it was followed, and the mass, where it
// was known, is identified anew, the old one held until then.
#define FSB_EVENT_TRANSLATION_PUSHED 256

// The same for the rates and the moments of inertia.
#define FSB_EVENT_ROTATION_PUSHED 512

// Version of the interface that this header describes: 65536 * major + 256 * minor + patch. Compare it once at
// start-up with fsb_version(): header and library must be of the same version.
#define FSB_VERSION 256

// The paper's lambda and q [1/s]. Each, times the period it runs at, must be within 1e-6..1; q = lambda/2 is
// the paper's choice.
typedef struct fsb_tuning_t {
  // Cut-off of the filters [1/s].
  double lambda;
  // Frequency shift: how fast the window opens [1/s].
  double q;
} fsb_tuning_t;

// When a parameter counts as valid.
typedef struct fsb_rule_t {
  // The smallest k that can be right. 1e-15..1e15.
  double min;
  // The largest k that can be right; above the smallest, up to 1e15.
  double max;
  // The largest sd(k)/k at which k becomes valid; it stays valid up to twice that. 1e-15..1e6.
  double max_relative_sd;
} fsb_rule_t;

// Configuration of an fsb_axis_t. Start from fsb_axis_config_default.
typedef struct fsb_axis_config_t {
  // Control period [s]: the time from one call of apply to the next. 1e-6..1e3.
  double period;
  // Control periods from one measurement to the next, 1..65535.
  uint32_t substeps;
  // Measurements per step of the identifier, 1..65535. More where the measurement rate is high: cheaper,
  // and no less accurate.
  uint32_t block;
  // Measurements by which the turns of this estimator come later, so that several on one processor do not do their
  // rare work in the same tick: 0 for one, 2 for the next. Below `block`, or below 8 where that is more.
  uint32_t turn;
  // FSB_READOUT_LEAST_SQUARES or FSB_READOUT_ABSOLUTE_RATIO.
  uint32_t readout;
  // Tuning of the identifier; runs at period * substeps * block.
  struct fsb_tuning_t identifier;
  // Tuning of the observer; runs at period * substeps.
  struct fsb_tuning_t observer;
  // Standard deviation of a measurement [m or rad] where it is known beforehand, else NaN. 1e-12..1e6.
  double noise_sd;
  // Standard deviation of the acceleration that is not accounted for [m/s^2 or rad/s^2], such as wind, where it is
  // known beforehand, else NaN; noise of the position that wanders by w within 1/lambda of the identifier is one of
  // lambda^2 w. 1e-12..1e6.
  double disturbance_sd;
  // Time constant [s] with which the identifier forgets, at least one of its steps; INFINITY: never.
  double memory_tau;
  // The largest share of the filtered acceleration's mean square that the model may leave unexplained before k
  // is contradicted; above 0, up to 1. NaN: not asked.
  double max_misfit;
  // k is not valid earlier than this after a reset [s]. 0 to 1e9 measurements.
  double parameter_settle;
  // States are not valid earlier than this after the first measurement [s]. 0 to 1e9 measurements.
  double state_settle;
  // A measurement of larger magnitude is rejected [m or rad]. Up to 1e6.
  double position_limit;
  // An input of larger magnitude is rejected [N or N m]. Up to 1e6.
  double input_limit;
  // Known constant drift [m/s^2 or rad/s^2]: -9.81 on an axis that points up, +9.81 on one that points down
  // (NED). Up to 1e6.
  double drift;
  // k that the observer uses until the identified one is valid, else NaN: no state is valid before. 1e-15..1e15.
  double nominal;
  // When k counts as valid.
  struct fsb_rule_t rule;
} fsb_axis_config_t;

// What a function returns: FSB_OK, or why it did not do what it was asked for.
typedef int32_t fsb_status_t;

// One axis: y'' = k f + drift. Storage of the caller; what is in it is the library's.
typedef struct fsb_axis_t {
  // Not to be touched. Copying the whole object is fine, and the copy goes on from there.
  uint64_t opaque[105];
} fsb_axis_t;

// Whether a position and a velocity may be used, and why not. Usable is whatever is FSB_STATE_NOMINAL or more.
typedef int32_t fsb_state_status_t;

// Position and velocity of an axis at the present control instant. Both are NaN where `status` says that they
// may not be used.
typedef struct fsb_state_t {
  // Position [m] or angle [rad], in the frame of the measurement.
  float position;
  // Velocity [m/s] or rate [rad/s].
  float velocity;
  // Whether the two may be used, and why not.
  fsb_state_status_t status;
} fsb_state_t;

// Standard deviations of a state, as measurement noise causes it and what residuals show that the model lacks; NaN until the noise
// is known, and after gaps among the first measurements until 8/lambda of them (of the observer) have come.
typedef struct fsb_state_sd_t {
  // Of the position [m or rad].
  float position;
  // Of the velocity [m/s or rad/s].
  float velocity;
} fsb_state_sd_t;

// Whether a parameter may be used, and why not. Usable is whatever is FSB_PARAMETER_VALID or more.
typedef int32_t fsb_parameter_status_t;

// k, which is 1/mass [1/kg] or 1/inertia [1/(kg m^2)]. `k` and `variance` are NaN where `status` says
// that they may not be used.
typedef struct fsb_parameter_t {
  // Identified k.
  float k;
  // Variance of k.
  float variance;
  // Whether k may be used, and why not.
  fsb_parameter_status_t status;
} fsb_parameter_t;

// Events since the initialisation, a reset does not clear them. They stop at the largest number.
typedef struct fsb_counters_t {
  // Measurements that did not come or were rejected, over all axes.
  uint32_t missed;
  // Measurements that were infinite or beyond the limit.
  uint32_t rejected_measurements;
  // Inputs that were not finite or beyond the limit; the axis's mean input of late was used in their place.
  uint32_t rejected_inputs;
} fsb_counters_t;

// Inner signals of an axis in physical units: for logs and tests, not for control. Not checked for validity.
typedef struct fsb_diagnostics_t {
  // Windowed, filtered acceleration, known drift removed [m/s^2 or rad/s^2].
  float z2;
  // Windowed, filtered input [N or N m].
  float z0;
  // Windowed, filtered one.
  float zu;
  // Innovation of the observer at the last measurement [m or rad].
  float innovation;
  // Variance of the measurement noise as learned so far, from sample to sample [m^2 or rad^2].
  float noise_variance;
  // The same, in the band of the identifier.
  float noise_variance_in_band;
  // Sum over the weighted z2 of the axis's parameter, scaled.
  float numerator;
  // Sum over the weighted z0, scaled alike: the quotient of the two is the newest k, valid or not.
  float denominator;
} fsb_diagnostics_t;

// Configuration of an fsb_rotation_t. Start from fsb_rotation_config_default.
typedef struct fsb_rotation_config_t {
  // Control period [s]: the time from one call of apply to the next. 1e-6..1e3.
  double period;
  // Control periods from one measurement to the next, 1..65535.
  uint32_t substeps;
  // Measurements per step of the identifier, 1..65535. More where the measurement rate is high: cheaper,
  // and no less accurate.
  uint32_t block;
  // Measurements by which the turns of this estimator come later, so that several on one processor do not do their
  // rare work in the same tick: 0 for one, 4 for the next. Below `block`, or below 8 where that is more.
  uint32_t turn;
  // FSB_READOUT_LEAST_SQUARES or FSB_READOUT_ABSOLUTE_RATIO.
  uint32_t readout;
  // Tuning of the identifier; runs at period * substeps * block.
  struct fsb_tuning_t identifier;
  // Tuning of the observer; runs at period * substeps.
  struct fsb_tuning_t observer;
  // Standard deviation of a measurement [rad] where it is known beforehand, else NaN. 1e-12..1e6.
  double noise_sd;
  // Standard deviation of the acceleration that is not accounted for [m/s^2 or rad/s^2], such as wind, where it is
  // known beforehand, else NaN; noise of the position that wanders by w within 1/lambda of the identifier is one of
  // lambda^2 w. 1e-12..1e6.
  double disturbance_sd;
  // Time constant [s] with which the identifier forgets, at least one of its steps; INFINITY: never.
  double memory_tau;
  // The largest share of the filtered acceleration's mean square that the model may leave unexplained before k
  // is contradicted; above 0, up to 1. NaN: not asked.
  double max_misfit;
  // k is not valid earlier than this after a reset [s]. 0 to 1e9 measurements.
  double parameter_settle;
  // States are not valid earlier than this after the first measurement [s]. 0 to 1e9 measurements.
  double state_settle;
  // A measurement of larger magnitude is rejected [rad]. Up to 1e6.
  double position_limit;
  // An input of larger magnitude is rejected [N m]. Up to 1e6.
  double input_limit;
  // Known constant drift of each axis [rad/s^2]. Up to 1e6.
  double drift[3];
  // k of each axis that the observer uses until the identified one is valid, else NaN: no state is valid
  // before. 1e-15..1e15.
  double nominal[3];
  // When k of each axis counts as valid.
  struct fsb_rule_t rule[3];
} fsb_rotation_config_t;

// Three axes with a k each: angles (roll, pitch, yaw) under the torque (x, y, z), k = 1/inertia. Storage of the
// caller; what is in it is the library's.
typedef struct fsb_rotation_t {
  // Not to be touched. Copying the whole object is fine, and the copy goes on from there.
  uint64_t opaque[178];
} fsb_rotation_t;

// Gains and limits of an axis's controller. Start from fsb_tracking_config_default.
typedef struct fsb_tracking_config_t {
  // Gain of the position error [1/s^2]. 1e-15..1e15.
  double kp;
  // Gain of the velocity error [1/s]. 1e-15..1e15.
  double kd;
  // Known drift of the axis [m/s^2 or rad/s^2], as in the estimator; the input makes up for it. Up to 1e6.
  double drift;
  // The smallest k by which the controller divides. 1e-15..1e15.
  double k_min;
  // The largest k by which the controller divides; not below the smallest, up to 1e15.
  double k_max;
} fsb_tracking_config_t;

// The controller of one axis. Storage of the caller; what is in it is the library's.
typedef struct fsb_tracking_t {
  // Not to be touched. Copying the whole object is fine.
  uint64_t opaque[4];
} fsb_tracking_t;

// What an axis shall do now.
typedef struct fsb_reference_t {
  // Position [m or rad].
  float position;
  // Velocity [m/s or rad/s].
  float velocity;
  // Acceleration [m/s^2 or rad/s^2].
  float acceleration;
} fsb_reference_t;

// Configuration of an fsb_translation_t. Start from fsb_translation_config_default.
typedef struct fsb_translation_config_t {
  // Control period [s]: the time from one call of apply to the next. 1e-6..1e3.
  double period;
  // Control periods from one measurement to the next, 1..65535.
  uint32_t substeps;
  // Measurements per step of the identifier, 1..65535. More where the measurement rate is high: cheaper,
  // and no less accurate.
  uint32_t block;
  // Measurements by which the turns of this estimator come later, so that several on one processor do not do their
  // rare work in the same tick: 0 for one, 4 for the next. Below `block`, or below 8 where that is more.
  uint32_t turn;
  // FSB_READOUT_LEAST_SQUARES or FSB_READOUT_ABSOLUTE_RATIO.
  uint32_t readout;
  // Tuning of the identifier; runs at period * substeps * block.
  struct fsb_tuning_t identifier;
  // Tuning of the observer; runs at period * substeps.
  struct fsb_tuning_t observer;
  // Standard deviation of a measurement [m] where it is known beforehand, else NaN. 1e-12..1e6.
  double noise_sd;
  // Standard deviation of the acceleration that is not accounted for [m/s^2 or rad/s^2], such as wind, where it is
  // known beforehand, else NaN; noise of the position that wanders by w within 1/lambda of the identifier is one of
  // lambda^2 w. 1e-12..1e6.
  double disturbance_sd;
  // Time constant [s] with which the identifier forgets, at least one of its steps; INFINITY: never.
  double memory_tau;
  // The largest share of the filtered acceleration's mean square that the model may leave unexplained before k
  // is contradicted; above 0, up to 1. NaN: not asked.
  double max_misfit;
  // k is not valid earlier than this after a reset [s]. 0 to 1e9 measurements.
  double parameter_settle;
  // States are not valid earlier than this after the first measurement [s]. 0 to 1e9 measurements.
  double state_settle;
  // A measurement of larger magnitude is rejected [m]. Up to 1e6.
  double position_limit;
  // An input of larger magnitude is rejected [N]. Up to 1e6.
  double input_limit;
  // Known constant drift of each axis [m/s^2]: -9.81 on an axis that points up, +9.81 on one that points down
  // (NED). Up to 1e6.
  double drift[3];
  // k that the observer uses until the identified one is valid, else NaN: no state is valid before. 1e-15..1e15.
  double nominal;
  // When k counts as valid.
  struct fsb_rule_t rule;
} fsb_translation_config_t;

// Three axes with one k: position (x, y, z) under the force (x, y, z), k = 1/mass. Storage of the caller; what
// is in it is the library's.
typedef struct fsb_translation_t {
  // Not to be touched. Copying the whole object is fine, and the copy goes on from there.
  uint64_t opaque[154];
} fsb_translation_t;

// A parameter in the units of an engineer. All NaN where the parameter is not valid.
typedef struct fsb_parameter_report_t {
  // Standard deviation of k.
  float k_sd;
  // 1/k: mass [kg] or inertia [kg m^2].
  float inverse;
  // Standard deviation of 1/k.
  float inverse_sd;
} fsb_parameter_report_t;

// What makes a measurement one that cannot be true. It is left out and counted then.
typedef struct fsb_guard_t {
  // A step of the innovation of more than so many of its standard deviations is improbable. 3..1000.
  double sigmas;
  // The largest acceleration that the model may not know of [m/s^2 or rad/s^2]: a load dropped, wind. 0..1e6.
  double acceleration;
  // Steps up to this always pass [m or rad]: a few quanta of the sensor. 0..1e6.
  double floor;
  // Gaps up to this are bridged by prediction [s]; after longer ones the state is stale and begins anew, masses and
  // inertias being held. In whole measurements, 1 to 65534 of them.
  double bridge;
  // So many improbable measurements in a row that agree with each other are a jump of the sensor. 2..65535.
  uint32_t jump_after;
  // A measurement whose bits have been the same for more than so many samples is one of a frozen sensor; 0: never.
  // Up to 65535.
  uint32_t frozen_after;
} fsb_guard_t;

// One of the two groups of axes: x, y, z, or the angles about the body's axes.
typedef struct fsb_vehicle_group_t {
  // Control periods from one measurement to the next, 1..65535.
  uint32_t substeps;
  // Control periods by which a measurement is late: what is given at an update was true so many periods before.
  // Up to FSB_VEHICLE_MAX_LATENCY; that of the translation not below that of the rotation.
  uint32_t latency;
  // Measurements per step of the identifier, 1..65535. More where the measurement rate is high: cheaper.
  uint32_t block;
  // FSB_READOUT_LEAST_SQUARES or FSB_READOUT_ABSOLUTE_RATIO.
  uint32_t readout;
  // Tuning of the identifier; runs at period * substeps * block.
  struct fsb_tuning_t identifier;
  // Tuning of the observer; runs at period * substeps.
  struct fsb_tuning_t observer;
  // Standard deviation of a measurement [m or rad] where it is known beforehand, else NaN. 1e-12..1e6.
  double noise_sd;
  // Standard deviation of the acceleration that is not accounted for [m/s^2 or rad/s^2], such as wind, where it is
  // known beforehand, else NaN. 1e-12..1e6.
  double disturbance_sd;
  // Time constant [s] with which the identifier forgets, at least one of its steps; INFINITY: never.
  double memory_tau;
  // The largest relative standard deviation at which a parameter becomes valid. 1e-15..1e6.
  double max_relative_sd;
  // The largest share of the filtered acceleration's mean square that the model may leave unexplained before a
  // parameter is contradicted; above 0, up to 1. NaN: not asked.
  double max_misfit;
  // No parameter is valid earlier than this after a reset [s]. 0 to 1e9 measurements.
  double parameter_settle;
  // States are not valid earlier than this after the first measurement [s]. 0 to 1e9 measurements.
  double state_settle;
  // What cannot be true.
  struct fsb_guard_t guard;
  // A position, or a body angle, of larger magnitude is rejected [m or rad]. Up to 1e6.
  double measurement_limit;
  // A force or torque with a larger component is rejected [N or N m]. Up to 5e5; best what the actuators can do.
  double input_limit;
} fsb_vehicle_group_t;

// What is known of a mass [kg] or a moment of inertia [kg m^2] beforehand; fsb_expected_about fills it in.
typedef struct fsb_expected_t {
  // Predicted with until the parameter is identified. 1e-12..1e12. NaN: not known, and no state is handed out before.
  double nominal;
  // The smallest that can be right. 1e-12..1e12. A smaller estimate is never used.
  double min;
  // The largest that can be right; above the smallest, up to 1e12.
  double max;
} fsb_expected_t;

// When a change of mass or inertia is taken as such, and identified anew.
typedef struct fsb_change_t {
  // The smallest change to react to, relative: 0.15 is a good choice. 1e-3..1e3; 0: changes are not looked for.
  double relative;
  // By how many of its standard deviations the change must show. 1..1e3.
  double sigmas;
  // Time after a start or a change in which nothing is decided [s]. 0..1e6.
  double hold_off;
} fsb_change_t;

// Configuration of an fsb_vehicle_t. Start from fsb_vehicle_config_default.
typedef struct fsb_vehicle_config_t {
  // Control period [s]: the time from one update to the next. 1e-6..1e3.
  double period;
  // FSB_FRAME_Z_UP or FSB_FRAME_Z_DOWN: the axes of everything that goes in and out.
  uint32_t frame;
  // x, y, z, pooled into the mass.
  struct fsb_vehicle_group_t translation;
  // Angles about the body's x, y, z, each with its moment of inertia.
  struct fsb_vehicle_group_t rotation;
  // Gravity [m/s^2], downwards whatever the frame. 0..1e6.
  double gravity;
  // Mass [kg].
  struct fsb_expected_t mass;
  // Moments of inertia about the body's x, y, z [kg m^2].
  struct fsb_expected_t inertia[3];
  // Time constant of force and torque behind what the actuators are told, first order [s]: from a twentieth of the
  // period to 1e3, or 0 where they follow at once.
  double actuator_lag;
  // When a change of load is taken as such.
  struct fsb_change_t change;
} fsb_vehicle_config_t;

// What was measured and has arrived by now. Start from fsb_measured_none.
typedef struct fsb_measured_t {
  // x, y, z in the world frame [m]; NaN, all three, where none has come.
  float position[3];
  // FSB_ATTITUDE_NONE, FSB_ATTITUDE_MATRIX or FSB_ATTITUDE_QUATERNION: what `attitude` holds.
  uint32_t attitude_kind;
  // Body to world, in that form.
  float attitude[9];
} fsb_measured_t;

// Mass, moments of inertia, position, velocity, attitude and body rates of a vehicle at any attitude, from positions and
// attitudes and from what its actuators did. Storage of the caller, static or a member: too large for most stacks.
typedef struct fsb_vehicle_t {
  // Not to be touched. Copying the whole object is fine, and the copy goes on from there.
  uint64_t opaque[1352];
} fsb_vehicle_t;

// Force and torque on the body about its centre of mass, along the body's axes.
typedef struct fsb_wrench_t {
  // Force [N], gravity not included.
  float force[3];
  // Torque [N m], the gyroscopic moment not included.
  float torque[3];
} fsb_wrench_t;

// The state now. What may not be used is NaN; the two `..._status` say why.
typedef struct fsb_vehicle_state_t {
  // World frame [m].
  float position[3];
  // World frame [m/s].
  float velocity[3];
  // Body to world by rows: attitude[3 i + j] is the component of body axis j along world axis i. While the rates are
  // not known yet it is the attitude as measured, if that is of now.
  float attitude[9];
  // About the body's axes [rad/s].
  float rates[3];
  // Whether position and velocity may be used, and why not: usable is FSB_STATE_NOMINAL or more.
  fsb_state_status_t translation_status;
  // The same for the rates.
  fsb_state_status_t rotation_status;
} fsb_vehicle_state_t;

// An identified mass [kg] or moment of inertia [kg m^2]. `value` and `variance` are NaN where `status` says that they may
// not be used.
typedef struct fsb_identified_t {
  // Mass or moment of inertia.
  float value;
  // Its variance; the square root of it is the standard deviation. For a while after a change (`mass_changed`, `inertia_changed`) it has the
  // distance from the value before in it: a torque or force that nobody told may have been taken for the change.
  float variance;
  // Whether it may be used, and why not: usable is FSB_PARAMETER_VALID or more. Its k is 1/value: FSB_PARAMETER_BELOW is
  // a mass that is too large.
  fsb_parameter_status_t status;
} fsb_identified_t;

// What is predicted with, and what a controller may divide by: identified, else held, else nominal; else NaN.
typedef struct fsb_vehicle_model_t {
  // Mass [kg].
  float mass;
  // Moments of inertia [kg m^2].
  float inertia[3];
} fsb_vehicle_model_t;

// How often what happened since the initialisation; a reset does not clear them. They stop at the largest number.
typedef struct fsb_vehicle_counters_t {
  // FSB_EVENT_ATTITUDE_REJECTED
  uint32_t rejected_attitudes;
  // FSB_EVENT_ATTITUDE_LOST
  uint32_t lost_attitudes;
  // FSB_EVENT_POSITION_REJECTED
  uint32_t rejected_positions;
  // FSB_EVENT_POSITION_JUMPED
  uint32_t position_jumps;
  // FSB_EVENT_POSITION_OUT_OF_STEP
  uint32_t positions_out_of_step;
  // FSB_EVENT_WRENCH_REJECTED
  uint32_t rejected_wrenches;
  // FSB_EVENT_MASS_CHANGED
  uint32_t mass_changes;
  // FSB_EVENT_INERTIA_CHANGED
  uint32_t inertia_changes;
  // FSB_EVENT_TRANSLATION_PUSHED
  uint32_t translation_pushes;
  // FSB_EVENT_ROTATION_PUSHED
  uint32_t rotation_pushes;
} fsb_vehicle_counters_t;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The configuration for a control period [s], which is not checked here: every tick measured, no blocks, lambda
// 2 and q 1 for the identifier, 10 and 5 for the observer, least squares that never forget, no drift, no
// nominal k.
struct fsb_axis_config_t fsb_axis_config_default(double period);

// Starts an estimator in the caller's storage. Nothing else may be called with it before; calling it again
// starts anew.
//
// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, or FSB_CONFIG_...: then `*parameter` names the parameter at fault
// as it is written in the configuration ("observer.lambda"; static storage), and the object is not initialised.
// Without a fault `*parameter` becomes NULL; `parameter` itself may be NULL. Not for the tick: exponentials in
// double precision.
fsb_status_t fsb_axis_init(struct fsb_axis_t *estimator,
                           const struct fsb_axis_config_t *config,
                           const char **parameter);

// Forgets everything but the configuration, what was said about learning and the counters. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
// FSB_NOT_INITIALISED.
fsb_status_t fsb_axis_reset(struct fsb_axis_t *estimator);

// Starts the identification anew, the observer going on with the nominal k. For a known change of load. Errors:
// FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED.
fsb_status_t fsb_axis_reset_identifier(struct fsb_axis_t *estimator);

// Starts the identification anew, what is known being held: a k that is valid goes on being handed out
// (FSB_PARAMETER_HELD) and predicted with until the new one is valid. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
// FSB_NOT_INITIALISED.
fsb_status_t fsb_axis_reinitialise_identifier(struct fsb_axis_t *estimator);

// Whether to learn from now on: FSB_LEARNING_ON, FSB_LEARNING_OFF or FSB_LEARNING_CONTACT. When learning resumes
// the identification begins anew, what is known being held. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
// FSB_NOT_INITIALISED, FSB_UNKNOWN_VALUE.
fsb_status_t fsb_axis_set_learning(struct fsb_axis_t *estimator,
                                   uint32_t learning);

// Takes the position [m or rad] at the present instant; NaN where the measurement is missing. Comes before
// apply, every `substeps` ticks. An instant at which it is not called counts as missed on its own.
//
// What is infinite or beyond the limit is rejected, counted, and treated as missing. Errors: FSB_NULL_POINTER,
// FSB_MISALIGNED, FSB_NOT_INITIALISED, FSB_OUT_OF_STEP; nothing has changed then. For the tick: bounded work.
fsb_status_t fsb_axis_measure(struct fsb_axis_t *estimator,
                              const float *position);

// Takes the input [N or N m] held over the control period that begins now, once a tick. Give what the actuators
// really do (saturated, and with their lag where it is known).
//
// Not finite or beyond the limit: rejected, counted, and replaced by the axis's mean input of late. Nothing happens before
// the first measurement. Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED. For the tick: bounded
// work.
fsb_status_t fsb_axis_apply(struct fsb_axis_t *estimator,
                            const float *input);

// As fsb_axis_apply, for an input that goes linearly from `from` to `to` over the control period.
fsb_status_t fsb_axis_apply_ramp(struct fsb_axis_t *estimator, const float *from, const float *to);

// Hands out the state at the present control instant, predicted from the last measurement with what was applied
// since. What is not valid is NaN and its `status` says why.
//
// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED; `state` holds NaN then, where it can be
// written. For the tick.
fsb_status_t fsb_axis_state(const struct fsb_axis_t *estimator,
                            struct fsb_state_t *state);

// Hands out the standard deviations of the state, as measurement noise causes it and what residuals show that the model lacks; NaN
// until the noise is known, and after gaps among the first measurements until 8/lambda of them have come.
// Errors as fsb_axis_state. Uses square roots: for logs, not for the tick.
fsb_status_t fsb_axis_state_sd(const struct fsb_axis_t *estimator,
                               struct fsb_state_sd_t *sd);

// Hands out the parameter. What is not valid is NaN and its `status` says why. Errors as fsb_axis_state. For
// the tick; for mass or inertia in SI units and standard deviations see fsb_parameter_report.
fsb_status_t fsb_axis_parameter(const struct fsb_axis_t *estimator,
                                struct fsb_parameter_t *parameter);

// Hands out what was missed or rejected. Errors as fsb_axis_state; the counters are zero then. For the tick.
fsb_status_t fsb_axis_counters(const struct fsb_axis_t *estimator,
                               struct fsb_counters_t *counters);

// Hands out inner signals, for logs and tests. Errors as fsb_axis_state. Not for the tick: divisions.
fsb_status_t fsb_axis_diagnostics(const struct fsb_axis_t *estimator,
                                  struct fsb_diagnostics_t *diagnostics);

// The configuration for a control period [s], which is not checked here: every tick measured, no blocks, lambda
// 2 and q 1 for the identifier, 10 and 5 for the observer, least squares that never forget, no drift, no
// nominal k.
struct fsb_rotation_config_t fsb_rotation_config_default(double period);

// Starts an estimator in the caller's storage. Nothing else may be called with it before; calling it again
// starts anew.
//
// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, or FSB_CONFIG_...: then `*parameter` names the parameter at fault
// as it is written in the configuration ("observer.lambda"; static storage), and the object is not initialised.
// Without a fault `*parameter` becomes NULL; `parameter` itself may be NULL. Not for the tick: exponentials in
// double precision.
fsb_status_t fsb_rotation_init(struct fsb_rotation_t *estimator,
                               const struct fsb_rotation_config_t *config,
                               const char **parameter);

// Forgets everything but the configuration, what was said about learning and the counters. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
// FSB_NOT_INITIALISED.
fsb_status_t fsb_rotation_reset(struct fsb_rotation_t *estimator);

// Starts the identification anew, the observer going on with the nominal k. For a known change of load. Errors:
// FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED.
fsb_status_t fsb_rotation_reset_identifier(struct fsb_rotation_t *estimator);

// Starts the identification anew, what is known being held: a k that is valid goes on being handed out
// (FSB_PARAMETER_HELD) and predicted with until the new one is valid. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
// FSB_NOT_INITIALISED.
fsb_status_t fsb_rotation_reinitialise_identifier(struct fsb_rotation_t *estimator);

// Whether to learn from now on: FSB_LEARNING_ON, FSB_LEARNING_OFF or FSB_LEARNING_CONTACT. When learning resumes
// the identification begins anew, what is known being held. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
// FSB_NOT_INITIALISED, FSB_UNKNOWN_VALUE.
fsb_status_t fsb_rotation_set_learning(struct fsb_rotation_t *estimator,
                                       uint32_t learning);

// Takes the angles [rad] at the present instant; NaN where a measurement is missing. Comes before apply, every
// `substeps` ticks. An instant at which it is not called counts as missed on its own.
//
// The estimator starts at the first instant at which every axis is measured; what comes before only counts.
// What is infinite or beyond the limit is rejected, counted, and treated as missing. Errors: FSB_NULL_POINTER,
// FSB_MISALIGNED, FSB_NOT_INITIALISED, FSB_OUT_OF_STEP; nothing has changed then. For the tick: bounded work.
fsb_status_t fsb_rotation_measure(struct fsb_rotation_t *estimator,
                                  const float angle[3]);

// Takes the torques [N m] held over the control period that begins now, once a tick. Give what the actuators
// really do (saturated, and with their lag where it is known).
//
// Not finite or beyond the limit: rejected, counted, and replaced by the axis's mean input of late. Nothing happens before
// the first measurement. Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED. For the tick: bounded
// work.
fsb_status_t fsb_rotation_apply(struct fsb_rotation_t *estimator,
                                const float input[3]);

// As fsb_rotation_apply, for an input that goes linearly from `from` to `to` over the control period.
fsb_status_t fsb_rotation_apply_ramp(struct fsb_rotation_t *estimator,
                                     const float from[3],
                                     const float to[3]);

// Hands out the three states at the present control instant, predicted from the last measurement with what was
// applied since. What is not valid is NaN and its `status` says why.
//
// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED; `state` holds NaN then, where it can be
// written. For the tick.
fsb_status_t fsb_rotation_states(const struct fsb_rotation_t *estimator,
                                 struct fsb_state_t state[3]);

// Hands out the standard deviations of the three states, as measurement noise causes it and what residuals show that the model lacks; NaN
// until the noise is known, and after gaps among the first measurements until 8/lambda of them have come.
// Errors as fsb_rotation_states. Uses square roots: for logs, not for the tick.
fsb_status_t fsb_rotation_state_sd(const struct fsb_rotation_t *estimator,
                                   struct fsb_state_sd_t sd[3]);

// Hands out the three parameters 1/inertia. What is not valid is NaN and its `status` says why. Errors as
// fsb_rotation_states. For the tick; for mass or inertia in SI units and standard deviations see
// fsb_parameter_report.
fsb_status_t fsb_rotation_parameters(const struct fsb_rotation_t *estimator,
                                     struct fsb_parameter_t parameter[3]);

// Hands out what was missed or rejected. Errors as fsb_rotation_states; the counters are zero then. For the tick.
fsb_status_t fsb_rotation_counters(const struct fsb_rotation_t *estimator,
                                   struct fsb_counters_t *counters);

// Hands out inner signals, for logs and tests. Errors as fsb_rotation_states. Not for the tick: divisions.
fsb_status_t fsb_rotation_diagnostics(const struct fsb_rotation_t *estimator,
                                      struct fsb_diagnostics_t diagnostics[3]);

// The name of a status code as it stands in this header, "FSB_OK"; "FSB_UNKNOWN" for a number that is none.
// Static storage, never NULL.
const char *fsb_status_name(fsb_status_t status);

// Gains as given, no drift, any k from 1e-6 to 1e9. With the true k a position error e then obeys e'' + kd e' +
// kp e = 0.
struct fsb_tracking_config_t fsb_tracking_config_default(double kp,
                                                         double kd);

// Starts a controller in the caller's storage.
//
// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, or FSB_CONFIG_...: then `*parameter` names the parameter at fault
// (static storage), and the object is not initialised. Without a fault `*parameter` becomes NULL; `parameter`
// itself may be NULL.
fsb_status_t fsb_tracking_init(struct fsb_tracking_t *controller,
                               const struct fsb_tracking_config_t *config,
                               const char **parameter);

// Hands out the input [N or N m] that makes the axis follow `reference` from `state`: (acceleration - drift -
// kd (velocity error) - kp (position error)) / k. `k` is the identified one where it is valid, else the nominal
// one. `state` may come from another estimator: only its position and velocity are read.
//
// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED, FSB_PARAMETER_OUT_OF_RANGE, FSB_NOT_FINITE (a
// state that is not valid is NaN); `input` becomes NaN then, where it can be written. What to do instead (hold,
// descend, hand over) is the caller's decision. For the tick.
fsb_status_t fsb_tracking_input(const struct fsb_tracking_t *controller,
                                const struct fsb_reference_t *reference,
                                const struct fsb_state_t *state,
                                float k,
                                float *input);

// Turns a force from the world frame into the body frame, F = R^T f. `attitude` is the rotation from body to
// world by rows: attitude[3 i + j] is the component of body axis j along world axis i. `body` may be `world`.
//
// Errors: FSB_NULL_POINTER, FSB_MISALIGNED. Values are not checked: NaN in, NaN out. For the tick.
fsb_status_t fsb_to_body(const float attitude[9],
                         const float world[3],
                         float body[3]);

// The configuration for a control period [s], which is not checked here: every tick measured, no blocks, lambda
// 2 and q 1 for the identifier, 10 and 5 for the observer, least squares that never forget, no drift, no
// nominal k.
struct fsb_translation_config_t fsb_translation_config_default(double period);

// Starts an estimator in the caller's storage. Nothing else may be called with it before; calling it again
// starts anew.
//
// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, or FSB_CONFIG_...: then `*parameter` names the parameter at fault
// as it is written in the configuration ("observer.lambda"; static storage), and the object is not initialised.
// Without a fault `*parameter` becomes NULL; `parameter` itself may be NULL. Not for the tick: exponentials in
// double precision.
fsb_status_t fsb_translation_init(struct fsb_translation_t *estimator,
                                  const struct fsb_translation_config_t *config,
                                  const char **parameter);

// Forgets everything but the configuration, what was said about learning and the counters. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
// FSB_NOT_INITIALISED.
fsb_status_t fsb_translation_reset(struct fsb_translation_t *estimator);

// Starts the identification anew, the observer going on with the nominal k. For a known change of load. Errors:
// FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED.
fsb_status_t fsb_translation_reset_identifier(struct fsb_translation_t *estimator);

// Starts the identification anew, what is known being held: a k that is valid goes on being handed out
// (FSB_PARAMETER_HELD) and predicted with until the new one is valid. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
// FSB_NOT_INITIALISED.
fsb_status_t fsb_translation_reinitialise_identifier(struct fsb_translation_t *estimator);

// Whether to learn from now on: FSB_LEARNING_ON, FSB_LEARNING_OFF or FSB_LEARNING_CONTACT. When learning resumes
// the identification begins anew, what is known being held. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
// FSB_NOT_INITIALISED, FSB_UNKNOWN_VALUE.
fsb_status_t fsb_translation_set_learning(struct fsb_translation_t *estimator,
                                          uint32_t learning);

// Takes the positions x, y, z [m] at the present instant; NaN where a measurement is missing. Comes before
// apply, every `substeps` ticks. An instant at which it is not called counts as missed on its own.
//
// The estimator starts at the first instant at which every axis is measured; what comes before only counts.
// What is infinite or beyond the limit is rejected, counted, and treated as missing. Errors: FSB_NULL_POINTER,
// FSB_MISALIGNED, FSB_NOT_INITIALISED, FSB_OUT_OF_STEP; nothing has changed then. For the tick: bounded work.
fsb_status_t fsb_translation_measure(struct fsb_translation_t *estimator,
                                     const float position[3]);

// Takes the forces x, y, z [N] held over the control period that begins now, once a tick. Give what the
// actuators really do (saturated, and with their lag where it is known).
//
// Not finite or beyond the limit: rejected, counted, and replaced by the axis's mean input of late. Nothing happens before
// the first measurement. Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED. For the tick: bounded
// work.
fsb_status_t fsb_translation_apply(struct fsb_translation_t *estimator,
                                   const float input[3]);

// As fsb_translation_apply, for an input that goes linearly from `from` to `to` over the control period.
fsb_status_t fsb_translation_apply_ramp(struct fsb_translation_t *estimator,
                                        const float from[3],
                                        const float to[3]);

// Hands out the three states at the present control instant, predicted from the last measurement with what was
// applied since. What is not valid is NaN and its `status` says why.
//
// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED; `state` holds NaN then, where it can be
// written. For the tick.
fsb_status_t fsb_translation_states(const struct fsb_translation_t *estimator,
                                    struct fsb_state_t state[3]);

// Hands out the standard deviations of the three states, as measurement noise causes it and what residuals show that the model lacks; NaN
// until the noise is known, and after gaps among the first measurements until 8/lambda of them have come.
// Errors as fsb_translation_states. Uses square roots: for logs, not for the tick.
fsb_status_t fsb_translation_state_sd(const struct fsb_translation_t *estimator,
                                      struct fsb_state_sd_t sd[3]);

// Hands out the parameter 1/mass. What is not valid is NaN and its `status` says why. Errors as
// fsb_translation_states. For the tick; for mass or inertia in SI units and standard deviations see
// fsb_parameter_report.
fsb_status_t fsb_translation_parameters(const struct fsb_translation_t *estimator,
                                        struct fsb_parameter_t *parameter);

// Hands out what was missed or rejected. Errors as fsb_translation_states; the counters are zero then. For the tick.
fsb_status_t fsb_translation_counters(const struct fsb_translation_t *estimator,
                                      struct fsb_counters_t *counters);

// Hands out inner signals, for logs and tests. Errors as fsb_translation_states. Not for the tick: divisions.
fsb_status_t fsb_translation_diagnostics(const struct fsb_translation_t *estimator,
                                         struct fsb_diagnostics_t diagnostics[3]);

// Standard deviation of k, and mass or inertia with its standard deviation.
//
// FSB_NOT_VALID (and NaN in `report`) where the parameter is not valid. Uses two square roots: for logs, not
// for the tick.
fsb_status_t fsb_parameter_report(const struct fsb_parameter_t *parameter,
                                  struct fsb_parameter_report_t *report);

// The name of a state status as it stands in this header. Static storage, never NULL.
const char *fsb_state_status_name(fsb_state_status_t status);

// The name of a parameter status as it stands in this header. Static storage, never NULL.
const char *fsb_parameter_status_name(fsb_parameter_status_t status);

// The configuration for a control period [s], which is not checked here: z up, every period measured and nothing late,
// lambda 4 for both identifiers, 10 and 20 for the observers of translation and rotation, q half of it, least squares
// that never forget, valid at 5 %, gravity 9.81, mass within 1 g and 1000 kg, inertia within 1e-7 and 1000 kg m^2, no
// nominal values (no state before mass and inertia are identified: set `mass` and `inertia` with fsb_expected_about), no
// lag, changes not looked for.
struct fsb_vehicle_config_t fsb_vehicle_config_default(double period);

// A mass or moment of inertia of roughly `nominal`: within a tenth and ten times of it.
struct fsb_expected_t fsb_expected_about(double nominal);

// Nothing measured: position NaN, no attitude. Fill in what has come. For the tick.
struct fsb_measured_t fsb_measured_none(void);

// Starts an estimator in the caller's storage. Nothing else may be called with it before; calling it again starts anew.
//
// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, or FSB_CONFIG_...: then `*parameter` names the parameter at fault as it is
// written in the configuration ("rotation.observer.lambda"; static storage), and the object is not initialised. Without
// a fault `*parameter` becomes NULL; `parameter` itself may be NULL. Not for the tick: exponentials in double precision,
// and about 12 KiB of stack on a Cortex-M4F (an update takes 1.2 KiB).
fsb_status_t fsb_vehicle_init(struct fsb_vehicle_t *vehicle,
                              const struct fsb_vehicle_config_t *config,
                              const char **parameter);

// Forgets everything but the configuration, what was said about learning and the counters. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
// FSB_NOT_INITIALISED.
fsb_status_t fsb_vehicle_reset(struct fsb_vehicle_t *vehicle);

// Identifies the parameters of a group anew, as after a known change of load: what is known goes on being handed out
// (FSB_PARAMETER_HELD) and used until the new value is valid. `group`: FSB_GROUP_TRANSLATION or FSB_GROUP_ROTATION.
// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED, FSB_UNKNOWN_VALUE.
fsb_status_t fsb_vehicle_reinitialise(struct fsb_vehicle_t *vehicle,
                                      uint32_t group);

// Whether to learn from now on: FSB_LEARNING_ON, FSB_LEARNING_OFF or, on the ground, FSB_LEARNING_CONTACT. When learning
// resumes the identification begins anew, what is known being held. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
// FSB_NOT_INITIALISED, FSB_UNKNOWN_VALUE.
fsb_status_t fsb_vehicle_set_learning(struct fsb_vehicle_t *vehicle,
                                      uint32_t learning);

// One control period has ended. `measured` is what has arrived by now; `applied` is the force and torque that the
// actuators held over the period that ends now, or were told where `actuator_lag` is set. Once per control period; what
// is measured less often or not at all is missing. At the very first call, which ends no period, `applied` does not
// matter.
//
// What is not finite, beyond its limit or cannot be true is left out, counted, and told in `*events`, the sum of
// FSB_EVENT_...; `events` may be NULL. Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED, FSB_UNKNOWN_VALUE
// (`attitude_kind`); nothing has changed then, and `*events` is 0. For the tick: bounded work.
fsb_status_t fsb_vehicle_update(struct fsb_vehicle_t *vehicle,
                                const struct fsb_measured_t *measured,
                                const struct fsb_wrench_t *applied,
                                uint32_t *events);

// The control loop has been late by so many control periods, before the fsb_vehicle_update that ends the last of them: as many
// updates with nothing measured and with the wrench of the last one, at most those of twice `guard.bridge`. That is the wrench of the
// period before: where the actuators have been told another one since, as many updates with that one and with nothing measured are
// right, and this is only nearly so. Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED.
fsb_status_t fsb_vehicle_missed(struct fsb_vehicle_t *vehicle,
                                uint32_t periods);

// Hands out position, velocity, attitude and rates now, predicted over what measurements are late. What is not valid is
// NaN and a status says why.
//
// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED; `state` holds NaN then, where it can be written. For the
// tick: the work grows with the latency.
fsb_status_t fsb_vehicle_state(const struct fsb_vehicle_t *vehicle,
                               struct fsb_vehicle_state_t *state);

// Hands out the mass. What is not valid is NaN and its `status` says why. Errors as fsb_vehicle_state. For the tick.
fsb_status_t fsb_vehicle_mass(const struct fsb_vehicle_t *vehicle,
                              struct fsb_identified_t *mass);

// Hands out the moments of inertia about the body's x, y, z. Errors as fsb_vehicle_state. For the tick.
fsb_status_t fsb_vehicle_inertia(const struct fsb_vehicle_t *vehicle,
                                 struct fsb_identified_t inertia[3]);

// Hands out the mass and the moments of inertia that the state is predicted with, and that a controller may divide by.
// Errors as fsb_vehicle_state. For the tick.
fsb_status_t fsb_vehicle_model(const struct fsb_vehicle_t *vehicle,
                               struct fsb_vehicle_model_t *model);

// Hands out what was rejected, lost or changed. Errors as fsb_vehicle_state; the counters are zero then. For the tick.
fsb_status_t fsb_vehicle_counters(const struct fsb_vehicle_t *vehicle,
                                  struct fsb_vehicle_counters_t *counters);

// Hands out inner signals of x, y, z and of the angles about the body's x, y, z, in the axes of FSB_FRAME_Z_UP: for logs
// and tests. Errors as fsb_vehicle_state. Not for the tick: divisions.
fsb_status_t fsb_vehicle_diagnostics(const struct fsb_vehicle_t *vehicle,
                                     struct fsb_diagnostics_t diagnostics[6]);

// Version of the library, coded as FSB_VERSION.
uint32_t fsb_version(void);

// Version of the library as text, "0.1.0". Static storage, never NULL.
const char *fsb_version_text(void);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

// The compiler agrees with the library on the storage. Where one of these fails, the two are for different ABIs.
FSB_STATIC_ASSERT(sizeof(fsb_axis_t) == FSB_AXIS_SIZE, axis_size);
FSB_STATIC_ASSERT(FSB_ALIGNOF(fsb_axis_t) == FSB_AXIS_ALIGNMENT, axis_alignment);
FSB_STATIC_ASSERT(sizeof(fsb_translation_t) == FSB_TRANSLATION_SIZE, translation_size);
FSB_STATIC_ASSERT(FSB_ALIGNOF(fsb_translation_t) == FSB_TRANSLATION_ALIGNMENT, translation_alignment);
FSB_STATIC_ASSERT(sizeof(fsb_rotation_t) == FSB_ROTATION_SIZE, rotation_size);
FSB_STATIC_ASSERT(FSB_ALIGNOF(fsb_rotation_t) == FSB_ROTATION_ALIGNMENT, rotation_alignment);
FSB_STATIC_ASSERT(sizeof(fsb_vehicle_t) == FSB_VEHICLE_SIZE, vehicle_size);
FSB_STATIC_ASSERT(FSB_ALIGNOF(fsb_vehicle_t) == FSB_VEHICLE_ALIGNMENT, vehicle_alignment);
FSB_STATIC_ASSERT(sizeof(fsb_tracking_t) == FSB_TRACKING_SIZE, tracking_size);
FSB_STATIC_ASSERT(FSB_ALIGNOF(fsb_tracking_t) == FSB_TRACKING_ALIGNMENT, tracking_alignment);

#endif
