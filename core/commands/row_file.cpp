#include "catena/core/commands/row_file.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "catena/core/csv_cell.h"
#include "catena/core/readers/number_text.h"

namespace catena {

RowFile::RowFile(const std::string& name, std::vector<std::string> columns)
    : out_(name), columns_(std::move(columns)), json_(name.ends_with(".jsonl")) {
  if (json_) return;
  for (const std::string& column : columns_) text(column);
  end_row();
}

void RowFile::begin_cell() {
  if (cells_ >= columns_.size()) throw std::logic_error("a row has more cells than columns");
  if (json_) {
    line_ += cells_ == 0 ? "{\"" : ",\"";
    line_ += columns_[cells_];
    line_ += "\":";
  } else if (cells_ > 0) {
    line_ += ',';
  }
  ++cells_;
}

RowFile& RowFile::number(std::uint64_t value) {
  begin_cell();
  append_shortest(line_, value);
  return *this;
}

RowFile& RowFile::real(double value) {
  begin_cell();
  append_shortest(line_, value);
  return *this;
}

RowFile& RowFile::text(std::string_view value) {
  begin_cell();
  if (json_) {
    line_ += nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  } else {
    append_csv_cell(line_, value);
  }
  return *this;
}

void RowFile::end_row() {
  if (cells_ != columns_.size()) throw std::logic_error("a row has fewer cells than columns");
  line_ += json_ ? "}\n" : "\n";
  out_.write(line_);
  line_.clear();
  cells_ = 0;
}

}  // namespace catena
