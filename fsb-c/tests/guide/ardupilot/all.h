// Stand-in for the headers of ArduPilot that the guide includes.
#pragma once
#include <cmath>
#include <cstdint>

struct Vector2f {
  float x, y;
};
struct Vector3f {
  float x, y, z;
  constexpr Vector3f() : x(0), y(0), z(0) {}
  constexpr Vector3f(float x0, float y0, float z0) : x(x0), y(y0), z(z0) {}
  float operator[](uint8_t index) const;
};
struct Matrix3f {
  Vector3f operator*(const Vector3f &vector) const;
};

class AP_AHRS {
public:
  bool get_relative_position_NED_origin_float(Vector3f &position) const __attribute__((warn_unused_result));
  uint32_t getLastPosNorthEastReset(Vector2f &position);
  uint32_t getLastPosDownReset(float &delta);
  const Matrix3f &get_rotation_body_to_ned() const;
};
class AP_Motors {
public:
  bool armed() const;
  float get_throttle_out() const;
};
class AP_Logger {
public:
  void WriteStreaming(const char *name, const char *labels, const char *format, ...);
};
namespace AP {
AP_AHRS &ahrs();
AP_Motors *motors();
AP_Logger &logger();
}  // namespace AP
namespace AP_HAL {
uint64_t micros64();
}
