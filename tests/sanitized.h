// Which sanitizer watches this program, and with it the programs it starts: g++ defines a macro, clang
// answers a question.
#pragma once

#ifndef __has_feature
#define __has_feature(feature) 0
#endif

namespace kinegraph {

#if defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer)
#define KINEGRAPH_LEAKS_ARE_WATCHED
inline constexpr bool address_sanitized = true;
#else
inline constexpr bool address_sanitized = false;
#endif

#if defined(__SANITIZE_THREAD__) || __has_feature(thread_sanitizer)
inline constexpr bool thread_sanitized = true;
#else
inline constexpr bool thread_sanitized = false;
#endif

// Sanitizers keep memory of their own, and take many times the time.
inline constexpr bool sanitized = address_sanitized || thread_sanitized;

}  // namespace kinegraph
