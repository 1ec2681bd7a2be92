#include "modules/model_verifier/gradient_normals.h"

#include "modules/model_verifier/normal_kernels.h"

namespace declutter {
namespace {

constexpr float kReach = 0.012f;  // [m] from a pixel to those its gradient is taken from
constexpr float kMinReach_px = 2;
constexpr float kMaxInverseJump = 0.020f;  // [1/m] 7 counts of disparity: another surface
constexpr auto kMargin = static_cast<size_t>(kNormalMargin_px);

}  // namespace

void GradientNormals::Compute(const PinholeCamera& camera, const PixelGrid& all,
                              const PixelGrid& every_second) {
  const auto rows = static_cast<size_t>(all.rows);
  const auto columns = static_cast<size_t>(all.columns);
  inverse_depth_.resize(all.z.size());
  for (size_t i = 0; i < all.z.size(); ++i) inverse_depth_[i] = all.z[i] > 0 ? 1 / all.z[i] : 0;

  const size_t means_stride = columns + 2 * kMargin;
  const size_t num_means = (rows + 2 * kMargin) * means_stride;
  // The margin stays zero from frame to frame.
  if (means_.size() != num_means || means_stride != means_stride_) means_.assign(num_means, 0);
  means_stride_ = means_stride;
  float* const means = means_.data() + kMargin * means_stride + kMargin;
  for (size_t v = 1; v + 1 < rows; ++v) {
    const float* middle = &inverse_depth_[v * all.stride];
    MeanInverseDepths(middle - all.stride, middle, middle + all.stride, columns, kMaxInverseJump,
                      means + v * means_stride);
  }

  stride_ = every_second.stride;
  for (auto* plane : {&x_, &y_, &z_}) plane->resize(every_second.z.size());
  const GradientLimits limits{static_cast<float>(camera.fx),
                              static_cast<float>(camera.fy),
                              kReach,
                              kMinReach_px,
                              static_cast<float>(kNormalMargin_px),
                              kMaxInverseJump};
  for (size_t j = 0; j < static_cast<size_t>(every_second.rows); ++j) {
    const NormalRow row{every_second.ray_x.data(),
                        every_second.ray_y[j],
                        &every_second.z[j * stride_],
                        means + kStep * j * means_stride,
                        static_cast<ptrdiff_t>(means_stride),
                        kStep,
                        static_cast<size_t>(every_second.columns)};
    NormalsOfRow(row, limits, &x_[j * stride_], &y_[j * stride_], &z_[j * stride_]);
  }
}

}  // namespace declutter
