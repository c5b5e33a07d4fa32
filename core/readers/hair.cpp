#include <fmt/format.h>

#include <numeric>

#include "catena/core/counted.h"
#include "catena/core/readers/binary_fields.h"
#include "catena/core/readers/reader.h"

/// Cem Yuksel's .hair: a header of 128 bytes, then the arrays that its bits announce: segments a strand
/// (u16), points, thickness, transparency, colours. A strand has one point more than segments; without the
/// array all have the default number. Thickness is a diameter; without its array the header's default counts
/// unless it is 0, which means that the file has no radii. All little-endian.
namespace catena {
namespace {

enum ArrayBit : std::uint32_t { segments = 1, points = 2, thickness = 4, transparency = 8, colours = 16 };

float radius_of(BinaryFields& fields) {
  const float diameter = fields.f32("thickness");
  if (diameter < 0) fields.fail(fmt::format("the thickness {} before this is negative", diameter));
  return diameter / 2;
}

std::vector<std::uint64_t> points_a_strand(BinaryFields& fields, std::uint32_t strands, std::uint32_t arrays,
                                           std::uint32_t default_segments) {
  if (arrays & segments) {
    fields.require(strands, 2, "segment counts");
  } else {
    // A strand has a point at least, so this also bounds the memory that a wrong count can ask for.
    fields.require(strands, 12, "first points of strands");
  }
  std::vector<std::uint64_t> size(strands, std::uint64_t{default_segments} + 1);
  if (arrays & segments)
    for (auto& points_here : size) points_here = std::uint64_t{fields.u16("segment count")} + 1;
  return size;
}

CurveFile read_hair(const std::filesystem::path& file, const ReadOptions& options) {
  BinaryFields fields(file);
  if (fields.text(4, "header") != "HAIR") fields.fail("the first four bytes are not HAIR");
  const std::uint32_t strands = fields.u32("number of strands");
  const std::uint32_t point_count = fields.u32("number of points");
  const std::uint32_t arrays = fields.u32("array bits");
  const std::uint32_t default_segments = fields.u32("default segments");
  // Not looked at where every point has its own.
  const float default_radius = arrays & thickness ? fields.raw_f32("thickness") : radius_of(fields);
  fields.skip(128 - fields.position(), "header bytes");
  if (!(arrays & points)) fields.fail("the header announces no array of points");

  const auto size = points_a_strand(fields, strands, arrays, default_segments);
  const std::uint64_t sum = std::accumulate(size.begin(), size.end(), std::uint64_t{0});
  if (sum != point_count)
    fields.fail(
        fmt::format("strands: {}, with points: {}, but the header says {}", strands, sum, point_count));

  fields.require(point_count, 12, "points");
  CurveFile curves(options);
  curves.spheres.reserve(point_count);
  for (const std::uint64_t points_here : size) {
    for (std::uint64_t i = 0; i < points_here; ++i) {
      const float x = fields.f32("x"), y = fields.f32("y"), z = fields.f32("z");
      curves.add_open_point(x, y, z);
    }
    curves.end_strand();
  }

  if (arrays & thickness) fields.require(point_count, 4, "thicknesses");
  for (Sphere& sphere : curves.spheres)
    sphere.radius = arrays & thickness ? radius_of(fields) : default_radius;
  curves.rounding.settle(curves.spheres, [](std::size_t k) { return k; });
  curves.has_radii = (arrays & thickness) || default_radius != 0;
  // Not needed, but a file that lacks what it announces is damaged, and then the points may be too.
  if (arrays & transparency) fields.skip(std::uint64_t{point_count} * 4, "transparency bytes");
  if (arrays & colours) fields.skip(std::uint64_t{point_count} * 12, "colour bytes");
  if (fields.left() > 0)
    curves.warnings.push_back(fmt::format("{} after the last array not read", counted(fields.left(), "byte")));
  return curves;
}

const RegisterReader registered{
    {"Cem Yuksel hair", {".hair"}, "binary strands; thickness is a diameter", "point number from 0"},
    read_hair};

}  // namespace
}  // namespace catena
