#pragma once
#include "catena/core/chain/chain_view.h"
#include "catena/core/hierarchy/radius_range.h"

namespace catena {

/// True when the chain proves the arithmetic's range checks idle.
template <class Arithmetic>
bool in_range(const ChainView& chain) {
  return Arithmetic::in_range(radius_range(chain.extent));
}

/// Calls search(tests) with the arithmetic's tests for this chain: those without range checks where the chain
/// proves them idle. The choice is made once a search, as even a branch never taken keeps a kernel's
/// registers.
template <class Arithmetic, class Search>
void with_tests_for(const ChainView& chain, const Search& search) {
  if (in_range<Arithmetic>(chain))
    search(typename Arithmetic::InRange{});
  else
    search(Arithmetic{});
}

}  // namespace catena
