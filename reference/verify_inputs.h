#pragma once
#include <string>
#include <vector>

#include "catena/core/input/input.h"

namespace catena::reference {

/// Every scene at 1,500 spheres, which the one block of bGPU2 takes; scenes far from the origin, tiny and
/// huge, where rounded arithmetic shows what it does; and the sample files of core/readers/examples, from the
/// source tree or else where they are installed.
std::vector<std::string> default_inputs();

/// Opens an input. A sample file without radii gets half the spacing when the options give no radius.
/// Throws InputError like open_input.
Input open_for_verification(const std::string& spec, InputOptions options, bool sample);

}  // namespace catena::reference
