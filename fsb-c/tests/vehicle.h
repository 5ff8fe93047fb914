/* The part of interface.c that is about fsb_vehicle_t, included by it alone. */

/* Every function of the vehicle on an object that it must refuse with `expected`. */
static void vehicle_refused(void *pointer, fsb_status_t expected) {
  fsb_vehicle_t *refused = (fsb_vehicle_t *)pointer;
  const fsb_measured_t measured = fsb_measured_none();
  const fsb_wrench_t wrench = {{0.0f, 0.0f, 9.0f}, {0.0f, 0.0f, 0.0f}};
  fsb_vehicle_state_t state;
  fsb_identified_t found[3];
  fsb_vehicle_model_t model;
  fsb_vehicle_counters_t counters;
  fsb_diagnostics_t diagnostics[6];
  uint32_t events = 77;
  fill(&state, sizeof state);
  fill(found, sizeof found);
  fill(&model, sizeof model);
  fill(&counters, sizeof counters);
  fill(diagnostics, sizeof diagnostics);
  CHECK(fsb_vehicle_reset(refused) == expected);
  CHECK(fsb_vehicle_reinitialise(refused, FSB_GROUP_TRANSLATION) == expected);
  CHECK(fsb_vehicle_set_learning(refused, FSB_LEARNING_ON) == expected);
  CHECK(fsb_vehicle_missed(refused, 1) == expected);
  CHECK(fsb_vehicle_update(refused, &measured, &wrench, &events) == expected && events == 0);
  CHECK(fsb_vehicle_update(refused, &measured, &wrench, NULL) == expected);
  CHECK(fsb_vehicle_state(refused, &state) == expected && isnan(state.position[0]) && isnan(state.velocity[2]));
  CHECK(isnan(state.attitude[8]) && isnan(state.rates[1]));
  CHECK(state.translation_status == FSB_STATE_UNKNOWN && state.rotation_status == FSB_STATE_UNKNOWN);
  CHECK(fsb_vehicle_mass(refused, found) == expected && isnan(found[0].value) && isnan(found[0].variance));
  CHECK(fsb_vehicle_inertia(refused, found) == expected && isnan(found[2].value));
  CHECK(found[2].status == FSB_PARAMETER_UNKNOWN);
  CHECK(fsb_vehicle_model(refused, &model) == expected && isnan(model.mass) && isnan(model.inertia[2]));
  CHECK(fsb_vehicle_counters(refused, &counters) == expected && counters.rejected_attitudes == 0);
  CHECK(counters.inertia_changes == 0);
  CHECK(fsb_vehicle_diagnostics(refused, diagnostics) == expected && isnan(diagnostics[5].innovation));
}

#define VEHICLE_NAMED(field, given, expected, text)                                    \
  do {                                                                                \
    fsb_vehicle_config_t config = fsb_vehicle_config_default(0.01);                   \
    const char *name = NULL;                                                          \
    config.field = (given);                                                           \
    CHECK(fsb_vehicle_init(&object.vehicle, &config, &name) == (expected));           \
    CHECK(name != NULL && !strcmp(name, text));                                       \
  } while (0)

static void vehicle_configurations(void) {
  VEHICLE_NAMED(period, NAN, FSB_CONFIG_NOT_FINITE, "period");
  VEHICLE_NAMED(frame, 2, FSB_CONFIG_OUT_OF_RANGE, "frame");
  VEHICLE_NAMED(gravity, -9.81, FSB_CONFIG_NEGATIVE, "gravity");
  VEHICLE_NAMED(mass.nominal, 0.0, FSB_CONFIG_NOT_POSITIVE, "mass.nominal");
  VEHICLE_NAMED(mass.min, 1e4, FSB_CONFIG_INVERTED_RANGE, "mass.min");
  VEHICLE_NAMED(mass.max, INFINITY, FSB_CONFIG_NOT_FINITE, "mass.max");
  VEHICLE_NAMED(inertia[2].nominal, -1.0, FSB_CONFIG_NOT_POSITIVE, "inertia.nominal");
  VEHICLE_NAMED(inertia[1].min, 0.0, FSB_CONFIG_NOT_POSITIVE, "inertia.min");
  VEHICLE_NAMED(inertia[0].max, NAN, FSB_CONFIG_NOT_FINITE, "inertia.max");
  VEHICLE_NAMED(actuator_lag, -0.1, FSB_CONFIG_NOT_POSITIVE, "actuator_lag");
  VEHICLE_NAMED(actuator_lag, NAN, FSB_CONFIG_NOT_FINITE, "actuator_lag");
  VEHICLE_NAMED(change.relative, -1.0, FSB_CONFIG_NOT_POSITIVE, "change.relative");
  VEHICLE_NAMED(change.relative, NAN, FSB_CONFIG_NOT_FINITE, "change.relative");
  VEHICLE_NAMED(translation.latency, FSB_VEHICLE_MAX_LATENCY + 1, FSB_CONFIG_OUT_OF_RANGE, "translation.latency");
  VEHICLE_NAMED(rotation.latency, 1, FSB_CONFIG_OUT_OF_RANGE, "translation.latency");
  VEHICLE_NAMED(rotation.latency, FSB_VEHICLE_MAX_LATENCY + 1, FSB_CONFIG_OUT_OF_RANGE, "rotation.latency");
  VEHICLE_NAMED(translation.readout, 2, FSB_CONFIG_OUT_OF_RANGE, "translation.readout");
  VEHICLE_NAMED(rotation.readout, 9, FSB_CONFIG_OUT_OF_RANGE, "rotation.readout");
  VEHICLE_NAMED(translation.substeps, 0, FSB_CONFIG_ZERO, "translation.substeps");
  VEHICLE_NAMED(rotation.block, 0, FSB_CONFIG_ZERO, "rotation.block");
  VEHICLE_NAMED(translation.identifier.lambda, 1e4, FSB_CONFIG_TOO_FAST, "translation.identifier.lambda");
  VEHICLE_NAMED(rotation.observer.q, 1e-9, FSB_CONFIG_TOO_SLOW, "rotation.observer.q");
  VEHICLE_NAMED(translation.noise_sd, -1.0, FSB_CONFIG_NOT_POSITIVE, "translation.noise_sd");
  VEHICLE_NAMED(rotation.disturbance_sd, 0.0, FSB_CONFIG_NOT_POSITIVE, "rotation.disturbance_sd");
  VEHICLE_NAMED(rotation.memory_tau, 0.0, FSB_CONFIG_NOT_POSITIVE, "rotation.memory_tau");
  VEHICLE_NAMED(translation.memory_tau, NAN, FSB_CONFIG_NOT_FINITE, "translation.memory_tau");
  VEHICLE_NAMED(translation.max_relative_sd, 0.0, FSB_CONFIG_NOT_POSITIVE, "translation.max_relative_sd");
  VEHICLE_NAMED(rotation.guard.sigmas, 1.0, FSB_CONFIG_OUT_OF_RANGE, "rotation.guard.sigmas");
  VEHICLE_NAMED(translation.guard.frozen_after, 70000, FSB_CONFIG_OUT_OF_RANGE, "translation.guard.frozen_after");
  VEHICLE_NAMED(translation.measurement_limit, 0.0, FSB_CONFIG_NOT_POSITIVE, "translation.measurement_limit");
  VEHICLE_NAMED(rotation.input_limit, NAN, FSB_CONFIG_NOT_FINITE, "rotation.input_limit");
}

/* A body of 2 kg that is pushed up and down without gravity; what it is told is all right but at some ticks. Returns the
 * events of all ticks. */
static uint32_t push(fsb_vehicle_t *it, int frame_sign, uint32_t *events_of_first) {
  uint32_t all = 0, events = 0;
  float z = 0.0f, v = 0.0f;
  fsb_wrench_t wrench = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
  for (int tick = 0; tick < 300; tick++) {
    fsb_measured_t measured = fsb_measured_none();
    measured.position[0] = measured.position[1] = 0.0f;
    measured.position[2] = (float)frame_sign * z;
    measured.attitude_kind = tick % 2 ? FSB_ATTITUDE_QUATERNION : FSB_ATTITUDE_MATRIX;
    measured.attitude[0] = 1.0f;
    if (tick % 2 == 0) measured.attitude[4] = measured.attitude[8] = 1.0f;
    CHECK(fsb_vehicle_update(it, &measured, &wrench, &events) == FSB_OK);
    if (tick == 0) *events_of_first = events;
    all |= events;
    const float force = tick % 50 < 25 ? 4.0f : -4.0f;
    wrench.force[2] = (float)frame_sign * force;
    z += 0.01f * v + 0.00005f * (force / 2.0f);
    v += 0.01f * (force / 2.0f);
  }
  return all;
}

static void vehicle(void) {
  fsb_vehicle_t *it = &object.vehicle;
  fsb_vehicle_config_t config = fsb_vehicle_config_default(0.01);
  const fsb_expected_t about = fsb_expected_about(3.0);
  fsb_measured_t measured = fsb_measured_none();
  fsb_wrench_t wrench = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
  unsigned char *bytes = object.bytes; /* only its address is used */
  const char *name = "untouched";
  fsb_vehicle_state_t state, turned;
  fsb_identified_t found[3], mass;
  fsb_vehicle_model_t model;
  fsb_vehicle_counters_t counters;
  fsb_diagnostics_t diagnostics[6];
  uint32_t events = 77;

  CHECK(about.nominal == 3.0 && fabs(about.min - 0.3) < 1e-12 && about.max == 30.0);
  CHECK(isnan(measured.position[2]) && measured.attitude_kind == FSB_ATTITUDE_NONE);
  CHECK(config.frame == FSB_FRAME_Z_UP && config.actuator_lag == 0.0 && config.change.relative == 0.0);
  CHECK(isnan(config.mass.nominal) && config.translation.memory_tau == (double)INFINITY);
  memset(&object, 0, sizeof object);
  vehicle_refused(it, FSB_NOT_INITIALISED);
  memset(&object, 0xa5, sizeof object);
  vehicle_refused(it, FSB_NOT_INITIALISED);
  vehicle_refused(NULL, FSB_NULL_POINTER);
  vehicle_refused(bytes + 4, FSB_MISALIGNED);
  CHECK(fsb_vehicle_init(NULL, &config, &name) == FSB_NULL_POINTER && name == NULL);
  CHECK(fsb_vehicle_init((fsb_vehicle_t *)(void *)(bytes + 4), &config, NULL) == FSB_MISALIGNED);
  CHECK(fsb_vehicle_init(it, NULL, &name) == FSB_NULL_POINTER);
  CHECK(fsb_vehicle_init(it, &config, (const char **)(void *)(unplaced + 1)) == FSB_MISALIGNED);
  CHECK(fsb_vehicle_init(it, &config, NULL) == FSB_OK);
  REFUSED_BY(rotation, states, parameters, object.bytes, 3, 3, FSB_NOT_INITIALISED);

  /* No nominal values: no state before the mass is known. */
  CHECK(fsb_vehicle_update(it, &measured, &wrench, &events) == FSB_OK && events == 0);
  CHECK(fsb_vehicle_state(it, &state) == FSB_OK && state.translation_status == FSB_STATE_NOT_MEASURED);
  CHECK(isnan(state.position[0]) && isnan(state.attitude[0]));
  CHECK(fsb_vehicle_model(it, &model) == FSB_OK && isnan(model.mass) && isnan(model.inertia[0]));
  CHECK(fsb_vehicle_mass(it, &mass) == FSB_OK && mass.status < FSB_PARAMETER_VALID && isnan(mass.value));

  config.gravity = 0.0;
  config.mass = about;
  for (int i = 0; i < 3; i++) config.inertia[i] = fsb_expected_about(0.05);
  CHECK(fsb_vehicle_init(it, &config, &name) == FSB_OK && name == NULL);
  CHECK(fsb_vehicle_update(it, NULL, &wrench, &events) == FSB_NULL_POINTER && events == 0);
  CHECK(fsb_vehicle_update(it, &measured, NULL, &events) == FSB_NULL_POINTER);
  CHECK(fsb_vehicle_update(it, (const fsb_measured_t *)(void *)(bytes + 1), &wrench, &events) == FSB_MISALIGNED);
  CHECK(fsb_vehicle_update(it, &measured, (const fsb_wrench_t *)(void *)(bytes + 1), &events) == FSB_MISALIGNED);
  CHECK(fsb_vehicle_update(it, &measured, &wrench, (uint32_t *)(void *)(bytes + 1)) == FSB_MISALIGNED);
  measured.attitude_kind = 3;
  CHECK(fsb_vehicle_update(it, &measured, &wrench, &events) == FSB_UNKNOWN_VALUE);
  CHECK(fsb_vehicle_state(it, NULL) == FSB_NULL_POINTER);
  CHECK(fsb_vehicle_state(it, (fsb_vehicle_state_t *)(void *)(bytes + 2)) == FSB_MISALIGNED);
  CHECK(fsb_vehicle_mass(it, NULL) == FSB_NULL_POINTER && fsb_vehicle_inertia(it, NULL) == FSB_NULL_POINTER);
  CHECK(fsb_vehicle_model(it, NULL) == FSB_NULL_POINTER && fsb_vehicle_counters(it, NULL) == FSB_NULL_POINTER);
  CHECK(fsb_vehicle_diagnostics(it, NULL) == FSB_NULL_POINTER);

  /* 2 kg, on either frame the same bits. */
  CHECK(push(it, 1, &events) == 0 && events == 0);
  CHECK(fsb_vehicle_mass(it, &mass) == FSB_OK && mass.status == FSB_PARAMETER_VALID && fabsf(mass.value - 2.0f) < 1e-3f);
  CHECK(fsb_vehicle_model(it, &model) == FSB_OK && model.mass == mass.value && fabsf(model.inertia[0] - 0.05f) < 1e-6f);
  CHECK(fsb_vehicle_state(it, &state) == FSB_OK && state.translation_status == FSB_STATE_IDENTIFIED);
  CHECK(state.rotation_status == FSB_STATE_NOMINAL && state.attitude[0] > 0.999f && state.rates[2] == 0.0f);
  CHECK(fsb_vehicle_inertia(it, found) == FSB_OK && found[0].status == FSB_PARAMETER_UNEXCITED && isnan(found[0].value));
  CHECK(fsb_vehicle_diagnostics(it, diagnostics) == FSB_OK && diagnostics[2].denominator > 0.0f);
  config.frame = FSB_FRAME_Z_DOWN;
  CHECK(fsb_vehicle_init(it, &config, NULL) == FSB_OK && push(it, -1, &events) == 0);
  CHECK(fsb_vehicle_mass(it, found) == FSB_OK && found[0].value == mass.value && found[0].variance == mass.variance);
  CHECK(fsb_vehicle_state(it, &turned) == FSB_OK && turned.position[2] == -state.position[2]);
  CHECK(turned.velocity[2] == -state.velocity[2] && turned.attitude[0] == state.attitude[0]);

  /* What cannot be is told and counted. The object goes on. */
  measured = fsb_measured_none();
  measured.position[0] = measured.position[1] = 0.0f; /* z is NaN */
  measured.attitude_kind = FSB_ATTITUDE_MATRIX;       /* of zeros */
  wrench.torque[1] = NAN;
  CHECK(fsb_vehicle_update(it, &measured, &wrench, &events) == FSB_OK);
  CHECK(events == (FSB_EVENT_POSITION_REJECTED | FSB_EVENT_ATTITUDE_REJECTED | FSB_EVENT_WRENCH_REJECTED));
  CHECK(fsb_vehicle_counters(it, &counters) == FSB_OK && counters.rejected_positions == 1);
  CHECK(counters.rejected_attitudes == 1 && counters.rejected_wrenches == 1 && counters.mass_changes == 0);
  CHECK(fsb_vehicle_update(it, &measured, &wrench, NULL) == FSB_OK);
  CHECK(fsb_vehicle_missed(it, 5) == FSB_OK);
  CHECK(fsb_vehicle_missed(it, UINT32_MAX) == FSB_OK);
  CHECK(fsb_vehicle_state(it, &state) == FSB_OK && state.translation_status < FSB_STATE_NOMINAL);
  CHECK(isnan(state.position[0]) && isnan(state.rates[0]));
  CHECK(fsb_vehicle_mass(it, found) == FSB_OK && found[0].status == FSB_PARAMETER_HELD && found[0].value == mass.value);
  CHECK(fsb_vehicle_reinitialise(it, FSB_GROUP_TRANSLATION) == FSB_OK);
  CHECK(fsb_vehicle_reinitialise(it, FSB_GROUP_ROTATION) == FSB_OK);
  CHECK(fsb_vehicle_reinitialise(it, 2) == FSB_UNKNOWN_VALUE);
  CHECK(fsb_vehicle_set_learning(it, FSB_LEARNING_CONTACT) == FSB_OK);
  CHECK(fsb_vehicle_set_learning(it, FSB_LEARNING_OFF) == FSB_OK);
  CHECK(fsb_vehicle_set_learning(it, 3) == FSB_UNKNOWN_VALUE);
  CHECK(fsb_vehicle_set_learning(it, FSB_LEARNING_ON) == FSB_OK);
  CHECK(fsb_vehicle_reset(it) == FSB_OK);
  CHECK(fsb_vehicle_state(it, &state) == FSB_OK && state.translation_status == FSB_STATE_NOT_MEASURED);
  CHECK(fsb_vehicle_mass(it, found) == FSB_OK && found[0].status < FSB_PARAMETER_VALID);
  CHECK(fsb_vehicle_counters(it, &counters) == FSB_OK && counters.rejected_wrenches == 2);

  /* A copy is an object of its own. */
  static fsb_vehicle_t copy;
  copy = *it;
  CHECK(push(&copy, -1, &events) == 0 && fsb_vehicle_mass(&copy, found) == FSB_OK && found[0].value == mass.value);
  CHECK(fsb_vehicle_mass(it, found) == FSB_OK && found[0].status < FSB_PARAMETER_VALID);

  config.rotation.observer.q = -1.0;
  CHECK(fsb_vehicle_init(it, &config, &name) == FSB_CONFIG_NOT_POSITIVE && !strcmp(name, "rotation.observer.q"));
  vehicle_refused(it, FSB_NOT_INITIALISED);
}
