#include <espalier/lsystem/drawing/turtle.h>

namespace espalier::lsystem {

namespace {

constexpr double kSmallest = 1e-12;

}  // namespace

void Turtle::level() {
  const Vector horizontal = cross({0, 0, 1}, heading);
  const double size = length(horizontal);
  if (size < kSmallest) return;  // heading straight up or down: every left is horizontal
  left = horizontal * (1 / size);
  up = cross(heading, left);
}

void Turtle::rotate(Vector axis_rad) {
  const double angle = length(axis_rad);
  if (angle < kSmallest) return;
  const Vector axis = axis_rad * (1 / angle);
  const double sine = std::sin(angle), cosine = std::cos(angle);
  for (Vector* v : {&heading, &left, &up})
    *v = *v * cosine + cross(axis, *v) * sine + axis * (dot(axis, *v) * (1 - cosine));
}

void Turtle::look_at(Vector target) {
  const Vector way = target - position;
  const double distance = length(way);
  if (distance < kSmallest) return;
  const Vector direction = way * (1 / distance);
  const Vector axis = cross(heading, direction);
  const double sine = length(axis), cosine = dot(heading, direction);
  if (sine < kSmallest) {
    if (cosine < 0) rotate(up * std::numbers::pi);
    return;
  }
  rotate(axis * (std::atan2(sine, cosine) / sine));
}

void Turtle::bend(Vector tropism, double susceptibility) { rotate(cross(heading, tropism) * susceptibility); }

}  // namespace espalier::lsystem
