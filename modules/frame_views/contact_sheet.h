#pragma once

#include <optional>
#include <string>

#include "modules/imaging/canvas.h"

namespace declutter {

// Many pictures on one, small, each above its name; row by row, page after page.
class ContactSheet {
 public:
  struct Layout {
    int num_columns = 5;
    int num_rows = 6;
    int width_px = 320;   // of a small picture
    int height_px = 240;  // at most; pictures keep their shape
  };

  explicit ContactSheet(const Layout& layout) : layout_(layout) {}

  // Returns the page that is full with this picture.
  std::optional<ColorImage> Add(const std::string& name, const ColorImage& image);

  // The page that is not full, no higher than needed; nothing when it is empty.
  std::optional<ColorImage> TakeRest();

 private:
  Layout layout_;
  std::optional<imaging::Canvas> page_;
  int num_on_page_ = 0;
};

// The image at most so large, of the same shape; each pixel the mean of those it stands for. One
// that is small enough stays as it is.
ColorImage ShrinkToFit(const ColorImage& image, int width_px, int height_px);

}  // namespace declutter
