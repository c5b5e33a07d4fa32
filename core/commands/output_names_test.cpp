#include "catena/core/commands/output_names.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

/// A file is the same by whatever name, there or yet to be made, first or last of several; a device loses
/// nothing.
TEST(OutputNames, AreApartFromOneAnotherAndFromWhatIsRead) {
  const TestFile file("a.csv", "");
  const std::filesystem::path folder = file.path().parent_path();
  std::filesystem::create_hard_link(file.path(), folder / "link.csv");
  const std::string read = file.path(), link = folder / "link.csv", fresh = folder / "b.csv",
                    again = folder / "none/../b.csv", other = folder / "c.csv";
  using Names = std::vector<std::string>;
  for (const Names& wrong : {Names{read},
                             {"", read},
                             {link},
                             {other, link},
                             {fresh, fresh},
                             {fresh, other, fresh},
                             {fresh, "", again},
                             {"-"}})
    EXPECT_THROW(require_apart({"rod:n=5", read}, wrong), InputError) << wrong.back();
  for (const Names& right : {Names{}, {""}, {fresh, other}, {"", ""}, {"/dev/null", fresh, "/dev/null"}})
    EXPECT_NO_THROW(require_apart({"rod:n=5", read}, right));
}

}  // namespace
}  // namespace catena
