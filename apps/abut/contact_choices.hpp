// What the command line asks of single interfaces: ID:NUMBER...
#pragma once

#include <span>
#include <string>
#include <vector>

#include "abut/run.hpp"

namespace abut::app {

/// "--record-contact ID[:FROM[:TO]]". @throws RunError naming the text and what is wrong with it
[[nodiscard]] std::vector<ContactRecording> contact_recordings(std::span<const std::string> texts);

}  // namespace abut::app
