// What the command line asks of single interfaces: ID:NUMBER... against the model.
#pragma once

#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cycle/run.hpp"
#include "init/contact_options.hpp"
#include "model/model.hpp"
#include "output/files.hpp"

namespace abut::app {

/// "--contact-ramp ID:TIME". @throws RunError naming the text and what is wrong with it
[[nodiscard]] std::vector<init::GradualStart> gradual_starts(const model::Model& model, std::span<const std::string> texts);

/// "--record-contact ID[:FROM[:TO]]": the logs are opened in the run folder, which must exist.
struct ContactLogs {
  std::vector<cycle::ContactRecording> recordings;
  std::vector<std::unique_ptr<std::ofstream>> files;
};
/// Without opening anything. @throws RunError as above
[[nodiscard]] ContactLogs contact_logs(const model::Model& model, std::span<const std::string> texts, const std::string& program);
/// @throws RunError when a file cannot be made
void open_contact_logs(ContactLogs& logs, const output::RunFolder& folder);

}  // namespace abut::app
