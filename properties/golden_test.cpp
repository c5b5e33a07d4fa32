#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/scenes/scene.h"
#include "catena/properties/declared_limit.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/pair_set_hash.h"
#include "catena/properties/property.h"
#include "catena/properties/variant_name.h"

/// properties/golden/pair_sets.tsv: for every scene, first and last frame, for every family of generated
/// chains, and for the chains stored beside it (frames of the rope, whose motion differs from machine to
/// machine), a hash of the floats and the hash of the pair set. Every exact variant must give it, on every
/// machine. Written anew, by the reference alone, with
///     CATENA_WRITE_GOLDEN=1 build/release/catena_tests --gtest_filter=Golden.PairSetsOfTheReference
namespace catena::properties {
namespace {

struct Row {
  std::string input;  ///< "path1:n=600 frame 0", "family walk seed 3"
  std::uint64_t spheres_hash, pairs, pairs_hash;
};

const std::filesystem::path& golden_file() {
  static const auto file = std::filesystem::path(CATENA_SOURCE_DIR) / "properties/golden/pair_sets.tsv";
  return file;
}

/// FNV-1a over the bits of every number.
std::uint64_t hash_of(std::span<const Sphere> spheres) {
  std::uint64_t hash = 14695981039346656037u;
  for (const Sphere& s : spheres)
    for (const float number : {s.x, s.y, s.z, s.radius})
      hash = (hash ^ std::bit_cast<std::uint32_t>(number)) * 1099511628211u;
  return hash;
}

struct Source {
  std::string input;
  Chain chain;
};

std::vector<Source> sources() {
  std::vector<Source> all;
  for (const SceneInfo& scene : SceneRegistry::instance().scenes()) {
    const std::string spec = scene.name + ":n=600";
    const auto animation = SceneRegistry::instance().open(spec);
    for (std::uint32_t f = 0; f < animation->frames(); f += std::max(1u, animation->frames() - 1))
      all.push_back({fmt::format("{} frame {}", spec, f), animation->frame(f)});
  }
  for (const Family& family : FamilyRegistry::instance().families())
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      Dice dice(seed);
      all.push_back({fmt::format("family {} seed {}", family.name, seed), generate(family, dice, 64)});
    }
  std::vector<std::filesystem::path> stored;
  for (const auto& entry : std::filesystem::directory_iterator(golden_file().parent_path()))
    if (entry.path().extension() == ".chain") stored.push_back(entry.path());
  std::ranges::sort(stored);
  for (const auto& path : stored)
    all.push_back({"file " + path.filename().string(), open_input(path.string()).animation->frame(0)});
  return all;
}

std::vector<Row> read_golden() {
  std::vector<Row> rows;
  std::ifstream in(golden_file());
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream text(line);
    Row row;
    std::getline(text, row.input, '\t');
    text >> std::hex >> row.spheres_hash >> std::dec >> row.pairs >> std::hex >> row.pairs_hash;
    if (!text) throw std::runtime_error(fmt::format("{}: not a row: {}", golden_file().string(), line));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// A rope is simulated by Eigen, whose sums depend on the machine's vectors: only its stored frames are
/// golden.
bool is_simulated(const std::string& input) { return input.starts_with("rope:"); }

void write_golden() {
  std::ofstream out(golden_file());
  out << "# input, hash of its floats, pairs, hash of the pair set; written by golden_test.cpp\n";
  for (const Source& source : sources()) {
    if (is_simulated(source.input)) continue;
    const Case test = Case::of(source.chain);
    out << fmt::format("{}\t{:016x}\t{}\t{:016x}\n", source.input, hash_of(source.chain.spheres()),
                       test.exact.pair_count, pair_set_hash(test.exact.pairs));
  }
}

/// Only these chains are made with the C library's sines, whose last bits are its own.
bool uses_sines(const std::string& input) {
  return input.starts_with("family coil ") || input.starts_with("family knot ");
}

/// Every chain with its row. A simulated one, and one that this machine's sines make other floats of, has the
/// reference's own answer instead; all others have the golden file's floats on every machine.
std::vector<std::pair<Row, Case>> golden_cases() {
  std::vector<std::pair<Row, Case>> cases;
  const auto rows = read_golden();
  std::size_t golden = 0;
  for (Source& source : sources()) {
    const auto row = std::ranges::find(rows, source.input, &Row::input);
    const bool known = row != rows.end();
    const bool same = known && row->spheres_hash == hash_of(source.chain.spheres());
    golden += known;
    EXPECT_TRUE(known || is_simulated(source.input)) << "not in the golden file: " << source.input;
    EXPECT_TRUE(!known || same || uses_sines(source.input)) << "other floats: " << source.input;
    Case test = Case::of(std::move(source.chain));
    const Row own{source.input, 0, test.exact.pair_count, pair_set_hash(test.exact.pairs)};
    cases.emplace_back(same ? *row : own, std::move(test));
  }
  EXPECT_EQ(golden, rows.size()) << "rows whose input is no more";
  return cases;
}

void expect_golden(bool on_device) {
  auto subjects = Subject::available();
  for (Subject& small : in_small_blocks(subjects)) subjects.push_back(std::move(small));
  std::erase_if(subjects, [&](const Subject& s) { return !s.exact() || s.info.on_device() != on_device; });
  if (subjects.empty()) GTEST_SKIP() << "no such variant is available here";
  const auto cases = golden_cases();
  Collisions found;
  for (const Subject& subject : subjects) {
    const auto variant = subject.make();
    const auto limit = declared_limit(subject);
    for (const auto& [row, test] : cases) try {
        variant->build(test.chain);
        variant->find(test.chain, {}, found);
        EXPECT_EQ(pair_set_hash(found.pairs), row.pairs_hash) << subject.info.name << ": " << row.input;
      } catch (const CapacityError& error) {
        EXPECT_TRUE(limit && test.chain.size() > limit->takes)
            << subject.info.name << ": " << row.input << ": " << error.what();
      }
  }
}

TEST(Golden, PairSetsOfTheReference) {
  if (std::getenv("CATENA_WRITE_GOLDEN") != nullptr) write_golden();
  for (const auto& [row, test] : golden_cases()) {
    EXPECT_EQ(test.exact.pair_count, row.pairs) << row.input;
    EXPECT_EQ(pair_set_hash(test.exact.pairs), row.pairs_hash) << row.input;
  }
}

TEST(Golden, PairSetsOfEveryHostVariant) { expect_golden(false); }
TEST(DeviceGolden, PairSetsOfEveryDeviceVariant) { expect_golden(true); }

}  // namespace
}  // namespace catena::properties
