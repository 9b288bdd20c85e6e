// The faces of a model's elements and who owns them: behind Idel (which facets go when elements do) and TYPE5's nodal stiffness.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "model/model.hpp"

namespace abut::init {

/// Sorted distinct nodes of a face, filled up with no_index: the same for every way to list it.
using FaceKey = std::array<Index, 4>;

/// The nodes of an element's face in cyclic order, from its key.
[[nodiscard]] std::array<Index, 4> face_of(const model::Model& model, const model::ElementRef& e, const FaceKey& key);

/// Elements that contain each given face: shells with just these nodes, solids with this face.
class FaceOwners {
 public:
  explicit FaceOwners(const model::Model& model);
  [[nodiscard]] std::vector<model::ElementRef> of(const std::array<Index, 4>& nodes) const;
  [[nodiscard]] const std::map<FaceKey, std::vector<model::ElementRef>>& all() const { return owners_; }

 private:
  void add(const std::array<Index, 4>& nodes, model::ElementRef e);
  std::map<FaceKey, std::vector<model::ElementRef>> owners_;
};

}  // namespace abut::init
