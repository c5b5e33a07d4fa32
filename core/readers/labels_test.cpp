#include "catena/core/readers/labels.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
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
void keeps_all_and_chosen(const std::vector<Label>& all) {
  const Labels labels = labels_of(all);
  RC_ASSERT(labels.size() == all.size());
  const auto n = static_cast<std::uint32_t>(all.size());
  for (std::uint32_t i = 0; i < n; ++i) RC_ASSERT(labels.of(i) == text(all[i]));
  if (n == 0) return;
  const auto some = *rc::gen::container<std::vector<std::uint32_t>>(rc::gen::inRange(0u, n));
  const Labels chosen = labels.chosen(some);
  RC_ASSERT(chosen.size() == some.size());
  for (std::uint32_t i = 0; i < some.size(); ++i) RC_ASSERT(chosen.of(i) == text(all[some[i]]));
}

// Few numbers, so that runs of consecutive ones are common.
RC_GTEST_PROP(Labels, GiveEveryNumberBack, ()) {
  constexpr auto least = std::numeric_limits<std::int64_t>::min(),
                 most = std::numeric_limits<std::int64_t>::max();
  const auto near_ends = rc::gen::element(least, least + 1, most - 1, most);
  keeps_all_and_chosen(*rc::gen::container<std::vector<std::int64_t>>(
      rc::gen::oneOf(rc::gen::inRange<std::int64_t>(-3, 6), near_ends)));
}

RC_GTEST_PROP(Labels, GiveEveryTextBack, ()) {
  keeps_all_and_chosen(*rc::gen::arbitrary<std::vector<std::string>>());
}

// Lengths of one, two and three bytes, on both sides of where blocks begin.
TEST(Labels, GiveLongTextsBack) {
  std::vector<std::string> all;
  for (const std::size_t length : {0u, 1u, 127u, 128u, 129u, 16383u, 16384u, 20000u})
    for (int k = 0; k < 5; ++k) all.emplace_back(length, static_cast<char>('a' + k));
  const Labels labels = labels_of(all);
  for (std::uint32_t i = 0; i < all.size(); ++i) EXPECT_EQ(labels.of(i), all[i]);
}

TEST(Labels, AreTheNumbersOfTheSpheresWhereThereAreNone) {
  EXPECT_EQ(Labels().of(0), "0");
  EXPECT_EQ(Labels().of(4000000000u), "4000000000");
  EXPECT_EQ(Labels().size(), 0u);
}

TEST(Labels, SurelyDifferInWhateverOrder) {
  EXPECT_TRUE(Labels().surely_differ());
  using All = std::vector<std::int64_t>;
  constexpr auto least = std::numeric_limits<std::int64_t>::min(),
                 most = std::numeric_limits<std::int64_t>::max();
  for (const All& all : {All{3, 2, 1}, All{7, 8, 1, 2}, All{5, 9, 6}, All{most - 1, most, least, 3}})
    EXPECT_TRUE(labels_of(all).surely_differ());
  for (const All& all :
       {All{3, 3}, All{7, 8, 1, 8}, All{5, 6, 7, 1, 2, 3, 4, 5}, All{most - 1, most, least, most}})
    EXPECT_FALSE(labels_of(all).surely_differ());
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
