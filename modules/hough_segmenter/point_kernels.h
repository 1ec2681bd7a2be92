#pragma once

#include <cstddef>

// Loops over points by SIMD, dispatched at run time to what the processor has. Results are the same
// bits with every instruction set: nothing is fused, and sums are made of kCellBlock partial sums,
// added in the same order.
namespace declutter {

// Elements that kernels may read, and write, after the last one.
inline constexpr size_t kCellBlock = 16;

// The line nx x + ny y = rho with unit normal, and the circle.
struct LineShape {
  float nx = 0, ny = 0, rho = 0;
};
struct CircleShape {
  float cx = 0, cy = 0, r = 0;
};

// Sums over weighted points, q = p - origin: w, w qx, w qy, w qx^2, w qx qy, w qy^2.
struct PointSums {
  float w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};
PointSums SumPoints(const float* x, const float* y, const float* weights, size_t num,
                    float origin_x, float origin_y);

// Sums for a step of least squares on the distances from a circle, e = d - r, u = (p - c) / d:
// w, w ux, w uy, w ux^2, w ux uy, w uy^2, w e, w ux e, w uy e.
struct CircleSums {
  float w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, e = 0, xe = 0, ye = 0;
};
CircleSums SumCircle(const float* x, const float* y, const float* weights, size_t num,
                     const CircleShape& circle);

struct Range {
  float low = 0;
  float high = 0;
};

// Of the positions along the direction (tx, ty) of num > 0 points.
Range RangeAlong(const float* x, const float* y, size_t num, float tx, float ty);

// Position along the direction (tx, ty) of each point.
void PositionsAlong(const float* x, const float* y, size_t num, float tx, float ty,
                    float* positions);

// Distance of each point from (cx, cy).
void Distances(const float* x, const float* y, size_t num, float cx, float cy, float* distances);

// Angle [rad] at (cx, cy) from the direction (ax, ay) to each point, in [-pi, pi], good to 2e-5.
void Angles(const float* x, const float* y, size_t num, float cx, float cy, float ax, float ay,
            float* angles);

// Points inside a circle.
size_t CountInside(const float* x, const float* y, size_t num, const CircleShape& circle);

// Points within tolerance of a circle, and those farther inside than twice that.
struct RingCount {
  int num_on = 0;
  int num_inside = 0;
};
RingCount CountOnRing(const float* x, const float* y, size_t num, const CircleShape& circle,
                      float tolerance);

}  // namespace declutter
