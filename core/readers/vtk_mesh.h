#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/readers/reader.h"

namespace catena {

/// What VTK's files have in common: points, cells of which the poly-lines are curves, and arrays of which one
/// may hold radii. A point that several lines share is a branch; a point of a vertex cell and of no line is a
/// strand of its own; points of neither are left out, and so are other cells, both with a warning.
///
/// Radii: the array of one number a point, or a line, that --array names, or else the only one whose name
/// says radius, diameter or r; a diameter is halved. Where lines have radii, a point takes the largest of its
/// lines.
class VtkMesh {
 public:
  explicit VtkMesh(const ReadOptions& options) : curves_(options), chosen_(options.array) {}

  std::uint32_t points() const { return static_cast<std::uint32_t>(curves_.spheres.size()); }
  void reserve_points(std::size_t points) { curves_.spheres.reserve(points); }
  void add_point(double x, double y, double z) { curves_.add_open_point(x, y, z); }

  std::uint64_t cells() const { return cells_; }
  enum CellType : std::int64_t { vertex = 1, poly_vertex = 2, line = 3, poly_line = 4 };  ///< VTK's numbers
  /// Why a cell cannot name this point; empty when it can.
  std::string refusal_of(std::int64_t point) const;
  /// The next cell, of these or any other type. The reason when a point of it is none; empty when it is good.
  std::string add_cell(std::int64_t type, std::span<const std::int64_t> points_of_cell);
  void add_other_cells(std::uint64_t cells) { cells_ += cells, other_cells_ += cells; }

  enum class Of { points, cells };
  /// Whether the values of this array, one number each, are to be handed over.
  bool may_be_radii(std::string_view name) const;
  /// Several calls of one name, one for each piece of a file, go on from each other.
  void add_array(std::string_view name, Of of, std::span<const double> values);

  /// All that was added as curves; once. Throws InputError, naming `file`.
  CurveFile curves(const std::string& file);

 private:
  struct Array {
    std::string name;
    Of of;
    std::vector<double> values;
  };

  const Array* radii(const std::string& file) const;
  void give_radii(const Array& array, const std::string& file);
  float radius_of(const Array& array, std::size_t k, const std::string& file) const;

  CurveFile curves_;
  std::string chosen_;
  std::uint64_t cells_ = 0, other_cells_ = 0;
  std::vector<std::uint32_t> line_points_;  ///< of all lines, one after the other
  std::vector<std::uint64_t> line_end_, line_cell_;
  std::vector<std::uint32_t> vertices_;
  std::vector<std::uint64_t> vertex_cell_;  ///< of each of the vertices
  std::vector<Array> arrays_;
};

}  // namespace catena
