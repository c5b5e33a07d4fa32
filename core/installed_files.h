#pragma once
#include <filesystem>

namespace catena {

/// The folder of the files that are installed with the program: beside it, wherever it was installed, as
/// `cmake --install --prefix` may say another place than the one it was configured for.
std::filesystem::path installed_files();

}  // namespace catena
