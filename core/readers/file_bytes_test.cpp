#include "catena/core/readers/file_bytes.h"

#include <gtest/gtest.h>

#include <string>

namespace catena {
namespace {

/// What a file holds is said in one line that any terminal shows.
TEST(InQuotes, ShowFortyLettersAndNothingThatIsNone) {
  EXPECT_EQ(in_quotes(""), "''");
  EXPECT_EQ(in_quotes(std::string(40, 'a')), "'" + std::string(40, 'a') + "'");
  EXPECT_EQ(in_quotes(std::string(41, 'a')), "'" + std::string(40, 'a') + "...'");
  EXPECT_EQ(in_quotes("a\tb\n\x1f ~\x7f\xc3\xa9"), "'a?b?? ~??\?'");
}

}  // namespace
}  // namespace catena
