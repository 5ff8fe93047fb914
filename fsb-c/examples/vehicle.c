/* A fully actuated multirotor flown on fsb_vehicle_t alone: position and attitude in, mass and moments of inertia learned
 * in flight, a load picked up and noticed.
 *
 * Motion capture at 100 Hz with 2 mm of noise, 20 ms late; attitude as a quaternion at 500 Hz, 2 ms late; control at 500 Hz.
 * All in NED and FRD. The body is flown in double precision with additions, multiplications and divisions only, which are
 * the same on every machine; what is printed is therefore the same to the last bit on a PC and on a Cortex-M4F. Build with
 * -ffp-contract=off. Exit status: 0 if mass and inertia came out right before and after, and the vehicle stayed where it
 * was told to.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "fsb.h"

#define TICKS 10000
#define LOADED 5000 /* the tick of the load */
#define PERIOD 0.002
#define MEMORY 16 /* ticks that the sensors remember */
#define GRAVITY 9.81

static const float home[3] = {1.0f, -2.0f, -3.0f}; /* 3 m high: z points down */

/* The body. */
static double mass = 1.6, inertia[3] = {0.03, 0.035, 0.055};
static double position[3] = {0.8, -2.1, -2.9}, velocity[3], attitude[4] = {1.0, 0.0, 0.0, 0.0}, rates[3];
static double seen_position[MEMORY][3], seen_attitude[MEMORY][4];

static fsb_vehicle_t vehicle;

/* Uniform in -1..1, the same everywhere. */
static double uniform(void) {
  static uint32_t state = 12345;
  state = state * UINT32_C(1664525) + UINT32_C(1013904223);
  return (double)(int32_t)state / 2147483648.0;
}

/* FNV-1a over 32-bit words: the whole flight in one number. */
static uint64_t hash = UINT64_C(0xcbf29ce484222325);

static void digest(float value) {
  uint32_t word;
  memcpy(&word, &value, sizeof word);
  hash = (hash ^ word) * UINT64_C(0x100000001b3);
}

/* q turned about the body's axes by small angles [rad]. */
static void turn(double q[4], const double by[3]) {
  const double a = 0.5 * by[0], b = 0.5 * by[1], c = 0.5 * by[2], s = a * a + b * b + c * c;
  const double w = 1.0 - 0.5 * s + s * s / 24.0, k = 1.0 - s / 6.0;
  const double x = k * a, y = k * b, z = k * c, p[4] = {q[0], q[1], q[2], q[3]};
  q[0] = p[0] * w - p[1] * x - p[2] * y - p[3] * z;
  q[1] = p[1] * w + p[0] * x + p[2] * z - p[3] * y;
  q[2] = p[2] * w + p[0] * y + p[3] * x - p[1] * z;
  q[3] = p[3] * w + p[0] * z + p[1] * y - p[2] * x;
  const double length = 1.5 - 0.5 * (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int i = 0; i < 4; i++) q[i] *= length;
}

/* Body to world, by rows. */
static void rotation(const double q[4], double r[9]) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const double rows[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                          2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                          2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
  memcpy(r, rows, sizeof rows);
}

/* A control period of the body under a wrench along its axes. */
static void fly(const fsb_wrench_t *wrench) {
  double by[3], half[3], middle[4], r[9];
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double gyroscopic = (inertia[k] - inertia[j]) * rates[j] * rates[k];
    const double step = PERIOD * ((double)wrench->torque[i] - gyroscopic) / inertia[i];
    by[i] = PERIOD * (rates[i] + 0.5 * step);
    half[i] = 0.5 * by[i];
    rates[i] += step;
  }
  memcpy(middle, attitude, sizeof middle);
  turn(middle, half);
  turn(attitude, by);
  rotation(middle, r);
  for (int i = 0; i < 3; i++) {
    double force = 0.0;
    for (int j = 0; j < 3; j++) force += r[3 * i + j] * (double)wrench->force[j];
    const double step = PERIOD * (force / mass + (i == 2 ? GRAVITY : 0.0));
    position[i] += PERIOD * (velocity[i] + 0.5 * step);
    velocity[i] += step;
  }
}

/* What the sensors see now, and what of it has arrived. */
static fsb_measured_t sense(int tick) {
  fsb_measured_t measured = fsb_measured_none();
  double shake[3];
  for (int i = 0; i < 3; i++) {
    seen_position[tick % MEMORY][i] = position[i] + 0.002 * uniform();
    shake[i] = 0.0005 * uniform();
  }
  memcpy(seen_attitude[tick % MEMORY], attitude, sizeof attitude);
  turn(seen_attitude[tick % MEMORY], shake);
  if (tick % 5 == 0 && tick >= 10) /* 100 Hz, 20 ms ago */
    for (int i = 0; i < 3; i++) measured.position[i] = (float)seen_position[(tick - 10) % MEMORY][i];
  if (tick >= 1) { /* 500 Hz, 2 ms ago */
    measured.attitude_kind = FSB_ATTITUDE_QUATERNION;
    for (int i = 0; i < 4; i++) measured.attitude[i] = (float)seen_attitude[(tick - 1) % MEMORY][i];
  }
  return measured;
}

/* Stays at home, level; shakes a little, or there is nothing to learn from. */
static fsb_wrench_t control(int tick, const fsb_vehicle_state_t *state, const fsb_vehicle_model_t *model) {
  fsb_wrench_t wrench;
  const float *r = state->attitude;
  const float tilt[3] = {0.5f * (r[7] - r[5]), 0.5f * (r[2] - r[6]), 0.5f * (r[3] - r[1])};
  float world[3];
  for (int i = 0; i < 3; i++) {
    const float push = tick / (150 + 40 * i) % 2 ? 1.5f : -1.5f, twist = tick / (40 + 10 * i) % 2 ? 8.0f : -8.0f;
    world[i] = push - 4.0f * (state->position[i] - home[i]) - 4.0f * state->velocity[i];
    wrench.torque[i] = model->inertia[i] * (twist - 50.0f * tilt[i] - 10.0f * state->rates[i]);
  }
  world[2] -= (float)GRAVITY;
  for (int i = 0; i < 3; i++) world[i] *= model->mass;
  fsb_to_body(r, world, wrench.force);
  return wrench;
}

static int stop(const char *what, fsb_status_t status, const char *parameter) {
  printf("%s: %s %s\n", what, fsb_status_name(status), parameter ? parameter : "");
  return 2;
}

/* Prints mass and inertia; whether they are right, to 1 % and to six standard deviations. */
static int report(int tick) {
  fsb_identified_t found[4];
  int right = fsb_vehicle_mass(&vehicle, &found[0]) == FSB_OK && fsb_vehicle_inertia(&vehicle, found + 1) == FSB_OK;
  for (int i = 0; i < 4; i++) {
    const double expected = i == 0 ? mass : inertia[i - 1], error = fabs((double)found[i].value - expected);
    const double sd = sqrt((double)found[i].variance);
    printf("%5d %s %.3f sd %.3f, true %.3f, %s\n", tick, i == 0 ? "mass in g" : "inertia in g m^2",
           1e3 * (double)found[i].value, 1e3 * sd, 1e3 * expected, fsb_parameter_status_name(found[i].status));
    right &= found[i].status == FSB_PARAMETER_VALID && error < 0.01 * expected && error < 6.0 * sd + 1e-3 * expected;
  }
  return right;
}

int main(void) {
  const char *parameter;
  fsb_vehicle_config_t config = fsb_vehicle_config_default(PERIOD);
  config.frame = FSB_FRAME_Z_DOWN;
  config.mass = fsb_expected_about(1.2); /* 25 % off */
  for (int i = 0; i < 3; i++) config.inertia[i] = fsb_expected_about(0.04);
  config.translation.substeps = 5;
  config.translation.latency = 10;
  config.rotation.latency = 1;
  config.rotation.block = 5;
  config.change.relative = 0.15;
  fsb_status_t status = fsb_vehicle_init(&vehicle, &config, &parameter);
  if (status != FSB_OK) return stop("vehicle", status, parameter);

  fsb_wrench_t wrench = {{0.0f, 0.0f, (float)(-GRAVITY * 1.2)}, {0.0f, 0.0f, 0.0f}};
  int right = 1, noticed = 0;
  double worst = 0.0;
  for (int tick = 0; tick < TICKS; tick++) {
    if (tick == LOADED) {
      right &= report(tick);
      mass *= 1.5;
      for (int i = 0; i < 3; i++) inertia[i] *= 1.3;
    }
    const fsb_measured_t measured = sense(tick);
    fsb_vehicle_state_t state;
    fsb_vehicle_model_t model;
    uint32_t events;

    /* The interface in a tick: what came and what was applied until now; the state and the model; control. */
    status = fsb_vehicle_update(&vehicle, &measured, &wrench, &events);
    if (status == FSB_OK) status = fsb_vehicle_state(&vehicle, &state);
    if (status == FSB_OK) status = fsb_vehicle_model(&vehicle, &model);
    if (status != FSB_OK) return stop("tick", status, NULL);
    if (state.translation_status >= FSB_STATE_NOMINAL && state.rotation_status >= FSB_STATE_NOMINAL)
      wrench = control(tick, &state, &model);
    /* else: no valid state yet, the last wrench stays */

    fly(&wrench);

    noticed |= events & FSB_EVENT_MASS_CHANGED && tick >= LOADED && tick < LOADED + 500;
    for (int i = 0; i < 3; i++) {
      digest(state.position[i]), digest(state.velocity[i]), digest(state.rates[i]), digest(wrench.force[i]);
      const double error = fabs(position[i] - (double)home[i]);
      if (tick > 1500 && error > worst) worst = error;
    }
    if (events != 0) printf("%5d events %lu\n", tick, (unsigned long)events);
    if (tick % 1000 == 999)
      printf("%5d %08lx%08lx\n", tick, (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffffu));
  }
  right &= report(TICKS);
  printf("furthest from home %.3f m\n", worst);
  if (!right || !noticed || worst > 1.0) return 1;
  return 0;
}
