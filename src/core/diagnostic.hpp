// Findings about input. They are part of the public interface: include/abut/diagnostic.hpp.
#pragma once

#include "abut/diagnostic.hpp"  // IWYU pragma: export
