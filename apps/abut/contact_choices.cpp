#include "contact_choices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/diagnostic.hpp"

namespace abut::app {
namespace {

struct Choice {
  const model::Interface* card = nullptr;
  std::vector<double> numbers;
};

/// "ID:NUMBER:..." with `least` to `most` numbers >= 0.
Choice read_choice(const model::Model& model, const char* option, const std::string& text, std::size_t least, std::size_t most) {
  const auto refuse = [&](const std::string& why) { throw RunError(fmt::format("{} {}: {}", option, text, why)); };
  std::vector<double> values;
  std::string_view rest = text;
  for (;;) {
    const std::size_t colon = rest.find(':');
    const std::string_view part = rest.substr(0, colon);
    double value = 0.0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size() || !(value >= 0.0) || !std::isfinite(value)) {
      refuse(fmt::format("'{}' is not a number >= 0", part));
    }
    values.push_back(value);
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  Choice c;
  for (const model::Interface& i : model.interfaces) {
    if (static_cast<double>(i.id) == values.front()) c.card = &i;
  }
  if (c.card == nullptr) refuse("the deck has no such interface");
  c.numbers.assign(values.begin() + 1, values.end());
  if (c.numbers.size() < least || c.numbers.size() > most) refuse("expected an interface id and times between colons");
  return c;
}

}  // namespace

std::vector<init::GradualStart> gradual_starts(const model::Model& model, std::span<const std::string> texts) {
  std::vector<init::GradualStart> out;
  for (const std::string& text : texts) {
    const Choice c = read_choice(model, "--contact-ramp", text, 1, 1);
    if (std::holds_alternative<model::InterfaceType7>(c.card->type)) {
      throw RunError(
          fmt::format("--contact-ramp {}: interface {} is of TYPE7, which has Inacti 5 and 6 for initial penetrations", text, c.card->id));
    }
    out.push_back({c.card->id, c.numbers.front()});
  }
  return out;
}

ContactLogs contact_logs(const model::Model& model, std::span<const std::string> texts, const std::string& program) {
  ContactLogs logs;
  for (const std::string& text : texts) {
    const Choice c = read_choice(model, "--record-contact", text, 0, 2);
    cycle::ContactRecording r;
    r.interface_id = c.card->id;
    if (!c.numbers.empty()) r.from = c.numbers[0];
    if (c.numbers.size() > 1) r.to = c.numbers[1];
    r.label = fmt::format("{}, deck {}, interface {}", program, model.name, c.card->id);
    const auto again = [&r](const cycle::ContactRecording& other) { return other.interface_id == r.interface_id; };
    if (std::any_of(logs.recordings.begin(), logs.recordings.end(), again)) {
      throw RunError(fmt::format("--record-contact {}: interface {} is recorded already", text, r.interface_id));
    }
    logs.recordings.push_back(std::move(r));
  }
  return logs;
}

void open_contact_logs(ContactLogs& logs, const output::RunFolder& folder) {
  for (cycle::ContactRecording& r : logs.recordings) {
    const std::filesystem::path path = folder.contact_calls(r.interface_id);
    logs.files.push_back(std::make_unique<std::ofstream>(path, std::ios::binary));
    if (!*logs.files.back()) throw RunError("cannot write '" + path.string() + "'");
    r.log = logs.files.back().get();
  }
}

}  // namespace abut::app
