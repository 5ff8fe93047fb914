/* Stand-in for the headers of the Crazyflie firmware that the guide includes. */
#pragma once
#include <stdbool.h>
#include <stdint.h>

typedef uint32_t stabilizerStep_t;
typedef struct {
  float x, y, z, w;
} quaternion_t;
typedef struct {
  quaternion_t attitudeQuaternion;
} state_t;
typedef struct {
  int nothing;
} setpoint_t;
typedef struct {
  int nothing;
} sensorData_t;
typedef enum { controlModeLegacy = 0, controlModeForceTorque = 1 } control_mode_t;
typedef struct {
  float thrust;
  float thrustSi;
  control_mode_t controlMode;
} control_t;

void estimatorOutOfTreeInit(void);
bool estimatorOutOfTreeTest(void);
void estimatorOutOfTree(state_t *state, const stabilizerStep_t stabilizerStep);
void estimatorKalmanInit(void);
bool estimatorKalmanTest(void);
void estimatorKalman(state_t *state, const stabilizerStep_t stabilizerStep);
void controllerOutOfTreeInit(void);
bool controllerOutOfTreeTest(void);
void controllerOutOfTree(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                         const state_t *state, const stabilizerStep_t stabilizerStep);
void controllerLeeFirmwareInit(void);
bool controllerLeeFirmwareTest(void);
void controllerLeeFirmware(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                           const state_t *state, const stabilizerStep_t stabilizerStep);
float powerDistributionGetMaxThrust();

typedef uint16_t logVarId_t;
logVarId_t logGetVarId(const char *group, const char *name);
float logGetFloat(logVarId_t id);
unsigned int logGetUint(logVarId_t id);

enum { LOG_FLOAT, LOG_INT32 };
struct log_s {
  int type;
  const char *name;
  void *address;
};
#define LOG_GROUP_START(NAME) static const struct log_s logs_##NAME[] __attribute__((used)) = {
#define LOG_ADD(TYPE, NAME, ADDRESS) {TYPE, #NAME, (void *)(ADDRESS)},
#define LOG_GROUP_STOP(NAME) {0, #NAME, 0}};
