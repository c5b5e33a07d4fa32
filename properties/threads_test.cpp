#include <gtest/gtest.h>

#include <algorithm>

#include "catena/properties/generators/family.h"
#include "catena/properties/suite.h"

namespace catena::properties {
namespace {

/// The property of that name, or null.
std::unique_ptr<Property> property_named(const std::string& name) {
  for (auto& property : PropertyRegistry::instance().make_all())
    if (property->name() == name) return std::move(property);
  return nullptr;
}

/// What ThreadSanitizer is to see of every host variant: several threads on one chain, and after them others.
TEST(Threads, AnyNumberGivesTheSameOnEveryFamily) {
  const auto property = property_named("any number of threads");
  ASSERT_NE(property, nullptr);
  auto subjects = Subject::available();
  std::erase_if(subjects, [&](const Subject& s) { return !property->applies_to(s); });
  EXPECT_GE(subjects.size(), 10u) << "variants that take a number of threads";
  for (const Subject& subject : subjects) {
    const auto variant = subject.make();
    std::uint64_t seed = 0;
    for (const Family& family : FamilyRegistry::instance().families()) {
      Dice dice(++seed);
      const Case test = Case::of(generate(family, dice, 48));
      const auto failure = property->check(subject, *variant, test);
      EXPECT_FALSE(failure) << subject.info.name << ", " << family.name << ": " << *failure;
    }
  }
}

}  // namespace
}  // namespace catena::properties
