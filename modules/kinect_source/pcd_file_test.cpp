#include "modules/kinect_source/pcd_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "modules/imaging/temporary_folder.h"
#include "modules/kinect_source/recording_files.h"

namespace declutter {
namespace {

using ::testing::HasSubstr;

constexpr const char* kHeader =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";

class PcdFileTest : public ::testing::Test {
 protected:
  std::string Path(const std::string& name) const { return folder_ / name; }

  std::string ErrorOf(const std::string& content) const {
    WriteText(Path("cloud.pcd"), content);
    try {
      ReadPcdFile(Path("cloud.pcd"));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  // 40 x 30 labelled, coloured points as PCL writes them, one of them not measured.
  pcl::PointCloud<pcl::PointXYZRGBL> PclCloud() const {
    pcl::PointCloud<pcl::PointXYZRGBL> cloud(40, 30);
    for (size_t i = 0; i < cloud.size(); ++i) {
      const auto step = static_cast<float>(i);
      cloud[i].x = 0.001f * step;
      cloud[i].y = -0.5f;
      cloud[i].z = 1 + 0.25f * step;
      cloud[i].rgba = 0xFF000000u + static_cast<uint32_t>(i) * 77u;
      cloud[i].label = static_cast<uint32_t>(i % 5);
    }
    cloud[7].z = std::numeric_limits<float>::quiet_NaN();
    cloud.is_dense = false;
    return cloud;
  }

  void ExpectSame(const PointCloudFile& read, const pcl::PointCloud<pcl::PointXYZRGBL>& cloud) {
    EXPECT_EQ(read.width, 40);
    EXPECT_EQ(read.height, 30);
    ASSERT_EQ(read.points.size(), cloud.size());
    ASSERT_EQ(read.colors.size(), cloud.size());
    for (size_t i = 0; i < cloud.size(); ++i) {
      EXPECT_FLOAT_EQ(read.points[i].x(), cloud[i].x);
      EXPECT_FLOAT_EQ(read.points[i].y(), cloud[i].y);
      EXPECT_EQ(std::isnan(read.points[i].z()), i == 7);
      EXPECT_TRUE(i == 7 || read.points[i].z() == cloud[i].z);
      EXPECT_EQ(read.colors[i] & 0xFFFFFFu, cloud[i].rgba & 0xFFFFFFu);
    }
  }

  imaging::TemporaryFolder folder_;
};

TEST_F(PcdFileTest, ReadsTextWrittenByPcl) {
  pcl::io::savePCDFileASCII(Path("cloud.pcd"), PclCloud());
  ExpectSame(ReadPcdFile(Path("cloud.pcd")), PclCloud());
}

TEST_F(PcdFileTest, ReadsBinaryWrittenByPcl) {
  pcl::io::savePCDFileBinary(Path("cloud.pcd"), PclCloud());
  ExpectSame(ReadPcdFile(Path("cloud.pcd")), PclCloud());
}

TEST_F(PcdFileTest, ReadsCompressedBinaryWrittenByPcl) {
  pcl::io::savePCDFileBinaryCompressed(Path("cloud.pcd"), PclCloud());
  ExpectSame(ReadPcdFile(Path("cloud.pcd")), PclCloud());
}

TEST_F(PcdFileTest, RefusesFilesCutAnywhere) {
  pcl::io::savePCDFileBinary(Path("binary.pcd"), PclCloud());
  pcl::io::savePCDFileBinaryCompressed(Path("compressed.pcd"), PclCloud());
  for (const char* name : {"binary.pcd", "compressed.pcd"}) {
    for (auto kept = std::filesystem::file_size(Path(name)) - 1; kept > 0; kept = kept * 4 / 5) {
      std::filesystem::resize_file(Path(name), kept);
      EXPECT_THROW(ReadPcdFile(Path(name)), std::runtime_error) << name << " " << kept;
    }
  }
}

TEST_F(PcdFileTest, RefusesDamagedCompression) {
  pcl::io::savePCDFileBinaryCompressed(Path("cloud.pcd"), PclCloud());
  std::fstream file(Path("cloud.pcd"), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(-200, std::ios::end);
  file << std::string(200, '\xFF');
  file.close();
  EXPECT_THROW(ReadPcdFile(Path("cloud.pcd")), std::runtime_error);
}

TEST_F(PcdFileTest, RefusesWhatIsNoCloud) {
  EXPECT_EQ(ErrorOf(""), Path("cloud.pcd") + ": not a .pcd file: it has no DATA line");
  EXPECT_THAT(ErrorOf("this is not a cloud\n"), HasSubstr("line 'this' in its header"));
  EXPECT_THAT(ErrorOf("\x7F\n"), HasSubstr("line '?' in its header"));
  EXPECT_THAT(ErrorOf("DATA ascii\n"), HasSubstr("a cloud without points"));
  EXPECT_THAT(ErrorOf(std::string(kHeader) + "WIDTH -1\n"), HasSubstr("WIDTH is '-1'"));
  EXPECT_THAT(ErrorOf(std::string(kHeader) + "WIDTH 1\nDATA zip\n"), HasSubstr("DATA is 'zip'"));
  EXPECT_THAT(ErrorOf("FIELDS x y\nSIZE 4\n"), HasSubstr("SIZE does not have a value per field"));
  EXPECT_THAT(ErrorOf("FIELDS x y\nWIDTH 1\nDATA ascii\n1 2\n"), HasSubstr("no 32-bit float"));
}

TEST_F(PcdFileTest, RefusesMorePointsThanTheFileHolds) {
  const std::string header = std::string(kHeader) + "WIDTH 4096\nHEIGHT 4096\nDATA ";
  EXPECT_THAT(ErrorOf(header + "binary\nabc"), HasSubstr("truncated"));
  EXPECT_THAT(ErrorOf(header + "ascii\n1 2 3\n"), HasSubstr("truncated"));
  const std::string one_byte("\1\0\0\0\0\0\0\x0C\0", 9);  // announces 201326592 bytes from one
  EXPECT_THAT(ErrorOf(header + "binary_compressed\n" + one_byte), HasSubstr("damaged"));
}

TEST_F(PcdFileTest, ReadsPointsWithoutColour) {
  WriteText(Path("cloud.pcd"), std::string(kHeader) + "WIDTH 2\nDATA ascii\n1 2 3\nnan 5 6\n");
  const PointCloudFile cloud = ReadPcdFile(Path("cloud.pcd"));
  EXPECT_FALSE(cloud.is_organised());
  EXPECT_TRUE(cloud.colors.empty());
  EXPECT_EQ(cloud.points.at(0), Eigen::Vector3f(1, 2, 3));
  EXPECT_TRUE(std::isnan(cloud.points.at(1).x()));
}

}  // namespace
}  // namespace declutter
