#include "catena/reports/report_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "catena/core/error.h"

namespace catena::reports {
namespace {

namespace fs = std::filesystem;

class ReportFolderTest : public testing::Test {
 protected:
  ReportFolderTest() : path_(fs::path(testing::TempDir()) / ("catena_report_" + std::to_string(getpid()))) {
    fs::remove_all(path_);
  }
  ~ReportFolderTest() override { fs::remove_all(path_); }

  /// As the page writer does.
  void report(const std::set<std::string>& files) const {
    std::ofstream list(path_ / ".catena-report", std::ios::app);
    list << "report\n";
    for (const auto& file : files) {
      list << file << '\n';
      fs::create_directories((path_ / file).parent_path());
      std::ofstream(path_ / file) << "content";
    }
  }
  std::set<std::string> files() const {
    std::set<std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(path_))
      if (!entry.is_directory() && entry.path().filename() != ".catena-report")
        all.insert(fs::relative(entry.path(), path_));
    return all;
  }
  const fs::path path_;
};

TEST_F(ReportFolderTest, IsHeldByOneReportAtATime) {
  {
    const ReportFolder first(path_);
    EXPECT_THROW(ReportFolder second(path_), InputError);
  }
  EXPECT_NO_THROW(ReportFolder third(path_));
}

/// Of a run that was refused nothing is left, and of others' folders all.
TEST_F(ReportFolderTest, IsGoneWhereItWasMadeAndNothingCameIntoIt) {
  { const ReportFolder refused(path_); }
  EXPECT_FALSE(fs::exists(path_));
  fs::create_directories(path_);
  { const ReportFolder refused(path_); }
  EXPECT_TRUE(fs::exists(path_)) << "it was there";
  fs::remove_all(path_);
  {
    const ReportFolder kept(path_);
    report({"run.json"});
  }
  EXPECT_EQ(files(), std::set<std::string>{"run.json"});
}

TEST_F(ReportFolderTest, LosesWhatAnEarlierReportLeftAndNothingElse) {
  ReportFolder folder(path_);
  report({"index.html", "run.json", "figures/old.svg", "tables/both.csv"});
  std::ofstream(path_ / "figures" / "mine.svg") << "by hand";
  report({"index.html", "run.json", "figures/new.svg", "tables/both.csv"});
  folder.remove_earlier();
  const std::set<std::string> expected{"index.html", "run.json", "figures/new.svg", "figures/mine.svg",
                                       "tables/both.csv"};
  EXPECT_EQ(files(), expected);
  folder.remove_earlier();
  EXPECT_EQ(files(), expected);
  folder.remove_reports();
  EXPECT_EQ(files(), std::set<std::string>{"figures/mine.svg"});
}

/// Which may be the only copy of what it measured.
TEST_F(ReportFolderTest, KeepsTheRunOfAnEarlierReportByTheFirstFreeName) {
  ReportFolder folder(path_);
  EXPECT_EQ(folder.keep_run(), "");
  std::ofstream(path_ / "run-2.json") << "mine";
  for (const char* const kept : {"run-1.json", "run-3.json"}) {
    report({"run.json"});
    EXPECT_EQ(folder.keep_run(), path_ / kept);
    folder.remove_reports();
    EXPECT_TRUE(fs::exists(path_ / kept));
    EXPECT_FALSE(fs::exists(folder.run_file()));
  }
  EXPECT_EQ(files(), (std::set<std::string>{"run-1.json", "run-2.json", "run-3.json"}));
  EXPECT_EQ(fs::file_size(path_ / "run-2.json"), 4u);
  fs::create_symlink("nowhere", path_ / "run-4.json");  // a name that is taken, too
  report({"run.json"});
  EXPECT_EQ(folder.keep_run(), path_ / "run-5.json");
}

TEST_F(ReportFolderTest, LeavesNoEmptyFolderAndKnowsItsOwnPage) {
  {
    ReportFolder folder(path_);
    report({"index.html", "figures/a.svg"});
  }
  ReportFolder again(path_);  // whose page a report is known to have written
  again.remove_reports();
  EXPECT_FALSE(fs::exists(path_ / "figures"));
  EXPECT_TRUE(files().empty());
}

TEST_F(ReportFolderTest, NeverRemovesOutsideOfIt) {
  ReportFolder folder(path_ / "below");
  std::ofstream(path_ / "mine") << "by hand";
  std::ofstream(path_ / "below" / ".catena-report") << "report\n../mine\nfigures/../../mine\n"
                                                    << (path_ / "mine").string() << '\n';
  folder.remove_reports();
  EXPECT_TRUE(fs::exists(path_ / "mine"));
}

TEST_F(ReportFolderTest, RefusesAPageOfSomebodyElse) {
  fs::create_directories(path_);
  std::ofstream(path_ / "index.html") << "a site";
  EXPECT_THROW(ReportFolder folder(path_), InputError);
  EXPECT_TRUE(fs::exists(path_ / "index.html"));
}

TEST_F(ReportFolderTest, SaysWhatCannotBeMade) { EXPECT_THROW(ReportFolder("/proc/nowhere"), InputError); }

}  // namespace
}  // namespace catena::reports
