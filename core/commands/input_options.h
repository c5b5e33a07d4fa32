#pragma once
#include <string>
#include <vector>

#include "catena/core/input/input.h"

namespace catena {

class OptionParser;

/// Adds to a subcommand what a user may say of its inputs: --radius R|half-spacing, --closed, --window,
/// --arc-window, --columns, --atom, --recentre, --origin, --format, --array, --topology, --box. They fill
/// `options`, which must outlive the parsing; a command that heeds Input::boxes says so in options.takes_box
/// before. A value that does not parse is an InputError.
void add_input_options(OptionParser& app, InputOptions& options);

/// What was said of an input, as arguments of a command that add_input_options knows: {"--radius", "0.5",
/// ...}. Numbers are written so that they read back as they are. Empty: nothing was said.
std::vector<std::string> arguments_of(const InputOptions& options);

/// The other way round, into options that say nothing yet. Throws InputError.
void read_input_options(std::vector<std::string> arguments, InputOptions& options);

/// arguments_of as text to be put behind the name of an input in a command: " --radius '0.5' ...".
std::string in_command(const InputOptions& options);

/// Adds --tolerance, for a command of one process that shows Input::warnings.
void add_tolerance_option(OptionParser& app, InputOptions& options);

}  // namespace catena
