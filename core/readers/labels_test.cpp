#include "catena/core/readers/labels.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <stdexcept>

namespace catena {
namespace {

template <class Label>
Labels labels_of(const std::vector<Label>& all) {
  Labels labels;
  for (const Label& label : all) labels.add(label);
  return labels;
}

std::string text(std::int64_t number) { return std::to_string(number); }
std::string text(const std::string& letters) { return letters; }

template <class Label>
void keeps_and_drops(const std::vector<Label>& all) {
  const Labels labels = labels_of(all);
  RC_ASSERT(labels.size() == all.size());
  std::vector<std::uint32_t> dropped;
  std::vector<Label> kept;
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    RC_ASSERT(labels.of(i) == text(all[i]));
    if (*rc::gen::arbitrary<bool>())
      dropped.push_back(i);
    else
      kept.push_back(all[i]);
  }
  const Labels rest = labels.without(dropped);
  RC_ASSERT(rest.size() == kept.size());
  for (std::uint32_t i = 0; i < kept.size(); ++i) RC_ASSERT(rest.of(i) == text(kept[i]));
}

// Few numbers, so that runs of consecutive ones are common.
RC_GTEST_PROP(Labels, GiveEveryNumberBack, ()) {
  keeps_and_drops(*rc::gen::container<std::vector<std::int64_t>>(rc::gen::inRange<std::int64_t>(-3, 6)));
}

RC_GTEST_PROP(Labels, GiveEveryTextBack, ()) {
  keeps_and_drops(*rc::gen::arbitrary<std::vector<std::string>>());
}

TEST(Labels, AreTheNumbersOfTheSpheresWhereThereAreNone) {
  EXPECT_EQ(Labels().of(0), "0");
  EXPECT_EQ(Labels().of(4000000000u), "4000000000");
  EXPECT_EQ(Labels().size(), 0u);
}

TEST(Labels, RefuseWhatTheyCannotSay) {
  Labels numbers, texts;
  numbers.add(7);
  texts.add("A/MSE1/CA");
  EXPECT_THROW(numbers.add("A"), std::logic_error);
  EXPECT_THROW(texts.add(7), std::logic_error);
  EXPECT_THROW(numbers.of(1), std::out_of_range);
}

}  // namespace
}  // namespace catena
