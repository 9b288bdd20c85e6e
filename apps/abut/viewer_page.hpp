// The report's page, embedded by the build (viewer/build.mjs writes it, cmake/AbutViewer.cmake turns it into an object).
#pragma once

#include <string_view>

namespace abut::app {

/// Empty when the build could not bundle it; ABUT_VIEWER_ABSENT then says why.
[[nodiscard]] std::string_view viewer_page();

}  // namespace abut::app
