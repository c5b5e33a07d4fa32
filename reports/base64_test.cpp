// Bytes as text in base 64.
#include "catena/reports/base64.h"

#include <gtest/gtest.h>

#include <span>
#include <string>

namespace catena::reports {
namespace {

TEST(Report, Base64IsThatOfTheStandard) {
  const auto of = [](const std::string& text) { return base64(std::span<const char>(text)); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace catena::reports
