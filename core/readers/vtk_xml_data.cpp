#include "catena/core/readers/vtk_xml_data.h"

#include <vector>

#include "catena/core/error.h"
#include "catena/core/readers/base64.h"
#include "catena/core/readers/compressed.h"

namespace catena {
namespace {

[[noreturn]] void fail_cut_off() { throw InputError("its data is cut off, or is no base64"); }

class Source {
 public:
  Source(std::string_view data, bool base64) : left_(data), coded_(data), base64_(base64) {}

  std::string read(std::uint64_t size) {
    if (size > left_.size()) fail_cut_off();  // of base64 too, which is longer than what it holds
    std::string bytes;
    bytes.reserve(size);
    if (!base64_) {
      bytes = left_.substr(0, size);
      left_.remove_prefix(size);
    } else if (!coded_.read(size, bytes)) {
      fail_cut_off();
    }
    return bytes;
  }

 private:
  std::string_view left_;
  Base64 coded_;
  bool base64_;
};

}  // namespace

std::uint64_t vtk_xml_number(std::string_view bytes, bool big_endian) {
  std::uint64_t number = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    const std::size_t place = big_endian ? bytes.size() - 1 - k : k;
    number |= std::uint64_t{static_cast<unsigned char>(bytes[k])} << (8 * place);
  }
  return number;
}

std::string vtk_xml_bytes(std::string_view data, bool base64, const VtkXmlForm& form) {
  Source source(data, base64);
  const auto number = [&] { return vtk_xml_number(source.read(form.header_size), form.big_endian); };
  if (!form.compressed) return source.read(number());

  const std::uint64_t blocks = number(), block_size = number(), last_size = number();
  if (blocks > data.size()) fail_cut_off();
  std::vector<std::uint64_t> compressed_size(blocks);
  for (auto& size : compressed_size) size = number();
  std::string bytes;
  for (std::uint64_t k = 0; k < blocks; ++k) {
    const bool partial = k + 1 == blocks && last_size > 0;
    if (!append_inflated(source.read(compressed_size[k]), partial ? last_size : block_size, bytes))
      throw InputError("its compressed data is damaged");
  }
  return bytes;
}

}  // namespace catena
