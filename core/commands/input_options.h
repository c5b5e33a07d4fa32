#pragma once
#include "catena/core/input/input.h"

namespace CLI {
class App;
}

namespace catena {

/// Adds to a subcommand what a user may say of its inputs: --radius R|half-spacing, --closed, --window,
/// --arc-window, --columns, --atom, --recentre, --origin, --format, --array, --topology. They fill `options`,
/// which must outlive the parsing. A value that does not parse is an InputError.
void add_input_options(CLI::App& app, InputOptions& options);

/// Adds --tolerance, for a command of one process that shows Input::warnings.
void add_tolerance_option(CLI::App& app, InputOptions& options);

/// Adds --box, for a command that heeds Input::boxes.
void add_box_option(CLI::App& app, InputOptions& options);

}  // namespace catena
