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
  EXPECT_THROW(read_and_written({"--radius"}), InputError);
}

TEST(InputOptions, StandInACommand) {
  InputOptions options;
  read_input_options({"--closed", "--array", "a b", "--box", "none"}, options);
  EXPECT_EQ(in_command(options), " --closed --array 'a b' --box 'none'");
  EXPECT_EQ(in_command({}), "");
}

}  // namespace
}  // namespace catena
