#pragma once

/// Whether this is built with a sanitizer that takes terabytes of addresses. GCC tells by macros, clang by
/// features.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CATENA_SANITIZED true
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CATENA_SANITIZED true
#endif
#endif
#ifndef CATENA_SANITIZED
#define CATENA_SANITIZED false
#endif

namespace catena::properties {

inline constexpr bool sanitized = CATENA_SANITIZED;

}  // namespace catena::properties

#undef CATENA_SANITIZED
