#pragma once
#include <string>

#include "catena/core/error.h"

namespace catena {

/// What is being thrown, in words: what() of a standard exception, "a foreign exception" of any other. Only
/// in a catch block.
std::string thrown_words();

/// What the machine has too little of, and what to do about it, where that is why something is being thrown;
/// empty where it is not. Only in a catch block.
std::string thrown_for_want();

/// A variant threw what is no Error of catena's: the fault is in it, not in its input; or there was too
/// little memory for it. what() names it.
class VariantThrew : public Error {
 public:
  /// Of what is being thrown. Only in a catch block.
  explicit VariantThrew(const std::string& variant);
};

/// work(), which runs this variant; of what it throws, errors pass, and everything else becomes VariantThrew.
template <class Work>
decltype(auto) blaming(const std::string& variant, const Work& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (...) {
    throw VariantThrew(variant);
  }
}

}  // namespace catena
