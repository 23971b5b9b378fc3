#pragma once

#include <memory>
#include <string>

#include "laneloom/config.hpp"

namespace laneloom::dds {

/// One participant in the domain, in the partition of one vehicle. Readers and writers keep it alive.
/// Not thread-safe; not to be used within a reader's callback.
class Participant {
 public:
  /// `name` is shown to others. Throws std::runtime_error when the profile is missing or invalid, or DDS
  /// refuses.
  Participant(const DdsConfig& config, const std::string& name);

  class Impl;
  const std::shared_ptr<Impl>& impl() const { return impl_; }

 private:
  std::shared_ptr<Impl> impl_;
};

}  // namespace laneloom::dds
