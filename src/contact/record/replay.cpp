#include <array>
#include <istream>
#include <optional>
#include <stdexcept>
#include <utility>

#include "abut/contact/call_log.hpp"
#include "contact/record/fields.hpp"
#include "contact/record/recorder.hpp"

namespace abut::contact {
namespace {

/// Reads a log record by record; every record that it returns is whole.
class LogReader {
 public:
  explicit LogReader(std::istream& in) : in_(in) {
    std::array<std::uint64_t, 2> head{};
    const std::size_t got = take(std::as_writable_bytes(std::span(head)));
    if (got < sizeof head[0] || head[0] != log_magic) throw std::invalid_argument("contact log: not a call log (or of another byte order)");
    if (got < sizeof head) throw std::invalid_argument("contact log: it ends inside its head");
    if (head[1] != log_version) {
      throw std::invalid_argument("contact log: it has version " + std::to_string(head[1]) + "; this library reads version " +
                                  std::to_string(log_version) + " only");
    }
  }

  /// False at the end of the file.
  bool next() {
    start_ = position_;
    RecordHead head;
    std::array<std::byte, sizeof head> raw{};
    const std::size_t got = take(raw);
    if (got == 0) return false;
    if (got < raw.size()) refuse("is not whole: the file ends inside its head");
    std::memcpy(&head, raw.data(), raw.size());
    payload_.clear();
    // In pieces: a damaged length must not ask for all memory.
    constexpr std::uint64_t piece = 1 << 20;
    while (payload_.size() < head.length) {
      const std::size_t old = payload_.size();
      const std::uint64_t wanted = std::min(piece, head.length - old);
      payload_.resize(old + wanted);
      if (take(std::span(payload_).subspan(old)) < wanted) refuse("is not whole: the file ends inside it, or its length is damaged");
    }
    std::uint64_t sum = 0;
    if (take(std::as_writable_bytes(std::span(&sum, 1))) < sizeof sum) refuse("is not whole: the file ends inside it");
    if (sum != checksum(payload_, checksum(raw))) refuse("is damaged: its checksum does not fit");
    if (head.kind < 1 || head.kind > static_cast<std::uint64_t>(LogRecord::commit)) refuse("is of an unknown kind");
    kind_ = static_cast<LogRecord>(head.kind);
    ++number_;
    return true;
  }
  [[nodiscard]] LogRecord kind() const { return kind_; }
  [[nodiscard]] ByteReader payload() const { return {payload_, name()}; }
  [[noreturn]] void refuse(const std::string& why) const { throw std::invalid_argument(name() + " " + why); }

 private:
  std::istream& in_;
  std::vector<std::byte> payload_;
  LogRecord kind_ = LogRecord::made;
  std::int64_t number_ = 0;
  std::uint64_t position_ = 0, start_ = 0;

  [[nodiscard]] std::string name() const {
    return "contact log: record " + std::to_string(number_) + " (at byte " + std::to_string(start_) + ")";
  }
  std::size_t take(std::span<std::byte> to) {
    in_.read(reinterpret_cast<char*>(to.data()), static_cast<std::streamsize>(to.size()));
    const auto got = static_cast<std::size_t>(in_.gcount());
    position_ += got;
    return got;
  }
};

/// The host of a replay: the interface's nodes and no others.
class Player {
 public:
  explicit Player(const Recipe& recipe) : interface_(recipe.make()), hosted_(recipe.hosted), force_(hosted_.size()) {
    stiffness_.assign(hosted_.size(), 0.0);
  }

  void surface(ByteReader& in) {
    const auto side = in.next<std::int64_t>();
    if (side < 0 || side > 1) in.refuse("names a side that does not exist");
    SurfaceValues values;
    in.get_any(values.stiffness);
    in.get_any(values.thickness);
    in.get_any(values.active);
    in.get_any(values.node_active);
    interface_.set_surface(static_cast<int>(side), values.spans());
  }
  void history(ByteReader& in) {
    std::vector<std::byte> blob;
    in.get_any(blob);
    interface_.restore(blob);
  }
  void search(ByteReader& in) {
    state(in);
    interface_.search(host_);
  }
  void evaluate(ByteReader& in) {
    state(in);
    std::vector<NodeLoad> before;
    in.get_any(before);
    std::fill(force_.begin(), force_.end(), Vec3{});
    std::fill(stiffness_.begin(), stiffness_.end(), 0.0);
    for (const NodeLoad& load : before) {
      if (load.node >= hosted_.size()) in.refuse("names a node that does not exist");
      force_[load.node] = load.force;
      stiffness_[load.node] = load.stiffness;
    }
    result_ = interface_.evaluate(host_, force_, stiffness_);
  }
  ReplayedStep result(ByteReader& in) const {
    ReplayedStep step;
    step.time = host_.time;
    step.dt = host_.dt;
    step.replayed = result_;
    const auto digest = in.next<std::uint64_t>();
    ByteWriter again;
    FieldWriter out(again);
    fields(out, result_);
    ByteReader rest = in;
    FieldReader results(in);
    fields(results, step.recorded);
    std::vector<std::byte> recorded(rest.left() - in.left());
    for (std::byte& b : recorded) rest.get(b);
    const bool same_results = std::equal(recorded.begin(), recorded.end(), again.bytes().begin(), again.bytes().end());
    step.same = same_results && digest == load_digest(hosted_, force_, stiffness_);
    return step;
  }
  void commit(ByteReader& in) { interface_.commit(in.next<double>()); }

 private:
  Interface interface_;
  std::vector<Index> hosted_;
  std::vector<Vec3> x_, v_, force_;
  std::vector<double> mass_, stiffness_;
  std::vector<Index> constrained_;
  std::vector<Mobility> mobility_;
  HostState host_;
  StepResult result_;

  void state(ByteReader& in) {
    in.get(host_.time);
    in.get(host_.dt);
    in.get(host_.dt_bar_old);
    const auto changed = in.next<std::array<std::uint8_t, 5>>();
    if (changed[0] != 0) in.get_any(x_);
    if (changed[1] != 0) in.get_any(v_);
    if (changed[2] != 0) in.get_any(mass_);
    if (changed[3] != 0) in.get_any(constrained_);
    if (changed[4] != 0) in.get_any(mobility_);
    host_.x = x_;
    host_.v = v_;
    host_.mass = mass_;
    host_.constrained = constrained_;
    host_.mobility = mobility_;
  }
};

const char* name_of(Recipe::Kind kind) {
  switch (kind) {
    case Recipe::Kind::nodes_to_surface:
      return "nodes to surface";
    case Recipe::Kind::both_sides:
      return "both sides";
    case Recipe::Kind::two_surfaces:
      break;
  }
  return "two surfaces";
}

}  // namespace

Replay replay(std::istream& log, const std::function<void(const ReplayedStep&)>& each) {
  LogReader reader(log);
  Replay out;
  std::optional<Player> player;
  while (reader.next()) {
    ByteReader in = reader.payload();
    if ((reader.kind() == LogRecord::made) == player.has_value()) {
      reader.refuse(player ? "makes the interface a second time" : "comes before the interface is made");
    }
    switch (reader.kind()) {
      case LogRecord::made: {
        std::vector<char> label;
        in.get_any(label);
        const Recipe recipe = Recipe::read(in);
        out.label.assign(label.begin(), label.end());
        out.kind = name_of(recipe.kind);
        out.nodes = static_cast<std::int64_t>(recipe.hosted.size());
        for (const Recipe::Topology& t : recipe.side) out.facets += static_cast<std::int64_t>(t.facets.size());
        player.emplace(recipe);
        break;
      }
      case LogRecord::surface:
        player->surface(in);
        break;
      case LogRecord::history:
        player->history(in);
        break;
      case LogRecord::search:
        player->search(in);
        break;
      case LogRecord::evaluate:
        player->evaluate(in);
        break;
      case LogRecord::result: {
        ReplayedStep step = player->result(in);
        step.number = out.steps++;
        if (!step.same && out.different++ == 0) out.first_different = step.number;
        if (each) each(step);
        break;
      }
      case LogRecord::commit:
        player->commit(in);
        break;
    }
    in.finish();
  }
  if (!player) throw std::invalid_argument("contact log: it ends before the interface is made");
  return out;
}

}  // namespace abut::contact
