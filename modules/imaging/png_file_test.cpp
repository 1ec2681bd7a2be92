#include "modules/imaging/png_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>

#include "modules/imaging/temporary_folder.h"

namespace declutter::imaging {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class PngFileTest : public ::testing::Test {
 protected:
  std::string Path(const std::string& name) const { return folder_ / name; }

  // Writes a PNG of one row in a layout that the library's own writers do not produce.
  std::string WriteRow(const std::string& name, uint32_t format, const std::vector<uint8_t>& row,
                       uint32_t width, const std::vector<uint8_t>& palette = {}) {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = 1;
    image.format = format;
    image.colormap_entries = static_cast<uint32_t>(palette.size() / 3);
    EXPECT_TRUE(png_image_write_to_file(&image, Path(name).c_str(), 0, row.data(), 0,
                                        palette.empty() ? nullptr : palette.data()))
        << image.message;
    return Path(name);
  }

  static std::string ErrorOf(const std::function<void()>& action) {
    try {
      action();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  TemporaryFolder folder_;
};

TEST_F(PngFileTest, KeepsEvery16BitSample) {
  const GrayImage<uint16_t> image{3, 2, {0, 1, 256, 65535, 4660, 700}};
  WriteGray16Png(Path("depth.png"), image);
  const auto read = ReadGray16Png(Path("depth.png"));
  EXPECT_EQ(read.width, 3);
  EXPECT_EQ(read.height, 2);
  EXPECT_EQ(read.pixels, image.pixels);
}

TEST_F(PngFileTest, KeepsEvery8BitSample) {
  const GrayImage<uint8_t> image{2, 2, {0, 1, 128, 255}};
  WriteGray8Png(Path("labels.png"), image);
  EXPECT_EQ(ReadGray8Png(Path("labels.png")).pixels, image.pixels);
}

TEST_F(PngFileTest, KeepsColours) {
  const ColorImage image{2, 1, {255, 0, 7, 1, 2, 3}};
  WriteRgbPng(Path("rgb.png"), image);
  const auto read = ReadRgbPng(Path("rgb.png"));
  EXPECT_EQ(read.width, 2);
  EXPECT_EQ(read.height, 1);
  EXPECT_EQ(read.rgb, image.rgb);
}

TEST_F(PngFileTest, ExpandsGreyToRgb) {
  WriteGray8Png(Path("grey.png"), {2, 1, {9, 200}});
  EXPECT_THAT(ReadRgbPng(Path("grey.png")).rgb, ElementsAre(9, 9, 9, 200, 200, 200));
}

TEST_F(PngFileTest, Scales16BitGreyToRgb) {
  WriteGray16Png(Path("grey16.png"), {2, 1, {0x0101, 0xFFFF}});
  EXPECT_THAT(ReadRgbPng(Path("grey16.png")).rgb, ElementsAre(1, 1, 1, 255, 255, 255));
}

TEST_F(PngFileTest, DropsAlpha) {
  const auto path = WriteRow("alpha.png", PNG_FORMAT_RGBA, {10, 20, 30, 128, 40, 50, 60, 255}, 2);
  EXPECT_THAT(ReadRgbPng(path).rgb, ElementsAre(10, 20, 30, 40, 50, 60));
}

TEST_F(PngFileTest, ExpandsPalette) {
  const auto path = WriteRow("palette.png", PNG_FORMAT_RGB_COLORMAP, {1, 0}, 2, {1, 2, 3, 7, 8, 9});
  EXPECT_THAT(ReadRgbPng(path).rgb, ElementsAre(7, 8, 9, 1, 2, 3));
}

TEST_F(PngFileTest, NamesTheKindOfAnImageThatIsNot16BitGrey) {
  WriteGray8Png(Path("grey.png"), {1, 1, {9}});
  WriteRgbPng(Path("rgb.png"), {1, 1, {1, 2, 3}});
  EXPECT_EQ(ErrorOf([&] { ReadGray16Png(Path("grey.png")); }),
            Path("grey.png") + ": 8-bit grey PNG where 16-bit grey is needed");
  EXPECT_THAT(ErrorOf([&] { ReadGray16Png(Path("rgb.png")); }), HasSubstr("8-bit RGB"));
}

TEST_F(PngFileTest, RefusesAFileThatIsNotAPng) {
  std::ofstream(Path("text.png")) << "this is not an image";
  std::ofstream(Path("empty.png")).flush();
  EXPECT_EQ(ErrorOf([&] { ReadGray16Png(Path("text.png")); }),
            Path("text.png") + ": not a PNG file");
  EXPECT_EQ(ErrorOf([&] { ReadGray16Png(Path("empty.png")); }), Path("empty.png") + ": empty file");
}

TEST_F(PngFileTest, NamesAMissingFile) {
  EXPECT_EQ(ErrorOf([&] { ReadRgbPng(Path("none.png")); }),
            Path("none.png") + ": No such file or directory");
}

TEST_F(PngFileTest, RefusesAFileCutAnywhere) {
  GrayImage<uint16_t> image{40, 30, std::vector<uint16_t>(1200)};
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = static_cast<uint16_t>(i * i * 7919);
  }
  WriteGray16Png(Path("whole.png"), image);
  const auto num_bytes = std::filesystem::file_size(Path("whole.png"));
  for (auto kept = num_bytes - 1; kept > 8; kept = kept * 3 / 4) {
    std::filesystem::copy_file(Path("whole.png"), Path("cut.png"),
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(Path("cut.png"), kept);
    EXPECT_EQ(ErrorOf([&] { ReadGray16Png(Path("cut.png")); }), Path("cut.png") + ": truncated PNG")
        << kept << " of " << num_bytes << " bytes";
  }
}

TEST_F(PngFileTest, RefusesDamagedPixels) {
  WriteGray16Png(Path("depth.png"), {4, 4, std::vector<uint16_t>(16, 1234)});
  std::fstream file(Path("depth.png"), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(50);
  file.put('\x55');
  file.close();
  EXPECT_THAT(ErrorOf([&] { ReadGray16Png(Path("depth.png")); }), HasSubstr("damaged PNG"));
}

TEST_F(PngFileTest, SaysWhyAFileCannotBeWritten) {
  EXPECT_EQ(ErrorOf([&] {
              WriteGray8Png(Path("no/such/folder.png"), {1, 1, {0}});
            }),
            Path("no/such/folder.png") + ": No such file or directory");
}

TEST_F(PngFileTest, SaysThatTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  std::filesystem::create_symlink("/dev/full", Path("labels.png"));
  EXPECT_THAT(ErrorOf([&] {
                WriteGray8Png(Path("labels.png"), {1, 1, {0}});
              }),
              HasSubstr("labels.png: cannot be written: No space left on device"));
  EXPECT_FALSE(std::filesystem::exists(Path("labels.png")));
}

}  // namespace
}  // namespace declutter::imaging
