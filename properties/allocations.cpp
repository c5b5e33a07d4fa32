#include "catena/properties/allocations.h"

namespace catena::properties {

Allocations::Read& Allocations::counter() {
  static Read read = nullptr;
  return read;
}

Allocations::Read& Allocations::held() {
  static Read read = nullptr;
  return read;
}

Allocations::Give& Allocations::give() {
  static Give give = nullptr;
  return give;
}

}  // namespace catena::properties
