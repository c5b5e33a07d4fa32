#include "catena/core/installed_files.h"

namespace catena {

std::filesystem::path installed_files() {
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return program.parent_path().parent_path() / CATENA_DATADIR / "catena";
}

}  // namespace catena
