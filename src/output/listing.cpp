#include "output/listing.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string_view>
#include <utility>

#include "output/animation_fields.hpp"
#include "output/element_lookup.hpp"
#include "output/erosion_watch.hpp"
#include "output/history_columns.hpp"
#include "output/summary.hpp"

namespace abut::output {
namespace {

constexpr int lines_per_header = 50;
constexpr std::string_view columns =
    "\n     CYCLE          TIME     TIME-STEP  BY              ID   ERROR%    I-ENERGY  K-ENERGY-T  K-ENERGY-R  CONT-ENERGY  "
    "CONT-MADE    EXT-WORK    MASS-ERR\n";

constexpr std::string_view legend = R"(
Columns of the cycle listing
  BY, ID       what gives the time step: an element, a node, an interface
  ERROR%       100 (I + H + K-T + K-R + CONT-ENERGY + X - EXT-WORK - initial) / largest term so far; H hourglass, X eroded and added mass
  I-ENERGY     internal energy, without hourglass
  CONT-ENERGY  interfaces: stored, friction and damping
  CONT-MADE    energy that the interfaces made or lost (GLOBAL/CX)
  MASS-ERR     added mass over initial mass
)";

std::string list(const std::vector<std::string>& items) {
  std::string s;
  for (const std::string& item : items) s += (s.empty() ? "" : ", ") + item;
  return s;
}

}  // namespace

Listing::Listing(const RunFolder& folder, RunInfo info) : file_(folder.listing(), info.opening()), info_(std::move(info)) {}

void Listing::begin(const cycle::Snapshot& first) {
  record_.begin(first);
  if (info_.resumed) {
    lines_ = 0;
    file_.append(fmt::format("\nRun {} goes on from the checkpoint of cycle {}, time {:.8g}: abut {}, {} threads, {}\n", info_.resumed->run,
                             info_.resumed->cycle, info_.resumed->time, info_.version, info_.threads, info_.instruction_set));
    return;
  }
  std::string text = fmt::format("abut {}{}\n", info_.version, info_.commit.empty() ? "" : fmt::format(" ({})", info_.commit));
  for (const std::string& deck : info_.decks) text += fmt::format("Deck        {}\n", deck);
  text += fmt::format("Settings    profile {}, {} threads, {}, {}\n", info_.profile, info_.threads, info_.instruction_set, info_.compiler);
  for (const std::string& choice : info_.interfaces) text += fmt::format("Interface   {}\n", choice);
  text += "\n";
  text += model_summary(*first.model, part_masses(*first.model, first.groups));
  if (!info_.findings.empty()) text += "\nFindings\n";
  for (const Diagnostic& finding : info_.findings) text += "  " + to_string(finding) + "\n";

  const auto history = make_history_columns(*first.model, ElementLookup(*first.model, first.groups)).left_out;
  const auto animation = select_animation_fields(first.model->controls.animation_fields).left_out;
  if (!history.empty()) text += "\nNot computed, left out of the time history: " + list(history) + "\n";
  if (!animation.empty()) text += "\nNot computed, left out of the animation: " + list(animation) + "\n";
  file_.append(text + std::string(legend));
}

void Listing::cycle(const cycle::Snapshot& now) {
  record_.cycle(now);
  say_findings();
  if (!now.listing_due) return;
  const state::Balance& b = *now.balance;
  std::string text;
  if (lines_++ % lines_per_header == 0) text = columns;
  fmt::format_to(
      std::back_inserter(text),
      "{:>10}  {:>12.6g}  {:>12.5g}  {:<6}{:>12}  {:>7.2f}  {:>10.4g}  {:>10.4g}  {:>10.4g}  {:>11.4g}  {:>9.3g}  {:>10.4g}  {:>10.3g}\n",
      now.state->times.cycle, now.state->times.t, now.state->times.h_plus, controller_name(now.controller.kind), now.controller.id,
      100.0 * b.err, b.ie, b.ke, b.ker, b.ce + b.fw + b.dw, b.cx, b.extw, mass_error(b));
  file_.append(text);
}

void Listing::say_findings() {
  for (; said_ < info_.during->size(); ++said_) file_.append("  " + to_string((*info_.during)[said_].diagnostic) + "\n");
}

void Listing::persist(state::Archive& a) {
  file_.persist(a);
  record_.persist(a);
  std::uint64_t said = said_;
  a(said);
  said_ = said;
}

void Listing::end(const cycle::Outcome& outcome) {
  say_findings();
  const state::Balance& b = record_.balance();
  std::string text = fmt::format("\nThe run {}\n", outcome_text(outcome));
  text += fmt::format("Wall time   {:.2f} s, {:.4g} element-cycles/s\n", record_.wall_seconds(), record_.rate(outcome.cycles));
  if (record_.any()) {
    text += fmt::format(
        "Energies    internal {:.6g}, hourglass {:.6g}, kinetic {:.6g}, rotational {:.6g}, contact stored {:.6g}, friction {:.6g}, damping "
        "{:.6g}, contact made {:.6g}, external work {:.6g}\n",
        b.ie, b.he, b.ke, b.ker, b.ce, b.fw, b.dw, b.cx, b.extw);
    text +=
        fmt::format("Worst       energy error {:.3f} % at time {:.6g}, contact made {:.4g} at time {:.6g}\n",
                    100.0 * record_.worst_error().value, record_.worst_error().time, record_.worst_made().value, record_.worst_made().time);
  }
  for (const RunFinding& f : *info_.during) {
    if (f.diagnostic.code == ErosionWatch::deleted) text += fmt::format("Deleted     {}\n", f.diagnostic.message);
  }
  if (b.added_mass > 0.0) {
    text += fmt::format("Added mass  {:.6g} by /DT/NODA/CST, {:.3g} % of the mass without it\n", b.added_mass, 100.0 * mass_error(b));
  }
  if (!record_.hashes().empty()) {
    const RunRecord::Hash& last = record_.hashes().back();
    text += fmt::format("State hash  {:016x} at cycle {}\n", last.value, last.cycle);
  }
  file_.append(text);
  file_.close();
}

}  // namespace abut::output
