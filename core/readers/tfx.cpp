#include <fmt/format.h>

#include "catena/core/readers/binary_fields.h"
#include "catena/core/readers/reader.h"

/// AMD TressFX hair of version 4, https://github.com/GPUOpen-Effects/TressFX: a header of 160 bytes (version,
/// strands, points a strand, where the points begin), then four floats a point, of which the last is a weight
/// of the simulation and no radius. Little-endian. Other arrays are not read. No radii.
namespace catena {
namespace {

constexpr std::uint32_t header_size = 160;

CurveFile read_tfx(const std::filesystem::path& file, const ReadOptions& options) {
  BinaryFields fields(file);
  if (const float version = fields.f32("version"); version != 4)
    fields.fail(fmt::format("the version is {}; TressFX hair of version 4 is read", version));
  const std::uint32_t strands = fields.u32("number of strands"), size = fields.u32("points of a strand"),
                      offset = fields.u32("offset of the points");
  if (offset < header_size)
    fields.fail(
        fmt::format("the points are said to begin at byte {}, in the header of {}", offset, header_size));
  fields.go_to(offset);
  const std::uint64_t points = std::uint64_t{strands} * size;
  fields.require(points, 16, "points");
  CurveFile curves(options);
  curves.spheres.reserve(points);
  for (std::uint32_t s = 0; s < strands && size > 0; ++s) {
    for (std::uint32_t k = 0; k < size; ++k) {
      const float x = fields.f32("x"), y = fields.f32("y"), z = fields.f32("z");
      curves.add_point(x, y, z);
      fields.skip(4, "weight");
    }
    curves.end_strand();
  }
  return curves;
}

const RegisterReader registered{
    {"TressFX hair", {".tfx"}, "strands of version 4; no radii", "point number from 0"}, read_tfx};

}  // namespace
}  // namespace catena
