// What core/blocks/lanes-inl.h asks of those who use it, and no compiler sees.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

namespace catena::properties {
namespace {

namespace fs = std::filesystem;

/// A local of lanes, or of what is made of them, and not a reference; members end with an underscore.
const std::regex local_of_lanes(
    R"(^\s+(const )?(L|Lanes\d+|Vectors|VectorsOf<\w+>|Flags<\w+>|Capsules|CapsulesOf<\w+>)"
    R"(|OrientedBoxes|Intervals?|Symmetric|AxisBoxes|Middles|Eight|EightApart) \w*[^\W_])"
    R"((\[.*\])?( =|[,;({]).*$)");

bool is_const_local(const std::string& line) {
  std::smatch parts;
  return std::regex_match(line, parts, local_of_lanes) && parts[1].matched;
}

TEST(Lanes, ConstLocalsAreTold) {
  EXPECT_TRUE(is_const_local("  const Lanes16 zero = Lanes16::all(0), one = Lanes16::all(1);"));
  EXPECT_TRUE(is_const_local("    const VectorsOf<n> t = b.centre - a.centre;"));
  EXPECT_TRUE(is_const_local("  const Lanes8 far(radius);"));
  EXPECT_FALSE(is_const_local("  Lanes16 zero = Lanes16::all(0);"));
  EXPECT_FALSE(is_const_local("  const Lanes16& zero = other;"));
  EXPECT_FALSE(is_const_local("  const Vectors t_;"));
  EXPECT_FALSE(is_const_local("  const LanesOf zero = all();"));
}

/// With AVX2 searches in the chain's order took up to 1.13 times as long where they were.
TEST(Lanes, AreConstNowhereWithinAFunction) {
  int locals = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(CATENA_SOURCE_DIR) / "core")) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with("-inl.h") && !name.ends_with(".cpp")) continue;
    std::ifstream file(entry.path());
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      if (!std::regex_match(line, local_of_lanes)) continue;
      ++locals;
      EXPECT_FALSE(is_const_local(line)) << entry.path().string() << ':' << number << ": " << line;
    }
  }
  EXPECT_GT(locals, 100);
}

}  // namespace
}  // namespace catena::properties
