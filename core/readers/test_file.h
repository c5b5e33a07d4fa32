#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "catena/core/error.h"
#include "catena/core/readers/reader.h"

namespace catena {

/// A file of a test: written where no other test writes, gone with the object.
class TestFile {
 public:
  TestFile(const std::string& name, std::string_view content)
      : folder_(std::filesystem::temp_directory_path() /
                ("catena-" + std::to_string(getpid()) + "-" + next())) {
    std::filesystem::create_directories(folder_);
    path_ = folder_ / name;
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TestFile() { std::filesystem::remove_all(folder_); }
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  static std::string next() {
    static int files = 0;
    return std::to_string(files++);
  }
  std::filesystem::path folder_, path_;
};

inline CurveFile read_text(const std::string& name, std::string_view content) {
  const TestFile file(name, content);
  return ReaderRegistry::instance().read(file.path());
}

/// What the reader says is wrong, from the file's name on ("a.swc:3: ..."); empty when nothing is.
inline std::string complaint(const std::string& name, std::string_view content) {
  const TestFile file(name, content);
  try {
    ReaderRegistry::instance().read(file.path());
    return "";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find_first_of("\r\n"), std::string::npos) << text;
    const auto at = text.find(name);
    return at == std::string::npos ? "(no file name) " + text : text.substr(at);
  }
}

inline std::filesystem::path example(const std::string& name) {
  return std::filesystem::path(CATENA_SOURCE_DIR) / "core/readers/examples" / name;
}

#define EXPECT_COMPLAINT(start, name, content)                                       \
  EXPECT_TRUE(complaint(name, content).starts_with(std::string(name) + ":" + start)) \
      << "got: " << complaint(name, content)

}  // namespace catena
