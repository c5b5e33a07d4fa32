#include "catena/core/commands/input_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <string>

#include "catena/core/error.h"

namespace catena {
namespace {

void set_radius(const std::string& text, InputOptions& options) {
  if (text == "half-spacing") {
    options.radius_half_spacing = true;
    return;
  }
  float radius = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, radius);
  if (parsed.ec != std::errc{} || parsed.ptr != end || !std::isfinite(radius) || radius < 0)
    throw InputError(fmt::format("--radius {}: must be a finite number from 0, or half-spacing", text));
  options.radius = radius;
}

}  // namespace

void add_input_options(CLI::App& app, InputOptions& options) {
  app.add_option_function<std::string>(
         "--radius", [&options](const std::string& text) { set_radius(text, options); },
         "Radius for files without radii; half-spacing: half the median step along the strands")
      ->type_name("R|half-spacing");
  app.add_flag("--closed", options.closed, "Every strand is closed: its last sphere is joined to its first");
  auto* window =
      app.add_option("--window", options.window,
                     "Spheres this many steps along a strand are neighbours, instead of the input's rule")
          ->type_name("K");
  app.add_option(
         "--arc-window", options.arc_window,
         "Spheres nearer along the strand than F times the sum of their radii are neighbours, instead")
      ->type_name("F")
      ->excludes(window);
}

}  // namespace catena
