#include <fmt/format.h>

#include <unordered_set>

#include "catena/core/counted.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// Genome models of Nucle3D and g3d: lines `KEY<tab>value`, of which `CHR name` begins a chromosome, then
/// `bin,x,y,z` rows, or `bin,x,y,z,haplotype`. A chromosome, and in it each haplotype, is a strand, so its
/// rows stand together in ascending bins; bins that are missing do not end it. No radii.
namespace catena {
namespace {

class Nucle3d {
 public:
  Nucle3d(const std::filesystem::path& file, const ReadOptions& options) : lines_(file), curves_(options) {}

  CurveFile curves() {
    lines_.read_once();
    while (lines_.next()) {
      lines_.cut_comment('#');
      if (!lines_.line().empty()) read_line();
    }
    curves_.end_strand();
    return std::move(curves_);
  }

 private:
  void read_line() {
    const auto& words = lines_.fields();
    if (words[0] == "CHR") {
      if (words.size() != 2) lines_.fail("a chromosome is 'CHR name'");
      chromosome_ = words[1];
      new_strand_ = true;
    } else if (words.size() == 1 || is_integer(words[0].substr(0, words[0].find(',')))) {
      read_point(lines_.columns());
    }  // else TITLE, GENOME, BINSIZE
  }

  void read_point(const std::vector<std::string_view>& fields) {
    if (chromosome_.empty()) lines_.fail("a point before the first 'CHR name'");
    if (fields.size() != 4 && fields.size() != 5)
      lines_.fail(fmt::format("a point is 'bin,x,y,z' and perhaps a haplotype, got {}",
                              counted(fields.size(), "column")));
    const std::string haplotype(fields.size() == 5 ? fields[4] : "");
    const bool starts = new_strand_ || haplotype != haplotype_;
    const std::int64_t bin = lines_.integer(fields[0], "bin");
    if (!starts && bin <= bin_)
      lines_.fail(fmt::format("bin {} of {} comes after {}; sort the rows", bin,
                              in_quotes(curves_.labels.strand_names.back()), bin_));
    bin_ = bin;
    if (starts) begin_strand(haplotype);
    curves_.add_point(lines_.coordinate(fields[1], "x"), lines_.coordinate(fields[2], "y"),
                      lines_.coordinate(fields[3], "z"));
    curves_.labels.add(fmt::format("{}:{}", curves_.labels.strand_names.back(), fields[0]));
  }

  void begin_strand(const std::string& haplotype) {
    curves_.end_strand();
    new_strand_ = false;
    haplotype_ = haplotype;
    std::string name = haplotype.empty() ? chromosome_ : chromosome_ + "/" + haplotype;
    if (!seen_.insert(name).second)
      lines_.fail(fmt::format("{} comes back after another; sort the rows", in_quotes(name)));
    curves_.labels.strand_names.push_back(std::move(name));
  }

  TextLines lines_;
  std::string chromosome_, haplotype_;
  std::unordered_set<std::string> seen_;
  bool new_strand_ = false;
  std::int64_t bin_ = 0;
  CurveFile curves_;
};

const RegisterReader registered{{"nucle3d genome",
                                 {".nucle3d"},
                                 "a strand for each chromosome and haplotype; no radii",
                                 "chromosome:bin"},
                                read_by<Nucle3d>};

}  // namespace
}  // namespace catena
