// What a run is, for the listing and the manifest: facts that the snapshot does not hold.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "abut/run.hpp"
#include "core/diagnostic.hpp"
#include "cycle/run.hpp"
#include "init/contact_inspection.hpp"
#include "output/files.hpp"

namespace abut::output {

using abut::RunFinding;
using RunFindings = std::vector<RunFinding>;

/// Where a run goes on.
struct ResumedFrom {
  std::int64_t cycle = 0;
  double time = 0.0;
  int run = 1;  ///< number of the run that goes on
};

struct RunInfo {
  std::string version;  ///< of abut
  std::string commit;   ///< of the source, empty when unknown at build
  std::string compiler;
  std::string instruction_set;  ///< "sse2", "avx2", "avx512"
  int threads = 1;
  std::string profile = "standard";
  std::vector<std::string> interfaces;  ///< choices for interfaces, "ID:KEY=VALUE,..."
  int hash_every = 0;                   ///< 0: no state hash
  std::optional<ResumedFrom> resumed;   ///< its files go on, too
  std::uint64_t model_fingerprint = 0;  ///< of the Starter deck's text
  std::vector<std::string> decks;       ///< paths of the Starter and Engine decks and their includes
  std::vector<Diagnostic> findings;
  /// What the inspection found; also among the findings, as text. One copy for all who write it.
  std::shared_ptr<const std::vector<init::ContactFinding>> contact = std::make_shared<const std::vector<init::ContactFinding>>();
  std::shared_ptr<RunFindings> during = std::make_shared<RunFindings>();  ///< filled while the run goes on; shared by its outputs

  [[nodiscard]] Opening opening() const { return resumed ? Opening::resumed : Opening::fresh; }
};

using PhaseTime = cycle::PhaseTime;

}  // namespace abut::output
