#include "modules/model_verifier/pixel_owners.h"

namespace declutter {

void PixelOwners::Assign(const std::vector<const RayEvidence*>& evidence, int num_pixels) {
  owners_.assign(static_cast<size_t>(num_pixels), 0);
  fits_.assign(static_cast<size_t>(num_pixels), 0);
  for (size_t i = 0; i < evidence.size(); ++i) {
    const RayEvidence& of_solid = *evidence[i];
    for (size_t k = 0; k < of_solid.explained.size(); ++k) {
      const auto pixel = static_cast<size_t>(of_solid.explained[k]);
      if (of_solid.fits[k] <= fits_[pixel]) continue;
      fits_[pixel] = of_solid.fits[k];
      owners_[pixel] = static_cast<uint8_t>(i + 1);
    }
  }
}

}  // namespace declutter
