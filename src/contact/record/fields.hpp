// The members of options and results, one by one, for writing and reading. A member that is added to one of these structures
// breaks the compilation here: add it to the list, and raise log_version in recorder.hpp.
#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "abut/contact/both_sides.hpp"
#include "abut/contact/options.hpp"
#include "contact/record/bytes.hpp"

namespace abut::contact {

class FieldWriter {
 public:
  explicit FieldWriter(ByteWriter& out) : out_(out) {}
  template <class T>
  void value(const T& v) {
    out_.put(v);
  }
  void flag(bool v) { out_.put(static_cast<std::uint8_t>(v ? 1 : 0)); }
  template <class E>
  void choice(E v, E /*last*/) {
    out_.put(static_cast<std::uint32_t>(v));
  }
  void list(const std::vector<double>& v) { out_.put_all(v); }

 private:
  ByteWriter& out_;
};

class FieldReader {
 public:
  explicit FieldReader(ByteReader& in) : in_(in) {}
  template <class T>
  void value(T& v) {
    in_.get(v);
  }
  void flag(bool& v) { v = in_.next<std::uint8_t>() != 0; }
  template <class E>
  void choice(E& v, E last) {
    const auto number = in_.next<std::uint32_t>();
    if (number > static_cast<std::uint32_t>(last)) in_.refuse("has a choice that does not exist");
    v = static_cast<E>(number);
  }
  void list(std::vector<double>& v) { in_.get_any(v); }

 private:
  ByteReader& in_;
};

template <class T, class Of>
concept LikeA = std::same_as<std::remove_const_t<T>, Of>;

template <class Io, LikeA<FrictionLaw> T>
void fields(Io& io, T& v) {
  auto& [model, c] = v;
  io.choice(model, FrictionLaw::Model::exponential);
  io.value(c);
}

template <class Io, LikeA<FrictionFilter> T>
void fields(Io& io, T& v) {
  auto& [share, frequency] = v;
  io.value(share);
  io.value(frequency);
}

template <class Io, LikeA<Rules> T>
void fields(Io& io, T& v) {
  auto& [law, edges, half, third, friction, area_ratio, switching, unlimited, limits_step] = v;
  io.choice(law, Law::constant);
  io.choice(edges, Edges::plain);
  for (auto* flag : {&half, &third, &friction, &area_ratio, &switching, &unlimited, &limits_step}) io.flag(*flag);
}

template <class Io, LikeA<Options> T>
void fields(Io& io, T& v) {
  auto& [scale, friction, friction_law, filter, tangential_ratio, gap, automatic, birth, death, start, shear_limit, damping, initial, depth,
         rules] = v;
  for (auto* number : {&scale, &friction, &tangential_ratio, &gap, &birth, &death, &start, &shear_limit, &damping, &depth})
    io.value(*number);
  fields(io, friction_law);
  fields(io, filter);
  io.choice(initial, Initial::ignore);
  io.flag(automatic);
  fields(io, rules);
}

template <class Io, LikeA<BothSidesOptions> T>
void fields(Io& io, T& v) {
  using O = BothSidesOptions;
  auto& [gap, node_gap, facet_gap, gap_max, node_size, facet_size, stiffness, stiffness_min, stiffness_max, friction, friction_law, filter,
         form, damping, viscosity, initial, penetration, birth, death, step_minimum, step_scale, reference_step, switch_correction,
         all_pieces] = v;
  for (auto* number : {&gap, &gap_max, &stiffness_min, &stiffness_max, &friction, &damping, &viscosity, &penetration, &birth, &death,
                       &step_minimum, &step_scale}) {
    io.value(*number);
  }
  for (auto* list : {&node_gap, &facet_gap, &node_size, &facet_size}) io.list(*list);
  io.choice(stiffness, O::Stiffness::series);
  fields(io, friction_law);
  fields(io, filter);
  io.choice(form, O::Friction::incremental);
  io.choice(initial, O::Initial::drop_facets);
  io.flag(reference_step);
  io.flag(switch_correction);
  io.flag(all_pieces);
}

template <class Io, LikeA<StepResult> T>
void fields(Io& io, T& v) {
  auto& [elastic, friction, damping, start, made, normal, tangential, in_contact, largest, deepest, crossed, lost, approach, step, node] =
      v;
  for (auto* number : {&elastic, &friction, &damping, &start, &made, &largest, &approach, &step}) io.value(*number);
  io.value(normal);
  io.value(tangential);
  for (auto* count : {&in_contact, &deepest, &crossed, &lost, &node}) io.value(*count);
}

}  // namespace abut::contact
