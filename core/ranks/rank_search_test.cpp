#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <numeric>
#include <random>

#include "catena/bench/ranks/lattice_part.h"
#include "catena/bench/ranks/scaling.h"
#include "catena/core/input/curve_input.h"
#include "catena/core/input/input.h"
#include "catena/core/ranks/answers.h"
#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/part_file.h"
#include "catena/core/ranks/test_chain.h"
#include "catena/core/ranks/thread_ranks.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/writers/writer.h"
#include "catena/properties/generators/family.h"
#include "catena/reference/find_in_box.h"
#include "catena/reference/ranks/verify_answer.h"
#include "catena/reference/reference.h"

namespace catena::ranks {
namespace {

/// What all ranks found, put together.
struct Whole {
  std::vector<std::uint64_t> count;
  std::vector<IdPair> pairs;
  std::uint64_t pair_count = 0;
  std::vector<RankWork> work;
};

using Cut = std::function<Part(Communicator&)>;

Whole searched(unsigned ranks, const RankOptions& options, const Cut& cut) {
  std::vector<RankAnswer> answers(ranks);
  Whole whole;
  whole.work.resize(ranks);
  run_in_threads(
      ranks, [&](Communicator& c) { answers[c.rank()] = search(c, cut(c), options, whole.work[c.rank()]); });
  for (const RankAnswer& answer : answers) {
    whole.count.insert(whole.count.end(), answer.count.begin(), answer.count.end());
    whole.pairs.insert(whole.pairs.end(), answer.pairs.begin(), answer.pairs.end());
    EXPECT_EQ(answer.pair_count, answers[0].pair_count);
    whole.pair_count = answer.pair_count;
  }
  return whole;
}

Cut evenly(const Chain& chain) {
  return [&chain](Communicator& c) { return even_part_of(chain, c.size(), c.rank()); };
}

void expect_exact(const Whole& whole, const Chain& chain, const std::string& what) {
  const reference::Answer exact = reference::find(chain);
  std::vector<IdPair> pairs;
  for (const Pair& p : exact.pairs) pairs.push_back({p.i, p.j});
  EXPECT_GT(exact.pair_count, 0u) << what;
  EXPECT_EQ(whole.pair_count, exact.pair_count) << what;
  EXPECT_EQ(whole.pairs, pairs) << what;
  EXPECT_EQ(whole.count, std::vector<std::uint64_t>(exact.count.begin(), exact.count.end())) << what;
  std::uint64_t found = 0;
  for (const RankWork& work : whole.work) found += work.pairs_within + work.pairs_across;
  EXPECT_EQ(found, exact.pair_count) << what;
}

TEST(RankSearch, FindsWhatOneRankFindsOnOneToSixtyFour) {
  for (const char* input : {"yarn:n=1500", "hair:n=1200", "lattice:n=800"}) {
    const Chain chain = chain_of(input);
    for (const unsigned ranks : {1u, 2u, 3u, 5u, 8u, 16u, 33u, 64u})
      for (const Order order : {Order::chain, Order::space, Order::measured})
        expect_exact(searched(ranks, {.order = order}, evenly(chain)), chain,
                     fmt::format("{} on {}", input, ranks));
  }
}

/// A tube wound five times, perhaps closed: by space each rank gets pieces of every winding, and one gets
/// both ends. Some of what touches are extra pairs.
Chain coil(bool closed, Exclusion rule) {
  constexpr std::uint32_t n = 400, turns = 5;
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * turns * i / n, along = 2 * std::numbers::pi * i / n;
    spheres.push_back({static_cast<float>(9 * std::cos(angle)), static_cast<float>(9 * std::sin(angle)),
                       static_cast<float>(std::sin(along)), 4});
  }
  for (std::uint32_t i = 0; i + n / turns < n; i += 3) rule.extra_pairs.push_back({i, i + n / turns});
  return Chain(std::move(spheres), closed ? Strands::one_closed(n) : Strands{}, std::move(rule));
}

TEST(RankSearch, KnowsNeighboursAcrossPiecesAndAroundTheEnd) {
  for (const Exclusion& rule : {Exclusion::index(1), Exclusion::index(12), Exclusion::index(60),
                                Exclusion::arc(1.5), Exclusion::arc(9)}) {
    for (const bool closed : {false, true}) {
      const Chain chain = coil(closed, rule);
      for (const unsigned ranks : {1u, 2u, 3u, 4u, 7u, 12u})
        for (const Order order : {Order::chain, Order::space})
          expect_exact(searched(ranks, {.order = order}, evenly(chain)), chain,
                       fmt::format("on {} ranks", ranks));
    }
  }
}

/// Numbers past 2^32, as no chain of one process has them: three parts in the middle of a chain of 5e9
/// spheres.
TEST(HeldPart, NumbersSpheresIn64Bits) {
  const bench::LatticeBox box{.side = 1700, .reach = 1, .rods = true};
  const SphereId first = (SphereId{1} << 32) - 500;
  const HeldPart held(lattice_part(box, first, first + 1000));
  const Place below = held.place(499), above = held.place(500);
  EXPECT_EQ(below.id, (SphereId{1} << 32) - 1);
  EXPECT_EQ(above.id, SphereId{1} << 32);
  for (std::uint32_t i = 1; i < 1000; ++i) {
    const Place a = held.place(i - 1), b = held.place(i), first_of_all = held.place(0);
    EXPECT_EQ(held.neighbours(a, b), box.neighbours(a.id, b.id)) << i;
    if (i > 1) {
      EXPECT_FALSE(held.neighbours(first_of_all, b)) << i;
    }
  }
}

/// What is found is told by those numbers to the ranks that they belong to.
TEST(ReturnedAnswers, GoHomeByNumbersOf64Bits) {
  const SphereId start = SphereId{1} << 33;
  const std::vector<SphereId> starts{0, start, start, start + 10};
  run_in_threads(3, [&](Communicator& c) {
    const std::vector<SphereId> counted_from{start - 5, start, start, start + 10};
    // Runs that end, begin and lie in the spheres of the last rank, and single ones.
    const std::vector<std::uint32_t> across{7, 2, 3}, within{1};
    std::vector<std::uint64_t> count;
    if (c.rank() == 2)
      count = return_counts(c, counted_from, std::vector<CountRun>{{start - 1, across}, {start + 3, within}},
                            std::vector<Counted>{{start + 3, 5}, {start + 9, 1}});
    else
      count = return_counts(c, counted_from, {}, std::vector<Counted>{{start + 3, 1}, {start + 9, 1}});
    if (c.rank() == 0) {
      EXPECT_EQ(count, (std::vector<std::uint64_t>{0, 0, 0, 0, 7}));
    }
    if (c.rank() == 1) {
      EXPECT_TRUE(count.empty());
    }
    if (c.rank() == 2) {
      EXPECT_EQ(count, (std::vector<std::uint64_t>{2, 3, 0, 8, 0, 0, 0, 0, 0, 3}));
    }
    const auto pairs =
        return_pairs(c, starts, PairLists{{{start + 2 - c.rank(), start + 7}}, {}, {{5, start + 1}}});
    if (c.rank() == 0) {
      EXPECT_EQ(pairs, (std::vector<IdPair>{{5, start + 1}, {5, start + 1}, {5, start + 1}}));
    }
    if (c.rank() == 1) {
      EXPECT_TRUE(pairs.empty());
    }
    if (c.rank() == 2) {
      EXPECT_EQ(pairs,
                (std::vector<IdPair>{{start, start + 7}, {start + 1, start + 7}, {start + 2, start + 7}}));
    }
  });
}

/// Also runs that are longer than what is read of a message at once.
TEST(ReturnedAnswers, OfLongRunsAreComplete) {
  constexpr std::uint32_t size = 5000;
  std::vector<std::uint32_t> counts(size);
  std::iota(counts.begin(), counts.end(), 1u);
  run_in_threads(2, [&](Communicator& c) {
    const std::vector<SphereId> starts{0, size, size};
    std::vector<std::uint64_t> twice(counts.begin(), counts.end());
    for (auto& count : twice) count *= 2;
    const std::vector<Counted> more{{2, 5}};
    const auto found = return_counts(c, starts, std::vector<CountRun>{{0, counts}}, more);
    twice[2] += 10;
    EXPECT_EQ(found, c.rank() == 0 ? twice : std::vector<std::uint64_t>());
  });
}

TEST(RankSearch, KeepsToTheLimitOfAllRanks) {
  const Chain chain = chain_of("coincident:n=60");
  for (const std::uint64_t limit : {0u, 100u, 811u, 812u}) {
    const Whole whole = searched(3, {.request = {.pair_limit = limit}}, evenly(chain));
    EXPECT_EQ(whole.pair_count, 812u);
    EXPECT_EQ(whole.pairs.size(), limit < 812 ? 0u : 812u);
    EXPECT_EQ(std::accumulate(whole.count.begin(), whole.count.end(), std::uint64_t{0}), 2u * 812);
  }
}

/// Whatever a rank does in whatever phase: all end, and say the same.
TEST(RankSearch, EndsOnAllRanksWhenOneFails) {
  const Chain chain = chain_of("yarn:n=600");
  for (const Phase phase : {Phase::take_part, Phase::order, Phase::repartition, Phase::build, Phase::within,
                            Phase::across, Phase::answers, Phase::done})
    for (unsigned failing = 0; failing < 4; ++failing) {
      std::vector<std::string> said(4);
      run_in_threads(4, [&](Communicator& c) {
        RankOptions options{.order = Order::space};
        options.entering = [&](Phase at) {
          if (at == phase && c.rank() == failing) throw InputError("no more");
          if (at == phase && c.rank() == 3) throw std::bad_alloc();
        };
        RankWork work;
        try {
          search(c, evenly(chain)(c), options, work);
        } catch (const RankFailed& failed) {
          said[c.rank()] = failed.what();
        }
      });
      const std::string first = fmt::format("rank {} of 4: {}", failing, "no more");
      for (unsigned rank = 0; rank < 4; ++rank)
        EXPECT_EQ(said[rank].substr(0, 10), first.substr(0, 10))
            << name_of(phase) << ": rank " << rank << " says " << said[rank];
      if (failing < 3) {
        EXPECT_EQ(said[failing], first);
      }
    }
}

TEST(RankSearch, ComparesWithTheReference) {
  const Chain chain = chain_of("yarn:n=500");
  run_in_threads(3, [&](Communicator& c) {
    RankWork work;
    RankAnswer answer = search(c, evenly(chain)(c), {}, work);
    const auto whole = [&] { return c.rank() == 0 ? std::optional<Chain>(chain) : std::nullopt; };
    EXPECT_TRUE(compare_with_reference(c, whole(), answer).right());
    RankAnswer less = answer, again = answer, more = answer, miscounted = answer;
    if (c.rank() == 1)
      less.pairs.pop_back(), again.pairs.push_back(again.pairs[0]), more.pairs.push_back({300, 302});
    if (c.rank() == 2) ++miscounted.count[0];
    EXPECT_EQ(compare_with_reference(c, whole(), less).missing, 1u);
    EXPECT_EQ(compare_with_reference(c, whole(), again).repeated, 1u);
    const RankComparison invented = compare_with_reference(c, whole(), more);
    EXPECT_EQ(invented.invented + invented.repeated, 1u);
    EXPECT_EQ(compare_with_reference(c, whole(), miscounted).wrong_counts, 1u);
    // Of every rank, and what all say alike.
    RankAnswer uncounted = answer, unsure = answer, of_more = answer;
    uncounted.count.pop_back();
    EXPECT_EQ(compare_with_reference(c, whole(), uncounted).wrong_counts, 3u);
    unsure.found = c.rank() == 2;
    EXPECT_FALSE(compare_with_reference(c, whole(), unsure).right());
    of_more.pair_count += c.rank() == 0;
    EXPECT_FALSE(compare_with_reference(c, whole(), of_more).right());
  });
}

TEST(LatticePart, IsAPartOfTheScene) {
  for (const bench::LatticeBox& box : {bench::LatticeBox{7, 3}, bench::LatticeBox{6, 2, true, false},
                                       bench::LatticeBox{5, 1, false, true}}) {
    const Chain chain = chain_of(box.scene());
    for (const std::uint32_t begin : {0u, 13u, 60u}) {
      const Part made = lattice_part(box, begin, chain.size()), cut = part_of(chain, begin, chain.size());
      EXPECT_EQ(made.spheres, cut.spheres) << box.scene();
      ASSERT_EQ(made.pieces.size(), cut.pieces.size());
      for (std::size_t k = 0; k < made.pieces.size(); ++k)
        EXPECT_EQ(std::memcmp(&made.pieces[k], &cut.pieces[k], sizeof(Piece)), 0) << box.scene() << ' ' << k;
    }
  }
}

TEST(LatticePart, GivesTheClosedFormOnAnyRanks) {
  for (const bench::LatticeBox& box :
       {bench::LatticeBox{12, 3}, bench::LatticeBox{9, 2, true, false}, bench::LatticeBox{9, 1, false, true}})
    run_in_threads(5, [&](Communicator& c) {
      RankWork work;
      RankAnswer answer = search(c,
                                 lattice_part(box, even_start(box.spheres(), 5, c.rank()),
                                              even_start(box.spheres(), 5, c.rank() + 1)),
                                 {.order = Order::space}, work);
      EXPECT_EQ(lattice_fault(c, box, answer, true), "");
      if (!answer.pairs.empty()) answer.pairs[0].j = answer.pairs[0].i;
      const std::string fault = lattice_fault(c, box, answer, true);
      if (!answer.pairs.empty()) {
        EXPECT_NE(fault, "");
      }
    });
}

/// On whichever rank; each says what is wrong of all, or of its own pairs.
TEST(LatticePart, NamesWhatIsWrongOfTheAnswer) {
  const bench::LatticeBox box{6, 2};
  run_in_threads(3, [&](Communicator& c) {
    const auto start = [&](unsigned rank) { return even_start(box.spheres(), 3, rank); };
    RankWork work;
    const RankAnswer right = search(c, lattice_part(box, start(c.rank()), start(c.rank() + 1)), {}, work);
    const auto fault = [&](unsigned of, const auto& spoil, bool with_pairs = true) {
      RankAnswer wrong = right;
      if (c.rank() == of) spoil(wrong);
      return lattice_fault(c, box, wrong, with_pairs);
    };
    const std::uint64_t n = box.pairs();
    for (unsigned of = 0; of < 3; ++of) {
      EXPECT_EQ(fault(of, [](RankAnswer& a) { ++a.count.back(); }),
                fmt::format("counts sum up to {} instead of {}", 2 * n + 1, 2 * n));
      EXPECT_EQ(fault(of, [](RankAnswer& a) { a.pairs.pop_back(); }),
                fmt::format("{} pairs are kept of {}", n - 1, n));
      EXPECT_EQ(fault(
                    of, [](RankAnswer& a) { a.pairs.pop_back(); }, false),
                "");
      const auto on_it = [&](const std::string& words) { return c.rank() == of ? words : ""; };
      EXPECT_EQ(fault(of, [](RankAnswer& a) { a.pairs[1] = a.pairs[0]; }), on_it("a pair is there twice"));
      const SphereId i = right.pairs[0].i, apart = i < box.spheres() / 2 ? box.spheres() - 1 : i + 1;
      EXPECT_EQ(fault(of, [&](RankAnswer& a) { a.pairs[0].j = apart; }),
                on_it(fmt::format("{} and {} do not collide", i, apart)));
    }
    RankAnswer more = right;
    ++more.pair_count;
    EXPECT_EQ(lattice_fault(c, box, more, true), fmt::format("{} pairs instead of {}", n + 1, n));
  });
}

/// A file of these bytes.
BinaryChain of_bytes(const std::string& bytes) {
  return {"a.catena", bytes.size(), [&bytes](std::uint64_t at, std::span<std::byte> part) {
            ASSERT_LE(at + part.size(), bytes.size());
            std::memcpy(part.data(), bytes.data() + at, part.size());
          }};
}

std::string binary_of(const Chain& chain) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("catena-{}.catena", getpid());
  const Labels none;
  WriterRegistry::instance().of(file).write(
      file, {0, 1, [&](std::uint32_t) { return ExportedFrame{chain}; }, none});
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(file);
  return bytes;
}

bool same(const Part& a, const Part& b) {
  return a.spheres == b.spheres && a.arcs == b.arcs && a.extra == b.extra &&
         a.pieces.size() == b.pieces.size() &&
         (a.pieces.empty() ||
          std::memcmp(a.pieces.data(), b.pieces.data(), a.pieces.size() * sizeof(Piece)) == 0) &&
         a.rule.kind == b.rule.kind && a.rule.window == b.rule.window && a.rule.factor == b.rule.factor;
}

TEST(PartFile, GivesEachRankItsPartOfAnyChain) {
  std::uint64_t seed = 0, extra = 0, arcs = 0, strands = 0;
  for (const properties::Family& family : properties::FamilyRegistry::instance().families())
    for (int round = 0; round < 12; ++round) {
      properties::Dice dice(++seed);
      const Chain chain = properties::generate(family, dice, 60);
      const std::string bytes = binary_of(chain);
      EXPECT_EQ(binary_of(make_chain(read_text("a.catena", bytes), {})), bytes) << family.name << ' ' << seed;
      for (const unsigned ranks : {1u, 3u, 7u})
        run_in_threads(ranks, [&](Communicator& c) {
          EXPECT_TRUE(same(read_part(c, of_bytes(bytes)), evenly(chain)(c)))
              << family.name << ' ' << seed << ": rank " << c.rank();
        });
      extra += !chain.exclusion().extra_pairs.empty();
      arcs += chain.exclusion().rule == Exclusion::Rule::arc_window;
      strands += chain.strand_count() > 2;
    }
  EXPECT_GT(std::min({extra, arcs, strands}), 5u);
}

void expect_refused(const std::string& bytes, const std::string& because) {
  const std::string words = complaint("a.catena", bytes);
  EXPECT_NE(words.find(because), std::string::npos) << words;
  for (const unsigned ranks : {1u, 2u, 3u})
    run_in_threads(ranks, [&](Communicator& c) {
      try {
        together(c, [&] { read_part(c, of_bytes(bytes)); });
        ADD_FAILURE() << ranks << " ranks do not refuse: " << because;
      } catch (const RankFailed& failed) {
        EXPECT_NE(std::string(failed.what()).find(because), std::string::npos) << failed.what();
      }
    });
}

TEST(PartFile, RefusesWhatIsNoChain) {
  const std::string whole = binary_of(chain_of("hair:n=40"));
  for (std::size_t size : {std::size_t{0}, std::size_t{63}, std::size_t{64}, whole.size() - 1})
    EXPECT_THROW(of_bytes(whole.substr(0, size)), InputError) << size;
  EXPECT_THROW(of_bytes(whole + "x"), InputError);
  const auto with = [&](std::size_t at, auto value) {
    std::string changed = whole;
    std::memcpy(changed.data() + at, &value, sizeof value);
    return changed;
  };
  expect_refused(with(0, 'K'), "does not start with 'catena-binary 1'");
  expect_refused(with(16, ~std::uint64_t{0}), "do not fit");
  expect_refused(with(24, std::uint64_t{1} << 60), "do not fit");
  expect_refused(with(32, std::uint64_t{1} << 60), "do not fit");
  expect_refused(with(16, std::uint64_t{39}), "but its header says");
  expect_refused(with(40, std::uint32_t{1}), "but its header says");
  expect_refused(with(40, std::uint32_t{2}), "the exclusion rule 2");
  expect_refused(with(44, std::uint32_t{0}), "window 0");
  expect_refused(with(64 + 2 * 16 + 4, std::numeric_limits<float>::quiet_NaN()), "sphere 2 is not finite");
  expect_refused(with(64 + 3 * 16 + 12, -1.0f), "sphere 3 has the negative radius");
  const std::size_t strands = 64 + 40 * 16;
  expect_refused(with(strands, std::uint64_t{1}), "strand 0 runs from");
  expect_refused(with(strands + 24, std::uint64_t{4000}), "runs from");
  expect_refused(with(strands + 8, std::uint64_t{7}), "is closed by 7");
  // The only strand, too, begins with the first sphere; and a file of none is none.
  const std::string single = binary_of(Chain(std::vector<Sphere>(4)));
  std::string late = single, strandless = single;
  late[64 + 4 * 16] = 1;
  expect_refused(late, "strand 0 runs from sphere 1");
  strandless[24] = 0, strandless.resize(64 + 4 * 16);
  expect_refused(strandless, "there is no strand");
  const std::string arcs = binary_of(Chain(std::vector<Sphere>(4), {}, Exclusion::arc(1.5)));
  for (const double factor : {1.5, 0.0, -1.5, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    std::string changed = arcs;
    std::memcpy(changed.data() + 48, &factor, sizeof factor);
    if (factor == 1.5)
      EXPECT_EQ(changed, arcs);
    else
      expect_refused(changed, fmt::format("with window 0 and factor {} is none", factor));
  }
  Exclusion joined = Exclusion::index(1);
  joined.extra_pairs = {{0, 2}};
  const std::string paired = binary_of(Chain(std::vector<Sphere>(3), {}, joined));
  for (const auto& [i, j] : {IdPair{0, 3}, IdPair{2, 2}, IdPair{2, 1}, IdPair{3, 4}, IdPair{200, 300}}) {
    std::string changed = paired;
    std::memcpy(changed.data() + changed.size() - 16, &i, sizeof i);
    std::memcpy(changed.data() + changed.size() - 8, &j, sizeof j);
    expect_refused(changed, "does not name two of the spheres in their order");
  }
  // Wherever strands do not ascend, one rank of any number sees it.
  const std::vector<Sphere> row(100);
  for (const std::uint32_t s : {1u, 2u, 3u}) {
    std::string changed = binary_of(Chain(row, {{0, 20, 40, 60, 80, 100}, {}}));
    const std::size_t first = 64 + 100 * 16 + s * 24;
    for (std::size_t k = 0; k < 8; ++k) std::swap(changed[first + k], changed[first + 24 + k]);
    expect_refused(changed, fmt::format("strand {} runs from sphere {} to {}", s, 20 * s + 20, 20 * s));
  }
}

/// One process measures the spheres, ranks take what the file says.
TEST(PartFile, RefusesArcLengthsThatAreNotThoseOfItsSpheres) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < 9; ++i)
    spheres.push_back({static_cast<float>(i), static_cast<float>(i % 3), 0, 0.5f});
  const std::string whole = binary_of(Chain(spheres, {{0, 4, 9}, {0, 1}}, Exclusion::arc(1.5)));
  const auto with = [&](std::size_t at, const auto& change) {
    std::string changed = whole;
    double length;
    std::memcpy(&length, changed.data() + at, sizeof length);
    length = change(length);
    std::memcpy(changed.data() + at, &length, sizeof length);
    return changed;
  };
  const std::size_t strands = 64 + 9 * 16, arcs = strands + 2 * 24;
  const auto next = [](double length) { return std::nextafter(length, 1e9); };
  for (std::uint32_t i = 0; i < 9; ++i)
    expect_refused(with(arcs + i * 8, next), fmt::format("sphere {} is at the arc length", i));
  expect_refused(with(strands + 24 + 16, next), "strand 1 has a loop of length");
  expect_refused(with(arcs + 8, [](double) { return -1.0; }), "sphere 1 is at the arc length -1, but");
}

TEST(Scaling, AsksForLittleMoreThanTrulyTouches) {
  for (const char* input : {"yarn:n=60000", "lattice:n=40000", "path2:n=60000"}) {
    const Scaling scaling = measure_scaling(chain_of(input), {.ranks = doubled_ranks(32)});
    ASSERT_EQ(scaling.points.size(), 5u);
    for (const ScalingPoint& p : scaling.points) {
      EXPECT_LE(p.blocks_asked, 2 * p.blocks_touching) << input << " on " << p.ranks;
      EXPECT_LE(p.blocks_touching, p.blocks_asked);
      EXPECT_LE(p.most_spheres, 2 * 60000 / p.ranks + 8) << input << " on " << p.ranks;
    }
  }
  const Chain yarn = chain_of("yarn:n=60000");
  EXPECT_LT(
      measure_scaling(yarn, {.ranks = doubled_ranks(8), .order = Order::space}).points[2].blocks_asked,
      measure_scaling(yarn, {.ranks = doubled_ranks(8), .order = Order::chain}).points[2].blocks_asked / 2);
}

}  // namespace
}  // namespace catena::ranks
