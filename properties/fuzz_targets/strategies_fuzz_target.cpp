#include <cstdlib>
#include <iostream>

#include "catena/core/readers/chain_format.h"
#include "catena/properties/fuzz_targets/chain_from_bytes.h"
#include "catena/properties/suite.h"
#include "catena/properties/variant_name.h"

/// libFuzzer over all variants: the bytes are a chain, and every property is asked of it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace catena;
  using namespace catena::properties;
  static Suite suite = [] {
    auto subjects = Subject::available();
    for (Subject& small : in_small_blocks(subjects))
      if (small.exact()) subjects.push_back(std::move(small));
    return Suite(std::move(subjects));
  }();
  static std::uint64_t turn = 0;
  const Case test = Case::of(chain_from_bytes(data, size));
  if (const auto finding = suite.check_some(test, ++turn)) {
    std::cerr << finding->variant << ": " << finding->property << ": " << finding->what << '\n';
    write_chain(std::cerr, test.chain);
    std::abort();
  }
  return 0;
}
