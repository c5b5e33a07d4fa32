#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

#include "catena/core/readers/test_bytes.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_floats.h"

namespace catena {
namespace {

struct Curve {
  std::vector<Sphere> points;
  bool closed;
};

std::string header(const std::string& start, std::uint64_t curves, std::uint64_t points) {
  std::string bytes = start;
  append(bytes, curves), append(bytes, points);
  bytes.resize(64, 'i');
  return bytes;
}

std::string bcc_of(const std::string& type, const std::vector<Curve>& curves) {
  std::uint64_t points = 0;
  for (const Curve& curve : curves) points += curve.points.size();
  std::string bytes = header("BCCD" + type + "\3\2", curves.size(), points);
  for (const auto& [these, closed] : curves) {
    const auto count = static_cast<std::int32_t>(these.size());
    append(bytes, closed ? -count : count);
    for (const Sphere& p : these) append(bytes, p.x), append(bytes, p.y), append(bytes, p.z);
  }
  return bytes;
}

RC_GTEST_PROP(BccReader, ReadsWhatIsWritten, ()) {
  std::vector<Curve> curves(*rc::gen::inRange<std::size_t>(1, 5));
  for (auto& [points, closed] : curves) {
    closed = *rc::gen::arbitrary<bool>();
    for (auto left = *rc::gen::inRange(1, 6); left > 0; --left)
      points.push_back({*any_finite(), *any_finite(), *any_finite(), 0});
  }
  const CurveFile read = read_text("a.bcc", bcc_of(*rc::gen::element<std::string>("C0", "C1", "C2", "PL"), curves));
  RC_ASSERT(read.strand_closed.size() == curves.size());
  RC_ASSERT(!read.has_radii);
  RC_ASSERT(read.warnings.empty());
  std::size_t at = 0;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    RC_ASSERT(bool{read.strand_closed[c] != 0} == curves[c].closed);
    for (const Sphere& p : curves[c].points) RC_ASSERT(read.spheres[at++] == p);
  }
  RC_ASSERT(at == read.spheres.size());
}

TEST(BccReader, SaysWhatIsWrong) {
  const std::string one = bcc_of("C0", {{{{1, 2, 3, 0}}, false}});
  EXPECT_EQ(read_text("a.bcc", one + "x").warnings.size(), 1u);
  EXPECT_COMPLAINT(" byte 3: the first three bytes are not BCC", "a.bcc", "HAIR");
  EXPECT_COMPLAINT(" byte 4: the numbers have 8 and 8 bytes", "a.bcc", "BCC\x88" + one.substr(4));
  EXPECT_COMPLAINT(" byte 4: the numbers have 8 and 4 bytes", "a.bcc", "BCC\x84" + one.substr(4));
  EXPECT_COMPLAINT(" byte 4: the numbers have 4 and 8 bytes", "a.bcc", "BCC\x48" + one.substr(4));
  EXPECT_COMPLAINT(" byte 80: curves: 1, with control points: 1, but the header says 2", "a.bcc",
                   header("BCCDC0\3\2", 1, 2) + one.substr(64) + std::string(12, '\0'));
  EXPECT_COMPLAINT(" byte 6: curves of type 'B0' are not known to go through", "a.bcc", "BCCDB0" + one.substr(6));
  for (const std::string type : {"CH", "CB", "C9", "P0"})
    EXPECT_COMPLAINT(" byte 6: curves of type '" + type + "'", "a.bcc", "BCCD" + type + one.substr(6));
  EXPECT_COMPLAINT(" byte 7: the curves have 2 dimensions", "a.bcc", "BCCDC0\2" + one.substr(7));
  EXPECT_COMPLAINT(" byte 80: curves: 1, with control points: 1, but the header says 0", "a.bcc",
                   header("BCCDPL\3\2", 1, 0) + one.substr(64));
  EXPECT_COMPLAINT(" byte ", "a.bcc", one.substr(0, one.size() - 1));
  for (const std::uint64_t many : {std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    EXPECT_COMPLAINT(" byte 64: the file is truncated", "a.bcc",
                     header("BCCDC0\3\2", many, 1) + one.substr(64));
    EXPECT_COMPLAINT(" byte 64: the file is truncated", "a.bcc",
                     header("BCCDC0\3\2", 1, many) + one.substr(64));
  }
  std::string least = header("BCCDC0\3\2", 1, 0);
  append(least, std::int32_t{-2147483647 - 1});
  EXPECT_COMPLAINT(" byte 68: the file is truncated", "a.bcc", least);
}

}  // namespace
}  // namespace catena
