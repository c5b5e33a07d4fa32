#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "catena/core/chain/chain.h"
#include "catena/core/error.h"
#include "catena/core/input/curve_input.h"
#include "catena/core/readers/chain_format.h"
#include "catena/core/readers/reader.h"

namespace {

/// The readers take files: one in memory, where there is such a place, that every run overwrites.
std::filesystem::path scratch(const std::string& extension) {
  static const std::filesystem::path folder =
      [] {
        const std::filesystem::path memory = "/dev/shm";
        const auto root =
            std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
        auto own = root / ("catena-fuzz-" + std::to_string(getpid()));
        std::filesystem::create_directories(own);
        std::ofstream(own / "input.top")
            << "3 1\n1 A -1 1\n1 C 0 2\n1 G 1 -1\n";  // what oxDNA's reader looks for
        return own;
      }();
  return folder / ("input" + extension);
}

/// CATENA_READER (.obj, .obj.gz) keeps to one kind of file, so that each reader gets its share of the time.
const char* only_extension() { return std::getenv("CATENA_READER"); }

/// What kind of file the rest of an input is, by its first byte.
std::string extension_of(std::uint8_t first) {
  using catena::ReaderRegistry;
  static const auto readers = ReaderRegistry::instance().readers();
  static const char* const only = only_extension();
  if (only == nullptr) return readers[first % readers.size()].extensions.front();
  if (!ReaderRegistry::instance().knows(std::string("input") + only)) std::abort();
  return only;
}

/// The head of each sample file as an input: what binary and long formats have to say stands there.
void write_seeds(const std::filesystem::path& folder) {
  using namespace catena;
  std::filesystem::create_directories(folder);
  const auto readers = ReaderRegistry::instance().readers();
  for (const auto& entry : std::filesystem::directory_iterator(CATENA_EXAMPLES_IN_SOURCE))
    for (std::size_t k = 0; k < readers.size(); ++k) {
      const std::string extension = entry.path().extension();
      if (std::ranges::find(readers[k].extensions, extension) == readers[k].extensions.end()) continue;
      if (only_extension() && extension != only_extension()) continue;
      constexpr std::size_t most = 4000;
      std::string head(most, '\0');
      std::ifstream in(entry.path(), std::ios::binary);
      in.read(head.data(), most);
      head.resize(static_cast<std::size_t>(in.gcount()));
      std::ofstream(folder / entry.path().filename(), std::ios::binary) << static_cast<char>(k) << head;
    }
}

}  // namespace

/// CATENA_SEEDS names the folder of a corpus that is to begin with the sample files.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  if (const char* folder = std::getenv("CATENA_SEEDS")) write_seeds(folder);
  return 0;
}

/// libFuzzer over all readers: the first byte chooses one, the rest is the file. It is read, or refused with
/// an InputError; what is read makes a chain or is refused, and a chain that is written reads back as itself.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace catena;
  if (size == 0) return 0;
  const auto path = scratch(extension_of(data[0]));
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data) + 1, static_cast<long>(size) - 1);
  try {
    CurveFile curves = ReaderRegistry::instance().read(path);
    const auto joints = curves.joints;
    const Chain chain = make_chain(std::move(curves), {});
    const auto copy = scratch(".chain");
    write_chain(copy, chain, joints);
    const Chain second = make_chain(ReaderRegistry::instance().read(copy), {});
    std::ostringstream first_text, second_text;
    write_chain(first_text, chain, joints);
    write_chain(second_text, second, joints);
    if (first_text.str() != second_text.str()) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
