#include "catena/core/commands/output_names.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

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

/// By whatever names they are written, of a folder or of the one that the process is in; through links to
/// nothing yet, too.
TEST(OutputNames, AreApartWhereNothingIsYet) {
  const TestFile file("a.csv", "");
  const std::filesystem::path folder = file.path().parent_path(), before = std::filesystem::current_path();
  std::filesystem::current_path(folder);
  std::filesystem::create_symlink("y.csv", folder / "x.csv");
  for (const std::string& again :
       {std::string("./b.csv"), (folder / "b.csv").string(), std::string("none/../b.csv")})
    EXPECT_THROW(require_apart(std::vector<std::string>{}, {"b.csv", again}), InputError) << again;
  for (const std::string& again : {std::string("y.csv"), (folder / "y.csv").string()})
    EXPECT_THROW(require_apart(std::vector<std::string>{}, {again, "x.csv"}), InputError) << again;
  EXPECT_NO_THROW(require_apart(std::vector<std::string>{}, {"b.csv", "x.csv"}));
  std::filesystem::current_path(before);
}

/// Of names whose places cannot be told none is another's; who writes there says what is wrong.
TEST(OutputNames, AreApartWhereTheyCannotBeFollowed) {
  const TestFile file("a.csv", "");
  const std::filesystem::path folder = file.path().parent_path();
  std::string far = folder;
  while (far.size() < 5000) far += "/" + std::string(200, 'f');
  for (const char* loop : {"loop", "other"}) std::filesystem::create_symlink(loop, folder / loop);
  const std::string loop = folder / "loop/a.csv", other = folder / "other/b.csv";
  EXPECT_NO_THROW(require_apart({file.path()}, {loop, far + "/a.csv", other, far + "/b.csv"}));
  EXPECT_NO_THROW(require_apart({"rod:n=5", file.path()}, {loop, folder / "fresh.csv"}));
}

/// As what is named: a topology that the reader finds, of files that have one.
TEST(OutputNames, AreApartFromWhatLiesBesideAnInput) {
  const TestFile file("a.conf", "");
  const std::filesystem::path folder = file.path().parent_path();
  const std::string conf = file.path(), packed = conf + ".gz", dat = folder / "a.dat", xyz = folder / "a.xyz",
                    top = folder / "a.top", other = folder / "b.top";
  for (const std::string& name : {top, other}) std::ofstream(name) << "2 1\n";
  for (const std::string& input : {conf, packed, dat}) {
    EXPECT_THROW(require_apart(input, {}, {other, top}), InputError) << input;
    EXPECT_NO_THROW(require_apart(input, {}, {other}));
    EXPECT_NO_THROW(require_apart(input, {.topology = other}, {top}));
    EXPECT_THROW(require_apart(input, {.topology = other}, {other}), InputError);
  }
  EXPECT_THROW(require_apart(xyz, {.format = "conf"}, {top}), InputError);
  EXPECT_NO_THROW(require_apart(xyz, {}, {top}));
  EXPECT_NO_THROW(require_apart("rod:n=5", {}, {top, conf}));
  EXPECT_THROW(require_apart(conf, {}, {conf}), InputError);
}

}  // namespace
}  // namespace catena
