#pragma once

#include <cstddef>
#include <functional>

namespace laneloom::experiment {

/// Runs task(0) … task(count - 1) on all cores at once, in no particular order. After all have ended, it
/// throws the exception of one that failed.
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& task);

}  // namespace laneloom::experiment
