#include "catena/core/commands/input_options.h"

#include <gtest/gtest.h>

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

TEST(InputOptions, StandInACommand) {
  InputOptions options;
  read_input_options({"--closed", "--array", "a b", "--box", "none"}, options);
  EXPECT_EQ(in_command(options), " --closed --array 'a b' --box none");
  EXPECT_EQ(in_command({}), "");
}

}  // namespace
}  // namespace catena
