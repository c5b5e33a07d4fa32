// Which frame and which strands a writer writes.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "catena/core/readers/test_file.h"
#include "catena/core/writers/writer.h"

namespace catena {
namespace {

std::string written(const std::string& name, std::uint32_t first, std::uint32_t last,
                    const std::function<Chain(std::uint32_t)>& chain_of,
                    const std::vector<PeriodicBox>& boxes = {}) {
  const TestFile file(name, "");
  WriterRegistry::instance()
      .of(file.path())
      .write(file.path(),
             {first, last, [&](std::uint32_t f) { return ExportedFrame{chain_of(f)}; }, Labels(), {}, boxes});
  std::ostringstream text;
  text << std::ifstream(file.path(), std::ios::binary).rdbuf();
  return text.str();
}

/// Of a series the frame that is asked for is as if it were alone.
TEST(Writers, WriteTheFrameThatIsAskedFor) {
  const auto chain_of = [](std::uint32_t f) {
    return Chain({{static_cast<float>(f), 0, 0, 1}, {5, static_cast<float>(f), 0, 1}});
  };
  for (const WriterInfo& info : WriterRegistry::instance().writers()) {
    const std::string name = "a" + info.extensions.front();
    const std::string second = written(name, 2, 3, chain_of);
    EXPECT_EQ(second, written(name, 0, 1, [&](std::uint32_t) { return chain_of(2); })) << name;
    EXPECT_NE(second, written(name, 0, 1, chain_of)) << name;
    if (info.frames) {
      EXPECT_EQ(written(name, 1, 3, chain_of), written(name, 1, 2, chain_of) + second) << name;
    }
  }
}

/// In its own box, or in that of all.
TEST(Writers, WriteTheBoxOfTheFrameThatIsAskedFor) {
  const auto chain_of = [](std::uint32_t) { return Chain({{0, 0, 0, 1}, {5, 0, 0, 1}}); };
  const std::vector<PeriodicBox> boxes{{{9, 9, 9}}, {{8, 9, 0}, 1}, {{9, 7, 9}, 0, 2, 1}};
  for (const WriterInfo& info : WriterRegistry::instance().writers()) {
    if (!info.box) continue;
    const std::string name = "a" + info.extensions.front();
    for (const std::uint32_t f : {0u, 1u, 2u}) {
      EXPECT_EQ(written(name, f, f + 1, chain_of, boxes), written(name, 0, 1, chain_of, {boxes[f]})) << name;
      EXPECT_EQ(written(name, f, f + 1, chain_of, {boxes[2]}), written(name, 0, 1, chain_of, {boxes[2]}))
          << name;
    }
    EXPECT_NE(written(name, 1, 2, chain_of, boxes), written(name, 0, 1, chain_of, boxes)) << name;
    if (info.frames) {
      EXPECT_EQ(written(name, 1, 3, chain_of, boxes),
                written(name, 1, 2, chain_of, boxes) + written(name, 2, 3, chain_of, boxes))
          << name;
    }
  }
}

TEST(Writers, WriteNoLineForAStrandWithoutSpheres) {
  const auto chain_of = [](std::uint32_t) {
    return Chain(std::vector<Sphere>(3), {{0, 0, 2, 2, 3, 3}, {0, 0, 1, 0, 0}});
  };
  EXPECT_EQ(written("a.obj", 0, 1, chain_of), "v 0 0 0\nv 0 0 0\nv 0 0 0\nl 1 2\np 3\n");
}

/// So that an arc window crosses branches in it as in the file that it came from.
TEST(Writers, BringJointsBackFromChain) {
  const TestFile file("a.chain", "");
  const std::vector<Pair> joints{{1, 2}};
  const Chain chain({{0, 0, 0, 1}, {5, 0, 0, 1}, {5, 5, 0, 1}}, {{0, 2, 3}, {0, 0}});
  WriterRegistry::instance()
      .of(file.path())
      .write(file.path(), {0, 1, [&](std::uint32_t) { return ExportedFrame{chain}; }, Labels(), joints});
  EXPECT_EQ(ReaderRegistry::instance().read(file.path()).joints, joints);
}

TEST(Writers, NumberStrandsFrom0InXyz) {
  const auto chain_of = [](std::uint32_t) {
    return Chain({{0, 0, 0, 1}, {5, 0, 0, 2}, {9, 0, 0.5f, 1}}, {{0, 2, 3}, {1, 0}});
  };
  EXPECT_EQ(written("a.xyz", 0, 1, chain_of),
            "3\nProperties=species:S:1:pos:R:3:radius:R:1:strand:I:1:closed:I:1\n"
            "X 0 0 0 1 0 1\nX 5 0 0 2 0 1\nX 9 0 0.5 1 1 0\n");
}

}  // namespace
}  // namespace catena
