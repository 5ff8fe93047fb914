/* A multirotor flown on the estimates alone: six axes, a tracking controller each, mass and inertia learned in flight.
 *
 * Position comes at 250 Hz with 5 mm of noise, the angles at 1 kHz with 1 mrad; control runs at 1 kHz. At 2 s one
 * position is missing, at 3 s one is absurd, at 4 s one torque. The plant is exact (the input is constant over a tick) and
 * in double precision, which is the same on every machine; what is printed is therefore the same to the last bit on a PC
 * and on a Cortex-M4F, and fly.rs prints it from Rust. Build with -ffp-contract=off. Exit status: 0 if mass and inertia
 * came out right and the vehicle followed.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "fsb.h"

#define TICKS 10000
#define PERIOD 0.001

/* The vehicle: mass [kg] and inertia [kg m^2] as the estimator is told, and as they are. */
static const double nominal[6] = {1.0, 1.0, 1.0, 0.02, 0.02, 0.04};
static const double truth[6] = {1.6, 1.6, 1.6, 0.03, 0.035, 0.055};
static const double drift[6] = {0.0, 0.0, -9.81, 0.0, 0.0, 0.0}; /* z points up */
static const double amplitude[6] = {1.0, 0.8, 0.5, 0.2, 0.15, 0.3};
static const double noise[6] = {0.005, 0.005, 0.005, 0.001, 0.001, 0.001};

static fsb_translation_t translation;
static fsb_rotation_t rotation;
static fsb_tracking_t controller[6];

static int stop(const char *what, fsb_status_t status, const char *parameter) {
  printf("%s: %s %s\n", what, fsb_status_name(status), parameter ? parameter : "");
  return 2;
}

static uint32_t bits(float value) {
  uint32_t word;
  memcpy(&word, &value, sizeof word);
  return word;
}

/* FNV-1a over 32-bit words: the whole flight in one number. */
static uint64_t hash = UINT64_C(0xcbf29ce484222325);

static void digest(uint32_t word) { hash = (hash ^ word) * UINT64_C(0x100000001b3); }

/* Uniform in -1..1, the same everywhere. */
static double uniform(void) {
  static uint32_t state = 12345;
  state = state * UINT32_C(1664525) + UINT32_C(1013904223);
  return (double)(int32_t)state / 2147483648.0;
}

static int init(void) {
  const char *parameter;
  fsb_status_t status;

  fsb_translation_config_t slow = fsb_translation_config_default(PERIOD);
  slow.substeps = 4;
  slow.block = 5;
  slow.drift[2] = drift[2];
  slow.nominal = 1.0 / nominal[0];
  slow.rule.max_relative_sd = 0.02;
  status = fsb_translation_init(&translation, &slow, &parameter);
  if (status != FSB_OK) return stop("translation", status, parameter);

  fsb_rotation_config_t fast = fsb_rotation_config_default(PERIOD);
  fast.block = 10;
  fast.observer.lambda = 40.0;
  fast.observer.q = 20.0;
  for (int i = 0; i < 3; i++) {
    fast.nominal[i] = 1.0 / nominal[3 + i];
    fast.rule[i].max_relative_sd = 0.02;
  }
  status = fsb_rotation_init(&rotation, &fast, &parameter);
  if (status != FSB_OK) return stop("rotation", status, parameter);

  for (int i = 0; i < 6; i++) {
    fsb_tracking_config_t gains = fsb_tracking_config_default(i < 3 ? 4.0 : 25.0, i < 3 ? 4.0 : 10.0);
    gains.drift = drift[i];
    status = fsb_tracking_init(&controller[i], &gains, &parameter);
    if (status != FSB_OK) return stop("controller", status, parameter);
  }
  return 0;
}

int main(void) {
  double y[6] = {0}, v[6] = {0};
  double c[2] = {1.0, 1.0}, s[2] = {0.0, 0.0};
  /* cosine, sine and rate [rad/s] of the reference's two phasors over a tick */
  const double turn_c[2] = {0.9999988750002109, 0.999995500003375};
  const double turn_s[2] = {0.0014999994375000632, 0.002999995500002025};
  const double rate[2] = {1.5, 3.0};
  float input[6] = {0.0f, 0.0f, (float)(9.81 * 1.0), 0.0f, 0.0f, 0.0f};
  double worst = 0.0;

  if (fsb_version() != FSB_VERSION) return stop("library and header", FSB_CONFIG_REFUSED, fsb_version_text());
  if (init() != 0) return 2;

  for (int tick = 0; tick < TICKS; tick++) {
    float measured[6];
    fsb_state_t state[6];
    fsb_parameter_t parameter[4];
    fsb_status_t status = FSB_OK;

    for (int i = 0; i < 6; i++) measured[i] = (float)(y[i] + noise[i] * uniform());
    if (tick == 2000) measured[1] = NAN;
    if (tick == 3000) measured[2] = 1e9f;

    /* The interface in a tick: measure, look, control, apply. */
    if (tick % 4 == 0) status = fsb_translation_measure(&translation, measured);
    if (status == FSB_OK) status = fsb_rotation_measure(&rotation, measured + 3);
    if (status == FSB_OK) status = fsb_translation_states(&translation, state);
    if (status == FSB_OK) status = fsb_rotation_states(&rotation, state + 3);
    if (status == FSB_OK) status = fsb_translation_parameters(&translation, parameter);
    if (status == FSB_OK) status = fsb_rotation_parameters(&rotation, parameter + 1);
    if (status != FSB_OK) return stop("tick", status, NULL);

    for (int i = 0; i < 6; i++) {
      const fsb_parameter_t *of = &parameter[i < 3 ? 0 : i - 2];
      const float k = of->status == FSB_PARAMETER_VALID ? of->k : (float)(1.0 / nominal[i]);
      const int p = i % 2;
      const fsb_reference_t reference = {(float)(amplitude[i] * s[p]), (float)(amplitude[i] * rate[p] * c[p]),
                                         (float)(-amplitude[i] * rate[p] * rate[p] * s[p])};
      float wanted;
      if (fsb_tracking_input(&controller[i], &reference, &state[i], k, &wanted) == FSB_OK) input[i] = wanted;
      /* else: no valid state yet, the last input stays */
      const double error = fabs(y[i] - (double)reference.position) / amplitude[i];
      if (tick > 7000 && error > worst) worst = error;
    }
    float given[6];
    memcpy(given, input, sizeof given);
    if (tick == 4000) given[4] = INFINITY;
    fsb_translation_apply(&translation, given);
    fsb_rotation_apply(&rotation, given + 3);

    for (int i = 0; i < 6; i++) {
      digest(bits(state[i].position) + (uint32_t)state[i].status);
      digest(bits(state[i].velocity));
      digest(bits(input[i]));
    }
    for (int i = 0; i < 4; i++) {
      digest(bits(parameter[i].k) + (uint32_t)parameter[i].status);
      digest(bits(parameter[i].variance));
    }
    if (tick % 1000 == 999) {
      printf("%5d", tick);
      for (int i = 0; i < 6; i++)
        printf(" %08lx %08lx %08lx", (unsigned long)bits(state[i].position), (unsigned long)bits(state[i].velocity),
               (unsigned long)bits(input[i]));
      for (int i = 0; i < 4; i++) printf(" %08lx %d", (unsigned long)bits(parameter[i].k), (int)parameter[i].status);
      printf(" %08lx%08lx\n", (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffffu));
    }

    /* The world: exact motion over a tick with the input held, and the reference's phasors turned on. */
    for (int i = 0; i < 6; i++) {
      const double a = (double)input[i] / truth[i] + drift[i];
      y[i] += PERIOD * v[i] + 0.5 * PERIOD * PERIOD * a;
      v[i] += PERIOD * a;
    }
    for (int p = 0; p < 2; p++) {
      const double next = c[p] * turn_c[p] - s[p] * turn_s[p];
      s[p] = s[p] * turn_c[p] + c[p] * turn_s[p];
      c[p] = next;
    }
  }

  fsb_counters_t counters;
  fsb_parameter_t found[4];
  int wrong = worst > 0.05;
  fsb_translation_parameters(&translation, found);
  fsb_rotation_parameters(&rotation, found + 1);
  for (int i = 0; i < 4; i++) {
    fsb_parameter_report_t report;
    const double expected = truth[i == 0 ? 0 : 2 + i];
    if (fsb_parameter_report(&found[i], &report) != FSB_OK) return 3;
    printf("%s %.3f sd %.3f, true %.3f\n", i == 0 ? "mass in g" : "inertia in g m^2", 1e3 * (double)report.inverse,
           1e3 * (double)report.inverse_sd, 1e3 * expected);
    /* Within four standard deviations, and what rounding alone may cost. */
    wrong |= fabs((double)report.inverse - expected) > 4.0 * (double)report.inverse_sd + 1e-5 * expected;
    wrong |= (double)report.inverse_sd > 0.01 * expected;
  }
  fsb_translation_counters(&translation, &counters);
  printf("missed %lu, rejected %lu and", (unsigned long)counters.missed, (unsigned long)counters.rejected_measurements);
  fsb_rotation_counters(&rotation, &counters);
  printf(" %lu; worst error after 7 s: %.4f of the amplitude\n", (unsigned long)counters.rejected_inputs, worst);
  return wrong;
}
