// Cameras: how points of the world become pixels. World: metres, z up; the front view looks along +y.
// Picture: x to the right, y down, pixel centres at (i+0.5, j+0.5).
#pragma once
#include <espalier/core/vec3.h>
#include <espalier/plant/plant.h>

namespace espalier {

enum class Projection { orthographic, perspective };

struct Camera {
  Projection projection = Projection::orthographic;
  Vec3 position_m{0, -100, 0};  ///< eye; orthographic: where depth is 0, but nothing behind it is cut off
  Vec3 right{1, 0, 0}, up{0, 0, 1}, forward{0, 1, 0};  ///< unit, at right angles
  float metres_per_px = 0.01f;  ///< orthographic: size of a pixel; perspective: its size at distance 1 m
  float center_x_px = 0,
        center_y_px = 0;  ///< where position_m (orthographic) or the axis (perspective) falls
  int width_px = 512, height_px = 512;
};

struct Ray {
  Vec3 origin_m, direction;
};

/// The ray through picture position (x_px, y_px); the centre of pixel (i, j) is (i+0.5, j+0.5).
Ray camera_ray(const Camera& camera, float x_px, float y_px);

/// Picture position of a world point; `depth_m` is its distance along `forward`.
struct PicturePoint {
  float x_px, y_px, depth_m;
};
PicturePoint project(const Camera& camera, Vec3 point_m);

/// A direction given as azimuth about z (0 = front view, looks along +y; 90 looks along -x)
/// and elevation above the horizon (camera higher looks down).
struct View {
  float azimuth_deg = 0, elevation_deg = 0;
  Projection projection = Projection::orthographic;
  float field_of_view_deg = 40;  ///< vertical, perspective only
};

/// A camera that sees all of `box` with a margin: frame = `margin` × the larger of width and height, centred.
/// A box without a size gets a frame 1 m high.
Camera frame_bounds(const Bounds& box, const View& view, int width_px, int height_px, float margin = 1.08f);

/// A camera for fits: the world point `base_m` falls on the middle of the bottom edge (at `base_row_px`),
/// and `metres_per_px` sets the scale. Orthographic, or perspective from a distance that keeps that
/// scale in the plane through the base.
Camera frame_base(Vec3 base_m, const View& view, float metres_per_px, int width_px, int height_px,
                  float base_row_px);

}  // namespace espalier
