#include "catena/core/parameters/parameters.h"

#include <gtest/gtest.h>

#include "catena/core/error.h"
#include "catena/core/parameters/nearest_name.h"
#include "catena/core/parameters/whole_number.h"

namespace catena {
namespace {

TEST(WholeNumber, TakesDigitsAndExponents) {
  EXPECT_EQ(whole_number("0"), 0u);
  EXPECT_EQ(whole_number("18446744073709551615"), ~std::uint64_t{0});
  EXPECT_EQ(whole_number("1e6"), 1'000'000u);
  EXPECT_EQ(whole_number("2.5e5"), 250'000u);
  EXPECT_EQ(whole_number("1E+3"), 1000u);
  for (const char* none :
       {"", "-1", "-1e3", "1.5", "1e-3", "18446744073709551616", "1e30", "nan", "inf", "1e6x", " 1"})
    EXPECT_FALSE(whole_number(none)) << none;
}

TEST(Parameters, ReadWholeNumbersAsTheyAreWritten) {
  const std::vector<ParameterInfo> declared{{"n", "10", "number"}};
  EXPECT_EQ(Parameters("scene x", declared, "n=1e6").unsigned_integer("n", 0, 2'000'000), 1'000'000u);
  EXPECT_THROW(Parameters("scene x", declared, "n=1e7").unsigned_integer("n", 0, 2'000'000), InputError);
  EXPECT_THROW(Parameters("scene x", declared, "n=0.5").unsigned_integer("n", 0, 2'000'000), InputError);
}

TEST(Parameters, ReadNumbersWithinTheirRange) {
  const std::vector<ParameterInfo> declared{{"x", "1", "number"}};
  const auto read = [&](const std::string& text) {
    return Parameters("scene x", declared, "x=" + text).real("x", -1, 2.5);
  };
  EXPECT_EQ(read("-1"), -1);
  EXPECT_EQ(read("2.5"), 2.5);
  for (const char* wrong : {"2.5000001", "3", "-1.0000001", "nan", "inf", "1x", "", " 1"})
    EXPECT_THROW(read(wrong), InputError) << wrong;
}

TEST(Parameters, AreGivenOnceAndKnowThatTheyWere) {
  const std::vector<ParameterInfo> declared{{"x", "1", "number"}, {"y", "2", "number"}};
  const Parameters some("scene x", declared, "y=1");
  EXPECT_TRUE(some.given("y"));
  EXPECT_FALSE(some.given("x")) << "its default";
  for (const char* twice : {"x=1,x=2", "x=1,x=1", "y=3,x=1,y=3"})
    EXPECT_THROW(Parameters("scene x", declared, twice), InputError) << twice;
}

TEST(Parameters, ReadSeveralChoices) {
  const std::vector<ParameterInfo> declared{{"keep", "none", "some"}};
  const auto read = [&](const std::string& text) {
    return Parameters("auto", declared, text).choices("keep", {"tree", "list"});
  };
  EXPECT_EQ(read(""), std::vector<std::string>{});
  EXPECT_EQ(read("keep=list"), std::vector<std::string>{"list"});
  EXPECT_EQ(read("keep=list+tree"), (std::vector<std::string>{"list", "tree"}));
  for (const char* wrong : {"keep=", "keep=x", "keep=tree+x", "keep=+tree", "keep=tree+", "keep=tree++list"})
    EXPECT_THROW(read(wrong), InputError) << wrong;
}

TEST(Parameters, SayWhatIsWrong) {
  const std::vector<ParameterInfo> declared{{"x", "1", "number"}, {"kind", "a", "which"}};
  const auto refusal = [](const auto& work) {
    try {
      work();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto made = [&](const std::string& text, const std::vector<ParameterInfo>& known) {
    return refusal([&] { Parameters("scene x", known, text); });
  };
  for (const char* text : {"x=1,", ",x=1", "x=1,,kind=b"})
    EXPECT_EQ(made(text, declared), "scene x: a comma has no key=value on one side of it") << text;
  for (const std::string text : {"=1", "=", "x"})
    EXPECT_EQ(made(text, declared), "scene x: '" + text + "' is not key=value");
  EXPECT_EQ(made("y=1", {}), "scene x takes no parameters, got 'y'");
  EXPECT_EQ(made("y=1", declared), "scene x has no parameter 'y'; it has: x, kind");
  const Parameters wrong("scene x", declared, "x=9,kind=b");
  EXPECT_EQ(refusal([&] { wrong.real("x", 0, 2); }), "scene x: x=9 must be a number from 0 to 2");
  EXPECT_EQ(refusal([&] { wrong.choice("kind", {"a", "c"}); }), "scene x: kind=b must be one of: a, c");
  EXPECT_EQ(wrong.choice("kind", {"a", "b"}), "b");
  const Parameters slip("scene x", declared, "x=lits,kind=hlaf");
  EXPECT_EQ(refusal([&] {
              slip.choice("kind", {"all", "half"});
            }),
            "scene x: kind=hlaf must be one of: all, half; did you mean 'half'?");
  EXPECT_EQ(refusal([&] {
              slip.choices("x", {"tree", "list"});
            }),
            "scene x: x=lits must be none, or of these, joined by '+': tree, list; did you mean 'list'?");
}

TEST(DidYouMean, KnowsASlipOfThePen) {
  const std::vector<std::string> known{"path1", "path2", "yarn", "lattice", "aCPU2+CPU2", "CPU1"};
  EXPECT_EQ(did_you_mean("pth1", known), "; did you mean 'path1'?");
  EXPECT_EQ(did_you_mean("lattcie", known), "; did you mean 'lattice'?");
  EXPECT_EQ(did_you_mean("cpu1", known), "; did you mean 'CPU1'?");
  EXPECT_EQ(did_you_mean("ACPU2+CPU3", known), "; did you mean 'aCPU2+CPU2'?");
  EXPECT_EQ(did_you_mean("yran", known),
            "; did you mean 'yarn'?");  // a swap is one slip, and in four letters two are another name
  for (const char* far : {"ybrm", "", "x", "yes", "nothing alike", "knot"})
    EXPECT_EQ(did_you_mean(far, known), "") << far;
}

}  // namespace
}  // namespace catena
