#include "catena/core/readers/vtk_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/readers/curve_graph.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/text_lines.h"

namespace catena {
namespace {

bool is_diameter(std::string_view name) { return lower_case(name).find("diam") != std::string::npos; }

bool says_radius(std::string_view name) {
  const std::string lower = lower_case(name);
  return lower == "r" || lower.find("radius") != std::string::npos ||
         lower.find("radii") != std::string::npos || is_diameter(name);
}

}  // namespace

std::string VtkMesh::refusal_of(std::int64_t point) const {
  if (point >= 0 && point < points()) return "";
  return fmt::format("a cell names point {}, of {} from 0", point, points());
}

std::string VtkMesh::add_cell(std::int64_t type, std::span<const std::int64_t> points_of_cell) {
  const bool is_vertex = type == vertex || type == poly_vertex;
  if (!is_vertex && type != line && type != poly_line) return add_other_cells(1), "";
  for (const std::int64_t point : points_of_cell)
    if (std::string refusal = refusal_of(point); !refusal.empty()) return refusal;
  for (const std::int64_t point : points_of_cell) {
    (is_vertex ? vertices_ : line_points_).push_back(static_cast<std::uint32_t>(point));
    if (is_vertex) vertex_cell_.push_back(cells_);
  }
  if (!is_vertex) line_end_.push_back(line_points_.size()), line_cell_.push_back(cells_);
  ++cells_;
  return "";
}

bool VtkMesh::may_be_radii(std::string_view name) const {
  return chosen_.empty() ? says_radius(name) : name == chosen_;
}

void VtkMesh::add_array(std::string_view name, Of of, std::span<const double> values) {
  auto array = std::ranges::find_if(arrays_, [&](const Array& a) { return a.name == name && a.of == of; });
  if (array == arrays_.end()) array = arrays_.insert(arrays_.end(), {std::string(name), of, {}});
  array->values.insert(array->values.end(), values.begin(), values.end());
}

const VtkMesh::Array* VtkMesh::radii(const std::string& file) const {
  if (arrays_.empty() && !chosen_.empty())
    throw InputError(
        fmt::format("{}: no array of one number a point or line is named {}", file, in_quotes(chosen_)));
  const Array* found = nullptr;
  for (const Array& array : arrays_) {
    if (found && found->name != array.name)
      throw InputError(fmt::format("{}: the radii may be {} or {}; choose one with --array NAME", file,
                                   in_quotes(found->name), in_quotes(array.name)));
    if (!found || array.of == Of::points) found = &array;
  }
  return found;
}

float VtkMesh::radius_of(const Array& array, std::size_t k, const std::string& file) const {
  const double value = is_diameter(array.name) ? array.values[k] / 2 : array.values[k];
  if (!(value >= 0 && value <= double{std::numeric_limits<float>::max()}))
    throw InputError(fmt::format("{}: {} of {} {} is {}, no radius", file, in_quotes(array.name),
                                 array.of == Of::points ? "point" : "cell", k, array.values[k]));
  if (value > 0 && static_cast<float>(value) == 0)
    throw InputError(
        fmt::format("{}: {} of {} {} is {}; binary32 has no radius so small, scale points and radii", file,
                    in_quotes(array.name), array.of == Of::points ? "point" : "cell", k, array.values[k]));
  return static_cast<float>(value);
}

void VtkMesh::give_radii(const Array& array, const std::string& file) {
  const std::uint64_t due = array.of == Of::points ? points() : cells_;
  if (array.values.size() != due)
    throw InputError(fmt::format("{}: {} has {} values for {} {}", file, in_quotes(array.name),
                                 array.values.size(), due, array.of == Of::points ? "points" : "cells"));
  curves_.has_radii = true;
  if (std::ranges::count(arrays_, array.name, &Array::name) > 1)
    curves_.warnings.push_back(
        fmt::format("{} is of points, and of cells; the points' own are taken", in_quotes(array.name)));
  if (array.of == Of::points) {
    for (std::size_t p = 0; p < curves_.spheres.size(); ++p)
      curves_.spheres[p].radius = radius_of(array, p, file);
    return;
  }
  const auto give = [&](std::uint32_t point, float radius) {
    curves_.spheres[point].radius = std::max(curves_.spheres[point].radius, radius);
  };
  std::uint64_t k = 0;
  for (std::size_t l = 0; l < line_end_.size(); ++l)
    for (const float radius = radius_of(array, line_cell_[l], file); k < line_end_[l]; ++k)
      give(line_points_[k], radius);
  std::vector<bool> on_line(points());
  for (const std::uint32_t point : line_points_) on_line[point] = true;
  for (std::size_t v = 0; v < vertices_.size(); ++v)
    if (!on_line[vertices_[v]]) give(vertices_[v], radius_of(array, vertex_cell_[v], file));
  curves_.warnings.push_back(
      fmt::format("{} is one number a line; a point takes the largest of its lines", in_quotes(array.name)));
}

CurveFile VtkMesh::curves(const std::string& file) {
  if (line_end_.empty() && vertices_.empty())
    throw InputError(fmt::format("{}: holds no lines, only {} and {}; catena reads poly-lines", file,
                                 counted(points(), "point"), counted(other_cells_, "other cell")));
  if (const Array* array = radii(file)) give_radii(*array, file);
  if (other_cells_ > 0)
    curves_.warnings.push_back(
        fmt::format("{} cell{} left out", other_cells_,
                    other_cells_ == 1 ? " that is no line is" : "s that are no lines are"));

  std::vector<Pair> edges;
  std::uint64_t k = 0;
  for (const std::uint64_t end : line_end_) {
    if (end == k + 1) edges.push_back({line_points_[k], line_points_[k]});
    for (const std::uint64_t first = k; k < end; ++k)
      if (k > first) edges.push_back({line_points_[k - 1], line_points_[k]});
  }
  for (const std::uint32_t point : vertices_) edges.push_back({point, point});
  for (auto* done : {&line_end_, &line_cell_, &vertex_cell_})
    std::exchange(*done, {});  // an assignment would keep the memory
  for (auto* done : {&line_points_, &vertices_}) std::exchange(*done, {});
  std::exchange(arrays_, {});
  const std::size_t all = curves_.spheres.size();
  const auto order = arrange_along_edges(curves_, edges, false);
  curves_.rounding.settle(curves_.spheres, [&](std::size_t sphere) { return order[sphere]; });
  for (const std::uint32_t point : order) curves_.labels.add(std::int64_t{point});
  if (const std::size_t left = all - curves_.spheres.size(); left > 0)
    curves_.warnings.push_back(fmt::format(
        "{} point{} left out", left, left == 1 ? " that is of no line is" : "s that are of no line are"));
  return std::move(curves_);
}

}  // namespace catena
