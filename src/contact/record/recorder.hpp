// Writes the call log of one interface. The file: head (magic, version), then records (kind, length, payload, checksum).
#pragma once

#include <cstdint>
#include <ostream>
#include <span>
#include <string_view>
#include <vector>

#include "abut/contact/interface.hpp"
#include "contact/record/bytes.hpp"
#include "contact/record/recipe.hpp"

namespace abut::contact {

inline constexpr std::uint64_t log_magic = 0x31474F4C54554241ULL;  // "ABUTLOG1" where the least byte comes first
/// Rises with every change of a record or of what stands in it.
inline constexpr std::uint64_t log_version = 6;

enum class LogRecord : std::uint32_t {
  made = 1,  ///< label, recipe (compact)
  surface,   ///< side, the four arrays of a SurfaceState
  history,   ///< blob: restored at this point
  search,    ///< host state
  evaluate,  ///< host state, what the spans held before
  result,    ///< digest of the spans after, StepResult
  commit,    ///< dt
};

struct RecordHead {
  std::uint64_t kind = 0, length = 0;
};

/// Force and stiffness of one interface node, as the host's spans hold them.
struct NodeLoad {
  std::uint64_t node = 0;
  Vec3 force;
  double stiffness = 0.0;
  [[nodiscard]] bool zero() const { return force == Vec3{} && stiffness == 0.0; }
};

class Recorder {
 public:
  Recorder(std::ostream& out, const Recipe& recipe, std::span<const SurfaceValues> surfaces, std::span<const std::byte> history,
           std::string_view label);

  void surface(int side, const SurfaceState& state);
  void history(std::span<const std::byte> blob);
  /// Before the calls: a call that does not come back is in the log.
  void search(const HostState& host);
  void evaluate(const HostState& host, std::span<const Vec3> force, std::span<const double> stiffness);
  void result(const StepResult& result, std::span<const Vec3> force, std::span<const double> stiffness);
  void commit(double dt);

 private:
  std::ostream& out_;
  std::vector<Index> hosted_;
  std::vector<Vec3> x_, v_;
  std::vector<double> mass_;
  std::vector<Index> constrained_;
  std::vector<Mobility> mobility_;
  ByteWriter payload_;

  void state(const HostState& host);
  void write(LogRecord kind);
};

/// Of force and stiffness of the given host nodes, in their order.
[[nodiscard]] std::uint64_t load_digest(std::span<const Index> nodes, std::span<const Vec3> force, std::span<const double> stiffness);

}  // namespace abut::contact
