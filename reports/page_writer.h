#pragma once
#include <string>
#include <vector>

namespace catena::reports {

/// Runs the page writer, the Python package catena_report, with these arguments and gives its exit code. Its
/// output is the user's. Throws InputError, saying what to install, when there is no interpreter or no
/// package. At Ctrl-C it ends, and so does this process, which says before what is left.
int run_page_writer(const std::vector<std::string>& arguments, const std::string& left_if_interrupted = {});

}  // namespace catena::reports
