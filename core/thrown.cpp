#include "catena/core/thrown.h"

#include <exception>
#include <new>

namespace catena {

std::string thrown_words() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "a foreign exception";
  }
}

}  // namespace catena
