// Writing checkpoints and going on from them.
#include "state/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "output/files.hpp"
#include "output/manifest.hpp"
#include "run/session.hpp"

namespace abut {
namespace {

/// A part of its own length: a reader that has no use for it passes over it.
template <class Body>
std::vector<std::byte> packed(Body&& body) {
  state::Archive a;
  body(a);
  return {a.bytes().begin(), a.bytes().end()};
}

template <class Body>
void unpack(const std::vector<std::byte>& bytes, Body&& body) {
  state::Archive a{std::span<const std::byte>(bytes)};
  body(a);
  a.finish();
}

[[noreturn]] void refuse(const std::filesystem::path& path, std::string_view why) {
  throw RunError(fmt::format("'{}' cannot be resumed: {}", path.string(), why));
}

}  // namespace

void run::CheckpointInfo::persist(state::Archive& a) {
  a.section("info", [&] {
    a(version);
    a(commit);
    a(name);
    a(deck);
    a(fingerprint);
    a(engine_fingerprint);
    a(run);
    for (bool* flag : {&reference, &orient, &allow_findings}) a(*flag);
    a.each_growing(interfaces, [&a](std::string& text) { a(text); });
    a(hash_every);
    a(checkpoint_every);
    a(cycle);
    a(time);
    a(hash);
  });
}

run::Checkpoint::Checkpoint(const std::filesystem::path& path) : file(output::read_bytes(path)) {
  archive = state::Archive(state::unseal(file));
  info.persist(archive);
  const output::RunInfo program = program_info();
  if (info.version != program.version || info.commit != program.commit) {
    const auto text = [](const std::string& version, const std::string& commit) {
      return commit.empty() ? version : fmt::format("{} ({})", version, commit);
    };
    refuse(path, fmt::format("it was written by abut {}, this is abut {}", text(info.version, info.commit),
                             text(program.version, program.commit)));
  }
}

run::CheckpointInfo Run::Impl::checkpoint_info() {
  const Model::Impl& m = model.impl();
  run::CheckpointInfo i;
  i.version = info.version;
  i.commit = info.commit;
  i.name = model.name();
  std::error_code ignored;
  if (!m.path.empty()) i.deck = std::filesystem::absolute(m.path, ignored).string();
  i.fingerprint = m.fingerprint;
  i.run = model.run_number();
  i.engine_fingerprint = m.engine_fingerprint[static_cast<std::size_t>(i.run) - 1];
  i.reference = settings.choices.rules == Rules::reference;
  i.orient = m.options.orient;
  i.allow_findings = settings.allow_findings;
  i.interfaces = info.interfaces;
  i.hash_every = settings.hash_every;
  i.checkpoint_every = settings.checkpoint_every;
  i.cycle = cycle->state().times.cycle;
  i.time = cycle->state().times.t;
  i.hash = cycle->hash();
  return i;
}

void Run::Impl::save(const std::filesystem::path& path, const std::filesystem::path& previous) {
  if (cycle->broken_off()) {
    throw RunError(
        fmt::format("'{}' is not written: the run broke off within cycle {}, and what it left there is not a state to go on from",
                    path.string(), cycle->state().times.cycle));
  }
  output::DurableFile file(path);
  state::Sealer sealer([&file](std::span<const std::byte> piece) {
    file.write({reinterpret_cast<const char*>(piece.data()), piece.size()});
  });
  state::Archive a([&sealer](std::span<const std::byte> piece) { sealer.add(piece); });
  checkpoint_info().persist(a);
  cycle->persist(a);
  std::vector<std::byte> watch = packed([this](state::Archive& part) {
    for (cycle::Sink* one : watches_) one->persist(part);
  });
  std::vector<std::byte> memory = packed([this](state::Archive& part) {
    if (memory_ != nullptr) memory_->persist(part);
  });
  // Files last: what they hold is brought to the disk before the checkpoint that counts on it.
  std::vector<std::byte> files = packed([this](state::Archive& part) {
    for (cycle::Sink* sink : files_) sink->persist(part);
  });
  a.section("sinks", [&] {
    a.growing(watch);
    a.growing(memory);
    a.growing(files);
  });
  a.finish();
  sealer.finish();
  file.replace(previous);
}

void Run::Impl::restore_outputs(run::Checkpoint& from, bool resume) {
  std::vector<std::byte> watch, memory, files;
  state::Archive& a = from.archive;
  a.section("sinks", [&] {
    a.growing(watch);
    a.growing(memory);
    a.growing(files);
  });
  a.finish();
  unpack(watch, [this](state::Archive& part) {
    for (cycle::Sink* one : watches_) one->persist(part);
  });
  if (memory_ != nullptr && !memory.empty()) unpack(memory, [this](state::Archive& part) { memory_->persist(part); });
  if (!resume) return;
  unpack(files, [this](state::Archive& part) {
    for (cycle::Sink* sink : files_) sink->persist(part);
  });
  const output::RunFolder folder{settings.output, model.name()};
  if (memory_ != nullptr && memory.empty()) memory_->read(folder.history(), from.info.time);
  for (const std::filesystem::path& log : output::contact_call_files(folder)) {
    tell("run.recording_stopped", "a run that goes on, also with a later Engine deck, is not recorded: this call log ends before it", log);
  }
}

void Run::Impl::keep_checkpoint() {
  if (settings.output.empty() || cycle->state().times.cycle == 0) return;
  const output::RunFolder folder{settings.output, model.name()};
  try {
    save(folder.checkpoint(), folder.previous_checkpoint());
  } catch (const std::exception& error) {
    if (std::exchange(told_checkpoint, true)) return;
    // The run itself is well: it goes on, and the checkpoint that is there stays.
    tell("run.no_checkpoint", fmt::format("at time {:.6g} (cycle {}): no checkpoint was written: {}", cycle->state().times.t,
                                          cycle->state().times.cycle, error.what()));
  }
}

void Run::save(const std::filesystem::path& checkpoint) { impl_->save(output::file_place(checkpoint), {}); }

Run Run::load(const Model& model, const std::filesystem::path& checkpoint, const RunSettings& settings) {
  try {
    run::Checkpoint from(checkpoint);
    if (from.info.fingerprint != model.fingerprint()) refuse(checkpoint, fmt::format("it is of another model ('{}')", from.info.name));
    const auto same = [](const std::string& a, const InterfaceChoice& b) { return a == to_string(b); };
    if (from.info.reference != (settings.choices.rules == Rules::reference) ||
        !std::ranges::equal(from.info.interfaces, settings.choices.interfaces, same)) {
      refuse(checkpoint, "it was written with another rule set or other settings of interfaces");
    }
    const output::RunFolder folder{settings.output, model.name()};
    std::error_code none;
    for (const std::filesystem::path& gone : {folder.checkpoint(), folder.previous_checkpoint()}) {
      if (!settings.output.empty() && std::filesystem::equivalent(checkpoint, gone, none))
        refuse(checkpoint, "a new run in its folder would remove it: name another folder, or resume the run");
    }
    return Run(std::make_unique<Impl>(model, settings, &from, false));
  } catch (const state::ArchiveError& error) { refuse(checkpoint, error.what()); }
}

namespace {

struct Candidates {
  std::filesystem::path folder, newest, previous;  ///< previous may be empty
};

Candidates find_checkpoints(const std::filesystem::path& place) {
  std::error_code error;
  if (std::filesystem::is_regular_file(place, error)) return {place.has_parent_path() ? place.parent_path() : ".", place, {}};
  if (!std::filesystem::is_directory(place, error)) refuse(place, "there is no such run folder");
  Candidates found{place, {}, {}};
  std::set<std::string> names;  // a run's own name may end in _previous
  for (const auto& entry : std::filesystem::directory_iterator(place, error)) {
    if (entry.path().extension() == ".rst") names.insert(entry.path().stem().string());
  }
  const auto of_the_one_before = [&names](const std::string& name) {
    constexpr std::string_view ending = "_previous";
    return name.ends_with(ending) && names.contains(name.substr(0, name.size() - ending.size()));
  };
  int count = 0;
  for (const std::string& name : names) {
    if (of_the_one_before(name)) {
      found.previous = place / (name + ".rst");
    } else {
      found.newest = place / (name + ".rst");
      ++count;
    }
  }
  if (count > 1) refuse(place, "it holds checkpoints of several runs; name one of the .rst files");
  if (found.newest.empty()) refuse(place, "there is no checkpoint in it (--checkpoint-every, /RFILE)");
  return found;
}

/// @param files_end  the files beside the checkpoint are those of a run that ended
Model model_of(const run::CheckpointInfo& info, const std::filesystem::path& checkpoint, const std::filesystem::path& deck,
               bool files_end) {
  const std::filesystem::path path = deck.empty() ? std::filesystem::path(info.deck) : deck;
  if (path.empty()) refuse(checkpoint, "its model was built in memory: load it with that model");
  std::error_code error;
  if (!std::filesystem::exists(path, error)) refuse(checkpoint, fmt::format("its deck '{}' is not there any more (--deck)", path.string()));
  Model model = Model::read(path, {.orient = info.orient, .write_deck = {}, .run = 1});
  if (model.fingerprint() != info.fingerprint) {
    refuse(checkpoint, fmt::format("'{}' is another model, or was changed since (the checkpoint is of '{}')", path.string(), info.name));
  }
  const std::vector<std::uint64_t>& engines = model.impl().engine_fingerprint;
  if (info.run < 1 || static_cast<std::size_t>(info.run) > engines.size() ||
      engines[static_cast<std::size_t>(info.run) - 1] != info.engine_fingerprint) {
    refuse(checkpoint, fmt::format("an Engine deck of the runs up to {} was changed since; what shall be different from here on goes into "
                                   "the Engine deck of run {}",
                                   info.run, info.run + 1));
  }
  if (info.run > 1) model = Model::read(path, {.orient = info.orient, .write_deck = {}, .run = info.run});
  if (info.time <= model.end_time()) return model;
  if (model.last_run_number() == info.run) {
    // Killed after its last checkpoint: the state is final, what is left is to end the files.
    if (!files_end) return model;
    refuse(checkpoint, fmt::format("the run is finished (time {:.8g}); an Engine deck of run {} with a later final time makes it go on",
                                   info.time, info.run + 1));
  }
  return Model::read(path, {.orient = info.orient, .write_deck = {}, .run = info.run + 1});
}

}  // namespace

Run Run::resume(const std::filesystem::path& place, const ResumeSettings& wanted) {
  // The name of the newest checkpoint may change until this run alone writes in the folder.
  output::FolderLock lock(find_checkpoints(place).folder);
  const Candidates candidates = find_checkpoints(place);
  const auto from_file = [&](const std::filesystem::path& path) {
    run::Checkpoint from(path);
    const run::CheckpointInfo& info = from.info;
    output::RunInfo of_checkpoint;
    of_checkpoint.model_fingerprint = info.fingerprint;
    of_checkpoint.profile = info.reference ? "reference" : "standard";
    of_checkpoint.interfaces = info.interfaces;
    if (const std::string other = output::manifest_difference({candidates.folder, info.name}, of_checkpoint); !other.empty()) {
      refuse(path, fmt::format("it is of {} ('{}') than the results in this folder", other, info.name));
    }
    const Model model = model_of(info, path, wanted.deck, !output::manifest_says_running({candidates.folder, info.name}));
    RunSettings settings;
    settings.threads = wanted.threads;
    settings.choices.rules = info.reference ? Rules::reference : Rules::standard;
    for (const std::string& text : info.interfaces) settings.choices.interfaces.push_back(interface_choice(text));
    settings.output = candidates.folder;
    settings.checkpoint_every = wanted.checkpoint_every >= 0 ? wanted.checkpoint_every : info.checkpoint_every;
    settings.hash_every = info.hash_every;
    settings.record_history = wanted.record_history;
    settings.progress = wanted.progress;
    settings.allow_findings = true;  // they were accepted, or there were none, when the run began
    settings.interrupt = wanted.interrupt;
    auto impl = std::make_unique<Impl>(model, settings, &from, true);
    impl->lock = std::move(lock);
    return impl;
  };
  std::string damage;
  try {
    return Run(from_file(candidates.newest));
  } catch (const state::ArchiveError& error) {
    damage = error.what();
    if (candidates.previous.empty()) refuse(candidates.newest, damage);
  }
  try {
    std::unique_ptr<Impl> impl = from_file(candidates.previous);
    // The whole one takes the place of the damaged one: from here on it is the one that the next checkpoint keeps.
    std::filesystem::rename(candidates.previous, candidates.newest);
    impl->tell("run.previous_checkpoint",
               fmt::format("{}; the run goes on from the checkpoint before it, of cycle {}", damage, impl->cycle->state().times.cycle),
               candidates.newest);
    return Run(std::move(impl));
  } catch (const state::ArchiveError& error) {
    refuse(place, fmt::format("{}: {}; {}: {}", candidates.newest.filename().string(), damage, candidates.previous.filename().string(),
                              error.what()));
  }
}

}  // namespace abut
