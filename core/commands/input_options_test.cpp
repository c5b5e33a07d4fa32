#include "catena/core/commands/input_options.h"

#include <gtest/gtest.h>

#include "catena/core/commands/command.h"
#include "catena/core/commands/command_line.h"
#include "catena/core/error.h"

namespace catena {
namespace {

using Arguments = std::vector<std::string>;

Arguments read_and_written(const Arguments& arguments) {
  InputOptions options{.takes_box = true};
  read_input_options(arguments, options);
  return arguments_of(options);
}

TEST(InputOptions, AreWrittenAsTheyAreRead) {
  for (const Arguments& arguments :
       {Arguments{}, Arguments{"--radius", "0.1", "--closed", "--window", "3", "--box", "8,0,0.1,1e-05,0,-2"},
        Arguments{"--radius", "half-spacing", "--arc-window", "1.5707963267948966", "--box", "file"},
        Arguments{"--columns", "x,y,_,z", "--atom", "CB", "--recentre", "--format", "csv", "--box", "none"},
        Arguments{"--origin", "1,0.1,3", "--array", "a b", "--topology", "x.top", "--box",
                  "3,0.30000000000000004,7"}})
    EXPECT_EQ(read_and_written(arguments), arguments);
  EXPECT_EQ(read_and_written({"--arc-window", "pi/2", "--box", "1,2,3,0,0,0"}),
            (Arguments{"--arc-window", "1.5707963267948966", "--box", "1,2,3"}));
  EXPECT_EQ(read_and_written({"--radius", "0"}), (Arguments{"--radius", "0"})) << "of points";
  EXPECT_THROW(read_and_written({"--radius"}), InputError);
}

TEST(InputOptions, AreRefusedWhereTheySayTooMuchOrTooLittle) {
  for (const auto& [option, wrong] : std::vector<std::pair<std::string, Arguments>>{
           {"--radius", {"-1", "inf", "nan", "1e39", "1x", "", "half"}},
           {"--arc-window", {"0", "-1", "inf", "nan", "pi/0", "pi/-2", "pi/", "2*pi", "", "1e999"}},
           {"--origin", {"1,2", "1,2,3,4", "1,2,x", "1,,3", "", "1,2,3,"}},
           {"--box",
            {"1,2", "1,2,3,4", "1,2,3,4,5", "1,2,3,4,5,6,7", "1,2,3,4,5,6,", "1,2,x", "", "File",
             "1,inf,3"}}})
    for (const std::string& text : wrong)
      EXPECT_THROW(read_and_written({option + "=" + text}), InputError) << option << " " << text;
}

/// As every option that is a number has it, within bounds or without.
TEST(CommandLine, RefusesWhatIsNotANumber) {
  double bounded = 3, positive = 3, any = 3;
  std::vector<double> several;
  const auto parse = [&](const std::string& option, const std::string& text) {
    parse_options({option, text}, [&](OptionParser& parser) {
      parser.add_option("--bounded", bounded, "").range(1e-3, 1e6);
      parser.add_option("--positive", positive, "").positive();
      parser.add_option("--any", any, "");
      parser.add_option("--several", several, "").delimiter(',');
    });
  };
  for (const std::string option : {"--bounded", "--positive", "--any", "--several"}) {
    for (const std::string nan : {"nan", "NaN", "-nan"}) {
      std::string said;
      try {
        parse(option, nan);
      } catch (const InputError& error) {
        said = error.what();
      }
      EXPECT_EQ(said, option + ": " + nan + " is not a number");
    }
    EXPECT_NO_THROW(parse(option, "0.5")) << option;
  }
  EXPECT_THROW(parse("--several", "1,nan"), InputError);
  EXPECT_EQ((std::vector{bounded, positive, any}), (std::vector{0.5, 0.5, 0.5}));
}

TEST(InputOptions, StandInACommand) {
  InputOptions options;
  read_input_options({"--closed", "--array", "a b", "--box", "none"}, options);
  EXPECT_EQ(in_command(options), " --closed --array 'a b' --box none");
  EXPECT_EQ(in_command({}), "");
}

}  // namespace
}  // namespace catena
