#include "catena/core/commands/row_file.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "catena/core/csv_cell.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/readers/text_lines.h"

namespace catena {

RowText::RowText(const std::string& file_name, std::vector<std::string> columns)
    : columns_(std::move(columns)), json_(lower_case(file_name).ends_with(".jsonl")) {}

std::string RowText::heading() const {
  if (json_) return "";
  RowText names("", columns_);
  for (const std::string& column : columns_) names.text(column);
  names.end_row();
  return names.take();
}

void RowText::begin_cell() {
  if (cells_ >= columns_.size()) throw std::logic_error("a row has more cells than columns");
  if (json_) {
    text_ += cells_ == 0 ? "{\"" : ",\"";
    text_ += columns_[cells_];
    text_ += "\":";
  } else if (cells_ > 0) {
    text_ += ',';
  }
  ++cells_;
}

RowText& RowText::number(std::uint64_t value) {
  begin_cell();
  append_shortest(text_, value);
  return *this;
}

RowText& RowText::real(double value) {
  begin_cell();
  append_shortest(text_, value);
  return *this;
}

RowText& RowText::text(std::string_view value) {
  begin_cell();
  if (json_) {
    text_ += nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  } else {
    append_csv_cell(text_, value);
  }
  return *this;
}

void RowText::end_row() {
  if (cells_ != columns_.size()) throw std::logic_error("a row has fewer cells than columns");
  text_ += json_ ? "}\n" : "\n";
  cells_ = 0;
}

}  // namespace catena
