#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace catena {

/// How the arrays of a VTK XML file are written.
struct VtkXmlForm {
  bool big_endian = false;
  unsigned header_size = 4;  ///< bytes of each number in front of data: 4 or 8
  bool compressed = false;   ///< by zlib
};

/// The bytes of one array, from its place in the file: the text of its element, or the rest of the appended
/// data. Throws InputError with a reason only, for the caller to say where.
std::string vtk_xml_bytes(std::string_view data, bool base64, const VtkXmlForm& form);

/// An unsigned number of 1, 2, 4 or 8 bytes.
std::uint64_t vtk_xml_number(std::string_view bytes, bool big_endian);

}  // namespace catena
