// Interfaces of which each acts between the same two surfaces as another one.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace abut::init {

class SamePairs {
 public:
  explicit SamePairs(const model::Model& model) : model_(&model) {}

  /// Interfaces shown before that act between the same segments (of TYPE3 in either order) or nodes and segments at a common time.
  [[nodiscard]] std::vector<const model::Interface*> add(const model::Interface& card);

 private:
  using Side = std::vector<std::array<Index, 4>>;  ///< nodes of segments, both sorted
  using Pair = std::pair<std::size_t, std::array<Side, 2>>;

  const model::Model* model_;
  std::map<Pair, std::vector<const model::Interface*>> seen_;

  [[nodiscard]] Side side(Index surface) const;
};

}  // namespace abut::init
