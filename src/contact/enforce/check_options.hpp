// The ranges of options, for interfaces and for whoever wants to know before there is one.
#pragma once

#include "abut/contact/both_sides.hpp"
#include "abut/contact/options.hpp"

namespace abut::contact {

/// @throws std::invalid_argument that names the option, what is right and what it was
void check(const FrictionFilter& filter);
void check(const Rules& rules);
void check(const Options& options);
void check(const BothSidesOptions& options);

}  // namespace abut::contact
