#include "modules/kinect_source/openni/usb_sensors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "modules/imaging/temporary_folder.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class UsbSensorsTest : public testing::Test {
 protected:
  // Device 4 on bus 1, and its node.
  void Connect(const std::string& vendor, const std::string& product, bool has_node) {
    fs::create_directories(devices_ / "1-2");
    const std::pair<const char*, std::string> files[] = {
        {"idVendor", vendor}, {"idProduct", product}, {"busnum", "1"}, {"devnum", "4"}};
    for (const auto& [name, text] : files) std::ofstream(devices_ / "1-2" / name) << text << "\n";
    fs::create_directories(nodes_ / "001");
    if (has_node) std::ofstream(nodes_ / "001" / "004") << "";
  }

  std::vector<UsbSensor> Find(const std::vector<std::string>& drivers) const {
    return FindUsbSensors(devices_, nodes_, drivers);
  }

  imaging::TemporaryFolder folder_;
  fs::path devices_ = fs::path(folder_.path()) / "devices",
           nodes_ = fs::path(folder_.path()) / "nodes";
};

TEST_F(UsbSensorsTest, FindsNothingWithoutAUsb) { EXPECT_TRUE(Find({}).empty()); }

TEST_F(UsbSensorsTest, LeavesOutOtherDevices) {
  Connect("046d", "c52b", true);
  EXPECT_TRUE(Find({}).empty());
}

TEST_F(UsbSensorsTest, FindsASensorThatCanBeUsed) {
  Connect("1d27", "0601", true);
  const auto sensors = Find({"/drivers/libPS1080.so.0"});
  ASSERT_EQ(sensors.size(), 1u);
  EXPECT_EQ(sensors[0].name, "PrimeSense sensor (USB 1d27:0601)");
  EXPECT_EQ(sensors[0].trouble, "");
}

TEST_F(UsbSensorsTest, TellsThatAKinectNeedsADriver) {
  Connect("045e", "02ae", true);
  const auto sensors = Find({"/drivers/libPS1080.so.0"});
  ASSERT_EQ(sensors.size(), 1u);
  EXPECT_THAT(sensors[0].trouble, HasSubstr("libFreenectDriver.so.0"));
}

TEST_F(UsbSensorsTest, TellsThatTheRightToUseItIsMissing) {
  Connect("045e", "02ae", false);
  const auto sensors = Find({"libFreenectDriver.so.0"});
  ASSERT_EQ(sensors.size(), 1u);
  EXPECT_THAT(sensors[0].trouble, HasSubstr("001/004"));
}

}  // namespace
}  // namespace declutter
