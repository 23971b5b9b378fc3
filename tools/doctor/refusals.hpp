#pragma once

#include <string_view>

namespace laneloom::doctor {

/// The cause of a refusal, and its remedy.
struct Refusal {
  std::string_view reason;  ///< as counters name it, or <subject>_<reason> where it differs by subject
  std::string_view cause;
  std::string_view remedy;
};

/// Explains why the guard in front of DDS refused datagrams: datagrams_refused_<reason>.
Refusal explain_refused_datagrams(std::string_view reason);

/// Explains a counter <subject>_refused_<reason>, of the subject detections, poses or objects. For an unknown
/// reason, the explanation says that it is unknown.
Refusal explain_refusal(std::string_view subject, std::string_view reason);

}  // namespace laneloom::doctor
