#include "catena/core/commands/command.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace catena {
namespace {

TEST(CommandRegistry, RefusesASecondOfOneName) {
  CommandRegistry registry;
  registry.add({"find", "finds", nullptr, false});
  registry.add({"find", "finds by ranks", nullptr, true});
  registry.add({"look", "looks", nullptr, false});
  EXPECT_THROW(registry.add({"find", "finds otherwise", nullptr, false}), std::logic_error);
  EXPECT_THROW(registry.add({"find", "finds otherwise", nullptr, true}), std::logic_error);
  EXPECT_EQ(registry.commands().size(), 2u);
}

}  // namespace
}  // namespace catena
