#include <fmt/format.h>

#include "catena/core/counted.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// Reads what chain_format.h describes. Rule, strands and pairs may come in any order, the rule at most once.
namespace catena {
namespace {

using Fields = std::vector<std::string_view>;

class ChainText {
 public:
  ChainText(const std::filesystem::path& file, const ReadOptions& options) : lines_(file), curves_(options) {}

  CurveFile curves() {
    lines_.read_once();
    const Fields& first = next_fields("the line 'catena-chain 1'");
    if (first.size() != 2 || first[0] != "catena-chain")
      lines_.fail("the file does not start with 'catena-chain 1'");
    if (first[1] != "1")
      lines_.fail(fmt::format("version {} of the format is not known, only 1", in_quotes(first[1])));
    curves_.has_radii = true;
    while (read_item()) {
    }
    check_pairs();
    while (lines_.next()) {
      lines_.cut_comment('#');
      if (!lines_.line().empty()) lines_.fail("there is more after 'end'");
    }
    return std::move(curves_);
  }

 private:
  bool read_item() {
    const Fields& fields = next_fields("'end'");
    const std::string_view word = fields[0];
    if (word == "end" && fields.size() == 1) return false;
    if (word == "window" && fields.size() == 2)
      read_window(fields[1]);
    else if (word == "arc_window" && fields.size() == 2)
      read_arc_window(fields[1]);
    else if (word == "strand" && fields.size() == 3)
      read_strand(fields[1], fields[2]);
    else if (word == "pairs" && fields.size() == 2)
      read_pairs(fields[1], "pairs", curves_.exclusion.extra_pairs);
    else if (word == "joints" && fields.size() == 2)
      read_pairs(fields[1], "joints", curves_.joints);
    else
      lines_.fail(fmt::format(
          "{}: expected 'window K', 'arc_window F', 'strand open|closed N', 'pairs N', 'joints N' or 'end'",
          in_quotes(lines_.line())));
    return true;
  }

  void read_window(std::string_view text) {
    take_rule(Exclusion::Rule::index_window);
    curves_.exclusion.window = lines_.count(text, "window");
    if (curves_.exclusion.window < 1) lines_.fail("the window must be at least 1");
  }

  void read_arc_window(std::string_view text) {
    take_rule(Exclusion::Rule::arc_window);
    curves_.exclusion.window = 0;
    curves_.exclusion.factor = lines_.wide_real(text, "arc_window");
    if (!(curves_.exclusion.factor > 0)) lines_.fail("the arc_window must be above 0");
  }

  void take_rule(Exclusion::Rule rule) {
    if (has_rule_) lines_.fail("a second exclusion rule; keep one of them");
    has_rule_ = true;
    curves_.exclusion.rule = rule;
  }

  void read_strand(std::string_view kind, std::string_view size) {
    if (kind != "open" && kind != "closed")
      lines_.fail(fmt::format("a strand is open or closed, not {}", in_quotes(kind)));
    const bool closed = kind == "closed";
    const std::uint32_t count = limited_count(size, "number of spheres");
    for (std::uint32_t i = 0; i < count; ++i) {
      const Fields& fields = next_fields("a sphere");
      if (fields.size() != 4)
        lines_.fail(fmt::format("a sphere is 'x y z radius', got {}", counted(fields.size(), "column")));
      // Not coordinates of some other precision: the format is of binary32, so this rounding loses nothing.
      curves_.add_point(lines_.real(fields[0], "x"), lines_.real(fields[1], "y"), lines_.real(fields[2], "z"),
                        lines_.radius(fields[3]));
    }
    // Not end_strand, which forgets strands without spheres.
    curves_.strand_first.push_back(static_cast<std::uint32_t>(curves_.spheres.size()));
    curves_.strand_closed.push_back(closed);
  }

  void read_pairs(std::string_view size, const std::string& what, std::vector<Pair>& pairs) {
    const std::uint32_t count = limited_count(size, "number of " + what);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Fields& fields = next_fields("a pair");
      if (fields.size() != 2)
        lines_.fail(fmt::format("a pair is 'i j', got {}", counted(fields.size(), "column")));
      const Pair pair{lines_.count(fields[0], "i"), lines_.count(fields[1], "j")};
      if (pair.i == pair.j) lines_.fail(fmt::format("sphere {} cannot be its own neighbour", pair.i));
      pairs.push_back(pair);
      named_.push_back({pair, lines_.line_number()});
    }
  }

  // At the end only, as pairs may stand before the spheres that they name.
  void check_pairs() const {
    for (const auto& [pair, line] : named_)
      if (pair.i >= curves_.spheres.size() || pair.j >= curves_.spheres.size())
        lines_.fail_at(line, fmt::format("pair {} {} does not name two of the spheres, of which there are {}",
                                         pair.i, pair.j, curves_.spheres.size()));
  }

  std::uint32_t limited_count(std::string_view text, const std::string& what) const {
    const std::uint32_t count = lines_.count(text, what);
    if (count > lines_.bytes())
      lines_.fail(fmt::format("{} {} is more than a file of {} bytes can hold", what, count, lines_.bytes()));
    return count;
  }

  const Fields& next_fields(const std::string& wanted) {
    while (lines_.next()) {
      lines_.cut_comment('#');
      if (!lines_.line().empty()) return lines_.fields();
    }
    lines_.fail(fmt::format("the file is truncated: it ends where {} is due", wanted));
  }

  TextLines lines_;
  bool has_rule_ = false;
  struct Named {
    Pair pair;
    std::size_t line;
  };
  std::vector<Named> named_;  ///< all pairs and joints
  CurveFile curves_;
};

const RegisterReader registered{
    {"catena chain",
     {".chain"},
     "catena's own text: spheres, strands, exclusion rule and extra pairs, exactly",
     "sphere number from 0"},
    read_by<ChainText>};

}  // namespace
}  // namespace catena
