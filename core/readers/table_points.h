#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "catena/core/readers/reader.h"
#include "catena/core/readers/table_columns.h"
#include "catena/core/readers/text_lines.h"

namespace catena {

/// Makes points of the rows of a table. A sphere's label is its id, or its element and its place in the file
/// from 1 ("C12"), or its line. Where there is a column of strands, rows of one name are one strand, also
/// when other strands stand between them. A column `closed` holds 0 or 1, the same in all rows of a strand.
class TablePoints {
 public:
  /// Points go to `curves`; errors name the current line of `lines`. Both outlive this object.
  TablePoints(const TextLines& lines, CurveFile& curves) : lines_(lines), curves_(curves) {}

  void set_columns(TableColumns columns);
  /// By the names of a header. What has another name is not read, and a warning says so. Throws InputError
  /// for the current line.
  void set_columns_named(std::span<const std::string_view> names);
  const TableColumns& columns() const { return columns_; }

  /// A row of as many cells as there are columns. In a frame after the first its point counts, and its id or
  /// element and its strand must be those of the first frame. Throws InputError for others, for another
  /// number of cells, and for what is no number.
  void add(std::span<const std::string_view> cells);
  /// The rows since the last call are a strand.
  void end_strand();
  /// After the last row.
  void finish();

 private:
  using Role = TableColumns::Role;

  void label(std::span<const std::string_view> cells);
  void require_same_sphere(std::span<const std::string_view> cells);
  void enter_strand(std::string_view name);
  void read_closed(std::string_view flag);
  void gather_strands();

  const TextLines& lines_;
  CurveFile& curves_;
  TableColumns columns_;
  Role label_of_ = Role::unread;    ///< of the first frame's: id, element, or their line
  std::string text_;                ///< of the label under way
  std::vector<std::string> names_;  ///< of the strands, as they first come
  std::unordered_map<std::string, std::uint32_t> number_of_;  ///< in names_
  std::vector<std::uint32_t> piece_;  ///< of each run of rows, the number of its strand
  bool closed_ = false;               ///< the strand under way
  std::size_t came_back_ = 0, line_of_return_ = 0;
};

}  // namespace catena
