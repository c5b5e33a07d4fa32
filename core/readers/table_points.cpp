#include "catena/core/readers/table_points.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "catena/core/error.h"
#include "catena/core/readers/file_bytes.h"

namespace catena {

void TablePoints::set_columns(TableColumns columns) {
  columns_ = std::move(columns);
  curves_.has_radii = columns_.has_radii();
}

void TablePoints::set_columns_named(std::span<const std::string_view> names) {
  std::vector<Role> roles;
  std::vector<std::string> unread;
  for (const std::string_view name : names) {
    roles.push_back(TableColumns::role_of(name).value_or(Role::unread));
    if (roles.back() == Role::unread) unread.push_back(in_quotes(name));
  }
  try {
    TableColumns::require_one_unit(names);
    set_columns(TableColumns(std::move(roles)));
  } catch (const InputError& error) {
    lines_.fail(fmt::format("{}; the first line names the columns, or --columns x,y,z,r does", error.what()));
  }
  if (unread.empty()) return;
  constexpr std::size_t most = 6;
  const auto shown = std::span(unread).first(std::min(unread.size(), most));
  curves_.warnings.push_back(fmt::format("not read: column{} {}{}", unread.size() == 1 ? "" : "s",
                                         fmt::join(shown, ", "), unread.size() > most ? ", ..." : ""));
}

void TablePoints::add(std::span<const std::string_view> cells) {
  if (cells.size() != columns_.size())
    lines_.fail(fmt::format("the row has {} column{}, not {}", cells.size(), cells.size() == 1 ? "" : "s",
                            columns_.size()));
  const auto coordinate = [&](Role role, const char* name) {
    return lines_.coordinate(cells[columns_.place(role)], name);
  };
  const double x = coordinate(Role::x, "x"), y = coordinate(Role::y, "y"), z = coordinate(Role::z, "z");
  float radius = 0;
  if (columns_.has(Role::radius)) radius = lines_.radius(cells[columns_.place(Role::radius)]);
  if (columns_.has(Role::diameter)) radius = lines_.half(cells[columns_.place(Role::diameter)]);
  if (curves_.later_frames.empty()) {
    if (columns_.has(Role::strand)) enter_strand(cells[columns_.place(Role::strand)]);
    if (columns_.has(Role::closed)) read_closed(cells[columns_.place(Role::closed)]);
    label(cells);
  } else {
    require_same_sphere(cells);
  }
  curves_.add_point(x, y, z, radius);
}

void TablePoints::label(std::span<const std::string_view> cells) {
  label_of_ = columns_.has(Role::id) ? Role::id : columns_.has(Role::element) ? Role::element : Role::unread;
  if (label_of_ == Role::unread) return curves_.labels.add(static_cast<std::int64_t>(lines_.line_number()));
  text_ = cells[columns_.place(label_of_)];
  if (label_of_ == Role::element) fmt::format_to(std::back_inserter(text_), "{}", curves_.spheres.size() + 1);
  curves_.labels.add(std::string_view(text_));
}

// Some programs write the rows of each frame in an order of its own.
void TablePoints::require_same_sphere(std::span<const std::string_view> cells) {
  const auto sphere = static_cast<std::uint32_t>(curves_.later_frames.back().size());
  if (label_of_ != Role::unread && columns_.has(label_of_)) {
    text_ = cells[columns_.place(label_of_)];
    if (label_of_ == Role::element) fmt::format_to(std::back_inserter(text_), "{}", sphere + 1);
    if (const std::string first = curves_.labels.of(sphere); first != text_)
      lines_.fail(fmt::format("{} stands where frame 0 has {}; write the rows of all frames in one order",
                              in_quotes(text_), in_quotes(first)));
  }
  const bool named = !piece_.empty() && columns_.has(Role::strand);
  if (!named && !columns_.has(Role::closed)) return;
  const auto next = std::ranges::upper_bound(curves_.strand_first, sphere);
  const auto place = static_cast<std::size_t>(next - curves_.strand_first.begin()) - 1;
  // The last strand ends with the file.
  const bool closed = place < curves_.strand_closed.size() ? curves_.strand_closed[place] != 0 : closed_;
  if (columns_.has(Role::closed) && cells[columns_.place(Role::closed)] != (closed ? "1" : "0"))
    lines_.fail(fmt::format("closed {} stands where frame 0 has {}; a strand is closed in all frames or none",
                            in_quotes(cells[columns_.place(Role::closed)]), closed ? 1 : 0));
  if (!named) return;
  const std::string& strand = names_[piece_[place]];
  if (const auto here = cells[columns_.place(Role::strand)]; here != strand)
    lines_.fail(
        fmt::format("strand {} stands where frame 0 has {}; write the rows of all frames in one order",
                    in_quotes(here), in_quotes(strand)));
}

void TablePoints::enter_strand(std::string_view name) {
  if (!piece_.empty() && names_[piece_.back()] == name) return;
  curves_.end_strand(closed_);
  const auto [known, is_new] = number_of_.emplace(name, static_cast<std::uint32_t>(names_.size()));
  if (is_new) names_.emplace_back(name);
  if (!is_new && came_back_++ == 0) line_of_return_ = lines_.line_number();
  piece_.push_back(known->second);
}

void TablePoints::read_closed(std::string_view flag) {
  const bool starts = curves_.spheres.size() == curves_.strand_first.back();
  if (flag != "0" && flag != "1") lines_.fail(fmt::format("closed {} must be 0 or 1", in_quotes(flag)));
  if (!starts && closed_ != (flag == "1"))
    lines_.fail("this strand is closed in one row and open in another");
  closed_ = flag == "1";
}

void TablePoints::end_strand() {
  if (columns_.has(Role::strand)) lines_.fail("a strand ends where its name changes; leave the END out");
  curves_.end_strand(closed_);
}

void TablePoints::finish() {
  curves_.end_strand(closed_);
  if (came_back_ > 0) gather_strands();
  curves_.labels.strand_names = std::move(names_);
}

void TablePoints::gather_strands() {
  std::vector<std::uint32_t> pieces(piece_.size()), order, first{0};
  std::vector<std::uint8_t> closed;
  std::iota(pieces.begin(), pieces.end(), 0u);
  std::ranges::stable_sort(pieces, {}, [&](std::uint32_t p) { return piece_[p]; });
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const std::uint32_t p = pieces[k];
    for (std::uint32_t i = curves_.strand_first[p]; i < curves_.strand_first[p + 1]; ++i) order.push_back(i);
    const bool ends = k + 1 == pieces.size() || piece_[pieces[k + 1]] != piece_[p];
    if (!ends && curves_.strand_closed[p] != curves_.strand_closed[pieces[k + 1]])
      lines_.fail(
          fmt::format("strand {} is closed in one row and open in another", in_quotes(names_[piece_[p]])));
    if (!ends) continue;
    first.push_back(static_cast<std::uint32_t>(order.size()));
    closed.push_back(curves_.strand_closed[p]);
  }
  curves_.choose(order);
  curves_.strand_first = std::move(first);
  curves_.strand_closed = std::move(closed);
  curves_.warnings.push_back(fmt::format(
      "line {}: a strand comes back after another, {} time{} in all; the rows of a name are one strand",
      line_of_return_, came_back_, came_back_ == 1 ? "" : "s"));
}

}  // namespace catena
