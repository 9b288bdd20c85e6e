// /BOX (deck-format.md C.4).
#pragma once

#include <unordered_map>
#include <vector>

#include "model/reader.hpp"

namespace abut::model {

class Boxes {
 public:
  /// Reads all /BOX blocks; needs nodes and skews.
  explicit Boxes(Context& c);
  /// For each node whether it lies in or on box `id`; null when there is no such box. Lists are evaluated once.
  [[nodiscard]] const std::vector<bool>* nodes_inside(Id id);

 private:
  struct Box {
    enum class Kind { cuboid, cylinder, sphere, list } kind = Kind::cuboid;
    Id id = 0;
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 p1, p2;
    double diameter = 0.0;
    std::vector<Id> members;
    enum class State { unknown, in_progress, done } state = State::unknown;
    std::vector<bool> nodes;
    Place place;
  };
  void read(Context& c, const deck::Block& b);
  [[nodiscard]] static bool inside(const Box& box, const Vec3& x);
  void evaluate(Box& box);

  Context* context_;
  int depth_ = 0;
  std::vector<Box> boxes_;
  std::vector<Place> places_;
  std::unordered_map<Id, Index> by_id_;
};

}  // namespace abut::model
