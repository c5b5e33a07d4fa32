#include "catena/core/ranks/named_part.h"

#include <gtest/gtest.h>

#include <atomic>

#include "catena/core/ranks/thread_ranks.h"
#include "catena/properties/generators/family.h"

namespace catena::ranks {
namespace {

Labels named(const Chain& chain, bool spheres, bool strands) {
  Labels labels;
  for (std::uint32_t i = 0; spheres && i < chain.size(); ++i) labels.add(std::string_view("atom" + std::to_string(7 * i)));
  for (std::uint32_t s = 0; strands && s < chain.strand_count(); ++s)
    labels.strand_names.push_back("chr" + std::to_string(3 * s));
  return labels;
}

/// What any sphere is called, whichever rank it is of and whoever asks, how often and in what order: by the
/// file's names, or the numbers where it has none.
TEST(Directory, NamesSpheresAsTheirFileDoes) {
  std::uint64_t seed = 0, later = 0;
  std::atomic<int> joints = 0;
  for (const char* family : {"strands", "closed", "joints"})
    for (int round = 0; round < 12; ++round) {
      properties::Dice dice(++seed);
      const Chain chain = generate(properties::FamilyRegistry::instance().family(family), dice, 60);
      const bool of_spheres = round % 2, of_strands = round / 2 % 2, with_spheres = dice.below(2) == 0;
      const Labels labels = named(chain, of_spheres, of_strands);
      const unsigned ranks = 1 + dice.below(5);
      std::vector<SphereId> starts;
      for (unsigned r = 0; r <= ranks; ++r) starts.push_back(chain.size() * std::uint64_t{r} / ranks);
      std::vector<SphereId> ids;
      for (int k = 0; k < 20; ++k) ids.push_back(dice.below(chain.size()));
      ids.push_back(ids[3]);
      const auto expect_named = [&](SphereId id, const Described& told) {
        const auto i = static_cast<std::uint32_t>(id);
        std::uint32_t strand = 0;
        while (chain.strands().first[strand + 1] <= i) ++strand;
        EXPECT_EQ(told.named.number, id);
        EXPECT_EQ(told.named.label, of_spheres ? labels.of(i) : std::to_string(i));
        EXPECT_EQ(told.named.strand, of_strands ? labels.strand_names[strand] : std::to_string(strand));
        EXPECT_EQ(told.named.index, i - chain.strands().first[strand]);
        EXPECT_EQ(told.sphere, with_spheres ? chain[i] : Sphere{});
      };
      run_in_threads(ranks, [&](Communicator& c) {
        const NamedPart part = scatter(c, [&](unsigned rank) {
          return named_part_of(chain, labels, static_cast<std::uint32_t>(starts[rank]),
                               static_cast<std::uint32_t>(starts[rank + 1]));
        });
        const Part right = part_of(chain, static_cast<std::uint32_t>(starts[c.rank()]),
                                   static_cast<std::uint32_t>(starts[c.rank() + 1]));
        EXPECT_EQ(part.part.spheres, right.spheres);
        EXPECT_EQ(part.part.arcs, right.arcs);
        EXPECT_EQ(part.part.extra, right.extra);
        joints += !right.extra.empty() && c.rank() > 0;
        const Directory directory(part, with_spheres);
        for (SphereId id = starts[c.rank()]; id < starts[c.rank() + 1]; ++id) expect_named(id, directory.at(id));
        const std::vector<SphereId> mine(ids.begin() + c.rank(), ids.end());
        const std::vector<Described> told = directory.of(c, starts, mine);
        ASSERT_EQ(told.size(), mine.size());
        for (std::size_t k = 0; k < mine.size(); ++k) expect_named(mine[k], told[k]);
      });
      later += of_strands && ranks > 1 && chain.strand_count() > 1;
    }
  EXPECT_GT(later, 2u);
  EXPECT_GT(joints, 2);
}

/// Whoever was the first to send.
TEST(Communicator, DeliversByRisingRank) {
  run_in_threads(4, [&](Communicator& c) {
    for (int k = 0; k < 100; ++k) {
      const Bytes own(c.rank() + 1);
      std::vector<Message> messages;
      std::vector<Outgoing> out;
      std::vector<unsigned> others, told, came;
      for (unsigned other = 0; other < c.size(); ++other) {
        if (other == c.rank()) continue;
        others.push_back(other), out.push_back({other, own}), messages.push_back({other, own});
      }
      std::vector<Bytes> places(c.size());
      c.exchange_in_place(out, [&](unsigned rank, std::size_t bytes) {
        EXPECT_EQ(bytes, rank + 1);
        told.push_back(rank), places[rank].resize(bytes);
        return places[rank].data();
      });
      for (const Message& message : c.exchange(std::move(messages))) came.push_back(message.rank);
      EXPECT_EQ(told, others);
      EXPECT_EQ(came, others);
    }
  });
}

/// What a rank sends itself is no traffic.
TEST(Communicator, CountsWhatGoesToOthers) {
  run_in_threads(3, [&](Communicator& c) {
    std::vector<Message> out;
    for (unsigned to = 0; to <= c.rank(); ++to) out.push_back({to, Bytes(10 + to)});
    c.exchange(std::move(out));
    EXPECT_EQ(c.traffic().messages, c.rank());
    EXPECT_EQ(c.traffic().bytes, c.rank() == 2 ? 21u : 10 * c.rank());
  });
}

}  // namespace
}  // namespace catena::ranks
