#pragma once

#include <cstddef>

// Loops over cells by SIMD, dispatched at run time to what the processor has. Results are the same
// bits with every instruction set: nothing is fused, and sums are made of kCellBlock partial sums,
// added in the same order.
namespace declutter {

// Elements that kernels may read, and write, after the last one.
inline constexpr size_t kCellBlock = 16;

// What tells whether a cell is an inlier, one array each.
struct CellView {
  const float* x = nullptr;   // [m]
  const float* y = nullptr;   // [m]
  const float* nx = nullptr;  // of the unit normal
  const float* ny = nullptr;
  const float* inverse_limit = nullptr;  // [1/m^2] of the squared distance of an inlier
  const float* weight = nullptr;         // [px] 0 where a cell is not to be looked at
  size_t num = 0;

  CellView Part(size_t begin, size_t num_of_part) const {
    return {x + begin,      y + begin,  nx + begin, ny + begin, inverse_limit + begin,
            weight + begin, num_of_part};
  }
};

// The line nx x + ny y = rho with unit normal, and the circle.
struct LineShape {
  float nx = 0, ny = 0, rho = 0;
};
struct CircleShape {
  float cx = 0, cy = 0, r = 0;
};

// How well each cell agrees with a model: 0 no inlier or of no weight, 1 exactly on it with the
// same normal (equation 1). min_cos: of the angle between the normals of an inlier and of its
// model.
void Agreements(const CellView& cells, const LineShape& line, float min_cos, float* agreements);
void Agreements(const CellView& cells, const CircleShape& circle, float min_cos, float* agreements);

// The sum of agreements times weights [px], for circles with the distance to first order, (d^2 -
// r^2) / 2r.
float Support(const CellView& cells, const LineShape& line, float min_cos);
float Support(const CellView& cells, const CircleShape& circle, float min_cos);

// Copies the elements of num_fields arrays for which marks are positive. Arrays of `from` are
// from_stride elements apart, those of `to` to_stride; both may be the same memory. Returns how
// many elements of each array were kept.
size_t CopyMarked(const float* marks, size_t num, size_t num_fields, const float* from,
                  size_t from_stride, float* to, size_t to_stride);

struct Range {
  float low = 0;
  float high = 0;
};
// Of num > 0 values, and reads no others.
Range RangeOf(const float* values, size_t num);

float SumOf(const float* values, size_t num);
float SumOfProducts(const float* a, const float* b, size_t num);

// The sum of the weights of the values below limit.
float WeightBelow(const float* values, const float* weights, size_t num, float limit);

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

// Position along the direction (tx, ty) of each point.
void PositionsAlong(const float* x, const float* y, size_t num, float tx, float ty,
                    float* positions);

// Distance of each point from (cx, cy).
void Distances(const float* x, const float* y, size_t num, float cx, float cy, float* distances);

// Angle [rad] at (cx, cy) from the direction (ax, ay) to each point, in [-pi, pi], good to 2e-5.
void Angles(const float* x, const float* y, size_t num, float cx, float cy, float ax, float ay,
            float* angles);

// Points within tolerance of a circle, and those farther inside than twice that.
struct RingCount {
  int num_on = 0;
  int num_inside = 0;
};
RingCount CountOnRing(const float* x, const float* y, size_t num, const CircleShape& circle,
                      float tolerance);

}  // namespace declutter
