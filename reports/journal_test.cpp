#include "catena/reports/journal.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "catena/core/error.h"

namespace catena::reports {
namespace {

using Json = Journal::Json;

class JournalTest : public testing::Test {
 protected:
  ~JournalTest() override { std::filesystem::remove(file_); }
  static Json measured_again() { throw std::logic_error("measured again"); }
  const std::string file_ = testing::TempDir() + "catena_journal_" + std::to_string(getpid());
};

TEST_F(JournalTest, KeepsWhatWasMeasured) {
  {
    Journal journal = Journal::begin(file_, {{"seed", 3}});
    EXPECT_TRUE(journal.empty());
    EXPECT_EQ(journal.section("counts", [] { return Json{{"n", 5}}; }), (Json{{"n", 5}}));
    journal.section("none", [] { return Json(); });
    journal.keep_row({{"name", "a"}}, 1);
    journal.keep_row({{"name", "b"}}, 2.5);
  }
  Journal journal = Journal::resume(file_);
  EXPECT_EQ(journal.run(), (Json{{"seed", 3}}));
  EXPECT_EQ(journal.rows(), (Json{{{"name", "a"}}, {{"name", "b"}}}));
  EXPECT_EQ(journal.row_seconds(), 2.5);
  EXPECT_EQ(journal.section("counts", measured_again), (Json{{"n", 5}}));
  EXPECT_EQ(journal.section("none", measured_again), Json());
  EXPECT_THROW(journal.section("new", measured_again), std::logic_error);
  EXPECT_FALSE(journal.empty());
  journal.keep_row({{"name", "c"}}, 1);
  EXPECT_EQ(Journal::resume(file_).row_seconds(), 3.5);
  journal.remove();
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(JournalTest, GoesOnBehindALineThatWasCutOff) {
  Journal::begin(file_, {{"seed", 3}}).keep_row({{"name", "a"}}, 1);
  std::ofstream(file_, std::ios::app) << R"({"row": {"name": "b")";
  Journal::resume(file_).keep_row({{"name", "c"}}, 1);
  EXPECT_EQ(Journal::resume(file_).rows(), (Json{{{"name", "a"}}, {{"name", "c"}}}));
}

/// The end of a line may look whole, as the number 12 of 123 does; and what follows a damaged one is not
/// believed.
TEST_F(JournalTest, BelievesOnlyLinesThatEndAndOnlyToTheFirstThatIsNone) {
  Journal::begin(file_, {{"seed", 3}}).keep_row({{"name", "a"}}, 1);
  std::ofstream(file_, std::ios::app) << R"({"row":{"name":"b"},"seconds":12})";
  EXPECT_EQ(Journal::resume(file_).rows().size(), 1u);
  std::ofstream(file_, std::ios::app) << "{\"row\":\n"
                                      << R"({"row":{"name":"c"},"seconds":3})" << '\n';
  EXPECT_EQ(Journal::resume(file_).rows().size(), 1u);
  Journal::resume(file_).keep_row({{"name", "d"}}, 1);
  EXPECT_EQ(Journal::resume(file_).rows(), (Json{{{"name", "a"}}, {{"name", "d"}}}));
}

TEST_F(JournalTest, OfSectionsAloneIsNotEmpty) {
  {
    Journal journal = Journal::begin(file_, {{"seed", 3}});
    journal.section("counts", [] { return usleep(3000), Json{{"n", 5}}; });
    EXPECT_FALSE(journal.empty());
    journal.section("steps", [] { return usleep(2000), Json{{"n", 6}}; });
  }
  const Journal journal = Journal::resume(file_);
  EXPECT_FALSE(journal.empty());
  EXPECT_GE(journal.section_seconds(), 0.005) << "of both";
  EXPECT_EQ(journal.row_seconds(), 0);
}

TEST_F(JournalTest, SaysWhenALineDoesNotFit) {
  Journal journal = Journal::begin(file_, {{"seed", 3}});
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{std::filesystem::file_size(file_) + 5, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::string said;
  try {
    journal.keep_row({{"name", "a"}}, 1);
  } catch (const InputError& why) {
    said = why.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_TRUE(said.ends_with("File too large")) << said;
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(Journal::resume(file_).rows().empty()) << "what fitted is no line";
}

TEST_F(JournalTest, IsNotOverwritten) {
  Journal::begin(file_, {{"seed", 3}}).keep_row({{"name", "a"}}, 1);
  EXPECT_THROW(Journal::begin(file_, {{"seed", 4}}), InputError);
  EXPECT_EQ(Journal::resume(file_).rows().size(), 1u);
}

TEST_F(JournalTest, RefusesWhatIsNone) {
  EXPECT_THROW(Journal::resume(file_), InputError);
  std::ofstream(file_) << "no journal\n";
  EXPECT_THROW(Journal::resume(file_), InputError);
  for (const char* line :
       {R"({"row": {}})", R"({"row": {}, "seconds": "1"})", R"({"section": "a", "content": 1})",
        R"({"section": "a", "seconds": 1})", R"({"section": 1, "content": 1, "seconds": 1})"}) {
    std::ofstream(file_) << "{\"run\": {}}\n" << line << "\n";
    EXPECT_THROW(Journal::resume(file_), InputError) << line;
  }
  EXPECT_THROW(Journal::begin("/nowhere/run.journal", Json::object()), InputError);
}

TEST_F(JournalTest, OfNobodyKeepsNothing) {
  Journal journal;
  EXPECT_EQ(journal.section("counts", [] { return Json{1}; }), Json{1});
  journal.keep_row({{"name", "a"}}, 1);
  journal.remove();
}

}  // namespace
}  // namespace catena::reports
