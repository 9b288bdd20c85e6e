#include "contact/enforce/check_options.hpp"

#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "contact/surface/side.hpp"

namespace abut::contact {
namespace {

void require(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument("contact: " + what);
}

void require(bool good, const char* what, double value) {
  if (!good) throw std::invalid_argument("contact: " + std::string(what) + ", not " + std::to_string(value));
}

void not_negative(double value, const char* what) {
  if (!(value >= 0.0) || !std::isfinite(value)) require(false, (std::string(what) + " must be >= 0 and finite").c_str(), value);
}

void positive(double value, const char* what) {
  if (!(value > 0.0) || !std::isfinite(value)) require(false, (std::string(what) + " must be > 0 and finite").c_str(), value);
}

/// A choice among those from 0 to `last`.
template <class Enum>
void choice(Enum value, Enum last, const char* what) {
  const int number = static_cast<int>(value);
  require(number >= 0 && number <= static_cast<int>(last),
          std::string(what) + " is choice " + std::to_string(number) + ", which does not exist");
}

void check(const FrictionLaw& law) {
  choice(law.model, FrictionLaw::Model::exponential, "model of the friction law");
  for (const double c : law.c) require(std::isfinite(c), "coefficients of the friction law must be finite", c);
}

void check_window(double birth, double death) {
  if (std::isnan(birth) || std::isnan(death)) require(false, "birth and death must be times", std::isnan(birth) ? birth : death);
  require(death > birth, "death must be later than birth", death);
}

}  // namespace

void check(const FrictionFilter& filter) {
  require(filter.share > 0.0 && filter.share <= 1.0, "filter share must be > 0 and at most 1", filter.share);
  not_negative(filter.frequency, "filter frequency");
}

void check(const Rules& rules) {
  choice(rules.law, Law::constant, "law");
  choice(rules.edges, Edges::plain, "edges");
}

void check(const Options& o) {
  positive(o.stiffness_scale, "stiffness_scale");
  not_negative(o.friction, "friction");
  check(o.friction_law);
  check(o.filter);
  positive(o.tangential_ratio, "tangential_ratio");
  not_negative(o.gap, "gap");
  require(o.damping >= 0.0 && o.damping <= 1.0, "damping must be 0 to 1 of critical", o.damping);
  check_window(o.birth, o.death);
  require(o.shear_limit > 0.0, "shear_limit must be > 0", o.shear_limit);
  not_negative(o.start_duration, "start_duration");
  choice(o.initial, Initial::ignore, "initial");
  check(o.rules);
  require(o.start_duration == 0.0 || o.initial == Initial::keep || o.initial == Initial::offset,
          "a gradual start pushes initial penetrations out; it cannot be had with project or ignore");
  require(!o.automatic_gap || o.rules.edges == Edges::closest, "automatic_gap cannot be had with plain edges");
  require(o.depth_limit >= 0.0, "depth_limit must be >= 0", o.depth_limit);
}

void check(const BothSidesOptions& o) {
  positive(o.gap, "gap");
  choice(o.stiffness, BothSidesOptions::Stiffness::series, "stiffness");
  choice(o.friction_form, BothSidesOptions::Friction::incremental, "friction_form");
  choice(o.initial, BothSidesOptions::Initial::drop_facets, "initial");
  not_negative(o.friction, "friction");
  check(o.friction_law);
  check(o.filter);
  not_negative(o.damping, "damping");
  not_negative(o.friction_viscosity, "friction_viscosity");
  not_negative(o.step_minimum, "step_minimum");
  positive(o.step_scale, "step_scale");
  not_negative(o.largest_penetration, "largest_penetration");
  not_negative(o.stiffness_min, "stiffness_min");
  require(o.stiffness_max >= o.stiffness_min, "stiffness_max must be at least stiffness_min", o.stiffness_max);
  require(o.gap_max > 0.0, "gap_max must be > 0", o.gap_max);
  check_window(o.birth, o.death);
  require(o.node_gap.empty() == o.facet_gap.empty(), "node_gap and facet_gap: both or none");
  require(o.node_size.empty() == o.facet_size.empty(), "node_size and facet_size: both or none");
  require(o.node_size.empty() || !o.node_gap.empty(), "node_size and facet_size come with node_gap and facet_gap");
  check_finite(o.node_gap, "node_gap");
  check_finite(o.facet_gap, "facet_gap");
  check_finite(o.node_size, "node_size");
  check_finite(o.facet_size, "facet_size");
}

}  // namespace abut::contact
