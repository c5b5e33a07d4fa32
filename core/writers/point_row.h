#pragma once
#include <string>

#include "catena/core/readers/number_text.h"
#include "catena/core/sphere.h"

namespace catena {

/// Appends "x<separator>y<separator>z", as texts that read as exactly these floats.
inline void append_point(std::string& text, const Sphere& sphere, char separator) {
  append_shortest(text, sphere.x);
  text += separator;
  append_shortest(text, sphere.y);
  text += separator;
  append_shortest(text, sphere.z);
}

}  // namespace catena
