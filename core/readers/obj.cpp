#include <fmt/format.h>

#include <set>

#include "catena/core/counted.h"
#include "catena/core/readers/curve_graph.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// Wavefront OBJ: the vertices that `l` lines join and `p` points name. An index counts from 1, or back from
/// the last vertex when negative; what stands behind a slash, and more columns of a vertex, are not read.
/// Lines that share vertices are branches. Faces are surfaces, and free-form curves are not sampled, so they
/// are left out with a warning. No radii.
namespace catena {
namespace {

class Obj {
 public:
  Obj(const std::filesystem::path& file, const ReadOptions& options) : lines_(file), curves_(options) {}

  CurveFile curves() {
    lines_.read_once();
    // The most that can be there: memory that is not touched is none, and growing would take twice what is.
    curves_.spheres.reserve(lines_.bytes() / 8);
    edges_.reserve(lines_.bytes() / 6);
    while (lines_.next()) {
      lines_.cut_comment('#');
      if (!lines_.line().empty()) read_statement();
    }
    if (!pending_.empty()) lines_.fail("the last line goes on, but the file ends");
    if (!edges_.empty() && greatest_ >= static_cast<std::int64_t>(curves_.spheres.size()))
      lines_.fail_at(greatest_line_,
                     fmt::format("vertex {} of {} is named", greatest_ + 1, curves_.spheres.size()));
    if (edges_.empty())
      lines_.fail(
          fmt::format("the file has no lines ('l 1 2 3'), but vertices: {}, faces: {}, free-form curves: {}; "
                      "convert curves to polylines, and export edges",
                      curves_.spheres.size(), faces_, free_form_));
    return arranged();
  }

 private:
  void read_statement() {
    const auto& fields = lines_.fields();
    const bool goes_on = fields.back() == "\\";
    if (pending_.empty() && !goes_on) return read(fields);
    for (const auto field : fields)
      if (field != "\\") pending_.emplace_back(field);
    if (goes_on) return;
    read({pending_.begin(), pending_.end()});
    pending_.clear();
  }

  void read(const std::vector<std::string_view>& fields) {
    if (fields[0] == "v") {
      if (fields.size() < 4)
        lines_.fail(fmt::format("a vertex needs three coordinates, got {}", fields.size() - 1));
      curves_.add_open_point(lines_.coordinate(fields[1], "x"), lines_.coordinate(fields[2], "y"),
                             lines_.coordinate(fields[3], "z"));
    } else if (fields[0] == "l") {
      if (fields.size() < 3) lines_.fail("a line needs two vertices");
      std::uint32_t before = vertex(fields[1]);
      for (std::size_t k = 2; k < fields.size(); ++k) {
        const std::uint32_t here = vertex(fields[k]);
        edges_.push_back({before, here});
        before = here;
      }
    } else if (fields[0] == "p") {
      if (fields.size() < 2) lines_.fail("a point needs a vertex");
      for (std::size_t k = 1; k < fields.size(); ++k) {
        const std::uint32_t here = vertex(fields[k]);
        edges_.push_back({here, here});
      }
    } else if (fields[0] == "f") {
      ++faces_;
    } else if (fields[0] == "curv") {
      ++free_form_;
    } else if (!is_statement(fields[0]) && unknown_++ == 0) {
      first_unknown_ =
          fmt::format("line {}: {} is no statement of OBJ", lines_.line_number(), in_quotes(fields[0]));
    }
  }

  /// Of those that say nothing of points or lines. What is none may be damaged, and the numbers of vertices
  /// with it.
  static bool is_statement(std::string_view word) {
    static const std::set<std::string_view> words{
        "vt",     "vn",       "vp",       "g",          "o",         "s",    "mg",   "usemtl", "mtllib",
        "usemap", "maplib",   "lod",      "bevel",      "cstype",    "deg",  "bmat", "step",   "curv2",
        "surf",   "parm",     "trim",     "hole",       "scrv",      "sp",   "end",  "con",    "ctech",
        "stech",  "c_interp", "d_interp", "shadow_obj", "trace_obj", "call", "csh"};
    return words.contains(word);
  }

  /// From 0. Whether there is such a vertex is known at the end, as it may follow.
  std::uint32_t vertex(std::string_view text) {
    const std::int64_t written = lines_.integer(text.substr(0, text.find('/')), "vertex");
    const auto known = static_cast<std::int64_t>(curves_.spheres.size());
    const std::int64_t index = written < 0 ? known + written : written - 1;
    if (index < 0 || index >= 0x7FFFFFFF)
      lines_.fail(fmt::format("vertex {} is not one of those before it, counted from 1", in_quotes(text)));
    if (index > greatest_) greatest_ = index, greatest_line_ = lines_.line_number();
    return static_cast<std::uint32_t>(index);
  }

  CurveFile arranged() {
    lines_.forget();
    const std::size_t all = curves_.spheres.size();
    const auto order = arrange_along_edges(curves_, edges_, false);
    curves_.rounding.settle(curves_.spheres, [&](std::size_t k) { return order[k]; });
    for (const std::uint32_t point : order) curves_.labels.add(std::int64_t{point} + 1);
    if (const std::size_t left = all - curves_.spheres.size(); left > 0)
      curves_.warnings.push_back(
          fmt::format("{} {} on no line and left out", left, left == 1 ? "vertex is" : "vertices are"));
    if (faces_ > 0)
      curves_.warnings.push_back(fmt::format(
          "{} {} left out", faces_, faces_ == 1 ? "face is no curve and" : "faces are no curves and"));
    if (unknown_ > 0)
      curves_.warnings.push_back(
          first_unknown_ +
          (unknown_ == 1 ? "" : fmt::format(", nor {} {} more", unknown_ == 2 ? "is" : "are", unknown_ - 1)));
    if (free_form_ > 0)
      curves_.warnings.push_back(fmt::format("{} left out; export {} as a polyline",
                                             counted(free_form_, "free-form curve"),
                                             free_form_ == 1 ? "it" : "each"));
    return std::move(curves_);
  }

  TextLines lines_;
  std::vector<std::string> pending_;  ///< of a statement that goes on after a backslash
  std::vector<Pair> edges_;
  std::int64_t greatest_ = -1;  ///< vertex that a line names, and where
  std::size_t greatest_line_ = 0;
  std::size_t faces_ = 0, free_form_ = 0, unknown_ = 0;
  std::string first_unknown_;
  CurveFile curves_;
};

const RegisterReader registered{{"Wavefront OBJ",
                                 {".obj"},
                                 "vertices along l lines, which may branch, and p points; no radii",
                                 "vertex number from 1"},
                                read_by<Obj>};

}  // namespace
}  // namespace catena
