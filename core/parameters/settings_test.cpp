#include "catena/core/parameters/settings.h"

#include <gtest/gtest.h>

#include "catena/core/error.h"

namespace catena {
namespace {

TEST(Settings, AreTakenApartAndPutTogetherAgain) {
  EXPECT_TRUE(parse_settings("x", "").empty());
  EXPECT_EQ(parse_settings("x", "a=1,b=,c=d=e"), (std::vector<Setting>{{"a", "1"}, {"b", ""}, {"c", "d=e"}}));
  for (const char* text : {"", "a=1", "a=1,b=", "c=d=e,a=1"})
    EXPECT_EQ(text_of(parse_settings("x", text)), text);
}

TEST(Settings, LackNothingBesideAComma) {
  for (const char* text : {",", "a=1,", ",a=1", "a=1,,b=2", "a=1, ", "a", "=1"})
    EXPECT_THROW(parse_settings("x", text), InputError) << text;
}

}  // namespace
}  // namespace catena
