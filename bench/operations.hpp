// What bench_operations adds to the output of bench_scenes.
#pragma once

#include <string>

namespace abut::bench {

/// `, "simple_elements": ...`: operations of the kernels per element and cycle, by kind; "" where nothing was counted.
[[nodiscard]] std::string operations_text(double element_cycles);

}  // namespace abut::bench
