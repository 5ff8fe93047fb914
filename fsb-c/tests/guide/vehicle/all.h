/* Stand-in for a flight controller's own functions that the guide calls. */
#pragma once
#include <stdbool.h>
#include "fsb.h"

struct motors {
  float force[3], torque[3];
};
bool mocap_new(float position_ned[3]);                  /* true once for each sample */
bool attitude_new(float quaternion[4]);                 /* body to world */
void motors_wrench(struct motors *since_the_last_tick); /* from the motors' speeds or the throttles */
bool landed(void);
void control(const fsb_vehicle_state_t *state, const fsb_vehicle_model_t *model);
void fall_back(void);
