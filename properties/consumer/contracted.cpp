// The same with contraction, against the target's flag: it must give other bits where the processor can contract.
#include "same_bits.cpp"
