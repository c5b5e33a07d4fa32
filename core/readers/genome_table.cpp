#include <fmt/format.h>

#include <unordered_set>

#include "catena/core/counted.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// Genome models as tables, `chromosome position x y z` in blank, tab or comma-separated columns: the .3dg
/// files of dip-c, hickit and nuc_dynamics; more columns are not read. `#` starts a comment, a first line of
/// names is skipped. A chromosome (`chr1`, or `1(mat)` of a diploid cell) is a strand, so its rows stand
/// together in ascending positions. No radii.
namespace catena {
namespace {

class GenomeTable {
 public:
  GenomeTable(const std::filesystem::path& file, const ReadOptions& options)
      : lines_(file), curves_(options) {}

  CurveFile curves() {
    lines_.read_once();
    while (lines_.next()) {
      lines_.cut_comment('#');
      if (!lines_.line().empty()) read_row(lines_.columns());
    }
    curves_.end_strand();
    return std::move(curves_);
  }

 private:
  void read_row(const std::vector<std::string_view>& fields) {
    if (fields.size() < 5)
      lines_.fail(
          fmt::format("a row is 'chromosome position x y z', got {}", counted(fields.size(), "column")));
    const bool names_columns = fields[2] == "x" || fields[2] == "X";
    if (names_columns && curves_.spheres.empty()) return;
    const std::int64_t position = lines_.integer(fields[1], "position");
    auto& names = curves_.labels.strand_names;
    if (names.empty() || fields[0] != names.back())
      begin_chromosome(fields[0]);
    else if (position <= position_)
      lines_.fail(fmt::format("position {} of {} comes after {}; sort the table", position,
                              in_quotes(fields[0]), position_));
    position_ = position;
    curves_.add_point(lines_.coordinate(fields[2], "x"), lines_.coordinate(fields[3], "y"),
                      lines_.coordinate(fields[4], "z"));
    curves_.labels.add(fmt::format("{}:{}", fields[0], fields[1]));
  }

  void begin_chromosome(std::string_view name) {
    curves_.end_strand();
    if (!seen_.emplace(name).second)
      lines_.fail(fmt::format("chromosome {} comes back after another; sort the table", in_quotes(name)));
    curves_.labels.strand_names.emplace_back(name);
  }

  TextLines lines_;
  std::unordered_set<std::string> seen_;
  std::int64_t position_ = 0;
  CurveFile curves_;
};

const RegisterReader registered{
    {"genome table", {".3dg"}, "chromosome position x y z in columns; no radii", "chromosome:position"},
    read_by<GenomeTable>};

}  // namespace
}  // namespace catena
