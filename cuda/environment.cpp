// The program's part of this folder: measurements say what they were taken on, and the library measures nothing.
#include "catena/core/environment.h"

#include "catena/cuda/device_facts.h"

namespace catena::cuda {
namespace {

const RegisterEnvironment registered(device_facts);

}  // namespace
}  // namespace catena::cuda
