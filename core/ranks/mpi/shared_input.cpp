#include "catena/core/ranks/mpi/shared_input.h"

#include <memory>

#include "catena/core/ranks/mpi/mpi_file.h"

namespace catena::ranks {

BinaryChain open_shared(const std::string& name) {
  const auto file = std::make_shared<MpiFile>(name, MpiFile::Use::read, name);
  return {name, file->size(),
          [file](std::uint64_t at, std::span<std::byte> part) { file->read(at, part.data(), part.size()); }};
}

}  // namespace catena::ranks
