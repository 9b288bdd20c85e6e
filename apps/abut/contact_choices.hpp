// What the command line asks of single interfaces: ID:NUMBER...
#pragma once

#include <span>
#include <string>
#include <vector>

#include "abut/run.hpp"

namespace abut::app {

/// "--contact-ramp ID:TIME". @throws RunError naming the text and what is wrong with it
[[nodiscard]] std::vector<GradualStart> gradual_starts(std::span<const std::string> texts);

/// "--record-contact ID[:FROM[:TO]]". @throws RunError as above
[[nodiscard]] std::vector<ContactRecording> contact_recordings(std::span<const std::string> texts);

}  // namespace abut::app
