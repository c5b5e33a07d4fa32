#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace catena {
namespace {

namespace fs = std::filesystem;

/// What asks for lines by other means may be left out by the compiler.
TEST(Prefetch, IsAskedForByItsHeaderAlone) {
  const fs::path core = fs::path(CATENA_SOURCE_DIR) / "core";
  int users = 0;
  for (const auto& entry : fs::recursive_directory_iterator(core)) {
    const fs::path& path = entry.path();
    if ((path.extension() != ".h" && path.extension() != ".cpp") ||
        path.stem().string().starts_with("prefetch"))
      continue;
    std::ifstream file(path);
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      users += line == "#include \"catena/core/prefetch.h\"";
      for (const char* other : {"hwy::Prefetch", "hn::Prefetch", "__builtin_prefetch", "_mm_prefetch"})
        EXPECT_EQ(line.find(other), std::string::npos) << path.string() << ':' << number << ": " << line;
    }
  }
  EXPECT_GT(users, 5);
}

}  // namespace
}  // namespace catena
