#pragma once
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "catena/core/readers/chain_format.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/generators/simplifications.h"
#include "catena/properties/giants.h"
#include "catena/properties/suite.h"

namespace catena::properties {

/// Every property holds for the variant of that name on so many chains of each family, and on the giants; a
/// failure shows the shrunk chain.
inline void expect_every_property(const std::string& variant, std::uint64_t seed, std::uint32_t rounds) {
  Suite suite({Subject::named(variant)});
  for (const Family& family : FamilyRegistry::instance().families())
    for (std::uint32_t round = 0; round < rounds; ++round) {
      Dice dice(++seed);
      const Case test = Case::of(generate(family, dice, family.name == "sizes" && round == 0 ? 2400 : 48));
      const auto finding = suite.check(test);
      if (!finding) continue;
      std::ostringstream text;
      write_chain(text, shrink(test.chain, [&](const Chain& c) { return suite.repeats(*finding, c); }));
      FAIL() << family.name << ", seed " << seed << ": " << finding->property << ": " << finding->what << '\n'
             << text.str();
    }
  for (const Case& giant : giants())
    if (const auto finding = suite.check_always(giant)) FAIL() << finding->property << ": " << finding->what;
}

}  // namespace catena::properties
