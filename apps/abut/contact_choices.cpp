#include "contact_choices.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "abut/diagnostic.hpp"

namespace abut::app {
namespace {

/// The numbers of "ID:NUMBER:...": an id, then `least` to `most` numbers, all >= 0.
std::vector<double> read_choice(const char* option, const std::string& text, std::size_t least, std::size_t most) {
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
  if (values.front() != std::floor(values.front()) || values.front() > 1e15) refuse("the interface id is not an integer");
  if (values.size() < least + 1 || values.size() > most + 1) refuse("expected an interface id and times between colons");
  return values;
}

}  // namespace

std::vector<ContactRecording> contact_recordings(std::span<const std::string> texts) {
  std::vector<ContactRecording> out;
  for (const std::string& text : texts) {
    const std::vector<double> numbers = read_choice("--record-contact", text, 0, 2);
    ContactRecording r;
    r.interface_id = static_cast<Id>(numbers[0]);
    if (numbers.size() > 1) r.from = numbers[1];
    if (numbers.size() > 2) r.to = numbers[2];
    out.push_back(r);
  }
  return out;
}

}  // namespace abut::app
