// What is behind abut::Model: the model as the mechanics take it, and the facts that the public interface shows.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "abut/model.hpp"
#include "core/profile.hpp"
#include "cycle/run.hpp"
#include "deck/deck.hpp"
#include "model/model.hpp"

namespace abut {

struct Model::Impl {
  model::Model model;
  std::filesystem::path path;
  std::vector<std::string> files;
  std::vector<Diagnostic> findings;
  ReadOptions options;
  int last_run = 1;
  std::uint64_t fingerprint = 0;
  std::vector<std::uint64_t> engine_fingerprint;  ///< of Engine decks 1 to n, for n = 1, 2, ...
  std::vector<PartInfo> parts;
  /// Of model.surfaces, made when they are first asked for: a run has no use for them.
  [[nodiscard]] const std::vector<SurfaceInfo>& surfaces() const;
  /// Ids of all elements of a kind, or of nodes (none): the same.
  [[nodiscard]] const std::vector<Id>& ids(ElementKind kind) const;
  std::vector<InterfaceInfo> interfaces;
  double read_seconds = 0.0;

 private:
  mutable std::shared_ptr<const std::vector<SurfaceInfo>> surfaces_;
  mutable std::array<std::shared_ptr<const std::vector<Id>>, 5> ids_;  // by kind
};

namespace run {

[[nodiscard]] Profile profile_of(Rules rules);
/// The interface of a choice that names one. @throws RunError naming the choice when the model has no such interface
[[nodiscard]] const model::Interface& interface_of(const model::Model& model, Id id, std::string_view choice);
/// @throws RunError when a choice is of an interface that is not there or cannot have it, or out of range
void check_choices(const model::Model& model, const Choices& choices);
/// The model with nodes moved out of initial penetrations where a choice is initial=project; the same model where none is.
[[nodiscard]] Model projected(const Model& model, const Choices& choices);
/// Model::inspect() of a model whose nodes are where the choices want them.
/// @param facing  not null: how the surfaces face each other where the model has them; empty where a run may see them otherwise
[[nodiscard]] Inspection inspect(const model::Model& model, const Choices& choices, bool with_step, init::FacingShares* facing = nullptr);
/// Options of the mechanics for these choices.
[[nodiscard]] cycle::RunOptions options_of(const Choices& choices, int threads);

}  // namespace run
}  // namespace abut
