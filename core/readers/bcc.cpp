#include <fmt/format.h>

#include <cstdint>

#include "catena/core/counted.h"
#include "catena/core/readers/binary_fields.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/reader.h"

/// Cem Yuksel's Binary Curve Collection, of his yarn-level cloth models,
/// http://www.cemyuksel.com/cyCodeBase/soln/using_bcc_files.html: a header of 64 bytes (BCC, bytes of an
/// integer and of a float, type of the curves, dimensions, which of them is up, curves, control points, a
/// text), then for each curve its number of control points (negative: closed) and three floats for each.
/// Little-endian. C with a digit for its parameters is a Catmull-Rom curve, which goes through its control
/// points, PL a polyline; of other curves the control points are no points. No radii.
namespace catena {
namespace {

void check_header(BinaryFields& fields) {
  if (fields.text(3, "header") != "BCC") fields.fail("the first three bytes are not BCC");
  if (const auto sizes = fields.unsigned_of(1, "header"); sizes != 0x44)
    fields.fail(
        fmt::format("the numbers have {} and {} bytes; four and four are read", sizes >> 4, sizes & 15));
  const std::string type(fields.text(2, "type of the curves"));
  if (type != "C0" && type != "C1" && type != "C2" && type != "PL")
    fields.fail(
        fmt::format("curves of type {} are not known to go through their control points; Catmull-Rom curves "
                    "(C0, C1, C2) and polylines (PL) are read",
                    in_quotes(type)));
  if (const auto dimensions = fields.unsigned_of(1, "dimensions"); dimensions != 3)
    fields.fail(fmt::format("the curves have {}; three are read", counted(dimensions, "dimension")));
  fields.skip(1, "upward dimension");
}

CurveFile read_bcc(const std::filesystem::path& file, const ReadOptions& options) {
  BinaryFields fields(file);
  check_header(fields);
  const std::uint64_t curve_count = fields.unsigned_of(8, "number of curves"),
                      points = fields.unsigned_of(8, "number of control points");
  fields.skip(40, "text");
  fields.require(curve_count, 4, "curves");
  fields.require(points, 12, "control points");
  CurveFile curves(options);
  curves.spheres.reserve(points);
  for (std::uint64_t c = 0; c < curve_count; ++c) {
    const std::int64_t count = fields.i32("number of points of a curve");
    const auto size = static_cast<std::uint64_t>(count < 0 ? -count : count);
    fields.require(size, 12, "control points");
    for (std::uint64_t k = 0; k < size; ++k) {
      const float x = fields.f32("x"), y = fields.f32("y"), z = fields.f32("z");
      curves.add_point(x, y, z);
    }
    curves.end_strand(count < 0);
  }
  if (curves.spheres.size() != points)
    fields.fail(fmt::format("curves: {}, with control points: {}, but the header says {}", curve_count,
                            curves.spheres.size(), points));
  if (fields.left() > 0)
    curves.warnings.push_back(
        fmt::format("{} after the last curve not read", counted(fields.left(), "byte")));
  return curves;
}

const RegisterReader registered{{"Binary Curve Collection",
                                 {".bcc"},
                                 "yarns: control points of curves, open or closed; no radii",
                                 "point number from 0"},
                                read_bcc};

}  // namespace
}  // namespace catena
