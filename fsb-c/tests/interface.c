/* The interface against a careless caller, every function of it: NULL, misaligned and uninitialised objects, objects of
 * another kind, refused configurations, values that are not valid. Flying right is tested by examples/fly.c.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "fsb.h"

static int checks, failures;

#define CHECK(condition) check((condition) ? 1 : 0, #condition, __LINE__)

static void check(int holds, const char *what, int line) {
  checks++;
  if (!holds) {
    failures++;
    printf("line %d: not so: %s\n", line, what);
  }
}

/* Room for the largest object and a step aside. */
typedef union {
  fsb_axis_t axis;
  fsb_translation_t translation;
  fsb_rotation_t rotation;
  fsb_tracking_t tracking;
  fsb_vehicle_t vehicle;
  unsigned char bytes[FSB_VEHICLE_SIZE + 8];
} storage;

static storage object;
static const float numbers[3] = {0.1f, 0.2f, 0.3f};
static void *unplaced_of[2]; /* only its address is used */
static unsigned char *const unplaced = (unsigned char *)unplaced_of;

static int is_nan3(const fsb_state_t *s, int n) {
  for (int i = 0; i < n; i++)
    if (!isnan(s[i].position) || !isnan(s[i].velocity) || s[i].status != FSB_STATE_UNKNOWN) return 0;
  return 1;
}

static void fill(void *out, size_t size) { memset(out, 0x41, size); }

/* Every function of a kind on an object that it must refuse with `expected`. `n` axes, `p` parameters. */
#define REFUSED_BY(kind, STATES, PARAMETERS, pointer, n, p, expected)                                    \
  do {                                                                                                  \
    struct fsb_##kind##_t *refused = (struct fsb_##kind##_t *)(void *)(pointer);                          \
    fsb_state_t s[3];                                                                                   \
    fsb_state_sd_t sd[3];                                                                               \
    fsb_parameter_t k[3];                                                                               \
    fsb_counters_t c;                                                                                   \
    fsb_diagnostics_t d[3];                                                                             \
    fill(s, sizeof s);                                                                                  \
    fill(sd, sizeof sd);                                                                                \
    fill(k, sizeof k);                                                                                  \
    fill(&c, sizeof c);                                                                                 \
    fill(d, sizeof d);                                                                                  \
    CHECK(fsb_##kind##_reset(refused) == (expected));                                                   \
    CHECK(fsb_##kind##_reset_identifier(refused) == (expected));                                        \
    CHECK(fsb_##kind##_reinitialise_identifier(refused) == (expected));                                 \
    CHECK(fsb_##kind##_set_learning(refused, FSB_LEARNING_ON) == (expected));                           \
    CHECK(fsb_##kind##_measure(refused, numbers) == (expected));                                        \
    CHECK(fsb_##kind##_apply(refused, numbers) == (expected));                                          \
    CHECK(fsb_##kind##_apply_ramp(refused, numbers, numbers) == (expected));                            \
    CHECK(fsb_##kind##_##STATES(refused, s) == (expected) && is_nan3(s, n));                            \
    CHECK(fsb_##kind##_state_sd(refused, sd) == (expected) && isnan(sd[0].position) && isnan(sd[(n)-1].velocity)); \
    CHECK(fsb_##kind##_##PARAMETERS(refused, k) == (expected) && isnan(k[0].k) && isnan(k[(p)-1].variance)); \
    CHECK(k[(p)-1].status == FSB_PARAMETER_UNKNOWN);                                                    \
    CHECK(fsb_##kind##_counters(refused, &c) == (expected) && c.missed == 0 && c.rejected_inputs == 0); \
    CHECK(fsb_##kind##_diagnostics(refused, d) == (expected) && isnan(d[0].z0) && isnan(d[(n)-1].innovation)); \
  } while (0)

/* Every other pointer of a kind that is initialised: NULL, and misaligned. */
#define POINTERS_OF(kind, STATES, PARAMETERS, good)                                                      \
  do {                                                                                                  \
    unsigned char *bytes = object.bytes; /* only its address is used */                                 \
    const float *odd = (const float *)(const void *)(bytes + 1);                                        \
    CHECK(fsb_##kind##_measure(good, NULL) == FSB_NULL_POINTER);                                        \
    CHECK(fsb_##kind##_measure(good, odd) == FSB_MISALIGNED);                                           \
    CHECK(fsb_##kind##_apply(good, NULL) == FSB_NULL_POINTER);                                          \
    CHECK(fsb_##kind##_apply(good, odd) == FSB_MISALIGNED);                                             \
    CHECK(fsb_##kind##_apply_ramp(good, NULL, numbers) == FSB_NULL_POINTER);                            \
    CHECK(fsb_##kind##_apply_ramp(good, numbers, NULL) == FSB_NULL_POINTER);                            \
    CHECK(fsb_##kind##_apply_ramp(good, numbers, odd) == FSB_MISALIGNED);                               \
    CHECK(fsb_##kind##_##STATES(good, NULL) == FSB_NULL_POINTER);                                       \
    CHECK(fsb_##kind##_##STATES(good, (fsb_state_t *)(void *)(bytes + 2)) == FSB_MISALIGNED);           \
    CHECK(fsb_##kind##_state_sd(good, NULL) == FSB_NULL_POINTER);                                       \
    CHECK(fsb_##kind##_##PARAMETERS(good, NULL) == FSB_NULL_POINTER);                                   \
    CHECK(fsb_##kind##_counters(good, NULL) == FSB_NULL_POINTER);                                       \
    CHECK(fsb_##kind##_diagnostics(good, NULL) == FSB_NULL_POINTER);                                    \
  } while (0)

/* A kind from never initialised to in use. */
#define KIND(kind, STATES, PARAMETERS, n, p)                                                             \
  do {                                                                                                  \
    struct fsb_##kind##_t *it = &object.kind;                                                           \
    struct fsb_##kind##_config_t config = fsb_##kind##_config_default(0.01);                            \
    const char *name = "untouched";                                                                     \
    fsb_state_t s[3];                                                                                   \
    fsb_parameter_t k[3];                                                                               \
    fsb_counters_t c;                                                                                   \
    memset(&object, 0, sizeof object);                                                                  \
    REFUSED_BY(kind, STATES, PARAMETERS, it, n, p, FSB_NOT_INITIALISED);                                \
    memset(&object, 0xa5, sizeof object);                                                               \
    REFUSED_BY(kind, STATES, PARAMETERS, it, n, p, FSB_NOT_INITIALISED);                                \
    REFUSED_BY(kind, STATES, PARAMETERS, NULL, n, p, FSB_NULL_POINTER);                                 \
    REFUSED_BY(kind, STATES, PARAMETERS, object.bytes + 4, n, p, FSB_MISALIGNED);                       \
    CHECK(fsb_##kind##_init(NULL, &config, &name) == FSB_NULL_POINTER && name == NULL);                 \
    CHECK(fsb_##kind##_init((struct fsb_##kind##_t *)(void *)(object.bytes + 4), &config, NULL) == FSB_MISALIGNED); \
    CHECK(fsb_##kind##_init(it, NULL, &name) == FSB_NULL_POINTER);                                      \
    CHECK(fsb_##kind##_init(it, &config, (const char **)(void *)(unplaced + 1)) == FSB_MISALIGNED);     \
    CHECK(fsb_##kind##_reset(it) == FSB_NOT_INITIALISED);                                               \
    CHECK(fsb_##kind##_init(it, &config, NULL) == FSB_OK);                                              \
    CHECK(fsb_##kind##_init(it, &config, &name) == FSB_OK && name == NULL);                             \
    CHECK(fsb_##kind##_##STATES(it, s) == FSB_OK && s[0].status == FSB_STATE_NOT_MEASURED && isnan(s[0].position)); \
    CHECK(fsb_##kind##_measure(it, numbers) == FSB_OK);                                                 \
    CHECK(fsb_##kind##_measure(it, numbers) == FSB_OUT_OF_STEP);                                        \
    CHECK(fsb_##kind##_apply_ramp(it, numbers, numbers) == FSB_OK);                                     \
    CHECK(fsb_##kind##_##PARAMETERS(it, k) == FSB_OK && k[(p)-1].status != FSB_PARAMETER_VALID && isnan(k[(p)-1].k)); \
    {                                                                                                   \
      const float bad[3] = {NAN, INFINITY, -INFINITY};                                                  \
      CHECK(fsb_##kind##_measure(it, bad) == FSB_OK && fsb_##kind##_apply(it, bad) == FSB_OK);          \
      CHECK(fsb_##kind##_counters(it, &c) == FSB_OK && c.missed == (n) && c.rejected_inputs == (n));    \
      CHECK(c.rejected_measurements == (n)-1);                                                          \
    }                                                                                                   \
    POINTERS_OF(kind, STATES, PARAMETERS, it);                                                          \
    CHECK(fsb_##kind##_reset_identifier(it) == FSB_OK);                                                 \
    CHECK(fsb_##kind##_##STATES(it, s) == FSB_OK && s[0].status != FSB_STATE_NOT_MEASURED);             \
    CHECK(fsb_##kind##_reinitialise_identifier(it) == FSB_OK);                                          \
    CHECK(fsb_##kind##_set_learning(it, FSB_LEARNING_CONTACT) == FSB_OK);                               \
    CHECK(fsb_##kind##_set_learning(it, FSB_LEARNING_OFF) == FSB_OK);                                   \
    CHECK(fsb_##kind##_set_learning(it, 3) == FSB_UNKNOWN_VALUE);                                       \
    CHECK(fsb_##kind##_set_learning(it, FSB_LEARNING_ON) == FSB_OK);                                    \
    CHECK(fsb_##kind##_reset(it) == FSB_OK);                                                            \
    CHECK(fsb_##kind##_##STATES(it, s) == FSB_OK && s[(n)-1].status == FSB_STATE_NOT_MEASURED);         \
    CHECK(fsb_##kind##_counters(it, &c) == FSB_OK && c.missed == (n));                                  \
    config.observer.q = -1.0;                                                                           \
    CHECK(fsb_##kind##_init(it, &config, &name) == FSB_CONFIG_NOT_POSITIVE && !strcmp(name, "observer.q")); \
    REFUSED_BY(kind, STATES, PARAMETERS, it, n, p, FSB_NOT_INITIALISED);                                \
  } while (0)

#define NAMED(field, value, expected, text)                                          \
  do {                                                                              \
    fsb_axis_config_t config = fsb_axis_config_default(0.01);                       \
    const char *name = NULL;                                                        \
    config.field = (value);                                                         \
    CHECK(fsb_axis_init(&object.axis, &config, &name) == (expected));               \
    CHECK(name != NULL && !strcmp(name, text));                                     \
  } while (0)

static void configurations(void) {
  NAMED(period, NAN, FSB_CONFIG_NOT_FINITE, "period");
  NAMED(substeps, 0, FSB_CONFIG_ZERO, "substeps");
  NAMED(block, 0, FSB_CONFIG_ZERO, "block");
  NAMED(turn, 8, FSB_CONFIG_OUT_OF_RANGE, "turn");
  NAMED(readout, 2, FSB_CONFIG_OUT_OF_RANGE, "readout");
  NAMED(identifier.lambda, 101.0, FSB_CONFIG_TOO_FAST, "identifier.lambda");
  NAMED(identifier.q, 1e-5, FSB_CONFIG_TOO_SLOW, "identifier.q");
  NAMED(observer.lambda, 0.0, FSB_CONFIG_NOT_POSITIVE, "observer.lambda");
  NAMED(observer.q, INFINITY, FSB_CONFIG_NOT_FINITE, "observer.q");
  NAMED(noise_sd, -1.0, FSB_CONFIG_NOT_POSITIVE, "noise_sd");
  NAMED(disturbance_sd, 0.0, FSB_CONFIG_NOT_POSITIVE, "disturbance_sd");
  NAMED(memory_tau, 0.0, FSB_CONFIG_NOT_POSITIVE, "memory_tau");
  NAMED(memory_tau, NAN, FSB_CONFIG_NOT_FINITE, "memory_tau");
  NAMED(max_misfit, 0.0, FSB_CONFIG_NOT_POSITIVE, "max_misfit");
  NAMED(max_misfit, 1.5, FSB_CONFIG_OUT_OF_RANGE, "max_misfit");
  NAMED(parameter_settle, -1.0, FSB_CONFIG_NEGATIVE, "parameter_settle");
  NAMED(state_settle, NAN, FSB_CONFIG_NOT_FINITE, "state_settle");
  NAMED(position_limit, 0.0, FSB_CONFIG_NOT_POSITIVE, "position_limit");
  NAMED(input_limit, 1e7, FSB_CONFIG_OUT_OF_RANGE, "input_limit");
  NAMED(drift, INFINITY, FSB_CONFIG_NOT_FINITE, "drift");
  NAMED(nominal, 0.0, FSB_CONFIG_NOT_POSITIVE, "nominal");
  NAMED(rule.min, 0.0, FSB_CONFIG_NOT_POSITIVE, "rule.min");
  NAMED(rule.max, NAN, FSB_CONFIG_NOT_FINITE, "rule.max");
  NAMED(rule.max, 1e-7, FSB_CONFIG_INVERTED_RANGE, "rule.min");
  NAMED(rule.max, 1e20, FSB_CONFIG_OUT_OF_RANGE, "rule.max");
  NAMED(rule.max_relative_sd, 0.0, FSB_CONFIG_NOT_POSITIVE, "rule.max_relative_sd");
}

static void kinds_are_told_apart(void) {
  fsb_translation_config_t config = fsb_translation_config_default(0.01);
  CHECK(fsb_translation_init(&object.translation, &config, NULL) == FSB_OK);
  REFUSED_BY(rotation, states, parameters, object.bytes, 3, 3, FSB_NOT_INITIALISED);
  REFUSED_BY(axis, state, parameter, object.bytes, 1, 1, FSB_NOT_INITIALISED);
  /* A copy is an object of its own. */
  static fsb_translation_t copy;
  fsb_counters_t counters;
  copy = object.translation;
  CHECK(fsb_translation_measure(&copy, numbers) == FSB_OK);
  CHECK(fsb_translation_measure(&object.translation, numbers) == FSB_OK);
  CHECK(fsb_translation_counters(&copy, &counters) == FSB_OK && counters.missed == 0);
}

static void tracking(void) {
  fsb_tracking_t *it = &object.tracking;
  fsb_tracking_config_t config = fsb_tracking_config_default(4.0, 3.0);
  const fsb_reference_t reference = {1.0f, 0.5f, 0.25f};
  fsb_state_t state = {0.0f, 0.0f, FSB_STATE_IDENTIFIED};
  const char *name = NULL;
  float input = 7.0f;
  memset(&object, 0xa5, sizeof object);
  CHECK(fsb_tracking_input(it, &reference, &state, 2.0f, &input) == FSB_NOT_INITIALISED && isnan(input));
  CHECK(fsb_tracking_init(NULL, &config, &name) == FSB_NULL_POINTER && name == NULL);
  CHECK(fsb_tracking_init(it, NULL, NULL) == FSB_NULL_POINTER);
  CHECK(fsb_tracking_init(it, &config, (const char **)(void *)(unplaced + 1)) == FSB_MISALIGNED);
  config.kp = 0.0;
  CHECK(fsb_tracking_init(it, &config, &name) == FSB_CONFIG_NOT_POSITIVE && !strcmp(name, "kp"));
  config = fsb_tracking_config_default(4.0, NAN);
  CHECK(fsb_tracking_init(it, &config, &name) == FSB_CONFIG_NOT_FINITE && !strcmp(name, "kd"));
  config = fsb_tracking_config_default(4.0, 3.0);
  config.drift = INFINITY;
  CHECK(fsb_tracking_init(it, &config, &name) == FSB_CONFIG_NOT_FINITE && !strcmp(name, "drift"));
  config.drift = -9.75;
  config.k_min = -1.0;
  CHECK(fsb_tracking_init(it, &config, &name) == FSB_CONFIG_NOT_POSITIVE && !strcmp(name, "k_min"));
  config.k_min = 1.0;
  config.k_max = NAN;
  CHECK(fsb_tracking_init(it, &config, &name) == FSB_CONFIG_NOT_FINITE && !strcmp(name, "k_max"));
  config.k_max = 8.0;
  CHECK(fsb_tracking_init(it, &config, &name) == FSB_OK && name == NULL);
  /* (0.25 + 9.75 + 3 * 0.5 + 4 * 1) / 2, exact in binary */
  CHECK(fsb_tracking_input(it, &reference, &state, 2.0f, &input) == FSB_OK && input == 7.75f);
  CHECK(fsb_tracking_input(it, &reference, &state, 0.5f, &input) == FSB_PARAMETER_OUT_OF_RANGE && isnan(input));
  CHECK(fsb_tracking_input(it, &reference, &state, NAN, &input) == FSB_PARAMETER_OUT_OF_RANGE);
  CHECK(fsb_tracking_input(it, NULL, &state, 2.0f, &input) == FSB_NULL_POINTER && isnan(input));
  CHECK(fsb_tracking_input(it, &reference, NULL, 2.0f, &input) == FSB_NULL_POINTER);
  CHECK(fsb_tracking_input(it, &reference, &state, 2.0f, NULL) == FSB_NULL_POINTER);
  CHECK(fsb_tracking_input(NULL, &reference, &state, 2.0f, &input) == FSB_NULL_POINTER);
  state.position = NAN;
  CHECK(fsb_tracking_input(it, &reference, &state, 2.0f, &input) == FSB_NOT_FINITE && isnan(input));

  /* A quarter turn about z: the world's x axis is the body's -y axis. */
  const float quarter[9] = {0.0f, -1.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f};
  float force[3] = {1.0f, 2.0f, 3.0f};
  CHECK(fsb_to_body(quarter, force, force) == FSB_OK && force[0] == 2.0f && force[1] == -1.0f && force[2] == 3.0f);
  CHECK(fsb_to_body(NULL, numbers, force) == FSB_NULL_POINTER && isnan(force[2]));
  CHECK(fsb_to_body(quarter, NULL, force) == FSB_NULL_POINTER);
  CHECK(fsb_to_body(quarter, numbers, NULL) == FSB_NULL_POINTER);
}

#include "vehicle.h"

static void reports_and_names(void) {
  const fsb_parameter_t good = {2.0f, 0.0625f, FSB_PARAMETER_VALID};
  const fsb_parameter_t bad = {2.0f, 0.0625f, FSB_PARAMETER_UNCERTAIN};
  fsb_parameter_report_t report;
  /* sd(k) = 0.25, 1/k = 0.5, sd(1/k) = sd(k)/k^2 */
  CHECK(fsb_parameter_report(&good, &report) == FSB_OK);
  CHECK(report.k_sd == 0.25f && report.inverse == 0.5f && report.inverse_sd == 0.0625f);
  CHECK(fsb_parameter_report(&bad, &report) == FSB_NOT_VALID && isnan(report.inverse) && isnan(report.k_sd));
  CHECK(fsb_parameter_report(NULL, &report) == FSB_NULL_POINTER);
  CHECK(fsb_parameter_report(&good, NULL) == FSB_NULL_POINTER);
  CHECK(!strcmp(fsb_status_name(FSB_OK), "FSB_OK"));
  CHECK(!strcmp(fsb_status_name(FSB_OUT_OF_STEP), "FSB_OUT_OF_STEP"));
  CHECK(!strcmp(fsb_status_name(FSB_CONFIG_REFUSED), "FSB_CONFIG_REFUSED"));
  CHECK(!strcmp(fsb_status_name(-1), "FSB_UNKNOWN") && !strcmp(fsb_status_name(INT32_MAX), "FSB_UNKNOWN"));
  for (fsb_status_t status = 0; status < 32; status++)
    for (fsb_status_t other = 0; other < status; other++)
      CHECK(strcmp(fsb_status_name(status), fsb_status_name(other)) || !strcmp(fsb_status_name(status), "FSB_UNKNOWN"));
  CHECK(!strcmp(fsb_state_status_name(FSB_STATE_NOMINAL), "FSB_STATE_NOMINAL"));
  CHECK(!strcmp(fsb_state_status_name(FSB_STATE_STALE), "FSB_STATE_STALE"));
  CHECK(!strcmp(fsb_state_status_name(77), "FSB_STATE_UNKNOWN"));
  CHECK(!strcmp(fsb_parameter_status_name(FSB_PARAMETER_BELOW), "FSB_PARAMETER_BELOW"));
  CHECK(!strcmp(fsb_parameter_status_name(FSB_PARAMETER_HELD), "FSB_PARAMETER_HELD"));
  CHECK(!strcmp(fsb_parameter_status_name(77), "FSB_PARAMETER_UNKNOWN"));
  CHECK(fsb_version() == FSB_VERSION);
  CHECK(strlen(fsb_version_text()) >= 5);
}

int main(void) {
  KIND(axis, state, parameter, 1, 1);
  KIND(translation, states, parameters, 3, 1);
  KIND(rotation, states, parameters, 3, 3);
  configurations();
  kinds_are_told_apart();
  tracking();
  vehicle_configurations();
  vehicle();
  reports_and_names();
  printf("%d checks, %d failed\n", checks, failures);
  return failures == 0 ? 0 : 1;
}
