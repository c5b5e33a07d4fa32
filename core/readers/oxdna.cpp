#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/readers/curve_graph.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// oxDNA configurations, https://lorenzo-rovigatti.github.io/oxDNA/configurations.html: frames of `t = `, `b
/// = ` (the box), `E = ` and a line for each nucleotide, of which the centre of mass is taken. The strands
/// are in the topology that
/// --topology names, or in the file beside it that ends in .top: the old form, a line for each nucleotide
/// with its neighbours, and the new one, a line for each strand with its sequence. The box is periodic. No
/// radii.
namespace catena {
namespace {

struct OxdnaTopology {
  std::uint32_t nucleotides = 0;
  std::vector<Pair> bonds;
};

class TopologyText {
 public:
  explicit TopologyText(const std::filesystem::path& file) : lines_(file) {}

  OxdnaTopology topology() {
    lines_.read_once();
    if (!lines_.next() || lines_.fields().size() < 2)
      lines_.fail("a topology begins with its numbers of nucleotides and strands");
    topology_.nucleotides = lines_.count(lines_.fields()[0], "number of nucleotides");
    const bool by_strand = lines_.fields().back() == "5->3";
    while (lines_.next()) {
      lines_.cut_comment('#');
      if (!lines_.line().empty()) by_strand ? read_strand() : read_nucleotide();
    }
    if (seen_ != topology_.nucleotides)
      lines_.fail(fmt::format("the first line says {}, but {} follow",
                              counted(topology_.nucleotides, "nucleotide"), seen_));
    tie_neighbours();
    return std::move(topology_);
  }

 private:
  // `strand base neighbour-to-3' neighbour-to-5'`; -1 for none.
  void read_nucleotide() {
    const auto& fields = lines_.fields();
    if (fields.size() < 4)
      lines_.fail(
          fmt::format("a nucleotide is 'strand base n3 n5', got {}", counted(fields.size(), "column")));
    for (const std::size_t k : {2, 3}) {
      const std::int64_t other = lines_.integer(fields[k], "neighbour");
      if (other < -1 || other >= topology_.nucleotides)
        lines_.fail(fmt::format("neighbour {} is not one of {}", other,
                                counted(topology_.nucleotides, "nucleotide")));
      (k == 2 ? towards_3_ : towards_5_).push_back(other);
    }
    ++seen_;
  }

  void tie_neighbours() {
    const auto agree = [&](const std::vector<std::int64_t>& there, const std::vector<std::int64_t>& back) {
      for (std::size_t i = 0; i < there.size(); ++i)
        if (const std::int64_t j = there[i]; j == static_cast<std::int64_t>(i))
          lines_.fail(fmt::format("nucleotide {} is its own neighbour", i));
        else if (j >= 0 && back[static_cast<std::size_t>(j)] != static_cast<std::int64_t>(i))
          lines_.fail(fmt::format("nucleotide {} has the neighbour {}, which has {} on that side", i, j,
                                  back[static_cast<std::size_t>(j)]));
    };
    agree(towards_3_, towards_5_);
    agree(towards_5_, towards_3_);
    for (std::uint32_t i = 0; i < towards_3_.size(); ++i)
      if (towards_3_[i] >= 0) topology_.bonds.push_back({static_cast<std::uint32_t>(towards_3_[i]), i});
  }

  // `SEQUENCE key=value ...`; a base in brackets is a number, and one base.
  void read_strand() {
    const auto& fields = lines_.fields();
    const std::uint32_t first = seen_;
    bool in_brackets = false;
    for (const char c : fields[0]) {
      if (c == '(') in_brackets = true;
      if (!in_brackets || c == ')') ++seen_;
      if (c == ')') in_brackets = false;
    }
    for (std::uint32_t i = first; i + 1 < seen_; ++i) topology_.bonds.push_back({i, i + 1});
    const bool circular = std::ranges::any_of(fields, [&](auto field) { return says_circular(field); });
    if (circular && seen_ - first > 2) topology_.bonds.push_back({seen_ - 1, first});
  }

  // The words of oxDNA itself; what it would not understand may be meant as either.
  bool says_circular(std::string_view field) const {
    const std::string lower = lower_case(field);
    if (lower != "circular" && !lower.starts_with("circular=")) return false;
    const std::string word = lower.substr(std::min(lower.size(), std::string_view("circular=").size()));
    const auto is_one_of = [&](std::initializer_list<std::string_view> words) {
      return std::ranges::find(words, word) != words.end();
    };
    if (is_one_of({"true", "1", "yes", "yup"})) return true;
    if (is_one_of({"false", "0", "no", "nope"})) return false;
    lines_.fail(fmt::format("{}: a strand is circular=true or circular=false", in_quotes(field)));
  }

  TextLines lines_;
  std::uint32_t seen_ = 0;
  std::vector<std::int64_t> towards_3_, towards_5_;  ///< of the old form: the neighbour of each, -1 for none
  OxdnaTopology topology_;
};

std::filesystem::path topology_beside(std::filesystem::path file) {
  if (lower_case(file.extension().string()) == ".gz") file.replace_extension();
  return file.replace_extension(".top");
}

class Oxdna {
 public:
  Oxdna(const std::filesystem::path& file, const ReadOptions& options)
      : lines_(file), topology_(TopologyText(topology_of(file, options)).topology()), curves_(options) {}

  CurveFile curves() {
    lines_.read_once();
    bool more = lines_.next();
    if (!more) lines_.fail("the file has no frame");
    for (std::size_t frame = 0; more; ++frame) {
      if (frame > 0) curves_.begin_later_frame();
      more = read_frame(frame);
    }
    lines_.forget();
    for (const std::uint32_t nucleotide : arrange_along_edges(curves_, topology_.bonds, true))
      curves_.labels.add(std::int64_t{nucleotide});
    return std::move(curves_);
  }

 private:
  static std::filesystem::path topology_of(const std::filesystem::path& file, const ReadOptions& options) {
    if (!options.topology.empty()) return options.topology;
    const auto beside = topology_beside(file);
    std::error_code unknown;
    if (is_standard_input(file) || !std::filesystem::exists(beside, unknown))
      throw InputError(fmt::format(
          "{}: the strands are in oxDNA's topology; name it with --topology FILE.top", shown_name(file)));
    return beside;
  }

  /// From its first line, which is current; true when another frame follows.
  bool read_frame(std::size_t frame) {
    bool has_box = false;
    std::uint32_t nucleotides = 0;
    do {
      const auto& fields = lines_.fields();
      if (fields.empty()) continue;
      if (fields.size() > 1 && fields[1] == "=") {
        if (fields[0] == "t" && (has_box || nucleotides > 0)) break;
        if (fields[0] == "b" && has_box) lines_.fail("a second box of this frame");
        if (fields[0] == "b") read_box(fields), has_box = true;
      } else {
        read_nucleotide(fields, ++nucleotides, frame);
      }
    } while (lines_.next());
    if (!has_box) lines_.fail(fmt::format("frame {} has no line 'b = X Y Z'", frame));
    if (nucleotides != topology_.nucleotides)
      lines_.fail(fmt::format("frame {} has {}, the topology {}", frame, counted(nucleotides, "nucleotide"),
                              topology_.nucleotides));
    return !lines_.fields().empty() && lines_.fields()[0] == "t";
  }

  void read_box(const std::vector<std::string_view>& fields) {
    if (fields.size() != 5) lines_.fail("the box is 'b = X Y Z'");
    PeriodicBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) box.length[axis] = lines_.wide_real(fields[2 + axis], "box");
    if (!curves_.boxes.empty() && box.repeats() != curves_.boxes.front().repeats())
      lines_.fail("this frame and the first differ in having a periodic box");
    curves_.boxes.push_back(box);
  }

  void read_nucleotide(const std::vector<std::string_view>& fields, std::uint32_t number, std::size_t frame) {
    if (fields.size() < 3)
      lines_.fail(fmt::format("a nucleotide begins with x y z, got {}", counted(fields.size(), "column")));
    if (number > topology_.nucleotides)
      lines_.fail(
          fmt::format("frame {} has more nucleotides than the topology's {}", frame, topology_.nucleotides));
    curves_.add_point(lines_.coordinate(fields[0], "x"), lines_.coordinate(fields[1], "y"),
                      lines_.coordinate(fields[2], "z"));
  }

  TextLines lines_;
  OxdnaTopology topology_;
  CurveFile curves_;
};

const RegisterReader registered{{"oxDNA configuration",
                                 {".oxdna", ".conf", ".dat"},
                                 "nucleotides along the strands of a topology, all frames; the box; no radii",
                                 "nucleotide from 0",
                                 {"--topology"},
                                 topology_beside},
                                read_by<Oxdna>};

}  // namespace
}  // namespace catena
