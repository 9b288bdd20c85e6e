// What a run is, for the listing and the manifest: facts that the snapshot does not hold.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "cycle/run.hpp"
#include "init/contact_inspection.hpp"

namespace abut::output {

/// What the watch over the contacts found, as it happened.
struct RunFinding {
  Diagnostic diagnostic;
  Id interface_id = 0;
  double time = 0.0;
  std::int64_t cycle = 0;
  double measure = 0.0;
  std::vector<Id> nodes;                    ///< all of them; the text names twenty
  std::vector<std::array<Id, 4>> segments;  ///< node ids
};
using RunFindings = std::vector<RunFinding>;

struct RunInfo {
  std::string version;  ///< of abut
  std::string commit;   ///< of the source, empty when unknown at build
  std::string compiler;
  std::string instruction_set;  ///< "sse2", "avx2", "avx512"
  int threads = 1;
  std::string profile = "standard";
  std::string interface_law;  ///< "stiffening", "constant"; empty: the profile's
  std::vector<init::GradualStart> contact_ramps;
  int hash_every = 0;              ///< 0: no state hash
  std::vector<std::string> decks;  ///< paths of the Starter and Engine decks and their includes
  std::vector<Diagnostic> findings;
  std::vector<init::ContactFinding> contact;                              ///< what the inspection found; also among the findings, as text
  std::shared_ptr<RunFindings> during = std::make_shared<RunFindings>();  ///< filled while the run goes on; shared by its outputs
};

using PhaseTime = cycle::PhaseTime;

}  // namespace abut::output
