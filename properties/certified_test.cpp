#include "catena/properties/testing/certified.h"

// Searches that go by cells, by several orders at once, or by what another chooses, prove their answers too.
namespace catena::properties {
namespace {

TEST(Certified, AreGridAndHybridWhateverPartsItTakes) {
  for (const char* name :
       {"Grid", "Grid(cells=wide)", "Grid(cells=narrow)", "SphereTree", "Hybrid", "Hybrid(crowd=0,dense=1e6)",
        "Hybrid(crowd=0,dense=0)", "Hybrid(crowd=2,dense=0.7)", "Hybrid(crowd=1,dense=2,threads=3)", "auto",
        "Grid(strands=read)", "SphereTree(strands=read)", "Hybrid(strands=read)", "ChainTree(strands=read)",
        "ChainTree(rows=search)", "Hybrid(rows=search)"})
    expect_certified(name);
}

TEST(Certified, AreTheTwinsOfDevices) {
  for (const char* name :
       {"DeviceGrid@host", "DeviceHybrid@host", "DeviceHybrid@host(crowd=1)", "DeviceHybrid@host(survey=0)",
        "DeviceHybrid@host(cells=1000000)", "DeviceHybrid@host(least=300000)", "DeviceCapsules@host",
        "DeviceCapsules@host(crowd=1)", "DeviceTree@host"})
    expect_certified(name);
}

}  // namespace
}  // namespace catena::properties
