// Arrays that begin as zeros and take memory only where something is written.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

namespace abut::state {

/// Allocates zeroed memory, of which the system gives pages at the first write only; a default-constructed T must be all zeros.
template <class T>
struct ZeroAllocator {
  using value_type = T;
  ZeroAllocator() = default;
  template <class U>
  ZeroAllocator(const ZeroAllocator<U>&) {}  // NOLINT: allocators convert
  [[nodiscard]] T* allocate(std::size_t n) {
    void* p = std::calloc(n, sizeof(T));
    if (p == nullptr) throw std::bad_alloc();
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t) noexcept { std::free(p); }
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
