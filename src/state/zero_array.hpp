// Arrays that begin as zeros and take memory only where something is written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include "simd/aligned.hpp"

namespace abut::state {

/// Allocates zeroed memory that begins on a line of the caches, of which the system gives pages at the first write only; a
/// default-constructed T must be all zeros.
template <class T>
struct ZeroAllocator {
  using value_type = T;
  static constexpr std::size_t line = simd::cache_line;
  ZeroAllocator() = default;
  template <class U>
  ZeroAllocator(const ZeroAllocator<U>&) {}  // NOLINT: allocators convert
  [[nodiscard]] T* allocate(std::size_t n) {
    if (n > (std::numeric_limits<std::size_t>::max() - line) / sizeof(T)) throw std::bad_alloc();
    auto* p = static_cast<std::byte*>(std::calloc(n * sizeof(T) + line, 1));
    if (p == nullptr) throw std::bad_alloc();
    // Where the memory begins stands before the array: calloc's addresses leave room for a pointer below the next line of the cache.
    std::byte* array = p + (line - reinterpret_cast<std::uintptr_t>(p) % line);
    std::memcpy(array - sizeof(p), &p, sizeof(p));
    return reinterpret_cast<T*>(array);
  }
  void deallocate(T* array, std::size_t) noexcept {
    void* p = nullptr;
    std::memcpy(&p, reinterpret_cast<std::byte*>(array) - sizeof(p), sizeof(p));
    std::free(p);
  }
  bool operator==(const ZeroAllocator&) const { return true; }

  template <class U>
  void construct(U*) {}  // zero already
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
};

/// A vector of a State: one that nothing writes (moments of a model of bricks) takes no memory. Its size is given once: memory that a
/// vector uses again is not zero.
template <class T>
class ZeroArray : public std::vector<T, ZeroAllocator<T>> {
 public:
  using std::vector<T, ZeroAllocator<T>>::vector;
  ZeroArray& operator=(const std::vector<T>& values) {
    this->assign(values.begin(), values.end());
    return *this;
  }
};

}  // namespace abut::state
