#include <cuda_runtime.h>

#include <fstream>

#include "catena/cuda/call.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_facts.h"

namespace catena::cuda {
namespace {

std::string version(int number) {
  return std::to_string(number / 1000) + "." + std::to_string(number % 1000 / 10);
}

}  // namespace

std::map<std::string, std::string> device_facts() {
  std::map<std::string, std::string> facts{{"cuda toolkit", version(CUDART_VERSION)}};
  if (const auto why = unavailable()) {
    facts["gpu unavailable"] = *why;
    return facts;
  }
  cudaDeviceProp device{};
  int driver = 0;
  CATENA_CUDA(cudaGetDeviceProperties(&device, 0));
  CATENA_CUDA(cudaDriverGetVersion(&driver));
  facts["gpu"] = device.name;
  facts["gpu multiprocessors"] = std::to_string(device.multiProcessorCount);
  facts["gpu memory"] = std::to_string(device.totalGlobalMem >> 20) + " MiB";
  facts["gpu driver supports"] = "CUDA " + version(driver);
  std::ifstream driver_file("/proc/driver/nvidia/version");  // absent in some containers
  for (std::string line; std::getline(driver_file, line);)
    if (line.starts_with("NVRM version:")) facts["gpu driver"] = line.substr(line.find(':') + 2);
  return facts;
}

}  // namespace catena::cuda
