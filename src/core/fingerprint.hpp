// A number that tells texts apart.
#pragma once

#include <cstdint>
#include <string_view>

namespace abut {

/// FNV-1a over bytes.
class Fingerprint {
 public:
  /// A text and its end: texts that follow each other do not run into one.
  void add(std::string_view text) {
    add_bytes(text);
    byte(0);
  }
  void add_bytes(std::string_view bytes) {
    for (const char c : bytes) byte(static_cast<unsigned char>(c));
  }
  void byte(unsigned char b) { hash_ = (hash_ ^ b) * 0x100000001b3ULL; }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace abut
