// Stand-in for the headers of PX4 that the guide includes.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

#define MODULE_NAME "fsb"
#define PX4_ERR(...) px4_print(__VA_ARGS__)
#define ORB_ID(topic) ORB_TOPIC::topic
void px4_print(const char *format, ...);
using hrt_abstime = uint64_t;
hrt_abstime hrt_absolute_time();

enum class ORB_TOPIC { vehicle_visual_odometry, vehicle_attitude, vehicle_thrust_setpoint, vehicle_land_detected, debug_array };

struct vehicle_odometry_s { float position[3]; };
struct vehicle_attitude_s { float q[4]; };
struct vehicle_thrust_setpoint_s { float xyz[3]; };
struct vehicle_land_detected_s { bool landed; };
struct debug_array_s {
  uint64_t timestamp;
  uint16_t id;
  char name[10];
  float data[58];
};

namespace time_literals {
constexpr uint32_t operator"" _ms(unsigned long long ms) { return static_cast<uint32_t>(ms * 1000); }
}  // namespace time_literals

namespace px4 {
struct wq_config_t {};
namespace wq_configurations {
static constexpr wq_config_t nav_and_controllers{};
}
class ScheduledWorkItem {
protected:
  ScheduledWorkItem(const char *name, const wq_config_t &config);
  virtual ~ScheduledWorkItem();
  void ScheduleOnInterval(uint32_t interval_us, uint32_t delay_us = 0);
  void ScheduleClear();
  virtual void Run() = 0;
};
}  // namespace px4

template <class T>
class ModuleBase {
protected:
  bool should_exit() const;
  static void exit_and_cleanup();
};

namespace uORB {
class Subscription {
public:
  explicit Subscription(ORB_TOPIC topic);
  bool update(void *to);
};
template <typename T>
class Publication {
public:
  explicit Publication(ORB_TOPIC topic);
  bool publish(const T &data);
};
}  // namespace uORB

namespace matrix {
class Vector3f {
public:
  explicit Vector3f(const float values[3]);
  float operator()(unsigned index) const;
};
class Quatf {
public:
  explicit Quatf(const float values[4]);
  Vector3f rotateVector(const Vector3f &vector) const;
};
}  // namespace matrix
