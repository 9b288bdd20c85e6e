// The call log: recorded calls made again give the same bits; damaged logs and foreign histories are refused in words.
#include <gtest/gtest.h>

#include <abut/contact/call_log.hpp>
#include <cmath>
#include <cstring>
#include <span>
#include <sstream>
#include <string>

#include "contact/record/bytes.hpp"
#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::grid;
using test::Host;
using test::set_stiffness;

double wavy(double x, double y) { return 0.05 * std::sin(3.0 * x) * std::cos(2.0 * y); }

/// Two wavy sheets that rub on each other; nodes of no interface come first and in between, keys run against the host's numbers.
struct Scene {
  Host host;
  std::vector<Facet> lower, upper;
  std::vector<Index> held;
  Scene() {
    host.add({9, 9, 9}, 1.0);
    lower = grid(host, 8, 6, -2, 2, -1.5, 1.5, wavy, true, false, 1.0);
    host.add({9, 9, 9}, 1.0);
    upper = grid(
        host, 7, 5, -1.2, 1.4, -1, 1, [](double x, double y) { return 0.2 + wavy(y, x); }, false, true, 1.0);
    for (std::size_t n = 0; n < host.x.size(); ++n) {
      const double way = n < 65 ? 1.0 : -1.0;
      host.v[n] = {0.3 * way, 0.1 * way, 0.4 * way};
      if (n >= 65) held.push_back(static_cast<Index>(n));
    }
  }
  [[nodiscard]] std::vector<Id> keys() const {
    std::vector<Id> k;
    for (std::size_t n = 0; n < host.x.size(); ++n) k.push_back(static_cast<Id>((n * 37) % 1009));
    return k;
  }
};

enum class Kind { two, nodes, both };

Interface make(const Scene& s, Kind kind, const Rules& rules = {}) {
  Options o;
  o.gap = 0.15;
  o.friction = 0.3;
  o.damping = 0.05;
  o.rules = rules;
  BothSidesOptions b;
  b.gap = 0.15;
  b.friction = 0.3;
  b.friction_form = BothSidesOptions::Friction::incremental;
  const Surface main(s.lower, s.keys());
  Interface i = kind == Kind::two     ? Interface::two_surfaces(main, Surface(s.upper, s.keys()), o)
                : kind == Kind::nodes ? Interface::nodes_to_surface(s.held, std::vector<double>(s.held.size(), 2.0), main, o)
                                      : Interface::both_sides(s.held, main, b);
  set_stiffness(i, kind == Kind::two ? 0 : 1, s.lower.size(), 20.0);
  if (kind == Kind::two) set_stiffness(i, 1, s.upper.size(), 30.0);
  return i;
}

void erode(Interface& i, const Scene& s, Kind kind) {
  std::vector<std::uint8_t> active(s.lower.size(), 1);
  active[20] = active[21] = 0;
  i.set_surface(kind == Kind::two ? 0 : 1, {.active = active});
}

struct Recorded {
  std::string log;
  Host with, without;  ///< the host's end, recorded and not
  double most_in_contact = 0;
};

/// A log from step 60 on; facets erode at step 100.
Recorded record(Kind kind, const Rules& rules = {}, int steps = 160) {
  Recorded out;
  for (const bool recorded : {false, true}) {
    Scene s;
    Interface i = make(s, kind, rules);
    std::ostringstream log;
    for (int step = 0; step < steps; ++step) {
      if (recorded && step == 60) i.record(log, "a test");
      if (step == 100) erode(i, s, kind);
      s.host.step(i, 0.005);
      out.most_in_contact = std::max<double>(out.most_in_contact, s.host.last.in_contact);
    }
    (recorded ? out.with : out.without) = s.host;
    if (recorded) out.log = log.str();
  }
  return out;
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

TEST(CallLog, replays_the_same_bits) {
  for (const Kind kind : {Kind::two, Kind::nodes, Kind::both}) {
    for (const bool reference : {false, true}) {
      const Recorded r = record(kind, reference ? Rules::reference() : Rules::standard());
      EXPECT_GT(r.most_in_contact, 10);
      EXPECT_TRUE(same_bits(r.with.x, r.without.x) && same_bits(r.with.v, r.without.v)) << "recording changes the results";
      std::istringstream log(r.log);
      std::int64_t touched = 0;
      const Replay again = replay(log, [&](const ReplayedStep& s) {
        touched += s.replayed.in_contact;
        EXPECT_NEAR(s.time, 0.005 * static_cast<double>(60 + s.number), 1e-9);
        EXPECT_EQ(s.recorded.made, s.replayed.made);
      });
      EXPECT_EQ(again.label, "a test");
      EXPECT_EQ(again.steps, 100);
      EXPECT_EQ(again.different, 0) << again.first_different;
      EXPECT_EQ(again.facets, kind == Kind::two ? 48 + 70 : 48);
      EXPECT_EQ(again.nodes, 63 + 48);
      EXPECT_GT(touched, 0);
    }
  }
}

// A log may begin at any step: what an interface says does not depend on how old its search lists are (they begin anew in a replay).
TEST(CallLog, may_begin_anywhere) {
  for (const Kind kind : {Kind::two, Kind::nodes, Kind::both}) {
    for (int from = 0; from < 120; from += 7) {
      Scene s;
      for (std::size_t n = 65; n < s.host.x.size(); ++n) s.host.x[n].z += 0.5;
      Interface i = make(s, kind);
      std::ostringstream log;
      for (int step = 0; step < 180; ++step) {
        if (step == from) i.record(log);
        s.host.step(i, 0.005);
      }
      EXPECT_GT(s.host.last.in_contact + s.host.last.elastic + s.host.last.friction_work, 0.0);
      std::istringstream in(log.str());
      const Replay again = replay(in);
      EXPECT_EQ(again.steps, 180 - from);
      EXPECT_EQ(again.different, 0) << "from step " << from << ", differs in " << again.first_different;
    }
  }
}

// What the host's spans held before is part of a bit-for-bit result: two interfaces on the same nodes.
TEST(CallLog, knows_what_others_added_before) {
  Scene s;
  Interface a = make(s, Kind::two), b = make(s, Kind::nodes);
  std::ostringstream log;
  b.record(log);
  for (int step = 0; step < 80; ++step) {
    s.host.f.assign(s.host.x.size(), {});
    s.host.k.assign(s.host.x.size(), 0.0);
    for (Interface* i : {&a, &b}) i->search(s.host.state());
    a.evaluate(s.host.state(), s.host.f, s.host.k);
    b.evaluate(s.host.state(), s.host.f, s.host.k);
    for (Interface* i : {&a, &b}) i->commit(0.005);
    for (std::size_t n = 0; n < s.host.x.size(); ++n) {
      s.host.v[n] += 0.005 * s.host.f[n];
      s.host.x[n] += 0.005 * s.host.v[n];
    }
    s.host.dt = 0.005;
    s.host.time += 0.005;
  }
  std::istringstream in(log.str());
  const Replay again = replay(in);
  EXPECT_EQ(again.steps, 80);
  EXPECT_EQ(again.different, 0) << again.first_different;
}

// A result that another build or a changed input gives is seen: the digest is of every bit.
TEST(CallLog, sees_a_different_result) {
  const std::string log = record(Kind::two).log;
  // Patch a stiffness of the surface record (with its checksum) and play: forces differ from the recorded ones.
  const double value = 30.0, changed = 30.0 + 1e-13;
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
  std::string patched = log;
  const std::size_t at = patched.find(bytes + bytes + bytes);
  ASSERT_NE(at, std::string::npos);
  // Find the record that holds it.
  std::size_t start = 16;
  for (;;) {
    std::uint64_t length = 0;
    std::memcpy(&length, patched.data() + start + 8, 8);
    if (at < start + 16 + length) {
      std::memcpy(patched.data() + at, &changed, sizeof changed);
      const std::uint64_t sum = checksum(std::as_bytes(std::span(patched)).subspan(start, 16 + length));
      std::memcpy(patched.data() + start + 16 + length, &sum, 8);
      break;
    }
    start += 16 + length + 8;
  }
  std::istringstream in(patched);
  const Replay again = replay(in);
  EXPECT_EQ(again.steps, 100);
  EXPECT_GT(again.different, 0);
  EXPECT_GE(again.first_different, 0);
}

std::string refusal(const std::string& log) {
  std::istringstream in(log);
  try {
    replay(in);
  } catch (const std::invalid_argument& e) { return e.what(); }
  return "";
}

TEST(CallLog, refuses_what_is_damaged) {
  const std::string log = record(Kind::nodes, {}, 62).log;
  EXPECT_EQ(refusal(log), "");
  EXPECT_NE(refusal("").find("not a call log"), std::string::npos);
  EXPECT_NE(refusal("a deck\nof some kind").find("not a call log"), std::string::npos);
  std::string other = log;
  other[8] = 99;
  EXPECT_NE(refusal(other).find("version 99"), std::string::npos);
  // Whole records, no end mark: a host that died leaves a log that ends between records.
  std::uint64_t length = 0;
  std::memcpy(&length, log.data() + 24, 8);
  EXPECT_EQ(refusal(log.substr(0, 16 + 16 + length + 8)), "");
  EXPECT_NE(refusal(log.substr(0, 16)).find("before the interface is made"), std::string::npos);
  for (const std::size_t cut : {17U, 31U, 40U, 500U})
    EXPECT_NE(refusal(log.substr(0, log.size() - cut)).find("not whole"), std::string::npos);
  // Every flipped byte is found, wherever it is (a sample, the length fields among it).
  std::size_t flips = 0;
  for (std::size_t at = 0; at < log.size(); at += at < 1200 ? 1 : 97) {
    std::string flipped = log;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    EXPECT_NE(refusal(flipped), "") << at;
    ++flips;
  }
  EXPECT_GT(flips, 1200U);
}

std::string restore_refusal(Interface& i, std::span<const std::byte> blob) {
  try {
    i.restore(blob);
  } catch (const std::invalid_argument& e) { return e.what(); }
  return "";
}

TEST(History, refuses_other_versions_and_other_interfaces) {
  Scene s;
  Interface i = make(s, Kind::two);
  for (int step = 0; step < 40; ++step) s.host.step(i, 0.005);
  const std::vector<std::byte> blob = i.history();
  Interface same = make(s, Kind::two);
  EXPECT_EQ(restore_refusal(same, blob), "");
  EXPECT_EQ(same.history(), blob);

  std::vector<std::byte> old = blob;
  old[8] = std::byte{1};
  EXPECT_NE(restore_refusal(same, old).find("version 1; this library reads version 8"), std::string::npos) << restore_refusal(same, old);
  Interface nodes = make(s, Kind::nodes), both = make(s, Kind::both), reference = make(s, Kind::two, Rules::reference());
  for (Interface* other : {&nodes, &both, &reference}) {
    EXPECT_NE(restore_refusal(*other, blob).find("another interface"), std::string::npos) << restore_refusal(*other, blob);
  }
  // The same number of nodes and facets, another mesh.
  Scene t;
  std::swap(t.lower[3], t.lower[4]);
  Interface listed = make(t, Kind::two);
  EXPECT_NE(restore_refusal(listed, blob).find("another interface"), std::string::npos);
  std::vector<std::byte> flipped = blob;
  flipped[flipped.size() / 2] ^= std::byte{4};
  EXPECT_NE(restore_refusal(same, flipped).find("checksum"), std::string::npos);
  EXPECT_NE(restore_refusal(same, std::span(blob).first(blob.size() - 8)).find("damaged"), std::string::npos);
  EXPECT_NE(restore_refusal(same, std::span(blob).first(10)).find("not a history blob"), std::string::npos);
  EXPECT_EQ(same.history(), blob) << "a refused blob changes nothing";
}

// The order of the verbs and the length of the spans are checked, not assumed.
TEST(Interface, says_what_a_host_does_wrong) {
  Scene s;
  Interface i = make(s, Kind::two);
  std::vector<Vec3> force(s.host.x.size());
  std::vector<double> stiffness(s.host.x.size());
  EXPECT_THROW(i.evaluate(s.host.state(), force, stiffness), std::logic_error);
  EXPECT_THROW(i.commit(1.0), std::logic_error);
  HostState brief = s.host.state();
  brief.v = brief.v.first(20);
  EXPECT_THROW(i.search(brief), std::invalid_argument);
  i.search(s.host.state());
  EXPECT_THROW(i.evaluate(s.host.state(), std::span(force).first(5), stiffness), std::invalid_argument);
  EXPECT_NO_THROW(i.evaluate(s.host.state(), force, stiffness));
  EXPECT_NO_THROW(i.commit(1.0));
}

}  // namespace
}  // namespace abut::contact
