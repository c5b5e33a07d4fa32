#include "catena/core/writers/writer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <fstream>
#include <set>
#include <span>
#include <sstream>

#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_floats.h"

namespace catena {
namespace {

using Offsets = std::vector<std::uint32_t>;

/// Any spheres; strands of at least one, open and closed.
Chain any_chain() {
  std::vector<Sphere> spheres;
  Strands strands{{0}, {}};
  for (auto left = *rc::gen::inRange(1, 5); left > 0; --left) {
    for (auto more = *rc::gen::inRange(1, 6); more > 0; --more)
      spheres.push_back({*any_finite(), *any_finite(), *any_finite(), std::abs(*any_finite())});
    strands.first.push_back(static_cast<std::uint32_t>(spheres.size()));
    strands.closed.push_back(*rc::gen::arbitrary<bool>());
  }
  return Chain(std::move(spheres), std::move(strands));
}

/// What is read of these frames, written.
CurveFile again(const std::string& name, const std::vector<Chain>& frames, const Labels& labels = {}) {
  const TestFile file(name, "");
  WriterRegistry::instance()
      .of(file.path())
      .write(file.path(), {0, static_cast<std::uint32_t>(frames.size()),
                           [&](std::uint32_t f) { return ExportedFrame{frames[f]}; }, labels});
  return ReaderRegistry::instance().read(file.path());
}

bool same_bits(std::span<const Sphere> a, std::span<const Sphere> b) {
  return std::ranges::equal(a, b, [](const Sphere& s, const Sphere& t) {
    return std::bit_cast<std::array<std::uint32_t, 4>>(s) == std::bit_cast<std::array<std::uint32_t, 4>>(t);
  });
}

std::vector<Sphere> without_radii(std::span<const Sphere> spheres) {
  std::vector<Sphere> bare(spheres.begin(), spheres.end());
  for (Sphere& sphere : bare) sphere.radius = 0;
  return bare;
}

TEST(Writers, AreKnownByTheirExtensionsInAnyCase) {
  for (const WriterInfo& info : WriterRegistry::instance().writers())
    for (std::string extension : info.extensions) {
      std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
      EXPECT_EQ(WriterRegistry::instance().of("A" + extension).info.name, info.name);
    }
  EXPECT_THROW(WriterRegistry::instance().of("a"), InputError);
}

void comes_back(const std::string& name) {
  const Chain chain = any_chain();
  const CurveFile curves = again(name, {chain});
  RC_ASSERT(same_bits(curves.spheres, chain.spheres()));
  RC_ASSERT(curves.strand_first == chain.strands().first);
  RC_ASSERT(curves.strand_closed == chain.strands().closed);
  RC_ASSERT(curves.has_radii);
  RC_ASSERT(curves.warnings.empty());
}

RC_GTEST_PROP(Writers, BringAChainBackFromChain, ()) { comes_back("a.chain"); }
RC_GTEST_PROP(Writers, BringAChainBackFromCsv, ()) { comes_back("a.csv"); }
RC_GTEST_PROP(Writers, BringAChainBackFromXyz, ()) { comes_back("a.xyz"); }

RC_GTEST_PROP(Writers, BringEveryFrameBackFromXyz, ()) {
  const Chain first = any_chain();
  std::vector<Chain> frames{first};
  for (auto more = *rc::gen::inRange(0, 4); more > 0; --more) {
    std::vector<Sphere> moved;
    for (std::uint32_t i = 0; i < first.size(); ++i)
      moved.push_back({*any_finite(), *any_finite(), *any_finite(), std::abs(*any_finite())});
    frames.push_back(first.moved(std::move(moved)));
  }
  const CurveFile curves = again("a.xyz", frames);
  RC_ASSERT(curves.later_frames.size() == frames.size() - 1);
  RC_ASSERT(same_bits(curves.spheres, frames[0].spheres()));
  for (std::size_t f = 1; f < frames.size(); ++f)
    RC_ASSERT(same_bits(curves.later_frames[f - 1], frames[f].spheres()));
}

// Labels of any letters; where strands share a name, their numbers stand in for it, or their rows would be
// joined.
RC_GTEST_PROP(Writers, BringLabelsBackFromCsv, ()) {
  const Chain chain = any_chain();
  const auto word = [] {
    return *rc::gen::nonEmpty(
        rc::gen::container<std::string>(rc::gen::elementOf(std::string("aB1/,;'\" \t\v\f#."))));
  };
  Labels labels;
  std::vector<std::string> ids;
  for (std::uint32_t i = 0; i < chain.size(); ++i) {
    std::string id = word();
    ids.push_back(id);
    labels.add(std::string_view(id));
  }
  for (std::uint32_t s = 0; s < chain.strand_count(); ++s)
    labels.strand_names.push_back(*rc::gen::elementOf(std::vector<std::string>{"A", "B", "C,1", "D", "E"}));
  const CurveFile curves = again("a.csv", {chain}, labels);
  RC_ASSERT(curves.strand_first == chain.strands().first);
  const std::set<std::string> distinct(labels.strand_names.begin(), labels.strand_names.end());
  if (distinct.size() == labels.strand_names.size())
    RC_ASSERT(curves.labels.strand_names == labels.strand_names);
  for (std::uint32_t i = 0; i < chain.size(); ++i) RC_ASSERT(curves.labels.of(i) == ids[i]);
}

/// The numbers of an array of a VTP file, by its name.
std::vector<double> array_of(const std::string& text, const std::string& name) {
  auto begin = text.find("Name=\"" + name + "\"");
  if (begin == std::string::npos) return {};
  begin = text.find('>', begin) + 1;
  std::istringstream in(text.substr(begin, text.find('<', begin) - begin));
  std::vector<double> numbers;
  for (double number; in >> number;) numbers.push_back(number);
  return numbers;
}

const Chain square(
    {{0, 0, 0, 1}, {3, 0, 0, 1}, {3, 3, 0, 1}, {1, 0, 0.5f, 0.25f}, {9, 0, 0, 1}, {8, 0, 0, 1}},
    {{0, 3, 4, 6}, {1, 0, 0}});

std::string written(const std::string& name, const ExportedFrame& frame) {
  const TestFile file(name, "");
  WriterRegistry::instance()
      .of(file.path())
      .write(file.path(), {0, 1, [&](std::uint32_t) { return frame; }, Labels()});
  std::ostringstream text;
  text << std::ifstream(file.path()).rdbuf();
  return text.str();
}

TEST(Writers, WriteLinesAndVerticesOfObj) {
  EXPECT_EQ(written("a.obj", {square}),
            "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 1 0 0.5\nv 9 0 0\nv 8 0 0\nl 1 2 3 1\np 4\nl 5 6\n");
  EXPECT_EQ(written("a.obj", {Chain(std::vector<Sphere>(2), Strands::one_closed(2))}),
            "v 0 0 0\nv 0 0 0\nl 1 2 1\n")
      << "a closed strand ends where it starts, however short";
}

TEST(Writers, WriteWhatParaViewShows) {
  Collisions found;
  found.found = true;
  found.pairs = {{1, 3}, {0, 3}};  // the deepest comes last
  found.count = {1, 1, 0, 2, 0, 0};
  found.pair_count = 2;
  const std::string text = written("a.vtp", {square, &found});
  using Numbers = std::vector<double>;
  EXPECT_EQ(array_of(text, "radius"), (Numbers{1, 1, 1, 0.25, 1, 1}));
  EXPECT_EQ(array_of(text, "strand"), (Numbers{0, 0, 0, 1, 2, 2}));
  EXPECT_EQ(array_of(text, "collisions"), (Numbers{1, 1, 0, 2, 0, 0}));
  EXPECT_EQ(array_of(text, "contact"), (Numbers{3, 3, -1, 0, -1, -1}));
  EXPECT_NEAR(array_of(text, "depth")[3], 1.25 - std::sqrt(1.25), 1e-15);
  // Of two that are equally deep the first, in whatever order they were found.
  const Chain cross({{0, 0, 0, 1}, {1, 0, 0, 1}, {-1, 0, 0, 1}}, {{0, 1, 2, 3}, {0, 0, 0}});
  for (const auto& pairs : {std::vector<Pair>{{0, 1}, {0, 2}}, std::vector<Pair>{{0, 2}, {0, 1}}}) {
    Collisions both{true, 2, {2, 1, 1}, pairs};
    EXPECT_EQ(array_of(written("a.vtp", {cross, &both}), "contact"), (Numbers{1, 0, 0}));
  }
  const std::string lines = text.substr(text.find("<Lines>"));
  EXPECT_EQ(array_of(lines, "connectivity"), (Numbers{0, 1, 2, 0, 4, 5}));
  EXPECT_EQ(array_of(lines, "offsets"), (Numbers{4, 6}));
  EXPECT_EQ(array_of(text, "connectivity"), (Numbers{3}));
  EXPECT_TRUE(array_of(written("a.vtp", {square}), "collisions").empty());
  const Chain with_empty_strands(std::vector<Sphere>(6), {{0, 0, 3, 3, 3, 6}, {0, 0, 0, 0, 0}});
  EXPECT_EQ(array_of(written("a.vtp", {with_empty_strands}), "strand"), (Numbers{1, 1, 1, 4, 4, 4}));
}

// Of one sphere no line, closed or not.
TEST(Writers, WriteClosedStrandsOfOneSphereAsPoints) {
  const Chain lone(std::vector<Sphere>(2), {{0, 1, 2}, {1, 0}});
  EXPECT_EQ(written("a.obj", {lone}), "v 0 0 0\nv 0 0 0\np 1\np 2\n");
  EXPECT_EQ(array_of(written("a.vtp", {lone}), "connectivity"), (std::vector<double>{0, 1}));
}

// The partner of a sphere may be an image, and the depth is that of the nearest.
TEST(Writers, WriteHowDeepSpheresOverlapAcrossTheBox) {
  const Chain chain({{0.25f, 0, 0, 1}, {9.5f, 0, 0, 1}, {1.75f, 0, 0, 1}}, {{0, 1, 2, 3}, {0, 0, 0}});
  const PeriodicBox box{{10, 10, 10}};
  Collisions found;
  found.found = true;
  found.pairs = {{0, 2}, {0, 1}};
  found.count = {2, 1, 1};
  found.pair_count = 2;
  const std::string text = written("a.vtp", {chain, &found, &box});
  EXPECT_EQ(array_of(text, "contact"), (std::vector<double>{1, 0, 0}));
  EXPECT_EQ(array_of(text, "depth"), (std::vector<double>{1.25, 1.25, 0.5}));
}

// By the readers of these formats, where there are any.
/// As lines and points show it, in the order in which they are read: first the strands with two ends. Of
/// fewer than three spheres none is closed.
Chain as_lines(const Chain& chain) {
  std::vector<Sphere> spheres;
  Strands strands{{0}, {}};
  for (const bool ends : {true, false}) {
    for (std::uint32_t s = 0; s < chain.strand_count(); ++s) {
      const std::uint32_t first = chain.strands().first[s], end = chain.strands().first[s + 1];
      const bool closed = end - first > 2 && chain.strands().closed[s];
      if (ends != (end - first > 1 && !closed)) continue;
      spheres.insert(spheres.end(), chain.spheres().begin() + first, chain.spheres().begin() + end);
      strands.first.push_back(static_cast<std::uint32_t>(spheres.size()));
      strands.closed.push_back(closed);
    }
  }
  return Chain(std::move(spheres), std::move(strands));
}

RC_GTEST_PROP(Writers, BringLinesAndPointsBackFromObjAndVtp, ()) {
  const Chain chain = as_lines(any_chain());
  for (const std::string name : {"a.obj", "a.vtp"}) {
    if (!ReaderRegistry::instance().knows(name)) continue;
    const CurveFile curves = again(name, {chain});
    RC_ASSERT(curves.has_radii == (name == "a.vtp"));
    RC_ASSERT(same_bits(curves.spheres,
                        name == "a.vtp" ? std::vector<Sphere>(chain.spheres().begin(), chain.spheres().end())
                                        : without_radii(chain.spheres())));
    RC_ASSERT(curves.strand_first == chain.strands().first);
    RC_ASSERT(std::ranges::equal(curves.strand_closed, chain.strands().closed));
    RC_ASSERT(curves.warnings.empty());
  }
}

PeriodicBox any_box() {
  const auto number = [] { return *rc::gen::inRange(-999, 1000) / 7.0; };
  PeriodicBox box{{0, 0, 0}, number(), number(), number()};
  for (double& length : box.length) length = *rc::gen::arbitrary<bool>() ? std::abs(number()) : 0;
  box.length[*rc::gen::inRange<std::size_t>(0, 3)] = 1 + std::abs(number());
  return box;
}

RC_GTEST_PROP(Writers, BringTheBoxOfEachFrameBackFromXyz, (bool one_for_all)) {
  const Chain chain = any_chain();
  const std::uint32_t frames = *rc::gen::inRange(1u, 4u);
  std::vector<PeriodicBox> boxes(one_for_all ? 1 : frames);
  std::ranges::generate(boxes, any_box);
  const TestFile file("a.xyz", "");
  WriterRegistry::instance()
      .of(file.path())
      .write(file.path(),
             {0, frames, [&](std::uint32_t) { return ExportedFrame{chain}; }, Labels(), {}, boxes});
  const CurveFile curves = ReaderRegistry::instance().read(file.path());
  RC_ASSERT(curves.boxes.size() == frames);
  RC_ASSERT(curves.box_is_periodic);
  for (std::uint32_t f = 0; f < frames; ++f) RC_ASSERT(curves.boxes[f] == boxes[one_for_all ? 0 : f]);
}

/// The points of a file without their order.
std::multiset<std::array<float, 3>> points_of(const CurveFile& curves) {
  std::multiset<std::array<float, 3>> points;
  for (const Sphere& s : curves.spheres) points.insert({s.x, s.y, s.z});
  return points;
}

// Of every reader there is a sample. Lines come back in an order of their own, and a strand that is closed
// for two spheres is none of theirs.
TEST(Writers, BringEverySampleBack) {
  std::size_t samples = 0;
  for (const auto& entry : std::filesystem::directory_iterator(example(""))) {
    if (!ReaderRegistry::instance().knows(entry.path())) continue;
    ++samples;
    const CurveFile read = ReaderRegistry::instance().read(entry.path());
    const Chain chain(read.spheres, {read.strand_first, read.strand_closed});
    for (const std::string name : {"a.chain", "a.csv", "a.xyz"}) {
      const CurveFile curves = again(name, {chain}, read.labels);
      EXPECT_TRUE(same_bits(curves.spheres, read.spheres)) << entry.path() << name;
      EXPECT_EQ(curves.strand_first, read.strand_first) << entry.path() << name;
      EXPECT_EQ(curves.strand_closed, read.strand_closed) << entry.path() << name;
      for (std::uint32_t i = 0; name == "a.csv" && read.labels.size() > 0 && i < chain.size(); ++i)
        ASSERT_EQ(curves.labels.of(i), read.labels.of(i)) << entry.path();
    }
    for (const std::string name : {"a.obj", "a.vtp"}) {
      if (!ReaderRegistry::instance().knows(name)) continue;
      const CurveFile curves = again(name, {chain}, read.labels);
      EXPECT_EQ(points_of(curves), points_of(read)) << entry.path() << name;
      EXPECT_EQ(curves.strand_closed.size(), read.strand_closed.size()) << entry.path() << name;
      EXPECT_TRUE(curves.joints.empty()) << entry.path() << name;
    }
  }
  EXPECT_GE(samples, ReaderRegistry::instance().readers().size() - 2);  // pugixml and zlib may be absent
}

TEST(Writers, NameWhatThereIs) {
  try {
    WriterRegistry::instance().of("a.doc");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "a.doc: nothing writes '.doc' files; there are: .catena .chain .csv .obj .vtp .xyz");
  }
}

TEST(Writers, HaveExtensionsOfTheirOwn) {
  WriterRegistry registry;
  WriterInfo info{"A", {".a", ".b"}, false, false, false, false, false, false, "some lines"};
  registry.add(info, nullptr);
  info.name = "B", info.extensions = {".c", ".b"};
  EXPECT_THROW(registry.add(info, nullptr), std::logic_error);
  EXPECT_EQ(registry.writers().size(), 1u);
}

}  // namespace
}  // namespace catena
