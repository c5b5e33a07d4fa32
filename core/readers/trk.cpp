#include <fmt/format.h>

#include "catena/core/counted.h"
#include "catena/core/readers/binary_fields.h"
#include "catena/core/readers/reader.h"

/// TrackVis tracks, https://trackvis.org/docs/?subsect=fileformat: a header of 1000 bytes, then for each
/// track its number of points, and for each point three floats and the scalars; the track's properties
/// follow. The byte order is that in which the header's last field says 1000. Coordinates are taken as they
/// are stored, in millimetres from the corner of the first voxel; the header's matrix, which only turns and
/// shifts them, is not applied. No radii.
namespace catena {
namespace {

constexpr std::uint32_t header_size = 1000;

class Trk {
 public:
  Trk(const std::filesystem::path& file, const ReadOptions& options) : fields_(file), curves_(options) {}

  CurveFile curves() {
    if (fields_.text(5, "header") != "TRACK") fields_.fail("the file does not start with TRACK");
    fields_.require(header_size - 5, 1, "header bytes");
    fields_.go_to(header_size - 4);
    if (fields_.u32("header size") != header_size) {
      fields_.set_order(BinaryFields::Order::big);
      fields_.go_to(header_size - 4);
      if (fields_.u32("header size") != header_size)
        fields_.fail("the header does not say that it has 1000 bytes");
    }
    fields_.go_to(36);
    const std::uint16_t scalars = fields_.u16("number of scalars");
    fields_.go_to(238);
    const std::uint16_t properties = fields_.u16("number of properties");
    fields_.go_to(988);
    const std::int32_t announced = fields_.i32("number of tracks");
    fields_.go_to(header_size);

    std::int64_t tracks = 0;
    for (; fields_.left() > 0; ++tracks) read_track(scalars, properties);
    if (announced > 0 && announced != tracks)  // 0 says that it is not known
      curves_.warnings.push_back(fmt::format("the header says {}, the file has {}; all of them are read",
                                             counted(announced, "track"), tracks));
    return std::move(curves_);
  }

 private:
  void read_track(std::uint64_t scalars, std::uint64_t properties) {
    const std::uint32_t points = fields_.u32("number of points");
    fields_.require(points, 4 * (3 + scalars), "points");
    for (std::uint32_t p = 0; p < points; ++p) {
      const float x = fields_.f32("x"), y = fields_.f32("y"), z = fields_.f32("z");
      curves_.add_point(x, y, z);
      fields_.skip(4 * scalars, "scalars");
    }
    fields_.skip(4 * properties, "properties");
    curves_.end_strand();
  }

  BinaryFields fields_;
  CurveFile curves_;
};

const RegisterReader registered{
    {"TrackVis tracks", {".trk"}, "streamlines, as stored; no radii", "point number from 0"}, read_by<Trk>};

}  // namespace
}  // namespace catena
