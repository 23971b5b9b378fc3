#pragma once

#include <cstddef>
#include <functional>

namespace laneloom {

/// Does task(0) … task(count - 1) on all cores at once, in no particular order. When they are done, throws
/// what one of them threw.
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& task);

}  // namespace laneloom
