#include <fmt/format.h>

#include <cmath>

#include "catena/core/readers/binary_fields.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// MRtrix tracks,
/// https://mrtrix.readthedocs.io/en/latest/getting_started/image_data.html#tracks-file-format-tck: lines
/// `key: value` up to END, then from the offset that `file: . N` says triples of 32 or 64-bit floats. NaN
/// ends a track, infinity the file. No radii; the header's count may be wrong and is not looked at.
namespace catena {
namespace {

class Tracks {
 public:
  Tracks(const std::filesystem::path& file, const ReadOptions& options) : fields_(file), curves_(options) {}

  CurveFile curves() {
    if (trimmed(fields_.line("the header")) != "mrtrix tracks")
      fields_.fail_at_line("the file does not start with 'mrtrix tracks'");
    read_header();
    while (read_point()) {
    }
    curves_.end_strand();
    return std::move(curves_);
  }

 private:
  void read_header() {
    bool has_type = false, has_place = false;
    std::uint64_t offset = 0;
    for (std::string_view line; (line = trimmed(fields_.line("the header's END"))) != "END";) {
      const std::size_t colon = line.find(':');
      if (colon == std::string_view::npos) continue;
      const std::string key = lower_case(trimmed(line.substr(0, colon)));
      const std::string_view value = trimmed(line.substr(colon + 1));
      if (key == "datatype") set_type(value), has_type = true;
      if (key == "file") offset = offset_of(value), has_place = true;
    }
    if (!has_type || !has_place) fields_.fail_at_line("the header lacks 'datatype:' or 'file: . OFFSET'");
    if (offset < fields_.position())
      fields_.fail_at_line(fmt::format("the tracks are said to begin at byte {}, inside the header", offset));
    fields_.go_to(offset);
  }

  void set_type(std::string_view type) {
    const bool big = type.ends_with("BE");
    if (type != "Float32LE" && type != "Float32BE" && type != "Float64LE" && type != "Float64BE")
      fields_.fail_at_line(fmt::format(
          "the datatype {} is not one of Float32LE, Float32BE, Float64LE and Float64BE", in_quotes(type)));
    fields_.set_order(big ? BinaryFields::Order::big : BinaryFields::Order::little);
    wide_ = type.starts_with("Float64");
  }

  std::uint64_t offset_of(std::string_view place) const {
    if (!place.starts_with(". "))
      fields_.fail_at_line(fmt::format("the tracks are in another file: {}", in_quotes(place)));
    const auto [offset, problem] = parse_integer(trimmed(place.substr(1)));
    if (!problem.empty() || offset < 0)
      fields_.fail_at_line(fmt::format("the offset in {} is no position", in_quotes(place)));
    return static_cast<std::uint64_t>(offset);
  }

  double number() { return wide_ ? fields_.raw_f64("coordinate") : double{fields_.raw_f32("coordinate")}; }

  bool read_point() {
    if (fields_.left() == 0) {
      curves_.warnings.emplace_back("the file ends without the infinities that are due; tracks may be missing");
      return false;
    }
    const double x = number(), y = number(), z = number();
    if (std::isinf(x) && std::isinf(y) && std::isinf(z)) return false;
    if (std::isnan(x) && std::isnan(y) && std::isnan(z)) {
      curves_.end_strand();
      return true;
    }
    for (const double value : {x, y, z})
      if (!std::isfinite(static_cast<float>(value)))
        fields_.fail(fmt::format("the coordinate {} before this is no finite 32-bit float", value));
    curves_.add_point(x, y, z);
    return true;
  }

  BinaryFields fields_;
  bool wide_ = false;
  CurveFile curves_;
};

const RegisterReader registered{{"MRtrix tracks", {".tck"}, "streamlines; no radii", "point number from 0"},
                                read_by<Tracks>};

}  // namespace
}  // namespace catena
