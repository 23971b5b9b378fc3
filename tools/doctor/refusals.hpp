#pragma once

#include <string_view>

namespace laneloom {

/// Why a message is refused, and what to do about it.
struct Refusal {
  std::string_view reason;  ///< as the counters name it: detections_refused_<reason>, poses_refused_<reason>
  std::string_view cause;
  std::string_view remedy;
};

/// Of a reason that is not known, it says no more than that.
Refusal explain_refusal(std::string_view reason);

}  // namespace laneloom
