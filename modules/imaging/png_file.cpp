#include "modules/imaging/png_file.h"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace declutter::imaging {
namespace {

constexpr png_uint_32 kMaxSidePx = 8192;

// libpng reports an error by a jump that runs no destructor. So everything that owns memory lives
// in this struct, outside the functions that are jumped out of, and those hold plain values only.
struct PngSession {
  explicit PngSession(std::string file_path) : path(std::move(file_path)) {}
  PngSession(const PngSession&) = delete;
  PngSession& operator=(const PngSession&) = delete;
  ~PngSession() {
    if (file != nullptr) std::fclose(file);
    if (png == nullptr) return;
    if (is_reader) {
      png_destroy_read_struct(&png, &info, nullptr);
    } else {
      png_destroy_write_struct(&png, &info);
    }
  }

  [[noreturn]] void Throw(const std::string& what) const {
    throw std::runtime_error(path + ": " + what);
  }

  std::string path;
  FILE* file = nullptr;
  png_structp png = nullptr;
  png_infop info = nullptr;
  bool is_reader = true;
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  int bit_depth = 0;
  int color_type = 0;
  std::vector<png_bytep> rows;
  char error[128] = "";
};

void OnError(png_structp png, png_const_charp text) {
  auto* session = static_cast<PngSession*>(png_get_error_ptr(png));
  std::snprintf(session->error, sizeof session->error, "%s", text);
  png_longjmp(png, 1);
}

// Warnings concern colour profiles and text chunks, which are not used.
void OnWarning(png_structp, png_const_charp) {}

// False: session.error says why.
bool ReadHeader(PngSession& session) {
  if (setjmp(png_jmpbuf(session.png)) != 0) return false;
  png_init_io(session.png, session.file);
  png_set_user_limits(session.png, kMaxSidePx, kMaxSidePx);
  png_read_info(session.png, session.info);
  png_get_IHDR(session.png, session.info, &session.width, &session.height, &session.bit_depth,
               &session.color_type, nullptr, nullptr, nullptr);
  return true;
}

// Reads into session.rows, which point to `row_bytes` bytes each.
bool ReadRows(PngSession& session, size_t row_bytes, bool as_rgb) {
  if (setjmp(png_jmpbuf(session.png)) != 0) return false;
  if (as_rgb) {
    png_set_expand(session.png);
    png_set_scale_16(session.png);
    png_set_gray_to_rgb(session.png);
    png_set_strip_alpha(session.png);
  } else if (session.bit_depth == 16) {
    png_set_swap(session.png);  // PNG keeps samples big-endian
  }
  png_set_interlace_handling(session.png);
  png_read_update_info(session.png, session.info);
  if (png_get_rowbytes(session.png, session.info) != row_bytes) {
    png_error(session.png, "unexpected row size");
  }
  png_read_image(session.png, session.rows.data());
  png_read_end(session.png, nullptr);
  return true;
}

bool WriteRows(PngSession& session) {
  if (setjmp(png_jmpbuf(session.png)) != 0) return false;
  png_init_io(session.png, session.file);
  // A fraction of the time of the default, for a somewhat larger file.
  png_set_compression_level(session.png, 1);
  png_set_filter(session.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_IHDR(session.png, session.info, session.width, session.height, session.bit_depth,
               session.color_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(session.png, session.info);
  if (session.bit_depth == 16) png_set_swap(session.png);
  png_write_image(session.png, session.rows.data());
  png_write_end(session.png, nullptr);
  return true;
}

// libpng calls a premature end of file a "Read Error".
[[noreturn]] void ThrowReadError(const PngSession& session) {
  if (std::feof(session.file) != 0) session.Throw("truncated PNG");
  session.Throw(std::string("damaged PNG: ") + session.error);
}

void Open(PngSession& session) {
  session.file = std::fopen(session.path.c_str(), "rb");
  if (session.file == nullptr) session.Throw(std::strerror(errno));
  png_byte signature[8] = {};
  const size_t num_read = std::fread(signature, 1, sizeof signature, session.file);
  if (num_read == 0) session.Throw(std::ferror(session.file) ? std::strerror(errno) : "empty file");
  if (png_sig_cmp(signature, 0, num_read) != 0) session.Throw("not a PNG file");
  std::rewind(session.file);
  session.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &session, OnError, OnWarning);
  if (session.png == nullptr) session.Throw("cannot start libpng");
  session.info = png_create_info_struct(session.png);
  if (session.info == nullptr) session.Throw("cannot start libpng");
  if (!ReadHeader(session)) ThrowReadError(session);
}

// Points session.rows into `pixels`, which holds the image with `row_bytes` a row.
void SetRows(PngSession& session, const void* pixels, size_t row_bytes) {
  auto* bytes = static_cast<png_bytep>(const_cast<void*>(pixels));
  session.rows.resize(session.height);
  for (size_t v = 0; v < session.rows.size(); ++v) session.rows[v] = bytes + v * row_bytes;
}

std::string KindOf(const PngSession& session) {
  const char* kind = session.color_type == PNG_COLOR_TYPE_GRAY         ? "grey"
                     : session.color_type == PNG_COLOR_TYPE_GRAY_ALPHA ? "grey and alpha"
                     : session.color_type == PNG_COLOR_TYPE_PALETTE    ? "palette"
                     : session.color_type == PNG_COLOR_TYPE_RGB        ? "RGB"
                                                                       : "RGB and alpha";
  return std::to_string(session.bit_depth) + "-bit " + kind;
}

template <typename Pixel>
GrayImage<Pixel> ReadGray(const std::string& path) {
  PngSession session(path);
  Open(session);
  constexpr int kBits = 8 * sizeof(Pixel);
  if (session.color_type != PNG_COLOR_TYPE_GRAY || session.bit_depth != kBits) {
    session.Throw(KindOf(session) + " PNG where " + std::to_string(kBits) + "-bit grey is needed");
  }
  GrayImage<Pixel> image;
  image.width = static_cast<int>(session.width);
  image.height = static_cast<int>(session.height);
  image.pixels.resize(static_cast<size_t>(session.width) * session.height);
  const size_t row_bytes = session.width * sizeof(Pixel);
  SetRows(session, image.pixels.data(), row_bytes);
  if (!ReadRows(session, row_bytes, /*as_rgb=*/false)) ThrowReadError(session);
  return image;
}

void Write(const std::string& path, int width, int height, int bit_depth, int color_type,
           const void* pixels, size_t row_bytes, bool size_agrees) {
  if (width <= 0 || height <= 0 || !size_agrees) {
    throw std::logic_error(path + ": image of " + std::to_string(width) + " x " +
                           std::to_string(height) + " px with another number of pixels");
  }
  PngSession session(path);
  session.is_reader = false;
  session.width = static_cast<png_uint_32>(width);
  session.height = static_cast<png_uint_32>(height);
  session.bit_depth = bit_depth;
  session.color_type = color_type;
  SetRows(session, pixels, row_bytes);
  session.file = std::fopen(path.c_str(), "wb");
  if (session.file == nullptr) session.Throw(std::strerror(errno));
  session.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &session, OnError, OnWarning);
  if (session.png != nullptr) session.info = png_create_info_struct(session.png);
  errno = 0;
  bool written = session.info != nullptr && WriteRows(session);
  written = std::fclose(session.file) == 0 && written;
  session.file = nullptr;
  if (written) return;
  const int cause = errno;
  std::remove(path.c_str());
  session.Throw(std::string("cannot be written: ") +
                (cause != 0 ? std::strerror(cause) : session.error));
}

}  // namespace

GrayImage<uint16_t> ReadGray16Png(const std::string& path) { return ReadGray<uint16_t>(path); }

GrayImage<uint8_t> ReadGray8Png(const std::string& path) { return ReadGray<uint8_t>(path); }

ColorImage ReadRgbPng(const std::string& path) {
  PngSession session(path);
  Open(session);
  ColorImage image;
  image.width = static_cast<int>(session.width);
  image.height = static_cast<int>(session.height);
  const size_t row_bytes = size_t{3} * session.width;
  image.rgb.resize(row_bytes * session.height);
  SetRows(session, image.rgb.data(), row_bytes);
  if (!ReadRows(session, row_bytes, /*as_rgb=*/true)) ThrowReadError(session);
  return image;
}

void WriteGray8Png(const std::string& path, const GrayImage<uint8_t>& image) {
  const auto row_bytes = static_cast<size_t>(image.width);
  Write(path, image.width, image.height, 8, PNG_COLOR_TYPE_GRAY, image.pixels.data(), row_bytes,
        image.pixels.size() == row_bytes * static_cast<size_t>(image.height));
}

void WriteGray16Png(const std::string& path, const GrayImage<uint16_t>& image) {
  const auto width = static_cast<size_t>(image.width);
  Write(path, image.width, image.height, 16, PNG_COLOR_TYPE_GRAY, image.pixels.data(), 2 * width,
        image.pixels.size() == width * static_cast<size_t>(image.height));
}

void WriteRgbPng(const std::string& path, const ColorImage& image) {
  const size_t row_bytes = 3 * static_cast<size_t>(image.width);
  Write(path, image.width, image.height, 8, PNG_COLOR_TYPE_RGB, image.rgb.data(), row_bytes,
        image.rgb.size() == row_bytes * static_cast<size_t>(image.height));
}

}  // namespace declutter::imaging
