#include "catena/core/readers/usc_hair.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "catena/core/counted.h"
#include "catena/core/readers/binary_fields.h"
#include "catena/core/readers/file_bytes.h"

namespace catena {

bool may_be_usc_hair(const std::filesystem::path& file) {
  if (is_standard_input(file)) return false;
  const std::string head = first_bytes(file, 4);
  return head.size() == 4 && head.find('\0') != std::string::npos;
}

CurveFile read_usc_hair(const std::filesystem::path& file, const ReadOptions& options) {
  BinaryFields fields(file);
  const auto count = [&](const char* what) {
    const std::int32_t number = fields.i32(what);
    if (number < 0) fields.fail(fmt::format("the {} before this is {}", what, number));
    return static_cast<std::uint64_t>(number);
  };
  const std::uint64_t strands = count("number of strands");
  fields.require(strands, 4, "strands");
  CurveFile curves(options);
  for (std::uint64_t s = 0; s < strands; ++s) {
    const std::uint64_t points = count("number of points of a strand");
    fields.require(points, 12, "points");
    for (std::uint64_t k = 0; k < points; ++k) {
      const float x = fields.f32("x"), y = fields.f32("y"), z = fields.f32("z");
      curves.add_point(x, y, z);
    }
    curves.end_strand();
  }
  if (fields.left() > 0)
    curves.warnings.push_back(
        fmt::format("{} after the last strand not read", counted(fields.left(), "byte")));
  return curves;
}

namespace {

const RegisterReader registered{{"USC hair",
                                 {".usc"},
                                 "strands, binary; a .data that is no text is read so, too; no radii",
                                 "point number from 0"},
                                read_usc_hair};

}  // namespace
}  // namespace catena
