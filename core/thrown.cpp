#include "catena/core/thrown.h"

#include <exception>
#include <new>

namespace catena {
namespace {

std::string words_of_variant(const std::string& variant) {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return variant + ": out of memory; take fewer spheres or ask for counts instead of pairs";
  } catch (...) {
    return variant + " threw: " + thrown_words() +
           "; the fault is in this variant: see catena fuzz --variant";
  }
}

}  // namespace

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

VariantThrew::VariantThrew(const std::string& variant) : Error(words_of_variant(variant)) {}

}  // namespace catena
