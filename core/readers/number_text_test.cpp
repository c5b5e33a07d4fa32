#include "catena/core/readers/number_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

namespace catena {
namespace {

TEST(NumberText, TakesTheUsualForms) {
  EXPECT_EQ(parse_float("1").value, 1.0f);
  EXPECT_EQ(parse_float("+1.5").value, 1.5f);
  EXPECT_EQ(parse_float("-.5e+1").value, -5.0f);
  EXPECT_EQ(parse_float("1.").value, 1.0f);
  EXPECT_TRUE(std::signbit(parse_float("-0").value));
}

TEST(NumberText, TakesTheExponentsOfFortran) {
  EXPECT_EQ(parse_float("1.5D+01").value, 15.0f);
  EXPECT_EQ(parse_double("-.25d-1").value, -0.025);
  EXPECT_EQ(parse_coordinate("+1D0").value, 1.0);
  EXPECT_EQ(parse_double("1D999").problem, "is too large for a 64-bit float");
  for (const char* text : {"D5", "1D", "1D+", "1DD5", "1E5D5", "1D5E5", "1D5x", "nanD5", "-D1"})
    EXPECT_EQ(parse_double(text).problem, "is not a number") << text;
}

TEST(NumberText, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"", "+", "-", "+-1", "++1", "1x", " 1", "1 ", "0x10", "1,5", "e5"})
    EXPECT_EQ(parse_float(text).problem, "is not a number") << text;
  for (const char* text : {"nan", "NaN", "-nan", "inf", "+INF", "infinity"})
    EXPECT_EQ(parse_float(text).problem, "is not a finite number") << text;
}

TEST(NumberText, TellsTooLargeFromTooSmall) {
  for (const char* text : {"1e39", "-3.5e38", "1e400", "1e99999999999999999999", "3.4028236e38"})
    EXPECT_EQ(parse_float(text).problem, "is too large for a 32-bit float") << text;
  for (const char* text :
       {"1e-60", "1e-400", "-1e-400", "-1e-99999999999999999999", "0e9999", "0e999999999999999999999"}) {
    EXPECT_EQ(parse_float(text).problem, "") << text;
    EXPECT_EQ(parse_float(text).value, 0.0f) << text;
    EXPECT_EQ(std::signbit(parse_float(text).value), text[0] == '-') << text;
  }
  EXPECT_EQ(parse_float("0." + std::string(500, '0') + "1").value, 0.0f);
  EXPECT_EQ(parse_float("0." + std::string(500, '0') + "1").problem, "");
  EXPECT_EQ(parse_float("1" + std::string(500, '0') + "e-10").problem, "is too large for a 32-bit float");
  EXPECT_EQ(parse_float("1" + std::string(500, '0') + "e-500").value, 1.0f);
  EXPECT_EQ(parse_float("3.4028235e38").value, std::numeric_limits<float>::max());
}

TEST(NumberText, KnowsZeroFromWhatReadsAsZero) {
  for (const char* text : {"0", "-0", "+0.00", ".0", "0.e9", "0D5"}) EXPECT_TRUE(is_zero(text)) << text;
  for (const char* text : {"1e-50", "0.01", "-1e-400", "2D-99", "", "x", "e5"})
    EXPECT_FALSE(is_zero(text)) << text;
}

TEST(NumberText, KnowsIntegers) {
  EXPECT_EQ(parse_integer("+12").value, 12);
  EXPECT_EQ(parse_integer("12.0").problem, "is not a whole number");
  EXPECT_EQ(parse_integer("99999999999999999999").problem, "is too large for a 64-bit integer");
  EXPECT_TRUE(is_integer("-7"));
  EXPECT_FALSE(is_integer("7e0"));
  EXPECT_FALSE(is_integer("-"));
}

RC_GTEST_PROP(NumberText, ReadsTheShortestTextOfEveryFloatBitForBit, (std::uint32_t bits)) {
  const float value = std::bit_cast<float>(bits);
  RC_PRE(std::isfinite(value));
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  const auto parsed = parse_float(std::string_view(text, end));
  RC_ASSERT(parsed.problem == "");
  RC_ASSERT(std::bit_cast<std::uint32_t>(parsed.value) == bits);
}

// Rounded once more, the double must be the float that the text is nearest to: also beside the middle of two.
RC_GTEST_PROP(NumberText, ACoordinateRoundsToTheNearestFloat, ()) {
  const float low = *rc::gen::suchThat(
      rc::gen::map(rc::gen::arbitrary<std::uint32_t>(),
                   [](std::uint32_t b) { return std::bit_cast<float>(b); }),
      [](float value) { return std::isfinite(value) && std::isfinite(std::nextafter(value, HUGE_VALF)); });
  const double middle = (double{low} + double{std::nextafter(low, HUGE_VALF)}) / 2;
  std::string text = fmt::format("{:.780f}", middle);
  text.back() = *rc::gen::elementOf(std::string("0129"));  // beyond the last digit of any such double
  if (*rc::gen::arbitrary<bool>()) text.pop_back(), text += "1";
  const auto nearest = parse_float(text);
  const auto wide = parse_coordinate(text);
  RC_ASSERT(nearest.problem == wide.problem);
  RC_ASSERT(std::bit_cast<std::uint32_t>(static_cast<float>(wide.value)) ==
            std::bit_cast<std::uint32_t>(nearest.value));
}

}  // namespace
}  // namespace catena
