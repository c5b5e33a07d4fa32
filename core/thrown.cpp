#include "catena/core/thrown.h"

#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace catena {
namespace {

constexpr const char* no_thread =
    "no more threads can be started; raise ulimit -u or the container's limit of processes, or take "
    "threads=1";

std::string at_fault(const std::string& variant) {
  return variant + " threw: " + thrown_words() + "; the fault is in this variant: see catena fuzz --variant";
}

std::string words_of_variant(const std::string& variant) {
  const std::string want = thrown_for_want();
  return want.empty() ? at_fault(variant) : variant + ": " + want;
}

}  // namespace

std::string thrown_for_want() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "out of memory; take fewer spheres or ask for counts instead of pairs";
  } catch (const std::system_error& error) {
    return error.code() == std::errc::resource_unavailable_try_again ? no_thread : "";
  } catch (const std::runtime_error& error) {
    // oneTBB's, which has no type of its own
    return std::string_view(error.what()).starts_with("pthread_create ") ? no_thread : "";
  } catch (...) {
    return "";
  }
}

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
