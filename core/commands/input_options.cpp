#include "catena/core/commands/input_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "catena/core/commands/command_line.h"
#include "catena/core/error.h"
#include "catena/core/periodic/periodic.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/shell_word.h"

namespace catena {
namespace {

void set_radius(const std::string& text, InputOptions& options) {
  if (text == "half-spacing") {
    options.radius_half_spacing = true;
    return;
  }
  const auto [radius, problem] = parse_float(text);
  if (!problem.empty() || radius < 0)
    throw InputError(fmt::format("--radius {}: must be a finite number from 0, or half-spacing", text));
  if (radius == 0 && !is_zero(text))
    throw InputError(
        fmt::format("--radius {}: is no 0, but binary32 has no radius so small; scale the points", text));
  options.radius = radius;
}

/// A number, pi, or pi/NUMBER; nothing for other text.
std::optional<double> number_with_pi(std::string_view text) {
  const auto number = [](std::string_view digits) -> std::optional<double> {
    const auto [value, problem] = parse_double(digits);
    if (!problem.empty()) return {};
    return value;
  };
  if (text == "pi") return std::numbers::pi;
  if (!text.starts_with("pi/")) return number(text);
  const auto parts = number(text.substr(3));
  if (!parts) return {};
  return std::numbers::pi / *parts;
}

void set_arc_window(const std::string& text, InputOptions& options) {
  options.arc_window = number_with_pi(text);
  if (!options.arc_window || !std::isfinite(*options.arc_window) || *options.arc_window <= 0)
    throw InputError(
        fmt::format("--arc-window {}: must be a finite number above 0, as 1.5 or pi/2", in_quotes(text)));
}

void set_origin(const std::string& text, ReadOptions& reading) {
  reading.recentre = true;
  std::array<double, 3> origin{};
  std::string_view rest = text;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string_view part = axis < 2 ? rest.substr(0, rest.find(',')) : rest;
    const auto [value, problem] = parse_double(part);
    if (!problem.empty())
      throw InputError(
          fmt::format("--origin {}: {} {}; an origin is X,Y,Z", in_quotes(text), in_quotes(part), problem));
    origin[axis] = value;
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
  }
  reading.origin = origin;
}

void set_box(const std::string& text, InputOptions& options) {
  if (text == "file" || text == "none") {
    options.box_from = text == "file" ? BoxFrom::file : BoxFrom::none;
    return;
  }
  std::vector<double> numbers;
  for (std::string_view rest = text; numbers.size() < 7;) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const auto [value, problem] = parse_double(rest.substr(0, comma));
    if (!problem.empty())
      throw InputError(fmt::format("--box {}: {} {}; a box is X,Y,Z or X,Y,Z,XY,XZ,YZ, file or none",
                                   in_quotes(text), in_quotes(rest.substr(0, comma)), problem));
    numbers.push_back(value);
    if (comma == rest.size()) break;
    rest.remove_prefix(comma + 1);
  }
  if (numbers.size() != 3 && numbers.size() != 6)
    throw InputError(
        fmt::format("--box {}: a box is X,Y,Z or X,Y,Z,XY,XZ,YZ, file or none", in_quotes(text)));
  options.box_from = BoxFrom::options;
  options.box = {{numbers[0], numbers[1], numbers[2]}};
  if (numbers.size() == 6)
    options.box.xy = numbers[3], options.box.xz = numbers[4], options.box.yz = numbers[5];
}

void add_box_option(OptionParser& app, InputOptions& options) {
  const bool taken = options.takes_box;
  app.add_option_function(
         "--box", [&options](const std::string& text) { set_box(text, options); },
         taken ? "Space repeats in a box of these edges (0: not along this one), and perhaps tilts, or in "
                 "the file's; "
                 "without it, in the file's where that says it is periodic"
               : "none: leaves out the box of a file that says space repeats in it; otherwise such a file is "
                 "refused")
      .type_name(taken ? "X,Y,Z[,XY,XZ,YZ]|file|none" : "none");
}

}  // namespace

void add_tolerance_option(OptionParser& app, InputOptions& options) {
  app.add_option("--tolerance", options.tolerance,
                 "Leave out spheres without which the tube lacks no more than this share of its radius; "
                 "needs an arc window")
      .type_name("T");
}

void add_input_options(OptionParser& app, InputOptions& options) {
  app.add_option_function(
         "--radius", [&options](const std::string& text) { set_radius(text, options); },
         "Radius for files without radii; half-spacing: half the median step along the strands")
      .type_name("R|half-spacing");
  app.add_flag("--closed", options.closed, "Every strand is closed: its last sphere is joined to its first");
  const auto window =
      app.add_option("--window", options.window,
                     "Spheres this many steps along a strand are neighbours, instead of the input's rule")
          .type_name("K")
          .range(1u, std::numeric_limits<std::uint32_t>::max());
  app.add_option_function(
         "--arc-window", [&options](const std::string& text) { set_arc_window(text, options); },
         "Spheres nearer along the strand than F times the sum of their radii are neighbours, instead")
      .type_name("F|pi/2")
      .excludes(window);
  app.add_option(
         "--columns", options.reading.columns,
         "What the columns of a text table are: x, y, z, r, d, id, element, strand, chr, closed, or _ for "
         "one that is not read")
      .type_name("x,y,z,r")
      .delimiter(',')
      .allow_extra_args(false);
  app.add_option("--atom", options.reading.atom,
                 "The atom that stands for a residue, instead of C-alpha or P")
      .type_name("NAME");
  app.add_flag("--recentre", options.reading.recentre,
               "Take the first point of a file off every point, before they are rounded to binary32");
  app.add_option_function(
         "--origin", [&options](const std::string& text) { set_origin(text, options.reading); },
         "Take this point off instead")
      .type_name("X,Y,Z");
  app.add_option("--format", options.reading.format,
                 "Read files as those of this extension; needed for -, which is standard input")
      .type_name("EXTENSION");
  app.add_option("--array", options.reading.array, "The array of a VTK file that holds radii, or diameters")
      .type_name("NAME");
  app.add_option("--topology", options.reading.topology,
                 "The file with the strands or bonds of a configuration: oxDNA's .top, LAMMPS's .data")
      .type_name("FILE");
  add_box_option(app, options);
}

std::vector<std::string> arguments_of(const InputOptions& options) {
  std::vector<std::string> arguments;
  const auto flag = [&](bool given, const char* name) {
    if (given) arguments.emplace_back(name);
  };
  const auto value = [&](const char* name, const std::string& text) {
    if (!text.empty()) arguments.emplace_back(name), arguments.push_back(text);
  };
  const ReadOptions& reading = options.reading;
  value("--radius", options.radius                ? fmt::format("{}", *options.radius)
                    : options.radius_half_spacing ? "half-spacing"
                                                  : "");
  flag(options.closed, "--closed");
  value("--window", options.window ? fmt::format("{}", *options.window) : "");
  value("--arc-window", options.arc_window ? fmt::format("{}", *options.arc_window) : "");
  value("--columns", fmt::format("{}", fmt::join(reading.columns, ",")));
  value("--atom", reading.atom);
  flag(reading.recentre && !reading.origin, "--recentre");
  value("--origin", reading.origin ? fmt::format("{}", fmt::join(*reading.origin, ",")) : "");
  value("--format", reading.format);
  value("--array", reading.array);
  value("--topology", reading.topology);
  value("--box", options.box_from == BoxFrom::file      ? "file"
                 : options.box_from == BoxFrom::none    ? "none"
                 : options.box_from == BoxFrom::options ? written(options.box)
                                                        : "");
  return arguments;
}

void read_input_options(std::vector<std::string> arguments, InputOptions& options) {
  parse_options(std::move(arguments), [&](OptionParser& app) { add_input_options(app, options); });
}

std::string in_command(const InputOptions& options) {
  std::string text;
  for (const std::string& argument : arguments_of(options)) text += " " + shell_word(argument);
  return text;
}

}  // namespace catena
