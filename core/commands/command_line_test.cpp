#include "catena/core/commands/command_line.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "catena/core/commands/plan_options.h"
#include "catena/core/error.h"

/// What the parser says in words of its own: CLI11's are not for whoever types a command.
namespace catena {
namespace {

struct Values {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> sizes;
  double share = 0, length = 0;
  std::string file, order, input;
  std::vector<std::string> names, compared;
};

void configure(OptionParser& app, Values& v) {
  app.add_option("INPUT", v.input, "");
  app.add_option("--count", v.count, "").range(2u, 5000u);
  app.add_option("--n", v.sizes, "").allow_extra_args(false).range(8u, 100'000'000u);
  app.add_option("--share", v.share, "").range(-1e30, 1e30);
  app.add_option("--length", v.length, "").positive();
  app.add_option("--pairs", v.file, "");
  app.add_option("--variant", v.names, "").allow_extra_args(false);
  app.add_option("--order", v.order, "").one_of({"chain", "space"});
  app.add_option("--compare", v.compared, "").expected(2);
}

Values parsed(const std::vector<std::string>& arguments) {
  Values values;
  parse_options(arguments, [&](OptionParser& app) { configure(app, values); });
  return values;
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& why) {
    return why.what();
  }
  return "";
}
std::string refusal(const std::vector<std::string>& arguments) {
  return refusal([&] { parsed(arguments); });
}

TEST(CommandLine, TakesCountsAsPeopleWriteThem) {
  EXPECT_EQ(parsed({"--count", "1e3"}).count, 1000u);
  EXPECT_EQ(parsed({"--n", "1e3", "--n", "2.5e4"}).sizes, (std::vector<std::uint32_t>{1000, 25'000}));
  EXPECT_EQ(parsed({"--share", "-1e30"}).share, -1e30);
}

TEST(CommandLine, TakesBothEndsOfARange) {
  for (const std::uint32_t end : {2u, 5000u}) EXPECT_EQ(parsed({"--count", std::to_string(end)}).count, end);
  for (const std::string end : {"-1e30", "1e30"}) EXPECT_EQ(parsed({"--share", end}).share, std::stod(end));
}

TEST(CommandLine, SaysWhatANumberShouldHaveBeen) {
  EXPECT_EQ(refusal({"--count", "1"}), "--count: 1 is not a whole number from 2 to 5000");
  EXPECT_EQ(refusal({"--count", "1e4"}), "--count: 1e4 is not a whole number from 2 to 5000");
  EXPECT_EQ(refusal({"--count", "-2"}), "--count: -2 is not a whole number from 2 to 5000");
  EXPECT_EQ(refusal({"--n", "9", "--n", "8.5"}), "--n: 8.5 is not a whole number from 8 to 100000000");
  for (const std::string wrong : {"inf", "2e30"})
    EXPECT_EQ(refusal({"--share", wrong}), "--share: " + wrong + " is not a number from -1e+30 to 1e+30");
  for (const std::string wrong : {"nan", "wide", ""})
    EXPECT_EQ(refusal({"--share", wrong}), "--share: " + wrong + " is not a number");
  for (const std::string wrong : {"0", "-1", "inf"})
    EXPECT_EQ(refusal({"--length", wrong}), "--length: " + wrong + " is not a number above 0");
}

TEST(CommandLine, KnowsWhatWasMeant) {
  EXPECT_EQ(refusal({"--order", "spce"}), "--order: spce is none of chain, space; did you mean 'space'?");
  EXPECT_EQ(refusal({"--pair", "x"}), "there is no option --pair here; did you mean '--pairs'?");
  EXPECT_EQ(refusal({"--pair=x"}), "there is no option --pair here; did you mean '--pairs'?");
  EXPECT_EQ(refusal({"--json"}), "there is no option --json here");
}

/// No name of a file, and no value twice, of which one would be lost.
TEST(CommandLine, TakesNoOptionForAValueAndOneValueOfAnOption) {
  EXPECT_EQ(refusal({"--pairs", "--count"}),
            "--pairs: --count is an option and no value; ./--count is a file");
  EXPECT_NE(refusal({"--variant", "--count"}), "");
  EXPECT_EQ(parsed({"--pairs", "./--count"}).file, "./--count");
  EXPECT_EQ(parsed({"--pairs", "-"}).file, "-");
  EXPECT_EQ(parsed({"--", "--count"}).input, "--count");
  EXPECT_EQ(refusal({"--pairs", "a", "--pairs", "b"}), "--pairs is given 2 times, and takes one value");
  EXPECT_EQ(refusal({"--pairs"}), "--pairs lacks a value");
  EXPECT_EQ(refusal({"--pairs", ""}), "--pairs: '' is no value; give one, or leave the option out");
  EXPECT_EQ(refusal({"--pairs="}), "--pairs lacks a value");
  EXPECT_EQ(refusal({"--compare", "a"}), "--compare takes 2 values");
  EXPECT_EQ(refusal({"x", "-"}), "- is one argument too many");
  EXPECT_EQ(parsed({"--variant", "a", "--variant", "b"}).names, (std::vector<std::string>{"a", "b"}));
}

TEST(CommandLine, TakesEachOmissionBehindItsOwnOption) {
  const auto omitted = [](const std::vector<std::string>& arguments) {
    NoOmitOption option;
    parse_options(arguments, [&](OptionParser& app) { option.add_to(app); });
    return option.names();
  };
  EXPECT_EQ(omitted({"--no-omit", "hierarchy", "--no-omit", "exact"}),
            (std::vector<std::string>{"hierarchy", "exact"}));
  EXPECT_EQ(refusal([&] { omitted({"--no-omit", "hierarchy", "exact"}); }), "exact is one argument too many");
  EXPECT_NE(refusal([&] {
              omitted({"--no-omit", "exakt"});
            }).find("did you mean 'exact'?"),
            std::string::npos);
}

TEST(CommandLine, SaysOfACommandThatTheBuildLeavesItOut) {
  EXPECT_NO_THROW(refuse_left_out("report", ""));
  EXPECT_NO_THROW(refuse_left_out("port", "closed-form report"));
  try {
    refuse_left_out("report", "closed-form report");
    ADD_FAILURE();
  } catch (const InputError& why) {
    EXPECT_NE(std::string(why.what()).find("'report' is left out of this build (CATENA_BENCH=OFF)"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace catena
