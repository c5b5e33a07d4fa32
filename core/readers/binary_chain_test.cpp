#include "catena/core/readers/binary_chain.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>

#include "catena/core/readers/test_file.h"
#include "catena/core/writers/writer.h"
#include "catena/properties/generators/family.h"

namespace catena {
namespace {

std::string bytes_of(const Chain& chain) {
  const TestFile file("a.catena", "");
  WriterRegistry::instance()
      .of(file.path())
      .write(file.path(), {0, 1, [&](std::uint32_t) { return ExportedFrame{chain}; }, Labels()});
  std::ifstream in(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

BinaryChain opened(const std::string& bytes) {
  return BinaryChain("a.catena", bytes.size(), [&bytes](std::uint64_t at, std::span<std::byte> part) {
    ASSERT_LE(at + part.size(), bytes.size());
    std::memcpy(part.data(), bytes.data() + at, part.size());
  });
}

void for_each_chain(const std::function<void(const Chain&, properties::Dice&)>& body) {
  std::uint64_t seed = 0;
  for (const char* family : {"strands", "closed", "arcs", "joints", "rules"})
    for (int round = 0; round < 8; ++round) {
      properties::Dice dice(++seed);
      const Chain chain = generate(properties::FamilyRegistry::instance().family(family), dice, 24);
      SCOPED_TRACE(std::string(family) + ", seed " + std::to_string(seed));
      body(chain, dice);
    }
}

/// What a rank asks for, by its definition: any sphere's strand, and the extra pairs of any range.
TEST(BinaryChain, GivesAnyPartOfItsArrays) {
  std::uint64_t extra = 0, strands = 0;
  for_each_chain([&](const Chain& chain, properties::Dice& dice) {
    const std::string bytes = bytes_of(chain);
    const BinaryChain file = opened(bytes);
    ASSERT_EQ(file.header().spheres, chain.size());
    ASSERT_EQ(file.header().strands, chain.strand_count());
    EXPECT_EQ(file.header().window, chain.exclusion().window);
    const auto& first = chain.strands().first;
    for (std::uint32_t i = 0; i < chain.size(); ++i) {
      std::uint32_t last = 0;
      for (std::uint32_t s = 0; s < chain.strand_count(); ++s)
        if (first[s] <= i) last = s;
      EXPECT_EQ(file.strand_of(i), last);
    }
    for (std::uint32_t s = 0; s < chain.strand_count(); ++s) {
      EXPECT_EQ(file.strand(s).strand.first, first[s]);
      EXPECT_EQ(file.strand(s).end, first[s + 1]);
      EXPECT_EQ(file.strand(s).strand.closed, chain.strands().closed[s]);
    }
    const std::uint32_t begin = dice.below(chain.size() + 1),
                        end = begin + dice.below(chain.size() - begin + 1);
    std::vector<Pair> mine, found;
    for (const Pair& pair : chain.exclusion().extra_pairs)
      if (pair.i >= begin && pair.i < end) mine.push_back(pair);
    for (const auto& [i, j] : file.pairs(begin, end))
      found.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
    EXPECT_EQ(found, mine);
    std::vector<std::uint64_t> of_range, visited;
    for (std::uint32_t s = 0; s < chain.strand_count(); ++s)
      if (begin < end && first[s] < first[s + 1] && first[s] < end && first[s + 1] > begin)
        of_range.push_back(s);
    file.for_each_strand(begin, end, [&](std::uint64_t number, const BinaryChain::Extent& extent) {
      EXPECT_EQ(extent.strand.first, first[number]);
      EXPECT_EQ(extent.end, first[number + 1]);
      visited.push_back(number);
    });
    EXPECT_EQ(visited, of_range);
    extra += mine.size(), strands += chain.strand_count() > 2;
  });
  EXPECT_GT(extra, 2u);
  EXPECT_GT(strands, 2u);
}

TEST(BinaryChain, ReadsMillionsOfStrandsInFewReads) {
  constexpr std::uint32_t strands = 300'000;
  Strands pairs;
  pairs.first.clear();
  for (std::uint32_t s = 0; s <= strands; ++s) pairs.first.push_back(2 * s);
  pairs.closed.assign(strands, 0);
  const std::string bytes = bytes_of(Chain(std::vector<Sphere>(2 * strands), pairs, {}));
  int reads = 0;
  const BinaryChain file("pairs.catena", bytes.size(), [&](std::uint64_t at, std::span<std::byte> part) {
    std::memcpy(part.data(), bytes.data() + at, part.size());
    ++reads;
  });
  std::uint64_t next = 7;
  file.for_each_strand(15, 2 * strands - 9,
                       [&](std::uint64_t number, const auto&) { EXPECT_EQ(number, next++); });
  EXPECT_EQ(next, strands - 4);
  EXPECT_LT(reads, 60);
}

/// A reader measures the spheres that are written; those of a moved frame are not the ones that its rule was
/// measured on.
TEST(BinaryChain, HoldsTheArcsOfTheSpheresThatItHolds) {
  int closed = 0;
  for_each_chain([&](const Chain& drawn, properties::Dice& dice) {
    const Chain rest({drawn.spheres().begin(), drawn.spheres().end()}, drawn.strands(), Exclusion::arc(1.5));
    std::vector<Sphere> spheres(rest.spheres().begin(), rest.spheres().end());
    for (Sphere& s : spheres) s.x = dice.symmetric(), s.y = dice.symmetric();
    const Chain measured(spheres, rest.strands(), rest.exclusion());
    const std::string bytes = bytes_of(rest.moved(spheres));
    const BinaryChain file = opened(bytes);
    const ExclusionView view = measured.view().exclusion;
    EXPECT_EQ(file.arcs(0, measured.size()), std::vector<double>(view.arc, view.arc + measured.size()));
    for (std::uint32_t s = 0; s < measured.strand_count(); ++s) {
      const bool loop = measured.strands().closed[s] != 0;
      EXPECT_EQ(file.strand(s).strand.loop_length, loop ? view.loop_length[s] : 0);
      closed += loop && view.loop_length[s] > 0;
    }
  });
  EXPECT_GT(closed, 5);
}

TEST(BinaryChain, RefusesAPairThatIsNoneOfItsSpheres) {
  const Chain chain(std::vector<Sphere>(5), {}, {Exclusion::Rule::index_window, 1, 0, {Pair{1, 3}}});
  const std::string bytes = bytes_of(chain);
  const std::size_t at = bytes.size() - sizeof(BinaryChain::Neighbours);
  for (const BinaryChain::Neighbours pair : {BinaryChain::Neighbours{1, 4}, {1, 1}, {1, 0}, {1, 5}, {5, 6}}) {
    std::string changed = bytes;
    std::memcpy(changed.data() + at, &pair, sizeof pair);
    const auto read = [&] { return opened(changed).pairs(0, 6).size(); };
    if (pair.i < pair.j && pair.j < 5)
      EXPECT_EQ(read(), 1u);
    else
      EXPECT_THROW(read(), InputError) << pair.i << ' ' << pair.j;
  }
}

/// What a reader of all of it says, after these bytes came over those at `at`; "" where nothing is wrong.
template <class Value>
std::string said_of(std::string bytes, std::size_t at, const Value& value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
  try {
    const BinaryChain file = opened(bytes);
    const auto& header = file.header();
    for (std::uint64_t k = 0; k < header.strands; ++k) file.strand(k);
    file.spheres(2, header.spheres);
    file.pairs(2, header.spheres);
    if (header.rule == 1) file.arcs(2, header.spheres);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(BinaryChain, SaysOfEachNumberWhatNoChainHas) {
  const std::vector<Sphere> spheres(6, Sphere{1, 2, 3, 4});
  const Strands strands{{0, 2, 4, 6}, {0, 1, 0}};
  const std::string arcs = bytes_of(Chain(spheres, strands, Exclusion::arc(1.5)));
  const std::size_t window_at = offsetof(BinaryChain::Header, window),
                    spheres_at = sizeof(BinaryChain::Header), strands_at = spheres_at + 6 * sizeof(Sphere),
                    one = sizeof(BinaryChain::Strand), arcs_at = strands_at + 3 * one;
  const std::uint64_t zero = 0, two = 2, seven = 7;
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(said_of(arcs, strands_at, zero), "");
  EXPECT_EQ(said_of(arcs, strands_at, two), "a.catena: strand 0 runs from sphere 2 to 2");
  EXPECT_EQ(said_of(arcs, strands_at + one, seven), "a.catena: strand 0 runs from sphere 0 to 7");
  EXPECT_EQ(said_of(arcs, strands_at + 2 * one, std::uint64_t{1}),
            "a.catena: strand 1 runs from sphere 2 to 1");
  EXPECT_EQ(said_of(arcs, strands_at + 2 * one + 8, two),
            "a.catena: strand 2 is closed by 2, with a loop of length 0");
  EXPECT_EQ(said_of(arcs, strands_at + one + 16, infinity),
            "a.catena: strand 1 is closed by 1, with a loop of length inf");
  EXPECT_EQ(said_of(arcs, spheres_at + 5 * sizeof(Sphere) + 12, -1.0f),
            "a.catena: sphere 5 has the negative radius -1");
  EXPECT_EQ(said_of(arcs, arcs_at + 5 * sizeof(double), infinity),
            "a.catena: the arc length inf of sphere 5 is not finite");
  const std::string pairs =
      bytes_of(Chain(spheres, strands, {Exclusion::Rule::index_window, 1, 0, {Pair{2, 4}, Pair{3, 5}}}));
  EXPECT_EQ(said_of(pairs, window_at, std::uint32_t{0}),
            "a.catena: the exclusion rule 0 with window 0 and factor 0 is none");
  // Not sorted, so that those of spheres from 2 to 6 seem to have one of sphere 7 among them.
  EXPECT_EQ(said_of(pairs, arcs_at, BinaryChain::Neighbours{7, 8}),
            "a.catena: the pair 7 8 does not name two of the spheres in their order, of which there are 6");
}

TEST(BinaryChain, FindsNoPairOfAnotherPartAmongItsOwn) {
  const std::string bytes = bytes_of(
      Chain(std::vector<Sphere>(6), {}, {Exclusion::Rule::index_window, 1, 0, {Pair{1, 3}, Pair{1, 4}}}));
  std::string unsorted = bytes;
  const BinaryChain::Neighbours late{4, 5};
  std::memcpy(unsorted.data() + bytes.size() - 2 * sizeof late, &late, sizeof late);
  EXPECT_EQ(opened(bytes).pairs(0, 3).size(), 2u);
  EXPECT_THROW(opened(unsorted).pairs(0, 3), InputError);
}

/// However many there are: that some are looked at at a time leaves none out.
TEST(BinaryChain, LooksAtEveryStrand) {
  constexpr std::uint32_t at_once = 1u << 16, n = at_once + 3;
  Strands strands{{0}, {}};
  for (std::uint32_t i = 1; i <= n; ++i) strands.first.push_back(i);
  const std::string bytes = bytes_of(Chain(std::vector<Sphere>(n), std::move(strands)));
  EXPECT_NO_THROW(opened(bytes).require_strands(0, n));
  for (const std::uint32_t strand : {0u, at_once - 1, at_once, n - 1}) {
    std::string wrong = bytes;
    wrong[sizeof(BinaryChain::Header) + n * sizeof(Sphere) + strand * sizeof(BinaryChain::Strand) + 8] = 7;
    EXPECT_THROW(opened(wrong).require_strands(0, n), InputError) << strand;
  }
}

}  // namespace
}  // namespace catena
