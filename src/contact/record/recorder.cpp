#include "contact/record/recorder.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "contact/record/fields.hpp"

namespace abut::contact {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

template <class T>
bool gather(std::span<const T> from, std::span<const Index> nodes, std::vector<T>& to) {
  std::vector<T> now;
  if (!from.empty()) {
    now.reserve(nodes.size());
    for (const Index n : nodes) now.push_back(from[at(n)]);
  }
  const bool changed = now.size() != to.size() || (!now.empty() && std::memcmp(now.data(), to.data(), now.size() * sizeof(T)) != 0);
  to = std::move(now);
  return changed;
}

}  // namespace

std::uint64_t load_digest(std::span<const Index> nodes, std::span<const Vec3> force, std::span<const double> stiffness) {
  std::uint64_t hash = checksum({});
  for (const Index n : nodes) {
    const std::array<double, 4> now{force[at(n)].x, force[at(n)].y, force[at(n)].z, stiffness[at(n)]};
    hash = checksum(std::as_bytes(std::span(now)), hash);
  }
  return hash;
}

Recorder::Recorder(std::ostream& out, const Recipe& recipe, std::span<const SurfaceValues> surfaces, std::span<const std::byte> blob,
                   std::string_view label)
    : out_(out), hosted_(recipe.hosted) {
  const std::array<std::uint64_t, 2> head{log_magic, log_version};
  out_.write(reinterpret_cast<const char*>(head.data()), sizeof head);
  payload_.put_all(std::span(label.data(), label.size()));
  recipe.compact().write(payload_);
  write(LogRecord::made);
  for (std::size_t k = 0; k < surfaces.size(); ++k) surface(static_cast<int>(k), surfaces[k].spans());
  history(blob);
}

void Recorder::write(LogRecord kind) {
  ByteWriter head;
  head.put(RecordHead{static_cast<std::uint64_t>(kind), payload_.bytes().size()});
  const std::uint64_t sum = checksum(payload_.bytes(), checksum(head.bytes()));
  const auto put = [this](std::span<const std::byte> bytes) {
    out_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  put(head.bytes());
  put(payload_.bytes());
  put(std::as_bytes(std::span(&sum, 1)));
  out_.flush();
  payload_.clear();
  if (!out_) throw std::runtime_error("contact: the call log cannot be written");
}

void Recorder::surface(int side, const SurfaceState& state) {
  payload_.put(static_cast<std::int64_t>(side));
  payload_.put_all(state.stiffness);
  payload_.put_all(state.thickness);
  payload_.put_all(state.active);
  payload_.put_all(state.node_active);
  write(LogRecord::surface);
}

void Recorder::history(std::span<const std::byte> blob) {
  payload_.put_all(blob);
  write(LogRecord::history);
}

void Recorder::state(const HostState& host) {
  for (const double t : {host.time, host.dt, host.dt_bar_old}) payload_.put(t);
  const bool moved = host.mobility.size() != mobility_.size() ||
                     (!mobility_.empty() && std::memcmp(host.mobility.data(), mobility_.data(), mobility_.size() * sizeof(Mobility)) != 0);
  if (moved) mobility_.assign(host.mobility.begin(), host.mobility.end());
  const std::array<std::uint8_t, 5> changed{gather(host.x, hosted_, x_), gather(host.v, hosted_, v_), gather(host.mass, hosted_, mass_),
                                            gather(host.constrained, hosted_, constrained_), moved};
  payload_.put(changed);
  if (changed[0] != 0) payload_.put_all(x_);
  if (changed[1] != 0) payload_.put_all(v_);
  if (changed[2] != 0) payload_.put_all(mass_);
  if (changed[3] != 0) payload_.put_all(constrained_);
  if (changed[4] != 0) payload_.put_all(mobility_);
}

void Recorder::search(const HostState& host) {
  state(host);
  write(LogRecord::search);
}

void Recorder::evaluate(const HostState& host, std::span<const Vec3> force, std::span<const double> stiffness) {
  state(host);
  std::vector<NodeLoad> before;
  for (std::size_t i = 0; i < hosted_.size(); ++i) {
    const NodeLoad load{i, force[at(hosted_[i])], stiffness[at(hosted_[i])]};
    if (!load.zero()) before.push_back(load);
  }
  payload_.put_all(before);
  write(LogRecord::evaluate);
}

void Recorder::result(const StepResult& result, std::span<const Vec3> force, std::span<const double> stiffness) {
  payload_.put(load_digest(hosted_, force, stiffness));
  StepResult compact = result;
  for (Index* node : {&compact.kinematic_node, &compact.deepest_node}) {
    if (*node != no_index) *node = static_cast<Index>(std::lower_bound(hosted_.begin(), hosted_.end(), *node) - hosted_.begin());
  }
  FieldWriter out(payload_);
  fields(out, compact);
  write(LogRecord::result);
}

void Recorder::commit(double dt) {
  payload_.put(dt);
  write(LogRecord::commit);
}

}  // namespace abut::contact
