// What each rank reads of a .catena file, and what is refused of one.
#include "catena/core/ranks/part_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/input/curve_input.h"
#include "catena/core/ranks/test_chain.h"
#include "catena/core/ranks/thread_ranks.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/writers/writer.h"
#include "catena/properties/generators/family.h"

namespace catena::ranks {
namespace {

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
          EXPECT_TRUE(same(read_part(c, of_bytes(bytes)), even_part_of(chain, c.size(), c.rank())))
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
  for (const double factor :
       {1.5, 0.0, -1.5, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
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

}  // namespace
}  // namespace catena::ranks
