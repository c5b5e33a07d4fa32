#include "catena/core/thrown.h"

#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace catena {
namespace {

constexpr const char* no_thread =
    ": no more threads can be started; raise ulimit -u or the container's limit of processes, or take "
    "threads=1";

std::string at_fault(const std::string& variant) {
  return variant + " threw: " + thrown_words() + "; the fault is in this variant: see catena fuzz --variant";
}

std::string words_of_variant(const std::string& variant) {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return variant + ": out of memory; take fewer spheres or ask for counts instead of pairs";
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again) return variant + no_thread;
    return at_fault(variant);
  } catch (const std::runtime_error& error) {
    // oneTBB's, which has no type of its own
    if (std::string_view(error.what()).starts_with("pthread_create ")) return variant + no_thread;
    return at_fault(variant);
  } catch (...) {
    return at_fault(variant);
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
