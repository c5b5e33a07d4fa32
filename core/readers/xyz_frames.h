#pragma once
#include "catena/core/readers/read_options.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

namespace catena {

/// Reads XYZ into `curves`: frames of a line with the number of points, a title, and the points; perhaps the
/// title is that of extended XYZ, and says what the columns are. Where one line less follows than the format
/// asks for, there is no title. `lines` stands before the first count. Throws InputError "file:line: reason".
void read_xyz_frames(TextLines& lines, const ReadOptions& options, CurveFile& curves);

}  // namespace catena
