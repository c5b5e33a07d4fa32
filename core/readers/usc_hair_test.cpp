#include "catena/core/readers/usc_hair.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>


#include "catena/core/readers/test_bytes.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_floats.h"

namespace catena {
namespace {

// As .usc, and as the .data that its publishers write; a strand may have one point, or none.
RC_GTEST_PROP(UscHair, ReadsWhatIsWritten, ()) {
  const auto strands = *rc::gen::inRange(1, 6);
  std::string bytes;
  append(bytes, static_cast<std::int32_t>(strands));
  std::vector<Sphere> all;
  std::vector<std::uint32_t> first{0};
  for (auto left = strands; left > 0; --left) {
    const auto points = *rc::gen::inRange(strands == 1 ? 1 : 0, 5);
    append(bytes, static_cast<std::int32_t>(points));
    for (int k = 0; k < points; ++k) {
      const Sphere p{*any_finite(), *any_finite(), *any_finite(), 0};
      append(bytes, p.x), append(bytes, p.y), append(bytes, p.z);
      all.push_back(p);
    }
    if (points > 0) first.push_back(static_cast<std::uint32_t>(all.size()));
  }
  RC_PRE(!all.empty());
  for (const char* name : {"a.usc", "a.data"}) {
    const CurveFile read = read_text(name, bytes);
    RC_ASSERT(read.spheres == all);
    RC_ASSERT(read.strand_first == first);
    RC_ASSERT(!read.has_radii);
    RC_ASSERT(read.warnings.empty());
  }
}

TEST(UscHair, SaysWhatIsWrong) {
  std::string bytes;
  append(bytes, 1), append(bytes, 1), append(bytes, 1.f), append(bytes, 2.f), append(bytes, 3.f);
  EXPECT_EQ(read_text("a.data", bytes + "x").warnings,
            std::vector<std::string>{"1 byte after the last strand not read"});
  EXPECT_COMPLAINT(" byte 8: the file is truncated: 11 bytes left, too few for points (12 bytes)", "a.data",
                   bytes.substr(0, bytes.size() - 1));
  std::string negative = bytes;
  negative[7] = '\xff';
  EXPECT_COMPLAINT(" byte 8: the number of points of a strand before this is -16777215", "a.usc", negative);
  EXPECT_COMPLAINT(" byte 4: the file is truncated", "a.usc", std::string("\0\0\0\x70", 4));
}

}  // namespace
}  // namespace catena
