#include "modules/codec/feature_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "modules/codec/checks.h"
#include "modules/codec/normal_code.h"
#include "modules/geometry/for_each_processor.h"

namespace declutter::codec {
namespace {

// Points coded together, one feature after the other: few enough to stay in the fastest cache.
constexpr size_t kBlock = 256;

using Floats = std::array<float, kBlock>;

// The bytes of the points of a block, plane by plane, after those of the point before.
using Bytes = std::array<uint8_t, kBlock + 1>;
using BlockPlanes = std::array<Bytes, kNumFeaturePlanes>;

const int8_t* Signed(const uint8_t* bytes) { return reinterpret_cast<const int8_t*>(bytes); }
int8_t* Signed(uint8_t* bytes) { return reinterpret_cast<int8_t*>(bytes); }

DECLUTTER_FOR_EACH_PROCESSOR bool AreFinite(const float* values, size_t num) {
  int num_finite = 0;
  for (size_t i = 0; i < num; ++i) {
    num_finite += std::abs(values[i]) <= std::numeric_limits<float>::max();
  }
  return num_finite == static_cast<int>(num);
}

// The nearest number of steps from min to max; halves go away from 0.
DECLUTTER_FOR_EACH_PROCESSOR void Quantise(const float* values, size_t num, double step, double min,
                                           double max, uint8_t* bytes) {
  for (size_t i = 0; i < num; ++i) {
    const double steps = std::min(std::max(static_cast<double>(values[i]) / step, min), max);
    const int whole = static_cast<int>(steps);
    const double rest = steps - whole;
    bytes[i] = static_cast<uint8_t>(whole + (rest >= 0.5) - (rest <= -0.5));
  }
}

void QuantiseFinite(const Floats& values, size_t num, double step, double min, double max,
                    uint8_t* bytes) {
  Demand(AreFinite(values.data(), num), "a feature is not finite");
  Quantise(values.data(), num, step, min, max, bytes);
}

void QuantiseKappa(const Floats& kappa, size_t num, uint8_t* bytes) {
  QuantiseFinite(kappa, num, kKappaStep, -127, 127, bytes);
}

void QuantiseCurvature(const Floats& curvature, size_t num, uint8_t* bytes) {
  QuantiseFinite(curvature, num, kCurvatureStep, 0, 255, bytes);
}

void QuantiseRMin(const Floats& r_min, size_t num, uint8_t* bytes) {
  QuantiseFinite(r_min, num, kRMinStep_m, 0, 255, bytes);
  // A radius below half a step is still one.
  for (size_t i = 0; i < num; ++i) {
    if (bytes[i] == 0 && r_min[i] > 0) bytes[i] = 1;
  }
}

void ToBytes(const FeaturePoint* points, size_t num, FeatureMode mode, BlockPlanes* planes) {
  Floats x, y, z, kappa, curvature, r_min;
  for (size_t i = 0; i < num; ++i) {
    const FeaturePoint& point = points[i];
    x[i] = point.normal.x();
    y[i] = point.normal.y();
    z[i] = point.normal.z();
    kappa[i] = point.kappa;
    curvature[i] = point.curvature;
    r_min[i] = point.r_min;
    const auto label = static_cast<uint32_t>(point.component + 1);
    (*planes)[4][i + 1] = static_cast<uint8_t>(label);
    (*planes)[5][i + 1] = static_cast<uint8_t>(label >> 8);
  }
  for (const Floats* coordinate : {&x, &y, &z}) {
    Demand(AreFinite(coordinate->data(), num), "a normal is not finite");
  }
  std::array<uint8_t*, 4> to;
  for (size_t plane = 0; plane < to.size(); ++plane) to[plane] = &(*planes)[plane][1];
  EncodeNormals(x.data(), y.data(), z.data(), num, Signed(to[0]), Signed(to[1]));
  if (mode == FeatureMode::kPaper) {
    QuantiseCurvature(curvature, num, to[2]);
    QuantiseRMin(r_min, num, to[3]);
  } else {
    QuantiseKappa(kappa, num, to[2]);
    QuantiseCurvature(curvature, num, to[3]);
  }
}

// The differences of num + 1 bytes.
DECLUTTER_FOR_EACH_PROCESSOR void Subtract(const uint8_t* bytes, size_t num, uint8_t* differences) {
  for (size_t i = 0; i < num; ++i) {
    differences[i] = static_cast<uint8_t>(bytes[i + 1] - bytes[i]);
  }
}

// What each byte of a plane stands for.
using Values = std::array<float, 256>;

Values UnsignedValues(double step) {
  Values values;
  for (int byte = 0; byte < 256; ++byte) {
    values[static_cast<size_t>(byte)] = static_cast<float>(byte * step);
  }
  return values;
}

Values SignedValues(double step) {
  Values values;
  for (int byte = 0; byte < 256; ++byte) {
    values[static_cast<size_t>(byte)] = static_cast<float>(static_cast<int8_t>(byte) * step);
  }
  return values;
}

// Undoes the differences of a plane.
void Sum(const uint8_t* differences, size_t num, Bytes* bytes) {
  uint8_t sum = (*bytes)[0];
  for (size_t i = 0; i < num; ++i) {
    sum = static_cast<uint8_t>(sum + differences[i]);
    (*bytes)[i + 1] = sum;
  }
}

void CheckPoint(size_t i, int8_t first, int8_t second, int32_t component, int32_t num_components) {
  Check(IsNormalCode(first, second), {"data normal", i}, int{static_cast<uint8_t>(first)},
        "is no code of a normal");
  Check(component < num_components, {"data component", i}, component,
        "must be below num_components");
}

// Turns the bytes of points into points.
class PointReader {
 public:
  PointReader(FeatureMode mode, const FeatureSteps& steps, int32_t num_components)
      : num_components_(num_components), curvature_plane_(mode == FeatureMode::kPaper ? 2 : 3) {
    if (mode == FeatureMode::kPaper) {
      r_min_ = UnsignedValues(steps.r_min_m);
    } else {
      kappa_ = SignedValues(steps.kappa);
    }
    curvature_ = UnsignedValues(steps.curvature);
  }

  // Of a block that begins with point number `begin`.
  void Read(const BlockPlanes& bytes, const int32_t* pixels, size_t begin, size_t num,
            std::vector<FeaturePoint>* points) {
    const uint8_t* first = &bytes[0][1];
    const uint8_t* second = &bytes[1][1];
    DecodeNormals(Signed(first), Signed(second), num, x_.data(), y_.data(), z_.data());
    for (size_t i = 0; i < num; ++i) {
      const int32_t component = (bytes[4][i + 1] | (bytes[5][i + 1] << 8)) - 1;
      const auto a = static_cast<int8_t>(first[i]), b = static_cast<int8_t>(second[i]);
      if (!IsNormalCode(a, b) || component >= num_components_) {
        CheckPoint(begin + i, a, b, component, num_components_);
      }
      points->push_back({pixels[i],
                         {x_[i], y_[i], z_[i]},
                         kappa_[bytes[2][i + 1]],
                         curvature_[bytes[curvature_plane_][i + 1]],
                         r_min_[bytes[3][i + 1]],
                         component});
    }
  }

 private:
  const int32_t num_components_;
  const size_t curvature_plane_;
  Values kappa_{}, curvature_{}, r_min_{};  // 0 where the mode has no such feature
  Floats x_, y_, z_;
};

}  // namespace

void AppendFeaturePlanes(const std::vector<FeaturePoint>& points, FeatureMode mode,
                         std::vector<uint8_t>* bytes) {
  const size_t first_plane = bytes->size();
  bytes->resize(first_plane + kNumFeaturePlanes * points.size());
  BlockPlanes planes{};
  for (size_t begin = 0; begin < points.size(); begin += kBlock) {
    const size_t num = std::min(kBlock, points.size() - begin);
    ToBytes(&points[begin], num, mode, &planes);
    for (size_t plane = 0; plane < kNumFeaturePlanes; ++plane) {
      Bytes& from = planes[plane];
      uint8_t* to = bytes->data() + first_plane + plane * points.size() + begin;
      Subtract(from.data(), num, to);
      from[0] = from[num];
    }
  }
}

std::vector<FeaturePoint> ReadFeaturePlanes(const uint8_t* planes, FeatureMode mode,
                                            const FeatureSteps& steps, int32_t num_components,
                                            const std::vector<int32_t>& pixels) {
  PointReader reader(mode, steps, num_components);
  std::vector<FeaturePoint> points;
  points.reserve(pixels.size());
  BlockPlanes bytes{};
  for (size_t begin = 0; begin < pixels.size(); begin += kBlock) {
    const size_t num = std::min(kBlock, pixels.size() - begin);
    for (size_t plane = 0; plane < kNumFeaturePlanes; ++plane) {
      Sum(planes + plane * pixels.size() + begin, num, &bytes[plane]);
    }
    reader.Read(bytes, &pixels[begin], begin, num, &points);
    for (Bytes& plane : bytes) plane[0] = plane[num];
  }
  return points;
}

}  // namespace declutter::codec
